//! Bodies of each machine: boxes and capsules on its links.
//!
//! A solid contains what it stands for, so that what passes the solid passes the machine.

use crate::kinematics::pose::Pose;
use crate::line::Obstacle;
use crate::machine::Machine;
use crate::part::Primitive;
use crate::point::Point;

/// A body of simple shape that is fixed to a link.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// Unlike every other one of the same machine: an identifier such as `upper_arm_tube`.
    pub name: String,
    pub link: Link,
    /// Of the shape's middle, in the frame of the link.
    pub pose: Pose,
    pub shape: Shape,
    /// Items hang on it.
    pub grips: bool,
}

/// What a solid is fixed to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Link {
    /// Does not move; the frame is the world's.
    World,
    /// Moves along the route or the track; the frame has its origin at the position, and of a route the world's axes, of a
    /// track x ahead.
    Route,
    /// Moves with a cylinder or a positioner, a part of the machine; the frame is the world's at its inner end.
    Carriage(usize),
    /// Moves with the link behind joint number so and so of the arm:
    /// an index into [`crate::kinematics::arm::Arm::frames`].
    Joint(usize),
}

/// A shape about its middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// Whole lengths along x, y and z.
    Box { size: Point },
    /// All points within `radius` of a segment of `length` on the z axis, which the origin halves:
    /// a cylinder of that length with half a ball on either end.
    Capsule { length: f64, radius: f64 },
}

impl Machine {
    /// All its bodies, in the order of its parts.
    pub fn solids(&self) -> Vec<Solid> {
        let arm = self.arm();
        let axes = self.axes().len();
        let chain = self.chain().and_then(|chain| chain.on);
        let mut solids = Vec::new();
        for part in &self.parts {
            let Primitive::Body(body) = &part.primitive else { continue };
            let (link, pose) = match body.on {
                None => (Link::World, body.pose),
                Some((other, frame)) => match (&self.parts[other].primitive, &arm) {
                    (Primitive::Route(_) | Primitive::Track(_), _) => (Link::Route, body.pose),
                    (Primitive::Cylinder(_) | Primitive::Positioner(_), _) => {
                        (Link::Carriage(other), body.pose)
                    }
                    // The base is a part of what carries it.
                    (Primitive::Chain(_), Some(arm)) if frame == 0 && axes == 0 => {
                        (Link::World, arm.mount().then(&body.pose))
                    }
                    (Primitive::Chain(_), Some(arm)) if frame == 0 => {
                        (Link::Joint(axes - 1), arm.mount().then(&body.pose))
                    }
                    (Primitive::Chain(chain), _) => (
                        Link::Joint((axes + chain.link(frame).unwrap_or_default()).saturating_sub(1)),
                        body.pose,
                    ),
                    // The last axis of a Cartesian robot moves with its tool.
                    (Primitive::Axis(_), Some(arm)) if chain == Some(other) && self.has_only_axes() => {
                        (Link::Joint(axes - 1), arm.mount().then(&body.pose))
                    }
                    _ => (self.joint_of(other).map_or(Link::World, Link::Joint), body.pose),
                },
            };
            solids.push(Solid { name: part.name.clone(), link, pose, shape: body.shape, grips: body.grips });
        }
        solids
    }
}

impl Obstacle {
    /// The layout's box, standing on the obstacle's pose; none if the layout gives no box.
    pub fn solid(&self) -> Option<Solid> {
        let size = self.size?;
        let middle = self.pose.up(size.z / 2.0);
        let pose = Pose { position: middle, ..Pose::IDENTITY };
        Some(Solid { name: "body".into(), link: Link::World, pose, shape: Shape::Box { size }, grips: false })
    }
}
