//! What a machine has in the trace: its cells, and what properties and operating modes keep: counters, alarms, whether it is
//! stopped.

use std::ops::Range;

/// Words are those of [`crate::scan::Controllers::trace`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Monitor {
    /// 1 while the machine is stopped by an alarm or at its panel; none if nothing stops it.
    pub stopped: Option<usize>,
    /// What other machines may read or write too.
    pub cells: Range<usize>,
    pub counters: Vec<Counter>,
    pub alarms: Vec<Alarm>,
    /// Words of the machine's inputs that its operating modes read, whether the line runs or not.
    pub panel: Vec<usize>,
}

/// For how long something has been waited for, ms; negative while it is not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counter {
    pub word: usize,
    /// When it matters, ms; none: at any time.
    pub limit: Option<u32>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Alarm {
    pub code: i32,
    /// The first of its words: active, acknowledged, count, scan of the first raise, scan of the last.
    pub word: usize,
}

/// Words of an alarm.
pub const ALARM_WORDS: usize = 5;

impl Monitor {
    /// Whether the same words say the same; limits of times may differ.
    pub(crate) fn has_same_words(&self, other: &Self) -> bool {
        let Self { stopped, cells, counters, alarms, panel } = self;
        let words = |counters: &[Counter]| counters.iter().map(|counter| counter.word).collect::<Vec<_>>();
        (stopped, cells, alarms, panel) == (&other.stopped, &other.cells, &other.alarms, &other.panel)
            && words(counters) == words(&other.counters)
    }

    pub fn is_stopped(&self, trace: &[f64]) -> bool {
        self.stopped.and_then(|word| trace.get(word)).is_some_and(|stopped| *stopped != 0.0)
    }
}
