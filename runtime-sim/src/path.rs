//! Where each item was at any time of a run, as exact segments.
//!
//! A segment begins where something changes: another carrier, a command that starts, is held, continues or ends,
//! a belt that starts or stops. Within it the place follows one law.

mod json;
mod recorder;
mod table;

pub use json::{FORMAT, segments_json};
pub use recorder::Recorder;
pub use table::{HEAD, table_csv};

use crate::carrier::Carrier;
use crate::kinematics::arm::Arm;
use crate::motion::Motion;
use crate::plant::conveyed::Conveyed;
use crate::point::Point;

/// The path of one item, from where it appeared on the line to the end of the run or to where it left.
/// Each segment begins when the one before it ends. Where an item falls, is let go or leaves, the carrier
/// changes at one moment, and the place may change with it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    pub segments: Vec<Segment>,
    /// Other kinds that the item became, each with its time, ms.
    pub becomes: Vec<(f64, usize)>,
    /// When it lay on other items.
    pub loads: Vec<OnItem>,
}

/// From one time to another one an item lay on another one, rigid with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnItem {
    /// ms.
    pub begin_ms: f64,
    pub end_ms: f64,
    /// That item.
    pub under: usize,
    /// How it was turned about the vertical on that, to the left, rad.
    pub turn: f64,
}

/// Times are milliseconds from the start of the run. An item that leaves the line ends with a segment without
/// duration, of the collector or of its order.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    pub begin_ms: f64,
    pub end_ms: f64,
    pub carrier: Carrier,
    pub law: Law,
}

/// Where the item's underside is within a segment.
#[derive(Clone, Debug, PartialEq)]
pub enum Law {
    Rests(Point),
    /// Straight, on a belt or a vehicle: where it begins, its velocity there in m/s, and how this changes, m/s2.
    Slides {
        from: Point,
        velocity: Point,
        acceleration: Point,
    },
    /// On an arc of a conveyor, or on a conveyor that is turned.
    Conveyed(Conveyed),
    Hangs(Box<Hanging>),
}

/// On the gripper of an arm whose joints move.
#[derive(Clone, Debug, PartialEq)]
pub struct Hanging {
    pub arm: Arm,
    pub motion: Motion,
    /// From the tool to the item's underside, in the frame of the tool.
    pub hang: Point,
}

impl Path {
    /// The kind at this time of an item that was of kind `first`.
    pub fn kind_at(&self, ms: f64, first: usize) -> usize {
        let before = self.becomes.partition_point(|(at_ms, _)| *at_ms <= ms);
        before.checked_sub(1).map_or(first, |last| self.becomes[last].1)
    }

    /// The segments that hold at this time: one, or those that meet there, in their order. None while the item
    /// is not on the line.
    pub fn at(&self, ms: f64) -> impl Iterator<Item = &Segment> {
        let first = self.segments.partition_point(|segment| segment.end_ms < ms);
        self.segments[first..].iter().take_while(move |segment| segment.begin_ms <= ms)
    }

    /// Ends what continues beyond this time.
    fn cut(&mut self, ms: f64) {
        while let Some(last) = self.segments.last_mut() {
            if last.begin_ms < ms {
                last.end_ms = last.end_ms.min(ms);
                break;
            }
            if last.end_ms <= ms {
                break;
            }
            self.segments.pop();
        }
    }

    /// Appends a segment, or lengthens the last one if the item continues to rest where it was.
    fn push(&mut self, segment: Segment) {
        match self.segments.last_mut() {
            Some(last)
                if last.carrier == segment.carrier
                    && last.law == segment.law
                    && matches!(segment.law, Law::Rests(_)) =>
            {
                last.end_ms = segment.end_ms;
            }
            _ => self.segments.push(segment),
        }
    }
}

impl Segment {
    /// Where the item's underside is at a time within the segment.
    pub fn place(&self, ms: f64) -> Point {
        match &self.law {
            Law::Rests(point) => *point,
            Law::Slides { from, velocity, acceleration } => {
                let seconds = (ms - self.begin_ms) / 1000.0;
                *from + velocity.scaled(seconds) + acceleration.scaled(seconds * seconds / 2.0)
            }
            Law::Conveyed(conveyed) => conveyed.point((ms - self.begin_ms) / 1000.0),
            Law::Hangs(hanging) => hanging.place(ms / 1000.0),
        }
    }
}

impl Hanging {
    fn place(&self, s: f64) -> Point {
        self.arm.tool_pose(&self.motion.at(s)).point(self.hang)
    }
}
