//! A whole line: what has to come of its run.

use super::value;
use super::{Comparison, Expect, Failure, Figure, What};
use crate::diagnostic::Diagnostic;
use crate::fault::reason_of_run;
use crate::ir::System;
use crate::source::Sources;
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
            if let Some(machine) = machine {
                value::instance(system, &machine.value, machine.span)?;
            }
            let text_of = |code: i32| {
                usize::try_from(code - 1)
                    .ok()
                    .and_then(|code| system.model.faults.get(code))
                    .map_or("", |site| &site.text)
            };
            let is_it = report.alarms.iter().any(|alarm| {
                text.as_ref().is_none_or(|text| text_of(alarm.code).contains(text.as_str()))
                    && machine.as_ref().is_none_or(|machine| machine.value == alarm.machine)
            });
            let of = machine.as_ref().map_or(String::new(), |machine| format!(" of {}", machine.value));
            let wanted =
                format!("alarm{of}{}", text.as_ref().map_or(String::new(), |text| format!(": {text}")));
            let all: Vec<String> = report
                .alarms
                .iter()
                .map(|a| format!("alarm of {}: {}", a.machine, text_of(a.code)))
                .collect();
            let found = if all.is_empty() { "no alarm".into() } else { all.join("; ") };
            (!is_it).then(|| plain(wanted, found))
        }
        What::Fault { text, machine } => {
            if let Some(machine) = machine {
                value::instance(system, &machine.value, machine.span)?;
            }
            let site = report.fault.as_ref().and_then(|(code, robot)| {
                let site = usize::try_from(*code - 1).ok().and_then(|code| system.model.faults.get(code))?;
                Some((site.text.clone(), robot.clone()))
            });
            let is_it = site.as_ref().is_some_and(|(found, robot)| {
                text.as_ref().is_none_or(|text| found.contains(text.as_str()))
                    && machine.as_ref().is_none_or(|machine| machine.value == *robot)
            });
            let of = machine.as_ref().map_or(String::new(), |machine| format!(" of {}", machine.value));
            let wanted =
                format!("fault{of}{}", text.as_ref().map_or(String::new(), |text| format!(": {text}")));
            let found = site.map_or("no fault".into(), |(text, robot)| format!("fault of {robot}: {text}"));
            (!is_it).then(|| plain(wanted, found))
        }
    };
    Ok(found)
}

fn figure_of(report: &Report, figure: Figure) -> Option<f64> {
    match figure {
        Figure::Orders => Some(report.orders_done as f64),
        Figure::SecondsPerOrder => report.seconds_per_order,
        Figure::Simulated => Some(report.simulated_s),
        Figure::Contacts => Some(report.collisions.len() as f64),
        Figure::Alarms => Some(report.alarms.iter().map(|alarm| u64::from(alarm.count)).sum::<u64>() as f64),
    }
}

fn name_of(figure: Figure) -> &'static str {
    match figure {
        Figure::Orders => "orders",
        Figure::SecondsPerOrder => "seconds_per_order",
        Figure::Simulated => "simulated",
        Figure::Contacts => "contacts",
        Figure::Alarms => "alarms",
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
