use super::super::random::Random;
use super::*;

/// KUKA KR 6 R700 sixx, as in the examples of the paper's authors.
const KR6: Opw = Opw {
    a1: 0.025,
    a2: -0.035,
    b: 0.0,
    c1: 0.400,
    c2: 0.315,
    c3: 0.365,
    tool: 0.080,
    offsets: [0.0, -FRAC_PI_2, 0.0, 0.0, 0.0, 0.0],
    signs: [-1.0, 1.0, 1.0, -1.0, 1.0, -1.0],
};

/// Stäubli TX40 has a side offset.
const TX40: Opw = Opw {
    a1: 0.0,
    a2: 0.0,
    b: 0.035,
    c1: 0.320,
    c2: 0.225,
    c3: 0.225,
    tool: 0.065,
    offsets: [0.0, 0.0, -FRAC_PI_2, 0.0, 0.0, 0.0],
    signs: [1.0; 6],
};

fn rotation(axis: usize, angle: f64) -> [[f64; 3]; 3] {
    let (s, c) = angle.sin_cos();
    match axis {
        1 => [[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]],
        _ => [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]],
    }
}

fn times(a: [[f64; 3]; 3], b: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

/// The forward kinematics as the paper writes it: place of the wrist's centre by k and psi3, directions by two products of
/// rotations.
fn of_the_paper(arm: &Opw, counted: &Angles) -> Pose {
    let q: [f64; 6] = std::array::from_fn(|i| counted[i] * arm.signs[i] - arm.offsets[i]);
    let psi3 = arm.a2.atan2(arm.c3);
    let k = (arm.a2 * arm.a2 + arm.c3 * arm.c3).sqrt();
    let x1 = arm.c2 * q[1].sin() + k * (q[1] + q[2] + psi3).sin() + arm.a1;
    let z1 = arm.c2 * q[1].cos() + k * (q[1] + q[2] + psi3).cos();
    let wrist =
        Point::new(x1 * q[0].cos() - arm.b * q[0].sin(), x1 * q[0].sin() + arm.b * q[0].cos(), z1 + arm.c1);
    let base = times(rotation(2, q[0]), rotation(1, q[1] + q[2]));
    let wrist_turn = times(times(rotation(2, q[3]), rotation(1, q[4])), rotation(2, q[5]));
    let rotation = times(base, wrist_turn);
    let z = Point::new(rotation[0][2], rotation[1][2], rotation[2][2]);
    Pose { rotation, position: wrist + z.scaled(arm.tool) }
}

fn differs(a: &Pose, b: &Pose) -> f64 {
    let turns = a.rotation.iter().flatten().zip(b.rotation.iter().flatten());
    turns.map(|(a, b)| (a - b).abs()).fold((a.position - b.position).length(), f64::max)
}

fn any(random: &mut Random) -> Angles {
    std::array::from_fn(|_| random.between(-PI, PI))
}

#[test]
fn forward_kinematics_is_that_of_the_paper() {
    let mut random = Random::new(41);
    for arm in [KR6, TX40] {
        for _ in 0..20_000 {
            let joints = any(&mut random);
            let difference = differs(&arm.forward(&joints), &of_the_paper(&arm, &joints));
            assert!(difference < 1e-12, "{difference}");
        }
    }
}

#[test]
fn every_pose_of_the_tool_has_its_joints_among_the_solutions() {
    let mut random = Random::new(42);
    for arm in [KR6, TX40] {
        for _ in 0..50_000 {
            let joints = any(&mut random);
            let tool = arm.forward(&joints);
            let solutions = arm.inverse(&tool);
            for solution in &solutions {
                let difference = differs(&arm.forward(&solution.angles), &tool);
                assert!(difference < 1e-6, "{difference} {joints:?}");
            }
            let apart = |angles: &Angles| {
                angles.iter().zip(&joints).map(|(a, b)| wrapped(a - b).abs()).fold(0.0, f64::max)
            };
            let nearest = solutions.iter().map(|s| apart(&s.angles)).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-4, "{nearest} {joints:?}");
            assert!(arm.margin(&tool) > -1e-9);
        }
    }
}

#[test]
fn the_sign_of_the_margin_tells_whether_there_are_solutions() {
    let mut random = Random::new(43);
    let mut sides = [0, 0];
    for arm in [KR6, TX40] {
        for _ in 0..50_000 {
            let mut drawn = || random.between(-1.0, 1.0);
            let place = Point::new(drawn(), drawn(), 0.3 + drawn());
            let tool =
                Pose { position: place, rotation: [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]] };
            let margin = arm.margin(&tool);
            assert_eq!(margin >= 0.0, !arm.inverse(&tool).is_empty(), "{margin} {place:?}");
            sides[usize::from(margin >= 0.0)] += 1;
        }
    }
    assert!(sides.iter().all(|count| *count > 10_000), "{sides:?}");
}

#[test]
fn a_singular_wrist_is_solved() {
    for arm in [KR6, TX40] {
        // Forearm and tool point down alike.
        let joints = arm.counted([0.3, -0.4, PI + 0.4, 0.0, 0.0, 0.7]);
        let tool = arm.forward(&joints);
        let solutions = arm.inverse(&tool);
        let found = solutions.iter().any(|s| differs(&arm.forward(&s.angles), &tool) < 1e-9);
        assert!(found, "{solutions:?}");
    }
}
