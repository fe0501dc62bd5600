//! Obstacles about a gantry.

use crate::collision::BoundingBox;
use crate::collision::body::{Ball, Piece, Placed};
use crate::kinematics::pose::Pose;
use crate::point::Point;
use crate::solid::{Shape, Solid};

/// A solid that is an obstacle, with the axes of the world.
#[derive(Clone, Debug)]
pub struct Obstruction {
    pub placed: Placed,
    bounds: BoundingBox,
}

/// Obstacles that stand together.
#[derive(Clone, Debug)]
pub struct Cluster {
    pub all: Vec<Obstruction>,
    pub bounds: BoundingBox,
}

impl Obstruction {
    fn new(solid: &Solid) -> Self {
        let (middle, half) = (solid.pose.position, half(solid));
        let placed = Piece::new(String::new(), &solid.pose, solid.shape).within(&Pose::IDENTITY);
        Self { placed, bounds: BoundingBox::between(middle - half, middle + half) }
    }

    /// A distance that nothing within the ball is nearer to it than, m.
    #[inline]
    pub fn apart(&self, ball: &Ball) -> f64 {
        self.bounds.gap(ball)
    }
}

impl Cluster {
    /// None of nothing.
    pub fn new(solids: &[Solid]) -> Option<Self> {
        let all: Vec<Obstruction> = solids.iter().map(Obstruction::new).collect();
        let bounds = all.iter().map(|one| one.bounds).reduce(|a, b| a.with(&b))?;
        Some(Self { all, bounds })
    }

    /// The square of a distance that none of them is nearer to a point than, m2.
    #[inline]
    pub fn square_gap(&self, point: Point) -> f64 {
        self.bounds.square_gap(point)
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
