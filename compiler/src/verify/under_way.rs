//! Places that conditions read while their machine moves: they are searched at a few places of the motion alone.

use super::Asked;
use super::properties::{read_by, searched};
use crate::ir::{Asking, ExprKind, Place, System};
use crate::reads::Reads;
use runtime_sim::device::Direction;
use runtime_sim::line::Line;
use runtime_sim::wiring::Source;

/// Ports that show them and that guards or searched properties read, such as `tool of gantry`.
pub fn places(system: &System, line: &Line, asked: &Asked) -> Vec<String> {
    let mut found = Vec::new();
    for (number, machine) in line.machines.iter().enumerate() {
        let automaton = system.automaton_of(number);
        let ports = automaton.device.ports.iter().enumerate();
        let inputs = ports.filter(|(_, port)| port.direction == Direction::Input).zip(&machine.wiring.inputs);
        for ((port, named), input) in inputs {
            let Source::Signal { part, signal } = input.source else { continue };
            let schema = machine.parts[part].schema();
            if !matches!(
                (schema.name, schema.signals[signal].name),
                ("chain", "tool") | ("route", "position")
            ) {
                continue;
            }
            let asks = Asking::new(
                automaton,
                |kind| matches!(kind, ExprKind::Read(Place::Port { port: of, .. }) if *of == port),
            );
            let mut guards = automaton.states.iter().map(|state| Reads::of_guards(automaton, state));
            let mut properties = searched(automaton, asked).flat_map(read_by);
            if guards.any(|reads| reads.inputs.contains(&port))
                || properties.any(|expr| asks.expression(expr))
            {
                found.push(format!("{} of {}", named.name, machine.name));
            }
        }
    }
    found
}
