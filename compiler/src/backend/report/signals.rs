//! The words of a run by name: ports, cells and variables of each machine, and inputs and outputs of the line.

use super::numbers::{List, list};
use crate::device::Port;
use crate::ir::{Extent, Scalar, System, Type};
use runtime_sim::device::{self, Direction, PortType};
use runtime_sim::history::Word;
use runtime_sim::io_trace::Source;
use serde_json::{Value, json};

/// A word that a run is watched for.
#[derive(Clone, Debug)]
pub struct Signal {
    /// Such as `agv1.at_stop`.
    pub name: String,
    /// None: of the line.
    pub machine: Option<usize>,
    pub group: Group,
    pub form: Form,
    pub source: Source,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    Line,
    Input,
    Output,
    /// A shared variable that belongs to the machine.
    Cell,
    /// A variable of its automaton.
    Local,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    Truth,
    Whole,
    Real,
    /// What its numbers mean.
    Names(Vec<String>),
}

impl Group {
    fn name(self) -> &'static str {
        match self {
            Group::Line => "line",
            Group::Input => "input",
            Group::Output => "output",
            Group::Cell => "cell",
            Group::Local => "local",
        }
    }
}

/// All of a line, machine by machine.
pub fn signals(system: &System) -> Vec<Signal> {
    let line = [
        ("run_permit", Form::Truth, Source::RunPermit),
        ("start", Form::Truth, Source::Start),
        ("reset", Form::Truth, Source::Reset),
        ("running", Form::Truth, Source::Running),
        ("fault", Form::Truth, Source::Fault),
        ("fault_code", Form::Whole, Source::FaultCode),
    ];
    let mut signals: Vec<Signal> = line
        .into_iter()
        .map(|(name, form, source)| Signal {
            name: name.into(),
            machine: None,
            group: Group::Line,
            form,
            source,
        })
        .collect();
    let mut at = 0;
    for machine in 0..system.instances.len() {
        let mut of = OfMachine { system, machine, at, signals: Vec::new() };
        of.ports(Direction::Input);
        of.ports(Direction::Output);
        of.remembered();
        at = of.at;
        signals.append(&mut of.signals);
    }
    signals
}

struct OfMachine<'a> {
    system: &'a System,
    machine: usize,
    /// The next word of the trace.
    at: usize,
    signals: Vec<Signal>,
}

impl OfMachine<'_> {
    fn put(&mut self, name: &str, group: Group, form: Form, source: Source) {
        let name = format!("{}.{name}", self.system.instances[self.machine].name);
        self.signals.push(Signal { name, machine: Some(self.machine), group, form, source });
    }

    fn ports(&mut self, direction: Direction) {
        let system = self.system;
        let (machine, mut word) = (self.machine, 0);
        let of_direction = |port: &&Port| port.direction == direction;
        for port in system.automaton_of(machine).device.ports.iter().filter(of_direction) {
            let form = match port.ty {
                PortType::Bool => Form::Truth,
                PortType::Int { .. } => self.meaning(port),
                PortType::Real | PortType::Point => Form::Real,
            };
            for name in self.elements(&port.name, port.extent.into(), port.ty == PortType::Point) {
                let (group, source) = match direction {
                    Direction::Input => (Group::Input, Source::Input { machine, word }),
                    Direction::Output => (Group::Output, Source::Output { machine, word }),
                };
                self.put(&name, group, form.clone(), source);
                word += 1;
            }
        }
    }

    /// Of the port of commands what its numbers ask for.
    fn meaning(&self, port: &Port) -> Form {
        let device = &self.system.automaton_of(self.machine).device;
        if port.name != "verb" || !device.is_commanded() {
            return Form::Whole;
        }
        let last = device.verbs.iter().map(|verb| verb.number).max().unwrap_or(0);
        let name = |number: i32| {
            let verb = device.verbs.iter().find(|verb| verb.number == number);
            verb.map_or(String::new(), |verb| verb.name.clone())
        };
        Form::Names((0..=last.clamp(0, MOST_NAMES)).map(name).collect())
    }

    /// What the trace has of this machine: state, time in it, locals, cells, outputs.
    fn remembered(&mut self) {
        let system = self.system;
        self.at += 2;
        let automaton = system.automaton_of(self.machine);
        for local in &automaton.locals {
            self.variable(&local.name, local.ty, Group::Local);
        }
        for implemented in &automaton.implements {
            for cell in &system.model.interface(implemented.interface).cells {
                self.variable(&cell.name, cell.ty, Group::Cell);
            }
        }
        self.at += automaton.device.words(device::Direction::Output, system.kinds());
    }

    fn variable(&mut self, name: &str, ty: Type, group: Group) {
        let form = self.form(ty.scalar);
        for name in self.elements(name, ty.extent, ty.scalar == Scalar::Point) {
            self.put(&name, group, form.clone(), Source::Trace(self.at));
            self.at += 1;
        }
    }

    fn form(&self, scalar: Scalar) -> Form {
        let model = &self.system.model;
        match scalar {
            Scalar::Bool => Form::Truth,
            Scalar::Int { .. } | Scalar::Time => Form::Whole,
            Scalar::Real | Scalar::Point => Form::Real,
            Scalar::Enum(id) => Form::Names(model.enums[id.0].members.clone()),
            Scalar::Ref(interface) => {
                let members = self.system.members[interface.0].iter();
                Form::Names(members.map(|&member| self.system.instances[member].name.clone()).collect())
            }
        }
    }

    /// Names of the words of a variable.
    fn elements(&self, name: &str, extent: Extent, is_point: bool) -> Vec<String> {
        let model = &self.system.model;
        let elements: Vec<String> = match extent {
            Extent::One => vec![name.into()],
            Extent::Count(n) => (0..n).map(|i| format!("{name}[{i}]")).collect(),
            Extent::By(id) => {
                model.enums[id.0].members.iter().map(|member| format!("{name}[{member}]")).collect()
            }
        };
        match is_point {
            false => elements,
            true => elements.iter().flat_map(|e| ["x", "y", "z"].map(|axis| format!("{e}.{axis}"))).collect(),
        }
    }
}

/// Numbers of commands that are named.
const MOST_NAMES: i32 = 1000;

/// Names and what they stand for; forms that come again are written once.
pub fn signals_json(signals: &[Signal]) -> Value {
    let mut forms: Vec<&Form> = Vec::new();
    let mut rows = Vec::new();
    for signal in signals {
        let form = forms.iter().position(|known| **known == signal.form).unwrap_or_else(|| {
            forms.push(&signal.form);
            forms.len() - 1
        });
        let machine = signal.machine.map_or(-1, |machine| machine as i64);
        rows.push(json!([signal.name, machine, signal.group.name(), form]));
    }
    let forms = forms.into_iter().map(|form| match form {
        Form::Truth => json!("truth"),
        Form::Whole => json!("whole"),
        Form::Real => json!("real"),
        Form::Names(names) => json!(names),
    });
    json!({ "forms": forms.collect::<Vec<_>>(), "rows": rows })
}

/// Of each word the scans since its change before, and its values; of those that are not kept nothing.
pub fn changes_json(signals: &[Signal], words: &[Word], is_kept: fn(&Signal) -> bool) -> String {
    list(words.iter().zip(signals).map(|(word, signal)| {
        let mut changes = List::default();
        if !is_kept(signal) {
            return changes.end();
        }
        let mut last = 0;
        for (scan, value) in &word.changes {
            changes.put_whole(scan - last).put_whole(short(*value));
            last = *scan;
        }
        changes.end()
    }))
}

/// Rounded to a ten-thousandth, as it is shown.
fn short(value: f64) -> f64 {
    let rounded = (value * 1e4).round() / 1e4;
    if rounded.is_finite() { rounded + 0.0 } else { 0.0 }
}
