//! The reference executor in a run, with what it changed last and when.

use super::until::Later;
use super::{Picture, guard};
use crate::executor::{Entry, Executor};
use crate::ir::{Element, FaultId, System};
use runtime_sim::scan::{Controllers, SystemInputs, SystemOutputs};
use std::collections::HashMap;

/// The last change of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Change {
    pub scan: u64,
    pub robot: usize,
}

/// The fault in which the line stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Stopped {
    pub site: FaultId,
    pub robot: usize,
    pub scan: u64,
}

/// Controllers that look at themselves after a scan.
pub struct Watch<'a> {
    pub(super) system: &'a System,
    pub(super) executor: Executor<'a>,
    pub(super) last: HashMap<Element, Change>,
    pub(super) fault: Option<Stopped>,
    /// After this scan the picture is taken.
    at: u64,
    next_scan: u64,
    picture: Option<Picture>,
    later: Option<Later>,
}

impl<'a> Watch<'a> {
    /// Looks after scan number `at`, or at the end of a run that ends before.
    pub fn new(system: &'a System, at: u64) -> Self {
        let mut executor = Executor::new(system);
        executor.keep_journal();
        let last = HashMap::new();
        Self { system, executor, last, fault: None, at, next_scan: 0, picture: None, later: None }
    }

    /// Also looks on, until each of these machines has left the state in which it is then.
    pub fn until_left(mut self, machines: Vec<usize>) -> Self {
        self.later = Some(Later::new(machines));
        self
    }

    /// Nothing more has to be known of the run.
    pub fn is_done(&self) -> bool {
        self.picture.is_some() && self.later.as_ref().is_none_or(Later::is_done)
    }

    /// What was seen, once the run has ended; `scans` is how many it had.
    pub fn finish(mut self, scans: u64) -> (Picture, Option<Later>) {
        let picture = self.picture.take().unwrap_or_else(|| {
            let end = self.at.min(scans.saturating_sub(1));
            let passed = (end + 1).saturating_sub(self.next_scan);
            self.executor.skip(passed);
            guard::picture(&mut self, end)
        });
        (picture, self.later)
    }

    pub(super) fn ms(&self, scan: u64) -> u64 {
        scan * self.system.scan_ms as u64
    }

    /// The time at which it looks.
    pub(super) fn now(&self) -> u64 {
        self.ms(self.at)
    }

    /// So many scans more, before the end of which it may have to look.
    fn passes_its_time(&self, scans: u64) -> bool {
        self.picture.is_none() && self.next_scan + scans > self.at
    }

    fn look(&mut self, scan: u64) {
        let picture = guard::picture(self, scan);
        if let Some(mut later) = self.later.take() {
            later.begin(self);
            self.later = Some(later);
        }
        self.picture = Some(picture);
    }
}

impl Controllers for Watch<'_> {
    fn scan(&mut self, system: SystemInputs, inputs: &[Vec<f64>], outputs: &mut [Vec<f64>]) -> SystemOutputs {
        let scan = self.next_scan;
        let answer = self.executor.scan(system, inputs, outputs);
        self.next_scan += 1;
        let stopped = (answer.fault && self.fault.is_none()).then(|| Stopped {
            site: FaultId((answer.fault_code - 1) as usize),
            robot: answer.fault_robot as usize,
            scan,
        });
        self.fault = stopped.or(self.fault.filter(|_| answer.fault));
        let journal = self.executor.take_journal();
        for entry in &journal {
            if let Entry::Changed { robot, what } = *entry {
                self.last.insert(what, Change { scan, robot });
            }
        }
        if self.picture.is_none() && scan == self.at {
            self.look(scan);
        } else if self.picture.is_some()
            && let Some(mut later) = self.later.take()
        {
            later.take(self, scan, &journal);
            self.later = Some(later);
        }
        answer
    }

    fn lose_power(&mut self, scans: u64) {
        if self.passes_its_time(scans) {
            self.look(self.at);
        }
        self.next_scan += scans;
    }

    fn power_up(&mut self) {
        self.executor.power_up();
    }

    fn state(&self, machine: usize) -> usize {
        self.executor.state(machine)
    }

    fn trace(&self, out: &mut Vec<f64>) {
        self.executor.trace(out);
    }

    fn stays(&self) -> Vec<usize> {
        self.executor.stays()
    }

    fn skip(&mut self, scans: u64) {
        let mut left = scans;
        if self.passes_its_time(scans) {
            let first = (self.at + 1).saturating_sub(self.next_scan);
            self.executor.skip(first);
            self.look(self.at);
            left -= first;
        }
        self.executor.skip(left);
        self.next_scan += scans;
    }
}
