//! The paths that could be taken, the quickest first.

use super::line::Line;
use super::plane::Start;
use super::timing::{Lift, Timing};
use super::{CLEARS, Candidate, Effort, Planner, TURNINGS, Task, Turning, Vertical, axis};
use crate::kinematics::gantry::Stance;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::sync::Arc;

/// One of the paths: by numbers of the candidate, of how far the robot draws back, and of the rise.
#[derive(Clone, Copy)]
pub struct Choice {
    pub candidate: usize,
    back: usize,
    pub rise: usize,
    turning: Turning,
    clear: f64,
}

/// How long the torso's line of a choice is.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Length {
    /// Straight on, as if nothing was in the way.
    AtLeast,
    Known,
}

/// A queue: all choices are timed as if the torso could go straight, and what is next is timed again as it goes round
/// obstacles.
pub struct Options<'a> {
    planner: &'a Planner,
    task: &'a Task<'a>,
    first: &'a Stance,
    candidates: &'a [Candidate],
    effort: &'a Effort,
    choices: Vec<Choice>,
    /// By time, as the bits of a number that is not negative.
    queue: BinaryHeap<Reverse<(u64, usize, Length)>>,
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
            choices: Vec::new(),
            queue: BinaryHeap::new(),
            starts: effort.backs.iter().map(|[back, _]| start(*back)).collect(),
            falls: BTreeMap::new(),
            lines: BTreeMap::new(),
            first_lifts,
            last_lifts: last_lifts(planner, task, candidates),
        };
        for candidate in 0..candidates.len() {
            let length = options.least_length(candidate);
            for back in 0..effort.backs.len() {
                for rise in 0..task.rises.len() {
                    for (turning, clear) in TURNINGS.into_iter().flat_map(|t| CLEARS.map(|clear| (t, clear)))
                    {
                        let choice = Choice { candidate, back, rise, turning, clear };
                        if let Some(timing) = options.timing(&choice, length) {
                            let number = options.choices.len();
                            options.queue.push(Reverse((timing.end.to_bits(), number, Length::AtLeast)));
                            options.choices.push(choice);
                        }
                    }
                }
            }
        }
        options
    }

    /// The next one in time whose end is free, with the line of the torso's axis and how the tool is lowered.
    pub fn next(&mut self) -> Option<(Choice, Timing, Arc<Line>, Vertical)> {
        loop {
            let Reverse((_, number, length)) = self.queue.pop()?;
            let choice = self.choices[number];
            let Some(fall) = self.fall(&choice) else { continue };
            let Some(line) = self.line(&choice) else { continue };
            let timing = self.timing(&choice, line.length())?;
            if length == Length::Known {
                return Some((choice, timing, line, fall));
            }
            self.queue.push(Reverse((timing.end.to_bits(), number, Length::Known)));
        }
    }

    fn fall(&mut self, choice: &Choice) -> Option<Vertical> {
        let (planner, task, candidate) = (self.planner, self.task, &self.candidates[choice.candidate]);
        let fall = || {
            let rise = &task.rises[choice.rise];
            planner.is_free_at_place(candidate).then(|| planner.fall(task, candidate, rise)).flatten()
        };
        *self.falls.entry((choice.candidate, choice.rise)).or_insert_with(fall)
    }

    fn timing(&self, choice: &Choice, length: f64) -> Option<Timing> {
        let Choice { candidate, rise, turning, clear, .. } = *choice;
        let stance = &self.candidates[candidate].stance;
        let lifts = [self.first_lifts[rise].as_ref()?, self.last_lifts[candidate][rise].as_ref()?];
        Some(Timing::new(length, [self.first, stance], lifts, clear, turning, self.task.limits))
    }

    fn line(&mut self, choice: &Choice) -> Option<Arc<Line>> {
        let (planner, task, candidates) = (self.planner, self.task, self.candidates);
        let back = self.effort.backs[choice.back];
        let start = self.starts[choice.back].as_mut()?;
        let line = || planner.line(task.from, start, &candidates[choice.candidate].over, back);
        self.lines.entry((choice.candidate, choice.back)).or_insert_with(line).clone()
    }

    /// Rounded corners are short cuts: no line is shorter than straight on.
    fn least_length(&self, candidate: usize) -> f64 {
        let [from, to] = [self.task.from, &self.candidates[candidate].over].map(axis);
        (to - from).length()
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
