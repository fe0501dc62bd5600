//! Which scans have to be executed: those in which a guard may begin to hold, or the plant may change by itself.

use super::changes::Changes;
use crate::line::Line;
use crate::monitor::Counter;
use crate::plant::Plant;
use crate::scan::{SystemInputs, SystemOutputs};

/// What the controllers wait for since the last scan in which they were stepped. A scan in which none of this happens
/// does nothing but let times in states continue.
pub struct Agenda<'a> {
    line: &'a Line,
    /// Where in the trace the time in its state stands, by machine.
    stays: Vec<usize>,
    /// The last scan in which the controllers were stepped, and what they were given and gave in it.
    last: Option<Stepped>,
    /// The inputs that they latched in it.
    latched: Vec<Vec<f64>>,
    analogue: Vec<Vec<bool>>,
}

struct Stepped {
    scan: u64,
    system: SystemInputs,
    running: bool,
    /// Something has changed in it.
    acted: bool,
}

impl<'a> Agenda<'a> {
    /// `analogue` says which words of the inputs change while a machine moves.
    pub fn new(line: &'a Line, stays: Vec<usize>, inputs: &[Vec<f64>], analogue: Vec<Vec<bool>>) -> Self {
        Self { line, stays, last: None, latched: inputs.to_vec(), analogue }
    }

    /// The controllers have lost their power and have it again: the next scan is their first one.
    pub fn power_up(&mut self) {
        self.last = None;
    }

    /// Scans since the controllers were stepped last.
    pub fn scans_since(&self, scan: u64) -> u64 {
        self.last.as_ref().map_or(1, |last| scan - last.scan)
    }

    /// Whether the controllers have to be stepped in this scan.
    pub fn is_due(
        &self,
        scan: u64,
        system: SystemInputs,
        inputs: &[Vec<f64>],
        states: &[usize],
        changes: &Changes,
    ) -> bool {
        let Some(last) = &self.last else { return true };
        if last.acted || system != last.system {
            return true;
        }
        let differs = |machine: usize, word: &usize| {
            self.latched[machine].get(*word).map(|w| w.to_bits())
                != inputs[machine].get(*word).map(|w| w.to_bits())
        };
        let mut machines = self.line.machines.iter().enumerate();
        if machines.any(|(machine, it)| it.monitor.panel.iter().any(|word| differs(machine, word))) {
            return true;
        }
        if !last.running {
            return false;
        }
        let passed = ((scan - last.scan) * u64::from(self.line.scan_ms)) as f64;
        self.line.machines.iter().enumerate().any(|(machine, description)| {
            let Some(state) = description.states.get(states[machine]) else { return true };
            let stay = self.stays.get(machine).map_or(0.0, |word| changes.stay(*word));
            let ends = |timer: &u32| stay < f64::from(*timer) && f64::from(*timer) <= stay + passed;
            let monitor = &description.monitor;
            let stops = monitor.is_stopped(changes.trace());
            let counter_ends = |counter: &Counter| {
                let waited = changes.stay(counter.word);
                let ends = |limit: u32| waited < f64::from(limit) && f64::from(limit) <= waited + passed;
                waited >= 0.0 && counter.limit.is_none_or(ends)
            };
            !stops
                && (state.timers.as_ref().is_none_or(|timers| timers.iter().any(ends))
                    || monitor.counters.iter().any(counter_ends))
                || state.reads.iter().any(|word| differs(machine, word))
                || state
                    .reads_while
                    .iter()
                    .any(|read| differs(machine, &read.word) && read.is_read(&self.latched[machine]))
        })
    }

    /// The controllers were stepped.
    pub fn step(
        &mut self,
        scan: u64,
        system: SystemInputs,
        inputs: &[Vec<f64>],
        answer: SystemOutputs,
        changed: bool,
    ) {
        let running = answer.running;
        let was_running = self.last.as_ref().is_some_and(|last| last.running);
        self.last = Some(Stepped { scan, system, running, acted: changed || running != was_running });
        for (latched, input) in self.latched.iter_mut().zip(inputs) {
            latched.copy_from_slice(input);
        }
    }

    /// The first scan after this one in which the controllers may have to be stepped, if no device changes anything.
    /// None: never.
    pub fn next_step(&self, scan: u64, states: &[usize], changes: &Changes, plant: &Plant) -> Option<u64> {
        let Some(last) = &self.last else { return Some(scan + 1) };
        if last.acted && last.scan == scan {
            return Some(scan + 1);
        }
        if !last.running {
            return None;
        }
        let mut next: Option<u64> = None;
        for (machine, description) in self.line.machines.iter().enumerate() {
            let Some(state) = description.states.get(states[machine]) else { return Some(scan + 1) };
            let is_analogue = |word: &usize| self.analogue[machine].get(*word) == Some(&true);
            let reads_analogue = || {
                state.reads.iter().any(is_analogue)
                    || state
                        .reads_while
                        .iter()
                        .any(|read| is_analogue(&read.word) && read.is_read(&self.latched[machine]))
            };
            if reads_analogue() && plant.moves(machine) {
                return Some(scan + 1);
            }
            if description.monitor.is_stopped(changes.trace()) {
                continue;
            }
            let Some(timers) = &state.timers else { return Some(scan + 1) };
            let counters = &description.monitor.counters;
            if counters.iter().any(|it| it.limit.is_none() && changes.stay(it.word) >= 0.0) {
                return Some(scan + 1);
            }
            if let Some(ends) = self.timer_ends(last, machine, timers, changes).min() {
                let due = ends.max(scan + 1);
                next = Some(next.map_or(due, |next| next.min(due)));
            }
        }
        next
    }

    /// Whether a timer of a machine is running, which ends after this scan: of its present state, or of a property.
    pub fn is_timed(&self, scan: u64, states: &[usize], changes: &Changes) -> bool {
        let Some(last) = self.last.as_ref().filter(|last| last.running) else { return false };
        self.line.machines.iter().enumerate().any(|(machine, description)| {
            let timers = description.states.get(states[machine]).and_then(|state| state.timers.as_deref());
            !description.monitor.is_stopped(changes.trace())
                && self.timer_ends(last, machine, timers.unwrap_or_default(), changes).any(|ends| ends > scan)
        })
    }

    /// The scans in which timers of a machine end that had not ended in the last step.
    fn timer_ends(
        &self,
        last: &Stepped,
        machine: usize,
        timers: &[u32],
        changes: &Changes,
    ) -> impl Iterator<Item = u64> {
        let stay = self.stays.get(machine).map_or(0.0, |word| changes.stay(*word));
        let of_state = timers.iter().map(move |timer| f64::from(*timer) - stay);
        let of_properties = self.line.machines[machine].monitor.counters.iter().filter_map(|counter| {
            let waited = changes.stay(counter.word);
            counter.limit.filter(|_| waited >= 0.0).map(|limit| f64::from(limit) - waited)
        });
        let [scan, scan_ms] = [last.scan, u64::from(self.line.scan_ms)];
        let left = of_state.chain(of_properties).filter(|left| *left > 0.0);
        left.map(move |left| scan + (left / scan_ms as f64).ceil() as u64)
    }
}
