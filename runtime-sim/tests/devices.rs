//! Each device alone.

mod common;

use common::*;
use runtime_sim::carrier::Carrier;
use runtime_sim::device::error;
use runtime_sim::event::{Event, OrderChange};
use runtime_sim::line::{Line, Obstacle, Order, Refusal, Slip, Supply};
use runtime_sim::point::Point;

fn near(a: Point, b: Point) -> bool {
    let d = a - b;
    d.x.abs() < 1e-9 && d.y.abs() < 1e-9 && d.z.abs() < 1e-9
}

// --- commands

/// Height of a tray over the vehicle's position.
const TRAY_SURFACE: f64 = 0.755;

/// Slot `i` of a tray, from the vehicle's position.
fn slot(i: usize) -> Point {
    line().machines[AGV].places().next().unwrap().slots[i]
}

#[test]
fn a_command_is_accepted_ended_and_counted_round() {
    let mut rig = Rig::new(&line());
    rig.outputs[BELT][output::CMD] = 32766.0;
    rig.command(BELT, DRIVE, None);
    rig.step(1);
    assert_eq!(rig.image(BELT)[..4], [1.0, 32767.0, 32767.0, 0.0]);
    assert_eq!(rig.image(BELT)[input::MOVING], 1.0);
    rig.command(BELT, HALT, None);
    rig.step(1);
    assert_eq!(rig.image(BELT)[..4], [1.0, 1.0, 1.0, 0.0]);
    assert_eq!(rig.image(BELT)[input::MOVING], 0.0);
}

#[test]
fn arguments_without_a_new_number_do_nothing() {
    let mut rig = Rig::new(&line());
    rig.outputs[BELT][output::VERB] = DRIVE;
    rig.step(10);
    assert_eq!(rig.image(BELT)[input::MOVING], 0.0);
    assert_eq!(rig.image(BELT)[input::GOT], 0.0);
}

#[test]
fn the_newest_command_replaces_the_running_one() {
    let mut rig = Rig::new(&line());
    rig.command(AGV, MOVE, Some(NEAR));
    rig.step(200);
    rig.command(AGV, MOVE, Some(START));
    rig.step(1);
    assert_eq!(rig.image(AGV)[input::GOT..=input::ACK], [2.0, 0.0]);
    rig.finish(AGV);
    assert_eq!(point(rig.image(AGV), input::POS), START);
}

#[test]
fn a_refused_command_ends_at_once() {
    let mut line = line();
    line.scenario.refusals = vec![Refusal { machine: AGV, command: 2 }];
    let mut rig = Rig::new(&line);
    assert_eq!(rig.go(AGV, MOVE, NEAR), 0.0);
    rig.command(AGV, MOVE, Some(START));
    rig.step(1);
    assert_eq!(rig.image(AGV)[1..4], [2.0, 2.0, f64::from(error::REFUSED)]);
    rig.step(500);
    assert_eq!(point(rig.image(AGV), input::POS), NEAR);
    assert_eq!(rig.go(AGV, MOVE, START), 0.0);
    assert_eq!(rig.go(AGV, 7.0, START), f64::from(error::REFUSED), "no such verb");
}

#[test]
fn numbers_from_nowhere_do_no_harm() {
    let mut rig = Rig::new(&line());
    for value in [f64::NAN, f64::INFINITY, -1e300, 1e300, -7.0, 0.5] {
        for image in &mut rig.outputs {
            image.fill(value);
        }
        rig.step(30);
        for image in &mut rig.outputs {
            image.fill(0.0);
        }
        for machine in [BELT, KITTING, AGV, GANTRY] {
            rig.outputs[machine][output::CMD] = 77.0;
            rig.outputs[machine][output::VERB] = 1.0;
            if let Some(x) = rig.outputs[machine].get_mut(output::GOAL) {
                *x = value;
            }
        }
        rig.step(30);
    }
}

// --- belt

#[test]
fn parts_appear_a_pitch_apart_while_the_belt_runs() {
    let mut rig = Rig::new(&line());
    rig.command(BELT, DRIVE, None);
    rig.step(199);
    assert_eq!(rig.plant.place(0), None);
    rig.step(1);
    assert_eq!(rig.plant.place(0), Some(Point::new(-0.573076, 4.3, 0.875)));
    rig.step(100);
    rig.outputs[BELT][output::HOLD] = 1.0;
    rig.step(1000);
    assert!(near(rig.plant.place(0).unwrap(), Point::new(-0.573076, 4.1, 0.875)));
    rig.outputs[BELT][output::HOLD] = 0.0;
    rig.step(99);
    assert_eq!(rig.plant.place(1), None);
    rig.step(1);
    let (first, second) = (rig.plant.place(0).unwrap(), rig.plant.place(1).unwrap());
    assert!((second.y - 4.3).abs() < 1e-12 && (second.y - first.y - 0.4).abs() < 1e-12);
}

#[test]
fn the_first_part_may_appear_earlier_or_later_than_the_next() {
    for (first_s, scans) in [(0.0, 1), (0.5, 50), (8.0, 800)] {
        let mut line = line();
        line.scenario.spawn_first_s = first_s;
        let mut rig = Rig::new(&line);
        rig.command(BELT, DRIVE, None);
        rig.step(scans - 1);
        assert_eq!(rig.plant.place(0), None, "{first_s}");
        rig.step(1);
        let first = rig.plant.place(0).unwrap();
        let travelled = 0.01 * scans as f64 - first_s;
        assert!(near(first, Point::new(-0.573076, 4.3 - 0.2 * travelled, 0.875)), "{first:?}");
        rig.step(199);
        assert_eq!(rig.plant.place(1).is_some(), scans == 1);
        rig.step(1);
        let (first, second) = (rig.plant.place(0).unwrap(), rig.plant.place(1).unwrap());
        assert!((second.y - first.y - 0.4).abs() < 1e-12);
    }
}

#[test]
fn a_scan_that_divides_no_second_spawns_at_the_same_places() {
    let mut line = line();
    line.scan_ms = 7;
    let mut rig = Rig::new(&line);
    rig.command(BELT, DRIVE, None);
    rig.step(1000);
    // 7 s: the parts appeared at 2 s and 4 s.
    assert!((rig.plant.place(0).unwrap().y - 3.3).abs() < 1e-12);
    assert!((rig.plant.place(1).unwrap().y - 3.7).abs() < 1e-12);
}

#[test]
fn the_camera_sees_a_part_wholly_in_the_zone_and_the_foremost_of_a_kind() {
    let mut line = line();
    line.scenario.supply = vec![Supply { belt: BELT, items: vec![BATTERY, BATTERY, PUMP] }];
    let mut rig = Rig::new(&line);
    rig.command(BELT, DRIVE, None);
    // From 4.3 to 0.56 - 0.07 at 0.2 m/s, after the 2 s until it appears: 21.05 s.
    rig.step(2104);
    assert_eq!(rig.image(BELT)[input::SEES], 0.0);
    // It lies on the very edge of the zone in scan 2105.
    rig.step(2);
    assert_eq!(rig.image(BELT)[input::SEES], 1.0);
    rig.step(249);
    assert!(near(point(rig.image(BELT), input::SEEN_AT), rig.plant.place(0).unwrap()), "not the second one");
    assert_eq!(rig.image(BELT)[input::SEES + PUMP], 0.0);
    rig.command(BELT, HALT, None);
    rig.step(1);
    let stands = rig.image(BELT).to_vec();
    rig.step(100);
    assert_eq!(rig.image(BELT), stands);
    // The first battery leaves the zone at its lower end, at 2 + 4.79 / 0.2 = 25.95 s.
    rig.command(BELT, DRIVE, None);
    rig.step(2594 - 2355);
    assert!(near(point(rig.image(BELT), input::SEEN_AT), rig.plant.place(0).unwrap()));
    rig.step(2);
    assert!(near(point(rig.image(BELT), input::SEEN_AT), rig.plant.place(1).unwrap()));
}

#[test]
fn a_long_part_is_seen_later() {
    let mut line = line();
    line.kinds[BATTERY].size = [0.06, 0.3];
    let mut rig = Rig::new(&line);
    rig.command(BELT, DRIVE, None);
    // From 4.3 to 0.56 - 0.15 at 0.2 m/s, after the 2 s until it appears: 21.45 s.
    rig.step(2144);
    assert_eq!(rig.image(BELT)[input::SEES], 0.0);
    rig.step(2);
    assert_eq!(rig.image(BELT)[input::SEES], 1.0);
}

#[test]
fn what_nobody_takes_ends_in_the_collector() {
    let mut rig = Rig::new(&line());
    rig.command(BELT, DRIVE, None);
    // 4.3 + 4.53 m at 0.2 m/s, after 2 s: 46.15 s.
    rig.step(4614);
    assert!(rig.plant.place(0).is_some());
    rig.step(1);
    assert_eq!(rig.plant.items()[0].carrier, Carrier::Sink { machine: 0, part: 2 });
    assert!(rig.plant.is_busy());
    rig.step(200);
    assert_eq!(rig.plant.items()[1].carrier, Carrier::Sink { machine: 0, part: 2 });
    assert!(!rig.plant.is_busy(), "nothing more to come");
}

// --- vehicle

#[test]
fn a_vehicle_starts_after_its_latency_and_keeps_its_speed() {
    let mut rig = Rig::new(&line());
    assert_eq!(rig.image(AGV)[input::AT_STOP], 0.0);
    rig.command(AGV, MOVE, Some(NEAR));
    rig.step(75);
    assert_eq!(point(rig.image(AGV), input::POS), START);
    assert_eq!(rig.image(AGV)[input::AT_STOP], 0.0);
    rig.step(1);
    assert_eq!(rig.image(AGV)[input::AT_STOP], -1.0);
    rig.step(150 - 1);
    let middle = START.x - 3.334 / 2.0;
    assert!((rig.image(AGV)[input::POS] - middle).abs() < 1e-9);
    // 0.75 s and 3.334315 m at 3.334 m in 3 s: 3.7503 s.
    assert_eq!(rig.finish(AGV) + 225, 376);
    assert_eq!(point(rig.image(AGV), input::POS), NEAR);
    assert_eq!(rig.image(AGV)[input::AT_STOP], 1.0);
}

#[test]
fn a_vehicle_that_passes_a_stop_does_not_stand_there() {
    let mut line = line();
    line.scan_ms = 1; // it is within a millimetre of the near stop in some scan
    let mut rig = Rig::new(&line);
    rig.command(AGV, MOVE, Some(Point::new(-10.590274, START.y, 0.0)));
    let mut nearest = f64::INFINITY;
    while rig.image(AGV)[input::AT_STOP] != 2.0 {
        rig.step(1);
        let position = point(rig.image(AGV), input::POS);
        nearest = nearest.min((position.x - NEAR.x).abs());
        assert_ne!(rig.image(AGV)[input::AT_STOP], 1.0);
        assert!(position.x > -11.0);
    }
    assert!(nearest < 0.001);
    assert!(rig.is_ended(AGV));
}

#[test]
fn a_held_vehicle_stands_and_goes_on() {
    for halt in [10, 75, 76, 200, 375] {
        let mut rig = Rig::new(&line());
        rig.command(AGV, MOVE, Some(NEAR));
        rig.step(halt);
        let stands = point(rig.image(AGV), input::POS);
        rig.outputs[AGV][output::HOLD] = 1.0;
        rig.step(1000);
        assert_eq!(point(rig.image(AGV), input::POS), stands);
        assert!(!rig.is_ended(AGV));
        rig.outputs[AGV][output::HOLD] = 0.0;
        assert_eq!(rig.finish(AGV) + halt, 376);
    }
}

#[test]
fn a_vehicle_goes_to_stops_only() {
    let mut rig = Rig::new(&line());
    assert_eq!(rig.go(AGV, MOVE, NEAR + Point::new(0.002, 0.0, 0.0)), f64::from(error::UNREACHABLE));
    assert_eq!(rig.go(AGV, MOVE, Point::new(f64::NAN, 0.0, 0.0)), f64::from(error::UNREACHABLE));
    assert_eq!(rig.go(AGV, MOVE, NEAR + Point::new(0.0009, 0.0, 0.0)), 0.0);
    assert_eq!(point(rig.image(AGV), input::POS), NEAR);
}

// --- arm and gripper

#[test]
fn an_arm_begins_at_rest() {
    let line = line();
    let rig = Rig::new(&line);
    for arm in [KITTING, GANTRY] {
        let rest = line.machines[arm].chain().unwrap().rest;
        assert!(near(point(rig.image(arm), input::TOOL), rest), "{rest:?} {:?}", rig.image(arm));
    }
}

#[test]
fn an_unreachable_goal_is_answered_at_once() {
    let mut rig = Rig::new(&line());
    for (arm, goal) in [(KITTING, Point::new(1.0, 0.0, 1.0)), (GANTRY, Point::new(-4.0, 0.0, 9.0))] {
        let tool = point(rig.image(arm), input::TOOL);
        rig.command(arm, MOVE, Some(goal));
        rig.step(1);
        assert_eq!(rig.image(arm)[1..4], [1.0, 1.0, f64::from(error::UNREACHABLE)]);
        rig.command(arm, PICK, Some(Point::new(f64::NAN, 0.0, 0.0)));
        rig.step(1);
        assert_eq!(rig.image(arm)[1..4], [2.0, 2.0, f64::from(error::UNREACHABLE)]);
        assert_eq!(point(rig.image(arm), input::TOOL), tool);
    }
}

#[test]
fn a_part_is_gripped_carried_and_put_on_a_tray_that_travels() {
    let mut rig = Rig::new(&line());
    rig.pick_from_belt(BATTERY);
    assert!(matches!(rig.plant.items()[0].carrier, Carrier::Grip { machine: KITTING, .. }));
    assert_eq!(rig.image(BELT)[input::SEES], 0.0);
    let here = START + slot(3);
    assert_eq!(rig.go(KITTING, MOVE, grip_point(here, BATTERY).up(0.3)), 0.0);
    assert!(near(rig.plant.place(0).unwrap(), here.up(0.3)));
    assert_eq!(rig.go(KITTING, MOVE, grip_point(here, BATTERY)), 0.0);
    rig.let_go(KITTING);
    assert_eq!(rig.image(KITTING)[input::ATTACHED], 0.0);
    assert!(matches!(rig.plant.items()[0].carrier, Carrier::Place { machine: AGV, .. }));
    assert!(near(rig.plant.place(0).unwrap(), here));
    assert_eq!(rig.go(KITTING, MOVE, grip_point(here, BATTERY).up(0.3)), 0.0);
    assert_eq!(rig.go(AGV, MOVE, NEAR), 0.0);
    assert!(near(rig.plant.place(0).unwrap(), NEAR + slot(3)));
}

#[test]
fn two_polls_with_contact_attach() {
    let mut rig = Rig::new(&line());
    let at = grip_point(rig.bring(BATTERY), BATTERY);
    rig.go(KITTING, MOVE, at);
    // To a moment just after a poll.
    rig.step(1);
    let scans = (0..100).find(|_| {
        rig.outputs[KITTING][output::GRIP] = 1.0;
        rig.step(1);
        rig.image(KITTING)[input::ATTACHED] != 0.0
    });
    let scans = scans.unwrap() + 1;
    assert!((11..=20).contains(&scans), "{scans}");
}

#[test]
fn a_pick_of_nothing_ends_in_error_half_a_second_after_it_arrives() {
    let mut rig = Rig::new(&line());
    let goal = Point::new(-0.573076, 0.3, 1.2);
    rig.command(KITTING, MOVE, Some(goal));
    let moving = rig.finish(KITTING);
    rig.go(KITTING, MOVE, line().machines[KITTING].chain().unwrap().rest);
    rig.outputs[KITTING][output::GRIP] = 1.0;
    rig.command(KITTING, PICK, Some(goal));
    let picking = rig.finish(KITTING);
    assert_eq!(rig.image(KITTING)[input::ERROR], f64::from(error::NO_PART));
    assert_eq!(picking, moving + 50);
}

#[test]
fn contact_ends_five_millimetres_away() {
    for (gap, error) in [(0.0049, 0), (0.0051, error::NO_PART)] {
        let mut rig = Rig::new(&line());
        let at = grip_point(rig.bring(BATTERY), BATTERY);
        rig.outputs[KITTING][output::GRIP] = 1.0;
        assert_eq!(rig.go(KITTING, PICK, at.up(gap)), f64::from(error));
    }
}

#[test]
fn what_is_let_go_falls_on_what_is_below() {
    let over = |x: f64, y: f64| Point::new(x, y, 1.2 + BATTERY_HEIGHT);
    for (place, carrier, height) in [
        // Let go below the surface.
        (Point::new(-0.573076, 0.7, 0.8 + BATTERY_HEIGHT), "Floor", 0.0),
        (over(-0.573076 + 0.2, 0.7), "Lane { machine: 0,", 0.875),
        (over(-0.573076 - 0.22, 0.7), "Floor", 0.0),
        (over(START.x + 0.15 + 0.34, START.y - 0.24), "Place { machine: 2,", TRAY_SURFACE),
        (over(START.x + 0.15 + 0.36, START.y), "Floor", 0.0),
        (over(START.x, START.y), "Place { machine: 2,", TRAY_SURFACE),
        (over(-1.899 + 0.29, 2.565), "Place { machine: 5,", 0.725),
        (over(-1.9 + 0.19, -2.0), "Floor", 0.6),
        (over(-1.9 + 0.21, -2.0), "Floor", 0.0),
    ] {
        let mut line = line();
        // A bin below the vehicle: the tray is higher.
        let below = machines::machine("below", &machines::bin(START));
        line.machines.push(below);
        let (pose, size) = (Point::new(-1.9, -2.0, 0.0), Some(Point::new(0.4, 0.4, 0.6)));
        line.obstacles.push(Obstacle { name: "box".into(), pose, size });
        let mut rig = Rig::new(&line);
        rig.pick_from_belt(BATTERY);
        assert_eq!(rig.go(KITTING, MOVE, place), 0.0, "{place:?}");
        rig.let_go(KITTING);
        let item = &rig.plant.items()[0];
        assert!(format!("{:?}", item.carrier).starts_with(carrier), "{place:?} {item:?}");
        let rests = rig.plant.place(0).unwrap();
        assert!(near(rests, Point { z: height, ..place }), "{rests:?}");
    }
}

#[test]
fn a_part_put_back_on_the_belt_travels_on() {
    let mut rig = Rig::new(&line());
    rig.pick_from_belt(BATTERY);
    rig.go(KITTING, MOVE, Point::new(-0.55, 0.4, 0.875 + BATTERY_HEIGHT));
    rig.let_go(KITTING);
    rig.go(KITTING, MOVE, Point::new(-0.55, 0.4, 1.3));
    rig.command(BELT, DRIVE, None);
    rig.step(100);
    assert!(near(rig.plant.place(0).unwrap(), Point::new(-0.55, 0.2, 0.875)));
}

#[test]
fn a_gripper_that_waits_takes_what_comes_to_it() {
    let at = Rig::new(&line()).bring(BATTERY);
    let mut rig = Rig::new(&line());
    rig.go(KITTING, MOVE, grip_point(at, BATTERY));
    rig.outputs[KITTING][output::GRIP] = 1.0;
    rig.step(300);
    assert!(near(rig.bring(BATTERY), at));
    rig.step(100);
    assert_eq!(rig.image(KITTING)[input::ATTACHED], 1.0);
}

#[test]
fn a_slip_loses_the_part_it_names() {
    let mut line = line();
    line.scenario.slips = vec![Slip { machine: KITTING, pick: 2, after_s: 0.3 }];
    let mut rig = Rig::new(&line);
    rig.pick_from_belt(BATTERY);
    rig.go(KITTING, MOVE, Point::new(-1.0, 1.0, 1.3));
    rig.step(100);
    assert_eq!(rig.image(KITTING)[input::ATTACHED], 1.0);
    rig.let_go(KITTING);
    assert!(matches!(rig.plant.items()[0].carrier, Carrier::Floor { .. }));
    let at = grip_point(rig.bring(PUMP), PUMP);
    rig.go(KITTING, MOVE, at.up(0.3));
    rig.outputs[KITTING][output::GRIP] = 1.0;
    rig.go(KITTING, PICK, at);
    rig.go(KITTING, MOVE, at.up(0.3));
    assert_eq!(rig.image(KITTING)[input::ATTACHED], 0.0);
    assert!(matches!(rig.plant.items()[1].carrier, Carrier::Lane { .. }), "{:?}", rig.plant.items()[1]);
}

#[test]
fn a_held_arm_brakes_on_its_path_and_ends_at_its_goal() {
    let goal = Point::new(-0.6, 3.0, 1.2);
    let mut rig = Rig::new(&line());
    rig.command(KITTING, MOVE, Some(goal));
    let whole = rig.finish(KITTING);
    for halt in [1, whole / 4, whole / 2, whole - 2] {
        let mut rig = Rig::new(&line());
        rig.command(KITTING, MOVE, Some(goal));
        rig.step(halt);
        rig.outputs[KITTING][output::HOLD] = 1.0;
        // Accelerations are 1 m/s2 at 1 m/s: it stands within a second or two.
        rig.step(300);
        let stands = point(rig.image(KITTING), input::TOOL);
        rig.step(300);
        assert_eq!(point(rig.image(KITTING), input::TOOL), stands);
        assert!(!rig.is_ended(KITTING), "held at {halt}");
        rig.outputs[KITTING][output::HOLD] = 0.0;
        rig.finish(KITTING);
        assert!(near(point(rig.image(KITTING), input::TOOL), goal));
        assert_eq!(rig.image(KITTING)[1..4], [1.0, 1.0, 0.0]);
    }
}

#[test]
fn a_new_goal_on_the_way_is_reached_without_a_jump() {
    let mut rig = Rig::new(&line());
    rig.command(KITTING, MOVE, Some(Point::new(-0.6, 3.0, 1.2)));
    rig.step(149);
    let before = point(rig.image(KITTING), input::TOOL);
    rig.step(1);
    let mut last = point(rig.image(KITTING), input::TOOL);
    let mut last_step = last - before;
    assert!(last_step.y > 0.005, "at speed");
    rig.command(KITTING, MOVE, Some(Point::new(-0.6, -3.0, 1.2)));
    for _ in 0..5000 {
        rig.step(1);
        let now = point(rig.image(KITTING), input::TOOL);
        let step = now - last;
        // 1 m/s2 of the rail is 0.1 mm in a scan; a jump from 1 m/s to rest would be 10 mm.
        let change = step - last_step;
        assert!(change.x.abs() + change.y.abs() + change.z.abs() < 0.001, "{change:?}");
        (last, last_step) = (now, step);
    }
    assert!(rig.is_ended(KITTING));
    assert!(near(last, Point::new(-0.6, -3.0, 1.2)));
}

#[test]
fn one_gripper_does_not_take_from_another() {
    let mut rig = Rig::new(&line());
    rig.pick_from_belt(BATTERY);
    let meet = Point::new(-2.0, 1.3, 1.2);
    rig.go(KITTING, MOVE, meet);
    rig.outputs[GANTRY][output::GRIP] = 1.0;
    assert_eq!(rig.go(GANTRY, PICK, meet), f64::from(error::NO_PART));
    assert_eq!(rig.image(GANTRY)[input::ATTACHED], 0.0);
}

#[test]
fn a_pick_that_waits_does_not_end_while_it_is_held() {
    let mut rig = Rig::new(&line());
    let goal = Point::new(-0.573076, 0.3, 1.2);
    rig.go(KITTING, MOVE, goal);
    rig.command(KITTING, PICK, Some(goal));
    rig.step(20);
    rig.outputs[KITTING][output::HOLD] = 1.0;
    rig.step(200);
    assert!(!rig.is_ended(KITTING));
    rig.outputs[KITTING][output::HOLD] = 0.0;
    // The scan in which it arrives, and half a second.
    assert_eq!(rig.finish(KITTING) + 20, 51);
}

// --- pace, turns and places to pass

#[test]
fn a_pace_holds_for_all_later_motions() {
    let (there, back) = (Point::new(-0.6, 3.0, 1.2), Point::new(-0.6, -1.0, 1.2));
    let scans = |rig: &mut Rig, goal: Point| {
        rig.command(KITTING, MOVE, Some(goal));
        rig.finish(KITTING)
    };
    let mut rig = Rig::new(&line());
    rig.go(KITTING, MOVE, there);
    // 4 m of rail at 1 m/s, with 1 m/s2: 5 s.
    assert_eq!(scans(&mut rig, back), 500);
    assert_eq!(rig.pace(KITTING, 0.1, 2.0), 0.0);
    assert_eq!(scans(&mut rig, there), 4005);
    assert_eq!(scans(&mut rig, back), 4005);
    assert_eq!(rig.pace(KITTING, 1.0, 1.0), 0.0);
    assert_eq!(scans(&mut rig, there), 500);
}

#[test]
fn a_pace_out_of_range_is_refused() {
    let mut rig = Rig::new(&line());
    let refused = f64::from(error::REFUSED);
    for (speed, gain) in [
        (0.0, 1.0),
        (-0.5, 1.0),
        (1.000001, 1.0),
        (f64::NAN, 1.0),
        (f64::INFINITY, 1.0),
        (1e-310, 1.0),
        (1.0, 0.0),
        (1.0, -1.0),
        (1.0, 100.1),
        (1.0, f64::NAN),
    ] {
        for arm in [KITTING, GANTRY] {
            assert_eq!(rig.pace(arm, speed, gain), refused, "{speed} {gain}");
        }
    }
    for (speed, gain) in [(f64::MIN_POSITIVE, f64::MIN_POSITIVE), (f64::MIN_POSITIVE, 100.0), (1.0, 100.0)] {
        assert_eq!(rig.pace(KITTING, speed, gain), 0.0, "{speed} {gain}");
        rig.command(KITTING, MOVE, Some(Point::new(-0.6, 3.0, 1.2)));
        rig.step(50);
        assert!(point(rig.image(KITTING), input::TOOL).y.is_finite());
        rig.outputs[KITTING][output::HOLD] = 1.0;
        rig.step(50);
        rig.outputs[KITTING][output::HOLD] = 0.0;
        rig.step(50);
        assert!(!rig.is_ended(KITTING));
        if speed == 1.0 {
            assert!(rig.finish(KITTING) < 1000);
        }
        rig = Rig::new(&line());
    }
}

#[test]
fn a_pace_on_the_way_is_refused_and_the_arm_brakes() {
    let mut rig = Rig::new(&line());
    let goal = Point::new(-0.6, 3.0, 1.2);
    rig.command(KITTING, MOVE, Some(goal));
    rig.step(100);
    assert_eq!(rig.pace(KITTING, 0.1, 1.0), f64::from(error::REFUSED));
    rig.step(300);
    let stands = point(rig.image(KITTING), input::TOOL);
    rig.step(100);
    assert_eq!(point(rig.image(KITTING), input::TOOL), stands);
    assert!(!near(stands, goal));
    rig.command(KITTING, MOVE, Some(goal));
    assert!(rig.finish(KITTING) < 500, "at full speed, as before");
}

#[test]
fn the_torso_turns_as_far_as_it_is_told() {
    use std::f64::consts::PI;
    let mut rig = Rig::new(&line());
    let goal = Point::new(-5.6, 0.5, 1.0);
    let turn = |rig: &mut Rig, turn: f64, goal: Point| {
        rig.outputs[GANTRY][output::TURN] = turn;
        rig.command(GANTRY, TURN_TO, Some(goal));
        let scans = rig.finish(GANTRY);
        (rig.image(GANTRY)[input::ERROR], scans)
    };
    for angle in [PI / 2.0, PI, 0.0, -PI / 2.0, 2.0 * PI] {
        assert_eq!(turn(&mut rig, angle, goal).0, 0.0, "{angle}");
        assert!(near(point(rig.image(GANTRY), input::TOOL), goal), "{angle}");
    }
    assert_eq!(turn(&mut rig, PI, goal).0, 0.0);
    // pi and -pi are one place and two values of the joint: a whole turn at pi/4 rad/s.
    let (error, scans) = turn(&mut rig, -PI, goal);
    assert_eq!(error, 0.0);
    assert!((800..900).contains(&scans), "{scans}");
    let unreachable = f64::from(error::UNREACHABLE);
    for (angle, goal) in [
        (2.0 * PI + 1e-9, goal),
        (f64::NAN, goal),
        (0.0, Point::new(f64::NAN, 0.0, 1.0)),
        // The torso would be at y = -4.5 - 0.637.
        (0.0, Point::new(-5.6, -4.5, 1.0)),
        (0.0, Point::new(-5.6, 0.5, 0.6)),
    ] {
        assert_eq!(turn(&mut rig, angle, goal).0, unreachable, "{angle} {goal:?}");
    }
    assert_eq!(turn(&mut rig, PI, Point::new(-5.6, -4.5, 1.0)).0, 0.0);
    assert_eq!(rig.go(KITTING, TURN_TO, Point::new(-0.6, 1.0, 1.2)), f64::from(error::REFUSED), "no torso");
}

#[test]
fn an_arm_passes_a_place_without_a_stop() {
    let (via, goal) = (Point::new(-0.6, 1.5, 1.5), Point::new(-0.6, 3.0, 1.1));
    let mut rig = Rig::new(&line());
    rig.command(KITTING, MOVE, Some(via));
    let first = rig.finish(KITTING);
    rig.command(KITTING, MOVE, Some(goal));
    let with_a_stop = first + rig.finish(KITTING);
    let distance = |a: Point| {
        let d = a - via;
        (d.x * d.x + d.y * d.y + d.z * d.z).sqrt()
    };
    let mut rig = Rig::new(&line());
    rig.outputs[KITTING][output::VIA..output::VIA + 3].copy_from_slice(&[via.x, via.y, via.z]);
    rig.command(KITTING, THROUGH, Some(goal));
    let (mut scans, mut nearest, mut last) = (0, f64::INFINITY, point(rig.image(KITTING), input::TOOL));
    rig.step(30);
    while !rig.is_ended(KITTING) {
        rig.step(1);
        let tool = point(rig.image(KITTING), input::TOOL);
        assert!(scans > 200 || tool != last, "stands after {scans} scans");
        (last, scans) = (tool, scans + 1);
        nearest = nearest.min(distance(tool));
    }
    assert!(near(point(rig.image(KITTING), input::TOOL), goal));
    assert!(scans + 30 < with_a_stop - 50, "{scans} {with_a_stop}");
    assert!(nearest < 0.1, "{nearest}");
    for (via, goal) in [(Point::new(1.0, 0.0, 1.0), goal), (goal, Point::new(1.0, 0.0, 1.0))] {
        rig.outputs[KITTING][output::VIA..output::VIA + 3].copy_from_slice(&[via.x, via.y, via.z]);
        assert_eq!(rig.go(KITTING, THROUGH, goal), f64::from(error::UNREACHABLE));
    }
}

// --- station

#[test]
fn orders_of_a_station_open_one_after_another() {
    let mut line = line();
    // An order of nothing is made as soon as it is reported complete.
    line.scenario.orders = [[0, 0], [1, 0], [0, 0]]
        .map(|parts| Order { stations: vec![STATION], parts: parts.to_vec() })
        .to_vec();
    let mut rig = Rig::new(&line);
    assert_eq!(rig.image(STATION), [1.0, 0.0, 0.0, 1.0]);
    rig.outputs[STATION][output::COMPLETE] = 1.0;
    rig.step(1);
    assert_eq!(rig.image(STATION), [0.0; 4]);
    rig.step(5);
    assert_eq!(rig.image(STATION), [0.0; 4]);
    rig.outputs[STATION][output::COMPLETE] = 0.0;
    rig.step(1);
    assert_eq!(rig.image(STATION), [0.0; 4]);
    rig.step(1);
    assert_eq!(rig.image(STATION), [1.0, 1.0, 0.0, 2.0]);
    // A controller that lies gets nothing.
    let log = rig.plant.items().log().count();
    rig.outputs[STATION][output::COMPLETE] = 1.0;
    rig.step(50);
    assert_eq!(rig.image(STATION), [1.0, 1.0, 0.0, 2.0]);
    assert_eq!(rig.plant.items().log().count(), log + 1, "one event");
}

/// The gantry takes a part of this kind from the belt and lets it go over the station.
fn deliver(rig: &mut Rig, kind: usize) {
    deliver_at(rig, kind, Point::new(-7.2, 3.1, 1.5));
}

fn deliver_at(rig: &mut Rig, kind: usize, place: Point) {
    let at = grip_point(rig.bring(kind), kind);
    assert_eq!(rig.go(GANTRY, MOVE, at.up(0.3)), 0.0);
    rig.outputs[GANTRY][output::GRIP] = 1.0;
    assert_eq!(rig.go(GANTRY, PICK, at), 0.0);
    assert_eq!(rig.go(GANTRY, MOVE, at.up(0.3)), 0.0);
    assert_eq!(rig.go(GANTRY, MOVE, place), 0.0);
    rig.let_go(GANTRY);
}

#[test]
fn an_order_is_made_of_its_parts_and_no_others() {
    let mut line = line();
    line.scenario.orders = vec![Order { stations: vec![STATION], parts: vec![1, 0] }];
    for (kinds, made) in [(vec![BATTERY], true), (vec![BATTERY, PUMP], false), (vec![PUMP], false)] {
        let mut rig = Rig::new(&line);
        for kind in kinds {
            deliver(&mut rig, kind);
        }
        assert!(!rig.plant.items().borne_by(STATION).is_empty());
        rig.outputs[STATION][output::COMPLETE] = 1.0;
        rig.step(1);
        assert_eq!(rig.image(STATION)[input::ORDER_OPEN] == 0.0, made);
        assert_eq!(rig.plant.items().borne_by(STATION).is_empty(), made);
    }
}

#[test]
fn without_an_order_there_is_no_briefcase() {
    let mut line = line();
    line.scenario.orders.clear();
    let mut rig = Rig::new(&line);
    deliver(&mut rig, BATTERY);
    assert_eq!(rig.image(STATION), [0.0; 4]);
    assert!(matches!(rig.plant.items()[0].carrier, Carrier::Floor { .. }));
}

/// A second station beside the first; orders of one battery each lie open at both.
fn two_stations(orders: usize) -> (Line, usize) {
    let mut line = line();
    let other = line.machines.len();
    line.machines.push(machines::machine("as3", &machines::station(Point::new(-7.3, -3.0, 0.0))));
    line.scenario.orders = vec![Order { stations: vec![STATION, other], parts: vec![1, 0] }; orders];
    line.scenario.supply = vec![Supply { belt: BELT, items: vec![BATTERY, PUMP, BATTERY, BATTERY] }];
    (line, other)
}

#[test]
fn an_order_at_two_stations_is_made_at_one_and_withdrawn_at_the_other() {
    let (line, other) = two_stations(2);
    let mut rig = Rig::new(&line);
    for station in [STATION, other] {
        assert_eq!(rig.image(station), [1.0, 1.0, 0.0, 1.0]);
        rig.outputs[station][output::COMPLETE] = 1.0;
    }
    deliver(&mut rig, BATTERY);
    rig.step(50);
    // Made where its parts fell; gone at the other in the same scan, and `complete` is not answered there.
    assert_eq!(rig.image(STATION), [0.0; 4]);
    assert_eq!(rig.image(other), [0.0; 4]);
    assert_eq!(rig.plant.items()[0].carrier, Carrier::Shipped { order: 0 });
    // The next one opens at each station when `complete` has fallen there.
    rig.outputs[other][output::COMPLETE] = 0.0;
    rig.step(2);
    assert_eq!(rig.image(STATION), [0.0; 4]);
    assert_eq!(rig.image(other), [1.0, 1.0, 0.0, 2.0]);
    rig.outputs[STATION][output::COMPLETE] = 0.0;
    rig.step(2);
    assert_eq!(rig.image(STATION), [1.0, 1.0, 0.0, 2.0]);
    assert_eq!(conservation(rig.plant.items().log().since(0), rig.plant.items()), Ok(()));
}

#[test]
fn what_lies_in_a_withdrawn_briefcase_is_collected() {
    let (line, other) = two_stations(1);
    let mut rig = Rig::new(&line);
    deliver_at(&mut rig, BATTERY, Point::new(-7.2, -2.9, 1.5));
    deliver_at(&mut rig, PUMP, Point::new(-7.2, -2.9, 1.5));
    assert_eq!(rig.plant.items().borne_by(other), [0, 1]);
    deliver(&mut rig, BATTERY);
    for station in [STATION, other] {
        rig.outputs[station][output::COMPLETE] = 1.0;
    }
    rig.step(1);
    assert_eq!((rig.image(STATION)[input::ORDER_OPEN], rig.image(other)[input::ORDER_OPEN]), (0.0, 0.0));
    let carriers: Vec<Carrier> = rig.plant.items().all().map(|item| item.carrier).collect();
    assert_eq!(carriers[..3], [Carrier::Collector, Carrier::Collector, Carrier::Shipped { order: 0 }]);
    assert!(rig.plant.items().borne_by(other).is_empty());
    assert_eq!(conservation(rig.plant.items().log().since(0), rig.plant.items()), Ok(()));
    assert_eq!(rig.plant.orders_to_open(STATION) + rig.plant.orders_to_open(other), 0);
}

#[test]
fn an_order_that_is_made_before_its_turn_does_not_open() {
    let (mut line, other) = two_stations(1);
    // At the first station its turn comes between two other orders.
    line.scenario.orders.insert(0, Order { stations: vec![STATION], parts: vec![0, 1] });
    line.scenario.orders.push(Order { stations: vec![STATION], parts: vec![0, 2] });
    let mut rig = Rig::new(&line);
    assert_eq!(rig.image(STATION), [1.0, 0.0, 1.0, 1.0]);
    assert_eq!(rig.image(other), [1.0, 1.0, 0.0, 2.0]);
    assert_eq!(rig.plant.orders_to_open(STATION), 2);
    rig.outputs[other][output::COMPLETE] = 1.0;
    deliver_at(&mut rig, BATTERY, Point::new(-7.2, -2.9, 1.5));
    assert_eq!(rig.plant.items()[0].carrier, Carrier::Shipped { order: 1 });
    assert_eq!(rig.plant.orders_to_open(STATION), 1);
    rig.outputs[STATION][output::COMPLETE] = 1.0;
    deliver(&mut rig, PUMP);
    assert_eq!(rig.plant.items()[1].carrier, Carrier::Shipped { order: 0 });
    rig.outputs[STATION][output::COMPLETE] = 0.0;
    rig.step(2);
    assert_eq!(rig.image(STATION), [1.0, 0.0, 2.0, 3.0]);
}

#[test]
fn two_stations_that_have_the_parts_at_once_make_one_order() {
    let (line, other) = two_stations(1);
    let mut rig = Rig::new(&line);
    deliver(&mut rig, BATTERY);
    deliver_at(&mut rig, BATTERY, Point::new(-7.2, -2.9, 1.5));
    for station in [STATION, other] {
        rig.outputs[station][output::COMPLETE] = 1.0;
    }
    rig.step(1);
    assert_eq!(rig.plant.items()[0].carrier, Carrier::Shipped { order: 0 });
    let second = rig.plant.items().all().rposition(|item| item.carrier == Carrier::Collector);
    assert_eq!(second, Some(2));
    let made = |event: &&Event| matches!(event, Event::Order { change: OrderChange::Made, .. });
    assert_eq!(rig.plant.items().log().since(0).iter().filter(made).count(), 1);
}
