//! The floor of a place.

use crate::frame::Frame;
use crate::point::Point;

/// A rectangle as seen from above; all from the origin of its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Floor {
    pub middle: Point,
    /// Extent from its middle along its own axes, m.
    pub x: [f64; 2],
    pub y: [f64; 2],
    /// By how much it is turned about its middle, to the left as seen from above, degrees.
    pub yaw: f64,
}

impl Floor {
    /// Whether it is under or over this point.
    pub fn is_under(&self, point: Point) -> bool {
        let is_within = |at: f64, [low, high]: [f64; 2]| (low..=high).contains(&at);
        let seen = self.frame().seen(point);
        is_within(seen.x, self.x) && is_within(seen.y, self.y)
    }

    /// In order round it.
    pub fn corners(&self) -> [Point; 4] {
        let ([west, east], [south, north]) = (self.x, self.y);
        let corners = [[west, south], [east, south], [east, north], [west, north]];
        corners.map(|[x, y]| self.frame().point(Point::new(x, y, 0.0)))
    }

    /// With its origin in the middle between its sides, and how long they are along its axes, m.
    pub fn sides(&self) -> (Frame, [f64; 2]) {
        let middle = |[low, high]: [f64; 2]| (low + high) / 2.0;
        let between = Point::new(middle(self.x), middle(self.y), 0.0);
        let lengths = [self.x, self.y].map(|[low, high]| high - low);
        (self.frame().then(Frame::new(between, 0.0)), lengths)
    }

    fn frame(&self) -> Frame {
        Frame::new(self.middle, self.yaw)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TURNED: Floor =
        Floor { middle: Point::new(1.0, 0.0, 0.5), x: [-0.4, 0.2], y: [-0.1, 0.1], yaw: 90.0 };

    #[test]
    fn a_floor_that_is_turned_is_under_what_is_over_its_sides() {
        for ((x, y), is_over) in
            [((1.0, 0.2), true), ((1.0, -0.4), true), ((1.0, 0.3), false), ((1.2, 0.0), false), ((0.9, -0.3), true)]
        {
            assert_eq!(TURNED.is_under(Point::new(x, y, 2.0)), is_over, "{x} {y}");
        }
    }

    #[test]
    fn its_corners_are_round_the_middle_between_its_sides() {
        let corners = [(1.1, -0.4), (1.1, 0.2), (0.9, 0.2), (0.9, -0.4)].map(|(x, y)| Point::new(x, y, 0.5));
        for (found, wanted) in TURNED.corners().into_iter().zip(corners) {
            assert!((found - wanted).length() < 1e-12, "{found:?} {wanted:?}");
        }
        let (frame, lengths) = TURNED.sides();
        assert!((frame.position - Point::new(1.0, -0.1, 0.5)).length() < 1e-12, "{frame:?}");
        assert_eq!(frame.yaw, 90.0);
        assert!((lengths[0] - 0.6).abs() < 1e-12 && (lengths[1] - 0.2).abs() < 1e-12, "{lengths:?}");
    }
}
