//! What comes behind a stop for an operator.

use crate::model::Model;
use crate::program::Cells;
use crate::scan::Scan;
use crate::successor::Expander;
use crate::violation::Violation;
use rustc_hash::{FxHashMap, FxHashSet};

/// A line that stops in so many scans one after another, in another state each time, is not followed any further.
const MOST_STOPS: usize = 256;

/// The state in which a scan has ended in a stop. What the operator does may change inputs of devices: they are open.
#[derive(Clone, PartialEq, Eq, Hash)]
pub(crate) struct Stopped {
    pub state: Vec<u8>,
    pub mark: Mark,
}

/// What the next scan has to know of a scan that was broken off.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Mark {
    /// What of its state is forgotten.
    pub forgotten: u128,
    /// Instances that may do something in the next scan, or whose properties were due.
    pub touched: u64,
    /// Values that have changed, and their owners.
    pub written: Cells,
}

/// What is known of stops in scans of the state that is expanded: what is wrong behind them, and who needs what is postponed
/// to find that out. Beside each which machines wait.
pub(crate) type Stops = FxHashMap<(Stopped, u64), (Option<Violation>, u64)>;

impl Stopped {
    pub fn new(model: &Model, state: &[u8], mark: Mark) -> Self {
        let mut state = state.to_vec();
        model.open_inputs(&mut state);
        Self { state, mark }
    }
}

impl Scan<'_> {
    /// `touched`: those with which the scan has begun.
    pub(crate) fn mark(&self, touched: u64) -> Mark {
        let Self { forgotten, fired, written, restless, .. } = *self;
        Mark { forgotten, touched: touched | fired | restless, written }
    }
}

impl Expander<'_> {
    /// What is wrong behind a stop, as [`Expander::behind_stop`]; notes who needs what is postponed for that. Scans that differ
    /// in what sensors tell often end in the same stop.
    pub(crate) fn behind(&mut self, stopped: Stopped) -> Option<Violation> {
        let key = (stopped, self.postponed.waiting);
        if let Some((found, observed)) = self.stops.get(&key) {
            self.postponed.observed |= observed;
            return found.clone();
        }
        let is_noted = std::mem::replace(&mut self.occurred.is_noted, false);
        let (found, read) = self.behind_stop(&key.0);
        let observed = self.observed_behind(&key.0, &found, read);
        self.occurred.is_noted = is_noted;
        self.postponed.observed |= observed;
        self.stops.insert(key, (found.clone(), observed));
        found
    }

    /// What is wrong once an operator has come, for whom the line has stopped in this state, while no device does anything:
    /// it stops again in each scan, or in a fault.
    /// The second result is what its scans read of what is postponed.
    pub(crate) fn behind_stop(&mut self, stopped: &Stopped) -> (Option<Violation>, u64) {
        let work = std::mem::replace(&mut self.work, stopped.state.clone());
        let (choices, told) = (std::mem::take(&mut self.choices), self.told.clone());
        let (noted, remarked) = (self.noted.len(), self.remarked.len());
        let order = std::mem::take(&mut self.order);
        let first = self.before.clone();
        let first_forgotten = (self.forgotten, self.forgotten_before);
        let mut mark = stopped.mark;
        let (mut found, mut read) = (None, 0);
        let mut stops: FxHashSet<Vec<u8>> = FxHashSet::default();
        for _ in 0..MOST_STOPS {
            self.model.open_inputs(&mut self.work);
            self.model.reset(&mut self.work);
            if !stops.insert(self.work.clone()) {
                found = Some(Violation::StopsAgain);
                break;
            }
            self.before.clone_from(&self.work);
            self.forgotten = mark.forgotten;
            self.forgotten_before = mark.forgotten;
            self.choices.clear();
            let mut scan = self.begin();
            scan.written = mark.written;
            scan.is_reset = true;
            let result = scan.run(&order, u64::MAX);
            scan.ask_starts();
            mark = scan.mark(u64::MAX);
            read |= scan.observed;
            if let Err(Violation::Fault { instance, fault }) = result
                && self.choices.is_empty()
                && !self.model.sensed[fault]
            {
                found = Some(Violation::FaultBehindStop { instance, fault });
            }
            let goes_on = |fault: usize| self.model.sensed[fault] || !self.choices.is_empty();
            if !matches!(result, Err(Violation::Stop { fault }) if !goes_on(fault)) {
                break;
            }
        }
        self.before = first;
        (self.forgotten, self.forgotten_before) = first_forgotten;
        self.noted.truncate(noted);
        self.remarked.truncate(remarked);
        self.order = order;
        (self.work, self.choices, self.told) = (work, choices, told);
        (found, read)
    }
}
