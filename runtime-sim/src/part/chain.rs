//! The joints of an arm behind the axes that carry it, moved together.

use super::settings::{Form, Setting, Settings};
use super::{Described, Action, Begun, Progress, Running, Schema, See, Signal, World, Start, Primitive};
use crate::device::{Extent, PortType, error};
use crate::kinematics::arm::Joints;
use crate::frame::Frame;
use crate::kinematics::pose::Pose;
use crate::kinematics::ur::Lengths;
use crate::part::axis::Axis;
use crate::plant::trajectory::Trajectory;
use crate::point::Point;
use crate::planner::{End, Load, Transfer};
use drive::{Drive, Moved, Target};

pub mod drive;
pub(crate) mod motions;

pub const SCHEMA: Schema = Schema {
    frames: &["base", "shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3"],
    signals: &[Signal { name: "tool", ty: PortType::Point, extent: Extent::One }],
    actions: &[
        Action { name: "joints", arguments: &[PortType::Point] },
        Action { name: "limits", arguments: &[PortType::Real, PortType::Real] },
        Action { name: "turned", arguments: &[PortType::Point, PortType::Real] },
        Action { name: "past", arguments: &[PortType::Point, PortType::Point] },
        Action { name: "around", arguments: &[PortType::Point, PortType::Point] },
        Action { name: "onto", arguments: &[PortType::Point, PortType::Point] },
        Action { name: "direct", arguments: &[PortType::Point] },
    ],
    can_jam: true,
    ..Schema::new(
        "chain",
        "Six joints as in a Universal Robots arm, with the tool pointing down: either carried by axes, with the lengths of the UR10, or fixed at `from`, with the given lengths.",
        &[
            Setting::new("on", Form::Part(&["axis"]), "", "the last of the axes that carry it").optional(),
            Setting::new("from", Form::Frame, "m", "frame of its base, if no axis carries it").optional(),
            Setting::new("lengths", Form::Numbers, "m", "d1, a2, a3, d4, d5, d6 of the manufacturer, for a fixed one")
                .optional(),
            Setting::new("tool_length", Form::Number, "m", "from the flange to the tool centre point, for a fixed one")
                .optional(),
            Setting::new("rest", Form::Point, "m", "place of the tool at the start"),
            Setting::new("speeds", Form::Numbers, "rad/s", "greatest velocity of each joint"),
            Setting::new("acceleration", Form::Positive, "rad/s2", "greatest of each joint, initially"),
            Setting::new("joints", Form::Words, "", "names of the joints, in the world"),
            Setting::new("links", Form::Words, "", "names of the links, in the world"),
            Setting::new("masses", Form::Numbers, "kg", "of the links, for the world"),
            Setting::new("efforts", Form::Numbers, "N m", "greatest, for the world"),
            Setting::new("damping", Form::Numbers, "N m s/rad", "for the world"),
            Setting::new("friction", Form::Numbers, "N m", "for the world"),
            Setting::new(
                "envelope",
                Form::Numbers,
                "m",
                "workspace that others keep free: half of its width across the axis, and its height over the shoulder; empty: none",
            ),
            Setting::new(
                "clearances",
                Form::Points,
                "m",
                "of the bodies that turn with it about the vertical: lower and upper end from the shoulder's height, and the distance of the axis from obstacles between them",
            ),
        ],
    )
};

/// Joints behind the axes.
const JOINTS: usize = 6;

#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// The last of the axes that carry it.
    pub on: Option<usize>,
    /// Where its base stands, if none does.
    pub base: Option<Frame>,
    /// Of a fixed one.
    pub lengths: Option<Lengths>,
    pub rest: Point,
    pub speeds: Vec<f64>,
    pub acceleration: f64,
    pub joints: Vec<String>,
    pub links: Vec<String>,
    pub masses: Vec<f64>,
    pub efforts: Vec<f64>,
    pub damping: Vec<f64>,
    pub friction: Vec<f64>,
    pub envelope: Option<[f64; 2]>,
    /// Lower end, upper end and radius of each.
    pub clearances: Vec<[f64; 3]>,
}

impl Described for Chain {
    fn new(settings: &Settings) -> Result<Self, String> {
        let numbers = |name: &str| {
            let numbers = settings.numbers(name)?;
            if numbers.len() == JOINTS {
                Ok(numbers)
            } else {
                Err(format!("the setting {name} has not a number for each of {JOINTS} joints"))
            }
        };
        let words = |name: &str| {
            let words = settings.words(name)?;
            if words.len() == JOINTS {
                Ok(words)
            } else {
                Err(format!("the setting {name} has not a name for each of {JOINTS} joints"))
            }
        };
        let speeds = numbers("speeds")?;
        if speeds.iter().any(|speed| *speed <= 0.0) {
            return Err("a number of the setting speeds is not over 0".into());
        }
        let envelope = match settings.numbers("envelope")?[..] {
            [] => None,
            [half, height] => Some([half, height]),
            _ => return Err("the setting envelope has neither two numbers nor none".into()),
        };
        let on = settings.optional("on", Settings::part)?;
        let base = settings.optional("from", Settings::upright)?;
        let lengths = lengths(settings)?;
        if on.is_some() == base.is_some() || base.is_some() != lengths.is_some() {
            return Err("a chain is on an axis, or it has from, lengths and tool_length".into());
        }
        Ok(Self {
            on,
            base,
            lengths,
            rest: settings.point("rest")?,
            speeds,
            acceleration: settings.positive("acceleration")?,
            joints: words("joints")?,
            links: words("links")?,
            masses: numbers("masses")?,
            efforts: numbers("efforts")?,
            damping: numbers("damping")?,
            friction: numbers("friction")?,
            envelope,
            clearances: settings.points("clearances")?.iter().map(|p| [p.x, p.y, p.z]).collect(),
        })
    }

    fn start(&self, start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        let (machine, part) = (start.machine(), start.part);
        let name = &machine.name;
        let motions = start.memory.motions(start.line, start.machine);
        let motions = motions.ok_or_else(|| format!("{name} has no inverse kinematics"))?;
        let drive = Drive::new(motions, self.rest)
            .ok_or_else(|| format!("{name} cannot reach its own rest position"))?;
        let grip = start.find(|other| matches!(other, Primitive::Grip(grip) if grip.chain == part));
        Ok(Some(Box::new(Swinging::new(drive, grip))))
    }
}

fn lengths(settings: &Settings) -> Result<Option<Lengths>, String> {
    let numbers = settings.optional("lengths", Settings::numbers)?;
    match (numbers.as_deref(), settings.optional("tool_length", Settings::number)?) {
        (None, None) => Ok(None),
        (Some(&[d1, a2, a3, d4, d5, d6]), Some(tool)) if a2 != 0.0 && a3 != 0.0 => {
            Ok(Some(Lengths { d1, a2, a3, d4, d5, tool: d6 + tool }))
        }
        _ => Err("the settings lengths and tool_length are d1, a2, a3, d4, d5, d6, of which a2 and a3 are not 0, and a length".into()),
    }
}

impl Chain {
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
}

impl Swinging {
    pub fn new(drive: Drive, grip: Option<usize>) -> Self {
        Self { drive, grip }
    }

    fn start(&mut self, target: Target, now: f64) -> Result<Begun, i32> {
        self.drive.start(target, now).map(|()| Begun::UnderWay).ok_or(error::UNREACHABLE)
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
            Moved::Lost => Progress::Failed(error::UNREACHABLE),
        }
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

    fn joints(&self) -> Option<Joints> {
        Some(self.drive.joints())
    }
}

fn seconds(ms: u64) -> f64 {
    ms as f64 / 1000.0
}
