//! What a part does while a line runs.

use super::chain::missed::Missed;
use crate::carrier::Carrier;
use crate::device::error;
use crate::item::Items;
use crate::item::block::Block;
use crate::kinematics::arm::Joints;
use crate::kinematics::pose::Pose;
use crate::line::Line;
use crate::machine::Machine;
use crate::memory::Memory;
use crate::part::Primitive;
use crate::part::orders::Desk;
use crate::part::place::Stack;
use crate::part::stroke::Carriage;
use crate::part::{lane, scanner, track};
use crate::plant::conveyed::Conveyed;
use crate::plant::fall::Falling;
use crate::plant::trajectory::Trajectory;
use crate::point::Point;

/// How a command has begun.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Begun {
    UnderWay,
    Ended,
}

/// What became of the command of a part while it moved on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    Going,
    Reached,
    /// A code of [`error`].
    Failed(i32),
}

/// What a part is started from.
pub struct Start<'a> {
    pub line: &'a Line,
    /// Numbers of the machine and of the part.
    pub machine: usize,
    pub part: usize,
    pub desk: &'a Desk,
    pub items: &'a mut Items,
    pub memory: &'a mut Memory,
}

impl<'a> Start<'a> {
    pub fn machine(&self) -> &'a Machine {
        &self.line.machines[self.machine]
    }

    /// The first part of the machine of which this holds.
    pub fn find(&self, wanted: impl Fn(&Primitive) -> bool) -> Option<usize> {
        self.machine().parts.iter().position(|part| wanted(&part.primitive))
    }
}

/// Of a time in the scenario.
pub fn milliseconds(seconds: f64) -> u64 {
    libm::round(seconds * 1000.0) as u64
}

/// A gripper now.
#[derive(Clone, Copy, Debug)]
pub struct Gripper {
    /// World frame.
    pub tool: Pose,
    /// It takes what is gripped no farther from the tool, m.
    pub near: f64,
    pub is_closed: bool,
    /// What hangs on it, be it reported or not.
    pub held: Option<usize>,
}

/// How a part looks for an item.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Looks {
    /// The chain at whose tool it looks.
    pub chain: usize,
    /// At whole multiples of it.
    pub period_ms: u64,
    /// It finds what is gripped no farther from the tool, m.
    pub near: f64,
    /// It has found something at the last look: the next one counts, whatever it finds.
    pub has_found: bool,
}

/// What a part can see of its machine and of the line.
#[derive(Clone, Copy)]
pub struct See<'a> {
    pub machine: usize,
    /// The parts of the machine; the one that looks may be absent, and those that do nothing are.
    pub parts: &'a [Option<Box<dyn Running>>],
    pub items: &'a Items,
    pub desk: &'a Desk,
}

/// The same while it may change what concerns all.
pub struct World<'a> {
    pub machine: usize,
    pub parts: &'a [Option<Box<dyn Running>>],
    pub items: &'a mut Items,
    pub desk: &'a mut Desk,
    /// Start of the scan, from the start of the run.
    pub now_ms: u64,
    /// Length of the scan.
    pub dt_ms: u64,
}

impl<'a> World<'a> {
    pub fn see(&self) -> See<'_> {
        See { machine: self.machine, parts: self.parts, items: self.items, desk: self.desk }
    }

    /// An item becomes a part of another one.
    pub fn join(&mut self, item: usize, of: usize) {
        let base = self.items.base_of(item);
        let part = self.items[base].carrier.part();
        let place = part.and_then(|part| self.see().place(part, base)).unwrap_or_default();
        self.items.pass(item, Carrier::Part { of }, place);
    }

    /// A part of another item comes to lie at a place of the machine again.
    pub fn lay(&mut self, item: usize, part: usize, offset: Point) {
        let (carrier, point) = self.at_place(item, part, offset);
        self.items.pass(item, carrier, point);
    }

    /// An item at a place of the machine moves on it.
    pub fn shift(&mut self, item: usize, part: usize, offset: Point) {
        let (carrier, point) = self.at_place(item, part, offset);
        self.items.shift(item, carrier, point);
    }

    /// An item moves on the item that bears it.
    pub fn shift_on_item(&mut self, item: usize, to: Carrier) {
        let (base, on_base) = self.items.on_base(item);
        let part = self.items[base].carrier.part();
        let block = part.and_then(|part| self.see().block(part, base, self.next_ms() as f64));
        let point = block.map(|block| block.frame().point(on_base.position));
        self.items.shift(item, to, point.unwrap_or_default());
    }

    fn at_place(&self, item: usize, part: usize, offset: Point) -> (Carrier, Point) {
        let carrier = Carrier::Place { machine: self.machine, part, offset };
        let see = self.see();
        let point = see.part(part).and_then(|place| place.place(item, &carrier, &see)).unwrap_or_default();
        (carrier, point)
    }

    /// The machine did what would break it: the run ends.
    pub fn crash(&mut self, reason: String) {
        self.items.crash(self.machine, reason);
    }

    /// End of the scan, from the start of the run.
    pub fn next_ms(&self) -> u64 {
        self.now_ms + self.dt_ms
    }
}

impl<'a> See<'a> {
    fn part(&self, part: usize) -> Option<&'a dyn Running> {
        self.parts.get(part)?.as_deref()
    }

    pub fn lane(&self, part: usize) -> Option<&'a lane::Moving> {
        self.part(part)?.lane()
    }

    /// Writes a signal of another part; nothing if it does nothing.
    pub fn read(&self, part: usize, signal: usize, out: &mut [f64]) {
        if let Some(part) = self.part(part) {
            part.signal(signal, self, out);
        }
    }

    pub fn carriage(&self, part: usize) -> Option<&'a dyn Carriage> {
        self.part(part)?.carriage()
    }

    /// The vehicle on a track that this part is.
    pub fn vehicle(&self, part: usize) -> Option<&'a track::Driving> {
        self.part(part)?.vehicle()
    }

    /// Where the origin is of what this part carries.
    pub fn position(&self, part: usize) -> Option<Point> {
        self.part(part)?.position()
    }

    pub fn is_open(&self, part: usize) -> bool {
        self.part(part).is_some_and(|orders| orders.open_order().is_some())
    }

    /// The frame of the tool of this chain.
    pub fn tool(&self, part: usize) -> Option<Pose> {
        self.part(part)?.tool()
    }

    /// Where the underside of an item is that a part of this machine bears.
    pub fn place(&self, part: usize, item: usize) -> Option<Point> {
        self.part(part)?.place(item, &self.items[item].carrier, self)
    }

    /// The items of a place of this machine where they lie on one another.
    pub fn stack(&self, part: usize) -> Option<Stack> {
        self.part(part)?.stack(self)
    }

    /// What an item takes up at a time, ms, that a part of this machine bears.
    pub fn block(&self, part: usize, item: usize, ms: f64) -> Option<Block> {
        self.part(part)?.block(item, ms, self)
    }

    /// Items that a part of this machine bears, in the order in which they came.
    pub fn borne_by(&self, part: usize) -> impl Iterator<Item = usize> + 'a {
        let items = self.items;
        let of_part = move |item: &usize| items[*item].carrier.part() == Some(part);
        items.borne_by(self.machine).iter().copied().filter(of_part)
    }
}

/// A part at work. In a scan the parts of all machines first obey, then they move on, then what slips falls, then
/// grippers take, then orders are served, and at last signals are read: each step of all machines, in their order,
/// before the next one.
pub trait Running: std::fmt::Debug + Send + Sync {
    fn boxed(&self) -> Box<dyn Running>;

    /// Begins a numbered command; the one before it is void. An error is a code of [`error`].
    fn begin(&mut self, _action: usize, _arguments: &[f64], _world: &mut World) -> Result<Begun, i32> {
        Err(error::REFUSED)
    }

    /// Why the last command that ended in [`error::UNREACHABLE`] did, if it is known.
    fn missed(&self) -> Option<Missed> {
        None
    }

    /// The command is void, or has ended in error.
    fn abandon(&mut self, _now_ms: u64) {}

    /// The last command was withdrawn: what it has set going stops, even if it has ended.
    fn lose_command(&mut self, now_ms: u64) {
        self.abandon(now_ms);
    }

    /// Halts on its path, or continues: a command holds it, or it jams.
    fn hold(&mut self, _held: bool, _now_ms: u64) {}

    fn level(&mut self, _level: usize, _value: &[f64]) {}

    /// An item that a level has let go.
    fn let_go(&mut self) -> Option<usize> {
        None
    }

    /// Moves on to the end of the scan.
    fn advance(&mut self, _world: &mut World) -> Progress {
        Progress::Going
    }

    /// An item that slips by the end of the scan.
    fn slip(&mut self, _next_ms: u64) -> Option<usize> {
        None
    }

    /// The frame of the tool where it looks for an item in this scan, and how near that has to be, m.
    fn seeks(&self, _see: &See, _now_ms: u64, _next_ms: u64) -> Option<(Pose, f64)> {
        None
    }

    /// Of a gripper.
    fn gripper(&self, _see: &See) -> Option<Gripper> {
        None
    }

    /// While it looks for an item: when, and how near it has to be.
    fn looks(&self) -> Option<Looks> {
        None
    }

    /// Metres that the tool goes at most between two times, s.
    fn tool_goes(&self, _from: f64, _to: f64) -> f64 {
        0.0
    }

    /// Where the tool is at a time, s, as it moves now; none if that is not known.
    fn tool_at(&self, _time: f64) -> Option<Point> {
        None
    }

    /// Whether it takes the item that it found, or none, where it looked. It would be the pick of this number, from 1, of
    /// the machine.
    fn meets(&mut self, _item: Option<usize>, _pick: u32, _now_ms: u64, _next_ms: u64) -> Option<usize> {
        None
    }

    /// Whether it takes away items that are ordered.
    fn serves(&self) -> bool {
        false
    }

    fn serve(&mut self, _world: &mut World) {}

    /// What others have served is taken away here.
    fn withdraw(&mut self, _world: &mut World) {}

    /// Writes a signal; `out` holds its words.
    fn signal(&self, _signal: usize, _see: &See, _out: &mut [f64]) {}

    /// When it does something next but continue along its path, ms from the start of the run, if no output changes and
    /// nothing else does: the earliest end of a motion, item that comes or goes, signal that rises or falls. It may be
    /// earlier than the truth, never later; infinity: never.
    fn next_change(&self, _see: &See, _now_ms: u64) -> f64 {
        f64::INFINITY
    }

    /// A number that it shows changes all the while.
    fn flows(&self) -> bool {
        false
    }

    /// How what it carries is going to move.
    fn trajectory(&self, _now_ms: u64) -> Trajectory {
        Trajectory::Rests
    }

    /// Something will change even if no output does, besides the end of a command.
    fn is_busy(&self, _see: &See) -> bool {
        false
    }

    /// Where the upper side of an item that it bears faces, a unit vector; none for up.
    fn upper(&self, _carrier: &Carrier, _see: &See) -> Option<Point> {
        None
    }

    /// How a gripper is turned about the vertical, rad; 0 for what does not turn.
    fn tool_turn(&self, _see: &See) -> f64 {
        0.0
    }

    /// The height of its surface and what becomes of an item that comes down at this time, ms, if it meets that.
    fn below(&self, _falling: &Falling, _ms: f64, _see: &See) -> Option<(f64, Carrier)> {
        None
    }

    /// The items of a place where they lie on one another.
    fn stack(&self, _see: &See) -> Option<Stack> {
        None
    }

    /// An item off which another one tips that comes down here at this time, ms.
    fn tips_off(&self, _falling: &Falling, _ms: f64, _see: &See) -> Option<usize> {
        None
    }

    /// What an item takes up at this time, ms, that stands here.
    fn block(&self, _item: usize, _ms: f64, _see: &See) -> Option<Block> {
        None
    }

    /// Where the underside of an item is that it bears.
    fn place(&self, _item: usize, _carrier: &Carrier, _see: &See) -> Option<Point> {
        None
    }

    /// How an item that it bears continues, as seen from what carries this part.
    fn conveyed(&self, _item: usize, _carrier: &Carrier, _see: &See) -> Option<Conveyed> {
        None
    }

    /// The part that carries it.
    fn on(&self) -> Option<usize> {
        None
    }

    /// Where the origin is of what it carries.
    fn position(&self) -> Option<Point> {
        None
    }

    /// Cycles that have begun.
    fn cycles(&self) -> u32 {
        0
    }

    fn joints(&self) -> Option<Joints> {
        None
    }

    /// The frame of its tool, world frame.
    fn tool(&self) -> Option<Pose> {
        None
    }

    fn lane(&self) -> Option<&lane::Moving> {
        None
    }

    fn lane_mut(&mut self) -> Option<&mut lane::Moving> {
        None
    }

    /// A cylinder or a positioner.
    fn carriage(&self) -> Option<&dyn Carriage> {
        None
    }

    /// A vehicle on a track.
    fn vehicle(&self) -> Option<&track::Driving> {
        None
    }

    fn scanner(&self) -> Option<&scanner::Scanning> {
        None
    }

    fn scanner_mut(&mut self) -> Option<&mut scanner::Scanning> {
        None
    }

    /// How many items a source was asked for, if it is asked for each.
    fn asked(&self) -> Option<u64> {
        None
    }

    fn open_order(&self) -> Option<usize> {
        None
    }

    /// Orders that have not opened yet.
    fn orders_to_open(&self, _desk: &Desk) -> usize {
        0
    }
}

impl Clone for Box<dyn Running> {
    fn clone(&self) -> Self {
        self.boxed()
    }
}
