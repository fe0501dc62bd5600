//! Breadth first through all states.

use crate::event::Event;
use crate::model::Model;
use crate::possible::{Edges, never_followed, never_made};
use crate::store::Store;
use crate::story::{self, Execution};
use crate::successor::{Expander, Orders};
use crate::value::Values;
use crate::violation::Violation;
use std::collections::HashSet;
use std::time::{Duration, Instant};

/// How far to search.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// Devices that do something in one scan, at most; none: any number.
    pub answers: Option<usize>,
    pub orders: Orders,
    pub time: Option<Duration>,
    /// Bytes of memory.
    pub memory: usize,
    /// It ends with so many different violations.
    pub violations: usize,
}

/// How far it has come.
#[derive(Clone, Copy, Debug, Default)]
pub struct Covered {
    pub states: usize,
    pub transitions: u64,
    /// Of these, how many end in a stop for an operator.
    pub stops: u64,
    /// States in which a machine is stopped by itself; 0 if the search is not complete.
    pub stopped: usize,
    /// Scans from the start to the farthest state that has been checked.
    pub depth: usize,
    /// Bytes of memory.
    pub memory: usize,
    pub time: Duration,
}

/// Why it ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// All states were checked.
    Complete,
    /// There are as many violations as were wanted.
    Violated,
    TimeIsUp,
    MemoryIsFull,
    /// Whoever watches wanted no more.
    Stopped,
    /// More than 65,536 places or numbers came up.
    TooManyValues,
}

pub struct Outcome {
    pub covered: Covered,
    pub end: End,
    /// The shortest execution to each.
    pub violations: Vec<(Violation, Execution)>,
    /// All states that were reached.
    pub reached: Store,
    /// Points and reals by their numbers in these states.
    pub values: Values,
}

struct Found {
    violation: Violation,
    /// The state before, and what devices did then.
    from: usize,
    events: Vec<Event>,
}

/// `watch` is told how far it is, some times a second, and says whether to continue.
pub fn explore(model: &Model, bounds: &Bounds, watch: &mut dyn FnMut(&Covered) -> bool) -> Outcome {
    let begin = Instant::now();
    let mut expander = Expander::new(model, bounds.answers.unwrap_or(usize::MAX), bounds.orders);
    let mut store = Store::new(model.initial.len());
    let mut edges = Edges::default();
    let mut found: Vec<Found> = Vec::new();
    let mut known: HashSet<Violation> = HashSet::new();
    let mut covered = Covered::default();
    store.add(&model.initial, 0);
    let mut restless = vec![u64::MAX];
    let (mut next, mut end_of_depth) = (0, 1);
    let end = loop {
        if next == store.len() {
            break End::Complete;
        }
        if next == end_of_depth {
            covered.depth += 1;
            end_of_depth = store.len();
        }
        let state = store.state(next).to_vec();
        expander.expand(&state, restless[next], &mut |successor| {
            covered.transitions += 1;
            let mut find = |violation: &Violation| {
                if found.len() < bounds.violations && known.insert(violation.clone()) {
                    let events = successor.events.to_vec();
                    found.push(Found { violation: violation.clone(), from: next, events });
                }
            };
            successor.noted.iter().for_each(&mut find);
            match successor.result {
                Ok(()) => {
                    let (number, is_new) = store.add(successor.state, next);
                    if is_new {
                        restless.push(successor.restless);
                    }
                    if successor.events.len() <= 1 && number != next {
                        edges.add(next, number);
                    }
                }
                Err(Violation::Stop) => {
                    edges.lead_out(next);
                    covered.stops += 1;
                }
                Err(violation) => {
                    edges.lead_out(next);
                    find(&violation);
                }
            }
        });
        next += 1;
        if found.len() >= bounds.violations {
            break End::Violated;
        }
        if next % 256 == 0 {
            covered.time = begin.elapsed();
            covered.memory = store.size() + 8 * restless.capacity() + edges.size();
            covered.states = store.len();
            if bounds.time.is_some_and(|time| covered.time > time) {
                break End::TimeIsUp;
            }
            if covered.memory > bounds.memory || store.is_full() {
                break End::MemoryIsFull;
            }
            if !watch(&covered) {
                break End::Stopped;
            }
        }
        if expander.values.is_full() {
            break End::TooManyValues;
        }
    };
    covered.states = store.len();
    covered.memory = store.size() + 8 * restless.capacity() + edges.size();
    let mut violations: Vec<(Violation, Execution)> = found
        .into_iter()
        .map(|found| {
            let execution =
                story::to_violation(&store, &mut expander, found.from, &found.violation, &found.events);
            (found.violation, execution)
        })
        .collect();
    if end == End::Complete {
        let never = never_made(&store, &edges, &mut expander).map(|state| (Violation::NeverMade, state));
        let mut never: Vec<(Violation, usize)> = never.into_iter().collect();
        if violations.len() + never.len() < bounds.violations {
            never.extend(never_followed(&store, &edges, &mut expander));
        }
        for (violation, state) in never {
            violations.push((violation, story::to_state(&store, &mut expander, state)));
        }
        violations.truncate(bounds.violations);
        covered.stopped = (0..store.len()).filter(|state| model.any_stands(store.state(*state))).count();
    }
    covered.time = begin.elapsed();
    Outcome { covered, end, violations, reached: store, values: expander.values }
}
