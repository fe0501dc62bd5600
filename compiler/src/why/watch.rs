//! The reference executor in a run, with what it changed last and when.

use super::until::Later;
use super::{Picture, guard};
use crate::executor::{Entry, Executor};
use crate::ir::{Element, FaultId, System, Value};
use runtime_sim::device::Direction;
use runtime_sim::scan::{Controllers, SystemInputs, SystemOutputs};
use std::collections::HashMap;

/// The last change of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Change {
    pub scan: u64,
    pub by: By,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum By {
    /// An instance, or its device for an input.
    Machine(usize),
    LossOfPower,
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
    /// What inputs were before a loss of power, until they are latched after it.
    before_loss: HashMap<Element, Value>,
    /// The first scan since the last power-up.
    powered_up: u64,
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
        Self {
            system,
            executor,
            last: HashMap::new(),
            fault: None,
            before_loss: HashMap::new(),
            powered_up: 0,
            at,
            next_scan: 0,
            picture: None,
            later: None,
        }
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

    /// When a scan was that the executor counts from power-up.
    pub(super) fn ms_since_power_up(&self, scan: i32) -> u64 {
        self.ms(self.powered_up + u64::try_from(scan).unwrap_or(0))
    }

    /// The time at which it looks.
    pub(super) fn now(&self) -> u64 {
        self.ms(self.at)
    }

    /// So many scans more, before the end of which it may have to look.
    fn passes_its_time(&self, scans: u64) -> bool {
        self.picture.is_none() && self.next_scan + scans > self.at
    }

    pub(super) fn is_input(&self, element: Element) -> bool {
        match element {
            Element::Port { robot, port, .. } => {
                self.system.automaton_of(robot).device.ports[port].direction == Direction::Input
            }
            Element::Local { .. } | Element::Cell { .. } => false,
        }
    }

    fn take_changes(&mut self, scan: u64, journal: &[Entry]) {
        for entry in journal {
            if let Entry::Changed { robot, what } = *entry {
                let before = self.before_loss.remove(&what);
                if before.is_none_or(|before| before != self.executor.element(what)) {
                    self.last.insert(what, Change { scan, by: By::Machine(robot) });
                }
            }
        }
        for (what, _) in self.before_loss.drain() {
            self.last.insert(what, Change { scan, by: By::Machine(self.system.owner(what)) });
        }
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
        self.take_changes(scan, &journal);
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
        let inputs = self.last.keys().copied().filter(|what| self.is_input(*what));
        let inputs: HashMap<Element, Value> =
            inputs.map(|what| (what, self.executor.element(what))).collect();
        self.executor.power_up();
        let scan = self.next_scan;
        self.powered_up = scan;
        let journal = self.executor.take_journal();
        for entry in &journal {
            let Entry::Changed { what, .. } = *entry else { continue };
            match inputs.get(&what) {
                Some(value) => _ = self.before_loss.insert(what, *value),
                None => _ = self.last.insert(what, Change { scan, by: By::LossOfPower }),
            }
        }
        let ms = self.ms(scan);
        if self.picture.is_some()
            && let Some(later) = &mut self.later
        {
            later.lose_power(ms, &journal);
        }
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
