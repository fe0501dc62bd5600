//! The upright box that an item takes up where it stands.

use super::footprint::{Footprint, TOUCHES};
use crate::frame::Frame;
use crate::point::Point;

/// Upper side and underside of two items of which one lies on the other one, m.
pub const SAME_HEIGHT: f64 = 1e-6;

#[derive(Clone, Copy, Debug)]
pub struct Block {
    footprint: Footprint,
    size: Point,
    /// Middle of its underside.
    at: Point,
    /// To the left, rad.
    turn: f64,
}

impl Block {
    /// Turned to the left by so many radians.
    pub fn new(size: Point, at: Point, turn: f64) -> Self {
        Self { footprint: Footprint::new(size, at, turn), size, at, turn }
    }

    /// Along its own axes, and upwards.
    pub fn size(&self) -> Point {
        self.size
    }

    /// Middle of its underside.
    pub fn at(&self) -> Point {
        self.at
    }

    /// To the left, rad.
    pub fn turn(&self) -> f64 {
        self.turn
    }

    /// The same with the middle of its underside there.
    pub fn moved_to(&self, at: Point) -> Self {
        Self::new(self.size, at, self.turn)
    }

    /// The same where this frame puts it, in which it was given.
    pub fn in_frame(&self, frame: Frame) -> Self {
        let turned = self.turn + frame.yaw.to_radians();
        Self::new(self.size, frame.point(self.at), turned)
    }

    /// Origin at the middle of its underside, x along its length.
    pub fn frame(&self) -> Frame {
        Frame::new(self.at, self.turn.to_degrees())
    }

    /// Half of its lengths along x and y of what it is given in.
    pub fn half_extents(&self) -> [f64; 2] {
        self.footprint.half_extents()
    }

    /// How far it reaches along x of what it is given in.
    pub fn reach_ahead(&self) -> f64 {
        self.at.x + self.half_extents()[0]
    }

    /// How far it reaches against x.
    pub fn reach_back(&self) -> f64 {
        self.half_extents()[0] - self.at.x
    }

    /// Whether the two would meet if one were moved along x.
    pub fn is_across_from(&self, other: &Self) -> bool {
        let apart = (self.at.y - other.at.y).abs();
        let touch = self.half_extents()[1] + other.half_extents()[1];
        self.is_beside(other) && apart < touch - TOUCHES
    }

    /// Of its upper side.
    pub fn top(&self) -> f64 {
        self.at.z + self.size.z
    }

    /// Whether a part of one is over or under a part of the other.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.footprint.overlaps(&other.footprint)
    }

    pub fn is_under_middle_of(&self, other: &Self) -> bool {
        self.footprint.contains(other.at)
    }

    pub fn lies_on(&self, other: &Self) -> bool {
        (self.at.z - other.top()).abs() < SAME_HEIGHT && self.overlaps(other)
    }

    pub fn is_in(&self, other: &Self) -> bool {
        self.is_beside(other) && self.overlaps(other)
    }

    /// Whether a solid of one item is in one of another item.
    pub fn are_in_one_another(one: &[Self], other: &[Self]) -> bool {
        one.iter().any(|one| other.iter().any(|other| one.is_in(other)))
    }

    /// Whether the two are in one another however they are turned: the upright cylinders inside them are.
    pub fn is_surely_in(&self, other: &Self) -> bool {
        let apart = libm::hypot(self.at.x - other.at.x, self.at.y - other.at.y);
        self.is_beside(other) && apart < self.inner_radius() + other.inner_radius() - TOUCHES
    }

    fn inner_radius(&self) -> f64 {
        f64::min(self.size.x, self.size.y) / 2.0
    }

    /// At the same height, over one another or not.
    fn is_beside(&self, other: &Self) -> bool {
        f64::max(self.at.z - other.top(), other.at.z - self.top()) < -TOUCHES
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn beside_and_over_one_another_they_touch_at_most() {
        let (wide, can) = (Point::new(0.1, 0.2, 0.2), Point::new(0.06, 0.06, 0.1));
        let at = Point::new(1.0, 2.0, 0.5);
        let box_ = Block::new(wide, at, 0.0);
        for (by, is_surely_in, is_in) in [
            (Point::new(0.0, 0.0, 0.0), true, true),
            (Point::new(0.05, 0.05, 0.0), true, true),
            (Point::new(0.08, 0.0, 0.0), false, false),
            (Point::new(0.06, 0.06, 0.0), false, true),
            (Point::new(0.0, 0.0, 0.2), false, false),
            (Point::new(0.0, 0.0, 0.19), true, true),
            (Point::new(0.0, 0.0, -0.1), false, false),
            (Point::new(0.0, 0.0, -0.09), true, true),
            (Point::new(0.0, 0.1, 0.0), false, true),
        ] {
            let can = Block::new(can, at + by, 0.0);
            assert_eq!(can.is_surely_in(&box_), is_surely_in, "{by:?}");
            assert_eq!([can.is_in(&box_), box_.is_in(&can)], [is_in; 2], "{by:?}");
        }
        let across = Block::new(wide, at, FRAC_PI_2);
        assert!(Block::new(can, at + Point::new(0.1, 0.0, 0.0), 0.0).is_in(&across));
    }

    #[test]
    fn an_item_lies_on_what_is_under_any_part_of_it() {
        let size = Point::new(0.4, 0.1, 0.1);
        let lower = Block::new(size, Point::default(), 0.0);
        for (x, z, lies, is_under_middle) in [
            (0.1, 0.1, true, true),
            (0.3, 0.1, true, false),
            (0.4, 0.1, false, false),
            (0.0, 0.11, false, true),
        ] {
            let upper = Block::new(size, Point::new(x, 0.0, z), 0.0);
            assert_eq!(upper.lies_on(&lower), lies, "{x} {z}");
            assert_eq!(lower.is_under_middle_of(&upper), is_under_middle, "{x} {z}");
        }
    }
}
