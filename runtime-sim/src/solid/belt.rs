//! A belt on its bed, between two guards.

use super::{Link, Solid, cuboid, laid};
use crate::geometry::{BELT_SURFACE, BELT_WIDTH};
use crate::point::{Axis, Point};

const HALF_WIDTH: f64 = BELT_WIDTH / 2.0;
/// Outer faces of the guards across a belt along y, and their upper edge over the pose
/// (bounds of `conveyor.dae`: x -0.341 to 0.454, z up to 0.920).
const OUTER: [f64; 2] = [-0.341, 0.454];
const GUARD_HEIGHT: f64 = 0.920;

/// Bed and guards are as long as the layout says and reach down to the floor under them.
pub fn solids(pose: Point, orient: Axis, [low, high]: [f64; 2]) -> Vec<Solid> {
    // Seen in the direction of travel, the wider guard of every belt is on the same side.
    let (line, side) = match orient {
        Axis::Y => (pose.x, 1.0),
        Axis::X => (pose.y, -1.0),
    };
    let body = |name, from: f64, to: f64, height: f64| {
        let (from, to) = (line + side * from, line + side * to);
        cuboid(
            name,
            Link::World,
            laid(orient, low, from.min(to), pose.z),
            laid(orient, high, from.max(to), pose.z + height),
        )
    };
    vec![
        body("bed", -HALF_WIDTH, HALF_WIDTH, BELT_SURFACE),
        body("lower_guard", OUTER[0], -HALF_WIDTH, GUARD_HEIGHT),
        body("upper_guard", HALF_WIDTH, OUTER[1], GUARD_HEIGHT),
    ]
}
