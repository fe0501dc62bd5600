//! Runs, taken in order, become rows.

use super::columns::Columns;
use super::design::{Asked, Design, Point, RunNumber};
use super::interval::Sample;
use super::outcome::Outcome;
use super::table::Table;
use crate::Status;
use autogen::backend::report::sweep as page;

/// What came of one point.
pub struct Row {
    pub point: Point,
    /// The only run; of several the first in which not all orders were made, else the first, with means instead of its
    /// figures.
    pub outcome: Outcome,
    /// Runs, and those of them in which all orders were made.
    pub runs: u32,
    pub finished_runs: usize,
    /// Those of them that have a figure: the warm-up may leave no order of a run.
    pub measured_runs: usize,
    /// Mean over the runs that have one.
    pub figure: Option<f64>,
    /// Half of the width of the 95 % interval of the figure; `None` of less than two runs.
    pub half_width: Option<f64>,
    /// Several runs have come to the same, and the controllers did the same at the same times.
    pub are_same: bool,
    /// Mean over the runs in which all orders were made.
    pub cut_orders: Option<f64>,
    /// Mean over all runs; `None` of a layout without a goal beside others with one.
    pub items_per_hour: Option<f64>,
    /// The figure less that of the first point with the same seeds.
    pub differences: Sample,
}

impl Row {
    /// Of a point of which nothing is known.
    pub fn empty(design: &Design) -> Self {
        Self {
            point: design.point(0),
            outcome: Outcome::new(None, None),
            runs: 0,
            finished_runs: 0,
            measured_runs: 0,
            figure: None,
            half_width: None,
            are_same: false,
            cut_orders: None,
            items_per_hour: None,
            differences: Sample::default(),
        }
    }

    /// `columns` are those of this row.
    pub fn on_page(&self, design: &Design, columns: &[Columns]) -> page::Row {
        let help = self.outcome.diagnostics[0]["help"].as_str().map(|help| format!("help: {help}"));
        let notes = self.outcome.notes.iter().map(|note| format!("note: {note}"));
        page::Row {
            at: design.indices(&self.point),
            cells: columns.iter().flat_map(|columns| &columns.texts).map(|text| text.cell.clone()).collect(),
            reason: self.outcome.reason.clone(),
            remarks: help.into_iter().chain(notes).collect(),
            runs: self.runs,
            finished_runs: self.finished_runs,
            measured_runs: self.measured_runs,
            figure: self.figure,
            half_width: self.half_width,
        }
    }
}

/// The runs of the point at work, as running figures.
#[derive(Default)]
struct Tally {
    runs: u32,
    orders_done: Option<u64>,
    items: Option<u64>,
    shown: Option<Outcome>,
    figure: Sample,
    simulated_s: Sample,
    cut_orders: Sample,
    items_per_hour: Sample,
    differences: Sample,
    /// The first run, and whether another one came to something else.
    first: Option<Outcome>,
    differ: bool,
}

impl Tally {
    fn take(&mut self, replication: u32, mut outcome: Outcome, asked: Asked) {
        self.runs += 1;
        self.differ |= outcome != *self.first.get_or_insert_with(|| outcome.clone());
        self.orders_done = self.orders_done.into_iter().chain([outcome.orders_done]).min();
        self.items = self.items.into_iter().chain([outcome.items]).min();
        outcome.items_per_hour(asked).into_iter().for_each(|n| self.items_per_hour.take(n));
        if outcome.finished {
            outcome.figure(asked).into_iter().for_each(|s| self.figure.take(s));
            outcome.simulated_s.into_iter().for_each(|s| self.simulated_s.take(s));
            self.cut_orders.take(outcome.cut_orders as f64);
        } else {
            outcome.reason = format!("replication {}: {}", replication + 1, outcome.reason);
        }
        if self.shown.as_ref().is_none_or(|shown| shown.finished && !outcome.finished) {
            self.shown = Some(outcome);
        }
    }

    fn row(self, point: Point, asked: Asked) -> Option<Row> {
        let mut outcome = self.shown?;
        outcome.orders_done = self.orders_done?;
        outcome.items = self.items?;
        outcome.seconds_per_order = self.figure.mean().filter(|_| asked == Asked::Orders);
        outcome.simulated_s = self.simulated_s.mean();
        outcome.trace_hash = None;
        Some(Row {
            point,
            outcome,
            runs: self.runs,
            finished_runs: self.cut_orders.count,
            measured_runs: self.figure.count,
            figure: self.figure.mean(),
            half_width: self.figure.half_width(),
            are_same: self.figure.half_width().is_some() && !self.differ,
            cut_orders: self.cut_orders.mean(),
            items_per_hour: self.items_per_hour.mean(),
            differences: self.differences,
        })
    }
}

/// Puts rows into a table, each as soon as its last run is known.
pub struct Rows<'a> {
    design: &'a Design,
    table: Table<'a>,
    tally: Tally,
    /// Of the first point, for each replication: the figure, if all was done. Empty unless the table
    /// compares.
    first: Vec<Option<f64>>,
    /// What all runs so far came to.
    pub status: Status,
    /// Points whose runs are over before their figure is as precise as it should be.
    imprecise: usize,
    /// Runs that did not finish and their points, where the runs go on until a precision.
    left_out: (usize, usize),
    /// Runs of which the warm-up leaves no order, and their points.
    cut_whole: (usize, usize),
}

impl<'a> Rows<'a> {
    pub fn new(design: &'a Design, table: Table<'a>) -> Self {
        table.begin();
        Self {
            design,
            table,
            tally: Tally::default(),
            first: Vec::new(),
            status: Status::Done,
            imprecise: 0,
            left_out: (0, 0),
            cut_whole: (0, 0),
        }
    }

    /// The runs of a point come in the order of their replications, the points in theirs. Whether it was the last run
    /// of its point.
    pub fn take(&mut self, run: RunNumber, outcome: Outcome) -> bool {
        self.status = worse(self.status, outcome.status);
        if self.table.compares() {
            self.compare(run, outcome.figure(self.design.asked));
        }
        let is_refused = outcome.is_refused();
        if !self.design.has_means() {
            let row = Row {
                point: self.design.point(run.point),
                runs: 1,
                finished_runs: usize::from(outcome.finished),
                measured_runs: usize::from(outcome.figure(self.design.asked).is_some()),
                figure: outcome.figure(self.design.asked),
                half_width: None,
                are_same: false,
                cut_orders: outcome.finished.then_some(outcome.cut_orders as f64),
                items_per_hour: outcome.items_per_hour(self.design.asked),
                differences: std::mem::take(&mut self.tally).differences,
                outcome,
            };
            self.put(&row);
            return true;
        }
        self.tally.take(run.replication, outcome, self.design.asked);
        let is_enough = self
            .design
            .precision
            .is_some_and(|precision| is_refused || precision.is_reached(&self.tally.figure));
        let is_last = is_enough || self.tally.runs == self.design.replications;
        self.imprecise += usize::from(is_last && !is_enough && self.design.precision.is_some());
        if is_last
            && let Some(row) =
                std::mem::take(&mut self.tally).row(self.design.point(run.point), self.design.asked)
        {
            self.put(&row);
        }
        is_last
    }

    fn put(&mut self, row: &Row) {
        let left_out = row.runs as usize - row.finished_runs;
        if self.design.precision.is_some() && row.finished_runs > 0 && left_out > 0 {
            self.left_out.0 += left_out;
            self.left_out.1 += 1;
        }
        // Layouts without orders have no figure either, and nothing is cut of them.
        let cut_whole = row.finished_runs - row.measured_runs;
        if cut_whole > 0 && row.cut_orders.is_some_and(|cut| cut > 0.0) {
            self.cut_whole.0 += cut_whole;
            self.cut_whole.1 += 1;
        }
        self.table.row(row);
    }

    fn compare(&mut self, run: RunNumber, figure: Option<f64>) {
        if run.point == 0 {
            self.first.push(figure);
        } else if let Some(first) = self.first.get(run.replication as usize).copied().flatten()
            && let Some(here) = figure
        {
            self.tally.differences.take(here - first);
        }
    }

    /// What all runs came to, and the table of a page, if one is kept.
    pub fn end(self) -> (Status, Option<page::Table>) {
        let kept = self.table.end();
        if self.imprecise > 0 {
            let (points, runs) = (self.imprecise, self.design.replications);
            let points = counted(points, "point has", "points have");
            complain!("{points} not reached the precision in {runs} runs");
        }
        if let (runs @ 1.., points) = self.left_out {
            let (runs, points) = (counted(runs, "run", "runs"), counted(points, "point", "points"));
            complain!(
                "{runs} of {points} did not finish: a precision is that of the runs that did, and a time limit makes \
                 their mean mostly too small"
            );
        }
        if let (runs @ 1.., points) = self.cut_whole {
            let (runs, points) = (counted(runs, "run", "runs"), counted(points, "point", "points"));
            complain!(
                "the warm-up leaves no order of {runs} of {points}: they are in no mean; cut less, or make more orders"
            );
        }
        (self.status, kept)
    }
}

fn counted(number: usize, one: &str, several: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { several })
}

/// Of what two points came to, that which the sweep came to.
pub fn worse(a: Status, b: Status) -> Status {
    let rank = |status| match status {
        Status::Done => 0,
        Status::WrongInput | Status::NotReached | Status::Undecided => 1,
        Status::WrongCommand => 2,
        Status::Bug => 3,
    };
    let worst = if rank(a) >= rank(b) { a } else { b };
    if worst == Status::WrongInput { Status::NotReached } else { worst }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a run with a goal of items.
    fn outcome(finished: bool, simulated_s: f64) -> Outcome {
        Outcome { finished, simulated_s: Some(simulated_s), ..Outcome::new(None, Some(2)) }
    }

    #[test]
    fn a_mean_is_over_the_runs_that_have_reached_the_goal() {
        let mut tally = Tally::default();
        let runs = [outcome(true, 10.0), outcome(false, 100.0), outcome(true, 30.0)];
        for (number, outcome) in (0..).zip(runs) {
            tally.take(number, outcome, Asked::Items);
        }
        let point = Point { layout: 0, values: Vec::new(), order: 0, delay: 0 };
        let row = tally.row(point, Asked::Items).expect("a row");
        assert_eq!((row.figure, row.runs, row.finished_runs), (Some(20.0), 3, 2));
    }
}
