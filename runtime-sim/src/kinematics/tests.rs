//! Both robots: every solution through the general forward kinematics, every refusal through the general inverse.

use super::arm::{Arm, Joints};
use super::fixed::{self, Mounting};
use super::gantry::Gantry;
use super::opw::Opw;
use super::pose::Pose;
use super::rail_arm::RailArm;
use super::random::Random;
use super::ur::Lengths;
use super::ur10::{self, D1};
use crate::frame::Frame;
use crate::part::axis::{Motion, Place};
use crate::part::chain::{Chain, Geometry, Joint};
use crate::point::{Axis, Direction, Point};
use std::f64::consts::{PI, TAU};

const KITTING: Point = Point::new(-1.3, 0.0, 1.127);
const ABOVE: Point = Point::new(-4.0, 0.0, 2.0);

fn kitting(rail: Axis) -> RailArm {
    RailArm::new(KITTING, rail, [-4.8, 4.8])
}

fn gantry() -> Gantry {
    Gantry::new(ABOVE, [-14.4, 0.4], [-4.5, 4.5])
}

/// Tool straight down at a place.
fn down(position: Point) -> Pose {
    Pose { rotation: [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]], position }
}

fn assert_at(pose: &Pose, tool: Point) {
    let d = pose.position - tool;
    let error = (d.x * d.x + d.y * d.y + d.z * d.z).sqrt();
    assert!(error < 1e-9, "{error} at {tool:?}");
    let axis = pose.axis(2);
    assert!(axis.x.abs() < 1e-9 && axis.y.abs() < 1e-9 && axis.z < 0.0, "{axis:?} at {tool:?}");
}

fn assert_rail_solved(arm: &RailArm, tool: Point, from: &mut [f64; 7]) {
    match arm.solve(tool, from) {
        Some(joints) => {
            assert!(arm.margin(tool) >= 0.0);
            assert_at(&arm.tool_pose(&joints), tool);
            assert!((-4.8..=4.8).contains(&joints[0]));
            assert!(joints[1..].iter().all(|angle| angle.abs() <= TAU), "{joints:?}");
            assert!(joints[3] >= 0.0, "elbow down: {joints:?}");
            *from = joints;
        }
        None => assert!(arm.margin(tool) < 0.0),
    }
}

fn assert_gantry_solved(arm: &Gantry, tool: Point, from: &mut [f64; 9]) {
    match arm.solve(tool, from) {
        Some(joints) => {
            assert!(arm.margin(tool) >= 0.0);
            assert_at(&arm.tool_pose(&joints), tool);
            assert!((-14.4..=0.4).contains(&joints[0]) && (-4.5..=4.5).contains(&joints[1]));
            assert!(joints[2..].iter().all(|angle| angle.abs() <= TAU), "{joints:?}");
            *from = joints;
        }
        None => assert!(arm.margin(tool) < 0.0),
    }
}

/// The same arm with its base fixed: is there any solution at all, however it bends?
fn rail_arm_at(place: f64, rail: Axis, tool: Point) -> bool {
    let base = match rail {
        Axis::X => Point::new(place, KITTING.y, KITTING.z - D1),
        Axis::Y => Point::new(KITTING.x, place, KITTING.z - D1),
    };
    !ur10::LENGTHS.inverse(&down(tool - base)).is_empty()
}

/// The same with the torso fixed and turned so that the arm's plane at pan 0 holds the tool.
fn gantry_at(x: f64, y: f64, tool: Point) -> bool {
    let ahead2 = (tool.x - x) * (tool.x - x) + (tool.y - y) * (tool.y - y) - ur10::D4 * ur10::D4;
    // In the frame of the arm's base: x up, y to the right, z outward.
    let pose = Pose {
        rotation: [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
        position: Point::new(tool.z - ABOVE.z, -ur10::D4, ahead2.max(0.0).sqrt() - 0.51),
    };
    let level = |q: &[f64; 6]| q[0].abs() < 1e-6 || PI - q[0].abs() < 1e-6;
    ahead2 >= 0.0 && ur10::LENGTHS.inverse(&pose).iter().any(level)
}

/// A place for which `margin` is `aim`, between one in reach and one out of reach.
fn near_limit(margin: impl Fn(Point) -> f64, inside: Point, outside: Point, aim: f64) -> Option<Point> {
    if margin(inside) <= aim || margin(outside) >= aim {
        return None;
    }
    let offset = outside - inside;
    let at = |part: f64| inside + Point::new(offset.x * part, offset.y * part, offset.z * part);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..40 {
        let middle = (low + high) / 2.0;
        if margin(at(middle)) > aim { low = middle } else { high = middle }
    }
    Some(at(high))
}

/// Up to 5 mm in either direction, as often down to a picometre as not.
fn small(random: &mut Random) -> f64 {
    let size = 0.005 * libm::pow(10.0, -random.between(0.0, 9.0));
    if random.between(0.0, 1.0) < 0.5 { size } else { -size }
}

fn around(random: &mut Random, centre: Point, size: Point) -> Point {
    let mut within = |half: f64| random.between(-half, half);
    centre + Point::new(within(size.x), within(size.y), within(size.z))
}

#[test]
fn rail_arm_solves_what_its_margin_says() {
    let mut random = Random::new(11);
    for rail in [Axis::Y, Axis::X] {
        let arm = kitting(rail);
        let size = if rail == Axis::Y { Point::new(1.5, 6.2, 1.5) } else { Point::new(6.2, 1.5, 1.5) };
        let mut from = arm.start();
        let mut reached = 0;
        for _ in 0..50_000 {
            let tool = around(&mut random, KITTING, size);
            let before = from;
            assert_rail_solved(&arm, tool, &mut from);
            reached += usize::from(before != from);
        }
        assert!((10_000..45_000).contains(&reached), "{reached}");
    }
}

#[test]
fn rail_arm_within_five_millimetres_of_its_limit() {
    let mut random = Random::new(12);
    let arm = kitting(Axis::Y);
    let size = Point::new(1.6, 6.6, 1.6);
    let (mut from, mut inside, mut outside) = (arm.start(), 0, 0);
    let mut points = vec![];
    while points.len() < 10_000 {
        let aim = small(&mut random);
        let (a, b) = (around(&mut random, KITTING, size), around(&mut random, KITTING, size));
        let Some(tool) = near_limit(|p| arm.margin(p), a, b, aim) else { continue };
        if arm.margin(tool).abs() > 0.005 {
            continue;
        }
        assert_rail_solved(&arm, tool, &mut from);
        points.push(tool);
        if arm.margin(tool) < 0.0 { outside += 1 } else { inside += 1 }
    }
    assert!(inside > 3000 && outside > 3000, "{inside} {outside}");
    // Out of reach by more than the general inverse allows for rounding: no place on the rail has any solution, however the arm bends.
    for tool in points.iter().filter(|p| arm.margin(**p) < -1e-7).take(1000) {
        let places = (0..=200).map(|i| (tool.y - 1.4 + 0.014 * f64::from(i)).clamp(-4.8, 4.8));
        for place in places {
            assert!(!rail_arm_at(place, Axis::Y, *tool), "{place} {tool:?}");
        }
    }
}

/// Out of reach the margin is the distance of the wrist's best place to the limit, found by trying. In reach it is at most
/// that, and less where the plane of the arm has to turn for the tool to go on.
#[test]
fn rail_arm_margin_against_a_search() {
    let mut random = Random::new(13);
    let arm = kitting(Axis::Y);
    for _ in 0..2000 {
        let tool = around(&mut random, KITTING, Point::new(1.6, 6.2, 1.5));
        let (mut found, margin) = (f64::MIN, arm.margin(tool));
        for i in 0..=9600 {
            let (dx, dy) = (tool.x - KITTING.x, tool.y + 4.8 - 0.001 * f64::from(i));
            let square = dx * dx + dy * dy - ur10::D4 * ur10::D4;
            for wrist in [-ur10::D5, ur10::D5] {
                let out = square.max(0.0).sqrt() + wrist;
                let dz = tool.z + 0.1 - KITTING.z;
                let w = (out * out + dz * dz).sqrt();
                if square >= 0.0 {
                    found = found.max((0.612 + 0.5723 - w).min(w - (0.612 - 0.5723)));
                }
            }
        }
        let least = if found < 0.0 { found } else { 0.0 };
        assert!(margin >= least - 1e-12, "{margin} {found} {tool:?}");
        assert!(margin - found < 0.03, "{margin} {found} {tool:?}");
    }
}

#[test]
fn gantry_solves_what_its_margin_says() {
    let mut random = Random::new(14);
    let arm = gantry();
    let mut from = arm.start();
    let mut reached = 0;
    for _ in 0..100_000 {
        let tool = around(&mut random, Point::new(-7.0, 0.0, 1.8), Point::new(10.0, 7.0, 1.6));
        let before = from;
        assert_gantry_solved(&arm, tool, &mut from);
        reached += usize::from(before != from);
    }
    assert!((10_000..90_000).contains(&reached), "{reached}");
}

/// Rails so short that the torso cannot stand where it likes.
#[test]
fn gantry_with_short_rails() {
    let mut random = Random::new(15);
    for _ in 0..300 {
        let mut range = |middle: f64| {
            let half = random.between(0.001, 0.6);
            [middle - half, middle + half]
        };
        let (x, y) = (range(-7.0), range(0.0));
        let arm = Gantry::new(ABOVE, x, y);
        let mut from = arm.start();
        for _ in 0..100 {
            let tool = around(&mut random, Point::new(-7.0, 0.0, 1.8), Point::new(2.5, 2.5, 1.2));
            if let Some(joints) = arm.solve(tool, &from) {
                assert_at(&arm.tool_pose(&joints), tool);
                assert!((x[0]..=x[1]).contains(&joints[0]) && (y[0]..=y[1]).contains(&joints[1]));
                from = joints;
            }
        }
    }
}

#[test]
fn gantry_within_five_millimetres_of_its_limit() {
    let mut random = Random::new(16);
    let arm = gantry();
    let (mut from, mut inside, mut outside) = (arm.start(), 0, 0);
    let mut beyond = vec![];
    while inside + outside < 10_000 {
        let aim = small(&mut random);
        let mut place = || around(&mut random, Point::new(-7.0, 0.0, 1.8), Point::new(10.0, 7.0, 1.6));
        let (a, b) = (place(), place());
        let Some(tool) = near_limit(|p| arm.margin(p), a, b, aim) else { continue };
        if arm.margin(tool).abs() > 0.005 {
            continue;
        }
        assert_gantry_solved(&arm, tool, &mut from);
        if arm.margin(tool) < 0.0 {
            outside += 1;
            beyond.push(tool);
        } else {
            inside += 1;
            assert!(gantry_at(from[0], from[1], tool) || arm.margin(tool) < 1e-7, "{tool:?}");
        }
    }
    assert!(inside > 3000 && outside > 3000, "{inside} {outside}");
    // Out of reach by more than the general inverse allows for rounding: with the torso at the nearest place and around it, no turn has a solution at pan 0.
    for tool in beyond.iter().filter(|p| arm.margin(**p) < -1e-7).take(500) {
        for i in 0..=20 {
            let x = (tool.x - 2.0 + 0.2 * f64::from(i)).clamp(-14.4, 0.4);
            for j in 0..=20 {
                let y = (tool.y - 2.0 + 0.2 * f64::from(j)).clamp(-4.5, 4.5);
                assert!(!gantry_at(x, y, *tool), "{x} {y} {tool:?}");
            }
        }
    }
}

#[test]
fn start_joints_of_the_prototypes_gantry() {
    let joints = [-3.45, 0.0, 0.0, 0.0, -1.13, 1.88, -0.72, 1.55, 0.83];
    let tool = gantry().tool(&joints);
    let expected = Point::new(-3.616, 0.683, 1.224);
    let d = tool - expected;
    assert!(d.x.abs() < 4e-3 && d.y.abs() < 4e-3 && d.z.abs() < 1e-3, "{tool:?}");
}

#[test]
fn start_joints_of_the_prototypes_kitting_robot() {
    let tool = kitting(Axis::Y).tool(&[0.0, 0.0, -1.25, 1.74, 1.00, -1.58, 0.0]);
    let d = tool - Point::new(-0.726, 0.163, 1.529);
    assert!(d.x.abs() < 1e-3 && d.y.abs() < 2e-3 && d.z.abs() < 1e-3, "{tool:?}");
}

#[test]
fn kitting_robot_stands_square_to_its_rail_over_the_belt() {
    let arm = kitting(Axis::Y);
    let joints = arm.solve(Point::new(-0.573076, 0.591, 1.0), &arm.start()).unwrap();
    assert!((joints[0] - (0.591 - ur10::D4)).abs() < 1e-12, "{joints:?}");
    assert!(joints[1].abs() < 1e-12, "{joints:?}");
}

#[test]
fn rail_along_x_stands_square_too() {
    let arm = kitting(Axis::X);
    for (side, pan) in [(0.7, PI / 2.0), (-0.7, -PI / 2.0)] {
        let joints = arm.solve(KITTING + Point::new(0.5, side, -0.2), &arm.start()).unwrap();
        assert!((joints[1] - pan).abs() < 1e-12, "{joints:?}");
    }
}

#[test]
fn gantry_keeps_its_turn_where_it_can() {
    let arm = gantry();
    let mut from = arm.start();
    from[2] = 0.7;
    let joints = arm.solve(Point::new(-6.0, 1.0, 1.0), &from).unwrap();
    assert!((joints[2] - 0.7).abs() < 1e-12, "{joints:?}");
}

#[test]
fn start_poses_point_down() {
    for axis in [kitting(Axis::Y), kitting(Axis::X)].map(|arm| arm.tool_pose(&arm.start()).axis(2)) {
        assert!(axis.z < -1.0 + 1e-12);
    }
    assert!(gantry().tool_pose(&gantry().start()).axis(2).z < -1.0 + 1e-12);
}

#[test]
fn goals_that_are_no_places() {
    for z in [f64::NAN, f64::INFINITY, 1e300] {
        let tool = Point::new(-1.0, 0.0, z);
        assert_eq!(kitting(Axis::Y).solve(tool, &kitting(Axis::Y).start()), None);
        assert_eq!(gantry().solve(tool, &gantry().start()), None);
    }
}

fn length(a: Point, b: Point) -> f64 {
    let d = a - b;
    (d.x * d.x + d.y * d.y + d.z * d.z).sqrt()
}

/// Each link behind the first keeps its length, and its far end turns about the axis that its joint has.
fn assert_links(frames: &[Pose], first: usize) {
    let at = |i: usize| frames[first + i].position;
    let lengths = [ur10::A2, ur10::A3, ur10::D4, ur10::D5, ur10::TOOL];
    for (i, expected) in lengths.iter().enumerate() {
        let got = length(at(i), at(i + 1));
        assert!((got - expected.abs()).abs() < 1e-9, "{i}: {got} for {expected}");
    }
}

fn assert_near(a: &Pose, b: &Pose) {
    assert!(length(a.position, b.position) < 1e-12, "{a:?} {b:?}");
    let turned = a.rotation.iter().flatten().zip(b.rotation.iter().flatten());
    assert!(turned.into_iter().all(|(a, b)| (a - b).abs() < 1e-12), "{a:?} {b:?}");
}

fn axis(at: Point, motion: Motion) -> crate::part::axis::Axis {
    let (speed, acceleration, mass, effort, damping, friction) = (1.0, 1.0, 1.0, 1.0, 0.0, 0.0);
    crate::part::axis::Axis {
        on: None,
        place: Some(crate::part::axis::Place::At(at)),
        motion,
        speed,
        acceleration,
        joint: None,
        link: None,
        mass,
        effort,
        damping,
        friction,
    }
}

pub(super) fn chain() -> Chain {
    let joint = Joint {
        name: String::new(),
        link: String::new(),
        speed: 1.0,
        mass: 1.0,
        effort: 1.0,
        damping: 1.0,
        friction: 1.0,
    };
    Chain {
        on: Some(0),
        base: None,
        mount: Frame::default(),
        mounting: Mounting::Upright,
        geometry: Geometry::Ur10,
        rest: Point::default(),
        joints: vec![joint; 6],
        acceleration: 1.0,
        envelope: None,
        clearances: Vec::new(),
    }
}

#[test]
fn links_keep_their_lengths_and_end_at_the_tool() {
    let mut random = Random::new(11);
    for rail in [Axis::X, Axis::Y] {
        let rail = axis(KITTING, Motion::Slides { along: rail.into(), range: [-4.8, 4.8] });
        assert_arm(&Arm::new(&[&rail], &chain()).unwrap(), 7, &mut random);
    }
    let x = axis(ABOVE, Motion::Slides { along: Direction::X, range: [-14.4, 0.4] });
    let y = axis(ABOVE, Motion::Slides { along: Direction::Y, range: [-4.5, 4.5] });
    let torso = axis(ABOVE, Motion::Turns);
    assert_arm(&Arm::new(&[&x, &y, &torso], &chain()).unwrap(), 9, &mut random);
    assert!(Arm::new(&[&y, &x, &torso], &chain()).is_none());
}

#[test]
fn the_links_of_other_arms_end_at_the_tool_too() {
    let mut random = Random::new(12);
    let base = Frame::new(Point::new(0.4, -0.3, 0.7), 35.0);
    let fixed = |geometry, mounting| {
        let geometry = Geometry::Fixed(Box::new(geometry), None);
        Chain { on: None, base: Some(base), mounting, geometry, ..chain() }
    };
    let ur = Lengths { d1: 0.1807, a2: -0.6127, a3: -0.57155, d4: 0.17415, d5: 0.11985, tool: 0.26655 };
    let opw = Opw {
        a1: 0.15,
        a2: -0.11,
        b: 0.02,
        c1: 0.4865,
        c2: 0.7,
        c3: 0.678,
        tool: 0.235,
        offsets: [0.0, 0.0, -1.5, 0.0, 0.2, PI],
        signs: [1.0, -1.0, 1.0, -1.0, 1.0, 1.0],
    };
    for geometry in [fixed::Geometry::UniversalRobots(ur), fixed::Geometry::OrthoParallel(opw)] {
        for mounting in [Mounting::Upright, Mounting::Hung] {
            assert_composed(&Arm::new(&[], &fixed(geometry, mounting)).unwrap(), 6, &mut random);
        }
    }
    let place = Some(Place::From(base));
    let slide = |along, place| crate::part::axis::Axis {
        place,
        ..axis(ABOVE, Motion::Slides { along, range: [-1.0, 1.0] })
    };
    let axes = [slide(Direction::Y, place), slide(Direction::Z, None), slide(Direction::X, None)];
    let axes: Vec<_> = axes.iter().collect();
    for count in 1..=3 {
        let tool = Chain { geometry: Geometry::Tool(0.2), joints: Vec::new(), ..chain() };
        assert_composed(&Arm::new(&axes[..count], &tool).unwrap(), count, &mut random);
    }
}

fn assert_composed(arm: &Arm, count: usize, random: &mut Random) {
    for _ in 0..1000 {
        let joints: Vec<f64> = (0..count).map(|_| random.between(-TAU, TAU)).collect();
        let frames = arm.frames(&Joints::new(&joints));
        assert_eq!(frames.len(), count);
        assert_eq!(frames.last(), Some(&arm.tool_pose(&Joints::new(&joints))));
        let mut composed = Pose::IDENTITY;
        for ((link, value), frame) in arm.links().iter().zip(&joints).zip(frames.iter()) {
            composed = composed.then(&link.frame(*value));
            assert_near(&composed, frame);
        }
    }
}

fn assert_arm(arm: &Arm, count: usize, random: &mut Random) {
    assert_composed(arm, count, random);
    for _ in 0..1000 {
        let joints: Vec<f64> = (0..count).map(|_| random.between(-TAU, TAU)).collect();
        let frames = arm.frames(&Joints::new(&joints));
        assert_links(&frames, count - 6);
        // A joint moves the links from its own on, and none before it.
        for moved in 0..count {
            let mut other = joints.clone();
            other[moved] += 0.3;
            let other = arm.frames(&Joints::new(&other));
            for i in 0..count {
                assert_eq!(frames[i] == other[i], i < moved, "joint {moved}, link {i}");
            }
        }
    }
}
