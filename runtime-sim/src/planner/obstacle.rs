//! Obstacles about a gantry.

use crate::collision::body::{Ball, Piece, Placed};
use crate::kinematics::pose::Pose;
use crate::point::Point;
use crate::solid::{Shape, Solid};

/// A solid that is an obstacle, with the axes of the world, and its corners.
#[derive(Clone, Debug)]
pub struct Obstruction {
    pub placed: Placed,
    corners: Corners,
}

/// Obstacles that stand together, and the corners of all of them.
#[derive(Clone, Debug)]
pub struct Cluster {
    pub all: Vec<Obstruction>,
    pub corners: Corners,
}

/// What is between two opposite corners.
#[derive(Clone, Copy, Debug)]
pub struct Corners {
    pub low: Point,
    pub high: Point,
}

impl Corners {
    /// A distance that nothing within the ball is nearer to it than, m.
    fn apart(&self, ball: &Ball) -> f64 {
        let outside = |at: f64, low: f64, high: f64| (low - at).max(at - high).max(0.0);
        let Ball { middle, radius } = *ball;
        let x = outside(middle.x, self.low.x, self.high.x);
        let y = outside(middle.y, self.low.y, self.high.y);
        let z = outside(middle.z, self.low.z, self.high.z);
        (x * x + y * y + z * z).sqrt() - radius
    }
}

impl Obstruction {
    fn new(solid: &Solid) -> Self {
        let (middle, half) = (solid.pose.position, half(solid));
        let placed = Piece::new(String::new(), &solid.pose, solid.shape).within(&Pose::IDENTITY);
        Self { placed, corners: Corners { low: middle - half, high: middle + half } }
    }

    /// A distance that nothing within the ball is nearer to it than, m.
    pub fn apart(&self, ball: &Ball) -> f64 {
        self.corners.apart(ball)
    }
}

impl Cluster {
    /// None of nothing.
    pub fn new(solids: &[Solid]) -> Option<Self> {
        let all: Vec<Obstruction> = solids.iter().map(Obstruction::new).collect();
        let corners = all.iter().map(|one| one.corners);
        let by = |a: Point, b: Point, rule: fn(f64, f64) -> f64| {
            Point::new(rule(a.x, b.x), rule(a.y, b.y), rule(a.z, b.z))
        };
        let corners = corners
            .reduce(|a, b| Corners { low: by(a.low, b.low, f64::min), high: by(a.high, b.high, f64::max) })?;
        Some(Self { all, corners })
    }

    /// A distance that nothing within the ball is nearer to any of them than, m.
    pub fn apart(&self, ball: &Ball) -> f64 {
        self.corners.apart(ball)
    }
}

/// Of a solid with the axes of the world: half of its size, or of more than that.
pub fn half(solid: &Solid) -> Point {
    match solid.shape {
        Shape::Box { size } => size.scaled(0.5),
        Shape::Capsule { length, radius } => {
            let reach = length / 2.0 + radius;
            Point::new(reach, reach, reach)
        }
    }
}

pub fn top(solid: &Solid) -> f64 {
    solid.pose.position.z + half(solid).z
}
