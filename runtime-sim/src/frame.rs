//! Places with a heading.

use crate::kinematics::pose::Pose;
use crate::point::Point;

/// A frame that stands upright: where a machine stands, or an end of a conveyor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Frame {
    pub position: Point,
    /// Degrees about the vertical, to the left, from the x of the outer frame to that of this one.
    pub yaw: f64,
}

impl Frame {
    pub const fn new(position: Point, yaw: f64) -> Self {
        Self { position, yaw }
    }

    pub fn is_near(self) -> bool {
        self.position.is_near() && self.yaw.abs() <= 1e6
    }

    /// A direction given in this frame, in the outer one. A quarter turn is exact.
    pub fn direction(self, inner: Point) -> Point {
        let (sin, cos) = sine_and_cosine(self.yaw);
        Point::new(cos * inner.x - sin * inner.y, sin * inner.x + cos * inner.y, inner.z)
    }

    /// A point given in this frame, in the outer one.
    pub fn point(self, inner: Point) -> Point {
        self.position + self.direction(inner)
    }

    /// A point given in the outer frame, in this one.
    pub fn seen(self, outer: Point) -> Point {
        let back = Frame { yaw: -self.yaw, ..self };
        back.direction(outer - self.position)
    }

    /// `inner`, given in this frame, in the outer one.
    pub fn then(self, inner: Frame) -> Frame {
        Frame { position: self.point(inner.position), yaw: whole_turn(self.yaw + inner.yaw) }
    }

    /// The outer frame, given in this one.
    pub fn inverse(self) -> Frame {
        Frame { position: self.seen(Point::default()), yaw: whole_turn(-self.yaw) }
    }

    pub fn pose(self) -> Pose {
        let (sin, cos) = sine_and_cosine(self.yaw);
        Pose { rotation: [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]], position: self.position }
    }
}

/// The same heading, from -180 on and less than 180 degrees.
pub fn whole_turn(yaw: f64) -> f64 {
    yaw - 360.0 * ((yaw + 180.0) / 360.0).floor()
}

fn sine_and_cosine(degrees: f64) -> (f64, f64) {
    match whole_turn(degrees) {
        -180.0 => (0.0, -1.0),
        -90.0 => (-1.0, 0.0),
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        other => libm::sincos(other.to_radians()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::random::Random;

    #[test]
    fn a_frame_and_its_inverse_lead_back() {
        let mut random = Random::new(3);
        for _ in 0..1000 {
            let mut drawn = || random.between(-5.0, 5.0);
            let frame = Frame::new(Point::new(drawn(), drawn(), drawn()), 100.0 * drawn());
            let point = Point::new(drawn(), drawn(), drawn());
            for back in [frame.seen(frame.point(point)), frame.inverse().point(frame.point(point))] {
                assert!((back - point).length() < 1e-12, "{back:?} {point:?}");
            }
            let still = frame.inverse().then(frame);
            assert!(still.position.length() < 1e-12 && still.yaw.abs() < 1e-12, "{still:?}");
            assert!((frame.pose().point(point) - frame.point(point)).length() < 1e-12);
        }
    }

    #[test]
    fn quarter_turns_are_exact() {
        let ahead = Point::new(1.0, 0.0, 0.0);
        for (yaw, wanted) in
            [(0.0, (1.0, 0.0)), (90.0, (0.0, 1.0)), (-180.0, (-1.0, 0.0)), (270.0, (0.0, -1.0))]
        {
            let found = Frame::new(Point::default(), yaw).direction(ahead);
            assert_eq!((found.x, found.y), wanted, "{yaw}");
        }
    }
}
