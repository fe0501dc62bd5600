//! What came of one point.

use super::interval;
use super::plan::{Plan, Point};
use crate::Status;
use serde_json::{Map, Value, json};

pub struct Row {
    pub point: Point,
    pub finished: bool,
    /// In one line, why the run ended or why there was none.
    pub reason: String,
    pub orders_done: u64,
    /// Number asked for; `None` if the scenario cannot be read.
    pub orders: Option<u64>,
    /// `None` if no order was made.
    pub seconds_per_order: Option<f64>,
    /// Half of the width of its 95 % interval; `None` of less than two runs.
    pub half_width: Option<f64>,
    /// Runs, and those of them in which all orders were made.
    pub runs: usize,
    pub finished_runs: usize,
    /// `None` if there was no run.
    pub simulated_s: Option<f64>,
    /// As `commission` reports it.
    pub trace_hash: Option<String>,
    /// A list; of a point that was refused.
    pub diagnostics: Value,
    pub status: Status,
}

impl Row {
    /// Nothing has come of it yet.
    pub fn new(point: Point, orders: Option<usize>) -> Self {
        Self {
            point,
            finished: false,
            reason: String::new(),
            orders_done: 0,
            orders: orders.map(|n| n as u64),
            seconds_per_order: None,
            half_width: None,
            runs: 1,
            finished_runs: 0,
            simulated_s: None,
            trace_hash: None,
            diagnostics: json!([]),
            status: Status::NotReached,
        }
    }

    /// Takes over what the simulation reports.
    pub fn reported(&mut self, report: &Value) {
        self.finished = report["finished"] == true;
        self.finished_runs = usize::from(self.finished);
        self.reason = report["reason"].as_str().unwrap_or("").into();
        self.orders_done = report["orders_done"].as_u64().unwrap_or(0);
        self.orders = report["orders"].as_u64();
        self.seconds_per_order = report["seconds_per_order"].as_f64();
        self.simulated_s = report["simulated_s"].as_f64();
        self.trace_hash = report["trace_hash"].as_str().map(String::from);
        self.status = match self.finished {
            true => Status::Done,
            false if self.reason.starts_with("bug: ") => Status::Bug,
            false => Status::NotReached,
        };
    }

    /// Of all runs of a point: means of those in which all orders were made, and what went wrong in the first of the
    /// others.
    pub fn of_runs(runs: Vec<Row>) -> Option<Self> {
        let finished: Vec<&Row> = runs.iter().filter(|row| row.finished).collect();
        let values = |value: fn(&Row) -> Option<f64>| -> Vec<f64> {
            finished.iter().filter_map(|row| value(row)).collect()
        };
        let (seconds, simulated) = (values(|row| row.seconds_per_order), values(|row| row.simulated_s));
        let (count, finished) = (runs.len(), finished.len());
        let orders_done = runs.iter().map(|row| row.orders_done).min()?;
        let wrong = runs.iter().position(|row| !row.finished);
        let mut all = runs.into_iter();
        let mut row = all.nth(wrong.unwrap_or(0))?;
        if count > 1 {
            if let Some(wrong) = wrong {
                row.reason = format!("replication {}: {}", wrong + 1, row.reason);
            }
            row.seconds_per_order = interval::mean(&seconds);
            row.half_width = interval::half_width(&seconds);
            row.simulated_s = interval::mean(&simulated);
            row.trace_hash = None;
        }
        Some(Self { orders_done, runs: count, finished_runs: finished, ..row })
    }

    pub fn to_json(&self, plan: &Plan) -> Value {
        let set: Map<String, Value> = (plan.axes.iter().zip(&self.point.values))
            .map(|(axis, &value)| (axis.name.clone(), written(&axis.values[value])))
            .collect();
        let mut json = json!({
            "layout": plan.lines[self.point.line].title,
            "set": set,
            "order_seed": plan.orders[self.point.order],
            "io_delay": plan.delays[self.point.delay].0,
            "finished": self.finished,
            "reason": self.reason,
            "orders_done": self.orders_done,
            "orders": self.orders,
            "seconds_per_order": self.seconds_per_order,
            "simulated_s": self.simulated_s,
            "trace_hash": self.trace_hash,
            "diagnostics": self.diagnostics,
        });
        if self.runs > 1 {
            json["runs"] = json!(self.runs);
            json["finished_runs"] = json!(self.finished_runs);
            json["half_width"] = json!(self.half_width);
        }
        json
    }
}

/// A value as JSON; a bare word is a text.
fn written(value: &str) -> Value {
    serde_json::from_str(value).unwrap_or_else(|_| json!(value))
}
