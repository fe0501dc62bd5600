//! A bin. It does nothing.

use crate::carrier::Carrier;
use crate::geometry::{BIN_FLOOR, BIN_SIDE};
use crate::point::Point;

/// What becomes of an item that comes down at this place, if it meets the bin that stands at `pose`.
pub fn below(pose: Point, machine: usize, point: Point) -> Option<(f64, Carrier)> {
    let from_middle = point - pose;
    let meets = from_middle.x.abs() <= BIN_SIDE / 2.0 && from_middle.y.abs() <= BIN_SIDE / 2.0;
    let offset = Point { z: BIN_FLOOR, ..from_middle };
    meets.then_some((pose.z + BIN_FLOOR, Carrier::Bin { machine, offset }))
}
