//! What has changed in the controllers since the last scan that was executed.

use crate::hash::Hash;
use crate::line::Line;
use crate::machine::Machine;

/// The last trace and the last outputs, and a hash of all changes with their scans. Times in states, and those for which
/// properties wait, are no part of it, so a scan in which nothing happens does not change it.
#[derive(Default)]
pub struct Changes {
    hash: Hash,
    words: Vec<f64>,
    times: Vec<Time>,
    /// Whether each word of the trace is one of them, as far as the last.
    is_time: Vec<bool>,
    /// Milliseconds that pass in a scan while the system runs.
    scan_ms: f64,
}

/// A word of the trace that is a time in a state, or one for which a property waits. It is at rest while the word at the
/// second place says that the machine is stopped.
#[derive(Clone, Copy)]
struct Time {
    word: usize,
    stopped: Option<usize>,
}

impl Changes {
    /// `stays` are the words of the times in states, by machine.
    pub fn new(stays: &[usize], line: &Line) -> Self {
        let stays = stays.iter().enumerate().map(|(machine, word)| {
            let machine = line.machines.get(machine);
            Time { word: *word, stopped: machine.and_then(|machine| machine.monitor.stopped) }
        });
        let counters = line.machines.iter().flat_map(|Machine { monitor, .. }| {
            monitor.counters.iter().map(|counter| Time { word: counter.word, stopped: monitor.stopped })
        });
        let times: Vec<Time> = stays.chain(counters).collect();
        let mut is_time = vec![false; times.iter().map(|time| time.word + 1).max().unwrap_or(0)];
        times.iter().for_each(|time| is_time[time.word] = true);
        Self { times, is_time, scan_ms: f64::from(line.scan_ms), ..Self::default() }
    }

    /// Takes the trace and the outputs of a scan, and says whether anything has changed since the last one that was
    /// taken, so many scans of a running system before: a word, or a time in a state that has not just gone on.
    pub fn take(&mut self, scan: u64, running: u64, trace: &[f64], outputs: &[Vec<f64>]) -> bool {
        if self.words.is_empty() {
            self.words.extend(trace.iter().chain(outputs.iter().flatten()));
            for (index, word) in self.words.iter().enumerate() {
                if self.is_time.get(index) != Some(&true) {
                    self.hash.change(scan, index, *word);
                }
            }
            return !self.words.is_empty();
        }
        // Whether a time stood still is said by the last trace.
        let mut changed = self.take_times(running as f64 * self.scan_ms, trace);
        let mut first = 0;
        for words in [trace].into_iter().chain(outputs.iter().map(Vec::as_slice)) {
            changed |= self.take_words(scan, first, words);
            first += words.len();
        }
        changed
    }

    /// Whether a time has not just gone on.
    fn take_times(&mut self, passed: f64, trace: &[f64]) -> bool {
        let went_otherwise = |Time { word, stopped }: &Time| {
            let last = self.words[*word];
            let stands = stopped.is_some_and(|stopped| self.words[stopped] != 0.0);
            let gone_on = match stands || last < 0.0 {
                true => last,
                false => (last + passed).min(f64::from(i32::MAX)),
            };
            trace[*word] != gone_on
        };
        self.times.iter().any(went_otherwise)
    }

    /// Whether one of these words has changed that is no time; the first of them has this number.
    fn take_words(&mut self, scan: u64, first: usize, words: &[f64]) -> bool {
        let mut changed = false;
        let known = &mut self.words[first..first + words.len()];
        for (offset, (last, word)) in known.iter_mut().zip(words).enumerate() {
            if last.to_bits() == word.to_bits() {
                continue;
            }
            *last = *word;
            if self.is_time.get(first + offset) != Some(&true) {
                changed = true;
                self.hash.change(scan, first + offset, *word);
            }
        }
        changed
    }

    /// Time in its state of the machine whose stay is at this place of the trace, ms.
    pub fn stay(&self, word: usize) -> f64 {
        self.words.get(word).copied().unwrap_or(0.0)
    }

    /// The trace of the last scan that was taken.
    pub fn trace(&self) -> &[f64] {
        &self.words
    }

    pub fn hash(&self) -> u64 {
        self.hash.value()
    }
}
