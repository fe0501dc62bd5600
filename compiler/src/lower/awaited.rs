//! What a machine awaits in a state in which no command is under way: others, or a timer or a signal of its own.

use crate::ir::{Automaton, InterfaceId, Place, Role, RoleKind, System};
use crate::reads::{ReadCell, Reads, Whose};
use std::collections::BTreeSet;

/// A cell of an interface.
type Cell = (InterfaceId, usize);

/// Of an instance: its cells that others write, each with one who may do so.
pub type Partners = Vec<(Cell, usize)>;

/// The members of a role that may be awaited one by one: of a `knows` with more of them, such as all zones of a line, it
/// would tell nothing who they are.
const MOST_KNOWN: usize = 8;

fn can_be_awaited(role: &Role, rows: &[usize]) -> bool {
    role.kind != RoleKind::Knows || rows.len() <= MOST_KNOWN
}

pub fn partners(system: &System) -> Vec<Partners> {
    let written: Vec<BTreeSet<Cell>> = system.model.automata.iter().map(written_of_others).collect();
    let mut partners = vec![Partners::new(); system.instances.len()];
    for (partner, instance) in system.instances.iter().enumerate() {
        for (role, rows) in system.automaton_of(partner).roles.iter().zip(&instance.roles) {
            if can_be_awaited(role, rows) {
                let members = &system.members[role.interface.0];
                let cells = written[instance.automaton.0].iter().filter(|cell| cell.0 == role.interface);
                for (row, cell) in rows.iter().flat_map(|row| cells.clone().map(move |cell| (row, cell))) {
                    partners[members[*row]].push((*cell, partner));
                }
            }
        }
    }
    partners
}

fn written_of_others(automaton: &Automaton) -> BTreeSet<Cell> {
    let transitions = automaton.states.iter().flat_map(|state| &state.transitions);
    let targets =
        transitions.flat_map(|transition| &transition.updates).filter_map(|update| update.kind.target());
    let cells = targets.filter_map(|target| match target.place {
        Place::Cell { interface, cell, of: Some(_), .. } => Some((interface, cell)),
        _ => None,
    });
    cells.collect()
}

/// Who writes the cells that guards read, but for the instance itself.
pub fn others(system: &System, partners: &[Partners], instance: usize, guards: &Reads) -> BTreeSet<usize> {
    let mut others = BTreeSet::new();
    for ReadCell { interface, cell, of } in &guards.cells {
        match of {
            // A cell of its own is awaited from those that write it too.
            Whose::Own => {
                let of_cell = partners[instance].iter().filter(|(of, _)| *of == (*interface, *cell));
                others.extend(of_cell.map(|(_, partner)| *partner));
            }
            Whose::Others => {
                let roles = system.automaton_of(instance).roles.iter().zip(&system.instances[instance].roles);
                let rows = roles
                    .filter(|(role, rows)| role.interface == *interface && can_be_awaited(role, rows))
                    .flat_map(|(_, rows)| rows);
                others.extend(rows.map(|row| system.members[interface.0][*row]));
            }
        }
    }
    others.remove(&instance);
    others
}

/// Whether an instance whose command has ended awaits a timer or a signal of its own. The answer to the command is none
/// where others are awaited: it is there.
pub fn awaits_itself(automaton: &Automaton, guards: &Reads, others: &BTreeSet<usize>) -> bool {
    let is_answer = |port: &usize| {
        let port = &automaton.device.ports[*port];
        port.place.is_none() && ANSWER.contains(&port.name.as_str())
    };
    let mut inputs = guards.inputs.iter();
    !guards.timers.is_empty()
        || if others.is_empty() { inputs.next().is_some() } else { inputs.any(|port| !is_answer(port)) }
}

/// The inputs by which a device answers a command.
const ANSWER: [&str; 3] = ["got", "ack", "error"];
