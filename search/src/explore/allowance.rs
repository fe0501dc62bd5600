//! What there is for the checks that come after a search.

use super::outcome::{Bounds, Covered, End};
use crate::possible::Allowance;
use std::time::{Duration, Instant};

/// What is possible is checked with what the limits have left, and in any case for so long, for a fifth of the time of the
/// search, and with a fifth of the memory.
const LEAST_CHECK: Duration = Duration::from_secs(1);

impl Allowance {
    pub(super) fn after(end: End, covered: &Covered, bounds: &Bounds) -> Self {
        let left = match end {
            // Whoever has stopped it waits.
            End::Stopped => Some(Duration::ZERO),
            _ => bounds.time.map(|time| time.saturating_sub(covered.time)),
        };
        let time = left.map(|left| left.max(covered.time / 5).max(LEAST_CHECK));
        Self {
            until: time.and_then(|time| Instant::now().checked_add(time)),
            memory: bounds.memory.saturating_sub(covered.memory).max(bounds.memory / 5),
        }
    }
}
