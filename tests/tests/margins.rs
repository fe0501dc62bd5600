//! What a margin of connectivity promises: its sign is that of the solver, and a place that is moved by 99.9 % of it is
//! still reached. `AUTOGEN_CAMPAIGN=full` tries a million places of each arm.

use autogen_tests::{is_full_campaign, machines};
use runtime_sim::frame::Frame;
use runtime_sim::kinematics::arm::Arm;
use runtime_sim::kinematics::cartesian::{Cartesian, Slide};
use runtime_sim::kinematics::facing::Facing;
use runtime_sim::kinematics::fixed::{FixedArm, Geometry, Mounting};
use runtime_sim::kinematics::opw::Opw;
use runtime_sim::kinematics::riding::RidingArm;
use runtime_sim::kinematics::scara::{Arms, Scara};
use runtime_sim::kinematics::solver::Solver;
use runtime_sim::kinematics::ur::Lengths;
use runtime_sim::point::{Axis, Direction, Point};
use runtime_sim::random::Random;

struct Drawn(Random);

impl Drawn {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * f64::from(self.0.up_to(u32::MAX - 1)) / f64::from(u32::MAX - 1)
    }

    fn within(&mut self, [low, high]: [Point; 2]) -> Point {
        Point::new(self.between(low.x, high.x), self.between(low.y, high.y), self.between(low.z, high.z))
    }

    /// A unit vector.
    fn direction(&mut self) -> Point {
        loop {
            let point = self.within([Point::new(-1.0, -1.0, -1.0), Point::new(1.0, 1.0, 1.0)]);
            let length = point.length();
            if (0.1..=1.0).contains(&length) {
                return point.scaled(1.0 / length);
            }
        }
    }
}

/// Of how many places one is looked at in many directions.
const LOOKED_AT: usize = 20;
const DIRECTIONS: usize = 64;

/// Places within and beyond the reach of an arm: each margin has the sign of the solver, and holds in a direction that is
/// drawn. Most margins are not much too small either: twice as far and 5 mm more, the place is lost in some direction.
fn promised(name: &str, around: [Point; 2], margin: impl Fn(Point) -> f64, reaches: impl Fn(Point) -> bool) {
    let places = if is_full_campaign() { 1_000_000 } else { 5_000 };
    let mut drawn = Drawn(Random::new(9));
    let (mut inside, mut signs, mut moved, mut tight) = (0, Vec::new(), Vec::new(), [0, 0]);
    for _ in 0..places {
        let place = drawn.within(around);
        let found = margin(place);
        if (found >= 0.0) != reaches(place) {
            signs.push((place, found));
        }
        let goes = drawn.direction().scaled(0.999 * found);
        if found >= 0.0 {
            inside += 1;
            if !reaches(place + goes) {
                moved.push((place, found, goes));
            }
            if inside % LOOKED_AT == 0 {
                let goes = 2.0 * found + 0.005;
                let is_lost = (0..DIRECTIONS).any(|_| !reaches(place + drawn.direction().scaled(goes)));
                tight[usize::from(is_lost)] += 1;
            }
        }
    }
    println!(
        "{name}: {places} places, {inside} within reach; {} wrong signs, {} lost when moved; {} of {} margins are more than half of what they could be",
        signs.len(),
        moved.len(),
        tight[1],
        tight[0] + tight[1]
    );
    assert!(
        inside > places / 20 && inside < places - places / 20,
        "{name}: {inside} of {places} are within reach"
    );
    assert!(tight[1] > 2 * tight[0], "{name}: many margins are too small: {tight:?}");
    signs.truncate(3);
    moved.truncate(3);
    assert!(signs.is_empty() && moved.is_empty(), "{name}: signs {signs:?}, moved {moved:?}");
}

fn around(middle: Point, half: Point) -> [Point; 2] {
    [middle - half, middle + half]
}

/// Upright, then hung; the tool down, then with a turn, then level. With a level tool, limits of the wrist do not count for the margin, only
/// for its sign.
fn fixed(name: &str, geometry: Geometry, ranges: Option<[[f64; 2]; 6]>, reach: f64) {
    let ranges = ranges.map(|ranges| ranges.map(|range| range.map(f64::to_radians)));
    let [x, y] = [0.6, -0.8];
    for mounting in [Mounting::Upright, Mounting::Hung] {
        facing(name, geometry, mounting, ranges, Facing::Down, reach);
        facing(name, geometry, mounting, ranges, Facing::Oriented { x, y }, reach);
        let turn = TURNS.map(f64::to_radians);
        let free = ranges.map(|[first, second, third, ..]| [first, second, third, turn, turn, turn]);
        facing(name, geometry, mounting, free, Facing::Level { x, y }, reach);
        if let Some(ranges) = ranges {
            signs(name, geometry, mounting, ranges, Facing::Level { x, y }, reach);
        }
    }
}

const BASE: Point = Point::new(0.3, -0.2, 0.4);

/// Whether an arm comes to a place; then its tool points there.
fn comes(arm: &FixedArm, place: Point, facing: Facing) -> bool {
    let Some(joints) = arm.solve(place, facing, &arm.start()) else { return false };
    let tool = arm.tool_pose(&joints);
    let is_there =
        (tool.position - place).length() < 1e-6 && tool.axis(2).dot(facing.direction()) > 1.0 - 1e-9;
    assert!(is_there, "{place:?} {joints:?}");
    if let Facing::Oriented { x, y } = facing {
        assert!(tool.axis(0).dot(Point::new(x, y, 0.0)) > 1.0 - 1e-9, "{place:?} {joints:?}");
    }
    true
}

/// Where most of what it reaches is.
fn of_reach(mounting: Mounting, facing: Facing, reach: f64) -> [Point; 2] {
    let middle = match (mounting, facing) {
        (Mounting::Hung, Facing::Down | Facing::Oriented { .. }) => BASE.up(-0.6 * reach),
        _ => BASE,
    };
    around(middle, Point::new(reach, reach, reach))
}

type Ranges = [[f64; 2]; 6];

fn facing(
    name: &str,
    geometry: Geometry,
    mounting: Mounting,
    ranges: Option<Ranges>,
    facing: Facing,
    reach: f64,
) {
    let arm = FixedArm::new(Frame::new(BASE, 20.0), geometry, ranges).mounted(mounting);
    let title = format!("{name}, {mounting:?}, {facing:?}");
    let around = of_reach(mounting, facing, reach);
    promised(&title, around, |place| arm.margin(place, facing), |place| comes(&arm, place, facing));
    // It starts with its tool down too.
    assert!(arm.tool_pose(&arm.start()).axis(2).z < 1e-9 - 1.0, "{title}: {:?}", arm.tool_pose(&arm.start()));
}

/// The sign of the margin is that of the solver; the wrist is within its limits where the arm comes, by the room that is
/// told and by no more than the least room of its joints.
fn signs(name: &str, geometry: Geometry, mounting: Mounting, ranges: Ranges, facing: Facing, reach: f64) {
    let arm = FixedArm::new(Frame::new(BASE, 20.0), geometry, Some(ranges)).mounted(mounting);
    let mut drawn = Drawn(Random::new(19));
    let [mut inside, mut forbidden] = [0; 2];
    let free = FixedArm::new(Frame::new(BASE, 20.0), geometry, None).mounted(mounting);
    for _ in 0..if is_full_campaign() { 1_000_000 } else { 3_000 } {
        let place = drawn.within(of_reach(mounting, facing, reach));
        let is_reached = comes(&arm, place, facing);
        assert_eq!(arm.margin(place, facing) >= 0.0, is_reached, "{name} {place:?}");
        inside += usize::from(is_reached);
        forbidden += usize::from(!is_reached && free.margin(place, facing) >= 0.0);
        let room = arm.wrist_room(place, facing);
        let is_limited = (3..6).any(|joint| ranges[joint][1] - ranges[joint][0] < std::f64::consts::TAU);
        assert_eq!(room.is_some(), is_reached && is_limited, "{name} {place:?}");
        let (Some(room), Some(joints)) = (room, arm.solve(place, facing, &arm.start())) else { continue };
        // The way that is taken is not always the one with most room.
        let taken = (3..6).filter(|joint| ranges[*joint][1] - ranges[*joint][0] < std::f64::consts::TAU);
        let taken =
            taken.map(|joint| (joints[joint] - ranges[joint][0]).min(ranges[joint][1] - joints[joint]));
        let taken = taken.fold(f64::INFINITY, f64::min);
        assert!((0.0..=room + 1e-9).contains(&taken), "{name} {place:?}: {taken} {room}");
    }
    assert!(
        inside > 100 && forbidden > 10,
        "{name}: {inside} reached, {forbidden} forbidden by limits alone"
    );
}

const UR10E: Lengths =
    Lengths { d1: 0.1807, a2: -0.6127, a3: -0.57155, d4: 0.17415, d5: 0.11985, tool: 0.26655 };

const TURNS: [f64; 2] = [-360.0, 360.0];

/// KUKA KR 6 R700 sixx with its limits, and a Stäubli TX40 with its own.
#[test]
fn of_arms_with_a_spherical_wrist() {
    let turn = |degrees: [f64; 6]| degrees.map(f64::to_radians);
    let kuka = Geometry::OrthoParallel(Opw {
        a1: 0.025,
        a2: -0.035,
        b: 0.0,
        c1: 0.400,
        c2: 0.315,
        c3: 0.365,
        tool: 0.180,
        offsets: turn([0.0, -90.0, 0.0, 0.0, 0.0, 0.0]),
        signs: [-1.0, 1.0, 1.0, -1.0, 1.0, -1.0],
    });
    let limits =
        [[-170.0, 170.0], [-190.0, 45.0], [-120.0, 156.0], [-185.0, 185.0], [-120.0, 120.0], [-350.0, 350.0]];
    fixed("KR 6", kuka, None, 0.8);
    fixed("KR 6 with limits", kuka, Some(limits), 0.8);
    let staubli = Geometry::OrthoParallel(Opw {
        a1: 0.0,
        a2: 0.0,
        b: 0.035,
        c1: 0.320,
        c2: 0.225,
        c3: 0.225,
        tool: 0.165,
        offsets: turn([0.0, 0.0, -90.0, 0.0, 0.0, 0.0]),
        signs: [1.0; 6],
    });
    let limits = [
        [-180.0, 180.0],
        [-125.0, 125.0],
        [-138.0, 138.0],
        [-270.0, 270.0],
        [-120.0, 133.5],
        [-270.0, 270.0],
    ];
    fixed("TX40", staubli, None, 0.5);
    fixed("TX40 with limits", staubli, Some(limits), 0.5);
    let aside = Geometry::OrthoParallel(Opw {
        a1: 0.2,
        a2: -0.1,
        b: 0.15,
        c1: 0.5,
        c2: 0.6,
        c3: 0.7,
        tool: 0.2,
        offsets: turn([10.0, -20.0, 30.0, 40.0, -50.0, 60.0]),
        signs: [1.0, -1.0, 1.0, -1.0, 1.0, -1.0],
    });
    fixed("offset to the side", aside, None, 1.8);
    let limits = [[-100.0, 80.0], [-60.0, 110.0], [-80.0, 90.0], [-200.0, 150.0], [-100.0, 130.0], TURNS];
    fixed("offset to the side with limits", aside, Some(limits), 1.8);
}

#[test]
fn of_arms_of_universal_robots() {
    let ur = Geometry::UniversalRobots(UR10E);
    fixed("UR10e", ur, None, 1.5);
    let limits = [[-150.0, 170.0], [-160.0, 20.0], [-150.0, 140.0], [-200.0, 60.0], [-120.0, 120.0], TURNS];
    fixed("UR10e with limits", ur, Some(limits), 1.5);
}

/// A UR10e on a rail that lies at an angle, its base turned on the carriage.
#[test]
fn of_an_arm_on_a_rail() {
    let geometry = Geometry::UniversalRobots(UR10E);
    let rail = Frame::new(Point::new(0.5, 0.2, 0.1), 35.0);
    let mount = Frame::new(Point::new(0.1, -0.2, 0.3), 90.0);
    let at = |base: Frame| FixedArm::new(base, geometry, None);
    let arm = RidingArm::new(rail, Axis::Y, [-1.0, 1.5], mount, at);
    for facing in [Facing::Down, Facing::Level { x: 0.6, y: -0.8 }] {
        let reaches = |place: Point| arm.solve(place, facing, &arm.start()).is_some();
        let around = around(rail.position.up(0.3), Point::new(2.2, 2.2, 1.4));
        promised(&format!("on a rail, {facing:?}"), around, |place| arm.margin(place, facing), reaches);
    }
}

#[test]
fn of_a_cartesian_robot() {
    let slides = [(Direction::Y, [0.0, 0.6]), (Direction::X, [0.0, 1.0]), (Direction::Z, [-0.3, 0.0])];
    let slides = slides.map(|(along, range)| Slide { along, range });
    let base = Frame::new(Point::new(2.0, 1.0, 1.2), 25.0);
    let robot = Cartesian::new(base, &slides, 0.2).expect("three axes");
    let middle = base.point(Point::new(0.5, 0.3, -0.35));
    let half = Point::new(0.8, 0.8, 0.3);
    promised(
        "three axes",
        around(middle, half),
        |place| robot.margin(place),
        |place| robot.solve(place).is_some(),
    );
}

fn of_library(name: &str, arm: &Arm, around: [Point; 2]) {
    let start = arm.start();
    promised(name, around, |place| arm.margin(place), |place| arm.solve(place, &start).is_some());
}

#[test]
fn of_arms_of_the_library() {
    let place = Point::new(-1.3, 0.0, 1.127);
    let arm = machines::arm(&machines::rail_arm(place, Axis::Y, [-2.0, 2.0]));
    of_library("arm on a rail", &arm, around(place, Point::new(1.6, 3.6, 1.6)));
    let place = Point::new(-4.0, 0.0, 2.0);
    let arm = machines::arm(&machines::gantry(place, [-6.0, -2.0], [-2.0, 2.0]));
    of_library("gantry", &arm, around(place, Point::new(4.0, 4.0, 2.0)));
}

/// With the limits of an Epson LS6 of 0.6 m, but for the outer arm, which there turns by 150 degrees.
#[test]
fn of_a_scara() {
    let turn = |degrees: f64| [-degrees.to_radians(), degrees.to_radians()];
    let ranges = [turn(132.0), turn(150.0), [-0.2, 0.0], turn(360.0)];
    let arms = Arms { lengths: [0.325, 0.275], tool: 0.1, ranges };
    let arm = Scara::new(Frame::new(BASE, 20.0), arms);
    let start = Solver::start(&arm);
    let comes = |place: Point| {
        let Some(joints) = Solver::solve(&arm, place, Facing::Down, &start) else { return false };
        let tool = Solver::tool_pose(&arm, &joints);
        assert!(
            (tool.position - place).length() < 1e-9 && tool.axis(2).z < 1e-12 - 1.0,
            "{place:?} {joints:?}"
        );
        true
    };
    let space = around(BASE.up(-0.2), Point::new(0.65, 0.65, 0.13));
    promised("SCARA", space, |place| Solver::margin(&arm, place, Facing::Down), comes);
}
