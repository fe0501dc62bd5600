//! `autogen sweep`: every layout with every combination of values.
//!
//! Layouts and values are data. Each layout is read and its types are checked once, the controllers are compiled
//! once, and each processor runs one point after another.

pub mod axis;
mod grid;
mod in_order;
mod interval;
pub mod measured;
mod plan;
mod point;
mod progress;
mod row;
mod table;

use super::controllers::Notice;
use super::options::{Format, SweepOptions, TableFormat};
use super::print;
use crate::Status;
use autogen::diagnostic::Diagnostic;
use plan::{Plan, Refusal};
use progress::Progress;
use row::Row;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::num::NonZeroUsize;
use std::thread;
use table::Table;

pub fn run(options: &SweepOptions) -> Status {
    let plan = match Plan::new(options) {
        Ok(plan) => plan,
        Err(refusal) => return not_planned(options, &refusal),
    };
    let mut table = match Table::new(&plan, options) {
        Ok(table) => table,
        Err(refusal) => return not_planned(options, &refusal),
    };
    if plan.lines.iter().all(|line| !line.draft.diagnostics().is_empty()) {
        return refuse(options, &plan);
    }
    let jobs = options.jobs.or_else(|| thread::available_parallelism().ok()).map_or(1, NonZeroUsize::get);
    let is_text = options.format == TableFormat::Text;
    let notice = if is_text && !options.quiet { Notice::Compiling } else { Notice::None };
    let Some(all) = plan.len().checked_mul(options.replications.get() as usize) else {
        return not_planned(options, &Refusal::Said("there are too many runs to count".into()));
    };
    let mut progress = Progress::new(all, options.quiet);
    let mut status = Status::Done;
    table.begin();
    let replications = options.replications.get();
    let mut runs = Vec::new();
    in_order::each(
        all,
        jobs,
        |index| {
            point::row(&plan, index / replications as usize, (index % replications as usize) as u32, notice)
        },
        |run| {
            status = worse(status, run.status);
            runs.push(run);
            progress.clear();
            if runs.len() == replications as usize
                && let Some(row) = Row::of_runs(std::mem::take(&mut runs))
            {
                table.row(&row);
            }
            progress.count();
        },
    );
    progress.clear();
    table.end();
    status
}

fn not_planned(options: &SweepOptions, refusal: &Refusal) -> Status {
    match refusal {
        Refusal::Failure(failure) => print::failure_in(format(options), failure),
        Refusal::Said(text) => {
            match format(options) {
                Format::Json => {
                    say!("{}", json!({ "rows": [], "finished": false, "reason": text, "diagnostics": [] }));
                }
                Format::Text => complain!("autogen: {text}"),
            }
            Status::WrongCommand
        }
    }
}

/// What a sweep says that has no table.
fn format(options: &SweepOptions) -> Format {
    match options.format {
        TableFormat::Json => Format::Json,
        TableFormat::Text | TableFormat::Csv | TableFormat::Jsonl => Format::Text,
    }
}

/// No layout can be run, whatever the values are: what is wrong is said once.
fn refuse(options: &SweepOptions, plan: &Plan) -> Status {
    let mut said = BTreeSet::new();
    let mut all: Vec<Value> = Vec::new();
    for line in &plan.lines {
        let mut found: Vec<Diagnostic> = Vec::new();
        for diagnostic in line.draft.diagnostics() {
            let json = print::diagnostics_json(&line.sources, std::slice::from_ref(diagnostic));
            if said.insert(json.to_string()) {
                found.push(diagnostic.clone());
                all.extend(json.as_array().cloned().unwrap_or_default());
            }
        }
        if format(options) == Format::Text && !found.is_empty() {
            print::diagnostics(&line.sources, &found);
        }
    }
    if format(options) == Format::Json {
        say!(
            "{}",
            json!({ "rows": [], "finished": false, "reason": "the input has errors", "diagnostics": all })
        );
    }
    Status::WrongInput
}

/// Of what two points came to, that which the sweep came to.
fn worse(a: Status, b: Status) -> Status {
    let rank = |status| match status {
        Status::Done => 0,
        Status::WrongInput | Status::NotReached => 1,
        Status::WrongCommand => 2,
        Status::Bug => 3,
    };
    let worst = if rank(a) >= rank(b) { a } else { b };
    if worst == Status::WrongInput { Status::NotReached } else { worst }
}
