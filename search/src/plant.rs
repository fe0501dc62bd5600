//! What the plant remembers, and what its machines consist of as far as that decides what may happen.

use crate::value::{Point, Var};

/// The machine of the instance of the same number.
#[derive(Clone, Debug, Default)]
pub struct Machine {
    pub head: Option<Head>,
    pub arm: Option<Arm>,
    pub route: Option<Route>,
    pub lane: Option<Lane>,
    pub desk: Option<Desk>,
    pub places: Vec<Place>,
}

/// Numbered commands and their answers.
#[derive(Clone, Debug)]
pub struct Head {
    /// One of [`status`].
    pub status: Var,
    /// Which command is under way; 0 if none is.
    pub command: Var,
    /// The port `error`, if the automaton reads it by itself.
    pub error: Option<Var>,
    pub commands: Vec<Asked>,
}

/// Values of [`Head::status`].
pub mod status {
    pub const NONE: i32 = 0;
    pub const UNDER_WAY: i32 = 1;
    pub const DONE: i32 = 2;
    pub const FAILED: i32 = 3;
}

/// What a command asks for, and with which errors it may end.
#[derive(Clone, Debug)]
pub struct Asked {
    pub action: Action,
    /// The same command with the same goal is the same: it has no arguments that are not kept.
    pub is_kept: bool,
    /// The machine plans the way round obstacles: it begins straight up.
    pub is_planned: bool,
    /// It ends well when the signal that it awaits is there, else in this error.
    pub awaits: Option<Awaits>,
    /// Errors in which it may end before it has changed anything.
    pub refusals: Vec<i32>,
}

#[derive(Clone, Copy, Debug)]
pub struct Awaits {
    /// Of the gripper: that it holds an item.
    pub is_hold: bool,
    pub error: i32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Of an arm, to the last of its places, past the first one if there are two.
    Motion,
    /// Of a vehicle, to its place.
    Trip,
    Run,
    Rest,
    /// Changes nothing that is remembered.
    Other,
}

/// An output that acts as long as it is on.
#[derive(Clone, Copy, Debug)]
pub struct Level {
    pub var: Var,
    /// Whether the machine is stopped, and what is published then; none: what the automaton wrote.
    pub stop: Option<(Var, bool)>,
}

impl Level {
    pub fn is_on(&self, state: &[u8]) -> bool {
        match self.stop {
            Some((stopped, value)) if stopped.load(state) != 0 => value,
            _ => self.var.load(state) != 0,
        }
    }
}

#[derive(Clone, Debug)]
pub struct Arm {
    /// Where the tool is, or was when the motion under way began.
    pub tool: Var,
    /// Where it passes, 0 for no place.
    pub via: Var,
    pub goal: Var,
    /// One more than the kind of what hangs on the gripper, else 0.
    pub holds: Var,
    /// What the controller sees of that.
    pub shown: Var,
    /// The level that closes the gripper.
    pub closes: Option<Level>,
    /// m.
    pub near: f64,
}

#[derive(Clone, Debug)]
pub struct Route {
    pub at: Var,
    pub goal: Var,
    pub stops: Vec<Point>,
    pub tolerance: f64,
    /// Two more than the number of the stop that it shows in this scan, 0 while that is open; none: nobody reads it.
    pub shown: Option<Var>,
}

impl Route {
    /// The number of the stop that it shows in this scan, if that is decided.
    pub(crate) fn shown_stop(&self, state: &[u8]) -> Option<i32> {
        let shown = self.shown?.load(state);
        (shown != 0).then_some(shown - 2)
    }

    pub(crate) fn show(&self, state: &mut [u8], stop: i32) {
        if let Some(shown) = self.shown {
            shown.store(state, stop + 2);
        }
    }
}

/// A conveyor that is driven by commands.
#[derive(Clone, Debug)]
pub struct Lane {
    /// One of [`motion`].
    pub motion: Var,
    /// In the scan of a command one more than whether it was shown before to move, else 0; none: nobody reads it.
    pub shown: Option<Var>,
    pub zones: Vec<Zone>,
}

/// Values of [`Lane::motion`].
pub mod motion {
    pub const STANDS: i32 = 0;
    pub const RUNS: i32 = 1;
    /// The command to run is under way.
    pub const STARTS: i32 = 2;
    /// The command to rest is under way.
    pub const STOPS: i32 = 3;
}

/// A field over a lane.
#[derive(Clone, Debug)]
pub struct Zone {
    pub low: [f64; 2],
    pub high: [f64; 2],
    /// Height of the surface.
    pub surface: f64,
    /// Of each kind the input that tells whether it is seen, if one does.
    pub sees: Vec<Option<usize>>,
    /// Where an item of each kind rests that is seen.
    pub found: Vec<Point>,
}

impl Zone {
    /// Whether an item can be in both.
    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        (0..2).all(|axis| self.low[axis] < other.high[axis] && other.low[axis] < self.high[axis])
    }
}

/// A terminal of the order system.
#[derive(Clone, Debug)]
pub struct Desk {
    /// One of [`phase`].
    pub phase: Var,
    /// The open order.
    pub order: Var,
    /// How many of its orders have had their turn.
    pub next: Var,
    pub complete: Option<Level>,
    /// Number among the places of the machine; none if it is not known what lies there.
    pub place: Option<usize>,
    /// Numbers of the orders that open here, in their order.
    pub orders: Vec<usize>,
}

/// Values of [`Desk::phase`].
pub mod phase {
    pub const BARE: i32 = 0;
    /// The next order is about to open.
    pub const OPENING: i32 = 1;
    pub const OPEN: i32 = 2;
    /// The order has been taken away, the controller does not know yet.
    pub const TAKEN: i32 = 3;
    /// It knows.
    pub const GONE: i32 = 4;
}

/// A rectangle on which items lie, from the origin of its place.
#[derive(Clone, Copy, Debug)]
pub struct Floor {
    pub middle: Point,
    /// Extent from its middle along its own axes.
    pub x: [f64; 2],
    pub y: [f64; 2],
    /// Its x axis in the axes of the world: the cosine and the sine of its direction.
    pub ahead: [f64; 2],
}

impl Floor {
    /// Whether a point, from the origin of its place, is over it, or no farther beside any of its sides than this.
    pub fn is_near(&self, [x, y]: [f64; 2], margin: f64) -> bool {
        let ([cos, sin], [x, y]) = (self.ahead, [x - self.middle[0], y - self.middle[1]]);
        let within = |at: f64, [low, high]: [f64; 2]| low - margin <= at && at <= high + margin;
        within(cos * x + sin * y, self.x) && within(cos * y - sin * x, self.y)
    }
}

/// Where items lie.
#[derive(Clone, Debug)]
pub struct Place {
    /// Where it stands, if the vehicle of the machine does not carry it.
    pub stands: Option<Point>,
    pub floor: Floor,
    /// From the origin.
    pub slots: Vec<Point>,
    /// Without: one more than the kind of the item at each slot, else 0. With: number of items of each kind.
    pub by_kind: bool,
    pub items: Vec<Var>,
    /// So many of one kind are told from more: one more than any order asks for.
    pub most: i32,
    /// One more than the kind of what lies among its slots, where nobody looks for it; the number after that of the last
    /// kind where others may lie there too. Not where items are counted by kinds.
    pub stray: Option<Var>,
    /// Items may lie on one another: what lies there is not known.
    pub stacks: bool,
}

/// A signal that changes by itself: a truth, or a whole number of few values.
#[derive(Clone, Debug)]
pub struct Input {
    /// One more than the number of its value, 0 while that is open.
    pub var: Var,
    pub low: i32,
    pub values: u32,
    /// Of this machine the lane that has to stand for the signal to stay as it is.
    pub stays: Option<usize>,
    pub machine: usize,
}

/// What the state holds of an input that tells whether an item is there.
pub mod sight {
    pub const OPEN: i32 = 0;
    pub const NOT_SEEN: i32 = 1;
    pub const SEEN: i32 = 2;
    /// It was seen, or was not: nobody can tell any more which.
    pub const FORGOTTEN: i32 = 3;
}

/// What is asked for.
#[derive(Clone, Debug)]
pub struct Order {
    pub parts: Vec<u32>,
    /// It has been made.
    pub made: Var,
}

/// What is a violation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Watch {
    Everything,
    /// Faults at run time: the search continues behind everything else.
    Faults,
}

/// What may go wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Faults {
    /// Commands end in error, and grippers lose what they hold.
    All,
    None,
}
