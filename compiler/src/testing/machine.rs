//! One machine alone against a table: the test plays its device, and the other machines.

use super::bench::Bench;
use super::value;
use super::{Expected, Failure, Given, Path, Row, Time};
use crate::diagnostic::Diagnostic;
use crate::executor::Executor;
use crate::ir::{Element, Group, Named, Rule, System, Value};
use crate::source::Span;
use runtime_sim::scan::Controllers;

/// What runs the controllers.
pub enum Engine<'e, 'a> {
    /// Only this machine steps; what it shares with others is written by the test.
    Executor(&'e mut Executor<'a>),
    /// All machines step: a test of one machine has to be one that [`super::is_for_any_engine`].
    Other(&'e mut dyn Controllers),
}

impl Engine<'_, '_> {
    pub fn controllers(&mut self) -> &mut dyn Controllers {
        match self {
            Engine::Executor(executor) => *executor,
            Engine::Other(controllers) => *controllers,
        }
    }
}

/// What came of a test.
#[derive(Debug)]
pub enum Played {
    Passed,
    Failed(Failure),
    /// Another machine has stopped the line by a fault.
    Stopped,
    /// The test itself is wrong.
    Wrong(Vec<Diagnostic>),
}

/// A value that the test writes.
pub(super) struct Poke {
    pub named: Named,
    pub value: Value,
}

/// Rows with names and values found.
pub(super) struct Step {
    pub span: Span,
    pub time: Time,
    pub given: Vec<Poke>,
    pub answer: Option<i32>,
    pub loses_power: bool,
    pub expected: Vec<Wanted>,
}

pub(super) enum Wanted {
    State(usize),
    Value(String, Named, Value),
    Fault(Option<String>),
    Alarm(Option<String>),
    NoAlarm,
}

/// Runs the rows in order, up to the first that fails.
pub fn play(system: &System, machine: usize, rows: &[Row], engine: Engine) -> Played {
    let mut found = Vec::new();
    let steps: Vec<Step> = rows.iter().map(|row| step(system, machine, row, &mut found)).collect();
    let targets = targets(system, rows, &mut found);
    if !found.is_empty() {
        return Played::Wrong(found);
    }
    let mut bench = Bench::new(system, machine, engine);
    bench.scan(false);
    for (step, target) in steps.iter().zip(targets) {
        if let Err(played) = bench.row(step, target) {
            return played;
        }
    }
    Played::Passed
}

/// When a row is due, in scans: at one, or within so many after the row before.
#[derive(Clone, Copy)]
pub(super) enum Target {
    At(u64),
    After(u64),
    Within(u64),
}

fn targets(system: &System, rows: &[Row], found: &mut Vec<Diagnostic>) -> Vec<Target> {
    let scan_ms = i64::from(system.scan_ms);
    // The latest scan so far; none after a row whose time is found by the run.
    let mut latest: Option<i64> = Some(-1);
    let mut targets = Vec::new();
    for row in rows {
        let ms = match row.time {
            Time::At(ms) | Time::After(ms) | Time::Within(ms) => ms,
            Time::Scan(scan) => scan.saturating_mul(scan_ms),
        };
        if ms % scan_ms != 0 {
            let help = format!("the line is scanned every {scan_ms} ms: write a multiple of it");
            found.push(Diagnostic::new("E0903", row.span, "there is no scan at this time").help(help));
        }
        let scans = ms / scan_ms;
        let (target, now) = match row.time {
            Time::At(_) | Time::Scan(_) => (Target::At(scans as u64), Some(scans)),
            Time::After(_) => (Target::After(scans as u64), latest.map(|latest| latest + scans)),
            Time::Within(_) => (Target::Within(scans as u64), None),
        };
        let goes_on = match row.time {
            Time::At(_) | Time::Scan(_) => latest.is_none_or(|latest| scans > latest),
            Time::After(_) | Time::Within(_) => scans > 0,
        };
        if !goes_on {
            let help = "each row is later than the one before: correct the time, or join the two rows";
            found.push(
                Diagnostic::new("E0903", row.span, "this row is not later than the one before").help(help),
            );
        }
        latest = now;
        targets.push(target);
    }
    targets
}

fn step(system: &System, machine: usize, row: &Row, found: &mut Vec<Diagnostic>) -> Step {
    let loses_power = row.given.iter().any(|given| matches!(given, Given::PowerOff));
    let (span, time) = (row.span, row.time);
    let mut step = Step { span, time, given: vec![], answer: None, loses_power, expected: vec![] };
    for given in &row.given {
        match given {
            Given::PowerOff => {}
            Given::Answer(span, error) => {
                if !system.automaton_of(machine).device.is_commanded() {
                    let message = "this machine has no commands, so it has none to answer";
                    found.push(Diagnostic::new("E0902", *span, message).help("give values of its ports"));
                }
                step.answer = Some(*error);
            }
            Given::Value(path, literal) => match giving(system, machine, path) {
                Ok(named) => match value::literal(system, named.ty, literal) {
                    Ok(value) => step.given.push(Poke { named, value }),
                    Err(wrong) => found.push(*wrong),
                },
                Err(wrong) => found.push(*wrong),
            },
        }
    }
    for expected in &row.expected {
        match expected {
            Expected::State(name) => match value::state(system, machine, &name.value, name.span) {
                Ok(state) => step.expected.push(Wanted::State(state)),
                Err(wrong) => found.push(*wrong),
            },
            Expected::Fault(_, text) => step.expected.push(Wanted::Fault(text.clone())),
            Expected::Alarm(text) => step.expected.push(Wanted::Alarm(text.clone())),
            Expected::NoAlarm => step.expected.push(Wanted::NoAlarm),
            Expected::Value(path, literal) => match value::named(system, machine, path) {
                Ok(named) => match value::literal(system, named.ty, literal) {
                    Ok(value) => step.expected.push(Wanted::Value(shown_path(path), named, value)),
                    Err(wrong) => found.push(*wrong),
                },
                Err(wrong) => found.push(*wrong),
            },
        }
    }
    step
}

/// What a test may write: inputs of the device, and shared cells as others do.
fn giving(system: &System, machine: usize, path: &Path) -> Result<Named, Box<Diagnostic>> {
    let named = value::named(system, machine, path)?;
    match named.group {
        Group::Input | Group::Cell if !is_its_own(system, machine, named.element) => Ok(named),
        _ => {
            let message = format!("the automaton itself writes `{}`", path.name);
            Err(Diagnostic::new("E0902", path.span, message)
                .help("set inputs of the device, and shared cells that others write; expect this value after `->`")
                .into())
        }
    }
}

/// Whether it is a cell of this machine that nobody else writes.
fn is_its_own(system: &System, machine: usize, element: Element) -> bool {
    let Element::Cell { interface, cell, .. } = element else { return false };
    let rule = &system.model.interface(interface).cells[cell].rule;
    matches!(rule, Rule::Owner) && system.owner(element) == machine
}

fn shown_path(path: &Path) -> String {
    let machine = path.machine.as_ref().map_or(String::new(), |machine| format!("{machine}."));
    let index = path.index.as_ref().map_or(String::new(), |index| match &index.kind {
        super::LiteralKind::Word(word) => format!("[{word}]"),
        super::LiteralKind::Number(number) => format!("[{number}]"),
        _ => String::new(),
    });
    format!("{machine}{}{index}", path.name)
}
