//! Sensors for a word that no kind has.

use crate::diagnostic::{Diagnostic, suggestion};
use crate::ir::System;
use runtime_sim::line::Line;
use runtime_sim::part::Primitive;
use std::collections::BTreeSet;

/// One for each part of a device, whatever number of machines has it.
pub fn check(system: &System, line: &Line) -> Vec<Diagnostic> {
    let words: BTreeSet<&str> = line.kinds.iter().flat_map(|kind| &kind.is).map(String::as_str).collect();
    let mut found = Vec::new();
    for (number, machine) in line.machines.iter().enumerate() {
        let device = &system.automaton_of(number).device;
        for (part, made) in machine.parts.iter().enumerate() {
            let Primitive::Beam(beam) = &made.primitive else { continue };
            let Some(word) = beam.only.as_deref().filter(|word| !words.contains(word)) else { continue };
            let Some(place) = device.place_of(part) else { continue };
            let message = format!("no kind of the scenario is `{word}`: `{}` never sees anything", made.name);
            let known: Vec<&str> = words.iter().copied().collect();
            let note = match known.is_empty() {
                true => "no kind of the scenario has the key `is`".into(),
                false => format!("kinds of the scenario are {}", known.join(", ")),
            };
            let help = match suggestion(word, known) {
                Some(near) => format!("is `{near}` meant?"),
                None => format!(
                    "give a kind this word in the scenario, `\"is\": [\"{word}\"]`, or correct `only`"
                ),
            };
            let told = Diagnostic::new("W0203", place, message).note(note).help(help);
            if !found.contains(&told) {
                found.push(told);
            }
        }
    }
    found
}
