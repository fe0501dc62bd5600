//! Runs whose controllers may do the same are made together, some of them before their turn.

use super::super::controllers::Notice;
use super::design::{Design, RunNumber};
use super::interval::Sample;
use super::outcome::Outcome;
use super::plan::Plan;
use super::point::{self, Ran};
use std::collections::{BTreeMap, BTreeSet};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Points after that of a run among which others are looked for.
const POINTS_AHEAD: usize = 256;
/// Runs that are made together, and their machines in all: each may come to need a plant of its own.
const MOST_RUNS: usize = 16;
const MOST_MACHINES: usize = 2000;
/// Runs before their turn.
const MOST_EARLY: usize = 20_000;

/// Runs of lines with so many machines that are made together; one at least.
pub fn most_runs(machines: usize) -> usize {
    (MOST_MACHINES / machines.max(1)).clamp(1, MOST_RUNS)
}

/// The runs of a sweep. They are begun in the order of their indices, but for those that are made with an earlier one.
pub struct Together<'a> {
    pub plan: &'a Plan,
    /// Threads that make runs.
    pub jobs: usize,
    runs: Mutex<Runs>,
}

/// How far they are.
#[derive(Default)]
struct Runs {
    /// Of those that are asked for, so many have not been begun.
    left: usize,
    /// All before this one were taken, or nobody will ask for them.
    taken: usize,
    /// All before this one were begun, or will never be.
    next: usize,
    /// Those from there on that were begun too.
    early: BTreeSet<usize>,
    /// What has come of runs that nobody has taken yet.
    known: BTreeMap<usize, Outcome>,
    /// By point: what comes of each of its replications.
    same: BTreeMap<usize, Outcome>,
    /// So many are known, and those of `same` that were taken.
    made: usize,
}

impl<'a> Together<'a> {
    /// Of `asked` runs at most anybody will ask.
    pub fn new(plan: &'a Plan, asked: usize, jobs: usize) -> Self {
        Self { plan, jobs, runs: Mutex::new(Runs { left: asked, ..Runs::default() }) }
    }

    fn runs(&self) -> MutexGuard<'_, Runs> {
        // Nothing panics while it is locked.
        self.runs.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Runs that were made so far.
    pub fn made(&self) -> usize {
        self.runs().made
    }

    /// Begins a run, with a greater index than the one before; false, if it was begun with an earlier one, or what comes of
    /// it is known.
    pub fn begin(&self, index: usize) -> bool {
        self.runs().begin(index, self.plan.design.run(index).point)
    }

    /// Makes a run that was begun, and others with it. `is_asked` says of which, by their indices, anybody will ask.
    pub fn make(&self, index: usize, is_asked: impl Fn(usize) -> bool, notice: Notice) {
        let number = self.plan.design.run(index);
        if self.runs().same.contains_key(&number.point) {
            return;
        }
        // What panics here does so again where it is said.
        let others = catch_unwind(AssertUnwindSafe(|| self.begin_others(number, is_asked)));
        let others = others.unwrap_or_default();
        let ran = point::outcomes(self.plan, number, &others, notice);
        let left_out: Vec<usize> = others.into_iter().filter(|other| !ran.has(*other)).collect();
        self.keep(number.replication, ran);
        for point in left_out {
            let number = RunNumber { point, ..number };
            self.keep(number.replication, point::outcomes(self.plan, number, &[], notice));
        }
    }

    fn keep(&self, replication: u32, ran: Ran) {
        let mut runs = self.runs();
        for (point, outcome) in ran.outcomes {
            if ran.is_drawn {
                runs.made += 1;
                runs.known.insert(self.plan.design.index(RunNumber { point, replication }), outcome);
            } else {
                runs.same.insert(point, outcome);
            }
        }
    }

    /// What has come of a run, whose turn it is; none if that is not known yet. Nobody asks for earlier ones again.
    pub fn take(&self, index: usize) -> Option<Outcome> {
        self.runs().take(index, self.plan.design.run(index).point)
    }

    /// Later points whose plant is that of a run, and of which it begins the same replication.
    fn begin_others(&self, number: RunNumber, is_asked: impl Fn(usize) -> bool) -> Vec<usize> {
        let design = &self.plan.design;
        let point = design.point(number.point);
        let line = &self.plan.lines[point.layout];
        let order = design.orders.get(point.order).copied();
        let Ok(made) = line.made(&point, order) else { return Vec::new() };
        let most = most_runs(made.project.plant.machines.len()) - 1;
        let points = self.plan.runs / design.replications as usize;
        let later = number.point + 1..points.min(number.point + 1 + POINTS_AHEAD);
        let alike = later.filter(|later| {
            let later = design.point(*later);
            (later.layout, later.order, later.delay) == (point.layout, point.order, point.delay)
        });
        let run = |point: usize| RunNumber { point, ..number };
        let free: Vec<usize> = {
            let runs = self.runs();
            // Others are left to other threads.
            let share = if self.jobs > 1 { runs.left / (2 * self.jobs) } else { runs.left };
            let room = MOST_EARLY.saturating_sub(runs.early.len() + runs.known.len());
            let is_free =
                |point: &usize| is_asked(design.index(run(*point))) && runs.is_free(design, run(*point));
            alike.filter(is_free).take(most.min(share).min(room)).collect()
        };
        let has_plant = |later: &usize| {
            let later = line.made(&design.point(*later), order);
            later.is_ok_and(|later| made.project.plant.has_plant_of(&later.project.plant))
        };
        let mut others: Vec<usize> = free.into_iter().filter(has_plant).collect();
        let mut runs = self.runs();
        others.retain(|point| runs.is_free(design, run(*point)));
        runs.early.extend(others.iter().map(|point| design.index(run(*point))));
        runs.left = runs.left.saturating_sub(others.len());
        others
    }
}

impl Runs {
    fn begin(&mut self, index: usize, point: usize) -> bool {
        self.next = index + 1;
        self.early = self.early.split_off(&index);
        if self.early.remove(&index) {
            return false;
        }
        self.left = self.left.saturating_sub(1);
        index >= self.taken && !self.same.contains_key(&point)
    }

    fn take(&mut self, index: usize, point: usize) -> Option<Outcome> {
        if self.known.first_key_value().is_some_and(|(known, _)| *known < index) {
            self.known = self.known.split_off(&index);
        }
        if self.same.first_key_value().is_some_and(|(same, _)| *same < point) {
            self.same = self.same.split_off(&point);
        }
        let known = self.known.remove(&index).or_else(|| {
            let same = self.same.get(&point).cloned()?;
            self.made += 1;
            Some(same)
        })?;
        self.taken = index + 1;
        Some(known)
    }

    /// Whether a run was not begun, and is needed, as far as that is known of the replications before it.
    fn is_free(&self, design: &Design, run: RunNumber) -> bool {
        let index = design.index(run);
        if index < self.next || self.early.contains(&index) || self.same.contains_key(&run.point) {
            return false;
        }
        let Some(precision) = design.precision else { return true };
        let mut figures = Sample::default();
        let before = (0..run.replication).map(|replication| RunNumber { replication, ..run });
        before.map_while(|run| self.known.get(&design.index(run))).all(|outcome| {
            outcome.figure(design.asked).into_iter().for_each(|figure| figures.take(figure));
            !precision.is_reached(&figures)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::axis::Axis;
    use super::super::design::Asked;
    use super::super::precision::Precision;
    use super::*;

    fn outcome(seconds: f64) -> Outcome {
        Outcome { finished: true, seconds_per_order: Some(seconds), ..Outcome::new(Some(1), None) }
    }

    /// Of points with twenty replications each.
    fn design(precision: Option<Precision>) -> Design {
        Design {
            layouts: vec!["line".into()],
            asked: Asked::Orders,
            axes: vec![Axis {
                name: "agv.capacity".into(),
                values: ["1", "2", "3"].map(String::from).into(),
            }],
            orders: Vec::new(),
            delays: Vec::new(),
            replications: 20,
            warm_up: None,
            precision,
        }
    }

    #[test]
    fn each_run_is_begun_once() {
        let mut runs = Runs { left: 9, early: [3, 5, 6].into(), ..Runs::default() };
        assert_eq!([0, 1, 3, 4, 5].map(|index| runs.begin(index, 0)), [true, true, false, true, false]);
        // One that is not needed is left out.
        assert!(runs.begin(8, 0));
        assert_eq!((runs.left, runs.next, runs.early.len()), (5, 9, 0));
    }

    #[test]
    fn replications_that_are_the_same_are_not_begun() {
        let mut runs = Runs { left: 60, ..Runs::default() };
        assert!(runs.begin(0, 0));
        runs.same.extend([(0, outcome(1.0)), (1, outcome(2.0))]);
        assert!((0..20).all(|index| runs.take(index, 0).is_some()));
        assert!((20..40).all(|index| runs.take(index, 1).is_some()));
        // Nobody asks for what is known of the first point any more.
        assert!(runs.same.keys().eq([&1]));
        assert!(!(1..40).any(|index| runs.begin(index, index / 20)));
        assert!(runs.begin(40, 2));
        assert_eq!((runs.made, runs.left), (40, 19));
    }

    #[test]
    fn only_what_was_not_begun_and_is_needed_is_free() {
        let mut runs = Runs { next: 3, early: [21].into(), ..Runs::default() };
        runs.same.insert(2, outcome(60.0));
        let is_free = |runs: &Runs, design: &Design, point, replication| {
            runs.is_free(design, RunNumber { point, replication })
        };
        let all = design(None);
        let free = [(0, 2), (0, 3), (1, 1), (1, 2), (2, 0)]
            .map(|(point, replication)| is_free(&runs, &all, point, replication));
        assert_eq!(free, [false, true, false, true, false]);
        // Five runs that come to the same are as precise as they can be.
        runs.known.extend((20..25).map(|index| (index, outcome(60.0))));
        assert!(is_free(&runs, &all, 1, 7));
        let precise = design(Precision::parse("1%"));
        assert!(!is_free(&runs, &precise, 1, 7));
        assert!(is_free(&runs, &precise, 1, 4));
    }

    #[test]
    fn what_is_known_is_taken_in_order() {
        let mut runs = Runs::default();
        runs.known.extend([(0, outcome(1.0)), (7, outcome(7.0)), (25, outcome(25.0))]);
        runs.same.extend([(0, outcome(0.5)), (2, outcome(2.0))]);
        assert_eq!(runs.take(7, 0), Some(outcome(7.0)));
        assert_eq!(runs.take(8, 0), Some(outcome(0.5)));
        assert_eq!(runs.take(24, 1), None);
        assert_eq!(runs.take(25, 1), Some(outcome(25.0)));
        assert_eq!(runs.take(45, 2), Some(outcome(2.0)));
        assert!(runs.known.is_empty() && !runs.same.contains_key(&0));
    }
}
