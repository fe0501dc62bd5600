//! An arm of six joints on a rail: its base stands beside the tool, as far as the rail goes.

use super::arm::{self, Frames};
use super::facing::Facing;
use super::fixed::{self, FixedArm};
use super::is_finite;
use super::links::Link;
use super::pose::Pose;
use super::solver::Solver;
use super::ur::Angles;
use crate::frame::Frame;
use crate::point::{Axis, Point};

/// Place on the rail (m, from the beginning of its frame), then the angles of the arm (rad).
pub type Joints = [f64; JOINTS];
pub const JOINTS: usize = 1 + fixed::JOINTS;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RidingArm {
    /// The carriage at 0.
    rail: Frame,
    along: Axis,
    /// From 0, along that axis of the rail's frame.
    range: [f64; 2],
    /// The base on the carriage.
    mount: Frame,
    /// With the carriage at 0.
    arm: FixedArm,
}

impl RidingArm {
    /// `arm` gives an arm whose base is at a frame.
    pub fn new(
        rail: Frame,
        along: Axis,
        range: [f64; 2],
        mount: Frame,
        arm: impl Fn(Frame) -> FixedArm,
    ) -> Self {
        Self { rail, along, range, mount, arm: arm(rail.then(mount)) }
    }

    /// How far the carriage is from 0, in the world.
    fn moved(&self, place: f64) -> Point {
        self.rail.direction(Point::default().with_coordinate(self.along, place))
    }

    /// Where the carriage is for a place of the tool.
    fn beside(&self, tool: Point) -> f64 {
        let [low, high] = self.range;
        let seen = self.rail.seen(tool) - self.mount.position;
        seen.coordinate(self.along).clamp(low, high)
    }

    /// A place of the tool, with the carriage where it then is, as if the carriage were at 0.
    fn seen(&self, tool: Point) -> (f64, Point) {
        let place = self.beside(tool);
        (place, tool - self.moved(place))
    }

    /// That of the arm with the carriage where it is for this place: as the tool goes, the carriage goes along with it, and
    /// the tool goes no farther from the base than in the world.
    pub fn margin(&self, tool: Point, facing: Facing) -> f64 {
        if !is_finite(tool) {
            return f64::NEG_INFINITY;
        }
        self.arm.margin(self.seen(tool).1, facing)
    }

    /// See [`FixedArm::wrist_room`].
    pub fn wrist_room(&self, tool: Point, facing: Facing) -> Option<f64> {
        is_finite(tool).then(|| self.arm.wrist_room(self.seen(tool).1, facing)).flatten()
    }

    /// Joints that bring the tool, pointing there, to a place, near `from`; some exactly when [`Self::margin`] is not
    /// negative.
    pub fn solve(&self, tool: Point, facing: Facing, from: &Joints) -> Option<Joints> {
        self.solve_as(tool, from, |seen, angles| self.arm.solve(seen, facing, angles))
    }

    /// [`Self::solve`], however the arm bends.
    pub fn solve_near(&self, tool: Point, facing: Facing, from: &Joints) -> Option<Joints> {
        self.solve_as(tool, from, |seen, angles| self.arm.solve_near(seen, facing, angles))
    }

    fn solve_as(
        &self,
        tool: Point,
        from: &Joints,
        solve: impl Fn(Point, &Angles) -> Option<Angles>,
    ) -> Option<Joints> {
        if !is_finite(tool) {
            return None;
        }
        let [_, angles @ ..] = *from;
        let (place, seen) = self.seen(tool);
        Some(self.joints(place, solve(seen, &angles)?))
    }

    fn joints(&self, place: f64, angles: Angles) -> Joints {
        std::array::from_fn(|i| if i == 0 { place } else { angles[i - 1] })
    }

    fn carried(&self, joints: &Joints, pose: Pose) -> Pose {
        Pose { position: pose.position + self.moved(joints[0]), ..pose }
    }

    pub fn tool_pose(&self, joints: &Joints) -> Pose {
        let [_, angles @ ..] = *joints;
        self.carried(joints, self.arm.tool_pose(&angles))
    }

    /// Of each link behind a joint, world frame: the carriage, then those of the arm.
    pub fn frames(&self, joints: &Joints) -> [Pose; JOINTS] {
        let [_, angles @ ..] = *joints;
        let arm = self.arm.frames(&angles);
        std::array::from_fn(|i| self.carried(joints, if i == 0 { self.rail.pose() } else { arm[i - 1] }))
    }

    /// The joints, from the world on.
    pub fn links(&self) -> Vec<Link> {
        let carriage = Link::slides(self.rail.pose(), self.along, Pose::IDENTITY);
        [carriage].into_iter().chain(self.arm.links_on(self.mount)).collect()
    }

    /// The frame of the maker's base in that of the carriage.
    pub fn mount(&self) -> Pose {
        self.rail.pose().inverse().then(&self.arm.base())
    }

    /// Limits of the joints that turn, rad; none if each turns once to either side.
    pub fn ranges(&self) -> Option<&[[f64; 2]; fixed::JOINTS]> {
        self.arm.ranges()
    }

    /// The middle of the rail.
    pub fn start(&self) -> Joints {
        let [low, high] = self.range;
        self.joints((low + high) / 2.0, self.arm.start())
    }

    /// Both ends of the base, in the world.
    pub fn ground(&self) -> [Point; 2] {
        self.range.map(|place| self.arm.base().position + self.moved(place))
    }
}

impl Solver for RidingArm {
    fn margin_down(&self, tool: Point) -> f64 {
        RidingArm::margin(self, tool, Facing::Down)
    }

    fn solve_down(&self, tool: Point, from: &arm::Joints) -> Option<arm::Joints> {
        Solver::solve(self, tool, Facing::Down, from)
    }

    fn margin(&self, tool: Point, facing: Facing) -> f64 {
        RidingArm::margin(self, tool, facing)
    }

    fn solve(&self, tool: Point, facing: Facing, from: &arm::Joints) -> Option<arm::Joints> {
        RidingArm::solve(self, tool, facing, &from.array()).map(|joints| arm::Joints::new(&joints))
    }

    fn solve_near(&self, tool: Point, facing: Facing, from: &arm::Joints) -> Option<arm::Joints> {
        RidingArm::solve_near(self, tool, facing, &from.array()).map(|joints| arm::Joints::new(&joints))
    }

    fn tool_pose(&self, joints: &arm::Joints) -> Pose {
        RidingArm::tool_pose(self, &joints.array())
    }

    fn frames(&self, joints: &arm::Joints) -> Frames {
        Frames::of(RidingArm::frames(self, &joints.array()).into_iter())
    }

    fn links(&self) -> Vec<Link> {
        RidingArm::links(self)
    }

    fn start(&self) -> arm::Joints {
        arm::Joints::new(&RidingArm::start(self))
    }

    fn mount(&self) -> Pose {
        RidingArm::mount(self)
    }

    fn standing(&self) -> Option<usize> {
        Some(1)
    }

    fn ranges(&self) -> Option<&[[f64; 2]]> {
        RidingArm::ranges(self).map(|ranges| &ranges[..])
    }

    fn wrist_room(&self, tool: Point, facing: Facing) -> Option<f64> {
        RidingArm::wrist_room(self, tool, facing)
    }
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::super::ur::Lengths;
    use super::*;

    const UR10E: Lengths =
        Lengths { d1: 0.1807, a2: -0.6127, a3: -0.57155, d4: 0.17415, d5: 0.11985, tool: 0.11655 + 0.15 };

    fn arm() -> RidingArm {
        let rail = Frame::new(Point::new(2.0, -1.0, 0.4), 30.0);
        let mount = Frame::new(Point::new(0.1, -0.2, 0.3), 90.0);
        let geometry = fixed::Geometry::UniversalRobots(UR10E);
        RidingArm::new(rail, Axis::Y, [-0.5, 2.5], mount, |base| FixedArm::new(base, geometry, None))
    }

    #[test]
    fn what_is_in_reach_is_reached_and_frames_are_those_of_the_links() {
        let (arm, mut random) = (arm(), Random::new(31));
        let (mut reached, mut from) = (0, arm.start());
        for i in 0..20_000 {
            let mut drawn = || random.between(-3.5, 3.5);
            let tool = Point::new(2.0 + drawn(), drawn(), 0.7 + drawn() / 3.0);
            let facing = if i % 2 == 0 { Facing::Down } else { Facing::Level { x: 0.0, y: 1.0 } };
            let found = arm.solve(tool, facing, &from);
            assert_eq!(found.is_some(), arm.margin(tool, facing) >= 0.0, "{tool:?}");
            let Some(joints) = found else { continue };
            let pose = arm.tool_pose(&joints);
            assert!((pose.position - tool).length() < 1e-6, "{tool:?} {joints:?}");
            assert!(pose.axis(2).dot(facing.direction()) > 1.0 - 1e-9, "{joints:?}");
            assert!((-0.5..=2.5).contains(&joints[0]), "{joints:?}");
            let mut frame = Pose::IDENTITY;
            for ((link, value), known) in arm.links().iter().zip(joints).zip(arm.frames(&joints)) {
                frame = frame.then(&link.frame(value));
                assert!((frame.position - known.position).length() < 1e-9, "{frame:?} {known:?}");
                assert!((0..3).all(|axis| (frame.axis(axis) - known.axis(axis)).length() < 1e-9));
            }
            assert!((frame.position - tool).length() < 1e-6);
            (reached, from) = (reached + 1, joints);
        }
        assert!(reached > 3_000, "{reached}");
    }

    #[test]
    fn the_base_stands_beside_the_tool_as_far_as_the_rail_goes() {
        let arm = arm();
        // The rail's y, 30 degrees from that of the world; its mount is 0.2 m behind the carriage.
        let (sin, cos) = (0.5, 3.0_f64.sqrt() / 2.0);
        for (along, place) in [(0.8, 1.0), (-0.2, 0.0), (-9.0, -0.5), (9.0, 2.5)] {
            let tool = Point::new(2.0 - sin * along + cos * 0.7, -1.0 + cos * along + sin * 0.7, 0.9);
            assert!((arm.beside(tool) - place).abs() < 1e-9, "{along}");
        }
    }
}
