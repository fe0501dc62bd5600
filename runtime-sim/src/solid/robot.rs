//! What carries the UR10: a rail, or rails, bridge, trolley and torso.

use super::{Link, Solid, cuboid, laid, ur10};
use crate::kinematics::gantry::MOUNT;
use crate::kinematics::pose::Pose;
use crate::kinematics::ur10::D1;
use crate::point::{Axis, Point};

/// The kitting robot's rail: half of its width, its lower and upper face from the shoulder, and how far it goes on
/// beyond the range (obstacle 0.2 x 10 x 0.1 at z 0.93 in `ariac.world.template`, for a range of 9.6 m).
const RAIL_HALF: f64 = 0.1;
const RAIL_Z: [f64; 2] = [-0.247, -0.147];
const RAIL_REST: f64 = 0.2;

/// Rails and bridge of the gantry: half of their width, and their faces from the shoulder
/// (`gantry.urdf.xacro`: rails of 15 m at z 2.9 and y -4.9 and 4.9, bridge of 10 m at z 3.0, both 0.2 x 0.1,
/// for ranges of 14.8 m and 9 m and a shoulder at 2 m).
const BEAM_HALF: f64 = 0.1;
const LONG_RAIL_Z: [f64; 2] = [0.85, 0.95];
const LONG_RAIL_REST: f64 = 0.1;
const LONG_RAIL_ASIDE: f64 = 0.4;
const BRIDGE_Z: [f64; 2] = [0.95, 1.05];
const BRIDGE_REST: f64 = 0.5;

/// Lower and upper corner of each part of trolley and torso from the shoulder's height on the torso's axis:
/// bounds of the parts of `torso_base.dae`, `torso_fixed_normals.dae` and `gantry_tray.dae` with their scales,
/// 1.3 m lower, where the torso's own origin is. The torso's x points to the arm.
const TROLLEY: [(&str, [Point; 2]); 2] = [
    ("trolley_plate", [Point::new(-0.328, -0.328, 0.710), Point::new(0.328, 0.328, 0.847)]),
    ("trolley_drive", [Point::new(-0.280, -0.207, 0.835), Point::new(0.280, 0.207, 1.035)]),
];
const TORSO: [(&str, [Point; 2]); 6] = [
    ("torso", [Point::new(-0.354, -0.478, -0.212), Point::new(0.354, 0.478, 0.715)]),
    ("arm_mount", [Point::new(0.351, -0.222, -0.201), Point::new(0.519, 0.222, 0.241)]),
    ("tray", [Point::new(-0.405, -0.440, -0.705), Point::new(0.373, 0.440, -0.652)]),
    ("tray_post", [Point::new(-0.528, -0.063, -0.765), Point::new(-0.462, 0.063, 0.044)]),
    ("tray_upper_arm", [Point::new(-0.528, -0.113, -0.093), Point::new(-0.347, 0.113, 0.131)]),
    ("tray_lower_arm", [Point::new(-0.521, -0.093, -0.765), Point::new(0.067, 0.093, -0.698)]),
];

/// `pose`, `rail` and its range as in [`crate::geometry::Geometry::RailArm`].
pub fn on_rail(pose: Point, rail: Axis, [low, high]: [f64; 2]) -> Vec<Solid> {
    let line = match rail {
        Axis::X => pose.y,
        Axis::Y => pose.x,
    };
    let carriage = Link::Joint(0);
    let mut solids = vec![
        cuboid(
            "rail",
            Link::World,
            laid(rail, low - RAIL_REST, line - RAIL_HALF, pose.z + RAIL_Z[0]),
            laid(rail, high + RAIL_REST, line + RAIL_HALF, pose.z + RAIL_Z[1]),
        ),
        // No source describes the carriage: a plate as wide as the rail fills the gap under the base.
        cuboid(
            "carriage",
            carriage,
            Point::new(-RAIL_HALF, -RAIL_HALF, RAIL_Z[1] + D1),
            Point::new(RAIL_HALF, RAIL_HALF, 0.0),
        ),
    ];
    solids.extend(ur10::solids(carriage, &Pose::IDENTITY, 1));
    solids
}

/// As in [`crate::geometry::Geometry::Gantry`].
pub fn gantry(pose: Point, [x0, x1]: [f64; 2], [y0, y1]: [f64; 2]) -> Vec<Solid> {
    let long_rail = |name, y: f64| {
        cuboid(
            name,
            Link::World,
            Point::new(x0 - LONG_RAIL_REST, y - BEAM_HALF, pose.z + LONG_RAIL_Z[0]),
            Point::new(x1 + LONG_RAIL_REST, y + BEAM_HALF, pose.z + LONG_RAIL_Z[1]),
        )
    };
    let mut solids = vec![
        long_rail("lower_rail", y0 - LONG_RAIL_ASIDE),
        long_rail("upper_rail", y1 + LONG_RAIL_ASIDE),
        cuboid(
            "bridge",
            Link::Joint(0),
            Point::new(-BEAM_HALF, y0 - BRIDGE_REST, BRIDGE_Z[0]),
            Point::new(BEAM_HALF, y1 + BRIDGE_REST, BRIDGE_Z[1]),
        ),
    ];
    solids.extend(TROLLEY.map(|(name, [low, high])| cuboid(name, Link::Joint(1), low, high)));
    solids.extend(TORSO.map(|(name, [low, high])| cuboid(name, Link::Joint(2), low, high)));
    solids.extend(ur10::solids(Link::Joint(2), &MOUNT, 3));
    solids
}
