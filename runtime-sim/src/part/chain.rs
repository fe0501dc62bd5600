//! The joints of an arm behind the axes that carry it, moved together.

use super::settings::{Form, Setting};
use super::{Action, Begun, Progress, Running, Schema, See, Signal, World};
use crate::device::{Extent, PortType, error};
use crate::frame::Frame;
use crate::kinematics::arm::Joints;
use crate::kinematics::facing::Facing;
use crate::kinematics::fixed::{self, Mounting};
use crate::kinematics::pose::Pose;
use crate::kinematics::scara::{self, Arms};
use crate::part::axis::Axis;
use crate::plant::trajectory::Trajectory;
use crate::point::Point;
use crate::planner::{End, Load, Transfer};
use drive::{Drive, Moved, Target};
use missed::{Missed, Why};

mod described;
pub mod drive;
pub mod missed;
pub(crate) mod motions;

/// The action that gives the tool a turn about the vertical.
pub const ORIENTED: &str = "oriented";

/// Whether a chain that has these settings has joints of its own: one without them is a Cartesian robot.
pub fn has_joints(has: impl Fn(&str) -> bool) -> bool {
    has("speeds")
}

pub const SCHEMA: Schema = Schema {
    frames: &[
        "base", "shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3", "inner_arm", "outer_arm", "quill",
        "flange",
    ],
    signals: &[Signal { name: "tool", ty: PortType::Point, extent: Extent::One }],
    actions: &[
        Action { name: "joints", arguments: &[PortType::Point] },
        Action { name: "limits", arguments: &[PortType::Real, PortType::Real] },
        Action { name: "turned", arguments: &[PortType::Point, PortType::Real] },
        Action { name: "past", arguments: &[PortType::Point, PortType::Point] },
        Action { name: "around", arguments: &[PortType::Point, PortType::Point] },
        Action { name: "onto", arguments: &[PortType::Point, PortType::Point] },
        Action { name: "direct", arguments: &[PortType::Point] },
        Action { name: "facing", arguments: &[PortType::Point, PortType::Point] },
        Action { name: ORIENTED, arguments: &[PortType::Point, PortType::Real] },
    ],
    can_jam: true,
    ..Schema::new(
        "chain",
        "The joints of an arm that move together, with the tool pointing down, or to a side with `facing`; `oriented` turns it about the vertical. On one axis, or on two that slide and one that turns: the six joints of a UR10. Fixed at `from`, or on one axis that slides: the six joints of an arm of Universal Robots with `lengths`, or of an arm with a spherical wrist by the parameters `opw`. Fixed at `from`, with `scara`: two arms that turn about vertical axes, a quill that slides and a tool that turns; bodies are on `inner_arm`, `outer_arm`, `quill` and `flange`. On one to three axes at right angles, without `speeds`: a Cartesian robot, which has no joints but its axes.",
        &[
            Setting::new("on", Form::Part(&["axis"]), "", "the last of the axes that carry it").optional(),
            Setting::new("from", Form::Frame, "m", "frame of its base, if no axis carries it").optional(),
            Setting::new("hung", Form::Truth, "", "its base is under a ceiling or under a rail, turned about its x axis by half a turn").optional(),
            Setting::new("mount", Form::Frame, "m", "with `on`, and `lengths` or `opw`: frame of its base on the carriage; without it that of the carriage").optional(),
            Setting::new("lengths", Form::Numbers, "m", "d1, a2, a3, d4, d5, d6 of the manufacturer, for an arm of Universal Robots")
                .optional(),
            Setting::new("opw", Form::Numbers, "m", "a1, a2, b, c1, c2, c3, c4 of an arm with an ortho-parallel base and a spherical wrist")
                .optional(),
            Setting::new("scara", Form::Numbers, "m", "lengths of the inner and the outer arm of a SCARA, from axis to axis")
                .optional(),
            Setting::new("offsets", Form::Numbers, "deg", "with `opw`: of each joint; without it 0").optional(),
            Setting::new("signs", Form::Numbers, "", "with `opw`: 1, or -1 for a joint that the manufacturer counts the other way; without it 1")
                .optional(),
            Setting::new("lowest", Form::Numbers, "deg", "lower limit of each joint, with `lengths` or `opw`; without it -360. With `scara` required: two angles, the lowest height of the flange over `from` in m, an angle").optional(),
            Setting::new("highest", Form::Numbers, "deg", "upper limit of each joint, with `lengths` or `opw`; without it 360. With `scara` required").optional(),
            Setting::new("tool_length", Form::Number, "m", "from the flange, or from the last axis of a Cartesian robot, to the tool centre point")
                .optional(),
            Setting::new("rest", Form::Point, "m", "place of the tool at the start"),
            Setting::new("speeds", Form::Numbers, "rad/s", "greatest velocity of each joint; of a quill m/s").optional(),
            Setting::new("acceleration", Form::Positive, "rad/s2", "greatest of each joint, initially; of a quill m/s2").optional(),
            Setting::new("joints", Form::Words, "", "names of the joints, in the world").optional(),
            Setting::new("links", Form::Words, "", "names of the links, in the world").optional(),
            Setting::new("masses", Form::Numbers, "kg", "of the links, for the world; without it 5 each").optional(),
            Setting::new("efforts", Form::Numbers, "N m", "greatest, for the world; without it 300").optional(),
            Setting::new("damping", Form::Numbers, "N m s/rad", "for the world; without it 0").optional(),
            Setting::new("friction", Form::Numbers, "N m", "for the world; without it 0").optional(),
            Setting::new(
                "envelope",
                Form::Numbers,
                "m",
                "workspace that others keep free: half of its width across the axis, and its height over the shoulder; empty or left out: none",
            )
            .optional(),
            Setting::new(
                "clearances",
                Form::Points,
                "m",
                "of the bodies that turn with it about the vertical: lower and upper end from the shoulder's height, and the distance of the axis from obstacles between them",
            )
            .optional(),
        ],
    )
};

#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// The last of the axes that carry it.
    pub on: Option<usize>,
    /// Where its base stands, if none does.
    pub base: Option<Frame>,
    /// On the carriage, if an axis carries it.
    pub mount: Frame,
    pub mounting: Mounting,
    pub geometry: Geometry,
    pub rest: Point,
    /// Behind the axes; none for a Cartesian robot.
    pub joints: Vec<Joint>,
    /// Of these joints, rad/s2; 0 without any.
    pub acceleration: f64,
    pub envelope: Option<[f64; 2]>,
    /// Lower end, upper end and radius of each.
    pub clearances: Vec<[f64; 3]>,
}

/// What is between its base, or the last axis, and the tool.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// A UR10 with the gripper of the library.
    Ur10,
    /// With the limits of its joints, rad.
    Fixed(Box<fixed::Geometry>, Option<Box<[[f64; 2]; fixed::JOINTS]>>),
    Scara(Box<Arms>),
    /// No joints: the tool is so far below the last axis, m.
    Tool(f64),
}

/// A joint that turns or, of a SCARA, slides, and its link as the world describes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    pub name: String,
    pub link: String,
    /// rad/s or m/s
    pub speed: f64,
    /// kg
    pub mass: f64,
    /// N m
    pub effort: f64,
    /// N m s/rad
    pub damping: f64,
    /// N m
    pub friction: f64,
}

/// The first frame of the schema that a SCARA has, behind those of six joints.
const INNER_ARM: usize = 1 + fixed::JOINTS;

impl Chain {
    /// The link that a frame of the schema is, from 1; 0 for the base. None if the chain has no such link.
    pub fn link(&self, frame: usize) -> Option<usize> {
        match self.geometry {
            Geometry::Scara(_) if frame > 0 => {
                frame.checked_sub(INNER_ARM).filter(|link| *link < scara::JOINTS).map(|link| link + 1)
            }
            _ => (frame <= self.joints.len()).then_some(frame),
        }
    }

    /// The axes that carry it, the first one first, with the numbers of their parts. `axis` finds one by its number.
    pub fn carriers<'a>(&self, axis: impl Fn(usize) -> Option<&'a Axis>) -> Vec<(usize, &'a Axis)> {
        let mut carriers = Vec::new();
        let mut next = self.on;
        while let Some((part, found)) = next.and_then(|part| Some((part, axis(part)?))) {
            carriers.push((part, found));
            next = found.on.filter(|before| *before < part);
        }
        carriers.reverse();
        carriers
    }
}

/// Highest acceleration that `limits` takes, m/s2 or rad/s2: ten times that of a fall, more than any drive has.
const HIGHEST_ACCELERATION: f64 = 100.0;

/// A chain at work.
#[derive(Clone, Debug)]
pub struct Swinging {
    drive: Drive,
    /// What may hold an item at its tool.
    grip: Option<usize>,
    /// Why the last command that ended in [`error::UNREACHABLE`] did.
    missed: Option<Missed>,
}

impl Swinging {
    pub fn new(drive: Drive, grip: Option<usize>) -> Self {
        Self { drive, grip, missed: None }
    }

    fn start(&mut self, target: Target, now: f64) -> Result<Begun, i32> {
        self.drive.start(target, now).map(|()| Begun::UnderWay).map_err(|missed| self.miss(missed))
    }

    fn miss(&mut self, missed: Missed) -> i32 {
        self.missed = Some(missed);
        error::UNREACHABLE
    }

    fn limit(&mut self, speed: f64, acceleration: f64) -> Result<Begun, i32> {
        let is_part = speed.is_normal() && speed > 0.0 && speed <= 1.0;
        let is_acceleration =
            acceleration.is_normal() && acceleration > 0.0 && acceleration <= HIGHEST_ACCELERATION;
        if !(is_part && is_acceleration && self.drive.is_at_rest()) {
            return Err(error::REFUSED);
        }
        self.drive.set_pace(speed, acceleration);
        Ok(Begun::Ended)
    }
}

impl Running for Swinging {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    fn begin(&mut self, action: usize, arguments: &[f64], world: &mut World) -> Result<Begun, i32> {
        let now = seconds(world.now_ms);
        match (action, arguments) {
            (0, &[x, y, z]) => self.start(Target::Place(Point::new(x, y, z)), now),
            (6, &[x, y, z]) => self.start(Target::Direct(Point::new(x, y, z)), now),
            (7, &[x, y, z, u, v, w]) => {
                let place = Point::new(x, y, z);
                let facing = Facing::new(Point::new(u, v, w));
                let facing = facing.ok_or_else(|| self.miss(Missed { place, why: Why::Direction }))?;
                self.start(Target::Facing(place, facing), now)
            }
            (8, &[x, y, z, turn]) => {
                let facing = Facing::oriented(turn).ok_or(error::UNREACHABLE)?;
                self.start(Target::Facing(Point::new(x, y, z), facing), now)
            }
            (1, &[speed, acceleration]) => self.limit(speed, acceleration),
            (2, &[x, y, z, turn]) if self.drive.has_torso() => {
                self.start(Target::Turned(Point::new(x, y, z), turn), now)
            }
            (3, &[x, y, z, u, v, w]) => {
                self.start(Target::Past(Point::new(x, y, z), Point::new(u, v, w)), now)
            }
            (4 | 5, &[x, y, z, u, v, w]) if self.drive.has_torso() => {
                let see = world.see();
                let holds = self.grip.is_some_and(|grip| see.borne_by(grip).next().is_some());
                let load = if holds { Load::Largest } else { Load::None };
                let end = if action == 4 { End::Above } else { End::AtGoal };
                let transfer = Transfer { via: Point::new(x, y, z), goal: Point::new(u, v, w), end };
                self.start(Target::Round(transfer, load), now)
            }
            _ => Err(error::REFUSED),
        }
    }

    fn abandon(&mut self, now_ms: u64) {
        self.drive.stop(seconds(now_ms));
    }

    fn hold(&mut self, held: bool, now_ms: u64) {
        let now = seconds(now_ms);
        if held { self.drive.hold(now) } else { self.drive.resume(now) }
    }

    /// It brakes even while it is held.
    fn advance(&mut self, world: &mut World) -> Progress {
        match self.drive.advance(seconds(world.next_ms())) {
            Moved::Moving => Progress::Going,
            Moved::Arrived => Progress::Reached,
            Moved::Lost(missed) => Progress::Failed(self.miss(missed)),
        }
    }

    fn missed(&self) -> Option<Missed> {
        self.missed
    }

    fn signal(&self, _signal: usize, _see: &See, out: &mut [f64]) {
        let Point { x, y, z } = self.drive.tool().position;
        out.copy_from_slice(&[x, y, z]);
    }

    fn trajectory(&self, _now_ms: u64) -> Trajectory {
        self.drive.under_way().map_or(Trajectory::Rests, |motion| Trajectory::Swings(motion.clone()))
    }

    fn next_change(&self, _see: &See, now_ms: u64) -> f64 {
        let now = seconds(now_ms);
        match self.drive.under_way() {
            // Held, it stands where it has come to.
            Some(motion) if motion.is_held() && motion.rests_at() <= now && !self.drive.is_braking() => f64::INFINITY,
            Some(motion) => 1000.0 * motion.rests_at(),
            None => f64::INFINITY,
        }
    }

    fn position(&self) -> Option<Point> {
        Some(self.drive.tool().position)
    }

    fn tool(&self) -> Option<Pose> {
        Some(self.drive.tool())
    }

    fn tool_goes(&self, from: f64, to: f64) -> f64 {
        self.drive.tool_goes(from, to)
    }

    fn tool_at(&self, time: f64) -> Option<Point> {
        Some(self.drive.tool_at(time))
    }

    fn joints(&self) -> Option<Joints> {
        Some(self.drive.joints())
    }
}

fn seconds(ms: u64) -> f64 {
    ms as f64 / 1000.0
}
