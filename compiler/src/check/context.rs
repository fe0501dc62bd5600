//! What is known while an automaton is checked.

use super::Checker;
use super::decided::Defined;
use super::facts::Facts;
use super::names::{Number, Space};
use crate::ir::{self, Scalar, VariableId};
use crate::source::Span;
use std::collections::{BTreeMap, BTreeSet};

/// What a name means in an automaton.
#[derive(Clone, Copy, Debug)]
pub enum Symbol {
    Local(usize),
    Cell(ir::InterfaceId, usize),
    Port(usize),
    Parameter(usize),
    /// Becomes a parameter when it is first read.
    DeviceConstant(usize),
    Define(usize),
    Role(ir::RoleId),
}

/// An automaton under construction and what is known at the present place of its text.
pub struct Context<'c, 'a> {
    pub(super) checker: &'c mut Checker<'a>,
    pub(super) automaton: ir::Automaton,
    pub(super) id: ir::AutomatonId,
    pub(super) symbols: BTreeMap<String, Symbol>,
    /// Variables in scope, innermost last.
    pub(super) variables: Vec<(String, VariableId, Scalar)>,
    /// Their numbers in the table of names.
    pub(super) variable_names: BTreeMap<VariableId, Number>,
    pub(super) facts: Facts,
    /// What the requirements say, and thus holds everywhere.
    pub(super) required: Facts,
    /// `after` has a meaning.
    pub(super) in_guard: bool,
    /// Names whose declarations have errors: reading them is no further one.
    pub(super) broken: BTreeSet<String>,
    /// An interface is not known, and with it the names of its cells.
    pub(super) lacks_names: bool,
    /// States, as the text names them.
    pub(super) states: Vec<String>,
    /// Of the definitions, in their order.
    pub(super) defined: Vec<Defined>,
    /// Definitions that have no meaning yet: the one at hand, and those below it.
    pub(super) defined_below: Vec<String>,
    /// Own interface, if the automaton shows something that no declared interface has.
    pub(super) own_interface: Option<ir::InterfaceId>,
}

impl Context<'_, '_> {
    /// Notes that a name stands at a place.
    pub(super) fn uses_symbol(&mut self, name: &str, symbol: &Symbol, span: Span) {
        if self.checker.names.is_none() {
            return;
        }
        let own = self.automaton.name.clone();
        let device = self.automaton.device.name.clone();
        let checker = &mut *self.checker;
        match symbol {
            Symbol::Local(_) | Symbol::Define(_) | Symbol::Role(_) => {
                checker.uses(span, Space::OfType, &own, name);
            }
            // A constant of the device becomes a parameter when it is first read.
            Symbol::Parameter(_) => {
                checker.uses(span, Space::OfDevice, &device, name);
                checker.uses(span, Space::OfType, &own, name);
            }
            Symbol::Port(_) => checker.uses(span, Space::Ports, &device, name),
            Symbol::DeviceConstant(_) => {
                checker.uses(span, Space::OfDevice, &device, name);
            }
            Symbol::Cell(interface, _) => {
                let of = checker.model.interfaces[interface.0].name.clone();
                checker.uses(span, Space::OfType, &of, name);
            }
        }
    }
}
