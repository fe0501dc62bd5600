//! The log of a run, and what it proves.

use crate::item::{Carrier, Item, Items};
use crate::point::Point;

/// Something that happened while the outputs of scan `scan` acted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event {
    /// An item was handed over. `point` is where its underside was afterwards.
    Item {
        scan: u64,
        item: usize,
        from: Carrier,
        to: Carrier,
        point: Point,
    },
    Order {
        scan: u64,
        order: usize,
        change: OrderChange,
    },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OrderChange {
    Opened,
    Made,
    /// `complete` was set while the parts in the briefcase were not those of the order.
    Refused,
}

/// Replays the log from the start, where every item is in the supply: each handover has to begin at the
/// carrier that the replay knows, no gripper may bear two items, nothing comes back from the collector or
/// from an order, and the end has to be what `items` says, on the items and on the machines alike.
pub fn conservation(log: &[Event], items: &Items) -> Result<(), String> {
    let end: &[Item] = items.all();
    let mut carriers = vec![Carrier::Supply; end.len()];
    let mut last_scan = 0;
    for event in log {
        let Event::Item { scan, item, from, to, point } = *event else { continue };
        let Some(carrier) = carriers.get(item).copied() else {
            return Err(format!("scan {scan}: item {item} does not exist"));
        };
        if scan < last_scan {
            return Err(format!("scan {scan} is logged after scan {last_scan}"));
        }
        last_scan = scan;
        if carrier != from {
            return Err(format!("scan {scan}: item {item} leaves {from:?} but was at {carrier:?}"));
        }
        if from.is_final() || to == Carrier::Supply {
            return Err(format!("scan {scan}: item {item} goes from {from:?} to {to:?}"));
        }
        if !(point.x.is_finite() && point.y.is_finite() && point.z.is_finite()) {
            return Err(format!("scan {scan}: item {item} is nowhere"));
        }
        if let Carrier::Gripper { machine, .. } = to {
            let held = carriers
                .iter()
                .position(|c| matches!(c, Carrier::Gripper { machine: m, .. } if *m == machine));
            if let Some(other) = held {
                return Err(format!(
                    "scan {scan}: gripper {machine} holds item {other} and takes item {item}"
                ));
            }
        }
        carriers[item] = to;
    }
    for (item, (carrier, found)) in carriers.iter().zip(end).enumerate() {
        if *carrier != found.carrier {
            return Err(format!("item {item} ends at {:?}, by the log at {carrier:?}", found.carrier));
        }
    }
    for machine in 0..items.machines() {
        let by_log = carriers.iter().filter(|c| c.machine() == Some(machine)).count();
        let borne = items.borne_by(machine);
        if borne.len() != by_log || borne.iter().any(|&i| carriers[i].machine() != Some(machine)) {
            return Err(format!("machine {machine} bears items {borne:?}, by the log {by_log} items"));
        }
    }
    Ok(())
}
