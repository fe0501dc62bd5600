//! The contracts of cylinders and processes.

use super::memory::Memory;
use autogen_search::plant::{Input, Level};
use autogen_search::stroke::{Centre, Cylinder, Process, drive, position};
use runtime_sim::machine::Machine;
use runtime_sim::part::cylinder::{self, End};
use runtime_sim::part::process;

/// What changes by itself, of all machines.
#[derive(Debug, Default)]
pub struct Changing {
    pub inputs: Vec<Input>,
    pub cylinders: Vec<Cylinder>,
    pub processes: Vec<Process>,
}

/// A valve, and whether it is on before the system runs.
pub type Valve = (Level, bool);

/// A part of a machine.
#[derive(Clone, Copy)]
pub struct Of<'a> {
    pub machine: &'a Machine,
    pub number: usize,
    pub part: usize,
    pub scan_ms: u64,
}

impl Of<'_> {
    fn name(&self, what: &str) -> String {
        format!("{}.({} {what})", self.machine.name, self.machine.parts[self.part].name)
    }
}

impl Changing {
    /// Before the system runs, its valves have the values that are published then.
    pub fn add_cylinder(
        &mut self,
        of: Of,
        cylinder: &cylinder::Cylinder,
        [extend, retract]: [Option<Valve>; 2],
        memory: &mut Memory,
    ) {
        let (position, begins) = match cylinder.begins {
            End::In => (position::IN, drive::IN),
            End::Out => (position::OUT, drive::OUT),
        };
        let is_on = |valve: Option<Valve>| valve.is_some_and(|(_, is_on)| is_on);
        let sent = match (retract.is_some(), is_on(extend), is_on(retract)) {
            (false, true, _) | (true, true, false) => drive::OUT,
            (false, false, _) | (true, false, true) => drive::IN,
            (true, ..) if cylinder.has_closed_centre => drive::STANDS,
            (true, ..) => begins,
        };
        let centre = match (retract.is_some(), cylinder.has_closed_centre) {
            (false, _) => Centre::Spring,
            (true, true) => Centre::Stands,
            (true, false) => Centre::GoesOn(memory.number(of.number, of.name("toward"), 1, sent)),
        };
        self.cylinders.push(Cylinder {
            machine: of.number,
            part: of.part,
            position: memory.number(of.number, of.name("position"), 2, position),
            drives: memory.number(of.number, of.name("drives"), 7, 1 << sent),
            extend: extend.map(|(level, _)| level),
            retract: retract.map(|(level, _)| level),
            centre,
            leaps: [cylinder.retract_ms, cylinder.extend_ms].map(|ms| ms <= of.scan_ms),
        });
    }

    pub fn add_process(
        &mut self,
        of: Of,
        process: &process::Process,
        start: Option<Valve>,
        memory: &mut Memory,
    ) {
        let mut truth = |what: &str| memory.number(of.number, of.name(what), 1, 0);
        self.processes.push(Process {
            machine: of.number,
            part: of.part,
            asked: truth("asked"),
            runs: truth("runs"),
            ended: truth("ended"),
            start: start.map(|(level, _)| level),
            leaps: process.shortest_ms() <= of.scan_ms,
        });
    }

    pub fn cylinder(&self, machine: usize, part: usize) -> Option<&Cylinder> {
        self.cylinders.iter().find(|cylinder| (cylinder.machine, cylinder.part) == (machine, part))
    }

    pub fn process(&self, machine: usize, part: usize) -> Option<&Process> {
        self.processes.iter().find(|process| (process.machine, process.part) == (machine, part))
    }
}
