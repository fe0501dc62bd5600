//! That no item was lost, doubled or brought back: what the log of a run proves.

use crate::carrier::Carrier;
use crate::event::Event;
use crate::item::{Item, Items};

/// Replays the log from the start, where every item is in the supply: each handover has to begin at the
/// carrier that the replay knows, no gripper may bear two items, nothing comes back from the collector or
/// from an order, and the end has to be what `items` says, on the items and on the machines alike.
pub fn conservation(log: &[Event], items: &Items) -> Result<(), String> {
    let end: &[Item] = items.all();
    let mut carriers = vec![Carrier::Supply; end.len()];
    // The item that the gripper of each machine holds.
    let mut held = vec![None; items.machines()];
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
        // A process may take an item apart again.
        let is_part = matches!(from, Carrier::Part { .. }) && matches!(to, Carrier::Place { .. });
        if from.is_final() && !is_part || to == Carrier::Supply {
            return Err(format!("scan {scan}: item {item} goes from {from:?} to {to:?}"));
        }
        if !(point.x.is_finite() && point.y.is_finite() && point.z.is_finite()) {
            return Err(format!("scan {scan}: item {item} is nowhere"));
        }
        if let Carrier::Grip { machine, .. } = to
            && let Some(other) = held[machine].replace(item)
        {
            return Err(format!("scan {scan}: gripper {machine} holds item {other} and takes item {item}"));
        }
        if let Carrier::Grip { machine, .. } = from {
            held[machine] = None;
        }
        carriers[item] = to;
    }
    for (item, (carrier, found)) in carriers.iter().zip(end).enumerate() {
        if *carrier != found.carrier {
            return Err(format!("item {item} ends at {:?}, by the log at {carrier:?}", found.carrier));
        }
    }
    let mut counts = vec![0; items.machines()];
    for machine in carriers.iter().filter_map(Carrier::machine) {
        counts[machine] += 1;
    }
    for (machine, by_log) in counts.into_iter().enumerate() {
        let borne = items.borne_by(machine);
        if borne.len() != by_log || borne.iter().any(|&i| carriers[i].machine() != Some(machine)) {
            return Err(format!("machine {machine} bears items {borne:?}, by the log {by_log} items"));
        }
    }
    Ok(())
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
        conservation(items.log(), items)
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
    fn the_end_is_that_of_the_log() {
        let mut items = items();
        items.pass(0, bin(1), Point::default());
        let mut log = items.log().to_vec();
        let Event::Item { to, .. } = &mut log[0] else { unreachable!() };
        *to = Carrier::Place { machine: 1, part: 0, offset: Point::new(0.1, 0.0, 0.0) };
        assert!(conservation(&log, &items).unwrap_err().starts_with("item 0 ends at"));
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
