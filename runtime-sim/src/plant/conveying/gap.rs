//! Ends of conveyors that nearly meet.

use super::tracks::joins;
use crate::frame::Frame;
use crate::line::Line;
use crate::part::Primitive;
use crate::part::lane::CentreLine;
use crate::point::Point;

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

/// The gaps of a line. Conveyors that continue as another one, or end in a sink, have none.
pub fn gaps(line: &Line) -> Vec<Gap> {
    let mut lanes = Vec::new();
    for (number, machine) in line.machines.iter().enumerate() {
        for (part, of) in machine.parts.iter().enumerate() {
            if let Primitive::Lane(lane) = &of.primitive {
                let lines: Vec<CentreLine> =
                    machine.centre_lines(lane).into_iter().map(|(_, line)| line).collect();
                lanes.push(((number, part), lines, ends_in_a_sink(line, number, part)));
            }
        }
    }
    let mut gaps = Vec::new();
    for (from, ends, has_sink) in &lanes {
        let others = || lanes.iter().filter(|(to, ..)| to != from);
        let pairs = |begins: &[CentreLine]| -> Vec<(CentreLine, CentreLine)> {
            ends.iter().flat_map(|end| begins.iter().map(|begin| (*end, *begin))).collect()
        };
        let is_joined =
            others().any(|(_, begins, _)| pairs(begins).iter().any(|(end, begin)| joins(end, begin)));
        if *has_sink || is_joined {
            continue;
        }
        for (to, begins, _) in others() {
            let near = pairs(begins).into_iter().map(|(end, begin)| Gap {
                from: *from,
                to: *to,
                end: end.frame(end.end()),
                begin: begin.frame(begin.begin()),
            });
            let near = near.filter(|gap| gap.off().length() <= NEAR && gap.turn().abs() <= NEARLY_ALIGNED);
            gaps.extend(near.min_by(|a, b| a.off().length().total_cmp(&b.off().length())));
        }
    }
    gaps
}

fn ends_in_a_sink(line: &Line, machine: usize, part: usize) -> bool {
    let parts = &line.machines[machine].parts;
    parts.iter().any(|other| matches!(&other.primitive, Primitive::Sink(sink) if sink.lane == part))
}
