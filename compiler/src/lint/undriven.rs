//! Outputs that the automaton never writes, and parts of a device that do nothing unless they are driven, which neither an
//! output nor a command drives.

use crate::device::{Device, type_text};
use crate::diagnostic::Diagnostic;
use crate::ir::{Automaton, Model, Place};
use crate::layout::Panel;
use runtime_sim::device::{Direction, Extent};
use runtime_sim::wiring::{Drives, Output};
use std::collections::BTreeSet;

/// Parts that act without a controller as well: a lane without `run` always runs, a source brings by its times, a tank
/// keeps what it has.
const ACT_ALONE: [&str; 3] = ["lane", "source", "tank"];

/// What holds a fixed stop: a cylinder that is never driven, and out.
const STANDS_OUT: &str = "begins_out";

/// With a panel for each machine, a person moves by hand what the automaton does not write.
pub fn check(model: &Model, panel: Panel, found: &mut Vec<Diagnostic>) {
    let mut devices = BTreeSet::new();
    for automaton in &model.automata {
        if panel == Panel::Line {
            found.extend(unwritten(automaton));
        }
        if devices.insert(&automaton.device.name) {
            found.extend(undriven(&automaton.device));
        }
    }
}

fn unwritten(automaton: &Automaton) -> impl Iterator<Item = Diagnostic> {
    let transitions = automaton.states.iter().flat_map(|state| &state.transitions);
    let updates = transitions.flat_map(|transition| &transition.updates);
    let written = updates.filter_map(|update| match update.kind.target()?.place {
        Place::Port { port, .. } => Some(port),
        _ => None,
    });
    let written: BTreeSet<usize> = written.collect();
    levels(&automaton.device).filter(move |(port, _)| !written.contains(port)).map(|(port, _)| {
        let [port, automaton_name] = [&automaton.device.ports[port].name, &automaton.name];
        let message = format!("`{automaton_name}` never writes the output `{port}`");
        Diagnostic::new("W0109", automaton.place, message)
            .other(automaton.device.place, "of this device")
            .note("what it drives stays as it is at power-up")
            .help(format!("write it where it has to act, such as `{port} := ...;`, or remove the output"))
    })
}

/// Outputs that set a level, by their numbers among the ports.
fn levels(device: &Device) -> impl Iterator<Item = (usize, &Output)> {
    let ports = device.ports.iter().enumerate();
    let outputs = ports.filter(|(_, port)| port.direction == Direction::Output);
    let numbers = outputs.map(|(number, _)| number);
    let levels = numbers.zip(&device.wiring.outputs);
    levels.filter(|(_, output)| matches!(output.drives, Drives::Level { .. }))
}

fn undriven(device: &Device) -> impl Iterator<Item = Diagnostic> {
    let by_level = device.wiring.outputs.iter().filter_map(|output| match output.drives {
        Drives::Level { part, .. } => Some(part),
        _ => None,
    });
    let driven: BTreeSet<usize> =
        by_level.chain(device.wiring.commands.iter().map(|command| command.part)).collect();
    let driveable = device.parts().filter(|(number, _, schema)| {
        let acts = !schema.levels.is_empty() || !schema.actions.is_empty();
        let is_meant = ACT_ALONE.contains(&schema.name) || device.sets(*number, STANDS_OUT);
        acts && !is_meant
    });
    let idle = driveable.filter(move |(number, _, _)| !driven.contains(number));
    idle.filter_map(|(number, name, schema)| {
        let levels = schema.levels.iter().map(|level| level.name);
        let all: Vec<&str> = levels.chain(schema.actions.iter().map(|action| action.name)).collect();
        let message = format!("nothing drives the {} `{name}`", schema.name);
        let help = match schema.levels.first() {
            Some(level) => {
                let ty = type_text(level.ty, Extent::One);
                format!("such as `out {0}: {ty} = {name}.{0};`", level.name)
            }
            None => format!("such as `command 1 {0}(...) = {name}.{0}(...);`", all[0]),
        };
        let diagnostic = Diagnostic::new("W0110", device.place_of(number)?, message)
            .note(format!("it stays as it is at power-up; it can be driven by: {}", all.join(", ")));
        Some(diagnostic.help(format!("add an output or a command to the device, {help} or remove the part")))
    })
}
