//! Arms of the Universal Robots kind: three parallel axes between a shoulder and a wrist of two more.
//!
//! Links by Denavit and Hartenberg, in the frame of the arm's base as the maker defines it (z along the first joint).

use super::links::Link;
use super::pose::{Pose, Twist};
use super::room::Bent;
use super::{root, wrapped};
use crate::point::Point;
use std::f64::consts::PI;

/// The lengths of one arm, m, named as the maker does; `tool` is from the origin of the last joint to the tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lengths {
    pub d1: f64,
    pub a2: f64,
    pub a3: f64,
    pub d4: f64,
    pub d5: f64,
    pub tool: f64,
}

/// Below this sine of the fifth joint, the fourth and the sixth turn about the same axis.
const WRIST_SINGULAR: f64 = 1e-9;
/// A cosine this far beyond 1, or a wrist this far (m) inside the shoulder's offset, is taken for rounding.
const ROUNDING: f64 = 1e-9;

/// What is rounded in a direction.
const LAST_DIGITS: f64 = 1e-15;

/// Joint angles from the base to the tool, rad.
pub type Angles = [f64; 6];

impl Lengths {
    /// The origin of the last joint.
    pub(super) fn wrist(&self, tool: &Pose) -> Point {
        tool.position - tool.axis(2).scaled(self.tool)
    }

    /// Whether the arm leans over the side to which it is drawn with all angles 0, with the elbow above the line from the
    /// shoulder to the end of the forearm. The tool is in the frame of the base.
    pub(super) fn is_usual(&self, tool: &Pose, angles: &Angles) -> bool {
        let [first, second, third, ..] = *angles;
        let (sin, cos) = libm::sincos(first);
        let Point { x, y, .. } = self.wrist(tool);
        let is_front = (x * cos + y * sin) * self.a2 >= 0.0;
        let end_ahead = self.a2 * libm::cos(second) + self.a3 * libm::cos(second + third);
        // Twice the area of the triangle of shoulder, end and elbow: over 0 where the elbow is to the left.
        let elbow_left = -self.a2 * self.a3 * libm::sin(third);
        is_front && elbow_left * end_ahead >= 0.0
    }

    /// How the arm bends at these angles, its tool vertical or level at a place.
    pub(super) fn bent(&self, tool: &Pose, angles: &Angles) -> Bent {
        let [first, second, third, ..] = *angles;
        let (sin, cos) = libm::sincos(first);
        let Point { x, y, .. } = self.wrist(tool);
        // A link with a length below 0 points the other way.
        let half = |length: f64| if length < 0.0 { PI } else { 0.0 };
        Bent {
            place: [x, y],
            first,
            beside: -self.d4,
            ahead: x * cos + y * sin,
            lengths: [self.a2.abs(), self.a3.abs()],
            upper_arm: second + half(self.a2),
            forearm: second + third + half(self.a3),
            rates: [1.0, 1.0, 1.0, -1.0, 0.0, -tool.axis(2).z.signum()],
            wrist: 3,
        }
    }

    /// What is fixed behind each joint: Denavit and Hartenberg's link at the angle 0.
    fn behind(&self) -> [Pose; 6] {
        let Lengths { d1, a2, a3, d4, d5, tool } = *self;
        let link = |shift_z, shift_x, twist| Pose::IDENTITY.behind_link(0.0, shift_z, shift_x, twist);
        [
            link(d1, 0.0, Twist::Quarter),
            link(0.0, a2, Twist::None),
            link(0.0, a3, Twist::None),
            link(d4, 0.0, Twist::Quarter),
            link(d5, 0.0, Twist::Back),
            link(tool, 0.0, Twist::None),
        ]
    }

    /// The joints, the base at this pose in the frame of the joint before.
    pub fn links(&self, base: Pose) -> [Link; 6] {
        let mut before = base;
        self.behind().map(|behind| Link::turns(std::mem::replace(&mut before, Pose::IDENTITY), behind))
    }

    /// The frames that the joints move, in the frame of the base: frame `i` is fixed to the link behind joint `i`.
    /// The first has its origin on the shoulder's axis and its y along the base's z; the second and the third lie
    /// at the far ends of upper arm and forearm, x pointing back along the link; the last is the tool, z its axis.
    pub fn frames(&self, q: &Angles) -> [Pose; 6] {
        let Lengths { d1, a2, a3, d4, d5, tool } = *self;
        let shoulder = Pose::IDENTITY.behind_link(q[0], d1, 0.0, Twist::Quarter);
        let upper_arm = shoulder.behind_link(q[1], 0.0, a2, Twist::None);
        let forearm = upper_arm.behind_link(q[2], 0.0, a3, Twist::None);
        let wrist_1 = forearm.behind_link(q[3], d4, 0.0, Twist::Quarter);
        let wrist_2 = wrist_1.behind_link(q[4], d5, 0.0, Twist::Back);
        let wrist_3 = wrist_2.behind_link(q[5], tool, 0.0, Twist::None);
        [shoulder, upper_arm, forearm, wrist_1, wrist_2, wrist_3]
    }

    /// Pose of the tool in the frame of the base; the tool's axis is its z.
    pub fn forward(&self, q: &Angles) -> Pose {
        let [.., tool] = self.frames(q);
        tool
    }

    /// All solutions for a pose of the tool in the frame of the base, at most eight, each angle in (-pi, pi].
    /// Where the wrist is singular, the sixth angle is 0 if the arm reaches the pose so, otherwise one with which it does.
    pub fn inverse(&self, tool: &Pose) -> Vec<Angles> {
        let Lengths { d1, a2, a3, d4, d5, tool: length } = *self;
        let mut solutions = Vec::with_capacity(8);
        let [x6, y6, z6] = [tool.axis(0), tool.axis(1), tool.axis(2)];
        let wrist_x = tool.position.x - length * z6.x;
        let wrist_y = tool.position.y - length * z6.y;
        let wrist_z = tool.position.z - length * z6.z;

        let radius = root(wrist_x * wrist_x + wrist_y * wrist_y);
        if radius < d4 - ROUNDING {
            return solutions;
        }
        let ahead = root((radius - d4) * (radius + d4));
        let bearing = libm::atan2(wrist_y, wrist_x);

        for forwards in [ahead, -ahead] {
            let q1 = bearing + libm::atan2(d4, forwards);
            let (s1, c1) = libm::sincos(q1);
            // The plane of the second to fourth joint has the normal (s1, -c1, 0).
            let across = |x: f64, y: f64| x * s1 - y * c1;
            let (along_x, along_y) = (across(x6.x, x6.y), across(y6.x, y6.y));
            let s5 = root(along_x * along_x + along_y * along_y);
            let c5 = across(z6.x, z6.y);
            let singular = s5 < WRIST_SINGULAR;
            // Near that the sixth angle is known to so little that a stretched arm seems too short.
            let rounding = if singular { ROUNDING } else { ROUNDING + LAST_DIGITS / s5 };

            for side in [1.0, -1.0] {
                if singular && side < 0.0 {
                    continue;
                }
                let q5 = match (singular, c5 > 0.0) {
                    (true, true) => 0.0,
                    (true, false) => std::f64::consts::PI,
                    _ => libm::atan2(side * s5, c5),
                };
                // Solutions of the wrist's centre for one angle of the sixth joint.
                let mut with_last = |q6: f64| {
                    let (s6, c6) = libm::sincos(q6);
                    // Axis of the fourth frame along which the wrist's second link (d5) lies.
                    let link = |x: f64, y: f64| -(s6 * x + c6 * y);
                    let (link_x, link_y, link_z) = (link(x6.x, y6.x), link(x6.y, y6.y), link(x6.z, y6.z));
                    let out = link_x * c1 + link_y * s1;
                    let sum = libm::atan2(out, -link_z);
                    let px = wrist_x * c1 + wrist_y * s1 - d5 * out;
                    let py = wrist_z - d1 - d5 * link_z;

                    let c3 = (px * px + py * py - a2 * a2 - a3 * a3) / (2.0 * a2 * a3);
                    if c3.abs() > 1.0 + rounding {
                        return false;
                    }
                    let c3 = c3.clamp(-1.0, 1.0);
                    let s3 = root((1.0 - c3) * (1.0 + c3));
                    for s3 in [s3, -s3] {
                        let q3 = libm::atan2(s3, c3);
                        let q2 = libm::atan2(py, px) - libm::atan2(a3 * s3, a2 + a3 * c3);
                        solutions.push([q1, q2, q3, sum - q2 - q3, q5, q6].map(wrapped));
                    }
                    true
                };
                if !singular {
                    with_last(libm::atan2(-side * along_y, side * along_x));
                } else if !with_last(0.0) {
                    // Turned so that the second link lies in line with the shoulder.
                    let (px, pz) = (wrist_x * c1 + wrist_y * s1, wrist_z - d1);
                    let toward = |axis: Point| (axis.x * c1 + axis.y * s1) * px + axis.z * pz;
                    let (sine, cosine) = (-toward(x6), -toward(y6));
                    let _ = with_last(libm::atan2(sine, cosine)) || with_last(libm::atan2(-sine, -cosine));
                }
            }
        }
        solutions
    }
}
