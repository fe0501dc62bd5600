//! Processes for kinds that are hardly meant.

use crate::diagnostic::{Diagnostic, suggestion};
use crate::ir::System;
use runtime_sim::line::Line;

/// One for each name in a device, whatever number of machines has it, that is nearly that of a kind of the scenario. Names
/// of other kinds are for other scenarios.
pub fn check(system: &System, line: &Line) -> Vec<Diagnostic> {
    let known: Vec<&str> = line.kinds.iter().map(|kind| &kind.name[..]).collect();
    let mut found = Vec::new();
    for (number, machine) in line.machines.iter().enumerate() {
        let device = &system.automaton_of(number).device;
        for (part, process) in machine.processes() {
            // What `makes` makes of a kind is checked as an error.
            let made = process.makes.iter().map(|[from, _]| from);
            let rejected = process.rejects.iter().flat_map(|reject| &reject.kinds);
            let named = process.kinds.iter().chain(made).chain(rejected).chain(&process.joins);
            for name in named.filter(|name| !known.contains(&&name[..])) {
                let near = suggestion(name, known.iter().copied());
                let (Some(near), Some(place)) = (near, device.place_of(part)) else { continue };
                let process = &machine.parts[part].name;
                let message = format!("no kind of the scenario is `{name}`, which `{process}` names");
                let told = Diagnostic::new("W0206", place, message)
                    .note(format!("kinds of the scenario are {}", known.join(", ")))
                    .help(format!("is `{near}` meant?"));
                if !found.contains(&told) {
                    found.push(told);
                }
            }
        }
    }
    found
}
