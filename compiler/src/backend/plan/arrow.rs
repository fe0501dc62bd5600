//! An arrow from one machine to another one: from outline to outline, so that neither end is hidden in a drawing.

use crate::backend::footprint::Shape;
use runtime_sim::point::Point;

/// A curve with one bend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrow {
    pub from: Point,
    pub bend: Point,
    pub to: Point,
}

/// Places along an arrow that are looked at.
const STEPS: usize = 1000;
/// Less of an arrow would be hidden by its head, m.
const SHORTEST: f64 = 0.25;

impl Arrow {
    /// A bow to one side keeps arrows apart from the paths of vehicles.
    pub fn between(from: Point, to: Point) -> Self {
        let (dx, dy) = (to.x - from.x, to.y - from.y);
        let bend = Point::new((from.x + to.x) / 2.0 - 0.12 * dy, (from.y + to.y) / 2.0 + 0.12 * dx, 0.0);
        Self { from, bend, to }
    }

    /// Without what lies within the shapes in which it begins and ends. Where little is left between them, it begins
    /// within the first one.
    pub fn outside(self, from: &[Shape], to: &[Shape]) -> Self {
        let around = |shapes: &[Shape], end: Point| -> Vec<Shape> {
            shapes.iter().filter(|shape| contains(shape, end)).cloned().collect()
        };
        let (first, last) = (around(from, self.from), around(to, self.to));
        let is_within = |shapes: &[Shape], step: usize| {
            let place = self.at(step as f64 / STEPS as f64);
            shapes.iter().any(|shape| contains(shape, place))
        };
        let begin = (0..=STEPS).find(|step| !is_within(&first, *step)).unwrap_or(0);
        let end = (0..=STEPS).rev().find(|step| !is_within(&last, *step)).unwrap_or(STEPS);
        let parts = [begin, 0].into_iter().filter(|begin| *begin < end);
        let mut parts = parts.map(|begin| self.part(begin as f64 / STEPS as f64, end as f64 / STEPS as f64));
        let length = |part: &Self| (part.to.x - part.from.x).hypot(part.to.y - part.from.y);
        parts.find(|part| length(part) > SHORTEST).unwrap_or(self)
    }

    fn at(&self, t: f64) -> Point {
        self.blend([t, t])
    }

    fn part(&self, begin: f64, end: f64) -> Self {
        Self { from: self.at(begin), bend: self.blend([begin, end]), to: self.at(end) }
    }

    /// The bend of the part between two places; the place itself if both are the same.
    fn blend(&self, [s, t]: [f64; 2]) -> Point {
        let weights = [(1.0 - s) * (1.0 - t), s * (1.0 - t) + t * (1.0 - s), s * t];
        self.from.scaled(weights[0]) + self.bend.scaled(weights[1]) + self.to.scaled(weights[2])
    }
}

/// From above; a line contains nothing.
pub fn contains(shape: &Shape, at: Point) -> bool {
    match shape {
        Shape::Rectangle { centre, size: (x, y) } => {
            (at.x - centre.x).abs() <= x / 2.0 && (at.y - centre.y).abs() <= y / 2.0
        }
        Shape::Circle { centre, radius } => (at.x - centre.x).hypot(at.y - centre.y) <= *radius,
        Shape::Polygon(corners) => {
            let before = corners.iter().cycle().skip(corners.len().saturating_sub(1));
            let sides = corners.iter().zip(before);
            // A ray to the right leaves a polygon that it begins in once more than it enters it.
            let crossed = sides.filter(|(a, b)| {
                (a.y > at.y) != (b.y > at.y) && at.x < a.x + (b.x - a.x) * (at.y - a.y) / (b.y - a.y)
            });
            crossed.count() % 2 == 1
        }
        Shape::Line { .. } => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64) -> Shape {
        Shape::Rectangle { centre: Point::new(x, 0.0, 0.0), size: (1.0, 1.0) }
    }

    #[test]
    fn an_arrow_begins_and_ends_at_the_outlines() {
        let turned = [(4.0, -0.5), (4.5, 0.0), (4.0, 0.5), (3.5, 0.0)].map(|(x, y)| Point::new(x, y, 0.0));
        let arrow = Arrow::between(Point::new(0.0, 0.0, 0.0), Point::new(4.0, 0.0, 0.0));
        let ring = Shape::Circle { centre: arrow.to, radius: 0.5 };
        for end in [Shape::Polygon(turned.to_vec()), ring] {
            let part = arrow.outside(&[square(0.0), square(9.0)], &[end]);
            assert!((part.from.x - 0.5).abs() < 0.01, "{part:?}");
            assert!((3.5..3.7).contains(&part.to.x), "{part:?}");
            // It is a part of the same curve.
            let middle = part.at(0.5);
            let nearest = (0..=STEPS).map(|step| (arrow.at(step as f64 / STEPS as f64) - middle).length());
            assert!(nearest.fold(f64::INFINITY, f64::min) < 0.01);
        }
    }

    #[test]
    fn without_room_between_the_outlines_it_begins_within_the_first_one() {
        // However high one of them is.
        let arrow = Arrow::between(Point::new(0.0, 0.0, 0.0), Point::new(1.05, 0.0, 9.0));
        let part = arrow.outside(&[square(0.0)], &[square(1.05)]);
        assert_eq!(part.from, arrow.from);
        assert!((0.5..0.56).contains(&part.to.x), "{part:?}");
        // Each end lies within the other machine, too.
        assert_eq!(arrow.outside(&[square(0.5)], &[square(0.55)]), arrow);
        assert_eq!(arrow.outside(&[], &[Shape::Line { from: arrow.from, to: arrow.to }]), arrow);
    }
}
