//! The shortest path of a disc among rectangles.

use crate::point::Point;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::f64::consts::FRAC_PI_2;
use std::sync::{Mutex, PoisonError};

/// On the plane: lower and upper corner; z has no meaning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    pub low: Point,
    pub high: Point,
}

/// What a disc keeps off, its middle by this distance, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    pub rectangle: Rectangle,
    pub radius: f64,
}

/// Steps in a quarter of a turn between the directions from a corner in which the middle of a disc may pass it.
const AROUND: u32 = 4;
/// It passes a corner at so many radii: between two of these directions it is still farther away than one.
const WIDER: f64 = 1.02;
/// Lengths of the same path that are added up in another way differ by less, as a part of it.
const ROUNDED: f64 = 1e-12;
/// Rectangles that are farther than this from start and goal are not looked at, m.
const DETOUR: f64 = 4.0;

impl Rectangle {
    /// The least that contains both.
    pub fn with(&self, other: &Self) -> Self {
        let [a, b] = [self, other];
        Self {
            low: Point::new(a.low.x.min(b.low.x), a.low.y.min(b.low.y), 0.0),
            high: Point::new(a.high.x.max(b.high.x), a.high.y.max(b.high.y), 0.0),
        }
    }

    pub fn contains(&self, point: Point) -> bool {
        (self.low.x..=self.high.x).contains(&point.x) && (self.low.y..=self.high.y).contains(&point.y)
    }

    /// From a segment, 0 if they meet.
    fn distance(&self, [a, b]: [Point; 2]) -> f64 {
        if self.meets([a, b]) {
            return 0.0;
        }
        let of_ends = self.square_distance(a).min(self.square_distance(b));
        let of_corners = self.corners().into_iter().map(|corner| square_distance(corner, [a, b]));
        of_corners.fold(of_ends, f64::min).sqrt()
    }

    /// Whether a segment is at least so far away.
    fn is_apart(&self, [a, b]: [Point; 2], distance: f64) -> bool {
        let beside = a.x.min(b.x) - self.high.x >= distance || self.low.x - a.x.max(b.x) >= distance;
        let behind = a.y.min(b.y) - self.high.y >= distance || self.low.y - a.y.max(b.y) >= distance;
        beside || behind || self.distance([a, b]) >= distance
    }

    /// What of the segment is between the sides is cut to what is between the others too.
    fn meets(&self, [a, b]: [Point; 2]) -> bool {
        let (mut begin, mut end) = (0.0_f64, 1.0_f64);
        for (from, to, low, high) in
            [(a.x, b.x, self.low.x, self.high.x), (a.y, b.y, self.low.y, self.high.y)]
        {
            if from == to {
                if from < low || from > high {
                    return false;
                }
                continue;
            }
            let [enters, leaves] = [(low - from) / (to - from), (high - from) / (to - from)];
            begin = begin.max(enters.min(leaves));
            end = end.min(enters.max(leaves));
        }
        begin <= end
    }

    fn square_distance(&self, point: Point) -> f64 {
        let x = (self.low.x - point.x).max(point.x - self.high.x).max(0.0);
        let y = (self.low.y - point.y).max(point.y - self.high.y).max(0.0);
        x * x + y * y
    }

    fn corners(&self) -> [Point; 4] {
        let Self { low, high } = *self;
        let corner = |x: f64, y: f64| Point::new(x, y, 0.0);
        [corner(low.x, low.y), corner(high.x, low.y), corner(low.x, high.y), corner(high.x, high.y)]
    }
}

/// Of a point from a segment.
fn square_distance(point: Point, [a, b]: [Point; 2]) -> f64 {
    let [along, beside] = [b - a, point - a];
    let square = along.x * along.x + along.y * along.y;
    let part = (along.x * beside.x + along.y * beside.y) / square;
    let part = if square > 0.0 { part.clamp(0.0, 1.0) } else { 0.0 };
    let [x, y] = [beside.x - part * along.x, beside.y - part * along.y];
    x * x + y * y
}

/// A plane with blocks, and what is known of the places round their corners.
#[derive(Debug)]
pub struct Plane {
    blocks: Vec<Block>,
    area: Rectangle,
    /// The places in the area round the corners of each block, one block after the other.
    corners: Vec<Corner>,
    /// Where those of each block begin, and the end of all.
    begins: Vec<usize>,
    /// From each corner.
    segments: Mutex<Vec<Segments>>,
}

#[derive(Debug)]
struct Corner {
    place: Point,
    /// To which it is too near.
    near: Blocks,
}

/// Where several paths begin.
#[derive(Debug)]
pub struct Start {
    point: Point,
    segments: Segments,
}

/// Of each corner that was looked at from a place: the blocks to which the segment to it is too near.
type Segments = Vec<Option<Blocks>>;

impl Start {
    pub fn new(point: Point) -> Self {
        Self { point, segments: Vec::new() }
    }

    pub fn point(&self) -> Point {
        self.point
    }
}

/// A set of the first [`KNOWN`] blocks by their numbers.
type Blocks = u64;
const KNOWN: usize = Blocks::BITS as usize;

/// A place on the way from start to goal.
#[derive(Clone, Copy)]
struct Place {
    point: Point,
    /// Its number, if it is a corner.
    corner: Option<usize>,
}

/// The blocks near start and goal.
struct Near {
    /// Whether a corner or a segment between two is too near to one of them is known.
    known: Blocks,
    /// All others.
    others: Vec<Block>,
    all: Vec<Block>,
}

impl Near {
    fn is_free(&self, path: [Point; 2]) -> bool {
        keeps_off_all(path, &self.all)
    }

    /// The same of what is between corners, and too near to these blocks.
    fn is_free_beside(&self, near: Blocks, path: [Point; 2]) -> bool {
        near & self.known == 0 && keeps_off_all(path, &self.others)
    }
}

fn keeps_off_all(path: [Point; 2], blocks: &[Block]) -> bool {
    blocks.iter().all(|block| block.rectangle.is_apart(path, block.radius))
}

impl Block {
    /// What is exactly as far away as it has to be is far enough.
    fn rounded(self, radius: f64) -> Self {
        Self { radius: radius - 1e-9, ..self }
    }

    /// Places round its corners.
    fn round_corners(&self) -> impl Iterator<Item = Point> + use<> {
        let Block { rectangle, radius } = *self;
        let middle = rectangle.low + (rectangle.high - rectangle.low).scaled(0.5);
        rectangle.corners().into_iter().flat_map(move |corner| {
            // Away from the rectangle, in a quarter of a turn.
            let away = corner - middle;
            (0..=AROUND).map(move |i| {
                let (y, x) = libm::sincos(FRAC_PI_2 * f64::from(i) / f64::from(AROUND));
                let toward = Point::new(x.copysign(away.x), y.copysign(away.y), 0.0);
                corner + toward.scaled(radius * WIDER)
            })
        })
    }
}

/// To which of these blocks a path is too near.
fn too_near(path: [Point; 2], blocks: &[Block]) -> Blocks {
    let near = blocks.iter().take(KNOWN).map(|block| {
        let block = block.rounded(block.radius);
        !block.rectangle.is_apart(path, block.radius)
    });
    near.enumerate().fold(0, |all, (number, is_near)| all | Blocks::from(is_near) << number)
}

impl Plane {
    pub fn new(blocks: Vec<Block>, area: Rectangle) -> Self {
        let mut corners = Vec::new();
        let mut begins = vec![0];
        for block in &blocks {
            let round = block.rounded(block.radius);
            let places = round.round_corners().filter(|place| area.contains(*place));
            corners.extend(places.map(|place| Corner { place, near: too_near([place; 2], &blocks) }));
            begins.push(corners.len());
        }
        let segments = Mutex::new(vec![Segments::new(); corners.len()]);
        Self { blocks, area, corners, begins, segments }
    }

    /// Whether a disc with its middle here keeps off all blocks.
    pub fn keeps_off(&self, place: Point) -> bool {
        keeps_off_all([place; 2], &self.blocks)
    }

    /// Places to pass between start and goal so that a disc keeps off all blocks, and its middle within the area; where
    /// start or goal are nearer to a block, no nearer than they. None if there is no path.
    pub fn shortest(&self, from: &mut Start, goal: Point) -> Option<Vec<Point>> {
        let start = from.point;
        let mut near = Near { known: 0, others: Vec::new(), all: Vec::new() };
        let mut numbers = Vec::new();
        for (number, block) in self.blocks.iter().enumerate() {
            if block.rectangle.distance([start, goal]) > DETOUR {
                continue;
            }
            let [at_start, at_goal] = [start, goal].map(|end| block.rectangle.distance([end; 2]));
            let radius = block.radius.min(at_start).min(at_goal);
            let is_known = radius == block.radius && number < KNOWN;
            let block = block.rounded(radius);
            near.all.push(block);
            if is_known {
                near.known |= 1 << number;
            } else {
                near.others.push(block);
            }
            numbers.push((number, is_known));
        }
        if near.is_free([start, goal]) {
            return Some(Vec::new());
        }
        let mut places = [start, goal].map(|point| Place { point, corner: None }).to_vec();
        for (block, (number, is_known)) in near.all.iter().zip(numbers) {
            if is_known {
                let corners = self.begins[number]..self.begins[number + 1];
                let free = corners.filter(|corner| {
                    let Corner { place, near: beside } = self.corners[*corner];
                    near.is_free_beside(beside, [place; 2])
                });
                places.extend(
                    free.map(|corner| Place { point: self.corners[corner].place, corner: Some(corner) }),
                );
            } else {
                let round = block.round_corners().filter(|place| self.area.contains(*place));
                let free = round.filter(|place| near.is_free([*place; 2]));
                places.extend(free.map(|point| Place { point, corner: None }));
            }
        }
        self.search(&places, &near, from)
    }

    /// From the first place to the second. Whether a segment is free is looked up if it is known, and asked only when it is
    /// the next on the shortest path if it is not. Numbers that are not negative are in the order of their bits.
    fn search(&self, places: &[Place], near: &Near, from: &mut Start) -> Option<Vec<Point>> {
        let distance = |a: usize, b: usize| (places[b].point - places[a].point).length();
        let still: Vec<f64> = (0..places.len()).map(|place| distance(place, 1)).collect();
        let segment = |a: usize, b: usize| [places[a].point, places[b].point];
        let mut before: Vec<Option<usize>> = vec![None; places.len()];
        // The shortest path to a place of those that are known to be free: no longer one is looked at.
        let mut free_lengths = vec![f64::INFINITY; places.len()];
        let mut queue = BinaryHeap::from([Reverse((still[0].to_bits(), 0, 0, 0))]);
        while let Some(Reverse((_, present, last, gone))) = queue.pop() {
            if before[present].is_some() {
                continue;
            }
            let is_free = match (places[last].corner, places[present].corner) {
                (Some(_), Some(_)) => true,
                (None, Some(corner)) if last == 0 => near.is_free_beside(
                    self.segment(from.point, &mut from.segments, corner),
                    segment(last, present),
                ),
                _ => near.is_free(segment(last, present)),
            };
            if !is_free {
                continue;
            }
            before[present] = Some(last);
            if present == 1 {
                return Some(back_from(1, &before, places));
            }
            let gone = f64::from_bits(gone);
            let straight = gone + still[present];
            if straight < free_lengths[1] && near.is_free(segment(present, 1)) {
                free_lengths[1] = straight;
            }
            // Nothing panics while it is locked.
            let mut segments = self.segments.lock().unwrap_or_else(PoisonError::into_inner);
            let mut known = places[present].corner.map(|corner| &mut segments[corner]);
            for next in (0..places.len()).filter(|next| before[*next].is_none()) {
                let length = gone + distance(present, next);
                let whole = length + still[next];
                if length > free_lengths[next] || whole > free_lengths[1] * (1.0 + ROUNDED) {
                    continue;
                }
                if let (Some(known), Some(corner)) = (&mut known, places[next].corner) {
                    let beside = self.segment(places[present].point, known, corner);
                    if !near.is_free_beside(beside, segment(present, next)) {
                        continue;
                    }
                    free_lengths[next] = length;
                }
                queue.push(Reverse((whole.to_bits(), next, present, length.to_bits())));
            }
        }
        None
    }

    /// The blocks to which the segment from a place to a corner is too near.
    fn segment(&self, from: Point, known: &mut Segments, corner: usize) -> Blocks {
        known.resize(self.corners.len(), None);
        *known[corner].get_or_insert_with(|| too_near([from, self.corners[corner].place], &self.blocks))
    }
}

/// The places between the first one and this.
fn back_from(place: usize, before: &[Option<usize>], places: &[Place]) -> Vec<Point> {
    let steps = std::iter::successors(before[place], |at| before[*at]);
    let mut path: Vec<Point> = steps.take_while(|at| *at != 0).map(|at| places[at].point).collect();
    path.reverse();
    path
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    fn point(x: f64, y: f64) -> Point {
        Point::new(x, y, 0.0)
    }

    fn rectangle(x: [f64; 2], y: [f64; 2]) -> Rectangle {
        Rectangle { low: point(x[0], y[0]), high: point(x[1], y[1]) }
    }

    fn block(rectangle: Rectangle) -> Block {
        Block { rectangle, radius: 0.6 }
    }

    fn area() -> Rectangle {
        rectangle([-10.0, 10.0], [-5.0, 5.0])
    }

    #[test]
    fn without_an_obstacle_it_is_straight() {
        let aside = rectangle([-1.0, 1.0], [0.7, 2.0]);
        assert_eq!(
            Plane::new(vec![block(aside)], area())
                .shortest(&mut Start::new(point(-3.0, 0.0)), point(3.0, 0.0)),
            Some(vec![])
        );
    }

    #[test]
    fn it_goes_round_on_the_shorter_side_and_keeps_off() {
        let wall = rectangle([-0.1, 0.1], [-1.0, 3.0]);
        let ends = [point(-3.0, 0.0), point(3.0, 0.0)];
        let path = Plane::new(vec![block(wall)], area()).shortest(&mut Start::new(ends[0]), ends[1]).unwrap();
        assert!(!path.is_empty() && path.iter().all(|p| p.y < -1.0), "{path:?}");
        let all: Vec<Point> = [ends[0]].into_iter().chain(path).chain([ends[1]]).collect();
        for pair in all.windows(2) {
            assert!(wall.distance([pair[0], pair[1]]) >= 0.6, "{all:?}");
        }
        // The shorter side is closed: it takes the other.
        let closed = rectangle([-10.0, 10.0], [-1.5, 5.0]);
        let path = Plane::new(vec![block(wall)], closed).shortest(&mut Start::new(ends[0]), ends[1]).unwrap();
        assert!(path.iter().all(|p| p.y > 3.0), "{path:?}");
        let shut = rectangle([-10.0, 10.0], [-1.5, 3.5]);
        assert_eq!(Plane::new(vec![block(wall)], shut).shortest(&mut Start::new(ends[0]), ends[1]), None);
    }

    #[test]
    fn who_begins_too_near_comes_no_nearer() {
        let wall = rectangle([-0.1, 0.1], [-1.0, 1.0]);
        let path = Plane::new(vec![block(wall)], area())
            .shortest(&mut Start::new(point(-0.3, 0.0)), point(3.0, 0.0))
            .unwrap();
        let first = [point(-0.3, 0.0), path[0]];
        assert!(wall.distance(first) >= 0.2 - 1e-6, "{path:?}");
    }

    /// Of the shortest path by all places round corners, each with each, m.
    fn least_length(plane: &Plane, [start, goal]: [Point; 2]) -> Option<f64> {
        let blocks: Vec<Block> = plane.blocks.iter().map(|block| block.rounded(block.radius)).collect();
        let round = blocks.iter().flat_map(Block::round_corners);
        let free = round.filter(|place| plane.area.contains(*place) && keeps_off_all([*place; 2], &blocks));
        let places: Vec<Point> = [start, goal].into_iter().chain(free).collect();
        let mut lengths = vec![f64::INFINITY; places.len()];
        lengths[0] = 0.0;
        let mut open: Vec<usize> = (0..places.len()).collect();
        while !open.is_empty() {
            let nearest = (0..open.len()).min_by(|a, b| lengths[open[*a]].total_cmp(&lengths[open[*b]]));
            let from = open.swap_remove(nearest?);
            for to in &open {
                let path = [places[from], places[*to]];
                let length = lengths[from] + (path[1] - path[0]).length();
                if length < lengths[*to] && keeps_off_all(path, &blocks) {
                    lengths[*to] = length;
                }
            }
        }
        lengths[1].is_finite().then_some(lengths[1])
    }

    #[test]
    fn no_path_is_shorter_whatever_was_asked_before() {
        let mut random = Random::new(7);
        let mut drawn = |low: f64, high: f64| low + random.fraction() * (high - low);
        let (mut round, mut none) = (0, 0);
        for _ in 0..12 {
            let blocks = (0..10).map(|_| {
                let [x, y] = [drawn(-4.0, 3.0), drawn(-4.0, 3.0)];
                block(rectangle([x, x + drawn(0.2, 2.0)], [y, y + drawn(0.2, 2.0)]))
            });
            let plane = Plane::new(blocks.collect(), rectangle([-4.5, 4.5], [-4.5, 4.5]));
            let mut place = || loop {
                let place = point(drawn(-4.5, 4.5), drawn(-4.5, 4.5));
                if plane.keeps_off(place) {
                    return place;
                }
            };
            for start in [place(), place()] {
                let mut from = Start::new(start);
                for goal in [place(), place(), place()] {
                    let found = plane.shortest(&mut from, goal).map(|path| {
                        let all: Vec<Point> = [start].into_iter().chain(path).chain([goal]).collect();
                        round += usize::from(all.len() > 3);
                        all.windows(2).map(|pair| (pair[1] - pair[0]).length()).sum::<f64>()
                    });
                    let least = least_length(&plane, [start, goal]);
                    none += usize::from(least.is_none());
                    let are_same = match (found, least) {
                        (Some(found), Some(least)) => (found - least).abs() < 1e-9,
                        _ => found == least,
                    };
                    assert!(are_same, "{start:?} {goal:?}: {found:?}, not {least:?}");
                }
            }
        }
        assert!(round > 10 && none > 0, "{round} past two corners or more, {none} without a path");
    }
}
