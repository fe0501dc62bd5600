//! The arm of the UR10 with a vacuum gripper.
//!
//! Links by Denavit and Hartenberg, in the frame of the arm's base as the maker
//! defines it (z along the first joint). Lengths from the robot's description in
//! the ARIAC 2021 packages, `ur10.urdf.macro.xacro`.

use super::pose::Pose;
use super::{root, wrapped};
use crate::point::Point;

pub const D1: f64 = 0.1273;
pub const A2: f64 = -0.612;
pub const A3: f64 = -0.5723;
pub const D4: f64 = 0.163941;
pub const D5: f64 = 0.1157;
/// From the origin of the last joint to the tool: the gripper replaces the flange (d6 = 0.0922)
/// (`vacuum_gripper.urdf.xacro`: 0.1 m along the tool's axis).
pub const TOOL: f64 = 0.1;

/// Below this sine of the fifth joint, the fourth and the sixth turn about the same axis.
const WRIST_SINGULAR: f64 = 1e-9;
/// A cosine this far beyond 1, or a wrist this far (m) inside the shoulder's offset, is taken for rounding.
const ROUNDING: f64 = 1e-9;

/// What is rounded in a direction.
const LAST_DIGITS: f64 = 1e-15;

/// Joint angles from the base to the tool, rad.
pub type Angles = [f64; 6];

/// The frames that the joints move, in the frame of the base: frame `i` is fixed to the link behind joint `i`.
/// The first has its origin on the shoulder's axis and its y along the base's z; the second and the third lie
/// at the far ends of upper arm and forearm, x pointing back along the link; the last is the tool, z its axis.
pub fn frames(q: &Angles) -> [Pose; 6] {
    const STRAIGHT: (f64, f64) = (0.0, 1.0);
    const QUARTER: (f64, f64) = (1.0, 0.0);
    const BACK: (f64, f64) = (-1.0, 0.0);
    let shoulder = Pose::link(q[0], D1, 0.0, QUARTER);
    let upper_arm = shoulder.then(&Pose::link(q[1], 0.0, A2, STRAIGHT));
    let forearm = upper_arm.then(&Pose::link(q[2], 0.0, A3, STRAIGHT));
    let wrist_1 = forearm.then(&Pose::link(q[3], D4, 0.0, QUARTER));
    let wrist_2 = wrist_1.then(&Pose::link(q[4], D5, 0.0, BACK));
    let wrist_3 = wrist_2.then(&Pose::link(q[5], TOOL, 0.0, STRAIGHT));
    [shoulder, upper_arm, forearm, wrist_1, wrist_2, wrist_3]
}

/// Pose of the tool in the frame of the base; the tool's axis is its z.
pub fn forward(q: &Angles) -> Pose {
    let [.., tool] = frames(q);
    tool
}

/// All solutions for a pose of the tool in the frame of the base, at most eight, each angle in (-pi, pi].
/// Where the wrist is singular, the sixth angle is 0 if the arm reaches the pose so, otherwise one with which it does.
pub fn inverse(tool: &Pose) -> Vec<Angles> {
    let mut solutions = Vec::with_capacity(8);
    let [x6, y6, z6] = [tool.axis(0), tool.axis(1), tool.axis(2)];
    let wrist_x = tool.position.x - TOOL * z6.x;
    let wrist_y = tool.position.y - TOOL * z6.y;
    let wrist_z = tool.position.z - TOOL * z6.z;

    let radius = root(wrist_x * wrist_x + wrist_y * wrist_y);
    if radius < D4 - ROUNDING {
        return solutions;
    }
    let ahead = root((radius - D4) * (radius + D4));
    let bearing = libm::atan2(wrist_y, wrist_x);

    for forwards in [ahead, -ahead] {
        let q1 = bearing + libm::atan2(D4, forwards);
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
                let px = wrist_x * c1 + wrist_y * s1 - D5 * out;
                let py = wrist_z - D1 - D5 * link_z;

                let c3 = (px * px + py * py - A2 * A2 - A3 * A3) / (2.0 * A2 * A3);
                if c3.abs() > 1.0 + rounding {
                    return false;
                }
                let c3 = c3.clamp(-1.0, 1.0);
                let s3 = root((1.0 - c3) * (1.0 + c3));
                for s3 in [s3, -s3] {
                    let q3 = libm::atan2(s3, c3);
                    let q2 = libm::atan2(py, px) - libm::atan2(A3 * s3, A2 + A3 * c3);
                    solutions.push([q1, q2, q3, sum - q2 - q3, q5, q6].map(wrapped));
                }
                true
            };
            if !singular {
                with_last(libm::atan2(-side * along_y, side * along_x));
            } else if !with_last(0.0) {
                // Turned so that the second link lies in line with the shoulder.
                let (px, pz) = (wrist_x * c1 + wrist_y * s1, wrist_z - D1);
                let toward = |axis: Point| (axis.x * c1 + axis.y * s1) * px + axis.z * pz;
                let (sine, cosine) = (-toward(x6), -toward(y6));
                let _ = with_last(libm::atan2(sine, cosine)) || with_last(libm::atan2(-sine, -cosine));
            }
        }
    }
    solutions
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;
    use std::f64::consts::PI;

    fn gap(a: &Pose, b: &Pose) -> (f64, f64) {
        let d = a.position - b.position;
        let turn = (0..3)
            .flat_map(|i| (0..3).map(move |j| (i, j)))
            .map(|(i, j)| (a.rotation[i][j] - b.rotation[i][j]).abs())
            .fold(0.0, f64::max);
        (root(d.x * d.x + d.y * d.y + d.z * d.z), turn)
    }

    fn worst_gap(pose: &Pose) -> (usize, f64) {
        let solutions = inverse(pose);
        let worst = solutions.iter().fold(0.0, |worst: f64, q| {
            assert!(q.iter().all(|angle| *angle > -PI && *angle <= PI), "{q:?}");
            let (position, rotation) = gap(&forward(q), pose);
            worst.max(position).max(rotation)
        });
        (solutions.len(), worst)
    }

    fn anywhere(random: &mut Random) -> Angles {
        std::array::from_fn(|_| random.between(-PI, PI))
    }

    #[test]
    fn zero_pose_of_the_maker() {
        let pose = forward(&[0.0; 6]);
        let expected = [A2 + A3, -D4 - TOOL, D1 - D5];
        let got = [pose.position.x, pose.position.y, pose.position.z];
        assert!(expected.iter().zip(got).all(|(e, g)| (e - g).abs() < 1e-12), "{got:?}");
    }

    /// Start joints of the kitting robot, with the tool's place that the prototype's description gives
    /// from the shoulder; the description's base is turned by half a turn.
    #[test]
    fn start_pose_of_the_kitting_robot() {
        let pose = forward(&[0.0, -1.25, 1.74, 1.00, -1.58, 0.0]);
        assert!((-pose.position.x - 0.574).abs() < 1e-3);
        assert!((-pose.position.y - 0.163).abs() < 2e-3);
        assert!((pose.position.z - D1 - 0.402).abs() < 1e-3);
    }

    #[test]
    fn inverse_undoes_forward_on_a_million_poses() {
        let mut random = Random::new(1);
        let (mut worst, mut fewest, mut most): (f64, _, _) = (0.0, 8, 0);
        for _ in 0..1_000_000 {
            let joints = anywhere(&mut random);
            let pose = forward(&joints);
            let (count, gap) = worst_gap(&pose);
            assert!(gap < 1e-9, "{gap} for {joints:?}");
            worst = worst.max(gap);
            fewest = fewest.min(count);
            most = most.max(count);
        }
        println!("worst {worst:e}, {fewest} to {most} solutions");
        assert!(fewest >= 2 && most == 8, "{fewest} to {most} solutions");
    }

    #[test]
    fn inverse_finds_the_joints_it_came_from() {
        let mut random = Random::new(2);
        for _ in 0..20_000 {
            let joints = anywhere(&mut random);
            let near_singular =
                joints[4].abs() < 1e-3 || joints[4].abs() > PI - 1e-3 || joints[2].abs() < 1e-3;
            let found = inverse(&forward(&joints))
                .iter()
                .any(|q| q.iter().zip(&joints).all(|(a, b)| wrapped(a - b).abs() < 1e-6));
            assert!(found || near_singular, "{joints:?}");
        }
    }

    #[test]
    fn near_singularities_within_a_micrometre() {
        let mut random = Random::new(3);
        let mut worst: f64 = 0.0;
        for i in 0..10_000 {
            let mut joints = anywhere(&mut random);
            let off = random.between(-1.0, 1.0) * libm::pow(10.0, -random.between(1.0, 18.0));
            match i % 3 {
                0 => joints[2] = off,
                1 => joints[4] = if i % 2 == 0 { off } else { PI - off },
                _ => {
                    // Wrist centre over the axis of the shoulder's offset: it is ahead in the plane of the arm by nearly 0.
                    let lift = joints[1];
                    let ahead = A2 * libm::cos(lift) + A3 * libm::cos(lift + joints[2]);
                    let sine = (off - ahead) / D5;
                    if sine.abs() > 1.0 {
                        continue;
                    }
                    joints[3] = libm::asin(sine) - lift - joints[2];
                }
            }
            let (count, gap) = worst_gap(&forward(&joints));
            assert!(count > 0, "{joints:?}");
            assert!(gap < 1e-6, "{gap} for {joints:?}");
            worst = worst.max(gap);
        }
        println!("worst {worst:e}");
    }

    /// Stretched or folded, with the fourth and the sixth joint about one axis.
    #[test]
    fn doubly_singular_poses_have_solutions_within_a_micrometre() {
        let mut random = Random::new(4);
        for i in 0..200_000 {
            let mut joints = anywhere(&mut random);
            let mut small = || random.between(-1.0, 1.0) * libm::pow(10.0, -random.between(1.0, 18.0));
            joints[2] = if i % 2 == 0 { small() } else { PI - small() };
            joints[4] = if i % 4 < 2 { small() } else { PI - small() };
            let (count, gap) = worst_gap(&forward(&joints));
            assert!(count > 0, "{joints:?}");
            assert!(gap < 1e-6, "{gap} for {joints:?}");
        }
    }

    #[test]
    fn nothing_reaches_further_than_the_arm() {
        let mut pose = forward(&[0.3, -0.4, 0.5, 0.1, 1.0, 0.2]);
        pose.position.x += 3.0;
        assert!(inverse(&pose).is_empty());
    }
}
