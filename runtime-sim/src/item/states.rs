//! The kinds and carriers of all items, in little memory: those in the supply, and those that are gone, share what is the
//! same for many.

use super::Item;
use crate::carrier::Carrier;
use std::collections::HashMap;

#[derive(Clone, Debug)]
pub(super) struct States {
    /// Of each item the number of its state.
    of: Vec<u32>,
    states: Vec<Item>,
    /// Numbers of states that no item has.
    free: Vec<u32>,
    /// Of items that are not on the line, by their kinds.
    shared: HashMap<(usize, OffLine), u32>,
}

/// Where an item is that is not on the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum OffLine {
    Supply,
    Sink { machine: usize, part: usize },
    Collector,
    Shipped { order: usize },
}

impl OffLine {
    /// None for an item on the line, or in one that is.
    fn at(carrier: Carrier) -> Option<Self> {
        match carrier {
            Carrier::Supply => Some(Self::Supply),
            Carrier::Sink { machine, part } => Some(Self::Sink { machine, part }),
            Carrier::Collector => Some(Self::Collector),
            Carrier::Shipped { order } => Some(Self::Shipped { order }),
            Carrier::Lane { .. }
            | Carrier::Grip { .. }
            | Carrier::Place { .. }
            | Carrier::On { .. }
            | Carrier::Floor { .. }
            | Carrier::Part { .. } => None,
        }
    }
}

impl States {
    /// Of items in the supply, by their kinds.
    pub fn new(kinds: impl Iterator<Item = usize>) -> Self {
        let mut states =
            Self { of: Vec::new(), states: Vec::new(), free: Vec::new(), shared: HashMap::new() };
        for kind in kinds {
            let state = states.number(Item { kind, carrier: Carrier::Supply });
            states.of.push(state);
        }
        states
    }

    pub fn count(&self) -> usize {
        self.of.len()
    }

    pub fn of(&self, item: usize) -> &Item {
        &self.states[self.of[item] as usize]
    }

    /// The carrier that the item had.
    pub fn carry(&mut self, item: usize, to: Carrier) -> Carrier {
        let Item { kind, carrier } = *self.of(item);
        self.set(item, Item { kind, carrier: to });
        carrier
    }

    /// The kind that the item had.
    pub fn remake(&mut self, item: usize, kind: usize) -> usize {
        let was = *self.of(item);
        self.set(item, Item { kind, carrier: was.carrier });
        was.kind
    }

    fn set(&mut self, item: usize, to: Item) {
        let number = self.of[item];
        let is_own = OffLine::at(self.states[number as usize].carrier).is_none();
        if is_own && OffLine::at(to.carrier).is_none() {
            self.states[number as usize] = to;
            return;
        }
        if is_own {
            self.free.push(number);
        }
        self.of[item] = self.number(to);
    }

    /// The number of a state for one more item.
    fn number(&mut self, state: Item) -> u32 {
        let shared = OffLine::at(state.carrier).map(|off_line| (state.kind, off_line));
        if let Some(number) = shared.and_then(|shared| self.shared.get(&shared)) {
            return *number;
        }
        let number = self.free.pop().unwrap_or(self.states.len() as u32);
        match self.states.get_mut(number as usize) {
            Some(free) => *free = state,
            None => self.states.push(state),
        }
        if let Some(shared) = shared {
            self.shared.insert(shared, number);
        }
        number
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_grows_with_the_items_on_the_line_alone() {
        let mut states = States::new((0..1000).map(|item| item % 3));
        let lane = |item: usize| Carrier::Lane { machine: 0, part: 0, at: item as f64, across: 0.0 };
        let sink = Carrier::Sink { machine: 0, part: 1 };
        for item in 0..1000 {
            assert_eq!(states.carry(item, lane(item)), Carrier::Supply);
            if item >= 10 {
                assert_eq!(states.carry(item - 10, sink), lane(item - 10));
            }
        }
        for item in 0..1000 {
            let carrier = if item < 990 { sink } else { lane(item) };
            assert_eq!(*states.of(item), Item { kind: item % 3, carrier });
        }
        assert!(states.states.len() <= 20, "{}", states.states.len());
    }

    #[test]
    fn an_item_of_another_kind_changes_no_other_one() {
        let mut states = States::new([0, 0].into_iter());
        assert_eq!(states.remake(0, 1), 0);
        states.carry(1, Carrier::Collector);
        assert_eq!(*states.of(0), Item { kind: 1, carrier: Carrier::Supply });
        assert_eq!(*states.of(1), Item { kind: 0, carrier: Carrier::Collector });
    }
}
