//! Runs of points: their values made lines, and the lines run.

use super::super::controllers::{Controllers, Notice};
use super::super::print;
use super::super::results::results;
use super::design::{Point, RunNumber};
use super::facts;
use super::outcome::Outcome;
use super::plan::{Made, Plan};
use crate::Status;
use autogen::backend::report;
use autogen::diagnostic::Diagnostic;
use autogen::fault::reason_of_run;
use runtime_sim::line::{IoDelay, Line};
use runtime_sim::memory::Memory;
use runtime_sim::report::Report;
use runtime_sim::run::{Seen, Stepping, record_again, run_together};
use runtime_sim::scan;
use serde_json::json;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

/// What came of runs of one replication, by the numbers of their points.
pub struct Ran {
    pub outcomes: Vec<(usize, Outcome)>,
    /// Other replications may come to something else.
    pub is_drawn: bool,
}

impl Ran {
    pub fn has(&self, point: usize) -> bool {
        self.outcomes.iter().any(|(of, _)| *of == point)
    }
}

/// What came of a run, and of the same replication of other points, which have its plant. Whatever went wrong is in it;
/// then nothing comes of the others.
pub fn outcomes(plan: &Plan, number: RunNumber, others: &[usize], notice: Notice) -> Ran {
    let point = plan.design.point(number.point);
    let line = &plan.lines[point.layout];
    let runs = |others| catch_unwind(AssertUnwindSafe(|| together(plan, number, others, notice)));
    let mut made = runs(others);
    if !others.is_empty() && !matches!(made, Ok(Ok(_))) {
        made = runs(&[]);
    }
    let mut outcome = Outcome::new(line.draft.orders(), line.draft.items());
    let mut is_drawn = false;
    match made {
        Ok(Ok(ran)) => return ran,
        Ok(Err(End::Refused(found))) => {
            outcome.reason = refusal(&found);
            outcome.diagnostics = print::diagnostics_json(&line.sources, &found);
            outcome.status = Status::WrongInput;
        }
        Ok(Err(End::NoControllers(text))) => {
            outcome.reason = beginning(&text);
            outcome.status = Status::WrongCommand;
        }
        Ok(Err(End::NoReport(text))) => {
            outcome.reason = beginning(&text);
            outcome.status = Status::NotReached;
            is_drawn = true;
        }
        Err(_) => {
            outcome.reason = "bug: autogen panicked".into();
            outcome.status = Status::Bug;
            is_drawn = true;
        }
    }
    Ran { outcomes: vec![(number.point, outcome)], is_drawn }
}

enum End {
    Refused(Vec<Diagnostic>),
    NoControllers(String),
    NoReport(String),
}

/// The page of a run, as `commission` writes it; an error says why there is none.
pub fn page(plan: &Plan, number: RunNumber) -> Result<String, String> {
    let point = plan.design.point(number.point);
    let line = &plan.lines[point.layout];
    let made = catch_unwind(AssertUnwindSafe(|| {
        let Ready { made, plant, mut controllers } = ready(plan, &point, number.replication, Notice::None)?;
        let project = &made.project;
        let watched = report::watched(&project.system, &plant);
        let ignore = &mut |_: &Seen| {};
        let run = |memory: &mut Memory| {
            record_again(&plant, &mut controllers, Stepping::Events, memory, &watched, ignore)
        };
        let recorded = line.remembering(run).map_err(End::NoReport)?;
        let mut results = results(&recorded.report, project, &line.shown).map_err(End::NoReport)?;
        let facts = facts::of_run(plan, number, plant.scenario.seed);
        results["of_sweep"] = facts.iter().map(|fact| json!([fact.name, fact.value])).collect();
        Ok(report::html(project, &line.shown, &plant, &recorded, &results))
    }));
    match made {
        Ok(Ok(page)) => Ok(page),
        Ok(Err(End::Refused(found))) => Err(refusal(&found)),
        Ok(Err(End::NoControllers(text) | End::NoReport(text))) => Err(text),
        Err(_) => Err("bug: autogen panicked".into()),
    }
}

/// A line that can be run.
struct Ready {
    made: Arc<Made>,
    /// That of the replication.
    plant: Line,
    controllers: Controllers,
}

fn ready(plan: &Plan, point: &Point, replication: u32, notice: Notice) -> Result<Ready, End> {
    let line = &plan.lines[point.layout];
    let order = plan.design.orders.get(point.order).copied();
    let made = line.made(point, order).map_err(End::Refused)?;
    let library = line.library(&made.project.system, notice).map_err(End::NoControllers)?;
    let mut plant = made.project.replication(replication);
    plant.io_delay = match plan.delays[point.delay] {
        IoDelay::Random { max, seed } => {
            IoDelay::Random { max, seed: seed.wrapping_add(u64::from(replication)) }
        }
        IoDelay::Fixed(scans) => IoDelay::Fixed(scans),
    };
    let controllers = library.controllers(&plant, &made.parameters).map_err(End::NoReport)?;
    Ok(Ready { made, plant, controllers })
}

fn together(plan: &Plan, number: RunNumber, others: &[usize], notice: Notice) -> Result<Ran, End> {
    let point = plan.design.point(number.point);
    let line = &plan.lines[point.layout];
    let Ready { made, plant, mut controllers } = ready(plan, &point, number.replication, notice)?;
    let others = others.iter().map(|other| {
        let ready = ready(plan, &plan.design.point(*other), number.replication, notice)?;
        Ok((*other, ready))
    });
    let mut others = others.collect::<Result<Vec<_>, End>>()?;
    let beside = others.iter_mut().map(|(_, other)| {
        let controllers: &mut dyn scan::Controllers = &mut other.controllers;
        (&other.plant, controllers)
    });
    let beside = beside.collect();
    let simulate = |memory: &mut Memory| run_together(&plant, &mut controllers, beside, memory);
    let reports = line.remembering(simulate).map_err(End::NoReport)?;
    let outcome = |made: &Made, report: Report| {
        let reason = reason_of_run(&report, &made.project.system, &line.shown);
        let mut outcome = Outcome::new(line.draft.orders(), line.draft.items());
        outcome.reported(&report, reason, plan.design.warm_up);
        outcome
    };
    let all = std::iter::once((number.point, &made));
    let all = all.chain(others.iter().map(|(point, other)| (*point, &other.made)));
    let outcomes = all.zip(reports).map(|((point, made), report)| (point, outcome(made, report)));
    Ok(Ran { outcomes: outcomes.collect(), is_drawn: made.project.differs(&plant) })
}

/// All diagnostics in a line.
fn refusal(found: &[Diagnostic]) -> String {
    let first = found.first().map_or_else(String::new, |d| format!("{}: {}", d.code, d.message));
    match found.len() {
        0 | 1 => first,
        n => format!("{first} (and {} more)", n - 1),
    }
}

/// The beginning of a text, in a line: what a compiler says has many.
fn beginning(text: &str) -> String {
    let lines: Vec<&str> = text.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    match lines.as_slice() {
        [] | [_] | [_, _] => lines.join(" "),
        [first, second, ..] => format!("{first} {second} (`commission` shows all of it)"),
    }
}
