//! The ports that every device with commands has.

use super::Port;
use crate::spec::ast::Command;
use runtime_sim::device::{Direction, Extent, LAST_COMMAND, PortType, Stop};
use runtime_sim::wiring::{Drives, Source};

const NUMBER: PortType = PortType::Int { lo: 0, hi: LAST_COMMAND };

pub fn inputs() -> Vec<(Port, Source)> {
    let input = |name: &str, ty, meaning: &str, source| {
        (port(name, Direction::Input, ty, meaning, Stop::Hold), source)
    };
    vec![
        input("ready", PortType::Bool, "the device is powered and enabled", Source::Ready),
        input("got", NUMBER, "number of the last command accepted", Source::Got),
        input("ack", NUMBER, "number of the last command ended, successfully or in error", Source::Ack),
        input(
            "error",
            PortType::Int { lo: 0, hi: 255 },
            "0, or the error of the command `ack`: 1 unreachable, 2 no part, 3 refused, others as the drive says; changes only with `ack`",
            Source::Error,
        ),
    ]
}

pub fn outputs(commands: &[Command]) -> Vec<(Port, Drives)> {
    let verb = format!("kind of the command `cmd`: {}", numbered(commands));
    let output = |name: &str, ty, meaning: &str, stop, drives| {
        (port(name, Direction::Output, ty, meaning, stop), drives)
    };
    vec![
        output(
            "cmd",
            NUMBER,
            "number of the last command; written in the same scan as its arguments",
            Stop::Hold,
            Drives::Command,
        ),
        output("verb", PortType::Int { lo: 0, hi: 9 }, &verb, Stop::Hold, Drives::Verb),
        output(
            "hold",
            PortType::Bool,
            "halt on the path, keep the command; true while the system does not run",
            Stop::Value(1.0),
            Drives::Hold,
        ),
    ]
}

/// Commands with their numbers, as `1 move, 2 pick`.
pub fn numbered(commands: &[Command]) -> String {
    let each = commands.iter().map(|command| format!("{} {}", command.number.value, command.name.value));
    each.collect::<Vec<_>>().join(", ")
}

/// Of all of them.
pub fn names() -> Vec<String> {
    let inputs = inputs().into_iter().map(|(port, _)| port.name);
    inputs.chain(outputs(&[]).into_iter().map(|(port, _)| port.name)).collect()
}

fn port(name: &str, direction: Direction, ty: PortType, meaning: &str, stop: Stop) -> Port {
    Port {
        name: name.into(),
        place: None,
        direction,
        ty,
        extent: Extent::One,
        unit: String::new(),
        meaning: meaning.into(),
        stop,
    }
}
