//! Ends of conveyors that nearly meet.

use super::tracks::joins;
use crate::frame::Frame;
use crate::line::Line;
use crate::part::Primitive;
use crate::part::lane::CentreLine;
use crate::point::Point;
use std::collections::{BTreeMap, BTreeSet};

/// Ends that are farther from each other were not meant to meet, m and degrees.
const NEAR: f64 = 0.15;
const NEARLY_ALIGNED: f64 = 15.0;

/// A conveyor that ends near the beginning of another one, and does not join it: items fall there.
#[derive(Clone, Debug, PartialEq)]
pub struct Gap {
    /// Machine and part of the one that ends, and of the one that begins.
    pub from: (usize, usize),
    pub to: (usize, usize),
    /// Where the first ends and the second begins.
    pub end: Frame,
    pub begin: Frame,
}

impl Gap {
    /// From the beginning of the second to the end of the first, m.
    pub fn off(&self) -> Point {
        self.end.position - self.begin.position
    }

    /// From the direction of the second to that of the first, degrees to the left.
    pub fn turn(&self) -> f64 {
        crate::frame::whole_turn(self.end.yaw - self.begin.yaw)
    }
}

/// A conveyor of a line, with its centre lines wherever it may be.
struct Conveyor {
    number: (usize, usize),
    lines: Vec<CentreLine>,
    has_sink: bool,
}

/// The gaps of a line. Conveyors that continue as another one, or end in a sink, have none.
pub fn gaps(line: &Line) -> Vec<Gap> {
    let mut conveyors = Vec::new();
    for (number, machine) in line.machines.iter().enumerate() {
        for (part, of) in machine.parts.iter().enumerate() {
            if let Primitive::Lane(lane) = &of.primitive {
                let lines = machine.centre_lines(lane).into_iter().map(|(_, line)| line).collect();
                let has_sink = ends_in_a_sink(line, number, part);
                conveyors.push(Conveyor { number: (number, part), lines, has_sink });
            }
        }
    }
    let begins = Begins::new(&conveyors);
    let mut gaps = Vec::new();
    for from in conveyors.iter().filter(|from| !from.has_sink) {
        let near: Vec<&Conveyor> = begins.near(from).map(|number| &conveyors[number]).collect();
        let others = || near.iter().filter(|to| to.number != from.number);
        let pairs = |to: &Conveyor| -> Vec<(CentreLine, CentreLine)> {
            from.lines.iter().flat_map(|end| to.lines.iter().map(|begin| (*end, *begin))).collect()
        };
        if others().any(|to| pairs(to).iter().any(|(end, begin)| joins(end, begin))) {
            continue;
        }
        for to in others() {
            let near = pairs(to).into_iter().map(|(end, begin)| Gap {
                from: from.number,
                to: to.number,
                end: end.frame(end.end()),
                begin: begin.frame(begin.begin()),
            });
            let near = near.filter(|gap| gap.off().length() <= NEAR && gap.turn().abs() <= NEARLY_ALIGNED);
            gaps.extend(near.min_by(|a, b| a.off().length().total_cmp(&b.off().length())));
        }
    }
    gaps
}

/// Conveyors by the squares of the floor in which they begin.
struct Begins {
    squares: BTreeMap<[i64; 2], BTreeSet<usize>>,
}

impl Begins {
    fn new(conveyors: &[Conveyor]) -> Self {
        let mut squares: BTreeMap<[i64; 2], BTreeSet<usize>> = BTreeMap::new();
        for (number, conveyor) in conveyors.iter().enumerate() {
            for line in &conveyor.lines {
                squares.entry(square(line.frame(line.begin()).position)).or_default().insert(number);
            }
        }
        Self { squares }
    }

    /// Numbers of all that may begin within [`NEAR`] of an end of this one, in their order.
    fn near(&self, from: &Conveyor) -> impl Iterator<Item = usize> {
        let mut near = BTreeSet::new();
        for line in &from.lines {
            let [x, y] = square(line.frame(line.end()).position);
            for i in x - 1..=x + 1 {
                let around = self.squares.range([i, y - 1]..=[i, y + 1]);
                near.extend(around.flat_map(|(_, numbers)| numbers));
            }
        }
        near.into_iter()
    }
}

/// Sides of squares are not shorter than what is near, and joints are nearer.
const SIDE: f64 = 2.0 * NEAR;

fn square(place: Point) -> [i64; 2] {
    [place.x, place.y].map(|along| (along / SIDE).floor() as i64)
}

fn ends_in_a_sink(line: &Line, machine: usize, part: usize) -> bool {
    let parts = &line.machines[machine].parts;
    parts.iter().any(|other| matches!(&other.primitive, Primitive::Sink(sink) if sink.lane == part))
}
