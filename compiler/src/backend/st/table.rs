//! Tables as comma-separated values.

use super::block::NO_SUCH_STATE;
use super::context::Shared;
use super::declaration::{Basic, constants};
use super::globals::stop_value;
use super::print::Dialect;
use crate::ir::{FaultKind, Scalar};
use crate::naming::st::Renamed;
use runtime_sim::device::{Direction, Extent, Port};

/// A line of fields, in quotes where they need them.
pub fn row(fields: &[&str]) -> String {
    let field = |text: &&str| match text.contains([',', '"', '\n', ';']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_string(),
    };
    fields.iter().map(field).collect::<Vec<_>>().join(",") + "\n"
}

/// The names that could not stay as the specification has them.
pub fn renamed(names: &[(String, Renamed)]) -> String {
    let mut text = row(&["unit", "wanted", "name", "reason"]);
    for (unit, renamed) in names {
        text += &row(&[unit, &renamed.wanted, &renamed.name, renamed.reason]);
    }
    text
}

const IO: [&str; 12] = [
    "robot",
    "name",
    "direction",
    "type",
    "unit",
    "stop value",
    "meaning",
    "address",
    "raw type",
    "scale",
    "offset",
    "invert",
];

/// Every point of I/O by the name of its variable; the columns behind the meaning are for the user to fill.
pub fn io(shared: Shared) -> String {
    let mut text = row(&IO);
    let mut point = |robot: &str, name: &str, direction: &str, ty: &str, [unit, stop, meaning]: [&str; 3]| {
        text += &row(&[robot, name, direction, ty, unit, stop, meaning, "", "", "", "", ""]);
    };
    let system = [
        ("run_permit", "input", "BOOL", "false when the emergency stop has acted or the fieldbus is lost"),
        ("start", "input", "BOOL", "its rising edge starts the line"),
        ("reset", "input", "BOOL", "its rising edge clears a fault"),
        ("running", "output", "BOOL", "the robots step"),
        ("fault", "output", "BOOL", "a fault is latched"),
        ("fault_code", "output", "DINT", "see alarms.csv; 0 without a fault"),
        ("fault_robot", "output", "DINT", "number of the robot; -1 without a fault"),
    ];
    for (name, direction, ty, meaning) in system {
        point("", name, direction, ty, ["", "", meaning]);
    }
    for (robot, (instance, names)) in shared.system.instances.iter().zip(&shared.names.robots).enumerate() {
        for (port, held) in shared.system.automaton_of(robot).device.ports.iter().zip(&names.ports) {
            let direction = if port.direction == Direction::Input { "input" } else { "output" };
            let ty = Basic::of(Scalar::from(port.ty)).name();
            for element in 0..port.extent.elements(shared.system.kinds()) {
                for (part, name) in held.iter().enumerate() {
                    let name =
                        if port.extent == Extent::One { name.clone() } else { format!("{name}[{element}]") };
                    let stop = stop_text(port, part);
                    point(&instance.name, &name, direction, ty, [port.unit, &stop, port.meaning]);
                }
            }
        }
    }
    text
}

fn stop_text(port: &Port, part: usize) -> String {
    match (port.direction, stop_value(port)) {
        (Direction::Input, _) => String::new(),
        (Direction::Output, None) => "hold".into(),
        (Direction::Output, Some(value)) => Dialect::Portable.expression(&constants(value)[part]),
    }
}

/// The codes that are published with a fault.
pub fn alarms(shared: Shared) -> String {
    let mut text = row(&["code", "type", "robots", "text", "mend"]);
    for (i, site) in shared.system.model.faults.iter().enumerate() {
        let robots: Vec<String> = (shared.instances(site.automaton).iter())
            .map(|r| format!("{r} {}", shared.system.instances[*r].name))
            .collect();
        if robots.is_empty() {
            continue;
        }
        let mend = match site.kind {
            FaultKind::OutOfBounds => {
                "The number was limited to its bounds. Look at the state of the robot and at what it counts; then reset and start."
            }
            FaultKind::NotFinite => {
                "The old value was kept. Look at the inputs and parameters from which it is computed; then reset and start."
            }
            FaultKind::InvariantFails => {
                "Look at the values that it names; set them right before reset, or the fault returns."
            }
            FaultKind::TooLong => {
                "Look for what the state waits for: the answer of the device, or another robot; then reset and start."
            }
        };
        let about = format!("{} ({})", site.text, shared.line(site.place));
        let automaton = &shared.system.model.automaton(site.automaton).name;
        text += &row(&[&(i + 1).to_string(), automaton, &robots.join(" "), &about, mend]);
    }
    let mend = "The memory of the controller is damaged: switch the power off and on.";
    text + &row(&[&NO_SUCH_STATE.to_string(), "", "", "the state has a number that does not exist", mend])
}
