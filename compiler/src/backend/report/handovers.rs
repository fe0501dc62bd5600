//! When each item was handed over, and when each machine was brought one.

use runtime_sim::carrier::Carrier;
use runtime_sim::event::Event;
use std::collections::HashMap;

/// By the start of a scan an item was taken from a carrier.
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
    /// To lanes and places of each machine: what others put there.
    to_machines: Vec<Vec<Handover>>,
}

impl Handovers {
    pub fn new(events: &[Event], machines: usize) -> Self {
        let mut all = Self { of_items: HashMap::new(), to_machines: vec![Vec::new(); machines] };
        for event in events {
            let Event::Item { scan, item, from, to, .. } = *event else { continue };
            if moves_at_its_place(from, to) {
                continue;
            }
            let handover = Handover { scan, item, from };
            all.of_items.entry(item).or_default().push(handover);
            if let Carrier::Lane { machine, .. } | Carrier::Place { machine, .. } = to {
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

/// What lies on an item that a process changes comes to another height.
fn moves_at_its_place(from: Carrier, to: Carrier) -> bool {
    let place = |carrier: Carrier| carrier.offset().and(carrier.machine().zip(carrier.part()));
    place(from).is_some() && place(from) == place(to)
}
