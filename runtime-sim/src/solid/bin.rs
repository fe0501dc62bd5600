//! A bin: a block up to its floor, and walls around it that are lower in the middle of two sides.
//!
//! Sizes from `workcell_bin/model.sdf` (ARIAC 2021).

use super::{Link, Solid, cuboid};
use crate::geometry::{BIN_FLOOR, BIN_SIDE};
use crate::point::Point;

/// Half of its foot's length, and the foot's height.
const FOOT: (f64, f64) = (0.33418, 0.20049);
/// Outer and inner face of the walls, and their upper edge.
const OUTER: f64 = 0.3205;
const INNER: f64 = 0.31749;
const WALL_TOP: f64 = 0.79089;
/// Half of the gap in the walls on both sides of y.
const HALF_GAP: f64 = 0.186125;

pub fn solids(pose: Point) -> Vec<Solid> {
    let body = |name, x: [f64; 2], y: [f64; 2], top: f64| {
        let corner = |i: usize, z: f64| pose + Point::new(x[i], y[i], z);
        cuboid(name, Link::World, corner(0, 0.0), corner(1, top))
    };
    let around = |half: f64| [-half, half];
    let (lower, upper) = ([-OUTER, -INNER], [INNER, OUTER]);
    let (left, right) = ([-OUTER, -HALF_GAP], [HALF_GAP, OUTER]);
    vec![
        body("foot", around(FOOT.0), around(FOOT.0), FOOT.1),
        body("block", around(BIN_SIDE / 2.0), around(BIN_SIDE / 2.0), BIN_FLOOR),
        body("lower_x_wall", lower, around(OUTER), WALL_TOP),
        body("upper_x_wall", upper, around(OUTER), WALL_TOP),
        body("lower_y_left_wall", left, lower, WALL_TOP),
        body("lower_y_right_wall", right, lower, WALL_TOP),
        body("upper_y_left_wall", left, upper, WALL_TOP),
        body("upper_y_right_wall", right, upper, WALL_TOP),
    ]
}
