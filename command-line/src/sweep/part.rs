//! Which runs of a sweep a part has.

use super::design::Design;
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

    /// The indices of its runs, of those of the sweep, in their order. Parts differ by one run at most.
    pub fn runs(self, design: &Design) -> impl Iterator<Item = usize> {
        (0..design.runs().unwrap_or(0)).filter(move |run| self.has(design, *run))
    }

    pub fn has(self, design: &Design, run: usize) -> bool {
        Self::having(design, run, self.of) == self.number
    }

    /// Number, from 0, of the part that has this run. Replications are given to parts with all their points, which are made
    /// together, as many to each part; the runs of those that are left one by one.
    pub fn having(design: &Design, run: usize, of: usize) -> usize {
        let replications = (design.replications as usize).max(1);
        let left = replications % of;
        let whole = replications - left;
        let [point, replication] = [run / replications, run % replications];
        let number = if replication < whole { replication } else { point * left + replication - whole };
        (number % of + turn(number / of, of)) % of
    }
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}/{}", self.number(), self.of)
    }
}

/// By how much as many runs as there are parts are turned before they are given out, a run to each part. Were they not, a
/// part would get the same value of an axis again and again, maybe the slowest.
fn turn(round: usize, of: usize) -> usize {
    (Random::new(round as u64).next_u64() % of as u64) as usize
}

#[cfg(test)]
mod tests {
    use super::super::axis::Axis;
    use super::super::design::{Asked, RunNumber};
    use super::*;

    #[test]
    fn a_part_is_a_number_of_a_number() {
        assert_eq!(Part::parse("2/8").map(|part| part.to_string()).as_deref(), Some("2/8"));
        for text in ["", "2", "/", "0/8", "9/8", "1/0", "1/1001", "-1/8", "1/8/2", "1/99999999999999999999"] {
            assert_eq!(Part::parse(text), None, "{text}");
        }
    }

    /// Of one axis.
    fn design(values: usize, replications: u32) -> Design {
        let values = (0..values).map(|value| value.to_string()).collect();
        Design {
            layouts: vec!["line".into()],
            asked: Asked::Orders,
            axes: vec![Axis { name: "agv.capacity".into(), values }],
            orders: Vec::new(),
            delays: Vec::new(),
            replications,
            warm_up: None,
            precision: None,
        }
    }

    fn runs(design: &Design, of: usize) -> Vec<Vec<usize>> {
        (1..=of).map(|number| Part::new(number, of).expect("a part").runs(design).collect()).collect()
    }

    #[test]
    fn each_run_is_in_exactly_one_part() {
        let all = [
            (1, 1, 3),
            (7, 1, 1),
            (7, 1, 3),
            (50, 2, 7),
            (5, 1, 9),
            (16, 4, 8),
            (18, 9, 7),
            (3, 8, 8),
            (1, 9, 4),
        ];
        for (values, replications, of) in all {
            let design = design(values, replications);
            let count = values * replications as usize;
            let mut given = vec![0; count];
            for (number, runs) in runs(&design, of).into_iter().enumerate() {
                assert!(runs.is_sorted());
                assert!(
                    (count / of..=count.div_ceil(of)).contains(&runs.len()),
                    "{number} of {of}: {runs:?}"
                );
                for run in runs {
                    given[run] += 1;
                    assert_eq!(Part::having(&design, run, of), number);
                }
            }
            assert!(given.iter().all(|times| *times == 1), "{count} in {of}: {given:?}");
        }
    }

    #[test]
    fn a_replication_of_all_points_is_in_one_part() {
        let design = design(6, 20);
        for runs in runs(&design, 8) {
            let whole: Vec<_> =
                runs.into_iter().map(|run| design.run(run)).filter(|run| run.replication < 16).collect();
            assert_eq!(whole.len(), 2 * 6);
            let has = |point, replication| whole.contains(&RunNumber { point, replication });
            assert!(whole.iter().all(|run| (0..6).all(|point| has(point, run.replication))), "{whole:?}");
        }
    }

    #[test]
    fn no_part_gets_all_slow_runs() {
        // Of an axis with as many values as there are parts, each is slower than the one before.
        let (count, of) = (8 * 200, 8);
        let length = |run: usize| (run % 8 + 1) as f64;
        let mean = (0..count).map(length).sum::<f64>() / of as f64;
        for (number, runs) in runs(&design(count, 1), of).into_iter().enumerate() {
            let long: f64 = runs.into_iter().map(length).sum();
            assert!((long / mean - 1.0).abs() < 0.15, "{number}: {long} of {mean}");
        }
    }
}
