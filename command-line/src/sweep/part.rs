//! Which runs of a sweep a part has.

use runtime_sim::random::Random;
use std::fmt;

/// Most parts of a sweep: a merge has the files of all open at the same time.
pub const MOST_PARTS: usize = 1000;

/// One of several parts, from 0. Each run is in exactly one of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    number: usize,
    of: usize,
}

impl Part {
    /// `K/N`: part K of N, from 1.
    pub fn parse(text: &str) -> Option<Self> {
        let (number, of) = text.split_once('/')?;
        Self::new(number.parse().ok()?, of.parse().ok()?)
    }

    /// Part `number` of `of`, from 1.
    pub fn new(number: usize, of: usize) -> Option<Self> {
        ((1..=MOST_PARTS).contains(&of) && (1..=of).contains(&number))
            .then(|| Self { number: number - 1, of })
    }

    /// From 1.
    pub fn number(self) -> usize {
        self.number + 1
    }

    /// Parts of the sweep.
    pub fn of(self) -> usize {
        self.of
    }

    /// The indices of its runs, of `count` of the sweep, in their order. They differ by one at most in number from those
    /// of another part.
    pub fn runs(self, count: usize) -> impl Iterator<Item = usize> {
        let lots = 0..count.div_ceil(self.of);
        lots.map(move |lot| lot * self.of + (self.number + self.of - turn(lot, self.of)) % self.of)
            .filter(move |run| *run < count)
    }

    pub fn has(self, run: usize) -> bool {
        Self::having(run, self.of) == self.number
    }

    /// Number, from 0, of the part that has this run.
    pub fn having(run: usize, of: usize) -> usize {
        (run % of + turn(run / of, of)) % of
    }
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}/{}", self.number(), self.of)
    }
}

/// By how much a lot of as many runs as there are parts is turned before it is dealt out, a run to each part. Were it
/// not, a part would get the same value of an axis again and again, maybe the slowest.
fn turn(lot: usize, of: usize) -> usize {
    (Random::new(lot as u64).next_u64() % of as u64) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_is_a_number_of_a_number() {
        assert_eq!(Part::parse("2/8").map(|part| part.to_string()).as_deref(), Some("2/8"));
        for text in ["", "2", "/", "0/8", "9/8", "1/0", "1/1001", "-1/8", "1/8/2", "1/99999999999999999999"] {
            assert_eq!(Part::parse(text), None, "{text}");
        }
    }

    #[test]
    fn each_run_is_in_exactly_one_part() {
        for (count, of) in [(0, 3), (1, 3), (7, 1), (7, 3), (100, 7), (5, 9), (64, 8)] {
            let mut dealt = vec![0; count];
            for number in 1..=of {
                let runs: Vec<usize> = Part::new(number, of).expect("a part").runs(count).collect();
                assert!(runs.is_sorted());
                assert!(
                    (count / of..=count.div_ceil(of)).contains(&runs.len()),
                    "{number} of {of}: {runs:?}"
                );
                for run in runs {
                    dealt[run] += 1;
                    assert_eq!(Part::having(run, of), number - 1);
                }
            }
            assert!(dealt.iter().all(|times| *times == 1), "{count} in {of}: {dealt:?}");
        }
    }

    #[test]
    fn no_part_gets_all_slow_runs() {
        // An axis of as many values as there are parts, each slower than the one before.
        let (count, of) = (8 * 200, 8);
        let length = |run: usize| (run % 8 + 1) as f64;
        let mean = (0..count).map(length).sum::<f64>() / of as f64;
        for number in 1..=of {
            let long: f64 = Part::new(number, of).expect("a part").runs(count).map(length).sum();
            assert!((long / mean - 1.0).abs() < 0.15, "{number}: {long} of {mean}");
        }
    }
}
