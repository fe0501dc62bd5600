//! That no item was lost, doubled or brought back: what the log of a run proves.

use crate::carrier::Carrier;
use crate::event::Event;
use crate::item::Items;
use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};

/// Replays the log from the start, where every item is in the supply: each handover has to begin at the
/// carrier that the replay knows, no gripper may bear two items, nothing comes back from the collector or
/// from an order, and the end has to be what `items` says, on the items and on the machines alike.
#[derive(Clone, Debug)]
pub struct Conservation {
    /// Of each item, whether it has left the supply.
    left: Vec<bool>,
    /// Carriers of those that have left it, until they are gone for good.
    carriers: BTreeMap<usize, Carrier>,
    /// Of those that are gone, the sum of their [`gone`].
    gone: u64,
    /// The items that grippers hold, by machine and part.
    held: BTreeMap<(usize, usize), usize>,
    last_scan: u64,
    /// The first one.
    violation: Option<String>,
}

impl Conservation {
    /// Of these items, before anything has become of them.
    pub fn new(items: &Items) -> Self {
        Self {
            left: vec![false; items.count()],
            carriers: BTreeMap::new(),
            gone: 0,
            held: BTreeMap::new(),
            last_scan: 0,
            violation: None,
        }
    }

    /// All events of a run have to be taken, in their order.
    pub fn take(&mut self, events: &[Event]) {
        for event in events {
            if self.violation.is_none() {
                self.violation = self.follow(event).err();
            }
        }
    }

    fn follow(&mut self, event: &Event) -> Result<(), String> {
        let Event::Item { scan, item, from, to, point } = *event else { return Ok(()) };
        let Some(has_left) = self.left.get(item) else {
            return Err(format!("scan {scan}: item {item} does not exist"));
        };
        if scan < self.last_scan {
            return Err(format!("scan {scan} is logged after scan {}", self.last_scan));
        }
        self.last_scan = scan;
        let carrier = match has_left {
            true => self.carriers.get(&item).copied(),
            false => Some(Carrier::Supply),
        };
        let Some(carrier) = carrier else {
            return Err(format!("scan {scan}: item {item} goes from {from:?} to {to:?} but was gone"));
        };
        if carrier != from {
            return Err(format!("scan {scan}: item {item} leaves {from:?} but was at {carrier:?}"));
        }
        // A process may take an item apart again.
        let is_part = matches!(from, Carrier::Part { .. }) && matches!(to, Carrier::Place { .. });
        if from.is_final() && !is_part || to == Carrier::Supply {
            return Err(format!("scan {scan}: item {item} goes from {from:?} to {to:?}"));
        }
        if !(point.x.is_finite() && point.y.is_finite() && point.z.is_finite()) {
            return Err(format!("scan {scan}: item {item} is nowhere"));
        }
        if let Carrier::Grip { machine, part, .. } = to
            && let Some(other) = self.held.insert((machine, part), item)
        {
            return Err(format!("scan {scan}: gripper {machine} holds item {other} and takes item {item}"));
        }
        if let Carrier::Grip { machine, part, .. } = from {
            self.held.remove(&(machine, part));
        }
        self.left[item] = true;
        if to.is_gone() {
            self.carriers.remove(&item);
            self.gone = self.gone.wrapping_add(gone(item, to));
        } else {
            self.carriers.insert(item, to);
        }
        Ok(())
    }

    /// After the last event.
    pub fn end(self, items: &Items) -> Result<(), String> {
        if let Some(violation) = self.violation {
            return Err(violation);
        }
        let mut counts = vec![0; items.machines()];
        let mut all_gone = 0_u64;
        for (item, found) in items.all().enumerate() {
            let carrier = self.carriers.get(&item);
            let is_so = match carrier {
                Some(carrier) => *carrier == found.carrier,
                None if self.left[item] => found.carrier.is_gone(),
                None => found.carrier == Carrier::Supply,
            };
            if !is_so {
                return Err(format!("item {item} ends at {:?}, by the log at {carrier:?}", found.carrier));
            }
            if let Some(machine) = carrier.and_then(Carrier::machine) {
                counts[machine] += 1;
            }
            if found.carrier.is_gone() {
                all_gone = all_gone.wrapping_add(gone(item, found.carrier));
            }
        }
        if all_gone != self.gone {
            return Err("items that are gone are elsewhere than by the log".into());
        }
        for (machine, by_log) in counts.into_iter().enumerate() {
            let borne = items.borne_by(machine);
            let is_here = |item: &usize| self.carriers.get(item).and_then(Carrier::machine) == Some(machine);
            if borne.len() != by_log || !borne.iter().all(is_here) {
                return Err(format!("machine {machine} bears items {borne:?}, by the log {by_log} items"));
            }
        }
        Ok(())
    }
}

/// A number for an item and where it has gone.
fn gone(item: usize, to: Carrier) -> u64 {
    let mut hash = DefaultHasher::new();
    let to = match to {
        Carrier::Sink { machine, part } => [0, machine, part],
        Carrier::Shipped { order } => [1, order, 0],
        _ => [2, 0, 0],
    };
    (item, to).hash(&mut hash);
    hash.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::line::{IoDelay, Kind, Line, Scenario, Supply};
    use crate::machine::Machine;
    use crate::point::Point;
    use std::sync::Arc;

    /// Two items on their way to a belt and two bins.
    fn items() -> Items {
        let machine = |_| Machine {
            name: "m".into(),
            pose: Point::default(),
            parts: vec![],
            wiring: Arc::default(),
            states: vec![],
            monitor: Default::default(),
            visits: None,
        };
        Items::new(&Line {
            scan_ms: 10,
            kinds: vec![Kind {
                name: "part".into(),
                height: 0.1,
                grasp: 0.1,
                size: [0.1, 0.1],
                is: Vec::new(),
                mass: 0.0,
                deck: None,
            }],
            machines: (0..3).map(machine).collect(),
            obstacles: vec![],
            may_touch: vec![],
            scenario: Scenario { supply: vec![Supply { belt: 0, items: vec![0, 0] }], ..Scenario::default() },
            io_delay: IoDelay::Fixed(0),
        })
    }

    fn bin(machine: usize) -> Carrier {
        Carrier::Place { machine, part: 0, offset: Point::default() }
    }

    fn verdict(items: &Items) -> Result<(), String> {
        verdict_on(items.log().since(0), items)
    }

    fn verdict_on(log: &[Event], items: &Items) -> Result<(), String> {
        let mut conservation = Conservation::new(items);
        conservation.take(log);
        conservation.end(items)
    }

    #[test]
    fn a_true_log_is_accepted() {
        let mut items = items();
        items.pass(0, bin(1), Point::default());
        items.pass(1, bin(1), Point::default());
        items.pass(0, bin(2), Point::default());
        assert_eq!(verdict(&items), Ok(()));
    }

    #[test]
    fn nothing_comes_back_from_the_collector() {
        let mut items = items();
        items.pass(0, Carrier::Collector, Point::default());
        items.pass(0, bin(1), Point::default());
        assert!(verdict(&items).unwrap_err().contains("goes from Collector"));
    }

    #[test]
    fn a_gripper_holds_one_item() {
        let mut items = items();
        let gripper = Carrier::Grip { machine: 1, part: 0, hang: Point::default() };
        items.pass(0, gripper, Point::default());
        items.pass(0, bin(2), Point::default());
        items.pass(1, gripper, Point::default());
        assert_eq!(verdict(&items), Ok(()));
        items.pass(0, gripper, Point::default());
        assert_eq!(verdict(&items).unwrap_err(), "scan 0: gripper 1 holds item 1 and takes item 0");
    }

    #[test]
    fn each_gripper_of_a_machine_holds_an_item() {
        let mut items = items();
        for part in [0, 1] {
            items.pass(part, Carrier::Grip { machine: 1, part, hang: Point::default() }, Point::default());
        }
        assert_eq!(verdict(&items), Ok(()));
    }

    #[test]
    fn the_end_is_that_of_the_log() {
        let mut items = items();
        items.pass(0, bin(1), Point::default());
        let mut log = items.log().since(0).to_vec();
        let Event::Item { to, .. } = &mut log[0] else { unreachable!() };
        *to = Carrier::Place { machine: 1, part: 0, offset: Point::new(0.1, 0.0, 0.0) };
        assert!(verdict_on(&log, &items).unwrap_err().starts_with("item 0 ends at"));
    }

    #[test]
    fn an_item_on_two_machines_is_found() {
        let mut items = items();
        items.pass(0, bin(1), Point::default());
        items.borne[2].push(0);
        assert!(verdict(&items).unwrap_err().starts_with("machine 2 bears items [0]"));
    }

    #[test]
    fn an_item_that_its_machine_does_not_know_is_found() {
        let mut items = items();
        items.pass(0, bin(1), Point::default());
        items.borne[1].clear();
        assert!(verdict(&items).unwrap_err().starts_with("machine 1 bears items []"));
    }

    #[test]
    fn an_item_that_is_nowhere_is_found() {
        let mut items = items();
        items.pass(0, bin(1), Point::new(f64::NAN, 0.0, 0.0));
        assert!(verdict(&items).is_err());
    }
}
