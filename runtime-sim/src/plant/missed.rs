//! Commands of a machine that ended in an error of reach or gripped nothing, and why.

/// Different ones that are remembered: a line that tries on for a day needs no more memory.
const MOST: usize = 50;
/// Times that are remembered.
const MOST_TIMES: usize = 1_000;

/// The same command that ended for the same reason.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The number of the command on the device.
    pub command: i32,
    /// In which it ended.
    pub error: i32,
    /// What of, with the place.
    pub reason: String,
    pub count: u32,
    pub first_ms: u64,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct MissedCommands {
    entries: Vec<Entry>,
    /// When, ms from the start of the run, and which entry.
    times: Vec<(u64, usize)>,
}

impl MissedCommands {
    pub fn add(&mut self, command: i32, error: i32, reason: String, at_ms: u64) {
        let is_same =
            |entry: &Entry| (entry.command, entry.error, &entry.reason) == (command, error, &reason);
        let number = match self.entries.iter().position(is_same) {
            Some(known) => {
                self.entries[known].count = self.entries[known].count.saturating_add(1);
                known
            }
            None if self.entries.len() < MOST => {
                self.entries.push(Entry { command, error, reason, count: 1, first_ms: at_ms });
                self.entries.len() - 1
            }
            None => return,
        };
        if self.times.len() < MOST_TIMES {
            self.times.push((at_ms, number));
        }
    }

    /// In the order of their first times.
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// In the order of time.
    pub fn times(&self) -> impl Iterator<Item = (u64, &Entry)> {
        self.times.iter().map(|(at_ms, number)| (*at_ms, &self.entries[*number]))
    }
}
