//! Distances between segments and boxes, exact to rounding.
//!
//! No iteration: a segment's square distance from a box is a convex function of the place on the segment,
//! made of at most seven parabolas; two boxes are nearest on an edge of one of them. Every result is the
//! distance of two points that were found, so it is never too short, and 0 for what meets. With a NaN among
//! the coordinates the result is NaN.

use crate::point::{Point, greater, lesser};

/// A box in any direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    pub middle: Point,
    /// Unit vectors, square to one another.
    pub axes: [Point; 3],
    /// Half of its lengths along them, not negative.
    pub half: [f64; 3],
}

/// How far two shapes are apart, and where they are nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    pub distance: f64,
    /// On the first shape and on the second.
    pub points: [Point; 2],
}

impl Gap {
    fn between(points: [Point; 2]) -> Self {
        Self { distance: (points[1] - points[0]).length(), points }
    }

    /// The nearer one; one without a distance before all.
    fn or(self, other: Self) -> Self {
        if other.distance < self.distance || other.distance.is_nan() { other } else { self }
    }

    /// Seen from the second shape.
    pub fn turned(self) -> Self {
        let [a, b] = self.points;
        Self { points: [b, a], ..self }
    }
}

/// Between two segments, given by their ends. A segment may be a point.
pub fn segment_segment(a: [Point; 2], b: [Point; 2]) -> Gap {
    let (u, v, w) = (a[1] - a[0], b[1] - b[0], a[0] - b[0]);
    let (uu, uv, vv, uw, vw) = (u.dot(u), u.dot(v), v.dot(v), u.dot(w), v.dot(w));
    let gap = |s: f64, t: f64| Gap::between([a[0] + u.scaled(s), b[0] + v.scaled(t)]);
    let on_a = |t: f64| part(t * uv - uw, uu);
    let on_b = |s: f64| part(s * uv + vw, vv);
    // Nearest where both lines are, if that is within both; otherwise at an end of one of them.
    let s = part(uv * vw - vv * uw, uu * vv - uv * uv);
    gap(s, on_b(s))
        .or(gap(0.0, on_b(0.0)))
        .or(gap(1.0, on_b(1.0)))
        .or(gap(on_a(0.0), 0.0))
        .or(gap(on_a(1.0), 1.0))
}

/// `value / of`, at least 0 and at most 1; 0 if there is nothing to divide by.
fn part(value: f64, of: f64) -> f64 {
    if of > 0.0 { (value / of).clamp(0.0, 1.0) } else { 0.0 }
}

impl Block {
    /// A point in the box's own frame.
    fn own(&self, point: Point) -> [f64; 3] {
        let offset = point - self.middle;
        let [u, v, w] = self.axes;
        [offset.dot(u), offset.dot(v), offset.dot(w)]
    }

    /// How far a point of the box's own frame is outside along each axis.
    fn outside(&self, own: [f64; 3]) -> [f64; 3] {
        let along = |i: usize| own[i] - lesser(greater(own[i], -self.half[i]), self.half[i]);
        [along(0), along(1), along(2)]
    }

    /// The point of the box that is nearest to a point.
    fn nearest(&self, point: Point) -> Point {
        let [x, y, z] = self.outside(self.own(point));
        let [u, v, w] = self.axes;
        point - u.scaled(x) - v.scaled(y) - w.scaled(z)
    }

    fn corner(&self, signs: [f64; 3]) -> Point {
        let along = |i: usize| self.axes[i].scaled(self.half[i] * signs[i]);
        self.middle + along(0) + along(1) + along(2)
    }

    /// Bit i of the number of a corner says on which side along axis i it is.
    fn corners(&self) -> [Point; 8] {
        let mut corners = [self.middle; 8];
        for (number, corner) in corners.iter_mut().enumerate() {
            let sign = |i: usize| if number >> i & 1 == 1 { 1.0 } else { -1.0 };
            *corner = self.corner([sign(0), sign(1), sign(2)]);
        }
        corners
    }

    /// The square of a distance that no point between two of the box's own frame is nearer than.
    fn square_apart(&self, start: [f64; 3], end: [f64; 3]) -> f64 {
        let along = |i: usize| {
            let (low, high) = (lesser(start[i], end[i]), greater(start[i], end[i]));
            greater(greater(low - self.half[i], -self.half[i] - high), 0.0)
        };
        let (x, y, z) = (along(0), along(1), along(2));
        x * x + y * y + z * z
    }
}

/// The corners at the ends of each edge.
const EDGES: [[usize; 2]; 12] =
    [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [4, 6], [1, 3], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]];
/// What is rounded in a distance, m, and much more.
const ROUNDED: f64 = 1e-9;

/// Between a segment and a box, 0 if they meet.
pub fn segment_block(segment: [Point; 2], block: &Block) -> Gap {
    let [start, end] = segment;
    let (t, _) = nearest_on([block.own(start), block.own(end)], block);
    gap_at(t, segment, block)
}

/// Between the place `t` on a segment and a box.
fn gap_at(t: f64, segment: [Point; 2], block: &Block) -> Gap {
    let on_segment = segment[0] + (segment[1] - segment[0]).scaled(t);
    Gap::between([on_segment, block.nearest(on_segment)])
}

/// Where on a segment of the box's own frame, 0 to 1, it is nearest to the box, and how near.
fn nearest_on([start, end]: [[f64; 3]; 2], block: &Block) -> (f64, f64) {
    let offset = [end[0] - start[0], end[1] - start[1], end[2] - start[2]];
    let at = |t: f64| [start[0] + t * offset[0], start[1] + t * offset[1], start[2] + t * offset[2]];
    // Half of the slope of the square distance: it grows with t, and is straight between the faces' planes.
    let slope = |t: f64| {
        let [x, y, z] = block.outside(at(t));
        x * offset[0] + y * offset[1] + z * offset[2]
    };
    let found = |t: f64| {
        let [x, y, z] = block.outside(at(t));
        (t, (x * x + y * y + z * z).sqrt())
    };
    let (mut low, mut high) = (0.0, 1.0);
    let (mut falls, mut rises) = (slope(low), slope(high));
    if falls >= 0.0 {
        return found(low);
    }
    if rises <= 0.0 {
        return found(high);
    }
    for i in 0..3 {
        for face in [-block.half[i], block.half[i]] {
            let t = (face - start[i]) / offset[i];
            if t > low && t < high {
                let there = slope(t);
                if there < 0.0 {
                    (low, falls) = (t, there);
                } else {
                    (high, rises) = (t, there);
                }
            }
        }
    }
    found(low + (high - low) * (falls / (falls - rises)).clamp(0.0, 1.0))
}

/// Between two boxes, 0 if they meet.
pub fn block_block(a: &Block, b: &Block) -> Gap {
    // Boxes are nearest on an edge of one of them, and where they meet an edge of one meets the other.
    let of_a = nearest_edge(a, b, f64::INFINITY).unwrap_or(Gap::between([a.middle; 2]));
    if of_a.distance <= 0.0 {
        return of_a;
    }
    nearest_edge(b, a, of_a.distance).map_or(of_a, |of_b| of_a.or(of_b.turned()))
}

/// From the edges of one box to another box; none if all of them are farther than `enough`.
fn nearest_edge(of: &Block, to: &Block, enough: f64) -> Option<Gap> {
    let corners = of.corners();
    let mut own = [[0.0; 3]; 8];
    for (own, corner) in own.iter_mut().zip(corners) {
        *own = to.own(corner);
    }
    // What is no number is never left out.
    let is_known = own.iter().flatten().chain(&to.half).sum::<f64>().is_finite();
    let mut least = enough;
    let mut nearest: Option<([usize; 2], f64)> = None;
    for edge in EDGES {
        let [start, end] = [own[edge[0]], own[edge[1]]];
        let most = least.min(enough) + ROUNDED;
        if is_known && to.square_apart(start, end) > most * most {
            continue;
        }
        let (t, distance) = nearest_on([start, end], to);
        if nearest.is_none() || distance < least || distance.is_nan() {
            nearest = Some((edge, t));
            least = distance;
        }
        if distance <= 0.0 {
            break;
        }
    }
    nearest.map(|([start, end], t)| gap_at(t, [corners[start], corners[end]], to))
}
