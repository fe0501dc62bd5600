//! The paths that could be taken, the quickest first.

use super::line::Line;
use super::timing::{Lift, Timing};
use super::{CLEARS, Candidate, Effort, Planner, TURNINGS, Task, Turning, axis};
use crate::kinematics::gantry::Stance;
use std::collections::{BTreeMap, BTreeSet};
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
    queue: BTreeSet<(u64, usize, Length)>,
    lines: BTreeMap<(usize, usize), Option<Arc<Line>>>,
    first_lifts: Vec<Option<Arc<Lift>>>,
    /// By how far the tool is beyond the shoulder, as bits, and by rise: the turn of the torso does not matter.
    last_lifts: BTreeMap<(u64, usize), Option<Arc<Lift>>>,
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
        let mut options = Self {
            planner,
            task,
            first,
            candidates,
            effort,
            choices: Vec::new(),
            queue: BTreeSet::new(),
            lines: BTreeMap::new(),
            first_lifts,
            last_lifts: BTreeMap::new(),
        };
        for candidate in 0..candidates.len() {
            let length = options.least_length(candidate);
            for back in 0..effort.backs.len() {
                for rise in 0..task.rises.len() {
                    for (turning, clear) in TURNINGS.into_iter().flat_map(|t| CLEARS.map(|clear| (t, clear)))
                    {
                        let choice = Choice { candidate, back, rise, turning, clear };
                        options.put(choice, length);
                    }
                }
            }
        }
        options
    }

    fn put(&mut self, choice: Choice, length: f64) {
        if let Some(timing) = self.timing(&choice, length) {
            self.queue.insert((timing.end.to_bits(), self.choices.len(), Length::AtLeast));
            self.choices.push(choice);
        }
    }

    /// The next one in time, with the line of the torso's axis.
    pub fn next(&mut self) -> Option<(Choice, Timing, Arc<Line>)> {
        loop {
            let (_, number, length) = self.queue.pop_first()?;
            let choice = self.choices[number];
            let Some(line) = self.line(&choice) else { continue };
            let timing = self.timing(&choice, line.length())?;
            if length == Length::Known {
                return Some((choice, timing, line));
            }
            self.queue.insert((timing.end.to_bits(), number, Length::Known));
        }
    }

    fn timing(&mut self, choice: &Choice, length: f64) -> Option<Timing> {
        let Choice { candidate, rise, turning, clear, .. } = *choice;
        let (planner, task) = (self.planner, self.task);
        let stance = &self.candidates[candidate].stance;
        let lift = self.first_lifts[rise].clone()?;
        let end = self.candidates[candidate].end(task.transfer);
        let fall = self
            .last_lifts
            .entry((stance.beyond.to_bits(), rise))
            .or_insert_with(|| planner.lift(&end, task.rises[rise].top, task.limits))
            .clone()?;
        Some(Timing::new(length, [self.first, stance], [&lift, &fall], clear, turning, task.limits))
    }

    fn line(&mut self, choice: &Choice) -> Option<Arc<Line>> {
        let (planner, task, candidates) = (self.planner, self.task, self.candidates);
        let back = self.effort.backs[choice.back];
        let known = self
            .lines
            .entry((choice.candidate, choice.back))
            .or_insert_with(|| planner.line(task.from, &candidates[choice.candidate].over, back));
        known.clone()
    }

    /// Rounded corners are short cuts: no line is shorter than straight on.
    fn least_length(&self, candidate: usize) -> f64 {
        let [from, to] = [self.task.from, &self.candidates[candidate].over].map(axis);
        (to - from).length()
    }
}
