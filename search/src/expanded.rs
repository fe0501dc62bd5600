//! What follows a run of states, found beside a store that does not change meanwhile: so several runs can be expanded at
//! the same time, and be added to the store in their order, as if one had been expanded after the other.

use crate::event::{Event, machines_of};
use crate::reached::Reached;
use crate::representative::LEFT_OUT;
use crate::store::Store;
use crate::successor::{Expander, Part, Successor};
use crate::unread::Needed;
use crate::violation::Violation;
use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// States that one processor takes at a time, at most; fewer where there are few, so that none waits long for the others.
const RUN: usize = 256;
/// The same at least.
const SHORT: usize = 4;

/// After so many successors of a state it is looked up how much memory they take.
const SUCCESSORS: u64 = 1024;

/// What follows some states, the first of which is `first`.
pub(crate) struct Expanded {
    pub first: usize,
    pub states: Vec<After>,
    steps: Vec<Step>,
    /// Successors that the store does not have, in the order in which they were found.
    pub unknown: Store,
    /// The numbers of their pieces, as far as they have one.
    codes: Vec<u8>,
    /// Of each of these: instances that may do something in the next scan even if no device does.
    pub restless: Vec<u64>,
    /// What has been found to be hardly meant: each thing once.
    remarked: Vec<Violation>,
    /// Instances with states that they have where a scan ends in a stop or a violation.
    entered: BTreeSet<(usize, usize)>,
}

/// What follows one state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct After {
    /// Where its steps end among all.
    end: usize,
    pub transitions: u64,
    pub stops: u64,
    /// Places or reals came up that had no number before.
    pub has_new_values: bool,
    /// Machines of which answers are postponed in this state.
    pub postponed: u64,
}

#[derive(Clone, Debug)]
pub(crate) enum Step {
    /// To a state of the store. `acting`: machines that did something, if answers are postponed; `is_plain`: at most one device
    /// did something, and it was no fault.
    Known {
        state: u32,
        acting: u64,
        is_plain: bool,
    },
    /// The same, to one of those that it does not have.
    Unknown {
        number: u32,
        acting: u64,
        is_plain: bool,
    },
    /// To a violation.
    Out {
        acting: u64,
    },
    /// To a stop, without a fault.
    Stop,
    Found(Box<(Violation, Vec<Event>)>),
    /// This must not be forgotten: what comes after it is not certain.
    Needs(Needed),
    /// What is hardly meant.
    Remarked(Box<(Violation, Vec<Event>)>),
    /// The scan of an instance ended in this state, and nothing follows.
    Entered {
        instance: usize,
        state: usize,
    },
}

impl Expanded {
    pub fn new(first: usize, length: usize) -> Self {
        Self {
            first,
            states: Vec::new(),
            steps: Vec::new(),
            unknown: Store::new(length),
            codes: Vec::new(),
            restless: Vec::new(),
            remarked: Vec::new(),
            entered: BTreeSet::new(),
        }
    }

    /// Nothing is known any more but what is the first state; the memory is kept.
    fn begin_anew(&mut self, first: usize) {
        let Self { first: old, states, steps, unknown, codes, restless, remarked, entered } = self;
        *old = first;
        states.clear();
        steps.clear();
        unknown.clear();
        codes.clear();
        restless.clear();
        remarked.clear();
        entered.clear();
    }

    /// Bytes of memory that it takes.
    pub fn size(&self) -> usize {
        size_of::<After>() * self.states.capacity()
            + size_of::<Step>() * self.steps.capacity()
            + size_of::<u64>() * self.restless.capacity()
            + self.codes.capacity()
            + self.unknown.size()
    }

    /// A state that the store did not have, of all that it does not have, and what it knows of it.
    pub fn unknown(&self, number: usize) -> (&[u8], &[u8]) {
        let length = self.codes.len() / self.unknown.len();
        (self.unknown.state(number), &self.codes[number * length..][..length])
    }

    pub fn steps(&self, state: usize) -> &[Step] {
        let begin = state.checked_sub(1).map_or(0, |before| self.states[before].end);
        &self.steps[begin..self.states[state].end]
    }

    /// Adds what follows the state of this number, as far as it is asked for. `postponed`: of each state, if answers are.
    pub fn expand(
        &mut self,
        expander: &mut Expander,
        part: Part,
        store: &Reached,
        state: usize,
        restless: u64,
        postponed: Option<&[u64]>,
    ) {
        let Self { states, steps, unknown, codes, restless: of_unknown, remarked, entered, .. } = self;
        if postponed.is_some_and(|postponed| postponed[state] == LEFT_OUT) {
            states.push(After {
                end: steps.len(),
                transitions: 0,
                stops: 0,
                has_new_values: false,
                postponed: LEFT_OUT,
            });
            return;
        }
        let count = expander.values.count();
        let mut after = After { end: 0, transitions: 0, stops: 0, has_new_values: false, postponed: 0 };
        let mut to = Vec::new();
        let before = store.state(state);
        let begin = steps.len();
        let (beside, mut other) = (store.coded(state, &before), Vec::new());
        let model = expander.model;
        let cut = expander.cut.clone();
        let mut emit = |successor: Successor| {
            after.transitions += 1;
            if after.transitions.is_multiple_of(SUCCESSORS) {
                cut.takes(size_of::<Step>() * steps.capacity() + codes.capacity() + unknown.size());
            }
            if successor.result.is_err() {
                for (instance, program) in model.instances.iter().enumerate() {
                    let state = program.state.load(successor.state) as usize;
                    if entered.insert((instance, state)) {
                        steps.push(Step::Entered { instance, state });
                    }
                }
            }
            let acting = if postponed.is_some() { machines_of(successor.events) } else { 0 };
            for remark in successor.remarked {
                if !remarked.contains(remark) {
                    remarked.push(remark.clone());
                    steps.push(Step::Remarked(Box::new((remark.clone(), successor.events.to_vec()))));
                }
            }
            let mut find = |violation: &Violation| {
                steps.push(Step::Found(Box::new((violation.clone(), successor.events.to_vec()))));
            };
            successor.noted.iter().for_each(&mut find);
            match successor.result {
                Ok(()) => {
                    let is_plain = successor.is_plain();
                    if let Some(known) = store.find_beside(successor.state, &beside, &mut other) {
                        let tells = |(other, less): &(usize, u64)| *other == known && less & !acting == 0;
                        let is_told = postponed.is_some() && !to.iter().any(tells);
                        if (is_plain || is_told) && known != state {
                            to.push((known, acting));
                            steps.push(Step::Known { state: known as u32, acting, is_plain });
                        }
                        return;
                    }
                    let (number, is_new) = unknown.add(successor.state, 0);
                    if is_new {
                        of_unknown.push(successor.restless);
                        codes.extend_from_slice(&other);
                    }
                    if is_new || is_plain || postponed.is_some() {
                        steps.push(Step::Unknown { number: number as u32, acting, is_plain });
                    }
                }
                Err(Violation::Stop { .. }) => {
                    after.stops += 1;
                    if successor.is_plain() {
                        steps.push(Step::Stop);
                    }
                }
                Err(violation) => {
                    find(&violation);
                    if successor.faults == 0 {
                        steps.push(Step::Out { acting });
                    }
                }
            }
        };
        if let Some(postponed) = postponed {
            after.postponed =
                expander.expand_postponing(part, &before, restless, postponed[state], &mut emit);
        } else {
            expander.expand_part(part, &before, restless, &mut emit);
        }
        steps.splice(begin..begin, expander.needed.drain(..).map(Step::Needs));
        after.has_new_values = expander.values.count() != count;
        after.end = steps.len();
        states.push(after);
    }
}

/// What follows these states, as far as it is asked for, in runs in their order; each expander works by itself. The memory
/// of `spare` is used again: threads that take it anew each time would wait for one another.
pub(crate) fn expand(
    expanders: &mut [Expander],
    part: Part,
    store: &Reached,
    restless: &[u64],
    postponed: Option<&[u64]>,
    states: Range<usize>,
    spare: Vec<Expanded>,
) -> Vec<Expanded> {
    let next = AtomicUsize::new(states.start);
    let length = (states.len() / (8 * expanders.len().max(1))).clamp(SHORT, RUN);
    let spare = Mutex::new(spare);
    let take = |first: usize| {
        let run = spare.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let mut run = run.unwrap_or_else(|| Expanded::new(first, store.length()));
        run.begin_anew(first);
        run
    };
    let work = |expander: &mut Expander| {
        let count = expander.values.count();
        let mut runs = Vec::new();
        loop {
            let first = next.fetch_add(length, Ordering::Relaxed);
            if first >= states.end {
                return runs;
            }
            let mut run = take(first);
            let last = states.end.min(first + length);
            for (state, restless) in (first..last).zip(&restless[first..last]) {
                run.expand(expander, part, store, state, *restless, postponed);
                // Their numbers are given in the order of the states.
                expander.values.forget_after(count);
            }
            runs.push(run);
        }
    };
    let Some((own, others)) =
        expanders.split_first_mut().filter(|(_, others)| !others.is_empty() && states.len() > SHORT)
    else {
        return expanders.first_mut().map(work).unwrap_or_default();
    };
    let mut runs = std::thread::scope(|scope| {
        let others: Vec<_> = others.iter_mut().map(|other| scope.spawn(|| work(other))).collect();
        let mut runs = work(own);
        for other in others {
            runs.extend(other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
        }
        runs
    });
    runs.sort_by_key(|run| run.first);
    runs
}
