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
    /// What the words of the trace are, as far as they count.
    words_are: Vec<Word>,
    /// Milliseconds that pass in a scan while the system runs.
    scan_ms: f64,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Word {
    Value,
    /// A time in a state, or one for which a property waits. It is at rest while the word at this place says that
    /// the machine is stopped.
    Time(Option<usize>),
}

impl Changes {
    /// `stays` are the words of the times in states, by machine.
    pub fn new(stays: &[usize], line: &Line) -> Self {
        let stays = stays.iter().enumerate().map(|(machine, word)| {
            (*word, line.machines.get(machine).and_then(|machine| machine.monitor.stopped))
        });
        let counters = line.machines.iter().flat_map(|Machine { monitor, .. }| {
            monitor.counters.iter().map(|counter| (counter.word, monitor.stopped))
        });
        let times: Vec<_> = stays.chain(counters).collect();
        let mut words_are = vec![Word::Value; times.iter().map(|(word, _)| word + 1).max().unwrap_or(0)];
        times.iter().for_each(|(word, stopped)| words_are[*word] = Word::Time(*stopped));
        Self { words_are, scan_ms: f64::from(line.scan_ms), ..Self::default() }
    }

    /// Takes the trace and the outputs of a scan, and says whether anything has changed since the last one that was
    /// taken, so many scans of a running system before: a word, or a time in a state that has not just gone on.
    pub fn take(&mut self, scan: u64, running: u64, trace: &[f64], outputs: &[Vec<f64>]) -> bool {
        let passed = running as f64 * self.scan_ms;
        let mut changed = false;
        let all = trace.iter().chain(outputs.iter().flatten());
        for (index, word) in all.enumerate() {
            let is_time = self.is_time(index);
            let stands = self.stands(index);
            let Some(last) = self.words.get_mut(index) else {
                self.words.push(*word);
                changed = true;
                if !is_time {
                    self.hash.change(scan, index, *word);
                }
                continue;
            };
            if is_time {
                let gone_on = match stands || *last < 0.0 {
                    true => *last,
                    false => (*last + passed).min(f64::from(i32::MAX)),
                };
                changed |= *word != gone_on;
                *last = *word;
            } else if last.to_bits() != word.to_bits() {
                *last = *word;
                changed = true;
                self.hash.change(scan, index, *word);
            }
        }
        changed
    }

    fn is_time(&self, word: usize) -> bool {
        self.words_are.get(word).is_some_and(|word| matches!(word, Word::Time(_)))
    }

    /// Whether a time stood still since the last scan: the word that says so comes behind it.
    fn stands(&self, word: usize) -> bool {
        match self.words_are.get(word) {
            Some(Word::Time(Some(stopped))) => self.words.get(*stopped).is_some_and(|is| *is != 0.0),
            _ => false,
        }
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
