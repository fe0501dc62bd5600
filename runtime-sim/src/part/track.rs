//! A vehicle on a track.

mod course;
mod ride;

pub use course::Course;
pub use ride::{Begin, Piece, Ride};

use super::settings::{Form, Setting, Settings};
use super::{Action, Begun, Described, Progress, Running, Schema, See, Signal, Start, World};
use crate::device::{Extent, PortType, error};
use crate::frame::Frame;
use crate::plant::trajectory::Trajectory;
use crate::point::Point;
use std::sync::Arc;

/// Places at most.
const MOST_PLACES: i32 = 32;

pub const SCHEMA: Schema = Schema {
    signals: &[
        Signal { name: "position", ty: PortType::Point, extent: Extent::One },
        Signal { name: "place", ty: PortType::Int { lo: -1, hi: MOST_PLACES - 1 }, extent: Extent::One },
        Signal { name: "stands", ty: PortType::Bool, extent: Extent::One },
    ],
    actions: &[
        Action { name: "to", arguments: &[PortType::Int { lo: 0, hi: MOST_PLACES - 1 }] },
        Action { name: "halt", arguments: &[] },
    ],
    can_jam: true,
    ..Schema::new(
        "track",
        "A vehicle that follows a track on the floor, straight from corner to corner. It does not slow down at corners, and turns there at once. It goes round a closed track in one direction; on an open track it also drives back.",
        &[
            Setting::new("corners", Form::Points, "m", "of the path of its middle, all with the same z"),
            Setting::new("closed", Form::Truth, "", "the track continues from the last corner to the first").optional(),
            Setting::new("places", Form::Numbers, "m", "along the track from the first corner: its possible goals, which `place` reports; at most 32"),
            Setting::new("begins", Form::Number, "m", "its place along the track at the start; without it, the first corner").optional(),
            Setting::new("speed", Form::Positive, "m/s", "greatest velocity"),
            Setting::new("acceleration", Form::Positive, "m/s2", "greatest acceleration, also for braking"),
            Setting::new("mass", Form::Positive, "kg", "of all moving bodies, for the world"),
        ],
    )
};

#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    pub course: Arc<Course>,
    pub places: Vec<f64>,
    pub begins: f64,
    pub speed: f64,
    pub acceleration: f64,
    pub mass: f64,
}

/// Two places are the same that are no farther from one another, m.
const SAME: f64 = 1e-6;

impl Described for Track {
    fn new(settings: &Settings) -> Result<Self, String> {
        let is_closed = settings.has("closed") && settings.truth("closed")?;
        let course = Course::new(&settings.points("corners")?, is_closed)?;
        let places = settings.numbers("places")?;
        let begins = settings.optional("begins", Settings::number)?.unwrap_or(0.0);
        let length = course.length();
        let is_on_track = |place: f64| (-SAME..=length + SAME).contains(&place);
        if let Some((number, place)) = places.iter().enumerate().find(|(_, place)| !is_on_track(**place)) {
            return Err(format!("place {number} is at {place:.3} m of a track of {length:.3} m"));
        }
        if !is_on_track(begins) {
            return Err(format!("it begins at {begins:.3} m of a track of {length:.3} m"));
        }
        if places.len() > MOST_PLACES as usize {
            return Err(format!("{} places, {MOST_PLACES} are the most", places.len()));
        }
        let on_track = |place: f64| course.on_track(place);
        Ok(Self {
            places: places.into_iter().map(on_track).collect(),
            begins: on_track(begins),
            course: Arc::new(course),
            speed: settings.positive("speed")?,
            acceleration: settings.positive("acceleration")?,
            mass: settings.positive("mass")?,
        })
    }

    fn start(&self, _start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        Ok(Some(Box::new(Driving::new(self))))
    }
}

impl Track {
    /// Where the vehicle is at the start.
    pub fn begin(&self) -> Frame {
        self.course.frame(self.begins)
    }

    /// The place that lies last behind this one; none on an open track before the first.
    fn behind(&self, place: f64) -> Option<usize> {
        let gone = |other: f64| {
            let gone = place - other + SAME;
            if self.course.is_closed() { self.course.on_track(gone) } else { gone }
        };
        let behind = self.places.iter().map(|other| gone(*other)).enumerate().filter(|(_, gone)| *gone >= 0.0);
        behind.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(number, _)| number)
    }
}

/// A vehicle at work.
#[derive(Clone, Debug)]
pub struct Driving {
    track: Track,
    now_ms: u64,
    /// Where it rests.
    place: f64,
    /// While it moves.
    ride: Option<Ride>,
    /// The places that it comes by on this ride: when, ms, and their numbers.
    ahead: Vec<(f64, usize)>,
    passed: Option<usize>,
    asked: Option<Asked>,
    held: bool,
}

/// What the command under way asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Asked {
    Place(usize),
    Halt,
}

impl Driving {
    fn new(track: &Track) -> Self {
        Self {
            track: track.clone(),
            now_ms: 0,
            place: track.begins,
            ride: None,
            ahead: Vec::new(),
            passed: track.behind(track.begins),
            asked: None,
            held: false,
        }
    }

    fn course(&self) -> &Course {
        &self.track.course
    }

    /// Where it is along the track at a time from now on, if no command changes anything.
    fn place(&self, ms: f64) -> f64 {
        self.ride.as_ref().map_or(self.place, |ride| ride.place(ms))
    }

    pub fn frame(&self, ms: f64) -> Frame {
        self.course().frame(self.place(ms))
    }

    pub fn frame_now(&self) -> Frame {
        self.frame(self.now_ms as f64)
    }

    /// When it comes to rest, ms.
    pub fn rests_ms(&self) -> f64 {
        self.ride.as_ref().map_or(f64::NEG_INFINITY, Ride::end_ms)
    }

    /// That it does not exceed until a command changes it, m/s.
    pub fn speed_limit(&self) -> f64 {
        self.ride.as_ref().map_or(0.0, Ride::top_speed)
    }

    /// How far a point is from the track within so many metres ahead of it at a time, m.
    pub fn distance(&self, point: Point, range: f64, ms: f64) -> f64 {
        let place = self.place(ms);
        self.course().distance(point, place, place + range)
    }

    fn now(&self) -> Begin {
        let now_ms = self.now_ms as f64;
        Begin {
            ms: now_ms,
            place: self.place(now_ms),
            speed: self.ride.as_ref().map_or(0.0, |ride| ride.speed(now_ms)),
            top_speed: self.track.speed,
            acceleration: self.track.acceleration,
        }
    }

    /// Metres to a place, less than 0 back; none if it comes to it too fast to stop there.
    fn way_to(&self, place: f64) -> Option<f64> {
        let now = self.now();
        let mut way = place - now.place;
        if self.course().is_closed() {
            way = self.course().on_track(way);
            if self.course().length() - way < SAME {
                way = 0.0;
            }
        }
        if way.abs() < SAME && now.speed == 0.0 {
            return Some(0.0);
        }
        let sign = self.ride.as_ref().map_or(way.signum(), Ride::sign);
        (now.speed == 0.0 || way * sign >= now.braking() - SAME).then_some(way)
    }

    /// Sets out, or continues as it is, to rest so far ahead.
    fn ride(&mut self, way: f64) {
        let now = self.now();
        let way = way.signum() * way.abs().max(now.braking());
        if way == 0.0 {
            self.place = now.place;
            self.ride = None;
            self.ahead.clear();
            return;
        }
        let ride = Ride::new(self.track.course.clone(), now, now.place + way);
        let length = self.course().length();
        self.ahead.clear();
        for (number, place) in self.track.places.iter().enumerate() {
            let mut gone = (place - now.place) * ride.sign();
            if self.course().is_closed() {
                gone = self.course().on_track(gone);
                // A place that is rounded to be behind it.
                if length - gone < SAME {
                    gone = 0.0;
                }
            }
            if (-SAME..=way.abs() + SAME).contains(&gone) {
                self.ahead.push((ride.time_of(gone), number));
            }
        }
        self.ahead.sort_by(|a, b| a.0.total_cmp(&b.0));
        self.ride = Some(ride);
    }

    fn brake(&mut self) {
        let sign = self.ride.as_ref().map_or(1.0, Ride::sign);
        self.ride(sign * self.now().braking());
    }

    /// Goes on after it was held.
    fn resume(&mut self) {
        if let Some(Asked::Place(number)) = self.asked
            && let Some(way) = self.way_to(self.track.places[number])
        {
            self.ride(way);
        }
    }
}

impl Running for Driving {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    fn begin(&mut self, action: usize, arguments: &[f64], world: &mut World) -> Result<Begun, i32> {
        self.now_ms = world.now_ms;
        self.asked = None;
        match (action, arguments) {
            (0, &[number]) => {
                let place = self.track.places.get(number as usize).filter(|_| number >= 0.0);
                let way = place.and_then(|place| self.way_to(*place)).ok_or(error::UNREACHABLE)?;
                self.asked = Some(Asked::Place(number as usize));
                if !self.held {
                    self.ride(way);
                }
            }
            (1, []) => {
                self.asked = Some(Asked::Halt);
                self.brake();
            }
            _ => return Err(error::REFUSED),
        }
        Ok(Begun::UnderWay)
    }

    /// It comes to rest.
    fn abandon(&mut self, now_ms: u64) {
        self.now_ms = now_ms;
        self.asked = None;
        self.brake();
    }

    fn hold(&mut self, held: bool, now_ms: u64) {
        if self.held == held {
            return;
        }
        self.now_ms = now_ms;
        self.held = held;
        if held { self.brake() } else { self.resume() }
    }

    fn advance(&mut self, world: &mut World) -> Progress {
        self.now_ms = world.next_ms();
        let now_ms = self.now_ms as f64;
        let gone = self.ahead.partition_point(|(ms, _)| *ms <= now_ms);
        if let Some((_, number)) = self.ahead.drain(..gone).next_back() {
            self.passed = Some(number);
        }
        if let Some(ride) = self.ride.as_ref().filter(|ride| ride.end_ms() <= now_ms) {
            self.place = self.course().on_track(ride.to());
            self.ride = None;
        }
        if self.ride.is_none() && !self.held && self.asked.take().is_some() {
            return Progress::Reached;
        }
        Progress::Going
    }

    fn signal(&self, signal: usize, _see: &See, out: &mut [f64]) {
        match signal {
            0 => {
                let Point { x, y, z } = self.frame_now().position;
                out.copy_from_slice(&[x, y, z]);
            }
            1 => out[0] = self.passed.map_or(-1.0, |number| number as f64),
            _ => out[0] = f64::from(u8::from(self.ride.is_none())),
        }
    }

    /// It comes by a place, or to rest.
    fn next_change(&self, _see: &See, now_ms: u64) -> f64 {
        match &self.ride {
            Some(ride) => self.ahead.first().map_or(ride.end_ms(), |(ms, _)| ms.min(ride.end_ms())),
            None if self.asked.is_some() && !self.held => now_ms as f64,
            None => f64::INFINITY,
        }
    }

    fn trajectory(&self, _now_ms: u64) -> Trajectory {
        self.ride.clone().map_or(Trajectory::Rests, Trajectory::Rides)
    }

    fn position(&self) -> Option<Point> {
        Some(self.frame_now().position)
    }

    fn vehicle(&self) -> Option<&Driving> {
        Some(self)
    }
}
