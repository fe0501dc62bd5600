//! Cylinders and processes: what is set going by an output, and goes on by itself.

use crate::event::{Event, What};
use crate::model::Model;
use crate::plant::Level;
use crate::program::bit;
use crate::scan::Scan;
use crate::value::Var;

#[derive(Clone, Debug)]
pub struct Cylinder {
    pub machine: usize,
    /// Number among the parts of the machine.
    pub part: usize,
    /// One of [`position`].
    pub position: Var,
    /// What its valves ask for and what they have asked for before, as far as that may still move it: a bit for each of
    /// [`drive`].
    pub drives: Var,
    pub extend: Option<Level>,
    pub retract: Option<Level>,
    pub centre: Centre,
    /// A stroke inwards, and one outwards, may be over from one scan to the next.
    pub leaps: [bool; 2],
}

/// What it does while the valves do not send it to one end.
#[derive(Clone, Copy, Debug)]
pub enum Centre {
    /// There is one valve: a spring brings it back.
    Spring,
    Stands,
    /// It goes on to the end to which it was sent last: one of [`drive`].
    GoesOn(Var),
}

/// Values of [`Cylinder::position`].
pub mod position {
    pub const IN: i32 = 0;
    pub const BETWEEN: i32 = 1;
    pub const OUT: i32 = 2;
}

/// Numbers of the bits of [`Cylinder::drives`].
pub mod drive {
    pub const IN: i32 = 0;
    pub const OUT: i32 = 1;
    pub const STANDS: i32 = 2;
}

/// Work that begins at a rising edge.
#[derive(Clone, Debug)]
pub struct Process {
    pub machine: usize,
    /// Number among the parts of the machine.
    pub part: usize,
    /// There was an edge on which it has not acted.
    pub asked: Var,
    pub runs: Var,
    pub ended: Var,
    pub start: Option<Level>,
    /// It may be over from one scan to the next.
    pub leaps: bool,
}

impl Cylinder {
    /// Where the valves send it.
    fn sent(&self, state: &[u8]) -> i32 {
        let [extend, retract] =
            [self.extend, self.retract].map(|valve| valve.is_some_and(|v| v.is_on(state)));
        match (self.centre, extend, retract) {
            (Centre::Spring, true, _) | (_, true, false) => drive::OUT,
            (Centre::Spring, false, _) | (_, false, true) => drive::IN,
            (Centre::Stands, ..) => drive::STANDS,
            (Centre::GoesOn(toward), ..) => toward.load(state),
        }
    }

    /// Those of some drives that would move it from where it is.
    fn moving(&self, state: &[u8]) -> i32 {
        let fixed = match self.position.load(state) {
            position::IN => 1 << drive::IN,
            position::OUT => 1 << drive::OUT,
            _ => 0,
        };
        self.drives.load(state) & !fixed & !(1 << drive::STANDS)
    }
}

/// Sources of events are the cylinders, then the processes.
pub(crate) fn sources(model: &Model) -> usize {
    model.cylinders.len() + model.processes.len()
}

pub(crate) fn events(model: &Model, state: &[u8], source: usize, out: &mut Vec<Event>) {
    let Some(cylinder) = model.cylinders.get(source) else {
        let number = source - model.cylinders.len();
        let process = &model.processes[number];
        let mut add = |what| out.push(Event { machine: process.machine, what });
        let is_asked = process.asked.load(state) != 0;
        let runs = process.runs.load(state) != 0;
        if is_asked {
            add(What::Begins(number));
        }
        if is_asked && !runs && process.leaps {
            add(What::Leaps(number));
        }
        if runs {
            add(What::Completes(number));
        }
        return;
    };
    let mut add = |what| out.push(Event { machine: cylinder.machine, what });
    let moving = cylinder.moving(state);
    // Before the system runs, any time has passed.
    let begins = model.instances[cylinder.machine].state.load(state) == 0;
    let at = cylinder.position.load(state);
    for (drive, end) in [(drive::IN, position::IN), (drive::OUT, position::OUT)] {
        if moving & 1 << drive == 0 {
            continue;
        }
        if at != position::BETWEEN {
            add(What::Strokes { cylinder: source, drive, to: position::BETWEEN });
        }
        if at == position::BETWEEN || begins || cylinder.leaps[drive as usize] {
            add(What::Strokes { cylinder: source, drive, to: end });
        }
    }
    let sent = 1 << cylinder.sent(state);
    if moving & !sent != 0 && moving & sent == 0 {
        add(What::Settles(source));
    }
}

/// The state after an event of a cylinder or of a process.
pub(crate) fn apply(model: &Model, state: &mut [u8], what: What) {
    match what {
        What::Strokes { cylinder, drive, to } => {
            let cylinder = &model.cylinders[cylinder];
            cylinder.position.store(state, to);
            let sent = cylinder.sent(state);
            // Valves act one after another: what was asked for before is over.
            let left = if drive == sent { 0 } else { cylinder.moving(state) };
            cylinder.drives.store(state, left | 1 << sent);
        }
        What::Settles(cylinder) => {
            let cylinder = &model.cylinders[cylinder];
            let sent = cylinder.sent(state);
            cylinder.drives.store(state, 1 << sent);
        }
        What::Begins(process) => {
            let process = &model.processes[process];
            process.asked.store(state, 0);
            if process.runs.load(state) == 0 {
                process.runs.store(state, 1);
                process.ended.store(state, 0);
            }
        }
        What::Leaps(process) | What::Completes(process) => {
            let process = &model.processes[process];
            if process.runs.load(state) == 0 {
                process.asked.store(state, 0);
            }
            process.runs.store(state, 0);
            process.ended.store(state, 1);
        }
        _ => {}
    }
}

impl Scan<'_> {
    /// Valves and edges act, now or later.
    pub(crate) fn valves(&mut self, touched: u64) {
        let due = touched | self.fired;
        let model = self.model;
        for cylinder in model.cylinders.iter().filter(|cylinder| due & bit(cylinder.machine) != 0) {
            let sent = cylinder.sent(self.bytes);
            if let Centre::GoesOn(toward) = cylinder.centre {
                toward.store(self.bytes, sent);
            }
            let drives = cylinder.moving(self.bytes) | 1 << sent;
            cylinder.drives.store(self.bytes, drives);
        }
        for process in model.processes.iter().filter(|process| due & bit(process.machine) != 0) {
            if process.start.is_some_and(|start| start.is_on(self.bytes) && !start.is_on(self.before)) {
                process.asked.store(self.bytes, 1);
            }
        }
    }
}
