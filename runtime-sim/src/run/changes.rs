//! What has changed in the controllers since the last scan that was executed.

use crate::hash::Hash;

/// The last trace and the last outputs, and a hash of all changes with their scans. Times in states are no part of
/// it, so a scan in which nothing happens does not change it.
#[derive(Default)]
pub struct Changes {
    hash: Hash,
    words: Vec<f64>,
    /// Which words of the trace are times in states.
    is_stay: Vec<bool>,
    /// Milliseconds that pass in a scan while the system runs.
    scan_ms: f64,
}

impl Changes {
    pub fn new(stays: &[usize], scan_ms: u32) -> Self {
        let mut is_stay = vec![false; stays.iter().max().map_or(0, |last| last + 1)];
        stays.iter().for_each(|word| is_stay[*word] = true);
        Self { is_stay, scan_ms: f64::from(scan_ms), ..Self::default() }
    }

    /// Takes the trace and the outputs of a scan, and says whether anything has changed since the last one that was
    /// taken, so many scans of a running system before: a word, or a time in a state that has not just gone on.
    pub fn take(&mut self, scan: u64, running: u64, trace: &[f64], outputs: &[Vec<f64>]) -> bool {
        let passed = running as f64 * self.scan_ms;
        let mut changed = false;
        let all = trace.iter().chain(outputs.iter().flatten());
        for (index, word) in all.enumerate() {
            let Some(last) = self.words.get_mut(index) else {
                self.words.push(*word);
                changed = true;
                if !self.is_stay.get(index).is_some_and(|is| *is) {
                    self.hash.change(scan, index, *word);
                }
                continue;
            };
            if self.is_stay.get(index).is_some_and(|is| *is) {
                let gone_on = (*last + passed).min(f64::from(i32::MAX));
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

    /// Time in its state of the machine whose stay is at this place of the trace, ms.
    pub fn stay(&self, word: usize) -> f64 {
        self.words.get(word).copied().unwrap_or(0.0)
    }

    pub fn hash(&self) -> u64 {
        self.hash.value()
    }
}
