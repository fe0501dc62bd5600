//! A person takes an item off the line.

use super::Plant;
use crate::carrier::Carrier;
use crate::item::Names;
use crate::line::Removal;

/// An item that is taken away at the start of a scan.
#[derive(Clone, Debug)]
pub struct Removing {
    item: Option<usize>,
    at_scan: u64,
    /// Why it was not taken away.
    pub missed: Option<NotRemoved>,
}

/// Why an item was not taken away.
#[derive(Clone, Copy, Debug)]
pub enum NotRemoved {
    /// It was not on the line: not there yet, in a gripper, a part of another item, or gone.
    Elsewhere(Carrier),
    /// This item lay on it.
    Under(usize),
}

impl Removing {
    pub fn new(removal: &Removal, names: &Names) -> Self {
        let Removal { kind, number, at_scan } = *removal;
        Self { item: names.find(kind, number), at_scan: at_scan.max(1), missed: None }
    }

    pub fn next_change(&self, scan: u64) -> Option<u64> {
        Some(self.at_scan).filter(|at| *at > scan)
    }
}

impl Plant {
    /// Takes away what is to be taken away at the start of this scan, if it lies on a conveyor, at a place or on
    /// the floor, or on an item that does; what lies on it goes too.
    pub(super) fn remove(&mut self, scan: u64) {
        for number in 0..self.removing.len() {
            let Removing { item: Some(item), at_scan, .. } = self.removing[number] else { continue };
            if at_scan != scan {
                continue;
            }
            let carrier = self.base_carrier(item);
            match (carrier, self.place(item)) {
                (Carrier::Lane { .. } | Carrier::Place { .. } | Carrier::Floor { .. }, Some(point)) => {
                    match self.lies_on(item, (scan * self.scan_ms) as f64) {
                        Some(upper) => self.removing[number].missed = Some(NotRemoved::Under(upper)),
                        None => self.items.pass(item, Carrier::Collector, point),
                    }
                }
                _ => self.removing[number].missed = Some(NotRemoved::Elsewhere(carrier)),
            }
        }
    }

    /// Of each removal of the scenario why nothing was taken away.
    pub(crate) fn missed_removals(&self) -> impl Iterator<Item = Option<NotRemoved>> {
        self.removing.iter().map(|removing| removing.missed)
    }
}
