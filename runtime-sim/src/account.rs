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

/// What the scans of a machine are counted as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Counted {
    Moving,
    Working,
    Waiting,
    Stopped,
}

impl Activity {
    pub fn counted(self, line: &Line, machine: usize) -> Counted {
        match self {
            Activity::Stopped => Counted::Stopped,
            Activity::Moving => Counted::Moving,
            Activity::InState(state) => match line.machines[machine].states.get(state) {
                Some(state) if state.working => Counted::Working,
                _ => Counted::Waiting,
            },
        }
    }
}

impl Account {
    pub fn new(line: &Line) -> Self {
        Self { waiting_for: vec![0; line.machines.len()], ..Self::default() }
    }

    /// What the machine does in so many scans.
    pub fn book(&mut self, line: &Line, machine: usize, activity: Activity, scans: u64) {
        match activity.counted(line, machine) {
            Counted::Stopped => self.stopped += scans,
            Counted::Moving => self.moving += scans,
            Counted::Working => self.working += scans,
            Counted::Waiting => self.waiting += scans,
        }
        if let (Activity::InState(state), Counted::Waiting) = (activity, activity.counted(line, machine)) {
            let state = line.machines[machine].states.get(state);
            for &owner in state.iter().flat_map(|state| &state.awaits) {
                self.waiting_for[owner] += scans;
            }
        }
    }
}
