//! Alarms, and the waiting times of properties.

use crate::types::Fault;

/// An entry of the table of alarms: one place of the text, of one robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alarm {
    /// Its `alarm_code` and its text.
    pub cause: Fault,
    /// Its cause is present.
    pub active: bool,
    /// It has been acknowledged: a rising edge of `reset` acknowledges all alarms.
    pub acknowledged: bool,
    /// How often it was raised.
    pub count: i32,
    /// Scans since power-up in which it was raised first and last, if it was.
    pub first: i32,
    pub last: i32,
}

impl Alarm {
    pub const fn new(cause: Fault) -> Self {
        Self { cause, active: false, acknowledged: true, count: 0, first: 0, last: 0 }
    }

    /// It is shown: it is active or not acknowledged.
    pub fn is_open(&self) -> bool {
        self.active || !self.acknowledged
    }

    /// Updates the alarm: whether its cause is present in this scan. Returns whether it was raised now.
    pub fn note(&mut self, active: bool, scan: i32) -> bool {
        let raised = active && !self.active;
        self.active = active;
        if raised {
            if self.count == 0 {
                self.first = scan;
            }
            self.last = scan;
            self.count = self.count.saturating_add(1);
            self.acknowledged = false;
        }
        raised
    }
}

/// The waiting time for a goal in milliseconds, from the scan with the trigger; -1 without waiting.
pub fn waited(before: i32, trigger: bool, goal: bool, scan_ms: i32) -> i32 {
    if goal {
        -1
    } else if before >= 0 {
        before.saturating_add(scan_ms)
    } else if trigger {
        0
    } else {
        -1
    }
}
