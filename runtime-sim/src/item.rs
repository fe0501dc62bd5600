//! Items, and the one carrier that each of them has at every moment.

use crate::carrier::Carrier;
use crate::event::{Event, OrderChange};
use crate::line::Line;
use crate::point::Point;

#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    pub kind: usize,
    pub carrier: Carrier,
}

/// Names of all items, in the order of the supply: the kind and the number among those of this kind, from 1,
/// such as `battery_1`.
pub fn names(line: &Line) -> Vec<String> {
    let mut counts = vec![0; line.kinds.len()];
    let kinds = line.scenario.supply.iter().flat_map(|supply| supply.items.iter());
    kinds
        .map(|&kind| {
            counts[kind] += 1;
            format!("{}_{}", line.kinds[kind].name, counts[kind])
        })
        .collect()
}

/// All items of a run, with the log of what became of them.
#[derive(Clone, Debug)]
pub struct Items {
    list: Vec<Item>,
    /// Items that each machine bears, in the order in which they came.
    pub(crate) borne: Vec<Vec<usize>>,
    /// Items on the ground or on obstacles.
    fallen: Vec<usize>,
    log: Vec<Event>,
    pub(crate) scan: u64,
    /// What broke a machine, and which.
    crash: Option<(usize, String)>,
}

impl Items {
    /// The items of the line's supply, none of them on the line yet.
    pub fn new(line: &Line) -> Self {
        let kinds = line.scenario.supply.iter().flat_map(|supply| supply.items.iter());
        Self {
            list: kinds.map(|&kind| Item { kind, carrier: Carrier::Supply }).collect(),
            borne: vec![Vec::new(); line.machines.len()],
            fallen: Vec::new(),
            log: Vec::new(),
            scan: 0,
            crash: None,
        }
    }

    pub fn all(&self) -> &[Item] {
        &self.list
    }

    /// Items that became parts of another one, in the order in which they did.
    pub fn parts_of(&self, of: usize) -> Vec<usize> {
        let mut parts = Vec::new();
        for event in &self.log {
            let Event::Item { item, to, .. } = event else { continue };
            parts.retain(|other| other != item);
            if *to == (Carrier::Part { of }) {
                parts.push(*item);
            }
        }
        parts
    }

    pub fn borne_by(&self, machine: usize) -> &[usize] {
        &self.borne[machine]
    }

    /// Items that have a place on the line, in no order that means anything.
    pub fn placed(&self) -> impl Iterator<Item = usize> {
        self.borne.iter().flatten().chain(&self.fallen).copied()
    }

    /// Number of machines that could bear items.
    pub fn machines(&self) -> usize {
        self.borne.len()
    }

    pub fn log(&self) -> &[Event] {
        &self.log
    }

    /// Hands an item over to another carrier, at `point`.
    pub(crate) fn pass(&mut self, item: usize, to: Carrier, point: Point) {
        let from = std::mem::replace(&mut self.list[item].carrier, to);
        if let Some(machine) = from.machine() {
            self.borne[machine].retain(|&other| other != item);
        }
        if let Some(machine) = to.machine() {
            self.borne[machine].push(item);
        }
        if matches!(from, Carrier::Floor { .. }) {
            self.fallen.retain(|&other| other != item);
        }
        if matches!(to, Carrier::Floor { .. }) {
            self.fallen.push(item);
        }
        self.log.push(Event::Item { scan: self.scan, item, from, to, point });
    }

    /// An item becomes one of another kind.
    pub(crate) fn remake(&mut self, item: usize, kind: usize) {
        if std::mem::replace(&mut self.list[item].kind, kind) != kind {
            self.log.push(Event::Kind { scan: self.scan, item, kind });
        }
    }

    /// Only the first counts.
    pub(crate) fn crash(&mut self, machine: usize, reason: String) {
        self.crash.get_or_insert((machine, reason));
    }

    pub fn crashed(&self) -> Option<(usize, &str)> {
        self.crash.as_ref().map(|(machine, reason)| (*machine, reason.as_str()))
    }

    pub(crate) fn note_order(&mut self, machine: usize, order: usize, change: OrderChange) {
        self.log.push(Event::Order { scan: self.scan, machine, order, change });
    }
}
