//! Solids that keep their places to one another, and where they are.

use super::SKIN;
use super::bounds::BoundingBox;
use super::distance::{Block, Gap, block_block, segment_block, segment_segment};
use crate::kinematics::pose::Pose;
use crate::point::Point;
use crate::solid::Shape;

/// A solid, smaller by half of the skin: all points within `radius` of its core.
#[derive(Clone, Debug)]
pub struct Piece {
    pub name: String,
    core: Core,
    radius: f64,
    ball: Ball,
}

#[derive(Clone, Copy, Debug)]
enum Core {
    Segment([Point; 2]),
    Block(Block),
}

/// Contains something.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    pub middle: Point,
    pub radius: f64,
}

impl Ball {
    /// The distance of two balls, 0 if they meet.
    #[inline]
    pub fn gap(&self, other: &Ball) -> f64 {
        ((other.middle - self.middle).length() - self.radius - other.radius).max(0.0)
    }

    /// Whether two balls are no nearer than this, m.
    #[inline]
    pub fn is_apart_by(&self, other: &Ball, distance: f64) -> bool {
        let offset = other.middle - self.middle;
        let reach = self.radius + other.radius + distance;
        offset.dot(offset) >= reach * reach
    }

    #[inline]
    pub fn shifted(&self, offset: Point) -> Self {
        Self { middle: self.middle + offset, ..*self }
    }

    #[inline]
    pub fn within(&self, frame: &Pose) -> Self {
        Self { middle: frame.point(self.middle), radius: self.radius }
    }

    /// A ball around others.
    pub fn around(balls: &[Ball]) -> Self {
        let count = balls.len().max(1) as f64;
        let sum = balls.iter().fold(Point::default(), |sum, ball| sum + ball.middle);
        let middle = sum.scaled(1.0 / count);
        let reach = |ball: &Ball| (ball.middle - middle).length() + ball.radius;
        Self { middle, radius: balls.iter().map(reach).fold(0.0, f64::max) }
    }
}

impl Piece {
    /// In the frame that the pose is given in.
    pub fn new(name: String, pose: &Pose, shape: Shape) -> Self {
        let less = |length: f64| (length - SKIN / 2.0).max(0.0);
        let middle = pose.position;
        let axes = [0, 1, 2].map(|i| pose.axis(i));
        let (core, radius, reach) = match shape {
            Shape::Box { size } => {
                let half = [size.x, size.y, size.z].map(|length| less(length / 2.0));
                let reach = (half[0] * half[0] + half[1] * half[1] + half[2] * half[2]).sqrt();
                (Core::Block(Block { middle, axes, half }), 0.0, reach)
            }
            Shape::Capsule { length, radius } => {
                let offset = axes[2].scaled(length / 2.0);
                let radius = less(radius);
                (Core::Segment([middle - offset, middle + offset]), radius, length / 2.0 + radius)
            }
        };
        Self { name, core, radius, ball: Ball { middle, radius: reach } }
    }

    /// The least z of any of its points, in the frame that its pose is given in.
    pub fn lowest(&self) -> f64 {
        self.ball.middle.z - self.within(&Pose::IDENTITY).extent(Point::new(0.0, 0.0, 1.0))
    }

    #[inline]
    pub fn within(&self, frame: &Pose) -> Placed {
        let ball = self.ball.within(frame);
        let core = match self.core {
            Core::Segment([begin, end]) => Core::Segment([frame.point(begin), frame.point(end)]),
            Core::Block(Block { axes: [x, y, z], half, .. }) => Core::Block(Block {
                middle: ball.middle,
                axes: [frame.direction(x), frame.direction(y), frame.direction(z)],
                half,
            }),
        };
        Placed { core, radius: self.radius, ball }
    }

    #[inline]
    pub fn ball(&self) -> Ball {
        self.ball
    }
}

/// A piece in the world.
#[derive(Clone, Copy, Debug)]
pub struct Placed {
    core: Core,
    radius: f64,
    pub ball: Ball,
}

impl Placed {
    /// A distance that theirs is not below: that of their balls, and unless it is `enough`, also those along the
    /// directions of the faces.
    #[inline]
    pub fn apart_at_least(&self, other: &Placed, enough: f64) -> f64 {
        let balls = self.ball.gap(&other.ball);
        if balls >= enough {
            return balls;
        }
        let offset = other.ball.middle - self.ball.middle;
        let axes = [self, other].into_iter().filter_map(|placed| match &placed.core {
            Core::Block(block) => Some(block.axes),
            Core::Segment(_) => None,
        });
        let along = |axis| offset.dot(axis).abs() - self.extent(axis) - other.extent(axis);
        axes.flatten().map(along).fold(balls, f64::max)
    }

    /// Whether they are no nearer than this, m, as far as their balls and their widths along the directions of the faces
    /// show.
    #[inline]
    pub fn is_apart_by(&self, other: &Placed, distance: f64) -> bool {
        if self.ball.is_apart_by(&other.ball, distance) {
            return true;
        }
        let offset = other.ball.middle - self.ball.middle;
        let along_faces = |of: &Placed, to: &Placed| match &of.core {
            Core::Segment(_) => false,
            Core::Block(block) => (0..3).any(|i| {
                let axis = block.axes[i];
                offset.dot(axis).abs() - block.half[i] - to.extent(axis) >= distance
            }),
        };
        along_faces(self, other) || along_faces(other, self)
    }

    /// What contains it.
    pub fn bounds(&self) -> BoundingBox {
        let half = match &self.core {
            Core::Segment([a, b]) => (*b - *a).absolute().scaled(0.5),
            Core::Block(Block { axes: [x, y, z], half, .. }) => {
                x.absolute().scaled(half[0]) + y.absolute().scaled(half[1]) + z.absolute().scaled(half[2])
            }
        };
        let half = half + Point::new(self.radius, self.radius, self.radius);
        BoundingBox::between(self.ball.middle - half, self.ball.middle + half)
    }

    /// Half of its length along a direction.
    #[inline]
    fn extent(&self, direction: Point) -> f64 {
        let core = match &self.core {
            Core::Segment([a, b]) => (*b - *a).dot(direction).abs() / 2.0,
            Core::Block(Block { axes: [x, y, z], half, .. }) => {
                half[0] * x.dot(direction).abs()
                    + half[1] * y.dot(direction).abs()
                    + half[2] * z.dot(direction).abs()
            }
        };
        core + self.radius
    }

    /// Between the surfaces, 0 if they meet; with the points nearest to one another.
    pub fn gap(&self, other: &Placed) -> Gap {
        let gap = match (&self.core, &other.core) {
            (Core::Segment(a), Core::Segment(b)) => segment_segment(*a, *b),
            (Core::Segment(a), Core::Block(b)) => segment_block(*a, b),
            (Core::Block(a), Core::Segment(b)) => segment_block(*b, a).turned(),
            (Core::Block(a), Core::Block(b)) => block_block(a, b),
        };
        let [a, b] = gap.points;
        let offset = (b - a).scaled(1.0 / gap.distance.max(f64::MIN_POSITIVE));
        let distance = gap.distance - self.radius - other.radius;
        if distance < 0.0 {
            return Gap { distance: 0.0, points: [a, b] };
        }
        Gap { distance, points: [a + offset.scaled(self.radius), b - offset.scaled(other.radius)] }
    }
}
