//! Who writes the cells of a line.

use crate::ir::{AutomatonId, Expr, InterfaceId, Place, System, Transition};
use std::cell::OnceCell;
use std::collections::BTreeMap;

/// An update of a cell, in a type.
pub struct Write<'a> {
    automaton: AutomatonId,
    pub transition: &'a Transition,
    /// None: one's own.
    pub of: Option<&'a Expr>,
    /// None of a copy.
    pub value: Option<&'a Expr>,
}

/// Of one cell of an interface.
#[derive(Default)]
struct Written<'a> {
    writes: Vec<Write<'a>>,
    /// In layout order.
    instances: OnceCell<Vec<usize>>,
}

/// The updates of each cell of an interface.
pub struct Writers<'a> {
    system: &'a System,
    cells: BTreeMap<(InterfaceId, usize), Written<'a>>,
}

impl<'a> Writers<'a> {
    pub fn new(system: &'a System) -> Self {
        let mut cells: BTreeMap<(InterfaceId, usize), Written> = BTreeMap::new();
        for (number, automaton) in system.model.automata.iter().enumerate() {
            for transition in automaton.states.iter().flat_map(|state| &state.transitions) {
                for update in &transition.updates {
                    let Some(target) = update.kind.target() else { continue };
                    let value = update.kind.value();
                    let Place::Cell { interface, cell, of, .. } = &target.place else { continue };
                    let write =
                        Write { automaton: AutomatonId(number), transition, of: of.as_deref(), value };
                    cells.entry((*interface, *cell)).or_default().writes.push(write);
                }
            }
        }
        Self { system, cells }
    }

    /// Each instance that may write a cell, with each update that does it.
    pub fn of(&self, interface: InterfaceId, cell: usize) -> impl Iterator<Item = (usize, &Write<'a>)> {
        self.cells.get(&(interface, cell)).into_iter().flat_map(|written| {
            let type_of = |instance: usize| self.system.instances[instance].automaton;
            let writes = move |instance: usize| {
                written.writes.iter().filter(move |w| w.automaton == type_of(instance))
            };
            let all = || {
                let all = 0..self.system.instances.len();
                all.filter(|instance| writes(*instance).next().is_some()).collect()
            };
            let instances = written.instances.get_or_init(all);
            instances.iter().flat_map(move |instance| writes(*instance).map(|write| (*instance, write)))
        })
    }
}
