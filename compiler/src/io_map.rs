//! Addresses of the process image for points of I/O: a table that a person fills in a spreadsheet.
//!
//! The table is `plc/io.csv` as `build` writes it, with the last five columns filled. A row without an address
//! leaves its point as it is. The value of an input is `raw * scale + offset`; the raw value of an output is
//! `(value - offset) / scale`, to the nearest whole number.

mod address;
mod columns;
mod overlap;
mod raw;
mod row;

pub use address::{Address, Area, Size};
pub use overlap::Counting;
pub use raw::Raw;

use crate::csv;
use crate::diagnostic::{self, Diagnostic};
use crate::ir::System;
use crate::reads::Reads;
use crate::source::{FileId, Sources};
use columns::Columns;
use runtime_sim::device::Direction;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// A scalar that a sensor or a drive supplies or takes.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Empty for those of the whole line.
    pub robot: String,
    /// In the table of devices, or among the inputs and outputs of the line.
    pub port: String,
    /// The variable, with the index of an element.
    pub name: String,
    pub direction: Direction,
    pub kind: Kind,
    pub unit: String,
    /// What is published while the line does not run; empty for inputs.
    pub stop: String,
    pub meaning: String,
}

/// What a point carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Bool,
    Int { lo: i32, hi: i32 },
    Real,
}

/// Address and raw type of a point in the process image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wire {
    pub address: Address,
    pub raw: Raw,
    pub conversion: Conversion,
}

/// How a raw value becomes the value of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Conversion {
    None,
    /// Of a boolean.
    Inverted,
    /// An integer is the raw value and so much.
    Shifted(i32),
    /// Of a real: `raw * scale + offset`. The scale is finite and not 0.
    Scaled {
        scale: f64,
        offset: f64,
    },
}

/// The wires of a line by the number of their point. Only [`read`] makes one that is not empty, so every wire
/// fits its point and no two addresses overlap.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct IoMap {
    wires: BTreeMap<usize, Wire>,
    counting: Counting,
}

impl IoMap {
    pub fn wire(&self, point: usize) -> Option<&Wire> {
        self.wires.get(&point)
    }

    /// How the addresses count.
    pub fn counting(&self) -> Counting {
        self.counting
    }

    /// How many points have an address.
    pub fn len(&self) -> usize {
        self.wires.len()
    }

    pub fn is_empty(&self) -> bool {
        self.wires.is_empty()
    }

    /// Points without an address that a cabinet needs as soon as others of their robot have one: its outputs,
    /// the inputs that its type reads, and the answers to its commands; the inputs of the line as soon as any
    /// point has one. By robot, empty for the line.
    pub fn gaps<'p>(&self, points: &'p [Point], system: &System) -> Vec<(&'p str, Vec<&'p str>)> {
        let read = inputs_read(system);
        let mut robots: Vec<&str> = Vec::new();
        for point in points {
            if !robots.contains(&point.robot.as_str()) {
                robots.push(&point.robot);
            }
        }
        let of = |robot: &str| {
            let numbered = points.iter().enumerate();
            numbered.filter(|(_, point)| point.robot == robot).collect::<Vec<_>>()
        };
        let is_needed = |point: &Point| match point.direction {
            Direction::Output => !point.robot.is_empty(),
            Direction::Input => {
                let is_read =
                    || read.get(point.robot.as_str()).is_some_and(|read| read.contains(point.port.as_str()));
                point.robot.is_empty() || ["got", "ack", "error"].contains(&point.port.as_str()) || is_read()
            }
        };
        let gaps = robots.into_iter().map(|robot| {
            let own = of(robot);
            let is_used = match robot {
                "" => !self.is_empty(),
                _ => own.iter().any(|(i, _)| self.wires.contains_key(i)),
            };
            let missing = own.iter().filter(|(i, p)| is_used && is_needed(p) && !self.wires.contains_key(i));
            (robot, missing.map(|(_, point)| point.name.as_str()).collect::<Vec<_>>())
        });
        gaps.filter(|(_, missing)| !missing.is_empty()).collect()
    }
}

/// Inputs of the device that the type of each robot reads.
fn inputs_read(system: &System) -> BTreeMap<&str, Rc<BTreeSet<&str>>> {
    let types = system.model.automata.iter();
    let types: Vec<Rc<BTreeSet<&str>>> =
        types.map(|automaton| Rc::new(Reads::of_type(automaton).names_of_inputs().collect())).collect();
    let instances = system.instances.iter();
    instances.map(|instance| (instance.name.as_str(), types[instance.automaton.0].clone())).collect()
}

impl Kind {
    /// The type in Structured Text.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Bool => "BOOL",
            Kind::Int { .. } => "DINT",
            Kind::Real => "LREAL",
        }
    }
}

/// The table of a person against the points of a line. All that is wrong with it is reported at once.
pub fn read(
    sources: &Sources,
    file: FileId,
    points: &[Point],
    counting: Counting,
) -> Result<IoMap, Vec<Diagnostic>> {
    let mut found = Vec::new();
    let table = csv::parse(file, &sources.file(file).text, &mut found);
    let mut wires = BTreeMap::new();
    if let Some(columns) = Columns::find(file, &table, &mut found) {
        let mut rows = row::Rows::new(points, table.separator);
        for record in table.records.iter().skip(1) {
            wires.extend(rows.read(&columns, record, &mut found));
        }
        rows.strangers(&mut found);
        overlap::check(&rows.places, points, counting, &mut found);
    }
    diagnostic::sort(&mut found);
    match found.is_empty() {
        true => Ok(IoMap { wires, counting }),
        false => Err(found),
    }
}
