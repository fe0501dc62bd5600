//! Machines that work with one another, of which one forgets after a loss of power what the other one relies on.

use crate::diagnostic::Diagnostic;
use crate::ir::{Automaton, System};
use std::collections::BTreeSet;

/// Each pair of types once.
pub fn check(system: &System) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    let mut known = BTreeSet::new();
    for (number, instance) in system.instances.iter().enumerate() {
        let automaton = system.automaton_of(number);
        for (role, rows) in automaton.roles.iter().zip(&instance.roles) {
            if system.model.interface(role.interface).cells.is_empty() {
                continue;
            }
            for member in rows.iter().map(|row| system.members[role.interface.0][*row]) {
                let other = system.automaton_of(member);
                let pair = match (automaton.retained.state, other.retained.state) {
                    (true, false) if other.retained.is_empty() => [automaton, other],
                    (false, true) if automaton.retained.is_empty() => [other, automaton],
                    _ => continue,
                };
                let mut types = [instance.automaton.0, system.instances[member].automaton.0];
                types.sort_unstable();
                if has_memory(system, pair[1]) && known.insert(types) {
                    found.push(warning(pair, &system.model.interface(role.interface).name));
                }
            }
        }
    }
    found
}

/// Whether there is anything that a loss of power takes from it.
fn has_memory(system: &System, automaton: &Automaton) -> bool {
    let mut interfaces = automaton.implements.iter().map(|implements| implements.interface);
    // The first state is the beginning.
    automaton.states.len() > 2
        || !automaton.locals.is_empty()
        || interfaces.any(|interface| !system.model.interface(interface).cells.is_empty())
}

fn warning([retains, forgets]: [&Automaton; 2], interface: &str) -> Diagnostic {
    let message =
        format!("`{}` retains nothing, and `{}`, with which it works, does", forgets.name, retains.name);
    Diagnostic::new("W0207", forgets.place, message)
        .other(retains.place, "this one continues after a loss of power")
        .note(format!("they share the cells of `{interface}`: after a loss of power one side begins anew"))
        .help("write `retain all;` in both of them, or in none")
}
