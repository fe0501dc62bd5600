//! A course of events from the start.

use crate::event::Event;
use crate::scan::Told;
use crate::store::Store;
use crate::successor::Expander;
use crate::violation::Violation;

/// What happened, scan by scan.
#[derive(Clone, Debug, Default)]
pub struct Course {
    pub scans: Vec<Happened>,
}

/// One scan: what devices did before it, and what fired in it.
#[derive(Clone, Debug)]
pub struct Happened {
    pub before: Vec<u8>,
    pub events: Vec<Event>,
    pub told: Told,
    /// In a scan with a violation: as far as it came.
    pub after: Vec<u8>,
}

/// The states from the first one to this one.
fn states(store: &Store, to: usize) -> Vec<usize> {
    let mut states = vec![to];
    let mut state = to;
    while state != 0 {
        state = store.parent(state);
        states.push(state);
    }
    states.reverse();
    states
}

pub(crate) fn to_state(store: &Store, expander: &mut Expander, to: usize) -> Course {
    let mut course = Course::default();
    for pair in states(store, to).windows(2) {
        let (before, after) = (store.state(pair[0]).to_vec(), store.state(pair[1]).to_vec());
        let way = expander.way(&before, |way| way.result.is_ok() && way.state == after);
        course.scans.extend(way);
    }
    course
}

pub(crate) fn to_violation(
    store: &Store,
    expander: &mut Expander,
    from: usize,
    violation: &Violation,
    events: &[Event],
) -> Course {
    let mut course = to_state(store, expander, from);
    let before = store.state(from).to_vec();
    let way = expander.way(&before, |way| way.events == events && way.result.as_ref() == Err(violation));
    course.scans.extend(way);
    course
}

impl Expander<'_> {
    /// The way with the fewest events among those that are wanted.
    fn way(&mut self, before: &[u8], wanted: impl Fn(&crate::successor::Way) -> bool) -> Option<Happened> {
        let mut best: Option<Happened> = None;
        self.tell = true;
        self.expand(before, u64::MAX, &mut |way| {
            let is_better = best.as_ref().is_none_or(|best| way.events.len() < best.events.len());
            if is_better && wanted(&way) {
                best = Some(Happened {
                    before: before.to_vec(),
                    events: way.events.to_vec(),
                    told: way.told.clone(),
                    after: way.state.to_vec(),
                });
            }
        });
        self.tell = false;
        best
    }
}
