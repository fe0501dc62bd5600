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

/// So many events are forgotten at a time.
const FORGOTTEN: usize = 2_000;

/// All events of a run in their order. Those that everyone has read are forgotten: the log of a long run does not grow.
#[derive(Clone, Debug, Default)]
pub struct Log {
    kept: Vec<Event>,
    forgotten: usize,
}

impl Log {
    pub fn push(&mut self, event: Event) {
        self.kept.push(event);
    }

    /// Events so far, with those that are forgotten.
    pub fn count(&self) -> usize {
        self.forgotten + self.kept.len()
    }

    /// The events after the first `read` ones.
    pub fn since(&self, read: usize) -> &[Event] {
        debug_assert!(read >= self.forgotten, "events were forgotten that nobody has read");
        self.kept.get(read.saturating_sub(self.forgotten)..).unwrap_or_default()
    }

    /// Everyone has read the first `read` ones.
    pub(crate) fn forget(&mut self, read: usize) {
        let old = read - self.forgotten;
        if old >= FORGOTTEN {
            self.kept.drain(..old);
            self.forgotten = read;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn order(order: usize) -> Event {
        Event::Order { scan: 0, machine: 0, order, change: OrderChange::Opened }
    }

    #[test]
    fn what_everyone_has_read_is_forgotten() {
        let mut log = Log::default();
        for number in 0..10 * FORGOTTEN {
            log.push(order(number));
            log.forget(number);
            assert_eq!(log.count(), number + 1);
            assert_eq!(log.since(number), [order(number)]);
            assert!(log.kept.len() <= FORGOTTEN + 1);
        }
    }
}
