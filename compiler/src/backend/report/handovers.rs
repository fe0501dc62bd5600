//! When each item was handed over, and when each machine was brought one.

use runtime_sim::carrier::Carrier;
use runtime_sim::event::Event;
use std::collections::HashMap;

/// By the start of a scan an item was taken from a carrier, or from an item that had this one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Handover {
    pub scan: u64,
    pub item: usize,
    pub from: Carrier,
}

impl Eq for Handover {}

/// In the order of time.
pub struct Handovers {
    of_items: HashMap<usize, Vec<Handover>>,
    /// To lanes and places of each machine, and onto items there: what others put there.
    to_machines: Vec<Vec<Handover>>,
}

impl Handovers {
    pub fn new(events: &[Event], machines: usize) -> Self {
        let mut all = Self { of_items: HashMap::new(), to_machines: vec![Vec::new(); machines] };
        let mut carriers: HashMap<usize, Carrier> = HashMap::new();
        for event in events {
            let Event::Item { scan, item, from, to, .. } = *event else { continue };
            let borne_by = |carrier: Carrier| under(carrier, &carriers);
            let (giver, taker) = (borne_by(from), borne_by(to));
            carriers.insert(item, to);
            let goes_with_item = from.item().is_some() && to.is_gone();
            if goes_with_item || moves_at_its_place(from, to) {
                continue;
            }
            let handover = Handover { scan, item, from: giver };
            all.of_items.entry(item).or_default().push(handover);
            if let Carrier::Lane { machine, .. } | Carrier::Place { machine, .. } = taker {
                all.to_machines[machine].push(handover);
            }
        }
        all
    }

    /// The last one of an item before a scan.
    pub fn before(&self, item: usize, scan: u64) -> Option<Handover> {
        let all = self.of_items.get(&item)?;
        all[..all.partition_point(|handover| handover.scan < scan)].last().copied()
    }

    /// The last one to a machine after one scan and not after another.
    pub fn last_to(&self, machine: usize, after: u64, until: u64) -> Option<Handover> {
        let all = &self.to_machines[machine];
        let last = all[..all.partition_point(|handover| handover.scan <= until)].last().copied();
        last.filter(|handover| handover.scan > after)
    }
}

/// What bears the item at the bottom, of those that lie on one another.
fn under(mut carrier: Carrier, carriers: &HashMap<usize, Carrier>) -> Carrier {
    while let Some(known) = carrier.item().and_then(|item| carriers.get(&item)) {
        carrier = *known;
    }
    carrier
}

/// What lies on an item that a process changes comes to another height.
fn moves_at_its_place(from: Carrier, to: Carrier) -> bool {
    let place = |carrier: Carrier| carrier.offset().and(carrier.machine().zip(carrier.part()));
    let is_at_place = place(from).is_some() && place(from) == place(to);
    is_at_place || from.item().is_some() && from.item() == to.item()
}
