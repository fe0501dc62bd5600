//! A straight conveyor: items lie on it and go with it.

use super::settings::{Form, Setting, Settings};
use super::{Described, Action, Begun, Progress, Running, Schema, See, Signal, World, Start};
use crate::carrier::Carrier;
use crate::device::{Extent, PortType, error};
use crate::plant::trajectory::Trajectory;
use crate::point::{Axis, Point};

pub const SCHEMA: Schema = Schema {
    signals: &[Signal { name: "moves", ty: PortType::Bool, extent: Extent::One }],
    actions: &[Action { name: "run", arguments: &[] }, Action { name: "rest", arguments: &[] }],
    ..Schema::new(
        "lane",
        "A straight conveyor along an axis of the world, from the upper to the lower end of its range.",
        &[
            Setting::new("along", Form::Axis, "", "axis of the world along which it lies"),
            Setting::new("range", Form::Range, "m", "both ends along this axis, in the world"),
            Setting::new("surface", Form::Point, "m", "a point of its middle line"),
            Setting::new("width", Form::Positive, "m", "of the moving surface"),
            Setting::new("outline", Form::Positive, "m", "width of the whole conveyor in drawings"),
            Setting::new("speed", Form::Positive, "m/s", "full speed; its changes are steps"),
        ],
    )
};

#[derive(Clone, Debug, PartialEq)]
pub struct Lane {
    pub along: Axis,
    pub range: [f64; 2],
    pub surface: Point,
    pub width: f64,
    pub outline: f64,
    pub speed: f64,
}

impl Described for Lane {
    fn new(settings: &Settings) -> Result<Self, String> {
        Ok(Self {
            along: settings.axis("along")?,
            range: settings.range("range")?,
            surface: settings.point("surface")?,
            width: settings.positive("width")?,
            outline: settings.positive("outline")?,
            speed: settings.positive("speed")?,
        })
    }

    fn start(&self, start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        Ok(Some(Box::new(Moving::new(self, start.part))))
    }
}

impl Lane {
    /// Metres in so many milliseconds at full speed.
    pub fn distance(&self, ms: u64) -> f64 {
        self.speed * ms as f64 / 1000.0
    }
}

/// What is less is rounding, m.
const AT_ONCE: f64 = 1e-9;

/// A lane at work.
#[derive(Clone, Debug)]
pub struct Moving {
    lane: Lane,
    part: usize,
    drive: Drive,
    held: bool,
    /// Milliseconds at full speed since the start of the run.
    travel_ms: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Drive {
    FullSpeed,
    Rest,
}

impl Moving {
    pub fn new(lane: &Lane, part: usize) -> Self {
        Self { lane: lane.clone(), part, drive: Drive::Rest, held: false, travel_ms: 0 }
    }

    pub fn lane(&self) -> &Lane {
        &self.lane
    }

    pub fn travel_ms(&self) -> u64 {
        self.travel_ms
    }

    /// Metres that it has moved since the start of the run.
    pub fn travel(&self) -> f64 {
        self.lane.distance(self.travel_ms)
    }

    pub fn is_moving(&self) -> bool {
        self.drive == Drive::FullSpeed && !self.held
    }

    /// When it has moved so many metres since the start of the run, ms; now, if it has just moved so far, and infinity if
    /// it has moved farther or stands.
    pub fn reaches(&self, travel: f64, now_ms: u64) -> f64 {
        let left = travel - self.travel();
        if !self.is_moving() || left < -AT_ONCE {
            return f64::INFINITY;
        }
        now_ms as f64 + 1000.0 * (left - AT_ONCE).max(0.0) / self.lane.speed
    }

    /// Where an item rests that has these coordinates, see [`Carrier::Lane`].
    pub fn rests(&self, at: f64, across: f64) -> Point {
        let along = at - self.travel();
        let surface = self.lane.surface;
        match self.lane.along {
            Axis::X => Point::new(along, surface.y + across, surface.z),
            Axis::Y => Point::new(surface.x + across, along, surface.z),
        }
    }
}

impl Running for Moving {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    fn begin(&mut self, action: usize, _arguments: &[f64], _world: &mut World) -> Result<Begun, i32> {
        self.drive = match action {
            0 => Drive::FullSpeed,
            1 => Drive::Rest,
            _ => return Err(error::REFUSED),
        };
        Ok(Begun::UnderWay)
    }

    fn hold(&mut self, held: bool, _now_ms: u64) {
        self.held = held;
    }

    fn advance(&mut self, world: &mut World) -> Progress {
        if self.is_moving() {
            self.travel_ms += world.dt_ms;
        }
        Progress::Reached
    }

    fn signal(&self, _signal: usize, _see: &See, out: &mut [f64]) {
        out[0] = f64::from(u8::from(self.is_moving()));
    }

    fn trajectory(&self, _now_ms: u64) -> Trajectory {
        if !self.is_moving() {
            return Trajectory::Rests;
        }
        let speed = self.lane.speed;
        let velocity = match self.lane.along {
            Axis::X => Point::new(-speed, 0.0, 0.0),
            Axis::Y => Point::new(0.0, -speed, 0.0),
        };
        Trajectory::Drives { velocity, from_ms: 0.0, until_ms: f64::INFINITY }
    }

    fn is_busy(&self, see: &See) -> bool {
        self.is_moving() && see.borne_by(self.part).next().is_some()
    }

    fn below(&self, point: Point, see: &See) -> Option<(f64, Carrier)> {
        let Lane { along, range, surface, width, .. } = self.lane;
        let (at, across) = match along {
            Axis::X => (point.x, point.y - surface.y),
            Axis::Y => (point.y, point.x - surface.x),
        };
        let meets = (range[0]..=range[1]).contains(&at) && across.abs() <= width / 2.0;
        let at = at + self.travel();
        let carrier = Carrier::Lane { machine: see.machine, part: self.part, at, across };
        meets.then_some((surface.z, carrier))
    }

    fn place(&self, carrier: &Carrier, _see: &See) -> Option<Point> {
        match *carrier {
            Carrier::Lane { at, across, .. } => Some(self.rests(at, across)),
            _ => None,
        }
    }

    fn lane(&self) -> Option<&Moving> {
        Some(self)
    }
}
