//! What is known while an automaton is checked.

use super::Checker;
use super::facts::Facts;
use crate::ir::{self, Scalar, VariableId};
use std::collections::{BTreeMap, BTreeSet};

/// What a name means in an automaton.
#[derive(Clone, Debug)]
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
    /// Own interface, if the automaton shows something that no declared interface has.
    pub(super) own_interface: Option<ir::InterfaceId>,
}
