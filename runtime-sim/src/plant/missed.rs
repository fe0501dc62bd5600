//! Commands of a machine that ended in an error of reach or gripped nothing, and why.

use std::fmt::{self, Display, Formatter};

/// Different ones of each error that are remembered: a line that tries on for a day needs no more memory.
const MOST: usize = 50;
/// Times that are remembered.
const MOST_TIMES: usize = 1_000;

/// Why a command ended in an error.
#[derive(Clone, Debug, PartialEq)]
pub struct Reason {
    /// With the place: commands of which this is the same count as one.
    pub what: String,
    /// How it was that time; empty if that is all.
    pub details: String,
}

/// The same command that ended for the same reason.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The number of the command on the device.
    pub command: i32,
    /// In which it ended.
    pub error: i32,
    /// Of the first time.
    pub reason: Reason,
    pub count: u32,
    pub first_ms: u64,
}

/// One of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Time {
    pub at_ms: u64,
    pub error: i32,
    pub reason: Reason,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct MissedCommands {
    entries: Vec<Entry>,
    times: Vec<Time>,
}

impl MissedCommands {
    pub fn add(&mut self, command: i32, error: i32, reason: Reason, at_ms: u64) {
        if self.times.len() < MOST_TIMES {
            self.times.push(Time { at_ms, error, reason: reason.clone() });
        }
        let is_same = |entry: &&mut Entry| {
            (entry.command, entry.error, &entry.reason.what) == (command, error, &reason.what)
        };
        if let Some(known) = self.entries.iter_mut().find(is_same) {
            known.count = known.count.saturating_add(1);
        } else if self.entries.iter().filter(|entry| entry.error == error).count() < MOST {
            self.entries.push(Entry { command, error, reason, count: 1, first_ms: at_ms });
        }
    }

    /// In the order of their first times.
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// In the order of time.
    pub fn times(&self) -> &[Time] {
        &self.times
    }
}

impl Display for Reason {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.what)?;
        if self.details.is_empty() { Ok(()) } else { write!(f, ": {}", self.details) }
    }
}
