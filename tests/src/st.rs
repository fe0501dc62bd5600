//! Emitted Structured Text as an engine, by the evaluator that knows only the text.

use autogen::ir::{Extent, Scalar, System};
use autogen_st_judge::listed;
use autogen_st_judge::machine::{Machine, Place};
use runtime_sim::device::{Direction, PortType};
use runtime_sim::scan::{Controllers, SystemInputs, SystemOutputs};

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
    /// Names of the words of the trace.
    pub names: Vec<String>,
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
    system: &'a System,
    missing: Vec<String>,
}

impl StructuredText {
    /// An error lists the findings of the judge, or the names that are not in the text.
    pub fn new(system: &System, text: &str) -> Result<Self, String> {
        let machine = Machine::new(text).map_err(|findings| listed(&findings, text))?;
        let mut finder = Finder { machine: &machine, system, missing: Vec::new() };
        let mut trace = Vec::new();
        let (mut inputs, mut outputs, mut states) = (Vec::new(), Vec::new(), Vec::new());
        for (index, instance) in system.instances.iter().enumerate() {
            let name = &instance.name;
            let (own, answers) = finder.image(index);
            inputs.push(own);
            outputs.push(answers.into_iter().flatten().collect());
            states.extend(finder.place(format!("{name}.state")));
            finder.trace(index, &mut trace);
        }
        if !finder.missing.is_empty() {
            return Err(format!("not in the text: {}", finder.missing.join(" ")));
        }
        let mut first = Vec::new();
        autogen::executor::Executor::new(system).trace(&mut first);
        let (names, places): (Vec<_>, Vec<_>) = trace.into_iter().unzip();
        let words = places.into_iter().zip(first);
        let trace = words.map(|(place, first)| place.map_or(Word::Constant(first), Word::At)).collect();
        Ok(Self { machine, scans: 0, ended: None, most: 0, inputs, outputs, states, trace, names })
    }
}

impl StructuredText {
    /// Words of the trace that the text leaves out: they are compared with what they were at first.
    pub fn left_out(&self) -> Vec<&str> {
        let words = self.names.iter().zip(&self.trace);
        words.filter(|(_, word)| matches!(word, Word::Constant(_))).map(|(name, _)| name.as_str()).collect()
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

    /// The paths of a variable: point by coordinate, element by element.
    fn paths(&self, name: &str, is_point: bool, extent: Extent, first: usize) -> Vec<String> {
        let count = self.system.model.elements(extent);
        let mut paths = Vec::new();
        for element in first..first + count {
            let index = if extent == Extent::One { String::new() } else { format!("[{element}]") };
            match is_point {
                true => paths.extend(["x", "y", "z"].map(|c| format!("{name}_{c}{index}"))),
                false => paths.push(format!("{name}{index}")),
            }
        }
        paths
    }

    /// Inputs and outputs of a robot in the order of its image. Inputs that no automaton reads may be left out.
    fn image(&mut self, index: usize) -> (Vec<Option<Place>>, Vec<Option<Place>>) {
        let robot = self.system.instances[index].name.clone();
        let (mut inputs, mut outputs) = (Vec::new(), Vec::new());
        for port in self.system.automaton_of(index).device.ports {
            let name = format!("{robot}_{}", port.name);
            for path in self.paths(&name, port.ty == PortType::Point, port.extent.into(), 0) {
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
        let robot = instance.name.clone();
        let mut paths = vec![format!("{robot}.state"), format!("{robot}.elapsed")];
        for local in &automaton.locals {
            let is_point = local.ty.scalar == Scalar::Point;
            let named = |name: &str| self.paths(&format!("{robot}.{name}"), is_point, local.ty.extent, 0);
            // What cannot be a name in the text, or is another one's there, has got an ending.
            // A block's own names keep theirs: a local of that name stands under another one.
            let own = ["state", "elapsed"].contains(&local.name.as_str());
            let endings: &[&str] = if own { &["_v", "_2"] } else { &["", "_v", "_2"] };
            let endings: Vec<_> =
                endings.iter().map(|ending| named(&format!("{}{ending}", local.name))).collect();
            let found = endings.iter().find(|paths| paths.iter().all(|p| self.machine.place(p).is_some()));
            paths.extend_from_slice(found.unwrap_or(&endings[0]));
        }
        for (implemented, row) in automaton.implements.iter().zip(&instance.rows) {
            let interface = self.system.model.interface(implemented.interface);
            for cell in &interface.cells {
                let name = format!("{}_{}", interface.name.to_lowercase(), cell.name);
                let count = self.system.model.elements(cell.ty.extent);
                // A row of scalars has as many elements as there are members.
                let extent = if cell.ty.extent == Extent::One { Extent::Count(1) } else { cell.ty.extent };
                paths.extend(self.paths(&name, cell.ty.scalar == Scalar::Point, extent, row * count));
            }
        }
        for path in paths {
            let place = self.machine.place(&path);
            trace.push((path, place));
        }
        for port in automaton.device.ports.iter().filter(|p| p.direction == Direction::Output) {
            let name = format!("{robot}.{}", port.name);
            for path in self.paths(&name, port.ty == PortType::Point, port.extent.into(), 0) {
                let place = self.machine.place(&path);
                trace.push((path, place));
            }
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
            self.ended = Some(format!("scan {}: the text ends at {error}", self.scans));
        }
        if self.ended.is_some() {
            return SystemOutputs { running: false, fault: true, fault_code: -1, fault_robot: -1 };
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
        }
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
}

/// The reference executor with the text beside it; the first difference stays.
pub struct Beside<'a> {
    pub executor: autogen::executor::Executor<'a>,
    pub text: StructuredText,
    outputs: Vec<Vec<f64>>,
    pub scans: u64,
    /// Words compared.
    pub words: u64,
    pub difference: Option<String>,
}

impl<'a> Beside<'a> {
    pub fn new(system: &'a System, text: &str) -> Result<Self, String> {
        Ok(Self {
            executor: autogen::executor::Executor::new(system),
            text: StructuredText::new(system, text)?,
            outputs: vec![Vec::new(); system.instances.len()],
            scans: 0,
            words: 0,
            difference: None,
        })
    }

    fn compare(
        &mut self,
        outputs: &[Vec<f64>],
        answers: (SystemOutputs, SystemOutputs),
    ) -> Result<(), String> {
        let scan = self.scans;
        if answers.0 != answers.1 {
            return Err(format!("scan {scan}: {:?}, the text {:?}", answers.0, answers.1));
        }
        for (robot, (image, other)) in outputs.iter().zip(&self.outputs).enumerate() {
            self.words += image.len() as u64;
            if image.len() != other.len() || image.iter().zip(other).any(|(a, b)| a.to_bits() != b.to_bits())
            {
                return Err(format!("scan {scan}: robot {robot} publishes {image:?}, the text {other:?}"));
            }
        }
        let (mut trace, mut other) = (Vec::new(), Vec::new());
        self.executor.trace(&mut trace);
        Controllers::trace(&self.text, &mut other);
        if trace.len() != other.len() {
            return Err(format!("the traces have {} and {} words", trace.len(), other.len()));
        }
        self.words += trace.len() as u64;
        match trace.iter().zip(&other).position(|(a, b)| a.to_bits() != b.to_bits()) {
            Some(i) => {
                Err(format!("scan {scan}: {} is {}, in the text {}", self.text.names[i], trace[i], other[i]))
            }
            None => Ok(()),
        }
    }
}

impl Controllers for Beside<'_> {
    fn scan(&mut self, system: SystemInputs, inputs: &[Vec<f64>], outputs: &mut [Vec<f64>]) -> SystemOutputs {
        let answer = self.executor.scan(system, inputs, outputs);
        if self.difference.is_none() {
            let mut own = std::mem::take(&mut self.outputs);
            let other = self.text.scan(system, inputs, &mut own);
            self.outputs = own;
            self.difference =
                self.text.ended.clone().or_else(|| self.compare(outputs, (answer, other)).err());
            self.scans += 1;
        }
        answer
    }

    fn state(&self, machine: usize) -> usize {
        self.executor.state(machine)
    }

    fn trace(&self, out: &mut Vec<f64>) {
        self.executor.trace(out);
    }
}
