//! Every scalar of I/O, in the order of `io.csv`: what a person can give an address.

use super::code::{Ex, name};
use super::declaration::{Basic, constants};
use super::name::Name;
use super::names::{Names, RobotNames};
use super::print::Dialect;
use super::value::{NO_SUCH_STATE, first_value, stop_value};
use crate::device::Port;
use crate::io_map::{Kind, Point};
use crate::ir::{Instance, KIND, Scalar, System};
use runtime_sim::device::{Direction, Extent, PortType, Stop};

/// A point and its variable.
pub struct Terminal {
    pub point: Point,
    /// The global; of an array all elements.
    pub variable: Name,
    pub element: Option<usize>,
    /// What an output is at power-up.
    pub first: Option<Ex>,
    /// Whether only the device or only the last statements of the program write the variable, so that it may
    /// stand in the process image itself.
    pub is_own: bool,
}

impl Terminal {
    pub fn place(&self) -> Ex {
        match self.element {
            None => name(&self.variable),
            Some(i) => Ex::Element(self.variable.clone(), Box::new(Ex::Int(i as i32))),
        }
    }

    pub fn basic(&self) -> Basic {
        match self.point.kind {
            Kind::Bool => Basic::Bool,
            Kind::Int { .. } => Basic::Dint,
            Kind::Real => Basic::Lreal,
        }
    }
}

/// The terminals of the line, then those of each robot.
pub fn terminals(system: &System, names: &Names) -> impl Iterator<Item = Terminal> {
    let robots = system.instances.iter().zip(&names.robots).enumerate();
    let of_robot = |(robot, (instance, own)): (usize, (&Instance, &RobotNames))| {
        let mut terminals = Vec::new();
        for (port, held) in system.automaton_of(robot).device.ports.iter().zip(&own.ports) {
            for element in 0..port.extent.elements(system.kinds()) {
                for (part, variable) in held.iter().enumerate() {
                    let element = (port.extent != Extent::One).then_some(element);
                    let mut terminal = terminal(&instance.name, port, part, variable, element);
                    if port.extent == Extent::PerKind {
                        let kind = &system.model.enums[KIND.0].members[element.unwrap_or(0)];
                        terminal.point.meaning = match terminal.point.meaning.as_str() {
                            "" => kind.clone(),
                            meaning => format!("{kind}: {meaning}"),
                        };
                    }
                    terminals.push(terminal);
                }
            }
        }
        terminals
    };
    line(system).into_iter().chain(robots.flat_map(of_robot))
}

/// Inputs and outputs of the whole line.
fn line(system: &System) -> Vec<Terminal> {
    let (input, output) = (Direction::Input, Direction::Output);
    let codes = Kind::Int { lo: 0, hi: NO_SUCH_STATE.max(system.model.faults.len() as i32) };
    let robots = Kind::Int { lo: -1, hi: system.instances.len() as i32 - 1 };
    let truth = || Some(Ex::Bool(false));
    let own = [
        (
            "run_permit",
            input,
            Kind::Bool,
            None,
            "false when the emergency stop has acted or the fieldbus is lost",
        ),
        ("start", input, Kind::Bool, None, "its rising edge starts the line"),
        ("reset", input, Kind::Bool, None, "its rising edge clears a fault"),
        ("running", output, Kind::Bool, truth(), "the line runs"),
        ("fault", output, Kind::Bool, truth(), "a fault is latched"),
        ("fault_code", output, codes, Some(Ex::Int(0)), "see alarms.csv; 0 without a fault"),
        (
            "fault_robot",
            output,
            robots,
            Some(Ex::Int(-1)),
            "number of the robot in the order of the steps, the first is 0; -1 without a fault, or for one of no robot",
        ),
    ];
    let alarms = [
        ("alarm", output, Kind::Bool, truth(), "an alarm is active, or not acknowledged"),
        (
            "alarm_code",
            output,
            codes,
            Some(Ex::Int(0)),
            "first raised alarm that is not acknowledged: see alarms.csv; 0 without one",
        ),
        ("alarm_robot", output, robots, Some(Ex::Int(-1)), "number of its robot; -1 without one"),
    ];
    let alarms = alarms.into_iter().filter(|_| !system.alarms().is_empty());
    own.into_iter()
        .chain(alarms)
        .map(|(variable, direction, kind, first, meaning)| Terminal {
            point: Point {
                robot: String::new(),
                port: variable.into(),
                name: variable.into(),
                direction,
                kind,
                unit: String::new(),
                stop: String::new(),
                meaning: meaning.into(),
            },
            variable: variable.into(),
            element: None,
            first,
            is_own: direction == Direction::Input,
        })
        .collect()
}

fn terminal(robot: &str, port: &Port, part: usize, variable: &Name, element: Option<usize>) -> Terminal {
    let first = || constants(stop_value(port).unwrap_or(first_value(port.ty))).swap_remove(part);
    let kind = match port.ty {
        PortType::Bool => Kind::Bool,
        PortType::Int { lo, hi } => Kind::Int { lo, hi },
        PortType::Real | PortType::Point => Kind::Real,
    };
    debug_assert_eq!(Basic::of(Scalar::from(port.ty)).name(), kind.name());
    Terminal {
        point: Point {
            robot: robot.into(),
            port: port.name.clone(),
            name: element.map_or(variable.to_string(), |i| format!("{variable}[{i}]")),
            direction: port.direction,
            kind,
            unit: port.unit.clone(),
            stop: stop_text(port, part),
            meaning: port.meaning.clone(),
        },
        variable: variable.clone(),
        element,
        first: (port.direction == Direction::Output).then(first),
        is_own: true,
    }
}

fn stop_text(port: &Port, part: usize) -> String {
    match (port.direction, port.stop, stop_value(port)) {
        (Direction::Output, Stop::Hold, _) => "hold".into(),
        (Direction::Output, _, Some(value)) => Dialect::Portable.expression(&constants(value)[part]),
        _ => String::new(),
    }
}
