//! The paths that could be taken, the quickest first.

use super::line::Line;
use super::plane::Start;
use super::timing::{Lift, Timing};
use super::{CLEARS, Candidate, Effort, Planner, TURNINGS, Task, Turning, Vertical, axis};
use crate::kinematics::gantry::Stance;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::sync::Arc;

/// Choices of a trip; none takes less time than the first one.
const MOTIONS: usize = TURNINGS.len() * CLEARS.len();
/// What is rounded in a time, as a part of it.
const ROUNDED: f64 = 1e-12;

/// One of the paths on a trip: by numbers of the candidate and of the rise.
#[derive(Clone, Copy)]
pub struct Choice {
    pub candidate: usize,
    pub rise: usize,
    turning: Turning,
    clear: f64,
}

/// What stands in the queue: the number of a trip, or of a choice among those of all trips.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Timed {
    /// No choice of the trip takes less, as if its torso could go straight.
    Straight(usize),
    /// The same with the torso round the obstacles.
    Trip(usize),
    Choice(usize),
}

/// Choices that differ only in when tool and torso move.
#[derive(Clone, Copy)]
struct Trip {
    candidate: usize,
    back: usize,
    rise: usize,
}

/// A queue: trips are timed by the choice that takes the least, as if the torso could go straight; what is next is timed
/// again as it goes round obstacles, and then choice by choice.
pub struct Options<'a> {
    planner: &'a Planner,
    task: &'a Task<'a>,
    first: &'a Stance,
    candidates: &'a [Candidate],
    effort: &'a Effort,
    trips: Vec<Trip>,
    /// By time, as the bits of a number that is not negative.
    queue: BinaryHeap<Reverse<(u64, Timed)>>,
    /// Where the torso is when it has drawn back at the beginning; none beyond the ends of the rails.
    starts: Vec<Option<Start>>,
    /// How the tool is lowered to a candidate, from the top of a rise; none if something is in the way there or at its end.
    falls: BTreeMap<(usize, usize), Option<Vertical>>,
    lines: BTreeMap<(usize, usize), Option<Arc<Line>>>,
    /// By rise.
    first_lifts: Vec<Option<Arc<Lift>>>,
    /// By candidate and rise. Those that are as far beyond the shoulder have the same: the turn of the torso does not matter.
    last_lifts: Vec<Vec<Option<Arc<Lift>>>>,
}

impl Trip {
    /// By its number below [`MOTIONS`].
    fn choice(&self, motion: usize) -> Choice {
        let Self { candidate, rise, .. } = *self;
        let (turning, clear) = (TURNINGS[motion / CLEARS.len()], CLEARS[motion % CLEARS.len()]);
        Choice { candidate, rise, turning, clear }
    }
}

impl<'a> Options<'a> {
    /// The candidates have the same wrist.
    pub fn new(
        planner: &'a Planner,
        task: &'a Task<'a>,
        first: &'a Stance,
        candidates: &'a [Candidate],
        effort: &'a Effort,
    ) -> Self {
        let rises = task.rises.iter();
        let first_lifts = rises.map(|rise| planner.lift(task.from, rise.top, task.limits)).collect();
        let start = |back: f64| planner.drawn_back(task.from, back).map(Start::new);
        let mut options = Self {
            planner,
            task,
            first,
            candidates,
            effort,
            trips: Vec::new(),
            queue: BinaryHeap::new(),
            starts: effort.backs.iter().map(|[back, _]| start(*back)).collect(),
            falls: BTreeMap::new(),
            lines: BTreeMap::new(),
            first_lifts,
            last_lifts: last_lifts(planner, task, candidates),
        };
        for candidate in 0..candidates.len() {
            for back in 0..effort.backs.len() {
                for rise in 0..task.rises.len() {
                    options.put_straight(Trip { candidate, back, rise });
                }
            }
        }
        options
    }

    /// The next one in time whose end is free, with the line of the torso's axis and how the tool is lowered.
    pub fn next(&mut self) -> Option<(Choice, Timing, Arc<Line>, Vertical)> {
        loop {
            let Reverse((_, timed)) = self.queue.pop()?;
            match timed {
                Timed::Straight(trip) => self.put_trip(trip),
                Timed::Trip(trip) => self.put_choices(trip),
                Timed::Choice(number) => {
                    let trip = self.trips[number / MOTIONS];
                    let (Some(fall), Some(line)) = (self.fall(&trip), self.line(&trip)) else { continue };
                    let choice = trip.choice(number % MOTIONS);
                    return Some((choice, self.timing(&choice, line.length())?, line, fall));
                }
            }
        }
    }

    /// A new trip. Rounded corners are short cuts: no line is shorter than straight on.
    fn put_straight(&mut self, trip: Trip) {
        let [from, to] = [self.task.from, &self.candidates[trip.candidate].over].map(axis);
        let number = self.trips.len();
        self.trips.push(trip);
        self.put(Timed::Straight(number), &trip.choice(0), (to - from).length());
    }

    /// A trip whose end is free, round the obstacles.
    fn put_trip(&mut self, number: usize) {
        let trip = self.trips[number];
        if self.fall(&trip).is_some()
            && let Some(line) = self.line(&trip)
        {
            self.put(Timed::Trip(number), &trip.choice(0), line.length());
        }
    }

    fn put_choices(&mut self, number: usize) {
        let trip = self.trips[number];
        let Some(line) = self.line(&trip) else { return };
        for motion in 0..MOTIONS {
            self.put(Timed::Choice(number * MOTIONS + motion), &trip.choice(motion), line.length());
        }
    }

    /// By the time of a choice, with a line so long.
    fn put(&mut self, timed: Timed, choice: &Choice, length: f64) {
        let Some(Timing { end, .. }) = self.timing(choice, length) else { return };
        let least = match timed {
            Timed::Straight(_) | Timed::Trip(_) => end * (1.0 - ROUNDED),
            Timed::Choice(_) => end,
        };
        self.queue.push(Reverse((least.to_bits(), timed)));
    }

    fn fall(&mut self, trip: &Trip) -> Option<Vertical> {
        let (planner, task, candidate) = (self.planner, self.task, &self.candidates[trip.candidate]);
        let fall = || {
            let rise = &task.rises[trip.rise];
            planner.is_free_at_place(candidate).then(|| planner.fall(task, candidate, rise)).flatten()
        };
        *self.falls.entry((trip.candidate, trip.rise)).or_insert_with(fall)
    }

    fn timing(&self, choice: &Choice, length: f64) -> Option<Timing> {
        let Choice { candidate, rise, turning, clear } = *choice;
        let stance = &self.candidates[candidate].stance;
        let lifts = [self.first_lifts[rise].as_ref()?, self.last_lifts[candidate][rise].as_ref()?];
        Some(Timing::new(length, [self.first, stance], lifts, clear, turning, self.task.limits))
    }

    fn line(&mut self, trip: &Trip) -> Option<Arc<Line>> {
        let (planner, task, candidates) = (self.planner, self.task, self.candidates);
        let back = self.effort.backs[trip.back];
        let start = self.starts[trip.back].as_mut()?;
        let line = || planner.line(task.from, start, &candidates[trip.candidate].over, back);
        self.lines.entry((trip.candidate, trip.back)).or_insert_with(line).clone()
    }
}

fn last_lifts(planner: &Planner, task: &Task, candidates: &[Candidate]) -> Vec<Vec<Option<Arc<Lift>>>> {
    let mut all: Vec<Vec<Option<Arc<Lift>>>> = Vec::with_capacity(candidates.len());
    for candidate in candidates {
        let beyond = candidate.stance.beyond.to_bits();
        let alike = candidates[..all.len()].iter().position(|other| other.stance.beyond.to_bits() == beyond);
        let lifts = alike.map(|number| all[number].clone()).unwrap_or_else(|| {
            let end = candidate.end(task.transfer);
            task.rises.iter().map(|rise| planner.lift(&end, rise.top, task.limits)).collect()
        });
        all.push(lifts);
    }
    all
}
