//! What goes wrong in the plant at given times.

use crate::line::{During, Line, Stuck};

/// The faults of one machine.
#[derive(Clone, Debug)]
pub struct Faults {
    /// The one that begins first comes first.
    sensors: Vec<Stuck>,
}

impl Faults {
    pub fn new(line: &Line, machine: usize) -> Self {
        let sensors = line.scenario.sensors.iter().filter(|stuck| stuck.machine == machine);
        let mut sensors: Vec<Stuck> = sensors.cloned().collect();
        sensors.sort_by_key(|stuck| stuck.during.at_scan);
        Self { sensors }
    }

    fn all(&self) -> impl Iterator<Item = &During> {
        self.sensors.iter().map(|stuck| &stuck.during)
    }

    /// The first scan after this one in which a fault begins or ends. None: there is none.
    pub fn next_change(&self, scan: u64) -> Option<u64> {
        self.all().flat_map(During::changes).filter(|at| *at > scan).min()
    }

    /// A fault holds that ends.
    pub fn is_passing(&self, scan: u64) -> bool {
        self.all().any(|during| during.holds(scan) && during.scans.is_some())
    }

    /// Of several values of one input, that of the fault that began last.
    pub fn stick(&self, scan: u64, image: &mut [f64]) {
        for stuck in self.sensors.iter().filter(|stuck| stuck.during.holds(scan)) {
            image[stuck.word..stuck.word + stuck.words].fill(stuck.value);
        }
    }
}
