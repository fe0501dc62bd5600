//! The rectangle that an item takes up, seen from above.

use crate::point::Point;

/// Rectangles that are in one another by no more touch, m.
pub(super) const TOUCHES: f64 = 1e-4;

#[derive(Clone, Copy, Debug)]
pub struct Footprint {
    middle: [f64; 2],
    half: [f64; 2],
    /// Its own x and y.
    axes: [[f64; 2]; 2],
}

impl Footprint {
    /// Of an item of this size whose underside is at a place, turned to the left by so many radians.
    pub fn new(size: Point, place: Point, turn: f64) -> Self {
        let (sin, cos) = libm::sincos(turn);
        Self {
            middle: [place.x, place.y],
            half: [size.x / 2.0, size.y / 2.0],
            axes: [[cos, sin], [-sin, cos]],
        }
    }

    /// Half of its width along a direction.
    fn extent(&self, along: [f64; 2]) -> f64 {
        (0..2).map(|axis| self.half[axis] * dot(self.axes[axis], along).abs()).sum()
    }

    /// Half of its lengths along x and y of what it is given in.
    pub fn half_extents(&self) -> [f64; 2] {
        [[1.0, 0.0], [0.0, 1.0]].map(|along| self.extent(along))
    }

    /// Whether the two have more than an edge in common: no side of one has the other beyond it.
    pub fn overlaps(&self, other: &Self) -> bool {
        let apart = [other.middle[0] - self.middle[0], other.middle[1] - self.middle[1]];
        let mut sides = self.axes.into_iter().chain(other.axes);
        sides.all(|along| dot(apart, along).abs() < self.extent(along) + other.extent(along) - TOUCHES)
    }

    /// Whether a point is over or under it.
    pub fn contains(&self, point: Point) -> bool {
        let from_middle = [point.x - self.middle[0], point.y - self.middle[1]];
        (0..2).all(|axis| dot(from_middle, self.axes[axis]).abs() <= self.half[axis])
    }
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

    #[test]
    fn turned_rectangles_overlap_where_they_have_an_area_in_common() {
        let long = Point::new(0.6, 0.2, 0.1);
        let at = |x: f64, y: f64, turn: f64| Footprint::new(long, Point::new(x, y, 0.0), turn);
        let middle = at(0.0, 0.0, 0.0);
        for (x, y, turn, overlaps) in [
            (0.59, 0.0, 0.0, true),
            (0.6, 0.0, 0.0, false),
            (0.0, 0.2, 0.0, false),
            // Across: 0.3 and 0.1 along x, 0.1 and 0.3 along y.
            (0.39, 0.0, FRAC_PI_2, true),
            (0.4, 0.0, FRAC_PI_2, false),
            (0.0, 0.39, FRAC_PI_2, true),
            (0.0, 0.41, FRAC_PI_2, false),
            (0.39, 0.39, FRAC_PI_2, true),
            // From the corner (0.3, 0.1) its long side is half of its width away, then its short one half of its length.
            (0.36, 0.16, -FRAC_PI_4, true),
            (0.38, 0.18, -FRAC_PI_4, false),
            (0.50, 0.30, FRAC_PI_4, true),
            (0.52, 0.32, FRAC_PI_4, false),
        ] {
            assert_eq!(middle.overlaps(&at(x, y, turn)), overlaps, "{x} {y} {turn}");
            assert_eq!(at(x, y, turn).overlaps(&middle), overlaps, "{x} {y} {turn}");
        }
    }

    #[test]
    fn a_turned_rectangle_contains_what_is_between_its_sides() {
        let (long, middle) = (Point::new(0.6, 0.2, 0.1), Point::new(1.0, 0.0, 0.0));
        for (x, y, turn, contains) in [
            (1.29, 0.09, 0.0, true),
            (1.31, 0.0, 0.0, false),
            (1.0, 0.11, 0.0, false),
            (1.0, 0.29, FRAC_PI_2, true),
            (1.2, 0.2, FRAC_PI_4, true),
            (1.2, 0.2, -FRAC_PI_4, false),
        ] {
            let print = Footprint::new(long, middle, turn);
            assert_eq!(print.contains(Point::new(x, y, 0.5)), contains, "{x} {y} {turn}");
        }
    }
}
