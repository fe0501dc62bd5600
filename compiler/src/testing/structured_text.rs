//! Emitted Structured Text as an engine: an evaluator that knows only the text runs it.

use crate::backend::Files;
use crate::executor::Executor;
use crate::ir::{Extent, KeptBy, Scalar, System};
use crate::naming::{camel, snake};
use autogen_st_judge::listed;
use autogen_st_judge::machine::{Machine, Place};
use autogen_st_judge::scl;
use autogen_st_judge::structured::{self, Object};
use runtime_sim::device::{Direction, PortType};
use runtime_sim::scan::{Controllers, SystemInputs, SystemOutputs};

/// A program as it is written, and the table of names that could not stay as the specification has them.
#[derive(Clone, Debug, Default)]
pub struct Emitted {
    pub main: String,
    /// Empty if all names stayed.
    pub names: String,
    shape: Shape,
}

/// How values are kept in a text.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Shape {
    /// A variable for each coordinate, an array for each cell.
    #[default]
    Flat,
    /// Structures.
    Structured,
}

impl Emitted {
    /// The portable flavour.
    pub fn of(files: &Files) -> Self {
        let text = |name: &str| files.get(name).cloned().unwrap_or_default();
        Self::flat(text("portable/main.st"), text("names.csv"))
    }

    /// A text of the portable flavour, and its table of names.
    pub fn flat(main: String, names: String) -> Self {
        Self { main, names, shape: Shape::Flat }
    }

    /// The objects of the CODESYS flavour, as the portable core has them. An error says what is wrong with one.
    pub fn of_codesys(files: &Files) -> Result<Self, String> {
        let objects = files.iter().filter_map(|(name, text)| {
            let name = name.strip_prefix("codesys/").filter(|name| name.ends_with(".st"))?;
            Some(Object { name, text })
        });
        let main = structured::portable(&objects.collect::<Vec<_>>())?;
        let names = files.get("names.csv").cloned().unwrap_or_default();
        Ok(Self { main, names, shape: Shape::Structured })
    }

    /// The source of SCL, as the portable core has it. An error lists what is wrong with the source.
    pub fn of_scl(files: &Files) -> Result<Self, String> {
        let text = |name: &str| files.get(name).cloned().unwrap_or_default();
        let source = text("siemens/main.scl");
        let main = scl::portable(&source)?;
        Ok(Self { main, names: text("names.csv"), shape: Shape::Structured })
    }

    /// The name that a unit has for a wanted one. A coordinate is wanted as `at.x`.
    fn name(&self, unit: &str, wanted: &str) -> String {
        let rows = self.names.lines().skip(1).filter_map(|row| {
            let mut fields = row.split(',');
            Some((fields.next()?, fields.next()?, fields.next()?))
        });
        let mut found = rows.filter(|row| (row.0, row.1) == (unit, wanted));
        found.next().map_or_else(|| wanted.replace('.', "_"), |row| row.2.into())
    }

    /// The names of a coordinate, or of a value that has none.
    fn part(&self, unit: &str, wanted: &str, part: &str) -> String {
        match (self.shape, part) {
            (Shape::Structured, ".x" | ".y" | ".z") => {
                format!("{}_{}", self.name(unit, wanted), &part[1..])
            }
            _ => self.name(unit, &format!("{wanted}{part}")),
        }
    }

    /// A cell, or one of its coordinates.
    fn cell(&self, interface: &str, cell: &str, part: &str) -> String {
        if self.shape == Shape::Flat {
            return self.part("globals", &format!("{}_{cell}", snake(interface)), part);
        }
        let rows = self.name("globals", &format!("{}_cells", snake(interface)));
        let structure = self.name("globals", &format!("ST_{}", camel(interface)));
        format!("{rows}_{}{}", self.name(&structure, cell), part.replace('.', "_"))
    }
}

/// A text that runs a system.
pub struct StructuredText {
    pub machine: Machine,
    scans: u64,
    /// Why a scan could not be ended; none is run after it.
    pub ended: Option<String>,
    /// The most statements that a scan has executed.
    pub most: u64,
    /// For each robot its words; None stands for inputs that the text leaves out.
    inputs: Vec<Vec<Option<Place>>>,
    outputs: Vec<Vec<Place>>,
    states: Vec<Place>,
    trace: Vec<Word>,
    stays: Vec<usize>,
    /// Names of the words of the trace.
    pub names: Vec<String>,
    /// The text has a table of alarms.
    has_alarms: bool,
}

/// A word of the trace.
#[derive(Clone, Copy)]
enum Word {
    At(Place),
    /// The text leaves it out, since it never changes.
    Constant(f64),
}

/// Finds the words of a system in a text.
struct Finder<'a> {
    machine: &'a Machine,
    emitted: &'a Emitted,
    system: &'a System,
    missing: Vec<String>,
}

impl StructuredText {
    /// An error lists the findings of the judge, or the names that are not in the text.
    pub fn new(system: &System, emitted: &Emitted) -> Result<Self, String> {
        let text = &emitted.main;
        let machine = Machine::new(text).map_err(|findings| listed(&findings, text))?;
        let mut finder = Finder { machine: &machine, emitted, system, missing: Vec::new() };
        let mut trace = Vec::new();
        let (mut inputs, mut outputs, mut states) = (Vec::new(), Vec::new(), Vec::new());
        for index in 0..system.instances.len() {
            let (own, answers) = finder.image(index);
            inputs.push(own);
            outputs.push(answers.into_iter().flatten().collect());
            let instance = finder.instance(index);
            states.extend(finder.place(format!("{instance}.state")));
            finder.trace(index, &mut trace);
        }
        if !finder.missing.is_empty() {
            return Err(format!("not in the text: {}", finder.missing.join(" ")));
        }
        let has_alarms = !system.alarms().is_empty();
        let mut first = Vec::new();
        let executor = Executor::new(system);
        executor.trace(&mut first);
        let (names, places): (Vec<_>, Vec<_>) = trace.into_iter().unzip();
        let words = places.into_iter().zip(first);
        let trace = words.map(|(place, first)| place.map_or(Word::Constant(first), Word::At)).collect();
        Ok(Self {
            machine,
            scans: 0,
            ended: None,
            most: 0,
            inputs,
            outputs,
            states,
            trace,
            stays: executor.stays(),
            names,
            has_alarms,
        })
    }
}

impl StructuredText {
    /// Words of the trace that the text leaves out: they are compared with what they were at first.
    pub fn left_out(&self) -> Vec<&str> {
        let words = self.names.iter().zip(&self.trace);
        words.filter(|(_, word)| matches!(word, Word::Constant(_))).map(|(name, _)| name.as_str()).collect()
    }
}

impl StructuredText {
    /// Whether the text has this word of the trace.
    pub fn has(&self, word: usize) -> bool {
        matches!(self.trace[word], Word::At(_))
    }
}

impl Finder<'_> {
    fn place(&mut self, path: String) -> Option<Place> {
        let place = self.machine.place(&path);
        if place.is_none() {
            self.missing.push(path);
        }
        place
    }

    /// The variables of a unit that hold a value: point by coordinate, element by element.
    fn variables(&self, unit: &str, name: &str, is_point: bool, extent: Extent) -> Vec<String> {
        self.parts(is_point, extent, 0, |part| self.emitted.part(unit, name, part))
    }

    /// The elements of a value from one on, each with its coordinates.
    fn parts(
        &self,
        is_point: bool,
        extent: Extent,
        first: usize,
        named: impl Fn(&str) -> String,
    ) -> Vec<String> {
        let parts: &[&str] = if is_point { &[".x", ".y", ".z"] } else { &[""] };
        let mut variables = Vec::new();
        for element in first..first + self.system.model.elements(extent) {
            let index = if extent == Extent::One { String::new() } else { format!("[{element}]") };
            for part in parts {
                variables.push(format!("{}{index}", named(part)));
            }
        }
        variables
    }

    /// The instance of a robot's block in the program.
    fn instance(&self, index: usize) -> String {
        self.emitted.name("MAIN", &self.system.instances[index].name)
    }

    /// Inputs and outputs of a robot in the order of its image. Inputs that no automaton reads may be left out.
    fn image(&mut self, index: usize) -> (Vec<Option<Place>>, Vec<Option<Place>>) {
        let robot = self.system.instances[index].name.clone();
        let (mut inputs, mut outputs) = (Vec::new(), Vec::new());
        for port in &self.system.automaton_of(index).device.ports {
            let name = format!("{robot}_{}", port.name);
            for path in self.variables("globals", &name, port.ty == PortType::Point, port.extent.into()) {
                match port.direction {
                    Direction::Input => inputs.push(self.machine.place(&path)),
                    Direction::Output => outputs.push(self.place(path)),
                }
            }
        }
        (inputs, outputs)
    }

    /// State, elapsed time, locals, cells, outputs before masking: the order of the executor's trace.
    fn trace(&mut self, index: usize, trace: &mut Vec<(String, Option<Place>)>) {
        let instance = &self.system.instances[index];
        let automaton = self.system.automaton_of(index);
        let robot = self.instance(index);
        let block = format!("FB_{}", camel(&automaton.name));
        let tests = self.emitted.name("MAIN", &format!("{}_properties", instance.name));
        let own = |name: &str, is_point, extent| {
            let variables = self.variables(&block, name, is_point, extent);
            variables.into_iter().map(|variable| format!("{robot}.{variable}")).collect::<Vec<_>>()
        };
        let mut paths = vec![format!("{robot}.state"), format!("{robot}.elapsed")];
        for local in &automaton.locals {
            let is_point = local.ty.scalar == Scalar::Point;
            match local.kept_by {
                KeptBy::Steps | KeptBy::Modes => paths.extend(own(&local.name, is_point, local.ty.extent)),
                KeptBy::Properties => {
                    let names = self.variables(&block, &local.name, is_point, local.ty.extent);
                    paths.extend(names.into_iter().map(|name| format!("{tests}.{name}")));
                }
            }
        }
        for (implemented, row) in automaton.implements.iter().zip(&instance.rows) {
            let interface = self.system.model.interface(implemented.interface);
            for cell in &interface.cells {
                let count = self.system.model.elements(cell.ty.extent);
                // A row of scalars has as many elements as there are members.
                let extent = if cell.ty.extent == Extent::One { Extent::Count(1) } else { cell.ty.extent };
                let is_point = cell.ty.scalar == Scalar::Point;
                let named = |part: &str| self.emitted.cell(&interface.name, &cell.name, part);
                paths.extend(self.parts(is_point, extent, row * count, named));
            }
        }
        for port in automaton.device.ports.iter().filter(|p| p.direction == Direction::Output) {
            paths.extend(own(&port.name, port.ty == PortType::Point, port.extent.into()));
        }
        if automaton.can_stop() {
            paths.push(format!("robot_stopped[{index}]"));
        }
        for (entry, alarm) in self.system.alarms().into_iter().enumerate() {
            let columns = ["active", "acknowledged", "count", "first", "last"];
            let columns = columns.iter().filter(|_| alarm.robot == index);
            paths.extend(columns.map(|column| format!("alarms_{column}[{entry}]")));
        }
        for path in paths {
            let place = self.machine.place(&path);
            trace.push((path, place));
        }
    }
}

impl Controllers for StructuredText {
    fn scan(&mut self, system: SystemInputs, inputs: &[Vec<f64>], outputs: &mut [Vec<f64>]) -> SystemOutputs {
        let machine = &mut self.machine;
        for (name, value) in
            [("run_permit", system.run_permit), ("start", system.start), ("reset", system.reset)]
        {
            machine.set(name, f64::from(u8::from(value)));
        }
        for (places, image) in self.inputs.iter().zip(inputs) {
            for (place, value) in places.iter().zip(image) {
                if let Some(place) = place {
                    machine.write(*place, *value);
                }
            }
        }
        let before = machine.executed();
        if self.ended.is_none()
            && let Err(error) = machine.scan()
        {
            self.ended = Some(format!("scan {}: the text stops with {error}", self.scans));
        }
        if self.ended.is_some() {
            return SystemOutputs { fault: true, fault_code: -1, ..SystemOutputs::default() };
        }
        self.scans += 1;
        self.most = self.most.max(self.machine.executed() - before);
        let machine = &self.machine;
        for (places, image) in self.outputs.iter().zip(outputs) {
            image.clear();
            image.extend(places.iter().map(|place| machine.read(*place)));
        }
        SystemOutputs {
            running: machine.get("running") != 0.0,
            fault: machine.get("fault") != 0.0,
            fault_code: machine.get("fault_code") as i32,
            fault_robot: machine.get("fault_robot") as i32,
            alarm: self.has_alarms && machine.get("alarm") != 0.0,
            alarm_code: if self.has_alarms { machine.get("alarm_code") as i32 } else { 0 },
            alarm_robot: if self.has_alarms { machine.get("alarm_robot") as i32 } else { -1 },
        }
    }

    fn power_up(&mut self) {
        self.machine.power_up();
    }

    fn state(&self, machine: usize) -> usize {
        self.machine.read(self.states[machine]) as usize
    }

    fn trace(&self, out: &mut Vec<f64>) {
        out.extend(self.trace.iter().map(|word| match word {
            Word::At(place) => self.machine.read(*place),
            Word::Constant(value) => *value,
        }));
    }

    fn stays(&self) -> Vec<usize> {
        self.stays.clone()
    }

    fn skip(&mut self, scans: u64) {
        assert_eq!(scans, 0, "the text runs in every scan");
    }
}
