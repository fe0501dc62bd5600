//! What goes wrong in the plant at given times.

use crate::line::{During, Jam, Line, Stuck};

/// The faults of one machine.
#[derive(Clone, Debug)]
pub struct Faults {
    /// The one that begins first comes first.
    sensors: Vec<Stuck>,
    jams: Vec<Jam>,
}

impl Faults {
    pub fn new(line: &Line, machine: usize) -> Self {
        let sensors = line.scenario.sensors.iter().filter(|stuck| stuck.machine == machine);
        let mut sensors: Vec<Stuck> = sensors.cloned().collect();
        sensors.sort_by_key(|stuck| stuck.during.at_scan);
        let jams = line.scenario.jams.iter().filter(|jam| jam.machine == machine).cloned().collect();
        Self { sensors, jams }
    }

    pub fn exist(&self) -> bool {
        self.all().next().is_some()
    }

    fn all(&self) -> impl Iterator<Item = &During> {
        let jams = self.jams.iter().map(|jam| &jam.during);
        self.sensors.iter().map(|stuck| &stuck.during).chain(jams)
    }

    /// The first scan after this one in which a fault begins or ends, or in which the plant shows that it did in this
    /// one. None: there is none.
    pub fn next_change(&self, scan: u64) -> Option<u64> {
        let changes = self.all().flat_map(During::changes).filter(|at| *at > scan);
        let mut jams = self.jams.iter().flat_map(|jam| jam.during.changes());
        changes.chain(jams.any(|at| at == scan).then_some(scan + 1)).min()
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

    /// The parts that jam at some time.
    pub fn jamming(&self) -> impl Iterator<Item = usize> {
        self.jams.iter().map(|jam| jam.part)
    }

    pub fn is_jammed(&self, part: usize, scan: u64) -> bool {
        self.jams.iter().any(|jam| jam.part == part && jam.during.holds(scan))
    }
}
