//! What the properties of a machine keep in the trace: counters, alarms, whether the machine is stopped.

/// Words are those of [`crate::scan::Controllers::trace`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Watch {
    /// 1 while the machine is stopped by an alarm; none if no alarm stops it.
    pub stopped: Option<usize>,
    pub counters: Vec<Counter>,
    pub alarms: Vec<Alarm>,
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

impl Watch {
    pub fn is_stopped(&self, trace: &[f64]) -> bool {
        self.stopped.and_then(|word| trace.get(word)).is_some_and(|stopped| *stopped != 0.0)
    }
}
