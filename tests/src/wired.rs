//! Structured Text whose points have addresses, beside the executor without any: what stands in the process
//! image is made and read here, from the rules of the table and not from the compiler.

use crate::st::{Beside, Emitted};
use autogen::io_map::{self, Counting, IoMap, Kind, Point};
use autogen::ir::System;
use autogen::source::Sources;
use autogen_st_judge::machine::Place;
use runtime_sim::device::Direction;
use runtime_sim::random::Random;
use runtime_sim::scan::{Controllers, SystemInputs, SystemOutputs};

/// A row of a table that gives an address.
#[derive(Clone, Debug)]
pub struct Row {
    /// Number of the point.
    pub point: usize,
    pub address: String,
    pub raw: &'static str,
    pub scale: f64,
    pub offset: f64,
    pub is_inverted: bool,
}

/// Type, size letter, least and greatest value.
const RAW: [(&str, char, f64, f64); 5] = [
    ("SINT", 'B', -128.0, 127.0),
    ("USINT", 'B', 0.0, 255.0),
    ("INT", 'W', -32_768.0, 32_767.0),
    ("UINT", 'W', 0.0, 65_535.0),
    ("DINT", 'D', -2_147_483_648.0, 2_147_483_647.0),
];

impl Row {
    fn bounds(&self) -> (f64, f64) {
        RAW.iter().find(|(name, ..)| *name == self.raw).map_or((0.0, 1.0), |(_, _, low, high)| (*low, *high))
    }

    /// The raw value that a device sends for a value: the nearest there is.
    fn raw_of(&self, kind: Kind, value: f64) -> f64 {
        let (low, high) = self.bounds();
        match kind {
            Kind::Bool => f64::from(u8::from((value != 0.0) != self.is_inverted)),
            Kind::Int { .. } => (f64::from(value as i32) - self.offset).clamp(low, high),
            Kind::Real => {
                let raw = ((value - self.offset) / self.scale).round();
                // A raw value has no negative zero.
                if raw.is_nan() { 0.0 } else { raw.clamp(low, high) + 0.0 }
            }
        }
    }

    /// The value that a raw value stands for.
    fn value_of(&self, kind: Kind, raw: f64) -> f64 {
        match kind {
            Kind::Bool => f64::from(u8::from((raw != 0.0) != self.is_inverted)),
            Kind::Int { .. } => raw + self.offset,
            Kind::Real => {
                let scaled = if self.scale == 1.0 { raw } else { raw * self.scale };
                if self.offset == 0.0 { scaled } else { scaled + self.offset }
            }
        }
    }

    /// What is wrong with the raw value of an output: a boolean and an integer are exact, a real is the nearest
    /// that the raw type holds.
    fn difference(&self, kind: Kind, value: f64, raw: f64) -> Option<String> {
        let (low, high) = self.bounds();
        let back = self.value_of(kind, raw);
        let is_near = match kind {
            Kind::Real => {
                let ends = [low, high].map(|end| self.value_of(kind, end));
                let held = value.clamp(ends[0].min(ends[1]), ends[0].max(ends[1]));
                // Half a step, and what the arithmetic loses.
                (back - held).abs() <= 0.500001 * self.scale.abs()
            }
            _ => back == value,
        };
        (!is_near || raw != raw.clamp(low, high))
            .then(|| format!("{value} is published as {raw} at {}, which is {back}", self.address))
    }

    fn line(&self, point: &Point) -> String {
        let number = |value: f64, neutral: f64| match (point.kind, value == neutral) {
            (Kind::Bool, _) | (_, true) => String::new(),
            _ => format!("{value}"),
        };
        let (scale, offset) = (number(self.scale, 1.0), number(self.offset, 0.0));
        let inversion = if self.is_inverted { "TRUE" } else { "" };
        format!("{},{},{},{},{scale},{offset},{inversion}\n", point.robot, point.name, self.address, self.raw)
    }
}

/// The table as a person would write it.
pub fn table(points: &[Point], rows: &[Row]) -> String {
    let lines: String = rows.iter().map(|row| row.line(&points[row.point])).collect();
    format!("robot,name,address,raw type,scale,offset,inversion\n{lines}")
}

/// The map that the compiler makes from a table.
pub fn map(points: &[Point], rows: &[Row]) -> IoMap {
    let mut sources = Sources::default();
    let file = sources.add("io.csv", table(points, rows));
    io_map::read(&sources, file, points, Counting::Apart).unwrap_or_else(|found| {
        panic!("{}", autogen::diagnostic::render_plain(&sources, &found));
    })
}

/// A table drawn by lot: three of four points have an address.
pub fn drawn(points: &[Point], seed: u64) -> Vec<Row> {
    let mut random = Random::new(seed);
    let mut rows = Vec::new();
    for (number, point) in points.iter().enumerate() {
        if random.up_to(3) == 0 {
            continue;
        }
        let mut row = Row {
            point: number,
            address: String::new(),
            raw: "BOOL",
            scale: 1.0,
            offset: 0.0,
            is_inverted: false,
        };
        let area = match (random.up_to(5), point.direction) {
            (0, _) => 'M',
            (_, Direction::Input) => 'I',
            (_, Direction::Output) => 'Q',
        };
        if point.kind == Kind::Bool {
            row.is_inverted = random.up_to(1) == 0 && point.name != "run_permit";
            row.address = format!("%{area}X{}.{}", number / 8, number % 8);
        } else {
            let (raw, letter, offset) = number_type(&mut random, point.kind);
            (row.raw, row.offset) = (raw, offset);
            if point.kind == Kind::Real {
                row.scale = [1.0, 0.001, 0.01, -0.002, 1.0e-6, 0.37][random.up_to(5) as usize];
                row.offset = [0.0, 0.0, 1.5, -3.25, 0.1][random.up_to(4) as usize];
            }
            row.address = format!("%{area}{letter}{number}");
        }
        rows.push(row);
    }
    rows
}

/// A type that holds all values of the point, and the offset with which it does.
fn number_type(random: &mut Random, kind: Kind) -> (&'static str, char, f64) {
    loop {
        let (name, letter, low, high) = RAW[random.up_to(4) as usize];
        let offset = [0.0, 0.0, 1.0, -1.0, -100.0][random.up_to(4) as usize];
        let fits = match kind {
            Kind::Int { lo, hi } => f64::from(lo) >= low + offset && f64::from(hi) <= high + offset,
            _ => true,
        };
        if fits {
            return (name, letter, offset);
        }
    }
}

/// Where the value of a point comes from or goes to.
#[derive(Clone, Copy)]
enum Word {
    /// An input or output of the whole line, by its place among them.
    Line(usize),
    /// Robot and word of its image.
    Robot(usize, usize),
}

/// The executor with a text whose points have addresses.
pub struct Wired<'a> {
    pub beside: Beside<'a>,
    /// Row, kind, direction, word, and whether it stands at its address itself.
    rows: Vec<(Row, Kind, Direction, Word, Place, bool)>,
    /// Raw values compared.
    pub compared: u64,
    pub difference: Option<String>,
}

impl<'a> Wired<'a> {
    pub fn new(
        system: &'a System,
        emitted: &Emitted,
        points: &[Point],
        rows: &[Row],
    ) -> Result<Self, String> {
        let beside = Beside::new(system, emitted)?;
        let mut counts = vec![[0; 2]; system.instances.len() + 1];
        let words: Vec<Word> = points
            .iter()
            .map(|point| {
                let robot = system.instances.iter().position(|i| i.name == point.robot);
                let side = usize::from(point.direction == Direction::Output);
                let count = &mut counts[robot.map_or(0, |r| r + 1)][side];
                *count += 1;
                robot.map_or(Word::Line(*count - 1), |r| Word::Robot(r, *count - 1))
            })
            .collect();
        let machine = &beside.text.machine;
        let rows = rows
            .iter()
            .map(|row| {
                let point = &points[row.point];
                let place =
                    machine.at_address(&row.address).ok_or(format!("nothing is at {}", row.address))?;
                let is_itself = machine.place(&point.name) == Some(place);
                Ok((row.clone(), point.kind, point.direction, words[row.point], place, is_itself))
            })
            .collect::<Result<_, String>>()?;
        Ok(Self { beside, rows, compared: 0, difference: None })
    }

    fn compare(&mut self, answer: SystemOutputs, outputs: &[Vec<f64>]) -> Option<String> {
        for (row, kind, _, word, place, _) in self.rows.iter().filter(|row| row.2 == Direction::Output) {
            let value = match word {
                Word::Line(0) => f64::from(u8::from(answer.running)),
                Word::Line(1) => f64::from(u8::from(answer.fault)),
                Word::Line(2) => f64::from(answer.fault_code),
                Word::Line(3) => f64::from(answer.fault_robot),
                Word::Line(4) => f64::from(u8::from(answer.alarm)),
                Word::Line(5) => f64::from(answer.alarm_code),
                Word::Line(_) => f64::from(answer.alarm_robot),
                Word::Robot(robot, word) => outputs[*robot][*word],
            };
            self.compared += 1;
            let difference = row.difference(*kind, value, self.beside.text.machine.read(*place));
            if difference.is_some() {
                return difference;
            }
        }
        None
    }
}

impl Controllers for Wired<'_> {
    /// The executor gets the inputs as the raw values have them; the globals of the text that come from raw
    /// values get something else, which the conversion has to write over.
    fn scan(&mut self, system: SystemInputs, inputs: &[Vec<f64>], outputs: &mut [Vec<f64>]) -> SystemOutputs {
        let mut line = [system.run_permit, system.start, system.reset].map(|b| f64::from(u8::from(b)));
        let mut images = inputs.to_vec();
        let (mut other_line, mut others) = (line, images.clone());
        for (row, kind, _, word, place, is_itself) in self.rows.iter().filter(|row| row.2 == Direction::Input)
        {
            let (value, other) = match word {
                Word::Line(i) => (&mut line[*i], &mut other_line[*i]),
                Word::Robot(robot, i) => (&mut images[*robot][*i], &mut others[*robot][*i]),
            };
            let raw = row.raw_of(*kind, *value);
            *value = row.value_of(*kind, raw);
            *other = if *is_itself { *value } else { 1.0 - *value };
            self.beside.text.machine.write(*place, raw);
        }
        let system_of = |line: [f64; 3]| SystemInputs {
            run_permit: line[0] != 0.0,
            start: line[1] != 0.0,
            reset: line[2] != 0.0,
        };
        self.beside.instead = Some((system_of(other_line), others));
        let answer = self.beside.scan(system_of(line), &images, outputs);
        if self.difference.is_none() {
            let scan = self.beside.scans;
            self.difference = self.beside.difference.clone();
            if self.difference.is_none() {
                self.difference = self.compare(answer, outputs).map(|d| format!("scan {scan}: {d}"));
            }
        }
        answer
    }

    fn power_up(&mut self) {
        self.beside.power_up();
    }

    fn state(&self, machine: usize) -> usize {
        self.beside.state(machine)
    }

    fn trace(&self, out: &mut Vec<f64>) {
        self.beside.trace(out);
    }

    fn stays(&self) -> Vec<usize> {
        self.beside.stays()
    }

    fn skip(&mut self, scans: u64) {
        self.beside.skip(scans);
    }
}
