//! One point of a sweep: its values made a line, and the line run.

use super::super::fault;
use super::super::print;
use super::super::program::Notice;
use super::plan::Plan;
use super::row::Row;
use super::runner::Runner;
use crate::Status;
use autogen::backend::rust::parameters_text;
use autogen::diagnostic::Diagnostic;
use autogen::lower::Setting;
use serde_json::Value;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// What came of a point; whatever went wrong is in the row.
pub fn row(plan: &Plan, index: usize, runner: &mut Runner, notice: Notice) -> Row {
    let point = plan.point(index);
    let line = &plan.lines[point.line];
    let mut row = Row::new(point, line.draft.orders());
    match catch_unwind(AssertUnwindSafe(|| run(plan, &row, runner, notice))) {
        Ok(Ok(report)) => row.reported(&report),
        Ok(Err(End::Refused(found))) => {
            row.reason = refusal(&found);
            row.diagnostics = print::diagnostics_json(&line.sources, &found);
            row.status = Status::WrongInput;
        }
        Ok(Err(End::NoProgram(text))) => {
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
    NoProgram(String),
    NoReport(String),
}

fn run(plan: &Plan, row: &Row, runner: &mut Runner, notice: Notice) -> Result<Value, End> {
    let point = &row.point;
    let line = &plan.lines[point.line];
    let settings: Vec<Setting> =
        line.settings.iter().zip(&point.values).map(|(of_axis, &value)| of_axis[value].clone()).collect();
    let made = line.draft.line(&settings, plan.orders[point.order]);
    let Some(mut project) = made.project else { return Err(End::Refused(made.diagnostics)) };
    let program = line.program(&project.system, notice).map_err(End::NoProgram)?;
    project.plant.io_delay = plan.delays[point.delay].1.clone();
    let report = runner.run(&program, &project.plant.to_text(), &parameters_text(&project.system));
    let mut report = report.map_err(End::NoReport)?;
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
