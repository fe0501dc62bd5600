//! The log of a run.

use crate::carrier::Carrier;
use crate::point::Point;

/// Something that had happened by the start of scan `scan`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event {
    /// An item was handed over. `point` is where its underside was afterwards.
    Item { scan: u64, item: usize, from: Carrier, to: Carrier, point: Point },
    /// An item became one of another kind.
    Kind { scan: u64, item: usize, kind: usize },
    Order {
        scan: u64,
        /// The station.
        machine: usize,
        order: usize,
        change: OrderChange,
    },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OrderChange {
    Opened,
    Made,
    /// It was made at another station.
    Withdrawn,
    /// `complete` was set while the parts in the briefcase were not those of the order.
    Refused,
}
