//! Which scans have to be executed: those in which a guard may begin to hold, or the plant may change by itself.

use super::changes::Changes;
use crate::image::are_same;
use crate::line::{Line, State};
use crate::plant::{Arrived, Plant};
use crate::scan::{SystemInputs, SystemOutputs};
use std::cell::OnceCell;

/// What controllers were given and gave when they were stepped last, and what has come since. A scan in which nothing
/// happens that they wait for does nothing but let times in states continue.
#[derive(Clone)]
pub struct Agenda {
    /// Where in the trace the time in its state stands, by machine.
    stays: Vec<usize>,
    /// The last scan in which the controllers were stepped, and what they were given and gave in it.
    last: Option<Stepped>,
    /// The inputs that they latched in it.
    latched: Vec<Vec<f64>>,
    /// The inputs may be others by now.
    has_arrived: bool,
    analogue: Vec<Vec<bool>>,
}

/// What the controllers of a line wait for.
pub struct Waits<'a> {
    line: &'a Line,
    /// Since the last step; none until somebody asks.
    awaited: OnceCell<Awaited>,
}

#[derive(Clone)]
struct Stepped {
    scan: u64,
    system: SystemInputs,
    running: bool,
    after: After,
}

/// What may happen in the scan after one because of what has happened in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum After {
    /// Nothing has happened.
    Nothing,
    /// Only devices have something new to do.
    Devices,
    Anything,
}

/// What may happen without an event of a device or of the line.
#[derive(Default)]
struct Awaited {
    /// Something may happen in any scan.
    anything: bool,
    /// The scans in which the first of all timers ends and the last one.
    timers: Option<[u64; 2]>,
    /// Machines, stopped ones too, in states that read words which change while something moves.
    places: Vec<usize>,
}

impl<'a> Waits<'a> {
    pub fn new(line: &'a Line) -> Self {
        Self { line, awaited: OnceCell::new() }
    }

    /// The controllers were stepped: they may wait for something else.
    pub fn step(&mut self) {
        self.awaited = OnceCell::new();
    }
}

impl Agenda {
    /// `analogue` says which words of the inputs change while a machine moves.
    pub fn new(stays: Vec<usize>, inputs: &[Vec<f64>], analogue: Vec<Vec<bool>>) -> Self {
        Self { stays, last: None, latched: inputs.to_vec(), has_arrived: false, analogue }
    }

    /// What has become of the inputs.
    pub fn arrive(&mut self, arrived: Arrived) {
        self.has_arrived |= arrived != Arrived::Nothing;
    }

    /// The controllers have lost their power and have it again: the next scan is their first one.
    pub fn power_up(&mut self) {
        self.last = None;
    }

    /// Scans since the controllers were stepped last.
    pub fn scans_since(&self, scan: u64) -> u64 {
        self.last.as_ref().map_or(1, |last| scan - last.scan)
    }

    /// Whether controllers that wait for this have to be stepped in this scan.
    pub fn is_due(
        &self,
        waits: &Waits,
        scan: u64,
        system: SystemInputs,
        inputs: &[Vec<f64>],
        states: &[usize],
        changes: &Changes,
    ) -> bool {
        let Some(last) = &self.last else { return true };
        if last.after == After::Anything || system != last.system {
            return true;
        }
        if last.running {
            let awaited = self.awaited(waits, last, states, changes);
            if awaited.anything || awaited.timers.is_some_and(|[first, _]| first <= scan) {
                return true;
            }
        }
        let machines = 0..self.latched.len();
        self.has_arrived
            && machines.into_iter().any(|machine| self.has_news(waits, machine, last, inputs, states))
    }

    /// Whether an input of a machine that it reads is another one than it latched.
    fn has_news(
        &self,
        waits: &Waits,
        machine: usize,
        last: &Stepped,
        inputs: &[Vec<f64>],
        states: &[usize],
    ) -> bool {
        let (latched, inputs) = (&self.latched[machine], &inputs[machine]);
        if are_same(latched, inputs) {
            return false;
        }
        if !last.running {
            // Who looks at a line that stands looks at what it has latched.
            return true;
        }
        let differs =
            |word: &usize| latched.get(*word).map(|w| w.to_bits()) != inputs.get(*word).map(|w| w.to_bits());
        let description = &waits.line.machines[machine];
        if description.monitor.panel.iter().any(differs) {
            return true;
        }
        let Some(state) = description.states.get(states[machine]) else { return true };
        state.reads.iter().any(differs)
            || state.reads_while.iter().any(|read| differs(&read.word) && read.is_read(latched))
    }

    /// The controllers were stepped.
    pub fn step(
        &mut self,
        scan: u64,
        system: SystemInputs,
        inputs: &[Vec<f64>],
        answer: SystemOutputs,
        after: After,
    ) {
        let running = answer.running;
        let was_running = self.last.as_ref().is_some_and(|last| last.running);
        let after = if running == was_running { after } else { After::Anything };
        self.last = Some(Stepped { scan, system, running, after });
        for (latched, input) in self.latched.iter_mut().zip(inputs) {
            latched.copy_from_slice(input);
        }
        self.has_arrived = false;
    }

    /// The first scan after this one in which the controllers may have to be stepped, if no device changes anything.
    /// None: never.
    pub fn next_step(
        &self,
        waits: &Waits,
        scan: u64,
        states: &[usize],
        changes: &Changes,
        plant: &Plant,
    ) -> Option<u64> {
        let Some(last) = &self.last else { return Some(scan + 1) };
        if last.after != After::Nothing && last.scan == scan {
            return Some(scan + 1);
        }
        if !last.running {
            return None;
        }
        let awaited = self.awaited(waits, last, states, changes);
        if awaited.anything || awaited.places.iter().any(|machine| plant.moves(*machine)) {
            return Some(scan + 1);
        }
        awaited.timers.map(|[first, _]| first.max(scan + 1))
    }

    /// Whether a timer of a machine is running, which ends after this scan: of its present state, or of a property.
    pub fn is_timed(&self, waits: &Waits, scan: u64, states: &[usize], changes: &Changes) -> bool {
        let Some(last) = self.last.as_ref().filter(|last| last.running) else { return false };
        self.awaited(waits, last, states, changes).timers.is_some_and(|[_, end]| end > scan)
    }

    fn awaited<'a>(
        &self,
        waits: &'a Waits,
        last: &Stepped,
        states: &[usize],
        changes: &Changes,
    ) -> &'a Awaited {
        waits.awaited.get_or_init(|| {
            let mut awaited = Awaited::default();
            for (machine, state) in states.iter().enumerate() {
                self.await_machine(&mut awaited, waits.line, last, (machine, *state), changes);
            }
            awaited
        })
    }

    /// Adds what a machine waits for in its state.
    fn await_machine(
        &self,
        awaited: &mut Awaited,
        line: &Line,
        last: &Stepped,
        (machine, state): (usize, usize),
        changes: &Changes,
    ) {
        let description = &line.machines[machine];
        let state = description.states.get(state);
        if state.is_some_and(|state| self.reads_places(machine, state)) {
            awaited.places.push(machine);
        }
        awaited.anything |= state.is_none();
        if description.monitor.is_stopped(changes.trace()) {
            return;
        }
        let timers = state.and_then(|state| state.timers.as_deref());
        let counters = &description.monitor.counters;
        awaited.anything |=
            timers.is_none() || counters.iter().any(|it| it.limit.is_none() && changes.stay(it.word) >= 0.0);
        for ends in self.timer_ends(line, last, machine, timers.unwrap_or_default(), changes) {
            let [earliest, latest] = awaited.timers.unwrap_or([ends; 2]);
            awaited.timers = Some([earliest.min(ends), latest.max(ends)]);
        }
    }

    /// Whether a state reads words that change while something moves.
    fn reads_places(&self, machine: usize, state: &State) -> bool {
        let is_analogue = |word: &usize| self.analogue[machine].get(*word) == Some(&true);
        let latched = &self.latched[machine];
        state.reads.iter().any(is_analogue)
            || state.reads_while.iter().any(|read| is_analogue(&read.word) && read.is_read(latched))
    }

    /// The scans in which timers of a machine end that had not ended in the last step.
    fn timer_ends(
        &self,
        line: &Line,
        last: &Stepped,
        machine: usize,
        timers: &[u32],
        changes: &Changes,
    ) -> impl Iterator<Item = u64> {
        let stay = self.stays.get(machine).map_or(0.0, |word| changes.stay(*word));
        let of_state = timers.iter().map(move |timer| f64::from(*timer) - stay);
        let of_properties = line.machines[machine].monitor.counters.iter().filter_map(|counter| {
            let waited = changes.stay(counter.word);
            counter.limit.filter(|_| waited >= 0.0).map(|limit| f64::from(limit) - waited)
        });
        let [scan, scan_ms] = [last.scan, u64::from(line.scan_ms)];
        let left = of_state.chain(of_properties).filter(|left| *left > 0.0);
        left.map(move |left| scan + (left / scan_ms as f64).ceil() as u64)
    }
}
