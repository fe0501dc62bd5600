//! How far a search goes, and what it tells.

use crate::occurred::Occurred;
use crate::reached::Reached;
use crate::refinement::Refinement;
use crate::story::Execution;
use crate::successor::Orders;
use crate::unread::Unread;
use crate::value::Values;
use crate::violation::Violation;
use std::collections::BTreeSet;
use std::time::Duration;

/// How far to search.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// Devices that do something in one scan, at most; none: any number.
    pub answers: Option<usize>,
    pub orders: Orders,
    pub time: Option<Duration>,
    /// Bytes of memory.
    pub memory: usize,
    pub states: usize,
    /// It ends with so many different violations.
    pub violations: usize,
    /// Processors that work at the same time.
    pub jobs: usize,
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
    /// Of a search that is cut: all sequences were checked in which devices fail before at most so many scans; none: not even
    /// those without faults.
    pub failing: Option<usize>,
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
    /// There are more states than were wanted.
    TooManyStates,
    /// Whoever watches wanted no more.
    Stopped,
    /// More than 65,536 places or numbers came up.
    TooManyValues,
}

/// Whether a question is decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Decided {
    Yes,
    /// No: the answer may depend on items that the search does not know.
    ItemsAreHidden,
    /// No: the search ended before.
    NotReached,
}

pub struct Outcome {
    pub covered: Covered,
    pub end: End,
    /// The shortest execution to each.
    pub violations: Vec<(Violation, Execution)>,
    /// What is hardly meant, and the shortest execution to it. Only if the search is complete and found no violation.
    pub remarks: Vec<(Violation, Execution)>,
    /// Whether it is decided that the orders can always still be made, in the sequences that were checked completely.
    pub orders: Decided,
    /// The same of what is waited for.
    pub obligations: Decided,
    /// All states that were reached.
    pub reached: Reached,
    /// Points and reals by their numbers in these states.
    pub values: Values,
    /// Where nothing is read of what is forgotten: another search may begin with that.
    pub unread: Unread,
    /// Instances, and states of theirs that no state that was reached has to have: answers that are postponed bring them
    /// there, or a scan ends there in a stop or a violation.
    pub entered: BTreeSet<(usize, usize)>,
    pub occurred: Occurred,
}

/// Why a search begins anew.
pub(super) struct Again {
    pub covered: Covered,
    pub certain: Certain,
    /// What must not be forgotten.
    pub refinements: Vec<Refinement>,
    /// What was found, if only a search that postpones nothing can tell whether the orders can be made.
    pub undecided: Option<Box<Outcome>>,
}

/// What an attempt has found for certain: violations, and points and reals by their numbers in their executions.
#[derive(Default)]
pub(super) struct Certain {
    pub violations: Vec<(Violation, Execution)>,
    pub values: Values,
}

impl Certain {
    /// Whichever has more.
    pub fn or(self, other: Self) -> Self {
        if other.violations.len() > self.violations.len() { other } else { self }
    }
}

impl Outcome {
    /// If it is cut: an attempt before it may have come farther.
    pub(super) fn or_checked(mut self, farthest: &Covered) -> Self {
        let is_cut = !matches!(self.end, End::Complete | End::Violated);
        if is_cut && self.covered.failing < farthest.failing {
            self.covered = Covered { time: self.covered.time, ..*farthest };
            (self.orders, self.obligations) = (Decided::NotReached, Decided::NotReached);
        }
        self
    }

    /// Earlier attempts say more if this one is cut: one all but whether the orders can be made, others what is certain.
    pub(super) fn or_earlier(mut self, earlier: Option<Self>, certain: Certain) -> Self {
        if matches!(self.end, End::Complete | End::Violated) {
            return self;
        }
        let has_more = |earlier: &Self| self.violations.len() <= earlier.violations.len();
        if self.orders == Decided::NotReached
            && let Some(earlier) = earlier.filter(has_more)
        {
            self = earlier;
        }
        if self.violations.len() < certain.violations.len() {
            Certain { violations: self.violations, values: self.values } = certain;
        }
        self
    }

    /// Whether everything was checked, as far as the search knows of it, and nothing found.
    pub fn is_proved(&self) -> bool {
        let is_reached = [self.orders, self.obligations].into_iter().all(|it| it != Decided::NotReached);
        self.violations.is_empty() && self.end == End::Complete && is_reached
    }
}
