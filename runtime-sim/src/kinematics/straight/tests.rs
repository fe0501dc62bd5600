use super::super::fixed;
use super::super::random::Random;
use super::super::tests;
use super::super::ur::Lengths;
use super::*;
use crate::frame::Frame;
use crate::part::chain::{Chain, Geometry};
use std::f64::consts::FRAC_PI_2;

const UR10E: Lengths =
    Lengths { d1: 0.1807, a2: -0.6127, a3: -0.57155, d4: 0.17415, d5: 0.11985, tool: 0.11655 + 0.15 };

fn arm(base: Frame, ranges: Option<[[f64; 2]; fixed::JOINTS]>) -> Arm {
    let geometry = Geometry::Fixed(Box::new(fixed::Geometry::UniversalRobots(UR10E)), ranges.map(Box::new));
    let chain = Chain { on: None, base: Some(base), geometry, ..tests::chain() };
    Arm::new(&[], &chain).expect("an arm")
}

/// How far the tool is off the straight line between two places while it goes through these joints, m.
fn off_line(arm: &Arm, from: &Joints, knots: &[Joints], goal: Point) -> f64 {
    let start = arm.tool(from);
    let line = goal - start;
    let mut last = *from;
    let mut most: f64 = 0.0;
    for knot in knots {
        for part in 1..=8 {
            let joints = last.map(|i, value| value + (knot[i] - value) * f64::from(part) / 8.0);
            let way = arm.tool(&joints) - start;
            let along = if line.length() > 0.0 { way.dot(line) / line.dot(line) } else { 0.0 };
            assert!((-0.01..1.01).contains(&along), "{along}");
            most = most.max((way - line.scaled(along)).length());
        }
        last = *knot;
    }
    most
}

#[test]
fn lines_up_and_down_are_straight_or_refused() {
    let mut random = Random::new(61);
    let arm = arm(Frame::default(), None);
    let (mut straight, mut refused) = (0, 0);
    for _ in 0..20_000 {
        let mut drawn = || random.between(-1.2, 1.2);
        let (x, y) = (drawn(), drawn());
        let [begin, goal] = [Point::new(x, y, drawn()), Point::new(x, y, drawn())];
        let Some(joints) = arm.solve(begin, &arm.start()) else { continue };
        match arm.line_to(goal, &joints) {
            Ok(knots) => {
                let off = off_line(&arm, &joints, &knots, goal);
                assert!(off < 0.001, "{off} from {begin:?} to {goal:?}");
                assert!((arm.tool(&knots[knots.len() - 1]) - goal).length() < 1e-6);
                straight += 1;
            }
            Err(Missed::NotStraight) => {
                let at_once = arm.solve(goal, &joints).expect("in reach");
                let turns = at_once.iter().zip(joints.iter()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(turns > 1.0, "{turns} from {begin:?} to {goal:?}");
                refused += 1;
            }
            Err(Missed::OutOfReach) => assert!(arm.margin(goal) < 0.0, "{goal:?}"),
        }
    }
    assert!(straight > 4_000 && refused < straight, "{straight} {refused}");
}

/// The line goes on as it began, with the elbow down, though there are joints with the elbow up.
#[test]
fn an_arm_bends_in_the_same_way_to_the_end_of_a_line() {
    let arm = arm(Frame::default(), None);
    let [high, low] = [0.6, 0.3].map(|z| Point::new(0.7, 0.2, z));
    let up = arm.solve(high, &arm.start()).expect("in reach");
    let down = arm.solve_near(
        high,
        Facing::Down,
        &up.map(|i, value| match i {
            1 => value + 1.5,
            2 => -value,
            _ => value,
        }),
    );
    let down = down.expect("in reach");
    assert!(up[2] * down[2] < 0.0, "{up:?} {down:?}");
    for from in [up, down] {
        let knots = arm.line_to(low, &from).expect("a line");
        assert!(knots.iter().all(|joints| joints[2] * from[2] > 0.0), "{knots:?}");
        assert!(off_line(&arm, &from, &knots, low) < 2e-4);
        let stays = arm.line_to(high, &from).expect("the same place");
        assert!(stays[0].iter().zip(from.iter()).all(|(a, b)| (a - b).abs() < 1e-6));
    }
}

/// A tool that points to a side does not have to come down in a straight line.
#[test]
fn a_tool_that_turns_goes_at_once() {
    let arm = arm(Frame::default(), None);
    let place = Point::new(0.6, 0.2, 0.5);
    let level = arm.solve_facing(place, Facing::Level { x: 1.0, y: 0.0 }, &arm.start()).expect("in reach");
    assert_eq!(arm.line_to(place.up(-0.2), &level).expect("in reach").len(), 1);
}

/// A tool with a turn of its own gives it up with a line that has none, so it does not go straight.
#[test]
fn a_tool_that_is_turned_goes_at_once() {
    let arm = arm(Frame::default(), None);
    let [high, low] = [0.6, 0.3].map(|z| Point::new(0.7, 0.2, z));
    let across = Facing::oriented(FRAC_PI_2).expect("a number");
    let from = arm.solve_facing(high, across, &arm.start()).expect("in reach");
    assert_eq!(arm.line_to(low, &from).expect("in reach").len(), 1);
    let knots = arm.line_facing(low, across, &from).expect("a line");
    assert!(knots.len() > 1 && off_line(&arm, &from, &knots, low) < 1e-3);
}
