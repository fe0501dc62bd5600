//! The track that a vehicle follows.

use crate::frame::Frame;
use crate::point::Point;

/// Straight from corner to corner. Places on it are metres along it, from the first corner on; on a closed one they continue
/// beyond its length.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    /// Each with its first corner as origin, x leading along it.
    sides: Vec<Side>,
    is_closed: bool,
    length: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Side {
    from: Frame,
    /// Unit vector along it.
    ahead: Point,
    /// Where it begins.
    place: f64,
    length: f64,
    limits: Limits,
}

/// What a vehicle may not exceed on a side, m/s; infinity: nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    pub speed: f64,
    /// Where the side begins.
    pub entry: f64,
}

impl Limits {
    pub const NONE: Self = Self { speed: f64::INFINITY, entry: f64::INFINITY };
}

/// Sides on which the same limits hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    pub length: f64,
    pub limits: Limits,
}

/// Corners nearer to one another are none, m.
const SHORTEST: f64 = 1e-3;

impl Polyline {
    /// An error says which corner is wrong.
    pub fn new(corners: &[Point], is_closed: bool) -> Result<Self, String> {
        let mut sides: Vec<Side> = Vec::new();
        let mut place = 0.0;
        let last = if is_closed { corners.first() } else { None };
        let ends = corners.iter().skip(1).chain(last);
        for (number, (from, to)) in corners.iter().zip(ends).enumerate() {
            let across = *to - *from;
            if across.z != 0.0 {
                return Err(format!("the track rises at corner {number}: all corners have the same z"));
            }
            let length = across.length();
            if length < SHORTEST {
                return Err(format!("the track has no length at corner {number}"));
            }
            let from = Frame::new(*from, libm::atan2(across.y, across.x).to_degrees());
            sides.push(Side { from, ahead: across.scaled(1.0 / length), place, length, limits: Limits::NONE });
            place += length;
        }
        if sides.is_empty() {
            return Err("a track has two corners at least".into());
        }
        Ok(Self { sides, is_closed, length: place })
    }

    /// The same with limits of each side, in their order.
    pub fn limited(mut self, limits: impl IntoIterator<Item = Limits>) -> Self {
        for (side, limits) in self.sides.iter_mut().zip(limits) {
            side.limits = limits;
        }
        self
    }

    pub fn length(&self) -> f64 {
        self.length
    }

    /// From one place to another: one stretch where nothing is limited, in any direction; else forward.
    pub fn stretches(&self, from: f64, to: f64) -> Vec<Stretch> {
        if self.sides.iter().all(|side| side.limits == Limits::NONE) {
            return vec![Stretch { length: (to - from).abs(), limits: Limits::NONE }];
        }
        let mut stretches: Vec<Stretch> = Vec::new();
        let mut place = from;
        for side in &self.sides[self.side(from)..] {
            let end = (side.place + side.length).min(to);
            let length = end - place;
            place = end;
            match stretches.last_mut() {
                Some(last) if last.limits.speed == side.limits.speed && side.limits.entry == f64::INFINITY => {
                    last.length += length;
                }
                _ => stretches.push(Stretch { length, limits: side.limits }),
            }
            if end >= to {
                break;
            }
        }
        stretches
    }

    pub fn is_closed(&self) -> bool {
        self.is_closed
    }

    /// The same place, from 0 to the length; of an open track the nearest one.
    pub fn on_track(&self, place: f64) -> f64 {
        if !self.is_closed {
            return place.clamp(0.0, self.length);
        }
        let rest = place - self.length * (place / self.length).floor();
        // What is rounded may come to the length.
        if rest < self.length { rest.max(0.0) } else { 0.0 }
    }

    /// The side on which a place of the track lies; where two meet, the second one.
    fn side(&self, place: f64) -> usize {
        self.sides.partition_point(|side| side.place <= place).saturating_sub(1)
    }

    /// The place in the world, x along the track.
    pub fn frame(&self, place: f64) -> Frame {
        let place = self.on_track(place);
        let side = &self.sides[self.side(place)];
        Frame { position: side.from.position + side.ahead.scaled(place - side.place), ..side.from }
    }

    /// Unit vector along the track.
    pub fn ahead(&self, place: f64) -> Point {
        self.sides[self.side(self.on_track(place))].ahead
    }

    pub fn corners(&self) -> Vec<Point> {
        let mut corners: Vec<Point> = self.sides.iter().map(|side| side.from.position).collect();
        if !self.is_closed {
            corners.push(self.frame(self.length).position);
        }
        corners
    }

    /// Both ends of each side.
    pub fn sides(&self) -> impl Iterator<Item = [Point; 2]> {
        self.sides.iter().map(|side| [side.from.position, side.from.position + side.ahead.scaled(side.length)])
    }

    /// What lies on each side from one place of the track to a later one: the direction of the side, degrees, and both ends.
    pub fn pieces(&self, from: f64, to: f64) -> impl Iterator<Item = (f64, [Point; 2])> {
        self.sides[self.side(from)..=self.side(to)].iter().map(move |side| {
            let along = [from, to].map(|place| (place - side.place).clamp(0.0, side.length));
            (side.from.yaw, along.map(|along| side.from.position + side.ahead.scaled(along)))
        })
    }

    /// The next corner behind a place, and by how much the track turns there, degrees.
    fn next_corner(&self, place: f64) -> Option<(f64, f64)> {
        let here = self.on_track(place);
        let side = self.side(here);
        let next = side + 1;
        let end = self.sides[side].place + self.sides[side].length;
        if next == self.sides.len() && !self.is_closed {
            return None;
        }
        let turn = self.sides[next % self.sides.len()].from.yaw - self.sides[side].from.yaw;
        // A place that is rounded to its own corner has not passed it.
        Some((place + (end - here).max(f64::EPSILON * self.length), turn))
    }

    /// The corners between two places, the lower one first, and by how much the track turns at each.
    pub fn corners_between(&self, from: f64, to: f64) -> impl Iterator<Item = (f64, f64)> {
        let first = self.next_corner(from);
        let all = std::iter::successors(first, |(place, _)| self.next_corner(*place));
        all.take_while(move |(place, _)| *place <= to)
    }

    /// How far a point is from the nearest place of a stretch that begins at `from` and ends at `to`, or at the end of the
    /// line, m.
    pub fn distance(&self, point: Point, from: f64, to: f64) -> f64 {
        let to = if self.is_closed { to } else { to.min(self.length) };
        let mut nearest = f64::INFINITY;
        let mut begin = from;
        loop {
            let corner = self.next_corner(begin).map(|(place, _)| place).filter(|place| *place < to);
            let end = corner.unwrap_or(to);
            let side = &self.sides[self.side(self.on_track(begin))];
            let start = self.frame(begin).position;
            let along = (point - start).dot(side.ahead).clamp(0.0, (end - begin).max(0.0));
            nearest = nearest.min((point - start - side.ahead.scaled(along)).length());
            match corner {
                Some(corner) => begin = corner,
                None => return nearest,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> Polyline {
        let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
        Polyline::new(&corners.map(|[x, y]| Point::new(x, y, 0.0)), true).expect("a track")
    }

    #[test]
    fn a_place_is_the_same_after_a_round() {
        let polyline = square();
        for place in [0.0, 3.0, 4.0, 9.5, 15.999] {
            let (here, again) = (polyline.frame(place), polyline.frame(place + 32.0));
            assert!((here.position - again.position).length() < 1e-12);
            assert_eq!(here.yaw, again.yaw, "{place}");
        }
    }

    #[test]
    fn at_a_corner_the_line_turns() {
        let polyline = square();
        assert_eq!(polyline.frame(4.0).yaw, 90.0);
        let corners: Vec<f64> = polyline.corners_between(3.0, 17.0).map(|(place, _)| place).collect();
        assert_eq!(corners, [4.0, 8.0, 12.0, 16.0]);
        assert_eq!(polyline.corners_between(4.0, 7.9).count(), 0);
    }

    #[test]
    fn pieces_end_at_their_places() {
        let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0]].map(|[x, y]| Point::new(x, y, 0.0));
        let polyline = Polyline::new(&corners, false).expect("a track");
        let pieces = |from, to| -> Vec<(f64, [[f64; 2]; 2])> {
            let flat = |(yaw, ends): (f64, [Point; 2])| (yaw, ends.map(|end| [end.x, end.y]));
            polyline.pieces(from, to).map(flat).collect()
        };
        assert_eq!(pieces(1.0, 3.0), [(0.0, [[1.0, 0.0], [3.0, 0.0]])]);
        assert_eq!(pieces(3.0, 5.0), [(0.0, [[3.0, 0.0], [4.0, 0.0]]), (90.0, [[4.0, 0.0], [4.0, 1.0]])]);
        // At a corner it looks along the second side.
        assert_eq!(pieces(4.0, 4.0), [(90.0, [[4.0, 0.0]; 2])]);
        assert_eq!(pieces(8.0, 8.0), [(90.0, [[4.0, 4.0]; 2])]);
    }

    #[test]
    fn nothing_is_seen_beyond_the_end_of_an_open_line() {
        let corners = [[0.0, 0.0], [6.0, 0.0]].map(|[x, y]| Point::new(x, y, 0.0));
        let polyline = Polyline::new(&corners, false).expect("a track");
        assert!((polyline.distance(Point::new(7.5, 0.0, 0.0), 5.0, 8.0) - 1.5).abs() < 1e-12);
    }

    #[test]
    fn the_distance_is_that_of_the_nearest_place_round_corners() {
        let polyline = square();
        let point = Point::new(4.5, 2.0, 0.0);
        assert!((polyline.distance(point, 3.0, 7.0) - 0.5).abs() < 1e-12);
        // The stretch ends a metre before.
        assert!((polyline.distance(point, 3.0, 5.0) - 1.25_f64.sqrt()).abs() < 1e-12);
        // All round.
        assert!((polyline.distance(Point::new(-1.0, 2.0, 0.0), 3.0, 15.0) - 1.0).abs() < 1e-12);
    }
}
