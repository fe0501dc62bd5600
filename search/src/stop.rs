//! What comes behind a stop for an operator.

use crate::model::Model;
use crate::program::Cells;
use crate::scan::Scan;
use crate::successor::Expander;
use crate::violation::Violation;
use rustc_hash::{FxHashMap, FxHashSet};

/// So many scans behind a stop are looked at: a line that stops in as many, one after another, does so for ever.
const MOST_SCANS: usize = 256;

/// The state behind a stop, once an operator has reset it. What he does may change inputs of devices: they are open.
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
        model.reset(&mut state);
        Self { state, mark }
    }
}

impl Scan<'_> {
    pub(crate) fn mark(&self) -> Mark {
        let Self { forgotten, written, .. } = *self;
        Mark { forgotten, written }
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
    /// whatever sensors show, it stops again until it is in a state in which it has stopped before; or a fault.
    /// The second result is what its scans read of what is postponed.
    pub(crate) fn behind_stop(&mut self, stopped: &Stopped) -> (Option<Violation>, u64) {
        // Whether a machine that is stopped by itself goes on is not searched.
        if self.model.any_stands(&stopped.state) {
            return (None, 0);
        }
        let (work, first) = (std::mem::take(&mut self.work), std::mem::take(&mut self.before));
        let (choices, told) = (std::mem::take(&mut self.choices), self.told.clone());
        let (noted, remarked) = (self.noted.len(), self.remarked.len());
        let order = std::mem::take(&mut self.order);
        let first_forgotten = (self.forgotten, self.forgotten_before);
        let mut read = 0;
        let found = self.stops_again(stopped, &order, &mut read);
        (self.forgotten, self.forgotten_before) = first_forgotten;
        self.noted.truncate(noted);
        self.remarked.truncate(remarked);
        self.order = order;
        (self.work, self.before, self.choices, self.told) = (work, first, choices, told);
        (found, read)
    }

    fn stops_again(&mut self, stopped: &Stopped, order: &[usize], read: &mut u64) -> Option<Violation> {
        let mut known: FxHashSet<Vec<u8>> = FxHashSet::default();
        let mut open = vec![stopped.clone()];
        let (mut scans, mut has_chosen) = (0, false);
        while let Some(Stopped { state, mark }) = open.pop() {
            if !known.insert(state.clone()) {
                continue;
            }
            self.choices.clear();
            loop {
                if scans == MOST_SCANS {
                    return (!has_chosen).then_some(Violation::StopsAgain);
                }
                scans += 1;
                self.work.clone_from(&state);
                self.before.clone_from(&state);
                (self.forgotten, self.forgotten_before) = (mark.forgotten, mark.forgotten);
                let mut scan = self.begin();
                scan.written = mark.written;
                scan.is_reset = true;
                let result = scan.run(order, u64::MAX);
                scan.ask_starts();
                let next = scan.mark();
                *read |= scan.observed;
                has_chosen |= !self.choices.is_empty();
                match result {
                    Err(Violation::Stop { fault }) if !self.model.sensed[fault] => {
                        open.push(Stopped::new(self.model, &self.work, next));
                    }
                    Err(Violation::Fault { instance, fault }) if !self.model.sensed[fault] && !has_chosen => {
                        return Some(Violation::FaultBehindStop { instance, fault });
                    }
                    _ => return None,
                }
                if !self.choices.advance() {
                    break;
                }
            }
        }
        Some(Violation::StopsAgain)
    }
}
