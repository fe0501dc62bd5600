//! An arm of the Universal Robots kind that stands where it is, its tool pointing down.

use super::links::Link;
use super::pose::Pose;
use super::ur::{Angles, Lengths};
use super::{is_finite, nearest_turn, root};
use crate::frame::Frame;
use crate::point::Point;
use std::f64::consts::{FRAC_PI_2, PI};

pub const JOINTS: usize = 6;

/// How the maker draws it: upper arm up, forearm level, tool down.
const USUAL: Angles = [0.0, -FRAC_PI_2, FRAC_PI_2, -FRAC_PI_2, -FRAC_PI_2, 0.0];

/// The frame of the base is the maker's: z along the first joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FixedArm {
    base: Frame,
    lengths: Lengths,
}

impl FixedArm {
    pub fn new(base: Frame, lengths: Lengths) -> Self {
        Self { base, lengths }
    }

    pub fn base(&self) -> Pose {
        self.base.pose()
    }

    /// Distance of the wrist to the limit of reach, the tool pointing down; negative out of reach, m.
    pub fn margin(&self, tool: Point) -> f64 {
        if !is_finite(tool) {
            return f64::NEG_INFINITY;
        }
        let Lengths { d1, a2, a3, d4, d5, tool: length } = self.lengths;
        let seen = self.base.seen(tool);
        let from_axis = libm::hypot(seen.x, seen.y);
        if from_axis < d4.abs() {
            return from_axis - d4.abs();
        }
        let ahead = root((from_axis - d4) * (from_axis + d4));
        let height = seen.z + length - d1;
        let (longest, shortest) = (a2.abs() + a3.abs(), (a2.abs() - a3.abs()).abs());
        let slack = |out: f64| {
            let wrist = libm::hypot(out, height);
            (longest - wrist).min(wrist - shortest)
        };
        slack(ahead - d5).max(slack(ahead + d5))
    }

    /// Joints that bring the tool, pointing down, to a place; some exactly when [`Self::margin`] is not negative. Its x lies
    /// along the base's x, one way or the other. Of all ways with the elbow up, else of all, the one on which the joint
    /// that goes farthest goes least.
    pub fn solve(&self, tool: Point, from: &Angles) -> Option<Angles> {
        if self.margin(tool) < 0.0 {
            return None;
        }
        let seen = self.base.seen(tool);
        let down =
            |x: f64| Pose { rotation: [[x, 0.0, 0.0], [0.0, -x, 0.0], [0.0, 0.0, -1.0]], position: seen };
        let solutions = [1.0, -1.0].into_iter().flat_map(|x| self.lengths.inverse(&down(x)));
        let near = solutions.map(|angles| -> Angles {
            std::array::from_fn(|joint| nearest_turn(angles[joint], from[joint]))
        });
        let cost = |angles: &Angles| {
            let farthest = angles.iter().zip(from).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            if angles[2] < 0.0 { farthest + 4.0 * PI } else { farthest }
        };
        // Of equals the first.
        near.reduce(|best, next| if cost(&next) < cost(&best) - 1e-9 { next } else { best })
    }

    pub fn tool_pose(&self, joints: &Angles) -> Pose {
        self.base().then(&self.lengths.forward(joints))
    }

    pub fn frames(&self, joints: &Angles) -> [Pose; JOINTS] {
        let base = self.base();
        self.lengths.frames(joints).map(|frame| base.then(&frame))
    }

    /// The joints, from the world on.
    pub fn links(&self) -> Vec<Link> {
        self.lengths.links(self.base()).into()
    }

    pub fn start(&self) -> Angles {
        USUAL
    }
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;

    /// UR10e, lengths of the maker; finger tips 0.15 m from the flange.
    const UR10E: Lengths =
        Lengths { d1: 0.1807, a2: -0.6127, a3: -0.57155, d4: 0.17415, d5: 0.11985, tool: 0.11655 + 0.15 };

    #[test]
    fn what_is_in_reach_is_reached_and_nothing_else() {
        let mut random = Random::new(12);
        let base = Frame::new(Point::new(0.3, -0.2, 0.75), 30.0);
        let arm = FixedArm::new(base, UR10E);
        let (mut reached, mut from) = (0, arm.start());
        for _ in 0..100_000 {
            let mut drawn = || random.between(-1.8, 1.8);
            let tool = Point::new(drawn(), drawn(), 0.5 + drawn());
            let found = arm.solve(tool, &from);
            assert_eq!(found.is_some(), arm.margin(tool) >= 0.0, "{tool:?}");
            let Some(joints) = found else { continue };
            let pose = arm.tool_pose(&joints);
            assert!((pose.position - tool).length() < 1e-6, "{tool:?} {joints:?}");
            assert!((pose.axis(2).z + 1.0).abs() < 1e-9, "{joints:?}");
            assert!(joints.iter().all(|joint| joint.abs() <= 2.0 * PI), "{joints:?}");
            (reached, from) = (reached + 1, joints);
        }
        assert!(reached > 15_000, "{reached}");
    }

    /// The margin is that of the length of the links: it changes by no more than the tool goes.
    #[test]
    fn the_margin_changes_by_no_more_than_the_tool_goes() {
        let mut random = Random::new(13);
        let arm = FixedArm::new(Frame::default(), UR10E);
        for _ in 0..100_000 {
            let mut drawn = || random.between(-1.8, 1.8);
            let (a, b) = (Point::new(drawn(), drawn(), drawn()), Point::new(drawn(), drawn(), drawn()));
            // Where the wrist is ahead of the axis, its distance is that of the tool.
            if libm::hypot(a.x, a.y) > 0.3 && libm::hypot(b.x, b.y) > 0.3 {
                let goes = (a - b).length();
                let stretched = 1.0 / (1.0 - (0.17415_f64 / 0.3).powi(2)).sqrt();
                assert!((arm.margin(a) - arm.margin(b)).abs() <= stretched * goes + 1e-9, "{a:?} {b:?}");
            }
        }
    }
}
