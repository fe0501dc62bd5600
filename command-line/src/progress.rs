//! How far a run has come, on a terminal.

use super::print;

/// Seconds of the simulation between two numbers.
const EVERY: u64 = 10;

/// A line on standard error that is written over.
pub struct Progress {
    is_wanted: bool,
    shown: u64,
}

impl Progress {
    pub fn new(is_wanted: bool) -> Self {
        Self { is_wanted, shown: 0 }
    }

    pub fn show(&mut self, seconds: u64) {
        if self.is_wanted && seconds >= self.shown + EVERY {
            self.shown = seconds;
            print::err_styled(&format!("\r{seconds} s"));
        }
    }

    pub fn end(self) {
        if self.shown > 0 {
            complain!("");
        }
    }
}
