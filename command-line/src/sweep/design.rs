//! What a sweep varies: the points, and the runs of each.

use super::axis::Axis;
use super::precision::Precision;
use super::warm_up::WarmUp;
use serde_json::{Map, Value, json};

/// What the scenarios of a sweep ask for. It decides which figure a run comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// The figure is the seconds per order.
    Orders,
    /// Sinks should collect items: the figure is the time until they have, s.
    Items,
    /// Nothing is asked for: the figure is the number of items that sinks collect in an hour.
    Throughput,
}

impl Asked {
    /// As a part of a sweep says it.
    const NAMES: [(Self, &str); 3] =
        [(Self::Orders, "orders"), (Self::Items, "goal"), (Self::Throughput, "throughput")];
}

/// Nothing of it needs the layouts: a part of a sweep carries it in its first line.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// How rows name the layouts.
    pub layouts: Vec<String>,
    pub asked: Asked,
    pub axes: Vec<Axis>,
    /// Seeds of orders of the steps; empty: layout order.
    pub orders: Vec<u64>,
    /// How late devices answer, as written; empty: at once.
    pub delays: Vec<String>,
    /// Runs of each point; with a precision, the most.
    pub replications: u32,
    pub warm_up: Option<WarmUp>,
    pub precision: Option<Precision>,
}

/// Which value a point has of everything that varies.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Point {
    pub layout: usize,
    /// For each axis the index of a value.
    pub values: Vec<usize>,
    pub order: usize,
    pub delay: usize,
}

/// A run: the number of its point, and which of its replications, both from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RunNumber {
    pub point: usize,
    pub replication: u32,
}

impl Design {
    /// Number of points; `None` if they cannot be counted.
    pub fn points(&self) -> Option<usize> {
        let sizes = self.axes.iter().map(|axis| axis.values.len());
        let one = [self.layouts.len(), self.orders.len().max(1), self.delays.len().max(1)];
        sizes.chain(one).try_fold(1, usize::checked_mul)
    }

    /// Number of runs, at most; `None` if they cannot be counted.
    pub fn runs(&self) -> Option<usize> {
        self.points()?.checked_mul(self.replications as usize)
    }

    /// Replications of a point follow one another.
    pub fn run(&self, index: usize) -> RunNumber {
        let replications = self.replications as usize;
        RunNumber { point: index / replications, replication: (index % replications) as u32 }
    }

    pub fn index(&self, run: RunNumber) -> usize {
        run.point * self.replications as usize + run.replication as usize
    }

    /// The layout changes slowest, then the first axis, and how late devices answer fastest.
    pub fn point(&self, index: usize) -> Point {
        let mut rest = index;
        let mut digit = |size: usize| {
            let digit = rest % size;
            rest /= size;
            digit
        };
        let delay = digit(self.delays.len().max(1));
        let order = digit(self.orders.len().max(1));
        let mut values: Vec<usize> = self.axes.iter().rev().map(|axis| digit(axis.values.len())).collect();
        values.reverse();
        Point { layout: digit(self.layouts.len()), values, order, delay }
    }

    /// Where a point is in the list of each of [`super::page::names`].
    pub fn indices(&self, point: &Point) -> Vec<usize> {
        let orders = (!self.orders.is_empty()).then_some(point.order);
        let delays = (!self.delays.is_empty()).then_some(point.delay);
        let values = point.values.iter().copied();
        [point.layout].into_iter().chain(values).chain(orders).chain(delays).collect()
    }

    /// Whether rows are means of several runs.
    pub fn has_means(&self) -> bool {
        self.replications > 1
    }

    /// What names a point in JSON.
    pub fn names(&self, point: &Point) -> Map<String, Value> {
        let set: Map<String, Value> = (self.axes.iter().zip(&point.values))
            .map(|(axis, &value)| (axis.name.clone(), written(&axis.values[value])))
            .collect();
        let delay = self.delays.get(point.delay).map_or("0", String::as_str);
        let names = [
            ("layout", json!(self.layouts[point.layout])),
            ("set", Value::Object(set)),
            ("order_seed", json!(self.orders.get(point.order))),
            ("io_delay", json!(delay)),
        ];
        names.into_iter().map(|(key, value)| (key.into(), value)).collect()
    }

    pub fn to_json(&self) -> Map<String, Value> {
        let axes: Vec<Value> =
            self.axes.iter().map(|axis| json!({ "name": axis.name, "values": axis.values })).collect();
        let design = [
            ("layouts", json!(self.layouts)),
            (
                "asked",
                json!(Asked::NAMES.iter().find(|(asked, _)| *asked == self.asked).map(|(_, name)| name)),
            ),
            ("set", Value::Array(axes)),
            ("order", json!(self.orders)),
            ("io_delay", json!(self.delays)),
            ("replications", json!(self.replications)),
            ("warm_up", json!(self.warm_up.map(|warm_up| warm_up.to_string()))),
        ];
        design.into_iter().map(|(key, value)| (key.into(), value)).collect()
    }

    /// What [`Self::to_json`] gave; `None` for anything else, and if the runs cannot be counted.
    pub fn from_json(json: &Value) -> Option<Self> {
        let texts = |json: &Value| -> Option<Vec<String>> {
            json.as_array()?.iter().map(|text| Some(text.as_str()?.to_string())).collect()
        };
        let axis = |json: &Value| {
            Some(Axis { name: json["name"].as_str()?.into(), values: texts(&json["values"])? })
        };
        let warm_up = match &json["warm_up"] {
            Value::Null => None,
            text => Some(WarmUp::parse(text.as_str()?)?),
        };
        let design = Self {
            layouts: texts(&json["layouts"])?,
            asked: Asked::NAMES.iter().find(|(_, name)| json["asked"] == *name)?.0,
            axes: json["set"].as_array()?.iter().map(axis).collect::<Option<_>>()?,
            orders: json["order"].as_array()?.iter().map(Value::as_u64).collect::<Option<_>>()?,
            delays: texts(&json["io_delay"])?,
            replications: u32::try_from(json["replications"].as_u64()?).ok()?,
            warm_up,
            precision: None,
        };
        (design.runs()? > 0).then_some(design)
    }
}

/// A value as JSON; a bare word is a text.
fn written(value: &str) -> Value {
    serde_json::from_str(value).unwrap_or_else(|_| json!(value))
}
