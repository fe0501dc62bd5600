//! `autogen sweep`: every layout with every combination of values.
//!
//! Layouts and values are data. Each layout is read and its types are checked once, the controllers are compiled
//! once, and each processor runs one point after another.

pub mod axis;
mod columns;
mod design;
mod distinct;
mod facts;
mod grid;
mod head;
mod in_order;
mod interval;
pub mod measured;
pub mod merge;
mod outcome;
mod page;
mod part;
mod part_file;
mod plan;
mod point;
mod precision;
mod progress;
mod rows;
mod table;
mod together;
mod warm_up;

use super::controllers::Notice;
use super::options::{Format, SweepOptions, TableFormat, TableOptions};
use super::print;
use crate::Status;
use autogen::diagnostic::Diagnostic;
use design::{Design, RunNumber};
use facts::About;
use head::Head;
use outcome::Outcome;
use page::Request;
use part::{MOST_PARTS, Part};
use plan::{Plan, Refusal};
use progress::Progress;
use rows::Rows;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use table::Table;
use together::Together;

pub fn run(options: &SweepOptions) -> Status {
    match plan(options) {
        Ok((plan, _)) if plan.lines.iter().all(|line| !line.draft.diagnostics().is_empty()) => {
            refuse(&options.table, &plan)
        }
        Ok((plan, Some(part))) => of_part(&plan, part, options),
        Ok((plan, None)) => whole(&plan, options),
        Err(refusal) => not_planned(&options.table, &refusal),
    }
}

fn plan(options: &SweepOptions) -> Result<(Plan, Option<Part>), Refusal> {
    let part = options.part.as_deref().map(part).transpose()?;
    if part.is_some() && options.until_precision.is_some() {
        return Err(Refusal::Said(
            "--until-precision cannot be used with --part: whether a point goes on depends on all of its runs so far, \
             and a part has only some of them; give --replications instead"
                .into(),
        ));
    }
    Ok((Plan::new(options)?, part))
}

fn part(text: &str) -> Result<Part, Refusal> {
    let said = || {
        Refusal::Said(format!("--part takes K/N, part K of N, with K from 1 to N and N up to {MOST_PARTS}"))
    };
    Part::parse(text).ok_or_else(said)
}

/// All runs, as rows of a table.
fn whole(plan: &Plan, options: &SweepOptions) -> Status {
    let page = Request::new(options.report.as_deref(), options.keep.as_deref(), &plan.design);
    let page = match page {
        Ok(page) => page,
        Err(text) => return not_planned(&options.table, &Refusal::Said(text)),
    };
    let mut rows = match shown(&plan.design, &options.table, page.as_ref()) {
        Ok(rows) => rows,
        Err(refusal) => return not_planned(&options.table, &refusal),
    };
    // Points of which all runs are known: a precision may be reached before the last replication.
    let closed = &AtomicUsize::new(0);
    let indices = || {
        let mut next = 0;
        std::iter::from_fn(move || {
            let first = closed.load(Ordering::Relaxed).saturating_mul(plan.design.replications as usize);
            let index = first.max(next);
            next = index + 1;
            (index < plan.runs).then_some(index)
        })
    };
    let is_text = options.table.format == TableFormat::Text;
    let mut progress = Progress::new(plan.runs, options.table.quiet);
    let together = Together::new(plan, plan.runs, jobs(options));
    let notice = if is_text && !options.table.quiet { Notice::Compiling } else { Notice::None };
    each_run(
        &together,
        notice,
        indices,
        |_| true,
        |number, outcome| {
            progress.clear();
            if rows.take(number, outcome) {
                closed.store(number.point + 1, Ordering::Relaxed);
            }
            progress.show(together.made());
        },
    );
    progress.clear();
    let (status, table) = rows.end();
    let Some((page, table)) = page.zip(table) else { return status };
    let written = page.write_kept(plan, table.rows.len()).and_then(|kept| {
        let about = About::of(plan, &options.specs);
        let facts = facts::of_sweep(&plan.design, &about, options.until_precision.as_deref(), &options.table);
        page.write(&plan.design, facts, table, kept)
    });
    status_of_page(status, written)
}

/// The rows of a table. Where there is a page they are kept for it, and nobody has to read the table.
fn shown<'a>(
    design: &'a Design,
    options: &'a TableOptions,
    page: Option<&Request>,
) -> Result<Rows<'a>, Refusal> {
    let table = Table::new(design, options)?;
    if page.is_none() {
        return Ok(Rows::new(design, table));
    }
    print::go_on_without_reader();
    Ok(Rows::new(design, table.keeping()))
}

/// What the runs came to, unless their page could not be written.
fn status_of_page(status: Status, written: Result<(), String>) -> Status {
    match written {
        Ok(()) => status,
        Err(text) => {
            complain!("autogen: {text}");
            Status::WrongCommand
        }
    }
}

/// The runs of a part, a line each.
fn of_part(plan: &Plan, part: Part, options: &SweepOptions) -> Status {
    match Head::line(plan, part, &options.specs) {
        Ok(line) => say!("{line}"),
        Err(text) => return not_planned(&options.table, &Refusal::Said(text)),
    }
    let mut status = Status::Done;
    let runs = part.runs(&plan.design).count();
    let mut progress = Progress::new(runs, options.table.quiet);
    let together = Together::new(plan, runs, jobs(options));
    let (indices, is_asked) = (|| part.runs(&plan.design), |index| part.has(&plan.design, index));
    each_run(&together, Notice::None, indices, is_asked, |number, outcome| {
        status = rows::worse(status, outcome.status);
        progress.clear();
        say!("{}", Value::Object(outcome.to_line(&plan.design, number)));
        progress.show(together.made());
    });
    progress.clear();
    status
}

/// Runs with these indices, on all processors; `take` sees what came of them in their order. `is_asked` says which are
/// among them.
fn each_run<I: Iterator<Item = usize> + Send>(
    together: &Together,
    notice: Notice,
    indices: impl Fn() -> I,
    is_asked: impl Fn(usize) -> bool + Sync,
    mut take: impl FnMut(RunNumber, Outcome),
) {
    let begun = indices().filter(|index| together.begin(*index));
    let mut turns = indices();
    let mut turn = turns.next();
    in_order::each(
        begun,
        together.jobs,
        |index| together.make(index, &is_asked, notice),
        |()| {
            while let Some((index, outcome)) = turn.and_then(|index| Some((index, together.take(index)?))) {
                take(together.plan.design.run(index), outcome);
                turn = turns.next();
            }
        },
    );
}

fn jobs(options: &SweepOptions) -> usize {
    options.jobs.or_else(|| thread::available_parallelism().ok()).map_or(1, NonZeroUsize::get)
}

fn not_planned(options: &TableOptions, refusal: &Refusal) -> Status {
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
fn format(options: &TableOptions) -> Format {
    match options.format {
        TableFormat::Json => Format::Json,
        TableFormat::Text | TableFormat::Csv | TableFormat::Jsonl => Format::Text,
    }
}

/// No layout can be run, whatever the values are: what is wrong is said once.
fn refuse(options: &TableOptions, plan: &Plan) -> Status {
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
