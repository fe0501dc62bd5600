//! Items that would change their size on a conveyor.

use super::role;
use crate::diagnostic::Diagnostic;
use runtime_sim::line::Line;

/// One for each process on a lane, and pair of its kinds, of which the one is not as long and as wide as the other. Where
/// items bear others this is found in the run: what lies on a tray may change its size.
pub fn items(of: &role::Line, line: &Line) -> Vec<Diagnostic> {
    let size = |name: &str| line.kinds.iter().find(|kind| kind.name == name).map(|kind| kind.size);
    let mut found = Vec::new();
    if line.kinds.iter().any(|kind| kind.deck.is_some()) {
        return found;
    }
    for (number, machine) in line.machines.iter().enumerate() {
        let on_lanes = machine.processes().filter(|(_, process)| process.at.is_some());
        for (part, process) in on_lanes {
            for [from, to] in process.made() {
                let (Some(before), Some(after)) = (size(from), size(to)) else { continue };
                if before == after {
                    continue;
                }
                let object = of.robots[number].object;
                let name = format!("{}.{}", machine.name, machine.parts[part].name);
                let message = format!("`{name}` would make a `{to}` of a `{from}`, which is of another size");
                let written = |[x, y]: [f64; 2]| format!("{x} m x {y} m");
                let mut diagnostic = Diagnostic::new("E0413", object.name.span, message)
                    .note(format!("a `{from}` is {}, a `{to}` is {}", written(before), written(after)))
                    .note("on a conveyor, items lie close to one another: what becomes longer would push the others")
                    .help("give both kinds the same `size`, or let the process work at a place");
                if let Some(place) = of.automaton(number).device.place_of(part) {
                    diagnostic = diagnostic.other(place, "the process");
                }
                found.push(diagnostic);
            }
        }
    }
    found
}
