//! What came of one run.

use super::design::{Asked, Design, RunNumber};
use super::warm_up::{WarmUp, seconds_per_order};
use crate::{Status, output};
use runtime_sim::report::{FaultReport, Report};
use serde_json::{Map, Value, json};

#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    pub finished: bool,
    /// In one line, why the run ended or why there was none.
    pub reason: String,
    pub orders_done: u64,
    /// Number asked for; `None` of a point that was refused, if it is not known or they have no end.
    pub orders: Option<u64>,
    /// `None` if no order was made, or all were cut.
    pub seconds_per_order: Option<f64>,
    /// Items that the sinks of a goal have; without a goal those that any sink has.
    pub items: u64,
    /// Number that they should have; `None` without such a goal.
    pub items_asked: Option<u64>,
    /// Orders of the warm-up, which are not in [`Self::seconds_per_order`].
    pub cut_orders: u64,
    /// `None` if there was no run.
    pub simulated_s: Option<f64>,
    /// As `commission` reports it.
    pub trace_hash: Option<String>,
    /// A list; of a point that was refused.
    pub diagnostics: Value,
    /// What the run did not come to, a line each.
    pub notes: Vec<String>,
    pub status: Status,
}

impl Outcome {
    /// Nothing has come of it yet.
    pub fn new(orders: Option<usize>, items_asked: Option<u64>) -> Self {
        Self {
            finished: false,
            reason: String::new(),
            orders_done: 0,
            orders: orders.map(|n| n as u64),
            seconds_per_order: None,
            items: 0,
            items_asked,
            cut_orders: 0,
            simulated_s: None,
            trace_hash: None,
            diagnostics: json!([]),
            notes: Vec::new(),
            status: Status::NotReached,
        }
    }

    /// Takes over what the simulation reports, and why it ended.
    pub fn reported(&mut self, report: &Report, reason: String, warm_up: Option<WarmUp>) {
        self.finished = report.finished;
        self.reason = reason;
        self.orders_done = report.orders_done as u64;
        self.orders = Some(report.orders as u64);
        self.seconds_per_order = report.seconds_per_order;
        let in_sinks = || report.sinks.iter().map(|(.., count)| count).sum();
        self.items = report.collected.map_or_else(in_sinks, |[items, _]| items);
        self.items_asked = report.collected.map(|[_, asked]| asked);
        if let Some(warm_up) = warm_up {
            let mut made: Vec<f64> = report.order_times.iter().filter_map(|times| times.made_s).collect();
            made.sort_by(f64::total_cmp);
            let cut = warm_up.cut(&made);
            self.cut_orders = cut as u64;
            self.seconds_per_order = seconds_per_order(&made, cut);
        }
        self.simulated_s = Some(report.simulated_s);
        self.trace_hash = Some(report.trace_hash_text());
        let cleared = report.faults.iter().map(|fault| {
            let FaultReport { code, machine, state, at_s, .. } = fault;
            format!(
                "fault {code} of {machine}, in state {state}, at {at_s:.2} s, after which the run went on"
            )
        });
        self.notes = report.notes.iter().cloned().chain(cleared).collect();
        self.status = match self.finished {
            true => Status::Done,
            false if self.reason.starts_with("bug: ") => Status::Bug,
            false => Status::NotReached,
        };
    }

    /// The figure of a run that has done what was asked for.
    pub fn figure(&self, asked: Asked) -> Option<f64> {
        match asked {
            Asked::Orders => self.seconds_per_order,
            Asked::Items => self.simulated_s.filter(|_| self.items_asked.is_some()),
            Asked::Throughput => self.items_per_hour(asked),
        }
        .filter(|_| self.finished)
    }

    /// Items that sinks collect in an hour, as a mean over the run; `None` of a layout without a goal beside others with one.
    pub fn items_per_hour(&self, asked: Asked) -> Option<f64> {
        if asked != Asked::Throughput && self.items_asked.is_none() {
            return None;
        }
        let simulated_s = self.simulated_s.filter(|s| *s > 0.0)?;
        Some(self.items as f64 * 3600.0 / simulated_s)
    }

    /// The point cannot be run, whatever the seeds are.
    pub fn is_refused(&self) -> bool {
        self.status == Status::WrongInput
    }

    /// What a row of JSON says beside the names of its point.
    pub fn to_json(&self) -> Map<String, Value> {
        let all = [
            ("finished", json!(self.finished)),
            ("reason", json!(self.reason)),
            ("orders_done", json!(self.orders_done)),
            ("orders", json!(self.orders)),
            ("seconds_per_order", json!(self.seconds_per_order)),
            ("simulated_s", json!(self.simulated_s)),
            ("trace_hash", json!(self.trace_hash)),
            ("diagnostics", self.diagnostics.clone()),
        ];
        let notes = (!self.notes.is_empty()).then(|| ("notes", json!(self.notes)));
        all.into_iter().chain(notes).map(|(key, value)| (key.into(), value)).collect()
    }

    /// A line of a part: what names the run, what came of it, the exit status of a sweep of this run alone, and a hash of
    /// all that.
    pub fn to_line(&self, design: &Design, run: RunNumber) -> Map<String, Value> {
        let mut line = design.names(&design.point(run.point));
        line.insert("replication".into(), json!(run.replication));
        line.extend(self.to_json());
        if design.asked != Asked::Orders {
            line.insert("items".into(), json!(self.items));
            line.insert("items_asked".into(), json!(self.items_asked));
        }
        line.insert("cut_orders".into(), json!(self.cut_orders));
        line.insert("status".into(), json!(self.status as u8));
        let hash = output::hash(Value::Object(line.clone()).to_string().as_bytes());
        line.insert("hash".into(), json!(hash));
        line
    }

    /// Reads such a line of this run; an error names a key that is not as [`Self::to_line`] writes it.
    pub fn from_line(line: &Map<String, Value>, design: &Design, run: RunNumber) -> Result<Self, String> {
        let value = |key: &str| line.get(key).unwrap_or(&Value::Null);
        let number = |key: &str| value(key).as_u64();
        let status =
            [Status::Done, Status::WrongInput, Status::WrongCommand, Status::NotReached, Status::Bug];
        let status = status.into_iter().find(|status| number("status") == Some(*status as u64));
        let outcome = Self {
            finished: value("finished") == &json!(true),
            reason: value("reason").as_str().unwrap_or("").into(),
            orders_done: number("orders_done").unwrap_or(0),
            orders: number("orders"),
            seconds_per_order: value("seconds_per_order").as_f64(),
            items: number("items").unwrap_or(0),
            items_asked: number("items_asked"),
            cut_orders: number("cut_orders").unwrap_or(0),
            simulated_s: value("simulated_s").as_f64(),
            trace_hash: value("trace_hash").as_str().map(String::from),
            notes: match value("notes") {
                Value::Array(notes) => notes.iter().filter_map(Value::as_str).map(String::from).collect(),
                _ => Vec::new(),
            },
            diagnostics: match value("diagnostics") {
                list @ Value::Array(_) => list.clone(),
                _ => json!([]),
            },
            status: status.unwrap_or(Status::Bug),
        };
        if outcome.finished != (outcome.status == Status::Done) {
            return Err("status".into());
        }
        let wanted = outcome.to_line(design, run);
        if let Some((key, _)) = wanted.iter().find(|(key, value)| line.get(*key) != Some(*value)) {
            return Err(key.clone());
        }
        match line.keys().find(|key| !wanted.contains_key(*key)) {
            Some(key) => Err(key.clone()),
            None => Ok(outcome),
        }
    }
}
