//! When orders opened and were made.

use crate::event::{Event, OrderChange};

/// Of one order.
#[derive(Clone, Copy, Debug, Default)]
pub struct OrderTimes {
    /// The scan in which it opened first.
    pub opened: Option<u64>,
    /// The scan in which it was made, and the machine.
    pub made: Option<(u64, usize)>,
}

/// Takes note of events that follow those of earlier calls. `times` are those of all orders of the line, in their order.
pub fn note(times: &mut [OrderTimes], events: &[Event]) {
    for event in events {
        let Event::Order { scan, machine, order, change } = *event else { continue };
        let times = &mut times[order];
        match change {
            OrderChange::Opened => times.opened = times.opened.or(Some(scan)),
            OrderChange::Made => times.made = Some((scan, machine)),
            OrderChange::Refused | OrderChange::Withdrawn => {}
        }
    }
}
