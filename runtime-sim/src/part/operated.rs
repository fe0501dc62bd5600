//! What a person operates, as the scenario says.

use super::running::milliseconds;
use super::{Progress, Running, See, Start, World};

/// What a person can do to a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operated {
    Press,
    SetNumber,
}

/// That something is operated between two times, ms from the start of the run.
#[derive(Clone, Copy, Debug)]
struct Operation {
    from_ms: u64,
    /// None: to the end of the run.
    until_ms: Option<u64>,
    value: f64,
}

/// A part whose only signal is what a person has set.
#[derive(Clone, Debug)]
pub struct Operating {
    operations: Vec<Operation>,
    /// While nobody operates it.
    begins: f64,
    now_ms: u64,
}

impl Operating {
    /// `shown` is the signal for a value of the scenario.
    pub fn new(start: &Start, begins: f64, shown: impl Fn(f64) -> f64) -> Self {
        let mine = |at: &&crate::line::Operation| at.machine == start.machine && at.part == start.part;
        let operations = start.line.scenario.operations.iter().filter(mine).map(|operation| Operation {
            from_ms: milliseconds(operation.at_s),
            until_ms: operation.for_s.map(|for_s| milliseconds(operation.at_s + for_s)),
            value: shown(operation.value),
        });
        Self { operations: operations.collect(), begins, now_ms: 0 }
    }

    /// That of the last operation that holds.
    fn value(&self) -> f64 {
        let now_ms = self.now_ms;
        let holds = |o: &&Operation| o.from_ms <= now_ms && o.until_ms.is_none_or(|until| now_ms < until);
        let last = self.operations.iter().filter(holds).max_by_key(|operation| operation.from_ms);
        last.map_or(self.begins, |operation| operation.value)
    }
}

impl Running for Operating {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    fn advance(&mut self, world: &mut World) -> Progress {
        self.now_ms = world.next_ms();
        Progress::Going
    }

    /// An operation begins or ends.
    fn next_change(&self, _see: &See, now_ms: u64) -> f64 {
        let times = self.operations.iter().flat_map(|o| [Some(o.from_ms), o.until_ms]).flatten();
        times.filter(|time| *time > now_ms).min().map_or(f64::INFINITY, |time| time as f64)
    }

    fn is_busy(&self, see: &See) -> bool {
        self.next_change(see, self.now_ms).is_finite()
    }

    fn signal(&self, _signal: usize, _see: &See, out: &mut [f64]) {
        out[0] = self.value();
    }
}
