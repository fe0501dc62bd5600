//! Where a conveyor leads.

use crate::frame::Frame;
use crate::part::settings::Settings;
use crate::point::{Axis, Point};

/// The middle line of a conveyor. Places on it are counted against the direction of travel, in metres: items go from
/// [`CentreLine::begin`] down to [`CentreLine::end`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CentreLine {
    /// Along an axis of the world, counted as this is. Items keep the heading with which they come.
    Axis { along: Axis, range: [f64; 2], surface: Point },
    /// From a frame, counted from its end. Items lie along it.
    Line { from: Frame, length: f64, rise: f64 },
    /// The same on an arc of this radius about a middle to the left, or to the right if it is less than 0.
    Arc { from: Frame, length: f64, rise: f64, radius: f64 },
}

/// Less than this is no arc, degrees.
const LEAST_TURN: f64 = 1e-6;

impl CentreLine {
    /// How much farther a point goes at most than its place along the line, as a factor, so far beside it, m.
    pub fn stretch(&self, beside: f64) -> f64 {
        let (climb, turn) = match self {
            Self::Axis { .. } => (0.0, 0.0),
            Self::Line { length, rise, .. } => (rise / length, 0.0),
            Self::Arc { length, rise, radius, .. } => (rise / length, beside / radius.abs()),
        };
        libm::hypot(1.0, climb) + turn
    }

    pub fn new(settings: &Settings) -> Result<Self, String> {
        let [axis, frame] =
            [["along", "range", "surface"].as_slice(), &["from", "length"]].map(|names| {
                let given = names.iter().filter(|name| settings.has(name)).count();
                (given > 0, given == names.len())
            });
        match (axis, frame) {
            ((true, true), (false, _)) => Ok(Self::Axis {
                along: settings.axis("along")?,
                range: settings.range("range")?,
                surface: settings.point("surface")?,
            }),
            ((false, _), (true, true)) => {
                let (from, length) = (settings.upright("from")?, settings.positive("length")?);
                let turn = settings.optional("turn", Settings::number)?.unwrap_or(0.0);
                let rise = settings.optional("rise", Settings::number)?.unwrap_or(0.0);
                if rise.abs() >= length {
                    return Err(format!(
                        "it rises by {rise:.3} m over a length of {length:.3} m along its middle line"
                    ));
                }
                if turn.abs() > 360.0 {
                    return Err("it turns by more than 360 degrees".into());
                }
                if turn.abs() < LEAST_TURN {
                    return Ok(Self::Line { from, length, rise });
                }
                Ok(Self::Arc { from, length, rise, radius: length / turn.to_radians() })
            }
            _ => Err("a lane is given by from and length, or by along, range and surface".into()),
        }
    }

    /// The same where this frame puts it that was given in the world.
    pub fn moved(self, by: Frame) -> Self {
        match self {
            Self::Axis { .. } => self,
            Self::Line { from, length, rise } => Self::Line { from: by.then(from), length, rise },
            Self::Arc { from, length, rise, radius } => {
                Self::Arc { from: by.then(from), length, rise, radius }
            }
        }
    }

    /// Place of its end.
    pub fn end(&self) -> f64 {
        match self {
            Self::Axis { range, .. } => range[0],
            Self::Line { .. } | Self::Arc { .. } => 0.0,
        }
    }

    /// Place of its beginning.
    pub fn begin(&self) -> f64 {
        match *self {
            Self::Axis { range, .. } => range[1],
            Self::Line { length, .. } | Self::Arc { length, .. } => length,
        }
    }

    /// Whether items turn with it.
    pub fn turns_items(&self) -> bool {
        !matches!(self, Self::Axis { .. })
    }

    /// A point of the surface; `across` to the left of the direction of travel, or along the other axis of the world on
    /// [`CentreLine::Axis`]. Beyond its ends it goes straight on.
    pub fn point(&self, place: f64, across: f64) -> Point {
        match *self {
            Self::Axis { along: Axis::X, surface, .. } => Point::new(place, surface.y + across, surface.z),
            Self::Axis { along: Axis::Y, surface, .. } => Point::new(surface.x + across, place, surface.z),
            Self::Line { .. } | Self::Arc { .. } => self.frame(place).point(Point::new(0.0, across, 0.0)),
        }
    }

    /// The frame of the surface at a place; its x is the direction of travel.
    pub fn frame(&self, place: f64) -> Frame {
        match *self {
            Self::Axis { along: Axis::X, .. } => Frame::new(self.point(place, 0.0), -180.0),
            Self::Axis { along: Axis::Y, .. } => Frame::new(self.point(place, 0.0), -90.0),
            Self::Line { from, length, rise } => {
                let gone = length - place;
                from.then(Frame::new(Point::new(gone, 0.0, climb(rise, gone, length)), 0.0))
            }
            Self::Arc { from, length, rise, radius } => {
                let gone = length - place;
                let on_arc = gone.clamp(0.0, length);
                let angle = on_arc / radius;
                let (sin, cos) = libm::sincos(angle);
                let at = Point::new(radius * sin, radius * (1.0 - cos), climb(rise, gone, length));
                let frame = from.then(Frame::new(at, angle.to_degrees()));
                Frame { position: frame.point(Point::new(gone - on_arc, 0.0, 0.0)), ..frame }
            }
        }
    }

    /// The place nearest to a point, and how far across this is; none beyond the ends.
    pub fn find(&self, point: Point) -> Option<(f64, f64)> {
        let (place, across) = match *self {
            Self::Axis { along: Axis::X, surface, .. } => (point.x, point.y - surface.y),
            Self::Axis { along: Axis::Y, surface, .. } => (point.y, point.x - surface.x),
            Self::Line { from, length, .. } => {
                let seen = from.seen(point);
                (length - seen.x, seen.y)
            }
            Self::Arc { from, length, radius, .. } => {
                let seen = from.seen(point);
                let (side, far) = (radius.signum(), radius.abs());
                let from_middle = (seen.x, far - side * seen.y);
                let angle = libm::atan2(from_middle.0, from_middle.1);
                let angle = if angle < 0.0 { angle + std::f64::consts::TAU } else { angle };
                (length - angle * far, side * (far - libm::hypot(from_middle.0, from_middle.1)))
            }
        };
        (self.end()..=self.begin()).contains(&place).then_some((place, across))
    }

    /// How far items go from its beginning to its end, m.
    pub fn length(&self) -> f64 {
        self.begin() - self.end()
    }
}

/// Height over the beginning.
fn climb(rise: f64, gone: f64, length: f64) -> f64 {
    rise * (gone / length).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::random::Random;

    fn near(a: Point, b: Point) -> bool {
        (a - b).length() < 1e-9
    }

    #[test]
    fn a_quarter_to_the_left_and_one_to_the_right() {
        let from = Frame::new(Point::new(1.0, 2.0, 0.8), 90.0);
        let length = std::f64::consts::FRAC_PI_2;
        for (side, end, yaw) in [(1.0, Point::new(0.0, 3.0, 0.8), -180.0), (-1.0, Point::new(2.0, 3.0, 0.8), 0.0)] {
            let arc = CentreLine::Arc { from, length, rise: 0.0, radius: side };
            assert!(near(arc.frame(length).position, from.position));
            let last = arc.frame(0.0);
            assert!(near(last.position, end), "{last:?}");
            assert!((last.yaw - yaw).abs() < 1e-9, "{last:?}");
        }
    }

    #[test]
    fn a_point_is_found_where_it_was_put() {
        let mut random = Random::new(8);
        for _ in 0..1000 {
            let mut drawn = |low, high| random.between(low, high);
            let from = Frame::new(Point::new(drawn(-3.0, 3.0), drawn(-3.0, 3.0), 0.5), drawn(-180.0, 180.0));
            let (length, rise) = (drawn(0.5, 3.0), drawn(-0.2, 0.2));
            let radius = length / drawn(0.2, 4.0) * drawn(-1.0, 1.0).signum();
            let (place, across) = (drawn(0.01, length), drawn(-0.1, 0.1));
            for centre_line in [CentreLine::Line { from, length, rise }, CentreLine::Arc { from, length, rise, radius }] {
                let found = centre_line.find(centre_line.point(place, across));
                let (at, aside) = found.unwrap_or((f64::NAN, f64::NAN));
                assert!((at - place).abs() < 1e-9 && (aside - across).abs() < 1e-9, "{centre_line:?} {found:?}");
            }
        }
    }
}
