//! What is surely within an item that stands on a place, however it is turned.

use crate::line::Kind;
use crate::point::Point;

/// Items that are in one another by no more touch, m.
const TOUCHES: f64 = 1e-4;

/// The upright cylinder inside an item.
#[derive(Clone, Copy, Debug)]
pub struct Upright {
    radius: f64,
    height: f64,
}

impl Upright {
    pub fn of(kind: &Kind) -> Self {
        Self { radius: f64::min(kind.size[0], kind.size[1]) / 2.0, height: kind.height }
    }

    /// Whether two are in one another with the middles of their undersides at these points.
    pub fn is_in(&self, point: Point, other: &Self, at: Point) -> bool {
        let apart = libm::hypot(point.x - at.x, point.y - at.y);
        let over = f64::max(point.z - at.z - other.height, at.z - point.z - self.height);
        apart < self.radius + other.radius - TOUCHES && over < -TOUCHES
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn beside_and_over_one_another_they_touch_at_most() {
        let (box_, can) = (Upright { radius: 0.05, height: 0.2 }, Upright { radius: 0.03, height: 0.1 });
        let at = Point::new(1.0, 2.0, 0.5);
        for (by, is_in) in [
            (Point::new(0.0, 0.0, 0.0), true),
            (Point::new(0.05, 0.05, 0.0), true),
            (Point::new(0.08, 0.0, 0.0), false),
            (Point::new(0.06, 0.06, 0.0), false),
            (Point::new(0.0, 0.0, 0.2), false),
            (Point::new(0.0, 0.0, 0.19), true),
            (Point::new(0.0, 0.0, -0.1), false),
            (Point::new(0.0, 0.0, -0.09), true),
        ] {
            assert_eq!(can.is_in(at + by, &box_, at), is_in, "{by:?}");
        }
    }
}
