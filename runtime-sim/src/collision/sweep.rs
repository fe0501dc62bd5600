//! Which of many boxes meet.

use super::bounds::BoundingBox;
use crate::point::Axis;

/// Boxes in the order in which they begin along the axis along which they are spread farther.
pub struct Sweep {
    axis: Axis,
    boxes: Vec<(usize, BoundingBox)>,
}

impl Sweep {
    pub fn new(boxes: impl IntoIterator<Item = BoundingBox>) -> Self {
        let mut boxes: Vec<(usize, BoundingBox)> = boxes.into_iter().enumerate().collect();
        let all = boxes.iter().fold(BoundingBox::NOTHING, |all, (_, next)| all.with(next));
        let length = |axis: Axis| all.along(axis)[1] - all.along(axis)[0];
        let axis = if length(Axis::X) >= length(Axis::Y) { Axis::X } else { Axis::Y };
        boxes.sort_by(|(_, a), (_, b)| a.along(axis)[0].total_cmp(&b.along(axis)[0]));
        Self { axis, boxes }
    }

    /// The numbers of each two that are not apart.
    pub fn meeting(&self) -> impl Iterator<Item = [usize; 2]> {
        self.boxes.iter().enumerate().flat_map(move |(i, (number, first))| {
            let end = first.along(self.axis)[1];
            let near =
                self.boxes[i + 1..].iter().take_while(move |(_, next)| next.along(self.axis)[0] <= end);
            near.filter(|(_, next)| !first.is_apart(next)).map(|(other, _)| [*number, *other])
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::random::Random;
    use crate::point::Point;
    use std::collections::BTreeSet;

    #[test]
    fn each_two_that_are_not_apart_are_found_once() {
        let mut random = Random::new(11);
        for spread in [Point::new(9.0, 1.0, 1.0), Point::new(1.0, 9.0, 1.0), Point::new(0.0, 0.0, 0.0)] {
            let drawn: Vec<BoundingBox> = (0..200)
                .map(|_| {
                    let mut part = |length: f64| random.between(0.0, 1.0) * length;
                    let low = Point::new(part(spread.x), part(spread.y), part(spread.z));
                    BoundingBox::between(low, low + Point::new(part(0.9), part(0.9), part(0.9)))
                })
                .collect();
            let pairs = (0..drawn.len()).flat_map(|b| (0..b).map(move |a| [a, b]));
            let expected: BTreeSet<[usize; 2]> =
                pairs.filter(|[a, b]| !drawn[*a].is_apart(&drawn[*b])).collect();
            let sweep = Sweep::new(drawn.iter().copied());
            let found: Vec<[usize; 2]> =
                sweep.meeting().map(|[a, b]| if a < b { [a, b] } else { [b, a] }).collect();
            assert_eq!(found.len(), expected.len());
            assert_eq!(BTreeSet::from_iter(found), expected);
        }
    }
}
