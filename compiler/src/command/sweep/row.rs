//! What came of one point.

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
            simulated_s: None,
            trace_hash: None,
            diagnostics: json!([]),
            status: Status::NotReached,
        }
    }

    /// Takes over what the simulation reports.
    pub fn reported(&mut self, report: &Value) {
        self.finished = report["finished"] == true;
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

    pub fn to_json(&self, plan: &Plan) -> Value {
        let set: Map<String, Value> = (plan.axes.iter().zip(&self.point.values))
            .map(|(axis, &value)| (axis.name.clone(), written(&axis.values[value])))
            .collect();
        json!({
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
        })
    }
}

/// A value as JSON; a bare word is a text.
fn written(value: &str) -> Value {
    serde_json::from_str(value).unwrap_or_else(|_| json!(value))
}
