//! The UR10 with its vacuum gripper.
//!
//! Capsules and boxes around the collision meshes of `ur_description/meshes/ur10` (ROS-Industrial
//! `universal_robot`), fitted by least volume: every point of a mesh lies in one of the solids of its link.

use super::{GRIPPER, Link, Shape, Solid, cuboid};
use crate::kinematics::pose::Pose;
use crate::point::Point;

/// Direction of a segment in the frame of its link.
#[derive(Clone, Copy)]
enum Along {
    X,
    Y,
    Z,
}

/// Radius and the length of a housing or tube, and the frame of its link (see
/// [`crate::kinematics::ur10::frames`]) by number, first end, direction.
struct Piece {
    name: &'static str,
    frame: usize,
    from: Point,
    along: Along,
    length: f64,
    radius: f64,
}

const fn piece(
    name: &'static str,
    frame: usize,
    from: (f64, f64, f64),
    along: Along,
    length: f64,
    radius: f64,
) -> Piece {
    Piece { name, frame, from: Point::new(from.0, from.1, from.2), along, length, radius }
}

const PIECES: [Piece; 9] = [
    piece("shoulder", 0, (0.0, -0.0444, 0.0169), Along::Y, 0.058, 0.1025),
    piece("upper_arm_shoulder", 1, (0.61, 0.0, 0.114), Along::Z, 0.1105, 0.082),
    piece("upper_arm_tube", 1, (0.0, 0.0, 0.1755), Along::X, 0.57, 0.0775),
    piece("upper_arm_elbow", 1, (0.0, 0.0, 0.138), Along::Z, 0.0835, 0.0635),
    piece("forearm_elbow", 2, (0.569, 0.0, 0.005), Along::Z, 0.095, 0.0635),
    piece("forearm_tube", 2, (0.0, 0.0, 0.0475), Along::X, 0.535, 0.0605),
    piece("forearm_wrist", 2, (0.0, 0.0, 0.015), Along::Z, 0.0775, 0.0495),
    piece("wrist_1", 3, (0.0, -0.007, -0.0015), Along::Z, 0.0235, 0.066),
    piece("wrist_2", 4, (0.0, 0.007, -0.003), Along::Z, 0.0265, 0.066),
];

/// Bounds of the base's mesh, plug included.
const BASE: [Point; 2] = [Point::new(-0.075, -0.0751, 0.0), Point::new(0.075, 0.092, 0.038)];
/// Bounds of the last wrist's mesh, in the frame of the tool.
const WRIST_3: [Point; 2] = [Point::new(-0.045, -0.046, -0.0385), Point::new(0.045, 0.0441, -0.0078)];
/// Half of the gripper's length across, and its height (`vacuum_gripper.urdf.xacro`: a disc of radius 0.05
/// and thickness 0.01). The disc's middle is the tool there; here its face is, which lies on the part.
const DISC: (f64, f64) = (0.05, 0.01);

/// The base, at `mount` in the frame of `link`; then what the joints from number `first` on move.
pub fn solids(link: Link, mount: &Pose, first: usize) -> Vec<Solid> {
    let mut base = cuboid("base", link, BASE[0], BASE[1]);
    base.pose = mount.then(&base.pose);
    let (half, height) = DISC;
    let last = Link::Joint(first + 5);
    let mut solids = vec![base];
    solids.extend(PIECES.iter().map(|piece| capsule(piece, first)));
    solids.push(cuboid("wrist_3", last, WRIST_3[0], WRIST_3[1]));
    solids.push(cuboid(GRIPPER, last, Point::new(-half, -half, -height), Point::new(half, half, 0.0)));
    solids
}

fn capsule(piece: &Piece, first: usize) -> Solid {
    // The capsule's own z lies along the segment.
    let rotation = match piece.along {
        Along::X => [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        Along::Y => [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
        Along::Z => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    };
    let half = Pose { rotation: Pose::IDENTITY.rotation, position: Point::new(0.0, 0.0, piece.length / 2.0) };
    Solid {
        name: piece.name,
        link: Link::Joint(first + piece.frame),
        pose: Pose { rotation, position: piece.from }.then(&half),
        shape: Shape::Capsule { length: piece.length, radius: piece.radius },
    }
}
