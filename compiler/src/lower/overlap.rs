//! Machines that overlap one another or an obstacle.

use crate::diagnostic::{Diagnostic, MOST};
use crate::layout::{Layout, Object};
use runtime_sim::collision;
use runtime_sim::line::Line;
use std::collections::HashMap;

/// The type of an obstacle around the end of a belt.
const COLLECTOR: &str = "collector";

fn conveys(plant: &Line, name: &str) -> bool {
    plant.machines.iter().any(|machine| machine.name == name && machine.lanes().next().is_some())
}

pub fn overlaps(layout: &Layout, plant: &Line) -> Vec<Diagnostic> {
    let objects: HashMap<&str, &Object> =
        layout.objects.iter().map(|object| (object.name.value.as_str(), object)).collect();
    let overlaps = collision::overlaps(plant, MOST).into_iter();
    let found = overlaps.filter_map(|overlap| {
        let [a, b] = overlap.names.each_ref().map(|name| objects.get(name.as_str()).copied());
        let (a, b) = (a?, b?);
        let is_at_belt = |collector: &Object, other: &Object| {
            collector.kind.value == COLLECTOR && conveys(plant, &other.name.value)
        };
        if is_at_belt(a, b) || is_at_belt(b, a) {
            return None;
        }
        let [first, second] = [a, b].map(|object| &object.name);
        let [of_first, of_second] = &overlap.parts;
        let message = format!("{} and {} overlap", first.value, second.value);
        let note = format!(
            "{of_first} of {} meets {of_second} of {} before anything moves",
            first.value, second.value
        );
        Some(
            Diagnostic::new("E0409", first.span, message)
                .other(second.span, "the other one")
                .note(note)
                .help("move one of the two, or say under \"may_touch\" why the overlap is harmless"),
        )
    });
    found.collect()
}
