//! The arm of the UR10 with a vacuum gripper.
//!
//! Links by Denavit and Hartenberg, in the frame of the arm's base as the maker
//! defines it (z along the first joint). Lengths from the robot's description in
//! the ARIAC 2021 packages, `ur10.urdf.macro.xacro`.

use super::pose::Pose;
pub use super::ur::Angles;
use super::ur::Lengths;

pub const D1: f64 = 0.1273;
pub const A2: f64 = -0.612;
pub const A3: f64 = -0.5723;
pub const D4: f64 = 0.163941;
pub const D5: f64 = 0.1157;
/// From the origin of the last joint to the tool: the gripper replaces the flange (d6 = 0.0922)
/// (`vacuum_gripper.urdf.xacro`: 0.1 m along the tool's axis).
pub const TOOL: f64 = 0.1;

/// The lengths of the arm with the gripper.
pub const LENGTHS: Lengths = Lengths { d1: D1, a2: A2, a3: A3, d4: D4, d5: D5, tool: TOOL };

/// See [`Lengths::frames`].
pub fn frames(q: &Angles) -> [Pose; 6] {
    LENGTHS.frames(q)
}

/// Pose of the tool in the frame of the base; the tool's axis is its z.
pub fn forward(q: &Angles) -> Pose {
    LENGTHS.forward(q)
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::super::{root, wrapped};
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
        let solutions = LENGTHS.inverse(pose);
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
            let found = LENGTHS
                .inverse(&forward(&joints))
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
        assert!(LENGTHS.inverse(&pose).is_empty());
    }
}
