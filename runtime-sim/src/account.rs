//! What each machine did with its time.

use crate::line::Line;

/// Scans of a machine. The first four add up to all scans of the run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Account {
    /// A command is under way: its number differs from the `ack` that the controller sees.
    pub moving: u64,
    /// Not moving, and the present state awaits a timer or a port of its own.
    pub working: u64,
    /// Neither: the present state awaits other machines.
    pub waiting: u64,
    /// The system does not run.
    pub stopped: u64,
    /// Of `waiting`, for each machine of the line, the scans in which it was awaited. In a state that
    /// awaits several machines the scan counts for each of them.
    pub waiting_for: Vec<u64>,
}

/// What a machine does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Activity {
    Stopped,
    Moving,
    /// No command is under way; the number of the state it is in.
    InState(usize),
}

impl Account {
    pub fn new(line: &Line) -> Self {
        Self { waiting_for: vec![0; line.machines.len()], ..Self::default() }
    }

    /// What the machine does in so many scans.
    pub fn book(&mut self, line: &Line, machine: usize, activity: Activity, scans: u64) {
        match activity {
            Activity::Stopped => self.stopped += scans,
            Activity::Moving => self.moving += scans,
            Activity::InState(state) => match line.machines[machine].states.get(state) {
                Some(state) if state.working => self.working += scans,
                Some(state) => {
                    self.waiting += scans;
                    for &owner in &state.awaits {
                        self.waiting_for[owner] += scans;
                    }
                }
                None => self.waiting += scans,
            },
        }
    }
}
