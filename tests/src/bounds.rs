//! Bounds of a search.

use autogen_search::explore::Bounds;
use autogen_search::successor::Orders;

/// Any number of answers, to the first violation, on one processor.
pub const BOUNDS: Bounds = Bounds {
    answers: None,
    orders: Orders::One,
    time: None,
    memory: 1_000_000_000,
    states: usize::MAX,
    violations: 1,
    jobs: 1,
};
