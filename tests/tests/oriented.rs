//! Tools that are turned about the vertical: which turns an arm reaches, and a pallet with layers across.

use autogen_tests::{Texts, machines, plain, side_by_side, stepped};
use runtime_sim::carrier::Carrier;
use runtime_sim::frame::Frame;
use runtime_sim::kinematics::arm::Joints;
use runtime_sim::kinematics::facing::Facing;
use runtime_sim::kinematics::fixed::{FixedArm, Geometry, Mounting};
use runtime_sim::kinematics::opw::Opw;
use runtime_sim::kinematics::pose::Pose;
use runtime_sim::kinematics::riding::RidingArm;
use runtime_sim::kinematics::scara::{Arms, Scara};
use runtime_sim::kinematics::solver::Solver;
use runtime_sim::kinematics::ur::Lengths;
use runtime_sim::point::{Axis, Point};
use runtime_sim::random::Random;
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const UR10E: Geometry = Geometry::UniversalRobots(Lengths {
    d1: 0.1807,
    a2: -0.6127,
    a3: -0.57155,
    d4: 0.17415,
    d5: 0.11985,
    tool: 0.26655,
});

/// ABB IRB 2400/10.
fn abb() -> Geometry {
    let offsets = [0.0, 0.0, -FRAC_PI_2, 0.0, 0.0, 0.0];
    let [a1, a2, b, c1, c2, c3] = [0.100, -0.135, 0.0, 0.615, 0.705, 0.755];
    Geometry::OrthoParallel(Opw { a1, a2, b, c1, c2, c3, tool: 0.235, offsets, signs: [1.0; 6] })
}

/// With these of the fourth and the sixth joint, to either side, degrees.
fn limits(fourth: f64, sixth: f64) -> Option<[[f64; 2]; 6]> {
    let all = [[-180.0, 180.0], [-100.0, 110.0], [-60.0, 65.0], [-fourth, fourth], [-120.0, 120.0]];
    let all = [all[0], all[1], all[2], all[3], all[4], [-sixth, sixth]];
    Some(all.map(|range| range.map(f64::to_radians)))
}

/// A SCARA whose tool turns by so many degrees to either side.
fn scara(turn: f64) -> Scara {
    let range = |degrees: f64| [-degrees.to_radians(), degrees.to_radians()];
    let ranges = [range(132.0), range(150.0), [-0.2, 0.0], range(turn)];
    Scara::new(Frame::new(BASE, 20.0), Arms { lengths: [0.325, 0.275], tool: 0.1, ranges })
}

const BASE: Point = Point::new(0.3, -0.2, 0.4);

fn fixed(geometry: Geometry, ranges: Option<[[f64; 2]; 6]>, mounting: Mounting) -> Box<dyn Solver> {
    Box::new(FixedArm::new(Frame::new(BASE, 20.0), geometry, ranges).mounted(mounting))
}

/// Arms whose last joint turns once or more, and how far they reach.
fn arms() -> Vec<(&'static str, Box<dyn Solver>, f64)> {
    let rail = Frame::new(BASE, 35.0);
    let mount = Frame::new(Point::new(0.1, -0.2, 0.3), 90.0);
    let riding = RidingArm::new(rail, Axis::Y, [-1.0, 1.5], mount, |base| FixedArm::new(base, UR10E, None));
    vec![
        ("UR10e", fixed(UR10E, None, Mounting::Upright), 1.2),
        ("UR10e, hung", fixed(UR10E, None, Mounting::Hung), 1.2),
        ("ABB", fixed(abb(), limits(200.0, 400.0), Mounting::Upright), 1.5),
        ("ABB, hung", fixed(abb(), limits(200.0, 180.0), Mounting::Hung), 1.5),
        ("on a rail", Box::new(riding), 1.5),
        ("SCARA", Box::new(scara(360.0)), 0.5),
    ]
}

fn is_at(pose: &Pose, place: Point, turn: f64) {
    let along = Point::new(turn.cos(), turn.sin(), 0.0);
    assert!((pose.position - place).length() < 1e-6, "{pose:?} {place:?}");
    assert!((pose.axis(0) - along).length() < 1e-6, "{pose:?} {turn}");
    assert!(pose.axis(2).z < 1e-9 - 1.0, "{pose:?}");
}

fn drawn(random: &mut Random, low: f64, high: f64) -> f64 {
    low + (high - low) * f64::from(random.up_to(1_000_000)) / 1e6
}

/// Only the last joint turns the tool about the vertical: where it turns once, a place in reach is reached at every turn, and
/// as far from its limits.
#[test]
fn a_place_in_reach_is_reached_at_every_turn() {
    for (name, arm, reach) in arms() {
        let (mut random, mut reached, mut from) = (Random::new(7), 0, arm.start());
        for _ in 0..4000 {
            let [x, y, z] = [0; 3].map(|_| drawn(&mut random, -reach, reach));
            let (place, turn) = (BASE + Point::new(x, y, z), drawn(&mut random, -9.0, 9.0));
            let facing = Facing::oriented(turn).expect("a number");
            let margins = [Facing::Down, facing].map(|facing| arm.margin(place, facing));
            assert!((margins[0] - margins[1]).abs() < 1e-6, "{name} {place:?} {margins:?}");
            let found = arm.solve(place, facing, &from);
            assert_eq!(found.is_some(), margins[0] >= 0.0, "{name} {place:?} {turn}");
            let Some(joints) = found else { continue };
            is_at(&arm.tool_pose(&joints), place, turn);
            (reached, from) = (reached + 1, joints);
        }
        assert!(reached > 150, "{name} {reached}");
    }
}

#[test]
fn arms_of_the_library_come_to_every_turn() {
    let kitting = machines::arm(&machines::rail_arm(Point::new(-1.3, 0.0, 1.127), Axis::Y, [-2.0, 2.0]));
    let gantry = machines::arm(&machines::gantry(Point::new(-4.0, 0.0, 2.0), [-6.0, -2.0], [-2.0, 2.0]));
    for (arm, place) in [(kitting, Point::new(-0.6, 0.3, 0.9)), (gantry, Point::new(-4.0, 0.5, 1.0))] {
        let mut joints = arm.solve(place, &arm.start()).expect("a place in reach");
        for turn in [0.3, 1.5, -2.0, 3.0, 6.0] {
            let facing = Facing::oriented(turn).expect("a number");
            joints = arm.solve_facing(place, facing, &joints).expect("every turn");
            is_at(&arm.tool_pose(&joints), place, turn);
        }
        // What comes after it keeps this turn.
        let aside = arm.solve(place + Point::new(0.05, 0.1, 0.0), &joints).expect("a place in reach");
        is_at(&arm.tool_pose(&aside), place + Point::new(0.05, 0.1, 0.0), 6.0);
    }
}

/// Limits of the last joint alone forbid a turn: the wrist has no room to turn over.
#[test]
fn a_joint_that_turns_less_than_once_does_not_reach_every_turn() {
    for (arm, low) in
        [(fixed(abb(), limits(100.0, 100.0), Mounting::Upright), 0.3), (Box::new(scara(100.0)), 0.2)]
    {
        let joints = arm.start().len();
        let (mut random, mut reached, mut forbidden) = (Random::new(8), 0, 0);
        for _ in 0..4000 {
            let [x, y] = [0; 2].map(|_| drawn(&mut random, -3.0 * low, 3.0 * low));
            let (place, turn) = (BASE + Point::new(x, y, -low / 2.0), drawn(&mut random, -PI, PI));
            let facing = Facing::oriented(turn).expect("a number");
            let found = arm.solve(place, facing, &arm.start());
            assert_eq!(found.is_some(), arm.margin(place, facing) >= 0.0, "{place:?} {turn}");
            match found {
                Some(found) => {
                    is_at(&arm.tool_pose(&found), place, turn);
                    assert!(found[joints - 1].abs() < 100.1_f64.to_radians(), "{found:?}");
                    reached += 1;
                }
                None => forbidden += u32::from(arm.margin(place, Facing::Down) >= 0.0),
            }
        }
        assert!(reached > 100 && forbidden > 100, "{reached} {forbidden}");
    }
}

/// Turn by turn in the same direction: as far as the joint goes on, then back by a whole turn. The wrist has no room to turn
/// over.
#[test]
fn the_last_joint_takes_the_nearer_way_within_its_limits() {
    let place = BASE + Point::new(0.35, 0.15, -0.2);
    let arms =
        [(fixed(abb(), limits(100.0, 400.0), Mounting::Upright), Point::new(0.6, 0.1, 0.3), 400.0_f64)];
    let arms = arms.into_iter().chain([(Box::new(scara(360.0)) as Box<dyn Solver>, place - BASE, 360.0)]);
    for (arm, offset, limit) in arms {
        let last = arm.start().len() - 1;
        let at = |turn: f64, from: &Joints| {
            arm.solve(BASE + offset, Facing::oriented(turn).expect("a number"), from).expect("every turn")
        };
        let mut joints = at(0.0, &arm.start());
        let mut back = 0;
        for step in 1..40 {
            let next = at(f64::from(step) * 0.5, &joints);
            let goes = (next[last] - joints[last]).abs();
            let is_near = (goes - 0.5).abs() < 1e-6;
            back += u32::from(!is_near);
            assert!(is_near || (goes - (TAU - 0.5)).abs() < 1e-6, "{joints:?} {next:?}");
            // It goes back only where it cannot go on.
            assert!(is_near || joints[last].abs() + 0.5 > limit.to_radians(), "{joints:?} {next:?}");
            assert!((0..last).all(|joint| (next[joint] - joints[joint]).abs() < 1e-6), "{next:?}");
            joints = next;
        }
        assert!((1..5).contains(&back), "{back}");
    }
}

#[test]
fn what_is_no_number_is_no_turn() {
    assert!([f64::NAN, f64::INFINITY].into_iter().all(|turn| Facing::oriented(turn).is_none()));
}

/// The scene with one text of its types replaced.
fn scene(changes: &[(&str, &str)]) -> Texts {
    side_by_side("scenes/layers").replaced(changes)
}

fn reason(texts: &Texts) -> String {
    stepped::report(texts, |_| {}).reason.to_string()
}

/// With an arm of the device replaced: its text from `part robot` to the gripper.
fn with_robot(robot: &str) -> Texts {
    let mut texts = scene(&[]);
    let text = &mut texts.specs[0];
    let begin = text.find("part robot = chain {").expect("the arm");
    let end = text.find("part cups").expect("the gripper");
    text.replace_range(begin..end, robot);
    texts
}

const UR20: &str = "part robot = chain {
        from: origin * frame(0, 0, 0.4, 0); lengths: [0.2363, -0.8620, -0.7287, 0.2010, 0.1593, 0.1543]; tool_length: 0.15;
        speeds: [2.1, 2.1, 2.6, 3.7, 3.7, 3.7]; acceleration: 4.0; rest: origin * point(0.9, 0.5, 0.95);
    };
    ";

/// Where a box lies and how it is turned, and the same as the pattern says: from its place on the infeed relative to the
/// gripper, turned by a quarter turn in every second layer. The machine stands at `pose`, turned by `yaw` degrees.
fn lies_as_the_pattern_says(texts: &Texts, pose: Point, yaw: f64) {
    let turned = |point: [f64; 2], by: f64| {
        let (sin, cos) = by.to_radians().sin_cos();
        [cos * point[0] - sin * point[1], sin * point[0] + cos * point[1]]
    };
    let mut gripped: BTreeMap<usize, [f64; 2]> = BTreeMap::new();
    let mut lie: BTreeMap<usize, (Point, f64)> = BTreeMap::new();
    let report = stepped::report(texts, |seen| {
        let plant = seen.plant;
        for item in 0..plant.items().count() {
            let Some(place) = plant.place(item) else { continue };
            match plant.items()[item].carrier {
                Carrier::Grip { machine, .. } => {
                    gripped.entry(item).or_insert_with(|| {
                        let off = place - plant.position(machine).expect("a tool");
                        turned([off.x, off.y], -yaw)
                    });
                }
                Carrier::Place { .. } => {
                    lie.insert(item, (place, plant.turn(item)));
                }
                _ => {}
            }
        }
    });
    assert_eq!(report.reason.to_string(), "all orders made");
    assert_eq!(lie.len(), 24);
    for (number, (place, turn)) in lie.values().enumerate() {
        let (layer, spot) = (number % 12 / 3, number % 3);
        let aside = 0.16 * (spot as f64 - 1.0);
        let (by, spot) = if layer % 2 == 0 { (0.0, [1.0, aside]) } else { (90.0, [1.0 + aside, 0.0]) };
        let off = turned(gripped[lie.keys().nth(number).expect("an item")], by);
        let [x, y] = turned([spot[0] + off[0], spot[1] + off[1]], yaw);
        let wanted = pose + Point::new(x, y, 0.15 + 0.1 * layer as f64);
        assert!((*place - wanted).length() < 1e-6, "box {number}: {place:?} {wanted:?}");
        let lacks = (turn - (by + yaw).to_radians()).rem_euclid(TAU);
        assert!(lacks.min(TAU - lacks) < 1e-6, "box {number}: {turn}");
    }
    // Not all of them hang at the very middle: where they hang turns with them.
    assert!(gripped.values().any(|[x, _]| x.abs() > 1e-4), "{gripped:?}");
}

#[test]
fn boxes_lie_as_the_pattern_says() {
    lies_as_the_pattern_says(&scene(&[]), Point::default(), 0.0);
    lies_as_the_pattern_says(&with_robot(UR20), Point::default(), 0.0);
    let mut texts = scene(&[]);
    texts.layout = texts.layout.replace("[0, 0, 0]", "[2, -1, 0, 30]");
    lies_as_the_pattern_says(&texts, Point::new(2.0, -1.0, 0.0), 30.0);
}

#[test]
fn without_the_turn_the_boxes_of_a_layer_meet() {
    let straight = [("(origin.yaw + 90) * pi / 180]", "origin.yaw * pi / 180]")];
    let reason = reason(&scene(&straight));
    assert!(reason.starts_with("collision of robot (box_4) with robot (box_5)"), "{reason}");
}

#[test]
fn a_turn_that_the_last_joint_does_not_reach_ends_the_command() {
    let less = [
        ("lowest: [-180, -100, -60, -200, -120, -400]", "lowest: [-180, -100, -60, -200, -120, -80]"),
        ("highest: [180, 110, 65, 200, 120, 400]", "highest: [180, 110, 65, 200, 120, 80]"),
    ];
    let report = stepped::report(&scene(&less), |_| {});
    assert!(!report.finished, "{}", report.reason);
}

#[test]
fn a_cartesian_robot_turns_no_tool() {
    let axes = "part x = axis { from: origin * frame(0, 0, 1.2, 0); along: x; range: [0, 1.6]; speed: 1.0; acceleration: 1.0; };
    part y = axis { on: x; along: y; range: [-0.5, 1.5]; speed: 1.0; acceleration: 1.0; };
    part z = axis { on: y; along: z; range: [-1.0, 0.4]; speed: 1.0; acceleration: 1.0; };
    part robot = chain { on: z; tool_length: 0.15; rest: origin * point(0.9, 0.5, 0.95); };
    ";
    let mut texts = with_robot(axes);
    texts.specs[0] = texts.specs[0].replace("on: robot.wrist_3;", "on: z;");
    let outcome = texts.compile();
    let codes: Vec<&str> = outcome.diagnostics.iter().map(|found| found.code).collect();
    let shown = plain(&outcome.sources, &outcome.diagnostics);
    assert!(outcome.project.is_none() && codes.contains(&"E0708"), "{shown}");
    assert!(shown.contains("no joint of this chain turns its tool for `oriented`"), "{shown}");
    assert!(shown.contains("command 1 move(goal, turn) = robot.oriented(goal, turn);"), "{shown}");
}
