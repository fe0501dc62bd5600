//! Devices: what a type of machine consists of, and what it offers its controller.
//!
//! A port is what a sensor or a drive of a real plant supplies; none carries what only
//! a simulator could know.

mod check;
mod evaluate;
mod head;
mod operation;
pub mod panel;
mod placed;
mod program;
mod settle;
mod stop;
mod wires;

pub use check::{Declared, check};
pub use evaluate::Heights;
pub use placed::{Place, Placed};

use crate::source::Span;
use program::Program;
use runtime_sim::device::{Direction, Extent, PortType, Stop};
use runtime_sim::part::{Operated, Schema};
use runtime_sim::value::Value;
use runtime_sim::wiring::{Input, Source, Wiring};
use std::sync::Arc;

/// A device that has passed every check; only [`check`] makes one.
#[derive(Debug)]
pub struct Device {
    pub name: String,
    pub purpose: String,
    /// Where it is declared.
    pub place: Span,
    pub parameters: Vec<Parameter>,
    pub ports: Vec<Port>,
    /// Empty for a device that obeys no commands.
    pub verbs: Vec<Verb>,
    pub constants: Vec<Constant>,
    pub handovers: Vec<Handover>,
    pub wiring: Arc<Wiring>,
    program: Program,
    /// Its parts turn with the machine.
    pub can_turn: bool,
}

/// What a layout gives each machine: a key of its JSON object.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    pub name: String,
    pub meaning: String,
    pub form: Form,
    /// For machines whose object has no such key.
    pub default: Option<Value>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    Axis,
    /// Two coordinates or lengths, the lower one first.
    Range,
    /// A coordinate or length, m.
    Real,
    /// Seconds in the layout, whole milliseconds in the device.
    Time,
    Point,
    /// So many points, with what each of them is.
    Points(Vec<String>),
    /// Nodes and edges of the layout, by their name there.
    Routes,
    /// A node of the machine's routes: its name in the layout, its number in the device.
    Node,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Port {
    pub name: String,
    /// Where it is declared; none of one that every device with commands has.
    pub place: Option<Span>,
    pub direction: Direction,
    pub ty: PortType,
    pub extent: Extent,
    pub unit: String,
    /// What the port carries, and when it changes.
    pub meaning: String,
    /// For outputs: what is published while the system does not run.
    pub stop: Stop,
}

impl Port {
    /// What it carries, and its unit behind `joint`; empty if neither is given.
    pub fn about(&self, joint: &str) -> String {
        match (self.meaning.as_str(), self.unit.as_str()) {
            (meaning, "") => meaning.into(),
            ("", unit) => unit.into(),
            (meaning, unit) => format!("{meaning}{joint}{unit}"),
        }
    }
}

/// A command: the output `verb` is set to `number`, the arguments to the named output ports.
#[derive(Clone, Debug, PartialEq)]
pub struct Verb {
    pub name: String,
    pub number: i32,
    pub arguments: Vec<String>,
    pub meaning: String,
}

/// A value that the layout fixes for a machine, readable in its automaton by name.
#[derive(Clone, Debug, PartialEq)]
pub struct Constant {
    pub name: String,
    pub ty: PortType,
    pub extent: Extent,
    pub unit: String,
    pub meaning: String,
}

/// A place named after `accepts at` or `offers at`.
#[derive(Clone, Debug, PartialEq)]
pub struct Handover {
    pub name: String,
    /// Number of places, if one of several is meant by an index.
    pub indexed: Option<usize>,
}

impl Parameter {
    /// Whether its value has numbers of the machine's own object.
    fn has_numbers(&self) -> bool {
        !matches!(self.form, Form::Routes | Form::Node)
    }
}

impl Constant {
    /// Whether a value has the type, whatever its bounds and the number of kinds.
    fn takes(&self, value: &Value) -> bool {
        let is_scalar = |value: &Value| {
            matches!(
                (self.ty, value),
                (PortType::Bool, Value::Truth(_))
                    | (PortType::Int { .. } | PortType::Real, Value::Number(_))
                    | (PortType::Point, Value::Point(_))
            )
        };
        match (self.extent, value) {
            (Extent::One, value) => is_scalar(value),
            (Extent::Times(n), Value::List(values)) => values.len() == n && values.iter().all(is_scalar),
            (Extent::PerKind, Value::List(values)) => !values.is_empty() && values.iter().all(is_scalar),
            _ => false,
        }
    }

    /// Why a value cannot be that of a machine in a line with so many kinds.
    fn refuses(&self, value: &Value, kinds: usize) -> Option<&'static str> {
        let elements = match value {
            Value::List(values) => values.as_slice(),
            one => std::slice::from_ref(one),
        };
        let is_within = |element: &Value| match (self.ty, element) {
            (PortType::Int { lo, hi }, Value::Number(n)) => {
                n.fract() == 0.0 && (f64::from(lo)..=f64::from(hi)).contains(n)
            }
            _ => true,
        };
        if !self.takes(value) {
            Some("has another type than its value")
        } else if elements.len() < self.extent.elements(kinds) {
            Some("has fewer elements than there are kinds")
        } else if !elements.iter().all(is_within) {
            Some("is not a whole number within its bounds")
        } else {
            None
        }
    }
}

/// A type as specifications write it, such as `int 0..12[Kind]`.
pub fn type_text(ty: PortType, extent: Extent) -> String {
    let scalar = match ty {
        PortType::Bool => "bool".to_string(),
        PortType::Int { lo, hi } => format!("int {lo}..{hi}"),
        PortType::Real => "real".into(),
        PortType::Point => "point".into(),
    };
    match extent {
        Extent::One => scalar,
        Extent::PerKind => format!("{scalar}[Kind]"),
        Extent::Times(n) => format!("{scalar}[{n}]"),
    }
}

impl Port {
    /// Numbers that this port takes in a process image.
    pub fn words(&self, kinds: usize) -> usize {
        self.ty.words() * self.extent.elements(kinds)
    }
}

impl Device {
    pub fn port(&self, name: &str) -> Option<&Port> {
        self.ports.iter().find(|p| p.name == name)
    }

    pub fn is_commanded(&self) -> bool {
        !self.verbs.is_empty()
    }

    /// It takes items and puts them elsewhere.
    pub fn is_arm(&self) -> bool {
        self.has("grip")
    }

    /// What a person operates: number and name of the part, and how.
    pub fn operated(&self) -> impl Iterator<Item = (usize, &str, Operated)> {
        let parts = self.program.parts.iter().enumerate();
        parts.filter_map(|(number, part)| Some((number, part.name.value.as_str(), part.schema.operated?)))
    }

    /// What a part that a person operates may be set to: the type of the inputs that read it, or of its signal if none
    /// does.
    pub fn type_of_operated(&self, number: usize) -> PortType {
        let inputs = self.ports.iter().filter(|port| port.direction == Direction::Input);
        let reads = |input: &Input| matches!(input.source, Source::Signal { part, .. } if part == number);
        let read_by = inputs.zip(&self.wiring.inputs).filter(|(_, input)| reads(input));
        let types = read_by.map(|(port, _)| port.ty);
        let narrower = |a, b| match (a, b) {
            (PortType::Int { lo, hi }, PortType::Int { lo: low, hi: high }) => {
                PortType::Int { lo: lo.max(low), hi: hi.min(high) }
            }
            _ => a,
        };
        types.reduce(narrower).unwrap_or(self.program.parts[number].schema.signals[0].ty)
    }

    /// Number, name and primitive of each of its parts.
    pub fn parts(&self) -> impl Iterator<Item = (usize, &str, &'static Schema)> {
        let parts = self.program.parts.iter().enumerate();
        parts.map(|(number, part)| (number, part.name.value.as_str(), part.schema))
    }

    /// Where a part is declared.
    pub fn place_of(&self, part: usize) -> Option<Span> {
        self.program.parts.get(part).map(|part| part.name.span)
    }

    /// Whether it gives a part this setting.
    pub fn sets(&self, part: usize, setting: &str) -> bool {
        let part = self.program.parts.get(part);
        part.is_some_and(|part| part.settings.iter().any(|given| given.name.value == setting))
    }

    /// Numbers and names of its parts of one primitive.
    pub fn parts_called(&self, primitive: &str) -> impl Iterator<Item = (usize, &str)> {
        let parts = self.program.parts.iter().enumerate();
        let wanted = parts.filter(move |(_, part)| part.schema.name == primitive);
        wanted.map(|(number, part)| (number, part.name.value.as_str()))
    }

    /// Names of the parts that can jam.
    pub fn jamming(&self) -> impl Iterator<Item = &str> {
        let jamming = self.program.parts.iter().filter(|part| part.schema.can_jam);
        jamming.map(|part| part.name.value.as_str())
    }

    /// Whether one of its parts is of this primitive.
    pub fn has(&self, primitive: &str) -> bool {
        self.program.parts.iter().any(|part| part.schema.name == primitive)
    }

    /// Numbers of all ports of one direction in a process image.
    pub fn words(&self, direction: Direction, kinds: usize) -> usize {
        self.ports.iter().filter(|p| p.direction == direction).map(|p| p.words(kinds)).sum()
    }

    /// The inputs, each with its first word in a process image.
    pub fn inputs(&self, kinds: usize) -> impl Iterator<Item = (usize, &Port)> {
        let inputs = self.ports.iter().filter(|port| port.direction == Direction::Input);
        inputs.scan(0, move |next, port| {
            let word = *next;
            *next += port.words(kinds);
            Some((word, port))
        })
    }

    /// Where a port begins among the ports of its own direction.
    pub fn offset(&self, name: &str, kinds: usize) -> Option<usize> {
        let port = self.port(name)?;
        let own = self.ports.iter().filter(|p| p.direction == port.direction);
        Some(own.take_while(|p| p.name != name).map(|p| p.words(kinds)).sum())
    }
}
