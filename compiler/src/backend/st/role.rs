//! What the robots of a type have in common: members of roles, arrays of parameters.

use crate::ir::{AutomatonId, Extent, Instance, RoleId, System};

/// How the members of a role are known to the block of a type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Members {
    /// For every robot of the type the first rows of the interface, so many.
    All(usize),
    /// Each robot has its list, of at most so many.
    Listed(usize),
}

pub fn members(system: &System, id: AutomatonId, role: RoleId) -> Members {
    let lists: Vec<_> = robots(system, id).map(|robot| &robot.roles[role.0]).collect();
    let most = lists.iter().map(|l| l.len()).max().unwrap_or(0);
    let is_all = lists.iter().all(|list| list.iter().copied().eq(0..most));
    if is_all { Members::All(most) } else { Members::Listed(most) }
}

/// Whether a parameter is an array that several robots of a type have alike.
pub fn is_alike(system: &System, id: AutomatonId, parameter: usize) -> bool {
    let mut values = robots(system, id).map(|robot| &robot.parameters[parameter]).peekable();
    let is_array = system.model.automaton(id).parameters[parameter].ty.extent != Extent::One;
    let Some(first) = values.next().filter(|_| is_array) else { return false };
    values.peek().is_some() && values.all(|v| v == first)
}

fn robots(system: &System, id: AutomatonId) -> impl Iterator<Item = &Instance> {
    system.instances.iter().filter(move |i| i.automaton == id)
}
