//! Which properties are searched.

use crate::ir::{Automaton, Property, PropertyKind, Severity};

/// What always holds, unless a violation only warns. What follows within a time is left out: time has no measure here.
pub fn searched(automaton: &Automaton) -> impl Iterator<Item = &Property> {
    let properties = automaton.properties.iter();
    properties.filter(|p| p.severity != Severity::Warning && matches!(p.kind, PropertyKind::Always(_)))
}
