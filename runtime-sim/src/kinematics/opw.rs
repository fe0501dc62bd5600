//! Arms of six axes with an ortho-parallel base and a spherical wrist: most industrial arms.
//!
//! Parameters and conventions: M. Brandstötter, A. Angerer, M. Hofbaur, *An Analytical Solution of the Inverse Kinematics
//! Problem of Industrial Serial Manipulators with an Ortho-parallel Basis and a Spherical Wrist*, 2014. With all angles 0
//! the arm points straight up; a positive angle of the second, third and fifth joint leans it forward.

use super::links::Link;
use super::pose::Pose;
use super::room::{Bent, room};
use super::ur::Angles;
use super::{root, wrapped};
use crate::point::Point;
use std::f64::consts::{FRAC_PI_2, PI};

/// Lengths in m, angles in rad; `tool` is from the centre of the wrist to the tool (c4 and the tool's length).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opw {
    pub a1: f64,
    pub a2: f64,
    pub b: f64,
    pub c1: f64,
    pub c2: f64,
    pub c3: f64,
    pub tool: f64,
    /// Of each joint where the maker's angle is 0.
    pub offsets: Angles,
    /// 1, or -1 where the maker counts the other way.
    pub signs: Angles,
}

/// Joint angles as the maker counts them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution {
    pub angles: Angles,
    /// The arm leans over its front, with the elbow up.
    pub is_usual: bool,
}

/// Below this sine of the fifth joint, the fourth and the sixth turn about the same axis.
const WRIST_SINGULAR: f64 = 1e-9;
/// What is beyond by less is rounding, of a cosine or in m.
const ROUNDING: f64 = 1e-9;

/// The wrist's centre as the upper arm sees it from one side of the first joint.
struct Side {
    first: f64,
    /// Ahead of the second joint, and over it.
    ahead: f64,
    height: f64,
    is_front: bool,
}

impl Opw {
    /// From the third joint to the centre of the wrist.
    fn forearm(&self) -> f64 {
        libm::hypot(self.a2, self.c3)
    }

    /// As the maker counts, from the angles of the convention.
    fn counted(&self, angles: Angles) -> Angles {
        std::array::from_fn(|i| wrapped(self.signs[i] * (angles[i] + self.offsets[i])))
    }

    /// Upper arm upright, forearm level, and this angle of the fifth joint: with a quarter of a turn the tool points to the
    /// base, with one the other way away from it.
    pub fn usual(&self, fifth: f64) -> Angles {
        self.counted([0.0, 0.0, FRAC_PI_2, 0.0, fifth, 0.0])
    }

    fn wrist(&self, tool: &Pose) -> Point {
        tool.position - tool.axis(2).scaled(self.tool)
    }

    fn sides(&self, wrist: Point) -> Option<[Side; 2]> {
        let radius = libm::hypot(wrist.x, wrist.y);
        if radius < self.b.abs() - ROUNDING {
            return None;
        }
        let out = root((radius - self.b) * (radius + self.b));
        let (bearing, aside) = (libm::atan2(wrist.y, wrist.x), libm::atan2(self.b, out));
        let height = wrist.z - self.c1;
        Some([
            Side { first: bearing - aside, ahead: out - self.a1, height, is_front: true },
            Side { first: bearing + aside - PI, ahead: -out - self.a1, height, is_front: false },
        ])
    }

    /// How far the tool may go, keeping its direction, within what upper arm and forearm reach; out of reach how far the
    /// centre of the wrist is from it, negative, m. Limits of joints are not considered.
    pub fn margin(&self, tool: &Pose) -> f64 {
        let wrist = self.wrist(tool);
        let Some(sides) = self.sides(wrist) else {
            return libm::hypot(wrist.x, wrist.y) - self.b.abs();
        };
        let (longest, shortest) = (self.c2 + self.forearm(), (self.c2 - self.forearm()).abs());
        let out = sides[0].ahead + self.a1;
        let slack = |side: Side| {
            let distance = libm::hypot(side.ahead, side.height);
            (longest - distance).min(distance - shortest)
        };
        room(out, self.b, sides.map(slack).into_iter().fold(f64::NEG_INFINITY, f64::max))
    }

    /// How the arm bends at these angles of the maker, its tool vertical or level at a place.
    pub(super) fn bent(&self, tool: &Pose, angles: &Angles) -> Bent {
        let counted: Angles = std::array::from_fn(|i| self.signs[i] * angles[i] - self.offsets[i]);
        let [first, second, third, fourth, ..] = counted;
        let (sin, cos) = libm::sincos(first);
        let Point { x, y, .. } = self.wrist(tool);
        let signs = self.signs;
        // With the fourth joint half a turn away, the fifth one turns the tool the other way.
        let wrist = if libm::cos(fourth) < 0.0 { -signs[4] } else { signs[4] };
        Bent {
            place: [x, y],
            first,
            beside: self.b,
            ahead: x * cos + y * sin,
            lengths: [self.c2, self.forearm()],
            upper_arm: FRAC_PI_2 - second,
            forearm: FRAC_PI_2 - (second + third + libm::atan2(self.a2, self.c3)),
            rates: [signs[0], -signs[1], -signs[2], 0.0, wrist, -signs[5] * tool.axis(2).z.signum()],
            wrist: 4,
        }
    }

    /// All solutions for a pose of the tool in the frame of the base, at most eight; each angle in (-pi, pi]. Where the
    /// wrist is singular, the fourth angle of the convention is 0.
    pub fn inverse(&self, tool: &Pose) -> Vec<Solution> {
        let mut solutions = Vec::with_capacity(8);
        let (c2, forearm) = (self.c2, self.forearm());
        let bend = libm::atan2(self.a2, self.c3);
        for side in self.sides(self.wrist(tool)).into_iter().flatten() {
            let square = side.ahead * side.ahead + side.height * side.height;
            let cosine = (square - c2 * c2 - forearm * forearm) / (2.0 * c2 * forearm);
            if cosine.abs() > 1.0 + ROUNDING {
                continue;
            }
            let cosine = cosine.clamp(-1.0, 1.0);
            let sine = root((1.0 - cosine) * (1.0 + cosine));
            // From the vertical, forwards.
            let lean = libm::atan2(side.ahead, side.height);
            for sine in [sine, -sine] {
                let third = libm::atan2(sine, cosine);
                let second = lean - libm::atan2(forearm * sine, c2 + forearm * cosine);
                // Over the back the elbow is up if it bends the other way.
                let is_usual = side.is_front && sine >= 0.0;
                for wrist in wrist_angles(side.first, second + third - bend, tool) {
                    let [fourth, fifth, sixth] = wrist;
                    let angles = [side.first, second, third - bend, fourth, fifth, sixth];
                    solutions.push(Solution { angles: self.counted(angles), is_usual });
                }
            }
        }
        solutions
    }

    pub fn frames(&self, joints: &Angles) -> [Pose; 6] {
        let links = self.links(Pose::IDENTITY);
        let mut frame = Pose::IDENTITY;
        std::array::from_fn(|i| {
            frame = frame.then(&links[i].frame(joints[i]));
            frame
        })
    }

    pub fn forward(&self, joints: &Angles) -> Pose {
        let [.., tool] = self.frames(joints);
        tool
    }

    /// The joints, the base at this pose. The frame behind a joint has its origin on the axis of the joint: where it
    /// crosses the height of the second one, in the middle plane, or in the centre of the wrist; that of the last is
    /// the tool's. With all angles of the convention 0 they lie like that of the base.
    pub fn links(&self, base: Pose) -> [Link; 6] {
        let Opw { a1, a2, b, c1, c2, c3, tool, .. } = *self;
        let at = |x: f64, y: f64, z: f64| Pose { position: Point::new(x, y, z), ..Pose::IDENTITY };
        let (up, forward) = (Pose::IDENTITY, FORWARD);
        [
            (base.then(&at(0.0, 0.0, c1)), up),
            (at(a1, 0.0, 0.0), forward),
            (at(0.0, 0.0, c2), forward),
            (at(a2, b, c3), up),
            (at(0.0, 0.0, 0.0), forward),
            (at(0.0, 0.0, tool), up),
        ]
        .into_iter()
        .enumerate()
        .map(|(i, (place, axis))| {
            // Turned over, a joint counts the other way.
            let over = if self.signs[i] < 0.0 { OVER } else { Pose::IDENTITY };
            let axis = axis.then(&over);
            let zero = Pose::turned(Point::default(), -self.offsets[i]);
            let behind = over.inverse().then(&zero).then(&axis.then(&over.inverse()).inverse());
            Link::turns(place.then(&axis), behind)
        })
        .collect::<Vec<_>>()
        .try_into()
        .unwrap_or_else(|_| unreachable!("six joints"))
    }
}

/// z lies along y: positive angles lean forward.
const FORWARD: Pose =
    Pose { rotation: [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]], ..Pose::IDENTITY };
const OVER: Pose = Pose { rotation: [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]], ..Pose::IDENTITY };

/// The last three angles that give the tool its direction, behind a forearm with this lean from the vertical.
fn wrist_angles(first: f64, lean: f64, tool: &Pose) -> Vec<[f64; 3]> {
    let ((s1, c1), (s, c)) = (libm::sincos(first), libm::sincos(lean));
    // Axes of the forearm's frame in that of the base.
    let x = Point::new(c1 * c, s1 * c, -s);
    let y = Point::new(-s1, c1, 0.0);
    let z = Point::new(c1 * s, s1 * s, c);
    let [tool_x, tool_y, tool_z] = [tool.axis(0), tool.axis(1), tool.axis(2)];
    let (out_x, out_y, cosine) = (x.dot(tool_z), y.dot(tool_z), z.dot(tool_z));
    let sine = libm::hypot(out_x, out_y);
    if sine < WRIST_SINGULAR {
        let fifth = if cosine > 0.0 { 0.0 } else { PI };
        return vec![[0.0, fifth, libm::atan2(y.dot(tool_x), y.dot(tool_y))]];
    }
    let side = |sign: f64| {
        [
            libm::atan2(sign * out_y, sign * out_x),
            libm::atan2(sign * sine, cosine),
            libm::atan2(sign * z.dot(tool_y), -sign * z.dot(tool_x)),
        ]
    };
    vec![side(1.0), side(-1.0)]
}

#[cfg(test)]
mod tests;
