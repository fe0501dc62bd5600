//! An assembly station: a table with an open briefcase on it.

use super::{Link, Solid, cuboid};
use crate::geometry::{BRIEFCASE, BRIEFCASE_X, BRIEFCASE_Y};
use crate::point::Point;

/// Nominal size of the table (ARIAC 2021, `gear.py`); its lamps and uprights are left out.
const TABLE: Point = Point::new(0.6, 0.6, 1.2);
/// Where the case stands, from the station's pose.
const CASE: Point = Point::new(BRIEFCASE.x, BRIEFCASE.y, TABLE.z);
/// From there the bounds of `briefcase.stl` above the places of the parts, 1.1 times as large as drawn: the lid,
/// which stands upright behind the case.
const LID_X: [f64; 2] = [-0.266, 0.324];
const LID_Y: [f64; 2] = [0.309, 0.449];
const LID_TOP: f64 = 0.768;

/// The case is taken to be filled up to where the parts lie.
pub fn solids(pose: Point) -> Vec<Solid> {
    let body = |name, origin: Point, x: [f64; 2], y: [f64; 2], z: [f64; 2]| {
        let corner = |i: usize| pose + origin + Point::new(x[i], y[i], z[i]);
        cuboid(name, Link::World, corner(0), corner(1))
    };
    let floor = BRIEFCASE.z - TABLE.z;
    let half = |length: f64| [-length / 2.0, length / 2.0];
    vec![
        body("table", Point::default(), half(TABLE.x), half(TABLE.y), [0.0, TABLE.z]),
        body("briefcase", CASE, BRIEFCASE_X, BRIEFCASE_Y, [0.0, floor]),
        body("lid", CASE, LID_X, LID_Y, [floor, LID_TOP]),
    ]
}
