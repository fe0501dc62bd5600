//! How an item on a conveyor goes on.

use crate::part::cylinder::Stroking;
use crate::part::lane::Course;
use crate::point::{Axis, Point};

/// The motion of an item on a conveyor from now on, until a drive, a cylinder or another item changes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conveyed {
    pub course: Course,
    /// Place of its middle on the course, now.
    pub place: f64,
    pub across: f64,
    /// m/s.
    pub speed: f64,
    /// It goes no farther; negative infinity: nothing that stands is in its way.
    pub stops_at: f64,
    /// How the conveyor itself moves; the course is where it is at the inner end.
    pub carried: Option<Stroking>,
}

impl Conveyed {
    pub fn moves(&self) -> bool {
        self.speed > 0.0 || self.carried.is_some_and(|carried| carried.moves())
    }

    fn place_after(&self, seconds: f64) -> f64 {
        (self.place - self.speed * seconds).max(self.stops_at.min(self.place))
    }

    /// Where its underside is after so many seconds.
    pub fn point(&self, seconds: f64) -> Point {
        let point = self.course.point(self.place_after(seconds), self.across);
        self.carried.map_or(point, |carried| carried.frame(seconds).point(point))
    }

    /// Degrees about the vertical; none if it keeps the heading with which it came.
    pub fn yaw(&self, seconds: f64) -> Option<f64> {
        let turns = self.course.turns_items();
        let carried = self.carried.map_or(0.0, |carried| carried.frame(seconds).yaw);
        turns.then(|| self.course.frame(self.place_after(seconds)).yaw + carried)
    }

    /// Seconds until something that stands stops it.
    pub fn rests_after(&self) -> f64 {
        ((self.place - self.stops_at) / self.speed).max(0.0)
    }

    /// Metres per second that no point of it goes faster than which is so far from its middle line.
    pub fn speed_within(&self, reach: f64) -> f64 {
        let turns = match self.course {
            Course::Arc { radius, .. } => (self.across.abs() + reach) / radius.abs(),
            Course::Axis { .. } | Course::Line { .. } => 0.0,
        };
        let climbs = match self.course {
            Course::Axis { .. } => 0.0,
            Course::Line { length, rise, .. } | Course::Arc { length, rise, .. } => rise / length,
        };
        let carried = self.carried.map_or(0.0, |carried| {
            let place = self.course.point(self.place, self.across);
            carried.stroke.path(place, reach + self.course.length(), carried.rate.abs())
        });
        self.speed * (libm::hypot(1.0, climbs) + turns) + carried
    }

    /// The middle of its arc, at the height of its beginning; of a straight course, where it is.
    pub fn middle(&self) -> Point {
        match self.course {
            Course::Arc { from, radius, .. } => from.point(Point::new(0.0, radius, 0.0)),
            Course::Axis { .. } | Course::Line { .. } => self.point(0.0),
        }
    }

    /// To the left about the middle of its arc, rad/s.
    pub fn rate(&self) -> f64 {
        match self.course {
            Course::Arc { radius, .. } => self.speed / radius,
            Course::Axis { .. } | Course::Line { .. } => 0.0,
        }
    }

    /// How much longer its own course is than the middle line, as a factor: 1 and more.
    pub fn widening(&self) -> f64 {
        match self.course {
            Course::Arc { radius, .. } => 1.0 + self.across.abs() / radius.abs(),
            Course::Axis { .. } | Course::Line { .. } => 1.0,
        }
    }

    /// On a straight course, m/s in the world.
    pub fn velocity(&self) -> Option<Point> {
        let ahead = match self.course {
            Course::Axis { along: Axis::X, .. } => Point::new(-1.0, 0.0, 0.0),
            Course::Axis { along: Axis::Y, .. } => Point::new(0.0, -1.0, 0.0),
            Course::Line { from, length, rise } => from.direction(Point::new(1.0, 0.0, rise / length)),
            Course::Arc { .. } => return None,
        };
        Some(ahead.scaled(self.speed))
    }
}
