//! How far a sweep has come, on a terminal.

use super::super::print;
use std::io::{self, IsTerminal};
use std::time::{Duration, Instant};

/// A line on standard error that is written over.
pub struct Progress {
    all: usize,
    is_wanted: bool,
    is_shown: bool,
    /// Some number has been shown.
    has_shown: bool,
    last: Instant,
}

/// Between two numbers that somebody could read.
const PAUSE: Duration = Duration::from_millis(100);

impl Progress {
    /// Shows nothing if it is not wanted, or if nobody sees it.
    pub fn new(all: usize, quiet: bool) -> Self {
        let is_wanted = !quiet && io::stderr().is_terminal();
        Self { all, is_wanted, is_shown: false, has_shown: false, last: Instant::now() }
    }

    /// So many are made.
    pub fn show(&mut self, made: usize) {
        // Rows on the same terminal would push it on, a line for each.
        if self.is_wanted && (self.last.elapsed() >= PAUSE || !self.has_shown) {
            print::err_styled(&format!("{made} of {}", self.all));
            self.last = Instant::now();
            (self.is_shown, self.has_shown) = (true, true);
        }
    }

    /// Takes the line away.
    pub fn clear(&mut self) {
        if std::mem::take(&mut self.is_shown) {
            print::err_styled("\r\x1b[K");
        }
    }
}
