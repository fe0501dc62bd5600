//! What a person operates, as the scenario says.

use super::Start;
use super::running::milliseconds;

/// That something is operated between two times, ms from the start of the run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Operation {
    from_ms: u64,
    /// None: to the end of the run.
    until_ms: Option<u64>,
    value: f64,
}

/// Everything that is done to one part, by time.
#[derive(Clone, Debug)]
pub struct Operations {
    all: Vec<Operation>,
}

impl Operations {
    pub fn of(start: &Start) -> Self {
        let mine = |at: &&crate::line::Operation| at.machine == start.machine && at.part == start.part;
        let all = start.line.scenario.operations.iter().filter(mine).map(|operation| Operation {
            from_ms: milliseconds(operation.at_s),
            until_ms: operation.for_s.map(|for_s| milliseconds(operation.at_s + for_s)),
            value: operation.value,
        });
        Self { all: all.collect() }
    }

    /// The value of the last operation that holds at this time.
    pub fn value(&self, now_ms: u64) -> Option<f64> {
        let holds = |o: &&Operation| o.from_ms <= now_ms && o.until_ms.is_none_or(|until| now_ms < until);
        self.all.iter().filter(holds).max_by_key(|operation| operation.from_ms).map(|o| o.value)
    }

    /// When one begins or ends after this time, ms; infinity: never.
    pub fn next_change(&self, now_ms: u64) -> f64 {
        let times = self.all.iter().flat_map(|o| [Some(o.from_ms), o.until_ms]).flatten();
        times.filter(|time| *time > now_ms).min().map_or(f64::INFINITY, |time| time as f64)
    }
}
