//! The words of a run by name: ports, cells and variables of each machine, and inputs and outputs of the line.

use super::numbers::{List, list};
use crate::ir::{Element, Group, Named, Scalar, System};
use runtime_sim::history::Word;
use runtime_sim::io_trace::Source;
use runtime_sim::line::Line;
use serde_json::{Value, json};

/// A word that a run is watched for.
#[derive(Clone, Debug)]
pub struct Signal {
    /// Such as `agv1.at_stop`.
    pub name: String,
    /// None: of the line.
    pub machine: Option<usize>,
    /// None: of the line.
    pub group: Option<Group>,
    pub form: Form,
    pub source: Source,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    Truth,
    Whole,
    Real,
    /// What its numbers mean.
    Names(Vec<String>),
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
        .map(|(name, form, source)| Signal { name: name.into(), machine: None, group: None, form, source })
        .collect();
    for (machine, begin) in (0..system.instances.len()).zip(system.traces()) {
        let values = system.values_of(machine, begin);
        for group in [Group::Input, Group::Output, Group::Local, Group::Cell] {
            values
                .iter()
                .filter(|value| value.group == group)
                .for_each(|v| put(system, machine, v, &mut signals));
        }
    }
    signals
}

/// A signal for each word of a value.
fn put(system: &System, machine: usize, value: &Named, signals: &mut Vec<Signal>) {
    let form = form(system, value);
    let axes: &[&str] = if value.ty == Scalar::Point { &[".x", ".y", ".z"] } else { &[""] };
    for (axis, word) in axes.iter().zip(0..) {
        let name = format!("{}.{}{axis}", system.instances[machine].name, value.name);
        let source = match (value.group, value.image, value.trace) {
            (Group::Input, Some(image), _) => Source::Input { machine, word: image + word },
            (Group::Output, Some(image), _) => Source::Output { machine, word: image + word },
            (_, _, trace) => Source::Trace(trace.unwrap_or(0) + word),
        };
        signals.push(Signal {
            name,
            machine: Some(machine),
            group: Some(value.group),
            form: form.clone(),
            source,
        });
    }
}

fn form(system: &System, value: &Named) -> Form {
    match value.ty {
        Scalar::Bool => Form::Truth,
        Scalar::Int { .. } | Scalar::Time => meaning(system, value.element),
        Scalar::Real | Scalar::Point => Form::Real,
        Scalar::Enum(id) => Form::Names(system.model.enums[id.0].members.clone()),
        Scalar::Ref(interface) => {
            let members = system.members[interface.0].iter();
            Form::Names(members.map(|&member| system.instances[member].name.clone()).collect())
        }
    }
}

/// Of the port of commands what its numbers ask for.
fn meaning(system: &System, element: Element) -> Form {
    let Element::Port { robot, port, .. } = element else { return Form::Whole };
    let device = &system.automaton_of(robot).device;
    if device.ports[port].name != "verb" || !device.is_commanded() {
        return Form::Whole;
    }
    let last = device.verbs.iter().map(|verb| verb.number).max().unwrap_or(0);
    let name = |number: i32| {
        let verb = device.verbs.iter().find(|verb| verb.number == number);
        verb.map_or(String::new(), |verb| verb.name.clone())
    };
    Form::Names((0..=last.clamp(0, MOST_NAMES)).map(name).collect())
}

/// Numbers of commands that are named.
const MOST_NAMES: i32 = 1000;

fn group_name(group: Option<Group>) -> &'static str {
    match group {
        None => "line",
        Some(Group::Input) => "input",
        Some(Group::Output) => "output",
        Some(Group::Cell) => "cell",
        Some(Group::Local) => "local",
    }
}

/// Names and what they stand for; forms that come again are written once. A signal that changes while something moves
/// has a 1 at the end of its row.
pub fn signals_json(line: &Line, signals: &[Signal]) -> Value {
    let analogue: Vec<Vec<bool>> =
        line.machines.iter().map(|machine| machine.analogue_inputs(line.kinds.len())).collect();
    let changes_between = |source: Source| match source {
        Source::Input { machine, word } => analogue[machine].get(word) == Some(&true),
        _ => false,
    };
    let mut forms: Vec<&Form> = Vec::new();
    let mut rows = Vec::new();
    for signal in signals {
        let form = forms.iter().position(|known| **known == signal.form).unwrap_or_else(|| {
            forms.push(&signal.form);
            forms.len() - 1
        });
        let machine = signal.machine.map_or(-1, |machine| machine as i64);
        let mut row = vec![json!(signal.name), json!(machine), json!(group_name(signal.group)), json!(form)];
        row.extend(changes_between(signal.source).then(|| json!(1)));
        rows.push(row);
    }
    let forms = forms.into_iter().map(|form| match form {
        Form::Truth => json!("truth"),
        Form::Whole => json!("whole"),
        Form::Real => json!("real"),
        Form::Names(names) => json!(names),
    });
    json!({ "forms": forms.collect::<Vec<_>>(), "rows": rows })
}

/// Of each word the scans since its change before, and its values: those of the line all, those of machines before this
/// scan, and of those that are not kept nothing.
pub fn changes_json(signals: &[Signal], words: &[Word], is_kept: fn(&Signal) -> bool, until: u64) -> String {
    list(words.iter().zip(signals).map(|(word, signal)| {
        let mut changes = List::default();
        if !is_kept(signal) {
            return changes.end();
        }
        let mut last = 0;
        let is_within = |(scan, _): &&(u64, f64)| signal.machine.is_none() || *scan < until;
        for (scan, value) in word.changes.iter().take_while(is_within) {
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
