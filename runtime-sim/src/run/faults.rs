//! The faults of a run after which it goes on, because a person resets the line later, or its power is lost and comes back.

use crate::line::{Line, Scenario};
use crate::report::{FaultReport, seconds};
use crate::scan::SystemOutputs;

#[derive(Clone)]
pub struct Faults<'a> {
    line: &'a Line,
    all: Vec<Fault>,
}

/// A fault of a machine, the state in which that machine was, and the scans in which it came and was cleared.
#[derive(Clone)]
struct Fault {
    code: i32,
    machine: Option<usize>,
    state: Option<usize>,
    at: u64,
    cleared: Option<u64>,
}

impl<'a> Faults<'a> {
    pub fn new(line: &'a Line) -> Self {
        Self { line, all: Vec::new() }
    }

    /// What the system puts out in this scan; `states` are those of the machines.
    pub fn note(&mut self, scan: u64, answer: SystemOutputs, states: &[usize]) {
        let machine = usize::try_from(answer.fault_robot).ok().filter(|robot| *robot < states.len());
        let present = self.all.last_mut().filter(|fault| fault.cleared.is_none());
        if let Some(fault) = present {
            if answer.fault && (fault.code, fault.machine) == (answer.fault_code, machine) {
                return;
            }
            fault.cleared = Some(scan);
        }
        if answer.fault {
            let state = machine.map(|machine| states[machine]);
            self.all.push(Fault { code: answer.fault_code, machine, state, at: scan, cleared: None });
        }
    }

    /// Code and machine of the fault that is there and that nothing clears after this scan.
    pub fn last(&self, scan: u64) -> Option<(i32, Option<usize>)> {
        let present = self.present()?;
        (!clears_later(&self.line.scenario, scan)).then_some((present.code, present.machine))
    }

    pub fn is_present(&self) -> bool {
        self.present().is_some()
    }

    fn present(&self) -> Option<&Fault> {
        self.all.last().filter(|fault| fault.cleared.is_none())
    }

    /// Those that did not end the run, in the order of their times, and the scan in which the one came that did.
    pub fn until_end(mut self, ended: Option<(i32, Option<usize>)>) -> (Vec<FaultReport>, Option<u64>) {
        let last = ended.and_then(|_| self.all.pop()).map(|fault| fault.at);
        let name = |machine: usize| self.line.machines[machine].name.clone();
        let state =
            |machine: usize, state: usize| Some(self.line.machines[machine].states.get(state)?.name.clone());
        let at_s = |scan: u64| seconds(scan, self.line.scan_ms);
        let faults = self.all.iter().map(|fault| FaultReport {
            code: fault.code,
            machine: fault.machine.map_or_else(String::new, name),
            state: fault
                .machine
                .zip(fault.state)
                .and_then(|(of, number)| state(of, number))
                .unwrap_or_default(),
            at_s: at_s(fault.at),
            cleared_s: fault.cleared.map(at_s),
        });
        (faults.collect(), last)
    }
}

/// Whether an edge of `reset` or a loss of power may clear a fault after this scan.
fn clears_later(scenario: &Scenario, scan: u64) -> bool {
    scenario.resets().any(|at| at > scan) || scenario.power_offs.iter().any(|off| off.end() > scan)
}
