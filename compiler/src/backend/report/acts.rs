//! When each machine did something: what a step of it leaves behind.

use super::signals::Signal;
use super::standstills::Standstills;
use crate::ir::Group;
use runtime_sim::history::{History, MachineHistory};
use runtime_sim::io_trace::Source;

/// A time in one state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stay {
    pub begin: u64,
    /// The scan in which it was left, or that of the end.
    pub end: u64,
    pub state: usize,
}

/// Of one machine, in scans.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Acts {
    pub stays: Vec<Stay>,
    /// In which it has changed its state, a variable of its own or an output. Ascending.
    pub acted: Vec<u64>,
    /// Of each word of its inputs when it changed.
    pub inputs: Vec<Vec<u64>>,
    /// When it was stopped, by itself or with the line.
    pub stopped: Standstills,
}

/// Of all machines, up to this scan.
pub fn acts(history: &History, signals: &[Signal], end: u64) -> Vec<Acts> {
    let mut all: Vec<Acts> = history.machines.iter().map(|machine| stays(machine, end)).collect();
    for (signal, word) in signals.iter().zip(&history.words) {
        let Some(machine) = signal.machine else { continue };
        // The first entry is the value at the start; some are there to say that a value is still the same.
        let pairs = word.changes.windows(2).filter(|pair| pair[0].1.to_bits() != pair[1].1.to_bits());
        let scans = pairs.map(|pair| pair[1].0).filter(|scan| *scan < end);
        match (signal.group, signal.source) {
            (Some(Group::Input), Source::Input { word, .. }) => {
                let inputs = &mut all[machine].inputs;
                inputs.resize(inputs.len().max(word + 1), Vec::new());
                inputs[word] = scans.collect();
            }
            (Some(Group::Output | Group::Local), _) => all[machine].acted.extend(scans),
            _ => {}
        }
    }
    for machine in &mut all {
        machine.acted.sort_unstable();
        machine.acted.dedup();
    }
    all
}

fn stays(machine: &MachineHistory, end: u64) -> Acts {
    let mut acts = Acts { stopped: Standstills::of_machine(machine, end), ..Acts::default() };
    let mut again = machine.entered_again().peekable();
    for (number, stay) in machine.stays.iter().enumerate().filter(|(_, stay)| stay.scan < end) {
        // What it is counted as may have changed alone.
        if acts.stays.last().is_none_or(|last| last.state != stay.state) {
            acts.enter(stay.scan, end, stay.state);
        }
        let next = machine.stays.get(number + 1).map_or(end, |next| next.scan.min(end));
        while let Some(scan) = again.next_if(|scan| *scan < next) {
            acts.enter(scan, end, stay.state);
        }
    }
    acts
}

impl Acts {
    fn enter(&mut self, begin: u64, end: u64, state: usize) {
        if let Some(last) = self.stays.last_mut() {
            last.end = begin;
            self.acted.push(begin);
        }
        self.stays.push(Stay { begin, end, state });
    }

    /// The stay that lasts up to this scan.
    pub fn before(&self, scan: u64) -> Option<Stay> {
        let number = self.stays.partition_point(|stay| stay.begin < scan);
        number.checked_sub(1).map(|number| self.stays[number])
    }

    /// The last scan before this one in which it has acted.
    pub fn last_act(&self, scan: u64) -> Option<u64> {
        self.acted[..self.acted.partition_point(|act| *act < scan)].last().copied()
    }

    pub fn has_acted(&self, scan: u64) -> bool {
        self.acted.binary_search(&scan).is_ok()
    }

    /// Whether it has left a state in this scan.
    pub fn has_left(&self, scan: u64) -> bool {
        self.before(scan).is_some_and(|stay| stay.end == scan)
    }

    pub fn input_changed(&self, word: usize, scan: u64) -> bool {
        self.inputs.get(word).is_some_and(|scans| scans.binary_search(&scan).is_ok())
    }
}
