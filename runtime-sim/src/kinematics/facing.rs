//! Where a tool points.

use super::pose::Pose;
use crate::point::Point;

/// In the world, or in the frame of an arm's base, which stands upright.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Facing {
    /// The last joint turns the tool so that its x lies along that of the arm's base, or against it.
    #[default]
    Down,
    /// Down, its x along this level unit vector.
    Oriented { x: f64, y: f64 },
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

    /// Down with the x of the tool at this turn, seen from above, to the left from the x of the frame, rad. None if it is
    /// no number.
    pub fn oriented(turn: f64) -> Option<Self> {
        let (y, x) = libm::sincos(turn);
        turn.is_finite().then_some(Self::Oriented { x, y })
    }

    pub fn is_oriented(self) -> bool {
        matches!(self, Self::Oriented { .. })
    }

    /// What `x` of [`Self::pose`] may be.
    pub(super) fn signs(self) -> &'static [f64] {
        match self {
            Self::Oriented { .. } => &[1.0],
            Self::Down | Self::Level { .. } => &[1.0, -1.0],
        }
    }

    /// Whether a tool points there, off it by less than this.
    pub(super) fn is_of(self, tool: &Pose, off: f64) -> bool {
        let points = (tool.axis(2) - self.direction()).length() < off;
        match self {
            Self::Oriented { x, y } => points && (tool.axis(0) - Point::new(x, y, 0.0)).length() < off,
            Self::Down | Self::Level { .. } => points,
        }
    }

    /// Where the tool points, a unit vector.
    pub fn direction(self) -> Point {
        match self {
            Self::Down | Self::Oriented { .. } => Point::new(0.0, 0.0, -1.0),
            Self::Level { x, y } => Point::new(x, y, 0.0),
        }
    }

    /// So many metres from a place against where the tool points: above it, if the tool points down.
    pub fn back(self, place: Point, distance: f64) -> Point {
        match self {
            Self::Down | Self::Oriented { .. } => place.up(distance),
            Self::Level { .. } => place - self.direction().scaled(distance),
        }
    }

    /// The tool at a place. Pointing down its x lies along the x of the frame (1), or against it (-1), or the same with its
    /// own direction; level it points down (1), or up (-1).
    pub fn pose(self, position: Point, x: f64) -> Pose {
        let rotation = match self {
            Self::Down => [[x, 0.0, 0.0], [0.0, -x, 0.0], [0.0, 0.0, -1.0]],
            Self::Oriented { x: along, y: left } => {
                [[x * along, x * left, 0.0], [x * left, -x * along, 0.0], [0.0, 0.0, -1.0]]
            }
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
        let level = [Facing::Level { x: 0.6, y: 0.8 }, Facing::Level { x: -1.0, y: 0.0 }];
        let down = [Facing::Down, Facing::Oriented { x: 0.6, y: 0.8 }, Facing::Oriented { x: -1.0, y: 0.0 }];
        for facing in level.into_iter().chain(down) {
            for &x in facing.signs() {
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
