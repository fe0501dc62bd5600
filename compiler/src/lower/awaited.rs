//! What a machine awaits in a state in which no command is under way: others, or a timer or a signal of its own.

use crate::ir::{
    Automaton, Clause, Expr, ExprKind, InterfaceId, Operator, Place, Role, RoleKind, Scalar, State, System,
    Value,
};
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

/// Sees the members of interfaces that an instance may await: those of its roles, and those that its parameters name.
fn each_known(system: &System, instance: usize, mut see: impl FnMut(InterfaceId, usize)) {
    let (automaton, of_instance) = (system.automaton_of(instance), &system.instances[instance]);
    for (role, rows) in automaton.roles.iter().zip(&of_instance.roles) {
        if can_be_awaited(role, rows) {
            rows.iter().for_each(|row| see(role.interface, *row));
        }
    }
    for (parameter, values) in automaton.parameters.iter().zip(&of_instance.parameters) {
        let Scalar::Ref(interface) = parameter.ty.scalar else { continue };
        let rows = values.iter().filter_map(|value| match value {
            Value::Int(row) => usize::try_from(*row).ok(),
            Value::Bool(_) | Value::Real(_) | Value::Point(_) => None,
        });
        rows.filter(|row| *row < system.members[interface.0].len()).for_each(|row| see(interface, row));
    }
}

pub fn partners(system: &System) -> Vec<Partners> {
    let written: Vec<BTreeSet<Cell>> = system.model.automata.iter().map(written_of_others).collect();
    let mut partners = vec![Partners::new(); system.instances.len()];
    for (partner, instance) in system.instances.iter().enumerate() {
        each_known(system, partner, |interface, row| {
            let cells = written[instance.automaton.0].iter().filter(|cell| cell.0 == interface);
            partners[system.members[interface.0][row]].extend(cells.map(|cell| (*cell, partner)));
        });
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
            Whose::Others => each_known(system, instance, |of, row| {
                if of == *interface {
                    others.insert(system.members[interface.0][row]);
                }
            }),
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

/// Whether no guard of a state holds before the device has answered the last command.
pub fn awaits_answer(automaton: &Automaton, state: &State) -> bool {
    state.transitions.iter().all(|transition| {
        transition.clauses.iter().any(|clause| match clause {
            Clause::Condition(condition) => implies_answer(automaton, condition),
            Clause::Bind(_) => false,
        })
    })
}

fn implies_answer(automaton: &Automaton, condition: &Expr) -> bool {
    let implies = |condition: &Expr| implies_answer(automaton, condition);
    match &condition.kind {
        ExprKind::Done | ExprKind::Failed => true,
        ExprKind::Binary(Operator::And, left, right) => implies(left) || implies(right),
        ExprKind::Binary(Operator::Or, left, right) => implies(left) && implies(right),
        ExprKind::Define(define) => implies(&automaton.defines[*define].value),
        _ => false,
    }
}

/// The inputs by which a device answers a command.
const ANSWER: [&str; 3] = ["got", "ack", "error"];
