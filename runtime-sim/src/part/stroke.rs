//! How a cylinder or a positioner moves what is on it.

use crate::frame::Frame;
use crate::part::settings::Settings;
use crate::point::Point;

/// Where what is on it is when it is all the way out, from where it is when it is in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stroke {
    /// So far, in the world.
    Slides(Point),
    /// So many degrees to the left about the vertical through a point.
    Turns { pivot: Point, degrees: f64 },
}

impl Stroke {
    /// None for one that carries nothing.
    pub fn new(settings: &Settings) -> Result<Option<Self>, String> {
        let slides = settings.optional("slides", Settings::point)?;
        let turns = settings.optional("turns", Settings::number)?;
        let pivot = settings.optional("pivot", Settings::point)?;
        match (slides, turns, pivot) {
            (None, None, None) => Ok(None),
            (Some(far), None, None) => Ok(Some(Self::Slides(far))),
            (None, Some(degrees), Some(pivot)) if degrees.abs() <= 360.0 => {
                Ok(Some(Self::Turns { pivot, degrees }))
            }
            _ => Err("what is on it slides, or turns about a pivot by 360 degrees at most".into()),
        }
    }

    /// What is on it, in the world, when it is out by this part of its stroke; the identity when it is in.
    pub fn frame(&self, out: f64) -> Frame {
        match *self {
            Self::Slides(far) => Frame::new(far.scaled(out), 0.0),
            Self::Turns { pivot, degrees } => {
                let turned = Frame::new(pivot, degrees * out);
                turned.then(Frame::new(Point::default() - pivot, 0.0))
            }
        }
    }

    /// Metres that a point so far from a place at the inner end goes at most over a part of the stroke.
    pub fn path(&self, place: Point, reach: f64, part: f64) -> f64 {
        match *self {
            Self::Slides(far) => far.length() * part,
            Self::Turns { pivot, degrees } => {
                let radius = libm::hypot(place.x - pivot.x, place.y - pivot.y) + reach;
                radius * degrees.to_radians().abs() * part
            }
        }
    }
}

/// Parts of a stroke that differ by less are the same.
const SAME: f64 = 1e-9;

/// A stroke as it continues from now, until a valve or a command changes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroking {
    pub stroke: Stroke,
    /// Part of the stroke that it is out now.
    pub out: f64,
    /// Parts per second, less than 0 on the way in.
    pub rate: f64,
    /// Part of the stroke at which it stops.
    pub until: f64,
}

impl Stroking {
    pub fn moves(&self) -> bool {
        self.rate != 0.0
    }

    /// Part of the stroke after so many seconds.
    pub fn out(&self, seconds: f64) -> f64 {
        let (low, high) = (self.out.min(self.until), self.out.max(self.until));
        (self.out + self.rate * seconds).clamp(low, high)
    }

    pub fn frame(&self, seconds: f64) -> Frame {
        self.stroke.frame(self.out(seconds))
    }

    /// Whether the other one is the same after so many seconds.
    pub fn becomes(&self, other: &Self, seconds: f64) -> bool {
        let then = self.after(seconds);
        let rests = !then.moves() && !other.moves();
        (rests || (then.rate, then.until) == (other.rate, other.until))
            && then.stroke == other.stroke
            && (then.out - other.out).abs() <= SAME
    }

    /// Seconds until it stops; infinity if it is at rest.
    pub fn rests_after(&self) -> f64 {
        if self.moves() { (self.until - self.out).abs() / self.rate.abs() } else { f64::INFINITY }
    }

    /// How it goes on then.
    pub fn after(&self, seconds: f64) -> Self {
        let rate = if seconds < self.rests_after() { self.rate } else { 0.0 };
        Self { out: self.out(seconds), rate, ..*self }
    }
}

/// What moves other parts along a stroke, and stops at places of it: a cylinder at both ends, a positioner at each of its
/// positions.
pub trait Carriage {
    /// None if nothing is on it.
    fn stroke(&self) -> Option<Stroke>;

    /// Part of the stroke that it is out at a time not before the last scan, parts per second, and the part at which it
    /// stops, if nothing new is asked of it.
    fn going(&self, now_ms: u64) -> [f64; 3];

    /// From when on it is at a stop, if nothing new is asked of it from `now_ms` on, ms; infinity: never.
    fn is_at_from(&self, stop: usize, now_ms: u64) -> f64;

    /// Start of the present span.
    fn now_ms(&self) -> u64;

    /// How it moves what is on it from a time on, if nothing new is asked of it; none if nothing is on it.
    fn stroking(&self, now_ms: u64) -> Option<Stroking> {
        let stroke = self.stroke()?;
        let [out, rate, until] = self.going(now_ms);
        Some(Stroking { stroke, out, rate, until })
    }

    /// What is on it at a time from the start of this span on, ms, from where it is at the inner end.
    fn frame(&self, ms: f64) -> Frame {
        let seconds = (ms - self.now_ms() as f64) / 1000.0;
        self.stroking(self.now_ms()).map_or(Frame::default(), |stroking| stroking.frame(seconds))
    }
}

/// The stroke of a carriage and its stops.
#[derive(Clone, Debug, PartialEq)]
pub struct Strokes {
    pub stroke: Option<Stroke>,
    /// Parts of the stroke at which it stops.
    pub stops: Vec<f64>,
    /// The stop at which it begins.
    pub begins: usize,
}

impl Strokes {
    /// What is on it when a run begins, from where it is at the inner end.
    pub fn begin(&self) -> Frame {
        let out = self.stops.get(self.begins).copied().unwrap_or_default();
        self.stroke.map_or(Frame::default(), |stroke| stroke.frame(out))
    }
}
