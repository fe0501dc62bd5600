//! What every arm answers about its joints, each by formulas of its own.

use super::arm::{Frames, Joints};
use super::facing::Facing;
use super::links::Link;
use super::pose::Pose;
use crate::point::Point;

/// The kinematics of an arm with its axes, forward and inverse, in closed form. Places are in the world.
pub trait Solver {
    /// [`Self::margin`] with the tool pointing down.
    fn margin_down(&self, tool: Point) -> f64;

    /// [`Self::solve`] with the tool pointing down.
    fn solve_down(&self, tool: Point, from: &Joints) -> Option<Joints>;

    /// How far the tool may go from a place in any direction, at least, until the arm loses it, while it points there;
    /// out of reach negative, m. Minus infinity for an arm whose tool does not point there at all: without a method of
    /// its own, an arm only points down, and has a turn only if [`Self::keeps_direction`].
    fn margin(&self, tool: Point, facing: Facing) -> f64 {
        match facing {
            Facing::Down => self.margin_down(tool),
            Facing::Oriented { .. } if self.keeps_direction() => self.margin_down(tool),
            Facing::Oriented { .. } | Facing::Level { .. } => f64::NEG_INFINITY,
        }
    }

    /// Joints for a place of the tool, near `from`; some exactly when [`Self::margin`] is not negative. Where the last
    /// joint alone keeps the direction of a part, it is not turned yet.
    fn solve(&self, tool: Point, facing: Facing, from: &Joints) -> Option<Joints> {
        match facing {
            Facing::Down => self.solve_down(tool, from),
            Facing::Oriented { .. } if self.keeps_direction() => self.solve_down(tool, from),
            Facing::Oriented { .. } | Facing::Level { .. } => None,
        }
    }

    /// [`Self::solve`], however the arm bends: the joints nearest to `from`. An arm without a method of its own bends in one
    /// way only.
    fn solve_near(&self, tool: Point, facing: Facing, from: &Joints) -> Option<Joints> {
        self.solve(tool, facing, from)
    }

    fn tool_pose(&self, joints: &Joints) -> Pose;

    /// Pose of the link behind each joint, world frame, in the order of the joints; the last is the tool's.
    fn frames(&self, joints: &Joints) -> Frames;

    /// The joints, from the world on: those of [`Self::frames`].
    fn links(&self) -> Vec<Link>;

    /// Joints to start from, the tool pointing down.
    fn start(&self) -> Joints;

    /// The frame of the chain's base in that of the axis that carries it; of a Cartesian robot that of the last axis in
    /// the frame of the tool.
    fn mount(&self) -> Pose;

    /// Its first joints that stand while the tool goes straight up or down. None for an arm whose tool goes straight
    /// anyway.
    fn standing(&self) -> Option<usize>;

    /// Whether a part on the tool keeps its direction by the last joint alone, whatever the others turn.
    fn keeps_direction(&self) -> bool {
        false
    }

    /// Limits of the joints behind the axes, rad or m; none if each turns once to either side.
    fn ranges(&self) -> Option<&[[f64; 2]]> {
        None
    }

    /// How far the joints of the wrist are from their limits at a place, the nearest of them, rad; none out of reach, and
    /// if they have no limits.
    fn wrist_room(&self, _tool: Point, _facing: Facing) -> Option<f64> {
        None
    }
}
