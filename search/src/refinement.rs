//! Refinement of what is forgotten: values that have to be known are kept. Single executions show most of them with little
//! effort; a search that comes upon one begins anew.

use crate::cut::Cut;
use crate::explore::Bounds;
use crate::model::Model;
use crate::reached::Reached;
use crate::story;
use crate::successor::{Expander, Orders};
use crate::unread::Needed;
use std::sync::Arc;
use std::time::Instant;

/// An execution at random has so many scans at most.
const SCANS: usize = 300;
/// So many of them, one after another, show nothing new in the end; more where a search of many states had to end.
const FRUITLESS: usize = 50;
/// For so many states one more.
const STATES: usize = 500;
/// The same at most.
const MANY: usize = 1000;
/// One of so many scans may be chosen among those before which devices fail.
const FAILING: u64 = 4;

/// Keeps what is asked for in executions at random, after a search of so many states; until it `goes_on` no more, and no
/// longer than `until`.
pub(crate) fn at_random(
    model: &mut Model,
    random: &mut Random,
    states: usize,
    until: Option<Instant>,
    goes_on: &mut dyn FnMut() -> bool,
) {
    let cut = Cut::new(until);
    let mut fruitless = 0;
    while fruitless < (states / STATES).clamp(FRUITLESS, MANY) && !model.unread.is_empty() && goes_on() {
        let mut expander = Expander::new(model, 1, Orders::One);
        expander.cut = cut.clone();
        let mut state = model.initial.clone();
        let mut next = vec![0; state.len()];
        for _ in 0..SCANS {
            let may_fail = random.below(FAILING) == 0;
            let mut seen = 0;
            expander.expand(&state, u64::MAX, &mut |successor| {
                let is_open = successor.result.is_ok() && (may_fail || successor.faults == 0);
                if is_open && successor.state != state {
                    seen += 1;
                    if random.below(seen) == 0 {
                        next.copy_from_slice(successor.state);
                    }
                }
            });
            if seen == 0 || !expander.needed.is_empty() {
                break;
            }
            std::mem::swap(&mut state, &mut next);
        }
        fruitless += 1;
        if !expander.needed.is_empty() {
            model.unread.keep(&expander.needed);
            fruitless = 0;
        }
    }
}

/// An execution to a state in which it turned out what has to be known.
pub(crate) struct Refinement {
    needed: Needed,
    /// Of each scan which one it is of all that may follow.
    scans: Vec<usize>,
}

impl Refinement {
    pub fn of(needed: Needed) -> Self {
        Self { needed, scans: Vec::new() }
    }

    pub fn new(needed: Needed, store: &Reached, expander: &mut Expander, to: usize) -> Self {
        let mut scans = Vec::new();
        for pair in story::states(store, to).windows(2) {
            let (before, after) = (store.state(pair[0]), store.state(pair[1]));
            let (mut number, mut found) = (0, None);
            expander.expand(&before, u64::MAX, &mut |successor| {
                if found.is_none() && successor.result.is_ok() && successor.state == after {
                    found = Some(number);
                }
                number += 1;
            });
            scans.extend(found);
        }
        Self { needed, scans }
    }
}

/// Keeps what was asked for; and what else is asked for on the path there, once that is known, until it `goes_on` no more,
/// and no longer than `until`.
pub(crate) fn along(
    model: &mut Model,
    bounds: &Bounds,
    refinements: &[Refinement],
    until: Option<Instant>,
    goes_on: &mut dyn FnMut() -> bool,
) {
    let needed: Vec<Needed> = refinements.iter().map(|refinement| refinement.needed).collect();
    model.unread.keep(&needed);
    let cut = Cut::new(until);
    for refinement in refinements {
        while goes_on()
            && let needed = asked_for(model, bounds, &refinement.scans, &cut)
            && !needed.is_empty()
        {
            model.unread.keep(&needed);
        }
    }
}

fn asked_for(model: &Model, bounds: &Bounds, scans: &[usize], cut: &Arc<Cut>) -> Vec<Needed> {
    let mut expander = Expander::new(model, bounds.answers.unwrap_or(usize::MAX), bounds.orders);
    expander.cut = cut.clone();
    let mut state = model.initial.clone();
    for scan in scans.iter().copied().map(Some).chain([None]) {
        let mut next = None;
        let mut number = 0;
        expander.expand(&state, u64::MAX, &mut |successor| {
            if Some(number) == scan {
                next = Some(successor.state.to_vec());
            }
            number += 1;
        });
        if !expander.needed.is_empty() {
            return expander.needed;
        }
        let Some(next) = next else { break };
        state = next;
    }
    Vec::new()
}

/// Numbers by xorshift.
pub(crate) struct Random(u64);

impl Default for Random {
    fn default() -> Self {
        Self(1)
    }
}

impl Random {
    fn below(&mut self, bound: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 % bound
    }
}
