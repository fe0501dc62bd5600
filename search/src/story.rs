//! An execution: what happened from the start.

use crate::event::Event;
use crate::reached::Reached;
use crate::scan::Told;
use crate::successor::Expander;
use crate::violation::Violation;

/// What happened, scan by scan.
#[derive(Clone, Debug, Default)]
pub struct Execution {
    pub scans: Vec<Happened>,
}

/// One scan: what devices did before it, and what fired in it.
#[derive(Clone, Debug)]
pub struct Happened {
    pub before: Vec<u8>,
    pub events: Vec<Event>,
    pub told: Told,
    /// Stops of machines that were not stopped before.
    pub stops: Vec<Violation>,
    /// In a scan with a violation: as far as it came.
    pub after: Vec<u8>,
}

/// The states from the first one to this one.
pub(crate) fn states(store: &Reached, to: usize) -> Vec<usize> {
    let mut states = vec![to];
    let mut state = to;
    while state != 0 {
        state = store.parent(state);
        states.push(state);
    }
    states.reverse();
    states
}

pub(crate) fn to_state(store: &Reached, expander: &mut Expander, to: usize) -> Execution {
    let mut execution = Execution::default();
    for pair in states(store, to).windows(2) {
        let (before, after) = (store.state(pair[0]), store.state(pair[1]));
        let last =
            expander.shortest(&before, |successor| successor.result.is_ok() && successor.state == after);
        execution.scans.extend(last);
    }
    execution
}

pub(crate) fn to_violation(
    store: &Reached,
    expander: &mut Expander,
    from: usize,
    violation: &Violation,
    events: &[Event],
) -> Execution {
    let mut execution = to_state(store, expander, from);
    let before = store.state(from);
    let last = expander.shortest(&before, |successor| {
        successor.events == events
            && (successor.noted.contains(violation)
                || successor.remarked.contains(violation)
                || successor.result.as_ref() == Err(violation))
    });
    execution.scans.extend(last);
    execution
}

impl Expander<'_> {
    /// The successor with the fewest faults, and the fewest events, among those that are wanted.
    fn shortest(
        &mut self,
        before: &[u8],
        wanted: impl Fn(&crate::successor::Successor) -> bool,
    ) -> Option<Happened> {
        let mut best: Option<Happened> = None;
        let mut least = (usize::MAX, usize::MAX);
        let model = self.model;
        let is_new_stop = |noted: &&Violation| matches!(noted, Violation::MachineStops { instance, .. } if !model.stands(before, *instance));
        self.tell = true;
        self.expand(before, u64::MAX, &mut |successor| {
            let events = (successor.faults, successor.events.len());
            if events < least && wanted(&successor) {
                least = events;
                best = Some(Happened {
                    before: before.to_vec(),
                    events: successor.events.to_vec(),
                    told: successor.told.clone(),
                    stops: successor.noted.iter().filter(is_new_stop).cloned().collect(),
                    after: successor.state.to_vec(),
                });
            }
        });
        self.tell = false;
        best
    }
}
