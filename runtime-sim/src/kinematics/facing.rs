//! Where a tool points.

use super::pose::Pose;
use crate::point::Point;

/// In the world, or in the frame of an arm's base, which stands upright.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Facing {
    #[default]
    Down,
    /// Level: a unit vector. The y of the tool is level too.
    Level { x: f64, y: f64 },
}

/// A direction is level or vertical that is off it by less, as a part of its length.
const OFF: f64 = 1e-6;

impl Facing {
    /// None for a direction that is neither down nor level, and for none at all.
    pub fn new(direction: Point) -> Option<Self> {
        let Point { x, y, z } = direction;
        let (level, length) = (libm::hypot(x, y), direction.length());
        if !(length.is_normal() && direction.is_near()) {
            return None;
        }
        if level < OFF * length && z < 0.0 {
            return Some(Self::Down);
        }
        (z.abs() < OFF * length).then_some(Self::Level { x: x / level, y: y / level })
    }

    /// Where the tool points, a unit vector.
    pub fn direction(self) -> Point {
        match self {
            Self::Down => Point::new(0.0, 0.0, -1.0),
            Self::Level { x, y } => Point::new(x, y, 0.0),
        }
    }

    /// So many metres from a place against where the tool points: above it, if the tool points down.
    pub fn back(self, place: Point, distance: f64) -> Point {
        match self {
            Self::Down => place.up(distance),
            Self::Level { .. } => place - self.direction().scaled(distance),
        }
    }

    /// The tool at a place. Pointing down its x lies along the x of the frame (1), or against it (-1); level it points
    /// down (1), or up (-1).
    pub fn pose(self, position: Point, x: f64) -> Pose {
        let rotation = match self {
            Self::Down => [[x, 0.0, 0.0], [0.0, -x, 0.0], [0.0, 0.0, -1.0]],
            Self::Level { x: ahead, y: left } => {
                [[0.0, -x * left, ahead], [0.0, x * ahead, left], [-x, 0.0, 0.0]]
            }
        };
        Pose { rotation, position }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_down_and_level_directions_are_known() {
        let facing = |x, y, z| Facing::new(Point::new(x, y, z));
        assert_eq!(facing(0.0, 0.0, -2.0), Some(Facing::Down));
        assert_eq!(facing(0.0, -3.0, 0.0), Some(Facing::Level { x: 0.0, y: -1.0 }));
        assert_eq!(facing(3.0, 4.0, 0.0), Some(Facing::Level { x: 0.6, y: 0.8 }));
        for [x, y, z] in
            [[0.0, 0.0, 1.0], [1.0, 0.0, -1.0], [0.0; 3], [f64::NAN, 0.0, 0.0], [f64::INFINITY, 0.0, 0.0]]
        {
            assert_eq!(facing(x, y, z), None, "{x} {y} {z}");
        }
    }

    /// A right-handed frame whose z points there.
    #[test]
    fn the_tool_points_there() {
        for facing in [Facing::Down, Facing::Level { x: 0.6, y: 0.8 }, Facing::Level { x: -1.0, y: 0.0 }] {
            for x in [1.0, -1.0] {
                let pose = facing.pose(Point::default(), x);
                assert_eq!(pose.axis(2), facing.direction());
                let [a, b, c] = [0, 1, 2].map(|i| pose.axis(i));
                let cross = Point::new(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
                assert!((cross - c).length() < 1e-12, "{facing:?} {x}");
                assert!(b.z == 0.0 && (a.length() - 1.0).abs() < 1e-12 && a.dot(b) == 0.0);
            }
        }
    }
}
