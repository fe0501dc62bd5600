//! What goes wrong in a run.

use super::check::LONGEST_TIME;
use crate::machine::Machine;

/// A gripper loses what it holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Slip {
    pub machine: usize,
    /// The how manieth part that this gripper has attached, from 1.
    pub pick: u32,
    /// Counted from the moment it was attached.
    pub after_s: f64,
}

/// A device answers a command with [`crate::device::error::REFUSED`].
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    pub machine: usize,
    /// The how manieth command that this device has accepted, from 1.
    pub command: u32,
}

/// How a device answers one of its commands.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    pub machine: usize,
    /// The how manieth command that this device has accepted, from 1.
    pub command: u32,
    /// So long after it has ended.
    pub late_s: f64,
    /// It ends in this error: if it is the one of a signal that the command awaits, that does not come; with any other
    /// nothing moves.
    pub error: Option<i32>,
}

/// `run_permit` is taken away; when it is back, an edge of `start` is given.
#[derive(Clone, Debug, PartialEq)]
pub struct Pause {
    pub at_scan: u64,
    pub scans: u64,
}

/// From the start of a scan on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct During {
    pub at_scan: u64,
    /// None: to the end of the run.
    pub scans: Option<u64>,
}

/// Inputs of a machine read a fixed value. Its own parts and commands do not: the fault is in the wires between the
/// machine and its controller.
#[derive(Clone, Debug, PartialEq)]
pub struct Stuck {
    pub machine: usize,
    /// The first word in the image of the inputs, and the number of words.
    pub word: usize,
    pub words: usize,
    pub value: f64,
    pub during: During,
}

/// A part of a machine stands, whatever moves it.
#[derive(Clone, Debug, PartialEq)]
pub struct Jam {
    pub machine: usize,
    pub part: usize,
    pub during: During,
}

/// A cycle of a process takes longer.
#[derive(Clone, Debug, PartialEq)]
pub struct SlowCycle {
    pub machine: usize,
    pub part: usize,
    /// The how manieth cycle that was started, from 1.
    pub cycle: u32,
    pub longer_s: f64,
}

impl Pause {
    /// The scan in which it is over.
    pub fn end(&self) -> u64 {
        self.at_scan.saturating_add(self.scans)
    }

    pub fn holds(&self, scan: u64) -> bool {
        (self.at_scan..self.end()).contains(&scan)
    }
}

impl During {
    /// The scan in which it is over.
    pub fn end(&self) -> Option<u64> {
        self.scans.map(|scans| self.at_scan.saturating_add(scans))
    }

    pub fn holds(&self, scan: u64) -> bool {
        self.at_scan <= scan && self.end().is_none_or(|end| scan < end)
    }

    /// The scans in which it begins and ends.
    pub fn changes(&self) -> impl Iterator<Item = u64> + use<> {
        [Some(self.at_scan), self.end()].into_iter().flatten()
    }
}

impl Stuck {
    pub(super) fn check(&self, machine: &Machine, kinds: usize) -> Result<(), String> {
        let words = machine.wiring.input_words(kinds);
        if self.word.checked_add(self.words).is_none_or(|end| end > words) {
            return Err(format!("a sensor of {} that is not there sticks", machine.name));
        }
        if !self.value.is_finite() {
            return Err(format!("a sensor of {} sticks at no number", machine.name));
        }
        Ok(())
    }
}

impl Jam {
    pub(super) fn check(&self, machine: &Machine) -> Result<(), String> {
        match machine.parts.get(self.part) {
            Some(part) if part.schema().can_jam => Ok(()),
            _ => Err(format!("a jam of {}, in a part that does not move", machine.name)),
        }
    }
}

impl SlowCycle {
    pub(super) fn check(&self, machine: &Machine) -> Result<(), String> {
        if machine.parts.get(self.part).is_none_or(|part| part.schema().name != "process") {
            return Err(format!("a slow cycle of {}, of a part that is no process", machine.name));
        }
        if !(0.0..=LONGEST_TIME).contains(&self.longer_s) {
            return Err(format!("a cycle of {} that takes {:?} s longer", machine.name, self.longer_s));
        }
        Ok(())
    }
}
