//! Conveyors that are shorter than what comes onto them.

use crate::diagnostic::Diagnostic;
use crate::layout::{Layout, Object};
use runtime_sim::line::Line;
use runtime_sim::part::Primitive;
use std::collections::HashMap;

/// One for each such lane; `comes` says whether a kind gets to a lane, a part of a machine.
pub fn lanes(layout: &Layout, line: &Line, comes: impl Fn((usize, usize), usize) -> bool) -> Vec<Diagnostic> {
    let objects: HashMap<&str, &Object> =
        layout.objects.iter().map(|object| (object.name.value.as_str(), object)).collect();
    let mut found = Vec::new();
    for (number, machine) in line.machines.iter().enumerate() {
        let Some(object) = objects.get(machine.name.as_str()) else { continue };
        for (part, made) in machine.parts.iter().enumerate() {
            let Primitive::Lane(lane) = &made.primitive else { continue };
            let length = lane.centre_line.length();
            let kinds = line.kinds.iter().enumerate();
            let kinds = kinds.map(|(number, kind)| (number, lane.lengths_of(kind.size)[0], kind));
            let longer = kinds.filter(|(kind, long, _)| *long > length && comes((number, part), *kind));
            let Some((_, long, kind)) = longer.max_by(|a, b| a.1.total_cmp(&b.1)) else { continue };
            let name = format!("{}.{}", machine.name, made.name);
            let message = format!("the conveyor {name} is shorter than a `{}`", kind.name);
            found.push(
                Diagnostic::new("E0411", object.name.span, message)
                    .note(format!("it is {length:.3} m long, a `{}` is {long:.3} m", kind.name))
                    .note("an item is on the conveyor on which its middle is, and stops what comes behind it")
                    .help("make it longer, or one conveyor of it and of that before or after it"),
            );
        }
    }
    found
}
