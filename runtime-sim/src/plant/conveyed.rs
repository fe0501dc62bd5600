//! How an item on a conveyor continues.

use crate::fingerprint::Fingerprint;
use crate::frame::Frame;
use crate::part::lane::CentreLine;
use crate::part::stroke::{Stroke, Stroking};
use crate::point::{Axis, Point};

/// The motion of an item on a conveyor, or at a place that is carried, from now on, until a drive, a cylinder or another item
/// changes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conveyed {
    pub centre_line: CentreLine,
    /// Place of its middle on the centre line, now.
    pub place: f64,
    pub across: f64,
    /// Of what lies on an item, from that: ahead, to the left and upwards where the conveyor turns items, else along the
    /// axes of what carries it.
    pub offset: Point,
    /// m/s.
    pub speed: f64,
    /// It goes no farther; negative infinity: nothing that stands is in its way.
    pub stops_at: f64,
    /// How the conveyor itself moves; the centre line is where it is at the inner end.
    pub carried: Option<Stroking>,
}

/// Places that differ by less are the same, m.
const SAME: f64 = 1e-9;
/// What is rounded of a place from one event to the next one, m.
const ROUNDED: f64 = 1e-8;

/// In the world at the beginning; metres and radians a second, turns to the left about the vertical.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Along {
    Straight(Point),
    Arc { middle: Point, rate: f64, climb: f64 },
}

/// In the world; metres and radians a second, turns to the left about the vertical.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Carry {
    Slides(Point),
    Turns { pivot: Point, rate: f64 },
}

impl Conveyed {
    /// It lies where a carriage is at its inner end at this point, and does not move on it.
    pub fn standing(surface: Point) -> Self {
        let centre_line = CentreLine::Axis { along: Axis::X, range: [surface.x; 2], surface };
        Self {
            centre_line,
            place: surface.x,
            across: 0.0,
            offset: Point::default(),
            speed: 0.0,
            stops_at: f64::NEG_INFINITY,
            carried: None,
        }
    }

    pub fn moves(&self) -> bool {
        self.speed > 0.0 || self.carried.is_some_and(|carried| carried.moves())
    }

    fn place_after(&self, seconds: f64) -> f64 {
        (self.place - self.speed * seconds).max(self.stops_at.min(self.place))
    }

    /// The same as [`Self::point`], as seen from what carries the conveyor.
    pub fn on_line(&self, seconds: f64) -> Point {
        let place = self.place_after(seconds);
        if self.offset == Point::default() {
            return self.centre_line.point(place, self.across);
        }
        match self.centre_line.turns_items() {
            true => self.centre_line.frame(place).point(self.offset + Point::new(0.0, self.across, 0.0)),
            false => self.centre_line.point(place, self.across) + self.offset,
        }
    }

    /// Where its underside is after so many seconds.
    pub fn point(&self, seconds: f64) -> Point {
        let point = self.on_line(seconds);
        self.carried.map_or(point, |carried| carried.frame(seconds).point(point))
    }

    /// How it is turned about the vertical, degrees; `own` is its heading on what carries it, which it keeps unless it lies
    /// along a conveyor.
    pub fn yaw(&self, seconds: f64, own: f64) -> f64 {
        let carried = self.carried.map_or(0.0, |carried| carried.frame(seconds).yaw);
        let lies = match self.centre_line.turns_items() {
            true => self.centre_line.frame(self.place_after(seconds)).yaw,
            false => own,
        };
        lies + carried
    }

    /// How something continues that is rigid with it, so far from it in its frame; `own` as in [`Self::yaw`].
    pub fn with(&self, offset: Point, own: f64) -> Self {
        let heading = if self.centre_line.turns_items() { 0.0 } else { own };
        Self { offset: Frame::new(Point::default(), heading).point(offset), ..*self }
    }

    /// Of how it goes on, with where it is; none if what it lies on is carried.
    pub fn law(&self) -> Option<Fingerprint> {
        if self.carried.is_some() {
            return None;
        }
        let [begin, end] = [self.centre_line.begin(), self.centre_line.end()];
        let places = [begin, (begin + end) / 2.0, end, self.place];
        let points = places.into_iter().map(|place| self.centre_line.point(place, self.across));
        let numbers = points.flat_map(|Point { x, y, z }| [x, y, z]);
        let Point { x, y, z } = self.offset;
        let numbers = numbers.chain([self.speed, self.stops_at, x, y, z]);
        Some(numbers.fold(Fingerprint::default(), Fingerprint::near))
    }

    /// Whether the other one is the same after so many seconds.
    pub fn becomes(&self, other: &Self, seconds: f64) -> bool {
        let is_carried_on = match (&self.carried, &other.carried) {
            (Some(then), Some(now)) => then.becomes(now, seconds),
            (then, now) => then.is_none() && now.is_none(),
        };
        let then = self.after(seconds);
        let rests = then.speed == 0.0 && other.speed == 0.0;
        is_carried_on
            && (rests || (then.speed, then.stops_at) == (other.speed, other.stops_at))
            && (then.centre_line, then.across, then.offset) == (other.centre_line, other.across, other.offset)
            && (then.place - other.place).abs() <= SAME
    }

    /// Seconds until something that stands stops it; infinity: never.
    pub fn rests_after(&self) -> f64 {
        if self.speed > 0.0 { ((self.place - self.stops_at) / self.speed).max(0.0) } else { f64::INFINITY }
    }

    /// How it goes on then.
    fn after(&self, seconds: f64) -> Self {
        let speed = if seconds < self.rests_after() { self.speed } else { 0.0 };
        let carried = self.carried.map(|carried| carried.after(seconds));
        Self { place: self.place_after(seconds), speed, carried, ..*self }
    }

    /// Begin and end of each piece in which neither the conveyor stops it nor a cylinder comes to its end, seconds
    /// from now, and how it continues at the begin.
    pub fn pieces(&self) -> Vec<(f64, f64, Self)> {
        let carried = self.carried.map_or(f64::INFINITY, |carried| carried.rests_after());
        let mut ends = [self.rests_after(), carried, f64::INFINITY];
        ends.sort_by(f64::total_cmp);
        let begins = [0.0, ends[0], ends[1]];
        let pieces = begins.into_iter().zip(ends).filter(|(begin, end)| begin < end);
        pieces.map(|(begin, end)| (begin, end, self.after(begin))).collect()
    }

    /// Whether the other one continues it after so many seconds: what is decided of it is the same, and it is where this one
    /// comes to.
    pub fn goes_on_as(&self, other: &Self, seconds: f64) -> bool {
        let is_there = (self.place_after(seconds) - other.place).abs() <= ROUNDED;
        is_there && self.is_decided_as(other)
    }

    /// When it came to where the other one is after so many seconds, if it has stood there since; in seconds from now.
    pub fn stood_after(&self, other: &Self, seconds: f64) -> Option<f64> {
        let is_on_the_same =
            (self.centre_line, self.across, self.offset) == (other.centre_line, other.across, other.offset);
        let stands = is_on_the_same && self.carried.is_none() && self.speed > 0.0;
        let stood_s = (self.place - other.place) / self.speed;
        (stands && (0.0..seconds).contains(&stood_s)).then_some(stood_s)
    }

    fn is_decided_as(&self, other: &Self) -> bool {
        let law = |conveyed: &Self| {
            let carried = conveyed.carried.map(|carried| (carried.stroke, carried.rate, carried.until));
            (conveyed.speed, conveyed.stops_at, carried)
        };
        law(self) == law(other)
    }

    /// Metres per second that no point of it goes faster than which is so far from its middle line.
    pub fn speed_within(&self, reach: f64) -> f64 {
        let carried = self.carried.map_or(0.0, |carried| {
            let place = self.centre_line.point(self.place, self.across);
            carried.stroke.path(place, reach + self.centre_line.length(), carried.rate.abs())
        });
        self.speed * self.centre_line.stretch(self.across.abs() + reach) + carried
    }

    /// How it moves along its centre line, as seen from what the conveyor is on.
    pub fn along(&self) -> Along {
        let now = self.carried.map_or(Frame::default(), |carried| carried.frame(0.0));
        let ahead = match self.centre_line {
            CentreLine::Axis { along: Axis::X, .. } => Point::new(-1.0, 0.0, 0.0),
            CentreLine::Axis { along: Axis::Y, .. } => Point::new(0.0, -1.0, 0.0),
            CentreLine::Line { from, length, rise } => from.direction(Point::new(1.0, 0.0, rise / length)),
            CentreLine::Arc { from, radius, length, rise } => {
                return Along::Arc {
                    middle: now.point(from.point(Point::new(0.0, radius, 0.0))),
                    rate: self.speed / radius,
                    climb: self.speed * rise / length,
                };
            }
        };
        Along::Straight(now.direction(ahead.scaled(self.speed)))
    }

    /// How that moves itself.
    pub fn carry(&self) -> Option<Carry> {
        let carried = self.carried.filter(|carried| carried.moves())?;
        Some(match carried.stroke {
            Stroke::Slides(far) => Carry::Slides(far.scaled(carried.rate)),
            Stroke::Turns { pivot, degrees } => {
                Carry::Turns { pivot, rate: degrees.to_radians() * carried.rate }
            }
        })
    }

    /// How much longer its own path is than the centre line, as a factor: 1 and more.
    pub fn widening(&self) -> f64 {
        match self.centre_line {
            CentreLine::Arc { radius, .. } => 1.0 + self.across.abs() / radius.abs(),
            CentreLine::Axis { .. } | CentreLine::Line { .. } => 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_law_tells_apart_what_goes_on_otherwise() {
        let surface = Point::new(1.0, 2.0, 0.9);
        let along = |along| CentreLine::Axis { along, range: [-3.0, 3.0], surface };
        let conveyed =
            Conveyed { speed: 0.2, place: 1.0, across: 0.1, stops_at: -1.0, ..Conveyed::standing(surface) };
        let conveyed = Conveyed { centre_line: along(Axis::X), ..conveyed };
        let others = [
            Conveyed { speed: 0.3, ..conveyed },
            Conveyed { place: 1.001, ..conveyed },
            Conveyed { across: 0.2, ..conveyed },
            Conveyed { stops_at: f64::NEG_INFINITY, ..conveyed },
            Conveyed { centre_line: along(Axis::Y), ..conveyed },
        ];
        assert_eq!(conveyed.law(), Conveyed { place: 1.0 + 1e-9, ..conveyed }.law());
        for other in others {
            assert_ne!(conveyed.law(), other.law(), "{other:?}");
        }
    }
}
