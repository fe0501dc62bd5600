//! A SCARA: two arms that turn about parallel vertical axes, a quill that slides in the outer one, and a tool that turns with
//! it and points down.

use super::arm::{self, Frames};
use super::facing::Facing;
use super::fixed::{ROUNDED, turn_within};
use super::links::Link;
use super::pose::Pose;
use super::room::from_half_circle;
use super::solver::Solver;
use super::{is_finite, root, wrapped};
use crate::frame::Frame;
use crate::point::{Direction, Point};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Angles of the inner and of the outer arm (rad), height of the flange over the base (m), turn of the tool (rad).
pub type Joints = [f64; JOINTS];
pub const JOINTS: usize = 4;
/// The joint that slides.
pub const QUILL: usize = 2;
/// The joint that turns the tool.
const TURN: usize = 3;
/// It moves nothing: an angle that it lacks counts at this distance, m.
const ABOUT_ITSELF: f64 = 0.1;

/// What the maker gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arms {
    /// From axis to axis: inner and outer arm, over 0, m.
    pub lengths: [f64; 2],
    /// From the flange down to the tool centre point, m.
    pub tool: f64,
    /// Limits of the joints; that of the tool is half a turn at least.
    pub ranges: [[f64; 2]; JOINTS],
}

/// Its base upright at a frame, on the axis of the inner arm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scara {
    base: Frame,
    arms: Arms,
}

/// Joints for a place of the tool.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    joints: Joints,
    /// 1 if the outer arm is turned to the left against the inner one, -1 to the right.
    hand: f64,
    /// By how much limits of the arms forbid it: the angle beyond, times the distance of the tool from the axis, m.
    beyond: f64,
}

impl Scara {
    pub fn new(base: Frame, arms: Arms) -> Self {
        Self { base, arms }
    }

    /// The axis of the tool in the frame of the base, and the height of the flange.
    fn seen(&self, tool: Point) -> ([f64; 2], f64) {
        let Point { x, y, z } = self.base.seen(tool);
        ([x, y], z + self.arms.tool)
    }

    /// How far the tool's axis is within the ring that both arms reach, without their limits, m.
    fn slack(&self, place: [f64; 2]) -> f64 {
        let [inner, outer] = self.arms.lengths;
        let distance = libm::hypot(place[0], place[1]);
        (inner + outer - distance).min(distance - (inner - outer).abs())
    }

    /// Where the x of the tool may lie, from that of the base to the left, rad; none if the tool does not point there.
    fn directions(&self, facing: Facing) -> Vec<f64> {
        match facing {
            // Along that of the base, one way or the other.
            Facing::Down => vec![0.0, PI],
            Facing::Oriented { x, y } => vec![libm::atan2(y, x) - self.base.yaw.to_radians()],
            Facing::Level { .. } => Vec::new(),
        }
    }

    /// Both ways to reach a place within this ring, near `from`, with the x of the tool in one of these directions.
    fn candidates(&self, place: [f64; 2], height: f64, directions: &[f64], from: &Joints) -> [Candidate; 2] {
        let [inner, outer] = self.arms.lengths;
        let [x, y] = place;
        let square = x * x + y * y;
        let cos = ((square - inner * inner - outer * outer) / (2.0 * inner * outer)).clamp(-1.0, 1.0);
        let sin = root((1.0 - cos) * (1.0 + cos));
        [1.0, -1.0].map(|hand| {
            let second = libm::atan2(hand * sin, cos);
            let first = libm::atan2(y, x) - libm::atan2(outer * hand * sin, inner + outer * cos);
            let near = |joint: usize, angle: f64| {
                let [low, high] = self.arms.ranges[joint];
                let turn = turn_within(wrapped(angle), [low, high], from[joint]);
                let lacks = (low - turn).max(turn - high);
                if lacks > ROUNDED { (turn, lacks) } else { (turn.clamp(low, high), 0.0) }
            };
            let ((first, lacks_first), (second, lacks_second)) = (near(0, first), near(1, second));
            let turns = directions.iter().map(|direction| near(TURN, direction - first - second));
            let nearer = |best: (f64, f64), next: (f64, f64)| {
                let is_nearer = (next.0 - from[TURN]).abs() < (best.0 - from[TURN]).abs() - 1e-9;
                if next.1 < best.1 || (next.1 == best.1 && is_nearer) { next } else { best }
            };
            let (turn, lacks_turn) = turns.reduce(nearer).unwrap_or_default();
            let arms = (lacks_first * root(square)).max(lacks_second * outer);
            let beyond = arms.max(lacks_turn * ABOUT_ITSELF);
            Candidate { joints: [first, second, height, turn], hand, beyond }
        })
    }

    /// How far the tool may go from a place in any direction, at least, until the arm loses it; out of reach the distance
    /// to what it reaches, negative, m. Where only limits of the arms forbid the place: less than 0 by the angle that is
    /// lacking times the distance of the tool from this axis.
    pub fn margin(&self, tool: Point, facing: Facing) -> f64 {
        let directions = self.directions(facing);
        if !is_finite(tool) || directions.is_empty() {
            return f64::NEG_INFINITY;
        }
        let (place, height) = self.seen(tool);
        let [low, high] = self.arms.ranges[QUILL];
        let (ring, stroke) = (self.slack(place), (height - low).min(high - height));
        let stroke = if stroke.abs() < ROUNDED { stroke.max(0.0) } else { stroke };
        if ring < 0.0 || stroke < 0.0 {
            return -libm::hypot(ring.min(0.0), stroke.min(0.0));
        }
        let found = self.candidates(place, height, &directions, &self.joints_at_start());
        let least = found.iter().map(|found| found.beyond).fold(f64::INFINITY, f64::min);
        if least > 0.0 {
            return -least;
        }
        let [low, high] = self.arms.ranges[TURN];
        if directions.len() == 1 && high - low < TAU {
            // Where the turn of the tool comes to its limit is not worked out.
            return 0.0;
        }
        let rooms =
            found.iter().filter(|found| found.beyond == 0.0).map(|found| self.room(place, found.hand));
        rooms.fold(0.0, f64::max).min(ring).min(stroke)
    }

    /// Until one of the two arms comes to its limit, while the outer one stays on its side, m.
    fn room(&self, place: [f64; 2], hand: f64) -> f64 {
        let [inner, outer] = self.arms.lengths;
        let [first, second] = [0, 1].map(|joint| {
            let [low, high] = self.arms.ranges[joint];
            (high - low < TAU).then_some([low, high]).into_iter().flatten()
        });
        // With the inner arm at its limit the tool is on a half circle about its end.
        let turned = first.map(|limit| {
            let (sin, cos) = libm::sincos(limit);
            from_half_circle(place, [inner * cos, inner * sin], outer, limit, hand)
        });
        // With the outer one at its limit it is on a circle about the base.
        let bent = second.map(|limit| wrapped(limit) * hand).filter(|limit| (0.0..PI).contains(limit));
        let bent = bent.map(|limit| {
            let square = inner * inner + outer * outer + 2.0 * inner * outer * libm::cos(limit);
            (libm::hypot(place[0], place[1]) - root(square)).abs()
        });
        turned.chain(bent).fold(f64::INFINITY, f64::min)
    }

    /// Joints that bring the tool to a place; some exactly when [`Self::margin`] is not negative. The outer arm stays on its
    /// side where this is possible; else the joint that goes farthest goes least.
    pub fn solve(&self, tool: Point, facing: Facing, from: &Joints) -> Option<Joints> {
        if self.margin(tool, facing) < 0.0 {
            return None;
        }
        let (place, height) = self.seen(tool);
        let [low, high] = self.arms.ranges[QUILL];
        let hand = if from[1] < 0.0 { -1.0 } else { 1.0 };
        let directions = self.directions(facing);
        let found = self.candidates(place, height.clamp(low, high), &directions, from).into_iter();
        let cost = |found: &Candidate| {
            let farthest = found.joints.iter().zip(from).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            if found.hand == hand { farthest } else { farthest + 4.0 * PI }
        };
        let best = found.filter(|found| found.beyond == 0.0);
        best.reduce(|best, next| if cost(&next) < cost(&best) { next } else { best })
            .map(|found| found.joints)
    }

    /// The tool in the frame of the flange.
    fn tool(&self) -> Pose {
        Facing::Down.pose(Point::new(0.0, 0.0, -self.arms.tool), 1.0)
    }

    /// Of each link behind a joint, world frame: inner arm, outer arm, quill, tool.
    pub fn frames(&self, joints: &Joints) -> [Pose; JOINTS] {
        let mut frame = Pose::IDENTITY;
        let links = self.links();
        std::array::from_fn(|i| {
            frame = frame.then(&links[i].frame(joints[i]));
            frame
        })
    }

    /// The joints, from the world on.
    pub fn links(&self) -> [Link; JOINTS] {
        let ahead = |length: f64| Pose { position: Point::new(length, 0.0, 0.0), ..Pose::IDENTITY };
        let [inner, outer] = self.arms.lengths;
        [
            Link::turns(self.base.pose(), Pose::IDENTITY),
            Link::turns(ahead(inner), Pose::IDENTITY),
            Link::slides(ahead(outer), Direction::Z, Pose::IDENTITY),
            Link::turns(Pose::IDENTITY, self.tool()),
        ]
    }

    /// The inner arm ahead, the outer one a quarter turn to the left, the quill up, as far as the limits allow.
    fn joints_at_start(&self) -> Joints {
        let within = |joint: usize, value: f64| {
            let [low, high] = self.arms.ranges[joint];
            value.clamp(low, high)
        };
        let (first, second) = (within(0, 0.0), within(1, FRAC_PI_2));
        [first, second, self.arms.ranges[QUILL][1], within(3, -first - second)]
    }
}

impl Solver for Scara {
    fn margin_down(&self, tool: Point) -> f64 {
        Scara::margin(self, tool, Facing::Down)
    }

    fn solve_down(&self, tool: Point, from: &arm::Joints) -> Option<arm::Joints> {
        Solver::solve(self, tool, Facing::Down, from)
    }

    fn margin(&self, tool: Point, facing: Facing) -> f64 {
        Scara::margin(self, tool, facing)
    }

    fn solve(&self, tool: Point, facing: Facing, from: &arm::Joints) -> Option<arm::Joints> {
        Scara::solve(self, tool, facing, &from.array()).map(|joints| arm::Joints::new(&joints))
    }

    fn tool_pose(&self, joints: &arm::Joints) -> Pose {
        Scara::frames(self, &joints.array())[JOINTS - 1]
    }

    fn frames(&self, joints: &arm::Joints) -> Frames {
        Frames::of(Scara::frames(self, &joints.array()).into_iter())
    }

    fn links(&self) -> Vec<Link> {
        Scara::links(self).into()
    }

    fn start(&self) -> arm::Joints {
        arm::Joints::new(&self.joints_at_start())
    }

    fn mount(&self) -> Pose {
        self.base.pose()
    }

    fn standing(&self) -> Option<usize> {
        None
    }

    fn ranges(&self) -> Option<&[[f64; 2]]> {
        Some(&self.arms.ranges)
    }
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;

    /// As an Epson LS6 of 0.6 m: both arms, their limits and the stroke of the quill.
    fn arms(tool: f64) -> Arms {
        let turn = |degrees: f64| [-degrees.to_radians(), degrees.to_radians()];
        Arms { lengths: [0.325, 0.275], tool, ranges: [turn(132.0), turn(150.0), [-0.2, 0.0], turn(360.0)] }
    }

    /// Where the tool is, by the sums of two arms.
    fn forward(base: Frame, arms: &Arms, [first, second, height, _]: Joints) -> Point {
        let [inner, outer] = arms.lengths;
        let x = inner * first.cos() + outer * (first + second).cos();
        let y = inner * first.sin() + outer * (first + second).sin();
        base.point(Point::new(x, y, height - arms.tool))
    }

    /// The long form has a million: `AUTOGEN_CAMPAIGN=full cargo test --release -p runtime-sim --lib scara`.
    fn number() -> u32 {
        if std::env::var("AUTOGEN_CAMPAIGN").is_ok_and(|campaign| campaign == "full") {
            1_000_000
        } else {
            20_000
        }
    }

    #[test]
    fn the_inverse_is_that_of_the_forward_kinematics() {
        let mut random = Random::new(41);
        for _ in 0..number() {
            let base = Frame::new(Point::new(0.4, -0.3, 0.7), random.between(-180.0, 180.0));
            let arms = Arms { lengths: [random.between(0.1, 0.6), random.between(0.1, 0.6)], ..arms(0.12) };
            let scara = Scara::new(base, arms);
            let drawn: Joints = arms.ranges.map(|[low, high]| random.between(low, high));
            let tool = forward(base, &arms, drawn);
            assert!((Scara::frames(&scara, &drawn)[3].position - tool).length() < 1e-12);
            let joints =
                scara.solve(tool, Facing::Down, &drawn).unwrap_or_else(|| panic!("{arms:?} {drawn:?}"));
            assert!((forward(base, &arms, joints) - tool).length() < 1e-9, "{drawn:?} {joints:?}");
            // On the side from which it comes, these are the joints themselves; near a stretched arm angles are not sharp.
            if drawn[1].abs() > 0.01 {
                assert!((0..3).all(|i| (joints[i] - drawn[i]).abs() < 1e-6), "{drawn:?} {joints:?}");
            }
            let pose = Scara::frames(&scara, &joints)[3];
            assert!((pose.axis(2).z + 1.0).abs() < 1e-12);
            let along = base.direction(Point::new(1.0, 0.0, 0.0));
            assert!((pose.axis(0).dot(along).abs() - 1.0).abs() < 1e-9, "{joints:?}");
            assert!(joints.iter().zip(arms.ranges).all(|(joint, [low, high])| (low..=high).contains(joint)));
        }
    }

    /// Reached is what some joints within their ranges reach: drawn from a fine grid of them, by forward kinematics alone.
    #[test]
    fn both_hands_are_found_where_both_are_within_the_limits() {
        let arms = arms(0.0);
        let scara = Scara::new(Frame::default(), arms);
        let mut from = scara.joints_at_start();
        for (hand, x, y) in [(1.0, 0.4, 0.1), (-1.0, 0.4, 0.1), (1.0, 0.3, -0.3), (-1.0, 0.3, 0.3)] {
            from[1] = hand;
            let joints = scara.solve(Point::new(x, y, -0.1), Facing::Down, &from).unwrap();
            assert!(joints[1] * hand > 0.0, "{joints:?}");
        }
        // Behind the base only one of them reaches: the other one would turn the inner arm too far.
        let [x, y] = [-0.3, 0.3];
        for hand in [1.0, -1.0] {
            from[1] = hand;
            assert!(scara.solve(Point::new(x, y, -0.1), Facing::Down, &from).unwrap()[1] > 0.0);
        }
    }

    #[test]
    fn margins_have_the_sign_of_the_solver_and_are_kept_in_every_direction() {
        let mut random = Random::new(43);
        let (mut reached, mut limited) = (0, 0);
        for _ in 0..number() {
            let base = Frame::new(Point::new(0.4, -0.3, 0.7), random.between(-180.0, 180.0));
            let mut arms =
                Arms { lengths: [random.between(0.2, 0.4), random.between(0.2, 0.4)], ..arms(0.1) };
            for joint in 0..2 {
                arms.ranges[joint] = [random.between(-3.5, -0.1), random.between(0.1, 3.5)];
            }
            let scara = Scara::new(base, arms);
            let seen =
                Point::new(random.between(-0.8, 0.8), random.between(-0.8, 0.8), random.between(-0.4, 0.0));
            let tool = base.point(seen);
            let margin = scara.margin(tool, Facing::Down);
            let found = scara.solve(tool, Facing::Down, &scara.joints_at_start());
            assert_eq!(found.is_some(), margin >= 0.0, "{arms:?} {tool:?}");
            let is_in_ring = scara.slack([seen.x, seen.y]) > 0.0 && (-0.3..-0.1).contains(&seen.z);
            let Some(joints) = found else {
                limited += u32::from(is_in_ring);
                continue;
            };
            reached += 1;
            assert!((forward(base, &arms, joints) - tool).length() < 1e-9);
            let way =
                Point::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0));
            // Half of them level, in which direction there is least room mostly.
            let way = if reached % 2 == 0 { Point { z: 0.0, ..way } } else { way };
            let moved = tool + way.scaled(0.999 * margin / way.length());
            assert!(
                scara.solve(moved, Facing::Down, &joints).is_some(),
                "{arms:?} {tool:?} {margin} {moved:?}"
            );
        }
        assert!(reached > number() / 10 && limited > number() / 50, "{reached} {limited}");
    }

    /// A margin that were always 0 would keep its promise too.
    #[test]
    fn margins_are_the_distance_to_what_ends_the_reach() {
        let scara = Scara::new(Frame::default(), arms(0.0));
        let at = |x: f64, y: f64, z: f64| scara.margin(Point::new(x, y, z), Facing::Down);
        let near = |margin: f64, wanted: f64| assert!((margin - wanted).abs() < 1e-9, "{margin} {wanted}");
        near(at(0.55, 0.0, -0.1), 0.05);
        near(at(0.45, 0.0, -0.02), 0.02);
        near(at(0.61, 0.0, -0.1), -0.01);
        near(at(0.63, 0.0, 0.04), -0.05);
        // The outer arm at 150 degrees.
        let folded =
            (0.325_f64.powi(2) + 0.275_f64.powi(2) + 2.0 * 0.325 * 0.275 * 150.0_f64.to_radians().cos())
                .sqrt();
        near(at(folded + 0.03, 0.0, -0.1), 0.03);
        assert!(at(folded - 0.003, 0.0, -0.1) < 0.0);
    }
}
