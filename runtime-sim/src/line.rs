//! What a run needs to know of a factory line, as plain data.

mod check;
mod faults;
mod text;

use crate::machine::Machine;
use crate::point::Point;
pub use faults::{Answer, During, Jam, Pause, Refusal, Slip, SlowCycle, Stuck};

/// A factory line, its machines in the order of the layout, and what is to happen on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Period of a scan.
    pub scan_ms: u32,
    pub kinds: Vec<Kind>,
    pub machines: Vec<Machine>,
    /// What stands about without a controller, in the order of the layout.
    pub obstacles: Vec<Obstacle>,
    /// Machines and obstacles, by their names, whose contact does not end a run.
    pub may_touch: Vec<[String; 2]>,
    pub scenario: Scenario,
    pub io_delay: IoDelay,
}

/// A kind of part.
#[derive(Clone, Debug, PartialEq)]
pub struct Kind {
    pub name: String,
    /// Of its top over what it lies on, in metres.
    pub height: f64,
    /// Over its underside, where the tool grips it, in metres.
    pub grasp: f64,
    /// Lengths along x and y as it appears on a belt, in metres.
    pub size: [f64; 2],
    /// What sensors for it find it to be, such as `metal`.
    pub is: Vec<String>,
    /// kg.
    pub mass: f64,
    /// On which other items lie, and with which they go on.
    pub deck: Option<Deck>,
}

/// Where items lie on a pallet, on a tray or in a box. What is beyond it and higher is a wall all around.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deck {
    /// Over the underside of what bears them, in metres.
    pub height: f64,
    /// Lengths along its x and y, in metres, around its middle.
    pub size: [f64; 2],
}

impl Kind {
    /// Along x and y as it appears on a belt, and upwards, m.
    pub fn lengths(&self) -> Point {
        Point::new(self.size[0], self.size[1], self.height)
    }
}

/// Something stationary without an automaton.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    pub name: String,
    /// The box stands on it.
    pub pose: Point,
    /// Lengths along x, y and z, if the layout gives them.
    pub size: Option<Point>,
}

/// What reports say of a machine in this state while it has no command under way.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    pub name: String,
    /// A timer or a port of its own is awaited.
    pub working: bool,
    /// The machines whose cells the guards read.
    pub awaits: Vec<usize>,
    /// Words of its inputs that guards read, not counting what only says which of several comes first.
    pub reads: Vec<usize>,
    /// The same for numbers that change while something moves, if guards read them under conditions.
    pub reads_while: Vec<ReadWhile>,
    /// Times in the state, ms, at which a guard may begin to hold or the stay becomes too long; none: any.
    pub timers: Option<Vec<u32>>,
    /// No guard holds before the device has answered the last command.
    pub awaits_answer: bool,
}

impl State {
    /// Whether reports say the same of both.
    pub(crate) fn is_reported_as(&self, other: &Self) -> bool {
        let Self { name, working, awaits, .. } = self;
        (name, working, awaits) == (&other.name, &other.working, &other.awaits)
    }
}

/// A word of the inputs that guards read only while bits of the inputs are as said: these stand before it in the guard,
/// and the rest of a guard that has already failed is not evaluated.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ReadWhile {
    pub word: usize,
    /// Words of the inputs, and what each has to be.
    pub gates: Vec<(usize, bool)>,
}

impl ReadWhile {
    /// Whether guards read it, with these inputs.
    pub fn is_read(&self, inputs: &[f64]) -> bool {
        self.gates.iter().all(|(word, is)| inputs.get(*word).is_none_or(|value| (*value != 0.0) == *is))
    }
}

/// What is asked of the line, what its belts bring, and what goes wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    pub goal: Goal,
    pub orders: Vec<Order>,
    pub supply: Vec<Supply>,
    /// Seconds of a belt at full speed until its first part.
    pub spawn_first_s: f64,
    /// The same between two parts.
    pub spawn_every_s: f64,
    pub time_limit_s: f64,
    /// A run in which nothing at all changes for so long ends as a deadlock.
    pub stall_limit_s: f64,
    /// The scan with the first rising edge of `start`.
    pub start_scan: u64,
    pub slips: Vec<Slip>,
    pub refusals: Vec<Refusal>,
    pub answers: Vec<Answer>,
    pub pauses: Vec<Pause>,
    /// As pauses; beside the permit, in the first scan, the controller loses its power, and has it again in the scan in
    /// which the permit is back.
    pub power_offs: Vec<Pause>,
    pub sensors: Vec<Stuck>,
    pub jams: Vec<Jam>,
    pub slow: Vec<SlowCycle>,
    pub operations: Vec<Operation>,
    pub presses: Vec<Press>,
    pub removals: Vec<Removal>,
    /// Of all times that are drawn.
    pub seed: u64,
}

/// When a run has done what it was for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Goal {
    /// All orders are made.
    AllOrders,
    /// The time limit has come: there are no orders, or more than can be made until then.
    TimeLimit,
    /// Each of these sinks has collected what it should, and no item of another kind.
    Collected(Vec<Collected>),
}

/// What a sink should collect.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Collected {
    pub machine: usize,
    pub part: usize,
    /// Number of items of each kind.
    pub items: Vec<u32>,
}

/// Orders of one station open one after another, in the order of [`Scenario::orders`].
#[derive(Clone, Debug, PartialEq)]
pub struct Order {
    /// Where it opens, each when its turn comes there. It is made at the first of them that has its parts,
    /// and withdrawn at the others.
    pub stations: Vec<usize>,
    /// Number of parts of each kind.
    pub parts: Vec<u32>,
}

/// The kinds of the parts that appear on a belt, first one first.
#[derive(Clone, Debug, PartialEq)]
pub struct Supply {
    pub belt: usize,
    pub items: Vec<usize>,
}

/// A person presses a button or sets a number.
#[derive(Clone, Debug, PartialEq)]
pub struct Operation {
    pub machine: usize,
    pub part: usize,
    pub at_s: f64,
    /// None: to the end of the run.
    pub for_s: Option<f64>,
    /// 1 for a button.
    pub value: f64,
}

/// A person presses a button of the whole line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Press {
    pub button: LineButton,
    pub during: During,
}

/// A person takes an item off the line, at the start of a scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Removal {
    /// The kind that the item has when it comes from the supply, and its number among those of this kind, from 1.
    pub kind: usize,
    pub number: u32,
    pub at_scan: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineButton {
    Start,
    Reset,
}

impl Scenario {
    /// Whether the controller executes this scan: its power is on.
    pub fn is_powered(&self, scan: u64) -> bool {
        !self.power_offs.iter().any(|off| off.at_scan < scan && off.holds(scan))
    }

    /// Whether power is back from this scan on.
    pub fn powers_up(&self, scan: u64) -> bool {
        self.is_powered(scan) && self.power_offs.iter().any(|off| off.end() == scan)
    }

    /// The first scan after this one before which power is lost.
    pub fn next_without_power(&self, scan: u64) -> Option<u64> {
        self.power_offs.iter().map(|off| off.at_scan + 1).filter(|first| *first > scan).min()
    }

    /// So many scans without power end before this one.
    pub fn scans_without_power(&self, scan: u64) -> u64 {
        let mut first = scan;
        let is_off = |scan: u64| self.power_offs.iter().find(|off| off.at_scan < scan && off.holds(scan));
        while let Some(off) = first.checked_sub(1).and_then(is_off) {
            first = off.at_scan + 1;
        }
        scan - first
    }

    /// Whether somebody presses a button of the line in this scan.
    pub fn presses(&self, button: LineButton, scan: u64) -> bool {
        self.presses.iter().any(|press| press.button == button && press.during.holds(scan))
    }

    /// Scans in which somebody begins to press the button `reset` of the line.
    pub fn resets(&self) -> impl Iterator<Item = u64> {
        self.presses
            .iter()
            .filter(|press| press.button == LineButton::Reset)
            .map(|press| press.during.at_scan)
    }

    /// Scans in which a button of the line is pressed or released, or an item is removed.
    pub fn changes_by_hand(&self) -> impl Iterator<Item = u64> {
        let removals = self.removals.iter().map(|removal| removal.at_scan);
        self.presses.iter().flat_map(|press| press.during.changes()).chain(removals)
    }
}

/// How many scans late the inputs of a machine reach its controller. They travel in one telegram.
#[derive(Clone, Debug, PartialEq)]
pub enum IoDelay {
    Fixed(u32),
    /// From 0 to `max`, drawn anew for each machine and scan; no telegram overtakes another.
    Random {
        max: u32,
        seed: u64,
    },
}

impl Default for Scenario {
    fn default() -> Self {
        Self {
            goal: Goal::AllOrders,
            orders: Vec::new(),
            supply: Vec::new(),
            // Belt population of the qualifier trials: a part every 2 s at 0.2 m/s.
            spawn_first_s: 2.0,
            spawn_every_s: 2.0,
            // Time limit of the same trials.
            time_limit_s: 500.0,
            stall_limit_s: 120.0,
            start_scan: 2,
            slips: Vec::new(),
            refusals: Vec::new(),
            answers: Vec::new(),
            pauses: Vec::new(),
            power_offs: Vec::new(),
            sensors: Vec::new(),
            jams: Vec::new(),
            slow: Vec::new(),
            operations: Vec::new(),
            presses: Vec::new(),
            removals: Vec::new(),
            seed: 1,
        }
    }
}

impl Line {
    /// Whether runs with other seeds may differ, with the same supply.
    pub fn is_drawn(&self) -> bool {
        matches!(self.io_delay, IoDelay::Random { max, .. } if max > 0)
            || self.machines.iter().flat_map(Machine::processes).any(|(_, process)| process.is_drawn())
    }

    /// Whether the same controllers do the same on both: they differ at most in what controllers wait for, by which a run
    /// leaves scans out.
    pub fn has_plant_of(&self, other: &Self) -> bool {
        let Self { scan_ms, kinds, machines, obstacles, may_touch, scenario, io_delay } = self;
        let machines = machines.iter().zip(&other.machines);
        self.machines.len() == other.machines.len()
            && machines.into_iter().all(|(machine, other)| machine.is_same_device(other))
            && (scan_ms, kinds, obstacles) == (&other.scan_ms, &other.kinds, &other.obstacles)
            && (may_touch, scenario, io_delay) == (&other.may_touch, &other.scenario, &other.io_delay)
    }

    /// Whether controllers wait for the same on both.
    pub(crate) fn waits_for_same(&self, other: &Self) -> bool {
        let waits = |machine: &Machine, other: &Machine| {
            machine.states == other.states && machine.monitor == other.monitor
        };
        let machines = self.machines.iter().zip(&other.machines);
        self.machines.len() == other.machines.len() && machines.into_iter().all(|(a, b)| waits(a, b))
    }

    /// Whether contact of these two, machines or obstacles, is no reason to end a run.
    pub fn allows(&self, [a, b]: [&str; 2]) -> bool {
        self.may_touch.iter().any(|[c, d]| (a, b) == (c, d) || (b, a) == (c, d))
    }
}

impl Obstacle {
    /// The height of its top, if it has one over or under this place, m.
    pub fn top_at(&self, place: Point) -> Option<f64> {
        let size = self.size?;
        let (x, y) = (place.x - self.pose.x, place.y - self.pose.y);
        (x.abs() <= size.x / 2.0 && y.abs() <= size.y / 2.0).then_some(self.pose.z + size.z)
    }
}

impl IoDelay {
    pub fn max(&self) -> u32 {
        match *self {
            IoDelay::Fixed(scans) => scans,
            IoDelay::Random { max, .. } => max,
        }
    }
}
