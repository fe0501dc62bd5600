//! The room that each machine takes: boxes and capsules on its links.
//!
//! A solid contains what it stands for, so that what passes the solid passes the machine.

mod belt;
mod bin;
mod robot;
mod station;
mod ur10;
mod vehicle;

use crate::geometry::Geometry;
use crate::kinematics::pose::Pose;
use crate::line::Obstacle;
use crate::point::{Axis, Point};

/// A body of simple shape that is fixed to a link.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// Unlike every other one of the same machine: an identifier such as `upper_arm_tube`.
    pub name: &'static str,
    pub link: Link,
    /// Of the shape's middle, in the frame of the link.
    pub pose: Pose,
    pub shape: Shape,
}

/// What a solid is fixed to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Link {
    /// Does not move; the frame is the world's.
    World,
    /// Moves with the vehicle; the frame has its origin at the vehicle's position and the world's axes.
    Vehicle,
    /// Moves with the link behind joint number so and so of the robot:
    /// an index into [`crate::kinematics::arm::Arm::frames`].
    Joint(usize),
}

/// Name of the solid that takes hold of parts.
pub const GRIPPER: &str = "gripper";

/// A shape about its middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// Whole lengths along x, y and z.
    Box { size: Point },
    /// All points within `radius` of a segment of `length` on the z axis, which the origin halves:
    /// a cylinder of that length with half a ball on either end.
    Capsule { length: f64, radius: f64 },
}

/// All solids of a machine; those of a robot in the order of its links.
pub fn solids(geometry: &Geometry) -> Vec<Solid> {
    match *geometry {
        Geometry::Belt { pose, orient, orient_range } => belt::solids(pose, orient, orient_range),
        Geometry::Vehicle { .. } => vehicle::solids(),
        Geometry::RailArm { pose, rail_dim, rail_range } => robot::on_rail(pose, rail_dim, rail_range),
        Geometry::Gantry { pose, x_rail_range, y_rail_range } => {
            robot::gantry(pose, x_rail_range, y_rail_range)
        }
        Geometry::Station { pose } => station::solids(pose),
        Geometry::Bin { pose } => bin::solids(pose),
    }
}

impl Obstacle {
    /// The layout's box, standing on the obstacle's pose; none if the layout gives no box.
    pub fn solid(&self) -> Option<Solid> {
        let size = self.size?;
        let middle = self.pose.up(size.z / 2.0);
        Some(Solid { name: "body", link: Link::World, pose: at(middle), shape: Shape::Box { size } })
    }
}

fn at(position: Point) -> Pose {
    Pose { position, ..Pose::IDENTITY }
}

/// A box by two opposite corners, with the axes of its link.
fn cuboid(name: &'static str, link: Link, low: Point, high: Point) -> Solid {
    let middle = Point::new((low.x + high.x) / 2.0, (low.y + high.y) / 2.0, (low.z + high.z) / 2.0);
    Solid { name, link, pose: at(middle), shape: Shape::Box { size: high - low } }
}

/// What lies along one axis of the world and across the other.
fn laid(axis: Axis, along: f64, across: f64, z: f64) -> Point {
    match axis {
        Axis::X => Point::new(along, across, z),
        Axis::Y => Point::new(across, along, z),
    }
}

#[cfg(test)]
mod tests;
