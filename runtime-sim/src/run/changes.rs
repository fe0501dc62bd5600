//! What has changed in the controllers since the last scan that was executed.

use crate::hash::Hash;
use crate::image::are_same;
use crate::line::Line;
use crate::machine::Machine;

/// The last trace and the last outputs, and a hash of all changes with their scans. Times in states, and those for which
/// properties wait, are no part of it, so a scan in which nothing happens does not change it.
#[derive(Clone, Default)]
pub struct Changes {
    hash: Hash,
    /// The trace, and the outputs of all machines behind it.
    words: Vec<f64>,
    /// Words of the trace.
    of_trace: usize,
    times: Vec<Time>,
    /// Milliseconds that pass in a scan while the system runs.
    scan_ms: f64,
    /// Words that are others since the last scan that was taken; among them times that have not just gone on.
    changed: Vec<usize>,
}

/// So many words are compared before one is looked for that has changed.
const FEW: usize = 32;

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
        Self { times: stays.chain(counters).collect(), scan_ms: f64::from(line.scan_ms), ..Self::default() }
    }

    /// Takes the trace and the outputs of a scan, and says whether anything has changed since the last one that was
    /// taken, so many scans of a running system before: a word, or a time in a state that has not just gone on.
    pub fn take(&mut self, scan: u64, running: u64, trace: &[f64], outputs: &[Vec<f64>]) -> bool {
        self.changed.clear();
        if self.words.is_empty() {
            self.words.extend(trace.iter().chain(outputs.iter().flatten()));
            self.of_trace = trace.len();
            self.changed.extend(0..self.words.len());
            for (index, word) in self.words.iter().enumerate() {
                if self.times.iter().all(|time| time.word != index) {
                    self.hash.change(scan, index, *word);
                }
            }
            return !self.words.is_empty();
        }
        // Whether a time stood still is said by the last trace.
        self.take_times(running as f64 * self.scan_ms, trace);
        self.times.iter().for_each(|time| self.words[time.word] = trace[time.word]);
        self.take_words(scan, 0, trace);
        let mut first = trace.len();
        for words in outputs {
            self.take_words(scan, first, words);
            first += words.len();
        }
        !self.changed.is_empty()
    }

    /// Notes times that have not just gone on.
    fn take_times(&mut self, passed: f64, trace: &[f64]) {
        for Time { word, stopped } in &self.times {
            let last = self.words[*word];
            let stands = stopped.is_some_and(|stopped| self.words[stopped] != 0.0);
            let gone_on = match stands || last < 0.0 {
                true => last,
                false => (last + passed).min(f64::from(i32::MAX)),
            };
            if trace[*word] != gone_on {
                self.changed.push(*word);
            }
        }
    }

    /// Takes words that have changed; the first of these has this number, and times among them are known by now.
    fn take_words(&mut self, scan: u64, first: usize, words: &[f64]) {
        let known = &mut self.words[first..first + words.len()];
        for (number, (known, words)) in known.chunks_mut(FEW).zip(words.chunks(FEW)).enumerate() {
            if are_same(known, words) {
                continue;
            }
            for (offset, (last, word)) in known.iter_mut().zip(words).enumerate() {
                if last.to_bits() != word.to_bits() {
                    *last = *word;
                    let place = first + number * FEW + offset;
                    self.hash.change(scan, place, *word);
                    self.changed.push(place);
                }
            }
        }
    }

    /// Words of the trace that the last scan has changed, but for times that have just gone on.
    pub fn of_trace(&self) -> impl Iterator<Item = usize> {
        self.changed.iter().copied().filter(|word| *word < self.of_trace)
    }

    /// Whether the last scan has changed a word of the outputs, counted through all machines.
    pub fn has_changed_output(&self, word: usize) -> bool {
        // Those of the outputs follow one another behind all of the trace.
        let word = self.of_trace + word;
        let place = self.changed.partition_point(|changed| *changed < word);
        self.changed.get(place) == Some(&word)
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

#[cfg(test)]
mod tests {
    use super::*;

    /// With times at these places.
    fn changes(words: &[usize]) -> Changes {
        let times: Vec<Time> = words.iter().map(|word| Time { word: *word, stopped: None }).collect();
        Changes { times, scan_ms: 10.0, ..Changes::default() }
    }

    #[test]
    fn all_words_but_times_are_taken_in_order() {
        let traces = [
            [1.0, 0.0, 2.0, 0.0, 3.0, 4.0],
            [1.0, 10.0, 2.5, 10.0, 3.0, 4.5],
            [7.0, 20.0, 2.5, 20.0, 3.0, 4.5],
        ];
        let outputs = [[vec![5.0], vec![6.0, 7.0]], [vec![5.0], vec![6.0, 7.5]], [vec![5.0], vec![6.0, 7.5]]];
        for times in [vec![1, 3], vec![3, 1], vec![0, 1], vec![1, 3, 4, 5], Vec::new()] {
            let mut changes = changes(&times);
            let mut hash = Hash::default();
            let mut known: Vec<f64> = Vec::new();
            for (scan, (trace, outputs)) in traces.iter().zip(&outputs).enumerate() {
                changes.take(scan as u64, 1, trace, outputs);
                let words: Vec<f64> = trace.iter().chain(outputs.iter().flatten()).copied().collect();
                for (place, word) in words.iter().enumerate() {
                    if !times.contains(&place) && known.get(place) != Some(word) {
                        hash.change(scan as u64, place, *word);
                    }
                }
                known = words;
                assert_eq!(changes.hash(), hash.value(), "scan {scan}, times {times:?}");
                assert_eq!(changes.trace(), known);
            }
        }
    }

    #[test]
    fn a_time_that_goes_on_is_no_change() {
        let mut changes = changes(&[1]);
        let outputs = [vec![5.0]];
        assert!(changes.take(0, 1, &[1.0, 0.0], &outputs));
        assert!(!changes.take(3, 3, &[1.0, 30.0], &outputs));
        assert!(changes.take(4, 1, &[1.0, 0.0], &outputs));
        assert!(changes.take(5, 1, &[2.0, 10.0], &outputs));
    }
}
