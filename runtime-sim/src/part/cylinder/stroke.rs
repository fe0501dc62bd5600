//! How a cylinder moves what is on it.

use crate::frame::Frame;
use crate::part::settings::Settings;
use crate::point::Point;

/// Where what is on a cylinder is when it is all the way out, from where it is when it is in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stroke {
    /// So far, in the world.
    Slides(Point),
    /// So many degrees to the left about the vertical through a point.
    Turns { pivot: Point, degrees: f64 },
}

impl Stroke {
    /// None for a cylinder that carries nothing.
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
            _ => Err("what is on a cylinder slides, or turns about a pivot by 360 degrees at most".into()),
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

/// A stroke as it continues from now, until a valve changes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroking {
    pub stroke: Stroke,
    /// Part of the stroke that it is out now.
    pub out: f64,
    /// Parts per second, less than 0 on the way in.
    pub rate: f64,
}

impl Stroking {
    pub fn moves(&self) -> bool {
        self.rate != 0.0
    }

    /// Part of the stroke after so many seconds.
    pub fn out(&self, seconds: f64) -> f64 {
        (self.out + self.rate * seconds).clamp(0.0, 1.0)
    }

    pub fn frame(&self, seconds: f64) -> Frame {
        self.stroke.frame(self.out(seconds))
    }

    /// Seconds until it comes to the end; infinity if it is at rest.
    pub fn rests_after(&self) -> f64 {
        let left = if self.rate > 0.0 { 1.0 - self.out } else { self.out };
        if self.moves() { left / self.rate.abs() } else { f64::INFINITY }
    }

    /// How it goes on then.
    pub fn after(&self, seconds: f64) -> Self {
        let rate = if seconds < self.rests_after() { self.rate } else { 0.0 };
        Self { out: self.out(seconds), rate, ..*self }
    }
}
