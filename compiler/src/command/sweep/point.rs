//! One point of a sweep: its values made a line, and the line run.

use super::super::controllers::Notice;
use super::super::fault;
use super::super::print;
use super::plan::Plan;
use super::row::Row;
use crate::Status;
use autogen::backend::rust::parameters_text;
use autogen::diagnostic::Diagnostic;
use autogen::lower::Setting;
use runtime_sim::line::IoDelay;
use runtime_sim::memory::Memory;
use runtime_sim::run::{Stepping, run_again};
use serde_json::Value;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// What came of a run of a point; whatever went wrong is in the row.
pub fn row(plan: &Plan, index: usize, replication: u32, notice: Notice) -> Row {
    let point = plan.point(index);
    let line = &plan.lines[point.line];
    let mut row = Row::new(point, line.draft.orders());
    match catch_unwind(AssertUnwindSafe(|| run(plan, &row, replication, notice))) {
        Ok(Ok(report)) => row.reported(&report),
        Ok(Err(End::Refused(found))) => {
            row.reason = refusal(&found);
            row.diagnostics = print::diagnostics_json(&line.sources, &found);
            row.status = Status::WrongInput;
        }
        Ok(Err(End::NoControllers(text))) => {
            row.reason = text;
            row.status = Status::WrongCommand;
        }
        Ok(Err(End::NoReport(text))) => {
            row.reason = text;
            row.status = Status::NotReached;
        }
        Err(_) => {
            row.reason = "bug: autogen panicked".into();
            row.status = Status::Bug;
        }
    }
    row
}

enum End {
    Refused(Vec<Diagnostic>),
    NoControllers(String),
    NoReport(String),
}

fn run(plan: &Plan, row: &Row, replication: u32, notice: Notice) -> Result<Value, End> {
    let point = &row.point;
    let line = &plan.lines[point.line];
    let settings: Vec<Setting> =
        line.settings.iter().zip(&point.values).map(|(of_axis, &value)| of_axis[value].clone()).collect();
    let made = line.draft.line(&settings, plan.orders[point.order], replication);
    let Some(mut project) = made.project else { return Err(End::Refused(made.diagnostics)) };
    let library = line.library(&project.system, notice).map_err(End::NoControllers)?;
    project.plant.io_delay = match plan.delays[point.delay].1 {
        IoDelay::Random { max, seed } => {
            IoDelay::Random { max, seed: seed.wrapping_add(u64::from(replication)) }
        }
        IoDelay::Fixed(scans) => IoDelay::Fixed(scans),
    };
    let mut controllers =
        library.controllers(&project.plant, &parameters_text(&project.system)).map_err(End::NoReport)?;
    let simulate = |memory: &mut Memory| {
        run_again(&project.plant, &mut controllers, Stepping::Events, memory, &mut |_| {})
    };
    let report = line.remembering(simulate).map_err(End::NoReport)?;
    let mut report = serde_json::from_str(&report.to_json())
        .map_err(|e| End::NoReport(format!("the report is no JSON: {e}")))?;
    fault::name(&mut report, &project.system, &line.shown);
    Ok(report)
}

/// All diagnostics in a line.
fn refusal(found: &[Diagnostic]) -> String {
    let first = found.first().map_or_else(String::new, |d| format!("{}: {}", d.code, d.message));
    match found.len() {
        0 | 1 => first,
        n => format!("{first} (and {} more)", n - 1),
    }
}
