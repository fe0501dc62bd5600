//! Poses of an arm, and the joints that the solver finds for them, for a comparison with another library:
//! `poses opw LENGTHS OFFSETS SIGNS COUNT SEED` or `poses ur LENGTHS COUNT SEED`. Lists are separated by commas: a1, a2, b,
//! c1, c2, c3, c4 or d1, a2, a3, d4, d5, d6 in m, offsets in degrees.
//!
//! Each record has 67 numbers of 8 bytes, the lowest byte first: six joints drawn from -pi to pi; the rows of rotation
//! and place of the flange at these joints; the number of solutions for this pose, and eight times six joints, NaN where
//! there are fewer.

use runtime_sim::kinematics::opw::Opw;
use runtime_sim::kinematics::pose::Pose;
use runtime_sim::kinematics::ur::{Angles, Lengths};
use runtime_sim::random::Random;
use std::f64::consts::PI;
use std::io::{BufWriter, Write};

enum Arm {
    OrthoParallel(Opw),
    UniversalRobots(Lengths),
}

impl Arm {
    fn forward(&self, joints: &Angles) -> Pose {
        match self {
            Self::OrthoParallel(opw) => opw.forward(joints),
            Self::UniversalRobots(lengths) => lengths.forward(joints),
        }
    }

    fn inverse(&self, flange: &Pose) -> Vec<Angles> {
        match self {
            Self::OrthoParallel(opw) => opw.inverse(flange).into_iter().map(|found| found.angles).collect(),
            Self::UniversalRobots(lengths) => lengths.inverse(flange),
        }
    }
}

fn numbers<const N: usize>(text: &str) -> [f64; N] {
    let numbers: Vec<f64> = text.split(',').map(|number| number.trim().parse().expect("a number")).collect();
    numbers.try_into().unwrap_or_else(|_| panic!("{text}: {N} numbers are wanted"))
}

fn main() -> std::io::Result<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let (arm, count, seed) = match words[..] {
        ["opw", lengths, offsets, signs, count, seed] => {
            let [a1, a2, b, c1, c2, c3, tool] = numbers(lengths);
            let offsets = numbers(offsets).map(f64::to_radians);
            (
                Arm::OrthoParallel(Opw { a1, a2, b, c1, c2, c3, tool, offsets, signs: numbers(signs) }),
                count,
                seed,
            )
        }
        ["ur", lengths, count, seed] => {
            let [d1, a2, a3, d4, d5, tool] = numbers(lengths);
            (Arm::UniversalRobots(Lengths { d1, a2, a3, d4, d5, tool }), count, seed)
        }
        _ => panic!("poses opw LENGTHS OFFSETS SIGNS COUNT SEED, or poses ur LENGTHS COUNT SEED"),
    };
    let mut random = Random::new(seed.parse().expect("a seed"));
    let mut out = BufWriter::new(std::io::stdout().lock());
    for _ in 0..count.parse::<u64>().expect("a count") {
        // 2^30 values from -pi to pi.
        let joints: Angles = std::array::from_fn(|_| {
            let drawn = f64::from(random.up_to((1 << 30) - 1));
            PI * (drawn / f64::from(1 << 29) - 1.0)
        });
        let flange = arm.forward(&joints);
        let solutions = arm.inverse(&flange);
        let Pose { rotation, position } = flange;
        let place = [position.x, position.y, position.z];
        let rows = (0..3).flat_map(|row| rotation[row].into_iter().chain([place[row]]));
        let missing = 8 - solutions.len();
        let all = solutions.iter().flatten().copied().chain(std::iter::repeat_n(f64::NAN, 6 * missing));
        for number in joints.into_iter().chain(rows).chain([solutions.len() as f64]).chain(all) {
            out.write_all(&number.to_le_bytes())?;
        }
    }
    out.flush()
}
