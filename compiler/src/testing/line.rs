//! A whole line: what has to come of its run.

use super::value;
use super::{Comparison, Expect, Failure, Figure, What};
use crate::diagnostic::Diagnostic;
use crate::fault::{reason_of_run, site};
use crate::ir::System;
use crate::source::{Sources, Spanned};
use runtime_sim::report::Report;
use runtime_sim::scan::{Controllers, SystemInputs, SystemOutputs};
use std::collections::BTreeMap;

/// Controllers, with the first time of each state.
pub struct Watched<'c> {
    controllers: &'c mut dyn Controllers,
    machines: usize,
    scan_ms: u64,
    next_scan: u64,
    states: Vec<Option<usize>>,
    /// By machine and state, ms.
    first: BTreeMap<(usize, usize), u64>,
    /// The last states of each machine, with their times.
    history: Vec<Vec<(u64, usize)>>,
}

/// States of a machine that a failure tells.
const MOST_STATES: usize = 8;

impl<'c> Watched<'c> {
    pub fn new(controllers: &'c mut dyn Controllers, system: &System) -> Self {
        let machines = system.instances.len();
        Self {
            controllers,
            machines,
            scan_ms: system.scan_ms as u64,
            next_scan: 0,
            states: vec![None; machines],
            first: BTreeMap::new(),
            history: vec![Vec::new(); machines],
        }
    }
}

impl Controllers for Watched<'_> {
    fn scan(&mut self, system: SystemInputs, inputs: &[Vec<f64>], outputs: &mut [Vec<f64>]) -> SystemOutputs {
        let scan = self.next_scan;
        self.next_scan += 1;
        let answer = self.controllers.scan(system, inputs, outputs);
        let ms = scan * self.scan_ms;
        for machine in 0..self.machines {
            let state = self.controllers.state(machine);
            if self.states[machine] != Some(state) {
                self.states[machine] = Some(state);
                self.first.entry((machine, state)).or_insert(ms);
                let history = &mut self.history[machine];
                history.push((ms, state));
                if history.len() > MOST_STATES {
                    history.remove(0);
                }
            }
        }
        answer
    }

    fn lose_power(&mut self, scans: u64) {
        self.next_scan += scans;
    }

    fn power_up(&mut self) {
        self.controllers.power_up();
    }

    fn state(&self, machine: usize) -> usize {
        self.controllers.state(machine)
    }

    fn trace(&self, out: &mut Vec<f64>) {
        self.controllers.trace(out);
    }

    fn stays(&self) -> Vec<usize> {
        self.controllers.stays()
    }

    fn skip(&mut self, scans: u64) {
        self.next_scan += scans;
        self.controllers.skip(scans);
    }
}

/// What a run lacks of what was expected of it; an error, if that is of no line.
pub fn judge(
    system: &System,
    sources: &Sources,
    report: &Report,
    watched: &Watched,
    expected: &[Expect],
) -> Result<Vec<Failure>, Vec<Diagnostic>> {
    // As `commission` prints it.
    let report = &Report { reason: reason_of_run(report, system, sources), ..report.clone() };
    let mut failures = Vec::new();
    let mut wrong = Vec::new();
    for expect in expected {
        match check(system, report, watched, expect) {
            Ok(failure) => failures.extend(failure),
            Err(diagnostic) => wrong.push(*diagnostic),
        }
    }
    if wrong.is_empty() { Ok(failures) } else { Err(wrong) }
}

fn check(
    system: &System,
    report: &Report,
    watched: &Watched,
    expect: &Expect,
) -> Result<Option<Failure>, Box<Diagnostic>> {
    let place = expect.span;
    let end = (report.simulated_s * 1000.0).round() as u64;
    let ended = || vec![(end, report.reason.clone())];
    let plain = |expected: String, found: String| Failure {
        place,
        at_ms: None,
        events: ended(),
        expected: vec![expected],
        found: vec![found],
    };
    let states = |machine: usize| -> Vec<(u64, String)> {
        let name = &system.instances[machine].name;
        let automaton = system.automaton_of(machine);
        let states = watched.history[machine].iter();
        let states = states.map(|(ms, state)| (*ms, format!("{name} in {}", automaton.states[*state].name)));
        states.chain(ended()).collect()
    };
    let found = match &expect.what {
        What::Finished(wanted) if *wanted == report.finished => None,
        What::Finished(true) => Some(plain("the run reaches its goal".into(), "it does not".into())),
        What::Finished(false) => Some(plain("the run does not reach its goal".into(), "it does".into())),
        What::Reason(text) if report.reason.contains(text) => None,
        What::Reason(text) => Some(plain(format!("reason {text}"), format!("reason {}", report.reason))),
        What::Figure(figure, comparison, wanted) => {
            let found = figure_of(report, *figure);
            let holds = found.is_some_and(|found| compare(found, *comparison, *wanted));
            let (name, sign) = (name_of(*figure), sign(*comparison));
            let shown = found.map_or("none".into(), |found| found.to_string());
            (!holds).then(|| plain(format!("{name} {sign} {wanted}"), format!("{name} = {shown}")))
        }
        What::Reaches { machine, state, before_ms } => {
            let number = value::instance(system, &machine.value, machine.span)?;
            let wanted = value::state(system, number, &state.value, state.span)?;
            let first = watched.first.get(&(number, wanted)).copied();
            let is_in_time = |ms: u64| before_ms.is_none_or(|before| (ms as i64) < before);
            let before = before_ms.map_or(String::new(), |ms| format!(" before {} s", ms as f64 / 1000.0));
            let text = format!("{} in {}{before}", machine.value, state.value);
            let found = first.map_or("never".into(), |ms| format!("at {} s", ms as f64 / 1000.0));
            let failure = || Failure { events: states(number), ..plain(text, found) };
            (!first.is_some_and(is_in_time)).then(failure)
        }
        What::Never { machine, state } => {
            let number = value::instance(system, &machine.value, machine.span)?;
            let wanted = value::state(system, number, &state.value, state.span)?;
            watched.first.get(&(number, wanted)).map(|ms| {
                let text = format!("{} never in {}", machine.value, state.value);
                Failure { events: states(number), ..plain(text, format!("at {} s", *ms as f64 / 1000.0)) }
            })
        }
        What::Alarm { text, machine } => {
            let all = report.alarms.iter().map(|alarm| (alarm.code, alarm.machine.as_str()));
            let differs = differs(system, "alarm", (text, machine), all)?;
            differs.map(|[expected, found]| plain(expected, found))
        }
        What::Fault { text, machine } => {
            let earlier = report.faults.iter().map(|fault| (fault.code, fault.machine.as_str()));
            let last = report.fault.iter().map(|(code, machine)| (*code, machine.as_str()));
            let differs = differs(system, "fault", (text, machine), earlier.chain(last))?;
            differs.map(|[expected, found]| plain(expected, found))
        }
    };
    Ok(found)
}

/// What was expected, and what was found instead, if none of these faults or alarms has this text in its own and is one of
/// this machine.
fn differs<'a>(
    system: &System,
    what: &str,
    (text, machine): (&Option<String>, &Option<Spanned<String>>),
    all: impl Iterator<Item = (i32, &'a str)>,
) -> Result<Option<[String; 2]>, Box<Diagnostic>> {
    if let Some(machine) = machine {
        value::instance(system, &machine.value, machine.span)?;
    }
    let all: Vec<(&str, &str)> =
        all.map(|(code, robot)| (site(system, code).map_or("", |site| &site.text), robot)).collect();
    let is_it = |(found, robot): &(&str, &str)| {
        text.as_ref().is_none_or(|text| found.contains(text.as_str()))
            && machine.as_ref().is_none_or(|machine| machine.value == *robot)
    };
    if all.iter().any(is_it) {
        return Ok(None);
    }
    let of = machine.as_ref().map_or(String::new(), |machine| format!(" of {}", machine.value));
    let text = text.as_ref().map_or(String::new(), |text| format!(": {text}"));
    let found: Vec<String> = all.iter().map(|(text, robot)| format!("{what} of {robot}: {text}")).collect();
    let found = if found.is_empty() { format!("no {what}") } else { found.join("; ") };
    Ok(Some([format!("{what}{of}{text}"), found]))
}

fn figure_of(report: &Report, figure: Figure) -> Option<f64> {
    match figure {
        Figure::Orders => Some(report.orders_done as f64),
        Figure::SecondsPerOrder => report.seconds_per_order,
        Figure::Simulated => Some(report.simulated_s),
        Figure::Contacts => Some(report.collisions.len() as f64),
        Figure::Alarms => Some(report.alarms.iter().map(|alarm| u64::from(alarm.count)).sum::<u64>() as f64),
        Figure::Faults => Some((report.faults.len() + usize::from(report.fault.is_some())) as f64),
    }
}

fn name_of(figure: Figure) -> &'static str {
    match figure {
        Figure::Orders => "orders",
        Figure::SecondsPerOrder => "seconds_per_order",
        Figure::Simulated => "simulated",
        Figure::Contacts => "contacts",
        Figure::Alarms => "alarms",
        Figure::Faults => "faults",
    }
}

fn sign(comparison: Comparison) -> &'static str {
    match comparison {
        Comparison::Equal => "=",
        Comparison::NotEqual => "<>",
        Comparison::Less => "<",
        Comparison::LessEqual => "<=",
        Comparison::Greater => ">",
        Comparison::GreaterEqual => ">=",
    }
}

fn compare(found: f64, comparison: Comparison, wanted: f64) -> bool {
    match comparison {
        Comparison::Equal => found == wanted,
        Comparison::NotEqual => found != wanted,
        Comparison::Less => found < wanted,
        Comparison::LessEqual => found <= wanted,
        Comparison::Greater => found > wanted,
        Comparison::GreaterEqual => found >= wanted,
    }
}
