//! What is to go wrong.

use crate::source::Spanned;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Faults {
    pub slips: Vec<Slip<Spanned<String>>>,
    pub refusals: Vec<Refusal<Spanned<String>>>,
    pub answers: Vec<Answer<Spanned<String>>>,
    pub pauses: Vec<Pause>,
    pub power_offs: Vec<Pause>,
    pub sensors: Vec<Stuck<Signal, Spanned<Reading>>>,
    pub jams: Vec<Jam<PartName>>,
    pub slow: Vec<SlowCycle<PartName>>,
}

/// A part falls off the gripper of `robot` so long after its pick number `pick`, counted from 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Slip<Robot> {
    pub robot: Robot,
    pub pick: u32,
    pub after_s: f64,
}

/// `robot` refuses its command number `command`, counted from 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal<Robot> {
    pub robot: Robot,
    pub command: u32,
}

/// How `robot` answers its command number `command`, counted from 1: so late, and in this error if there is one.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer<Robot> {
    pub robot: Robot,
    pub command: u32,
    pub late_s: f64,
    pub error: Option<i32>,
}

/// The permit to run is taken away for a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Pause {
    pub at_s: f64,
    pub for_s: f64,
}

/// An input reads a fixed value for a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Stuck<Of, Value> {
    pub input: Of,
    pub reads: Value,
    pub at_s: f64,
    /// None: to the end of the run.
    pub for_s: Option<f64>,
}

/// An input of a machine, by its names.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal {
    pub robot: Spanned<String>,
    pub signal: Spanned<String>,
    /// None: all of its elements.
    pub element: Option<Spanned<Element>>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Element {
    /// From 0.
    Number(u32),
    Kind(String),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reading {
    Truth(bool),
    Number(f64),
}

/// A part stands for a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Jam<Part> {
    pub part: Part,
    pub at_s: f64,
    /// None: to the end of the run.
    pub for_s: Option<f64>,
}

/// Cycle number `cycle` of a process, counted from 1, takes longer.
#[derive(Clone, Debug, PartialEq)]
pub struct SlowCycle<Part> {
    pub part: Part,
    pub cycle: u32,
    pub longer_s: f64,
}

/// A part of a machine, by its names.
#[derive(Clone, Debug, PartialEq)]
pub struct PartName {
    pub robot: Spanned<String>,
    pub part: Spanned<String>,
}

/// Words of the inputs of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Words {
    pub robot: usize,
    pub first: usize,
    pub count: usize,
}
