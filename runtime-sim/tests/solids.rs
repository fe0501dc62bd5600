//! The solids of the default line's machines.

#[path = "../../tests/src/machines.rs"]
mod machines;

use autogen::device::Placed;
use machines::{arm, belt, bin, machine, rail_arm, station, vehicle};
use runtime_sim::kinematics::arm::Joints;
use runtime_sim::kinematics::pose::Pose;
use runtime_sim::line::Obstacle;
use runtime_sim::point::{Axis, Point};
use runtime_sim::solid::{Link, Shape, Solid};

const BELT_SURFACE: f64 = 0.875;
const TRAY_SURFACE: f64 = 0.755;
const BIN_FLOOR: f64 = 0.725;
const BRIEFCASE: Point = Point::new(0.08, 0.095839, 1.35);

fn machines() -> Vec<Placed> {
    let pose = Point::new(-2.265685, 4.675404, 0.0);
    vec![
        belt(Point::new(-0.573076, 0.0, 0.0), Axis::Y, [-5.0, 5.0]),
        belt(Point::new(-4.0, 2.0, 0.0), Axis::X, [-6.0, -1.0]),
        vehicle(pose, [Point::new(-5.6, 4.675404, 0.0); 2]),
        kitting(Axis::Y),
        kitting(Axis::X),
        gantry(),
        station(Point::new(-7.3, 3.0, 0.0)),
        bin(Point::new(-1.899, 3.38, 0.0)),
    ]
}

fn kitting(rail_dim: Axis) -> Placed {
    rail_arm(Point::new(-1.3, 0.0, 1.127), rail_dim, [-4.8, 4.8])
}

fn gantry() -> Placed {
    machines::gantry(Point::new(-4.0, 0.0, 2.0), [-14.4, 0.4], [-4.5, 4.5])
}

/// Of a machine's solid, lowest and highest coordinates; its link is at `frame`.
fn bounds(solid: &Solid, frame: &Pose) -> [Point; 2] {
    let pose = frame.then(&solid.pose);
    let half = match solid.shape {
        Shape::Box { size } => {
            let half = [size.x / 2.0, size.y / 2.0, size.z / 2.0];
            pose.rotation.map(|row| (0..3).map(|i| row[i].abs() * half[i]).sum::<f64>())
        }
        Shape::Capsule { length, radius } => pose.rotation.map(|row| row[2].abs() * length / 2.0 + radius),
    };
    let [x, y, z] = half;
    [pose.position - Point::new(x, y, z), pose.position + Point::new(x, y, z)]
}

fn solids(placed: &Placed) -> Vec<Solid> {
    machine("m", placed).solids()
}

fn named(placed: &Placed, name: &str) -> Solid {
    solids(placed).into_iter().find(|s| s.name == name).unwrap_or_else(|| panic!("no {name}"))
}

fn assert_close(got: Point, expected: (f64, f64, f64)) {
    let d = got - Point::new(expected.0, expected.1, expected.2);
    assert!(d.x.abs() < 1e-9 && d.y.abs() < 1e-9 && d.z.abs() < 1e-9, "{got:?} is not {expected:?}");
}

#[test]
fn names_are_unique_and_shapes_have_room() {
    for placed in machines() {
        let solids = solids(&placed);
        let mut names: Vec<&str> = solids.iter().map(|s| s.name.as_str()).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), solids.len(), "{placed:?}");
        for solid in &solids {
            let lengths = match solid.shape {
                Shape::Box { size } => vec![size.x, size.y, size.z],
                Shape::Capsule { length, radius } => vec![length, radius],
            };
            assert!(lengths.iter().all(|l| *l > 0.0), "{solid:?}");
            // Right-handed and square, or the shape would be another one.
            let r = &solid.pose.rotation;
            let cross = [
                r[1][0] * r[2][1] - r[2][0] * r[1][1],
                r[2][0] * r[0][1] - r[0][0] * r[2][1],
                r[0][0] * r[1][1] - r[1][0] * r[0][1],
            ];
            assert!((0..3).all(|i| (cross[i] - r[i][2]).abs() < 1e-12), "{solid:?}");
        }
        let links = solids.iter().map(|s| s.link);
        let arm = placed.arm();
        let joints = arm.map_or(0, |arm| arm.start().len());
        for link in links {
            match link {
                Link::World => assert!(!placed.device.has("route")),
                Link::Route => assert!(placed.device.has("route")),
                Link::Carriage(_) => assert!(placed.device.has("cylinder")),
                Link::Joint(i) => assert!(i < joints),
            }
        }
        let moved: std::collections::BTreeSet<Link> =
            solids.iter().map(|s| s.link).filter(|l| matches!(l, Link::Joint(_))).collect();
        assert_eq!(moved.len(), joints, "a link of {placed:?} has no solid");
    }
}

#[test]
fn belts_carry_between_their_guards() {
    let along_y = &machines()[0];
    let [low, high] = bounds(&named(along_y, "bed"), &Pose::IDENTITY);
    assert_close(low, (-0.783076, -5.0, 0.0));
    assert_close(high, (-0.363076, 5.0, BELT_SURFACE));
    let [low, high] = bounds(&named(along_y, "upper_guard"), &Pose::IDENTITY);
    assert_close(low, (-0.363076, -5.0, 0.0));
    assert_close(high, (-0.119076, 5.0, 0.92));
    let along_x = &machines()[1];
    let [low, high] = bounds(&named(along_x, "bed"), &Pose::IDENTITY);
    assert_close(low, (-6.0, 1.79, 0.0));
    assert_close(high, (-1.0, 2.21, BELT_SURFACE));
    // The same belt turned to the right: what was on the side of x is now on the side of -y.
    let [low, high] = bounds(&named(along_x, "upper_guard"), &Pose::IDENTITY);
    assert_close(low, (-6.0, 1.546, 0.0));
    assert_close(high, (-1.0, 1.79, 0.92));
}

#[test]
fn parts_rest_on_solids() {
    let [low, high] = bounds(&named(&machines()[2], "tray"), &Pose::IDENTITY);
    assert!((high.z - TRAY_SURFACE).abs() < 1e-12);
    for slot in machine("agv", &machines()[2]).places().flat_map(|place| place.slots.clone()) {
        assert!(low.x < slot.x && slot.x < high.x && low.y < slot.y && slot.y < high.y, "{slot:?}");
    }
    let station = &machines()[6];
    let [low, high] = bounds(&named(station, "briefcase"), &Pose::IDENTITY);
    let floor = Point::new(-7.3, 3.0, 0.0) + BRIEFCASE;
    assert!((high.z - floor.z).abs() < 1e-12);
    assert!(
        low.x < floor.x - 0.1 && floor.x + 0.1 < high.x && low.y < floor.y - 0.12 && floor.y + 0.12 < high.y
    );
    let [_, high] = bounds(&named(&machines()[7], "block"), &Pose::IDENTITY);
    assert!((high.z - BIN_FLOOR).abs() < 1e-12);
}

/// The tubes of the arm lie beside the line from shoulder to elbow, as far as the description says (0.221 m
/// and 0.049 m measured from its model), and the gripper's face is at the tool.
#[test]
fn arms_are_where_their_description_puts_them() {
    for (placed, first) in [(kitting(Axis::Y), 1), (kitting(Axis::X), 1), (gantry(), 3)] {
        let arm = arm(&placed);
        let joints = Joints::new(&vec![0.4; arm.start().len()]);
        let frames = arm.frames(&joints);
        let tool = arm.tool_pose(&joints);
        let place = |name: &str| {
            let solid = named(&placed, name);
            let Link::Joint(i) = solid.link else { panic!("{name} does not move") };
            frames[i].then(&solid.pose)
        };
        let gripper = place("gripper");
        let to_tool = tool.position - gripper.position;
        let axis = tool.axis(2);
        assert_close(to_tool, (0.005 * axis.x, 0.005 * axis.y, 0.005 * axis.z));
        let base = place("base");
        let pan = frames[first].axis(1);
        let up = base.axis(2);
        assert_close(pan, (up.x, up.y, up.z));
        let shoulder = place("shoulder");
        let lateral = frames[first].axis(2);
        let offset = |pose: &Pose, from: Point| {
            let d = pose.position - from;
            d.x * lateral.x + d.y * lateral.y + d.z * lateral.z
        };
        let origin = frames[first].position;
        assert!((offset(&place("upper_arm_tube"), origin) - 0.1755).abs() < 1e-9);
        assert!((offset(&place("forearm_tube"), origin) - 0.0475).abs() < 1e-9);
        assert!((offset(&shoulder, origin) - 0.0169).abs() < 1e-9);
    }
}

#[test]
fn the_default_gantry_is_the_one_described() {
    let [low, high] = bounds(&named(&gantry(), "lower_rail"), &Pose::IDENTITY);
    assert_close(low, (-14.5, -5.0, 2.85));
    assert_close(high, (0.5, -4.8, 2.95));
    let arm = arm(&gantry());
    let frames = arm.frames(&Joints::new(&[-4.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]));
    let [low, high] = bounds(&named(&gantry(), "bridge"), &frames[0]);
    assert_close(low, (-4.1, -5.0, 2.95));
    assert_close(high, (-3.9, 5.0, 3.05));
    // The arm is mounted towards y: 0.51 m from the torso's axis at a height of 2 m.
    let [low, high] = bounds(&named(&gantry(), "arm_mount"), &frames[2]);
    assert_close(low, (-4.222, 1.351, 1.799));
    assert_close(high, (-3.778, 1.519, 2.241));
    let [low, high] = bounds(&named(&gantry(), "base"), &frames[2]);
    assert!((low.y - 1.51).abs() < 1e-9 && (high.y - 1.548).abs() < 1e-9);
    let [low, high] = bounds(&named(&kitting(Axis::Y), "rail"), &Pose::IDENTITY);
    assert_close(low, (-1.4, -5.0, 0.88));
    assert_close(high, (-1.2, 5.0, 0.98));
}

#[test]
fn obstacles_stand_on_their_pose() {
    let pose = Point::new(1.0, 2.0, 3.0);
    let obstacle = |size| Obstacle { name: "post".into(), pose, size };
    assert_eq!(obstacle(None).solid(), None);
    let [low, high] = bounds(&obstacle(Some(Point::new(0.2, 0.4, 0.6))).solid().unwrap(), &Pose::IDENTITY);
    assert_close(low, (0.9, 1.8, 3.0));
    assert_close(high, (1.1, 2.2, 3.6));
}
