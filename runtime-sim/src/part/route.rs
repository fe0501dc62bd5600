//! A vehicle between stops.

use super::settings::{Form, Setting, Settings};
use super::{Described, Action, Begun, Progress, Running, Schema, See, Signal, World, Start};
use crate::device::{Extent, PortType, error};
use crate::plant::EARLY_MS;
use crate::plant::trajectory::Trajectory;
use crate::point::Point;

pub const SCHEMA: Schema = Schema {
    signals: &[
        Signal { name: "position", ty: PortType::Point, extent: Extent::One },
        Signal { name: "at_stop", ty: PortType::Int { lo: -1, hi: 2 }, extent: Extent::One },
    ],
    actions: &[Action { name: "to", arguments: &[PortType::Point] }],
    can_jam: true,
    ..Schema::new(
        "route",
        "A vehicle that moves straight from stop to stop, always with the same orientation. It starts at the first stop.",
        &[
            Setting::new("stops", Form::Points, "m", "its stops"),
            Setting::new("speed", Form::Positive, "m/s", "from start to end of a trip"),
            Setting::new("latency", Form::Number, "ms", "from the command to the start"),
            Setting::new("tolerance", Form::Positive, "m", "greatest distance of a goal from the stop that it means"),
            Setting::new("mass", Form::Positive, "kg", "of all moving bodies, for the world"),
        ],
    )
};

#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    pub stops: Vec<Point>,
    pub speed: f64,
    pub latency_ms: u64,
    pub tolerance: f64,
    pub mass: f64,
}

impl Described for Route {
    fn new(settings: &Settings) -> Result<Self, String> {
        let stops = settings.points("stops")?;
        if stops.is_empty() {
            return Err("the setting stops is empty".into());
        }
        Ok(Self {
            stops,
            speed: settings.positive("speed")?,
            latency_ms: settings.milliseconds("latency")?,
            tolerance: settings.positive("tolerance")?,
            mass: settings.positive("mass")?,
        })
    }

    fn start(&self, _start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        Ok(Some(Box::new(Driving::new(self))))
    }
}

/// A vehicle at work.
#[derive(Clone, Debug)]
pub struct Driving {
    route: Route,
    position: Point,
    trip: Option<Trip>,
    motion: Motion,
    held: bool,
}

/// From where a command found the vehicle to a stop.
#[derive(Clone, Debug)]
struct Trip {
    from: Point,
    to: Point,
    length: f64,
    /// Since the command, without the time it was held.
    elapsed_ms: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Motion {
    Standing,
    Moving,
}

impl Driving {
    pub fn new(route: &Route) -> Self {
        let position = route.stops[0];
        Self { route: route.clone(), position, trip: None, motion: Motion::Standing, held: false }
    }

    fn stop_near(&self, point: Point) -> Option<usize> {
        self.route.stops.iter().position(|&stop| length(stop - point) <= self.route.tolerance)
    }
}

impl Running for Driving {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    fn begin(&mut self, action: usize, arguments: &[f64], _world: &mut World) -> Result<Begun, i32> {
        let (0, &[x, y, z]) = (action, arguments) else { return Err(error::REFUSED) };
        let stop = self.stop_near(Point::new(x, y, z)).ok_or(error::UNREACHABLE)?;
        let (from, to) = (self.position, self.route.stops[stop]);
        self.trip = Some(Trip { from, to, length: length(to - from), elapsed_ms: 0 });
        Ok(Begun::UnderWay)
    }

    fn abandon(&mut self, _now_ms: u64) {
        self.trip = None;
    }

    fn hold(&mut self, held: bool, _now_ms: u64) {
        self.held = held;
    }

    fn advance(&mut self, world: &mut World) -> Progress {
        self.motion = Motion::Standing;
        if self.held {
            return Progress::Going;
        }
        let Some(trip) = &mut self.trip else { return Progress::Going };
        let Route { speed, latency_ms, .. } = self.route;
        trip.elapsed_ms += world.dt_ms;
        let travelled = speed * trip.elapsed_ms.saturating_sub(latency_ms) as f64 / 1000.0;
        if trip.elapsed_ms >= latency_ms && travelled + speed * EARLY_MS / 1000.0 >= trip.length {
            self.position = trip.to;
            self.trip = None;
            return Progress::Reached;
        }
        if travelled > 0.0 {
            let share = travelled / trip.length;
            self.position = trip.from + (trip.to - trip.from).scaled(share);
            self.motion = Motion::Moving;
        }
        Progress::Going
    }

    fn signal(&self, signal: usize, _see: &See, out: &mut [f64]) {
        if signal == 0 {
            out.copy_from_slice(&[self.position.x, self.position.y, self.position.z]);
            return;
        }
        let stop = match self.motion {
            Motion::Standing => self.stop_near(self.position),
            Motion::Moving => None,
        };
        out[0] = stop.map_or(-1.0, |stop| stop as f64);
    }

    /// It sets out, or arrives.
    fn next_change(&self, _see: &See, now_ms: u64) -> f64 {
        let Some(trip) = self.trip.as_ref().filter(|_| !self.held) else { return f64::INFINITY };
        let Route { speed, latency_ms, .. } = self.route;
        let begin = (now_ms + latency_ms) as f64 - trip.elapsed_ms as f64;
        if trip.elapsed_ms <= latency_ms { begin } else { begin + 1000.0 * trip.length / speed }
    }

    fn trajectory(&self, now_ms: u64) -> Trajectory {
        let Some(trip) = self.trip.as_ref().filter(|trip| !self.held && trip.length > 0.0) else {
            return Trajectory::Rests;
        };
        let Route { speed, latency_ms, .. } = self.route;
        let from_ms = (now_ms + latency_ms) as f64 - trip.elapsed_ms as f64;
        let until_ms = from_ms + 1000.0 * trip.length / speed;
        Trajectory::Drives { velocity: (trip.to - trip.from).scaled(speed / trip.length), from_ms, until_ms }
    }

    fn position(&self) -> Option<Point> {
        Some(self.position)
    }
}

fn length(p: Point) -> f64 {
    libm::sqrt(p.x * p.x + p.y * p.y + p.z * p.z)
}
