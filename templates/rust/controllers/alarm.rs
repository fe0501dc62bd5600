//! Alarms, and how long something is waited for.

use crate::types::Fault;

/// An entry of the table of alarms: one place of the text, of one robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alarm {
    /// What `alarm_code` tells of it, and what it means.
    pub cause: Fault,
    /// What raises it lasts.
    pub active: bool,
    /// It has been seen: a rising edge of `reset` acknowledges all alarms.
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

    /// It is shown: it lasts, or nobody has acknowledged it.
    pub fn is_open(&self) -> bool {
        self.active || !self.acknowledged
    }

    /// What raises it lasts or not in this scan. Says whether it was raised just now.
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

/// For how many milliseconds a goal has been waited for, -1 if it is not: from the scan with the trigger on.
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
