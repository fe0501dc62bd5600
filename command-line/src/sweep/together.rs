//! Runs whose controllers may do the same are made together: what comes of the later ones is known before their turn.

use super::super::controllers::Notice;
use super::design::{Design, RunNumber};
use super::interval::Sample;
use super::outcome::Outcome;
use super::plan::Plan;
use super::point;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Points after that of a run among which others are looked for.
const AHEAD: usize = 256;
/// Runs that are made together, and their machines in all: each may come to need a plant of its own.
const MOST_RUNS: usize = 16;
const MOST_MACHINES: usize = 2000;
/// Outcomes that wait for their turn.
const MOST_WAITING: usize = 50_000;

/// Runs of lines with so many machines that are made together; one at least.
pub fn most_runs(machines: usize) -> usize {
    (MOST_MACHINES / machines.max(1)).clamp(1, MOST_RUNS)
}

/// The runs of a sweep.
pub struct Together<'a> {
    plan: &'a Plan,
    /// What has come of runs before their turn, by their indices.
    waiting: Mutex<BTreeMap<usize, Outcome>>,
    made: AtomicUsize,
}

impl<'a> Together<'a> {
    pub fn new(plan: &'a Plan) -> Self {
        Self { plan, waiting: Mutex::default(), made: AtomicUsize::new(0) }
    }

    /// Runs that were made so far.
    pub fn made(&self) -> usize {
        self.made.load(Ordering::Relaxed)
    }

    /// What comes of a run, whose turn it is. `is_asked` says of which others, by their indices, anybody will ask.
    pub fn outcome(&self, number: RunNumber, is_asked: impl Fn(usize) -> bool, notice: Notice) -> Outcome {
        if let Some(known) = self.take(number) {
            return known;
        }
        let design = &self.plan.design;
        let others = self.others(number, is_asked);
        let (outcome, others) = point::outcomes(self.plan, number, &others, notice);
        self.made.fetch_add(1 + others.len(), Ordering::Relaxed);
        let indices =
            others.into_iter().map(|(point, outcome)| (design.index(RunNumber { point, ..number }), outcome));
        self.waiting().extend(indices);
        outcome
    }

    fn waiting(&self) -> MutexGuard<'_, BTreeMap<usize, Outcome>> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What is known of a run. Of points before its own nobody will ask.
    fn take(&self, number: RunNumber) -> Option<Outcome> {
        let design = &self.plan.design;
        let mut waiting = self.waiting();
        let first = design.index(RunNumber { replication: 0, ..number });
        if waiting.first_key_value().is_some_and(|(index, _)| *index < first) {
            *waiting = waiting.split_off(&first);
        }
        waiting.remove(&design.index(number))
    }

    /// Later points of which the same replication can be made with this run.
    fn others(&self, number: RunNumber, is_asked: impl Fn(usize) -> bool) -> Vec<usize> {
        let design = &self.plan.design;
        let point = design.point(number.point);
        let line = &self.plan.lines[point.layout];
        let order = design.orders.get(point.order).copied();
        let Ok(made) = line.made(&point, order) else { return Vec::new() };
        if made.only.get().is_some() {
            return Vec::new();
        }
        let most = most_runs(made.project.plant.machines.len()) - 1;
        let points = self.plan.runs / design.replications as usize;
        let later = number.point + 1..points.min(number.point + 1 + AHEAD);
        let alike = later.filter(|later| {
            let later = design.point(*later);
            (later.layout, later.order, later.delay) == (point.layout, point.order, point.delay)
        });
        let wanted = {
            let waiting = self.waiting();
            let is_wanted = |later: &usize| {
                let run = RunNumber { point: *later, ..number };
                let index = design.index(run);
                is_asked(index) && !waiting.contains_key(&index) && is_open(design, &waiting, run)
            };
            let room = MOST_WAITING.saturating_sub(waiting.len());
            alike.filter(is_wanted).take(most.min(room)).collect::<Vec<_>>()
        };
        let has_plant = |later: &usize| {
            line.made(&design.point(*later), order).is_ok_and(|later| {
                later.only.get().is_none() && made.project.plant.has_plant_of(&later.project.plant)
            })
        };
        wanted.into_iter().filter(has_plant).collect()
    }
}

/// Whether a run is needed, as far as that is known of the replications before it.
fn is_open(design: &Design, waiting: &BTreeMap<usize, Outcome>, run: RunNumber) -> bool {
    let Some(precision) = design.precision else { return true };
    let mut figures = Sample::default();
    let before = (0..run.replication).map(|replication| RunNumber { replication, ..run });
    before.map_while(|run| waiting.get(&design.index(run))).all(|outcome| {
        outcome.figure(design.asked).into_iter().for_each(|figure| figures.take(figure));
        !precision.is_reached(&figures)
    })
}
