//! The reference executor: runs a system straight from the IR, as `docs/semantics.md` says.

mod evaluate;
mod modes;
mod properties;
mod restart;
mod step;

use crate::device::Port;
use crate::ir::{Element, FaultId, Scalar, System, Type, Value, VariableId};
pub use properties::Alarm;
use properties::Seen;
use runtime_sim::device::{Direction, PortType, Stop};
use runtime_sim::scan::{Controllers, SystemInputs, SystemOutputs};

/// A system in execution.
#[derive(Clone, Debug)]
pub struct Executor<'a> {
    system: &'a System,
    robots: Vec<Robot>,
    /// `[interface][row][cell][element]`.
    cells: Vec<Vec<Vec<Vec<Value>>>>,
    status: Status,
    /// The permit of this scan.
    permit: bool,
    /// Scans since power-up; saturates.
    scan: i32,
    /// For each automaton, state and transition: how often it has fired.
    fired: Vec<Vec<Vec<u64>>>,
    journal: Option<Vec<Entry>>,
    /// The only instance that steps, if not all do.
    only: Option<usize>,
}

/// What happened in a scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entry {
    /// An instance, or its device for an input, has changed a value.
    Changed { robot: usize, what: Element },
    /// A transition of the state in which the instance was, by its number.
    Fired { robot: usize, transition: usize },
    /// An instance is in its beginning again, and was in another state.
    BeganAnew { robot: usize },
}

#[derive(Clone, Debug)]
struct Robot {
    state: usize,
    /// Time in the present state, ms; saturates.
    elapsed: i32,
    locals: Vec<Vec<Value>>,
    /// Latched inputs and unmasked outputs, `[port][element]`.
    ports: Vec<Vec<Value>>,
    /// Values of variables of binders and quantifiers.
    variables: Vec<Value>,
    alarms: Vec<Alarm>,
    /// It makes no steps, and its device is held.
    stopped: bool,
    seen: Seen,
}

#[derive(Clone, Copy, Debug)]
struct Status {
    running: bool,
    fault: Option<(FaultId, usize)>,
    start_before: bool,
    reset_before: bool,
}

impl Status {
    const NEW: Self = Self { running: false, fault: None, start_before: true, reset_before: true };
}

impl<'a> Executor<'a> {
    pub fn new(system: &'a System) -> Self {
        let model = &system.model;
        let filled = |ty: Type, value: Value| vec![value; model.elements(ty.extent)];
        let robots = system
            .instances
            .iter()
            .map(|instance| {
                let automaton = model.automaton(instance.automaton);
                let ports = automaton
                    .device
                    .ports
                    .iter()
                    .map(|port| vec![Self::first_value(port.ty); port.extent.elements(system.kinds())]);
                Robot {
                    state: 0,
                    elapsed: 0,
                    locals: automaton.locals.iter().map(|l| filled(l.ty, l.initial)).collect(),
                    ports: ports.collect(),
                    variables: vec![Value::Int(0); automaton.variables.len()],
                    alarms: vec![Alarm::NONE; automaton.alarms().count()],
                    stopped: false,
                    seen: Seen::default(),
                }
            })
            .collect();
        let cells = model
            .interfaces
            .iter()
            .zip(&system.members)
            .map(|(interface, members)| {
                let row: Vec<_> = interface.cells.iter().map(|c| filled(c.ty, c.initial)).collect();
                vec![row; members.len()]
            })
            .collect();
        let fired = model
            .automata
            .iter()
            .map(|a| a.states.iter().map(|s| vec![0; s.transitions.len()]).collect())
            .collect();
        Self { cells, fired, ..Self::of_robots(system, robots) }
    }

    /// For expressions that read nothing but what the layout fixes: instances have neither cells nor ports nor locals.
    pub fn without_values(system: &'a System) -> Self {
        let robots = system.instances.iter().map(|instance| Robot {
            state: 0,
            elapsed: 0,
            locals: Vec::new(),
            ports: Vec::new(),
            variables: vec![Value::Int(0); system.model.automaton(instance.automaton).variables.len()],
            alarms: Vec::new(),
            stopped: false,
            seen: Seen::default(),
        });
        Self::of_robots(system, robots.collect())
    }

    fn of_robots(system: &'a System, robots: Vec<Robot>) -> Self {
        Self {
            system,
            robots,
            cells: Vec::new(),
            status: Status::NEW,
            permit: false,
            scan: 0,
            fired: Vec::new(),
            journal: None,
            only: None,
        }
    }

    /// What a port is at power-up.
    fn first_value(ty: PortType) -> Value {
        match ty {
            PortType::Bool => Value::Bool(false),
            PortType::Int { lo, hi } => Value::Int(0.clamp(lo, hi)),
            PortType::Real => Value::Real(0.0),
            PortType::Point => Value::Point([0.0; 3]),
        }
    }

    /// Keeps what happens, until [`Self::take_journal`].
    pub fn keep_journal(&mut self) {
        self.journal = Some(Vec::new());
    }

    /// What has happened since the last time, in order.
    pub fn take_journal(&mut self) -> Vec<Entry> {
        self.journal.as_mut().map(std::mem::take).unwrap_or_default()
    }

    /// Stores a value that an instance has changed, or that changes with it.
    fn put(&mut self, robot: usize, what: Element, value: Value) {
        let changed = self.element(what) != value;
        // What is equal is stored too: -0.0 is equal to 0.0, and is another value.
        self.set(what, value);
        if changed {
            self.note(Entry::Changed { robot, what });
        }
    }

    fn put_local(&mut self, robot: usize, local: usize, value: Value) {
        for index in 0..self.robots[robot].locals[local].len() {
            self.put(robot, Element::Local { robot, local, index }, value);
        }
    }

    /// A port is as at power-up.
    fn put_first(&mut self, robot: usize, port: usize) {
        let value = Self::first_value(self.system.automaton_of(robot).device.ports[port].ty);
        for index in 0..self.robots[robot].ports[port].len() {
            self.put(robot, Element::Port { robot, port, index }, value);
        }
    }

    fn put_beginning(&mut self, robot: usize) {
        if std::mem::take(&mut self.robots[robot].state) != 0 {
            self.note(Entry::BeganAnew { robot });
        }
    }

    fn note(&mut self, entry: Entry) {
        if let Some(journal) = &mut self.journal {
            journal.push(entry);
        }
    }

    /// From now on no other instance makes steps: somebody else plays the others.
    pub fn step_only(&mut self, robot: usize) {
        self.only = Some(robot);
    }

    /// Writes a value as another instance does.
    pub fn set(&mut self, element: Element, value: Value) {
        match element {
            Element::Local { robot, local, index } => self.robots[robot].locals[local][index] = value,
            Element::Cell { interface, row, cell, index } => {
                self.cells[interface.0][row][cell][index] = value
            }
            Element::Port { robot, port, index } => self.robots[robot].ports[port][index] = value,
        }
    }

    pub fn is_running(&self) -> bool {
        self.status.running
    }

    /// Time of an instance in its present state, ms.
    pub fn elapsed(&self, robot: usize) -> i32 {
        self.robots[robot].elapsed
    }

    pub fn element(&self, element: Element) -> Value {
        match element {
            Element::Local { robot, local, index } => self.robots[robot].locals[local][index],
            Element::Cell { interface, row, cell, index } => self.cells[interface.0][row][cell][index],
            Element::Port { robot, port, index } => self.robots[robot].ports[port][index],
        }
    }

    /// How often each transition has fired: `[automaton][state][transition]`.
    pub fn fired(&self) -> &[Vec<Vec<u64>>] {
        &self.fired
    }

    /// The variables of binders and quantifiers of an instance, for [`Self::restore`].
    pub(crate) fn variables(&self, robot: usize) -> Vec<Value> {
        self.robots[robot].variables.clone()
    }

    pub(crate) fn restore(&mut self, robot: usize, variables: Vec<Value>) {
        self.robots[robot].variables = variables;
    }

    pub(crate) fn bind(&mut self, robot: usize, variable: VariableId, value: Value) {
        self.robots[robot].variables[variable.0] = value;
    }

    fn latch(&mut self, inputs: &[Vec<f64>]) {
        let kinds = self.system.kinds();
        for (robot, words) in inputs.iter().enumerate().take(self.robots.len()) {
            let mut words = &words[..];
            let ports = self.system.automaton_of(robot).device.ports.iter().enumerate();
            for (number, port) in ports.filter(|(_, port)| port.direction == Direction::Input) {
                for index in 0..port.extent.elements(kinds) {
                    let ty = Scalar::from(port.ty);
                    let latched = Value::from_words(ty, words);
                    words = words.get(ty.words()..).unwrap_or_default();
                    let value = &mut self.robots[robot].ports[number][index];
                    if std::mem::replace(value, latched) != latched {
                        let what = Element::Port { robot, port: number, index };
                        self.note(Entry::Changed { robot, what });
                    }
                }
            }
        }
    }

    fn publish(&mut self, outputs: &mut [Vec<f64>]) {
        for (index, image) in outputs.iter_mut().enumerate() {
            image.clear();
            let runs = self.status.running && !self.robots[index].stopped;
            match &self.system.automaton_of(index).modes {
                Some(modes) => self.outputs_of_mode(index, modes, runs, image),
                None => self.published(index, runs, image),
            }
        }
    }

    /// Appends what an instance without a panel publishes: stop values unless it runs.
    fn published(&self, index: usize, runs: bool, image: &mut Vec<f64>) {
        let is_held = !runs || self.is_abandoned(index);
        for (port, values) in self.outputs(index) {
            match port.stop {
                Stop::Value(stop) if !runs || is_held && port.name == "hold" => {
                    image.extend(values.iter().map(|_| stop));
                }
                _ => values.iter().for_each(|v| v.push_words(image)),
            }
        }
    }

    /// The outputs of an instance as its automaton has them.
    fn outputs(&self, index: usize) -> impl Iterator<Item = (&Port, &Vec<Value>)> {
        let ports = self.system.automaton_of(index).device.ports.iter().zip(&self.robots[index].ports);
        ports.filter(|(port, _)| port.direction == Direction::Output)
    }

    /// Modes and steps in layout order, then properties, up to the first fault. Modes are checked whatever happens.
    fn turns(&mut self, starts: bool) -> Result<(), (FaultId, usize)> {
        let only = self.only;
        let stepping = move |index: &usize| only.is_none_or(|only| only == *index);
        let mut so_far = Ok(());
        for index in (0..self.robots.len()).filter(stepping) {
            self.operate(index);
            if self.status.running && so_far.is_ok() {
                so_far = self.step(index).map_err(|fault| (fault, index));
            }
        }
        so_far?;
        if self.status.running {
            for index in (0..self.robots.len()).filter(stepping) {
                self.properties(index, starts).map_err(|fault| (fault, index))?;
            }
        }
        Ok(())
    }
}

impl Controllers for Executor<'_> {
    fn scan(&mut self, system: SystemInputs, inputs: &[Vec<f64>], outputs: &mut [Vec<f64>]) -> SystemOutputs {
        self.latch(inputs);
        let status = &mut self.status;
        let faulted_before = status.fault.is_some();
        let reset = system.reset && !status.reset_before;
        let cleared = reset && status.fault.take().is_some();
        let start = system.start && !status.start_before;
        status.start_before = system.start;
        status.reset_before = system.reset;
        if !system.run_permit || status.fault.is_some() {
            status.running = false;
        } else if start && !faulted_before {
            status.running = true;
        }
        if reset {
            self.acknowledge();
        }
        if cleared {
            self.robots.iter_mut().for_each(|robot| robot.elapsed = 0);
            self.observe_anew();
        }
        self.permit = system.run_permit;
        if let Err(fault) = self.turns(start) {
            self.status.fault = Some(fault);
            self.status.running = false;
        }
        self.publish(outputs);
        self.scan = self.scan.saturating_add(1);
        self.tell_alarms(SystemOutputs {
            running: self.status.running,
            fault: self.status.fault.is_some(),
            fault_code: self.status.fault.map_or(0, |(fault, _)| fault.0 as i32 + 1),
            fault_robot: self.status.fault.map_or(-1, |(_, robot)| robot as i32),
            ..SystemOutputs::default()
        })
    }

    fn state(&self, machine: usize) -> usize {
        self.robots[machine].state
    }

    fn stays(&self) -> Vec<usize> {
        let mut stays = Vec::new();
        let mut trace = Vec::new();
        for index in 0..self.robots.len() {
            stays.push(trace.len() + 1);
            self.trace_of(index, &mut trace);
        }
        stays
    }

    fn skip(&mut self, scans: u64) {
        self.scan = self.scan.saturating_add(i32::try_from(scans).unwrap_or(i32::MAX));
        if !self.status.running {
            return;
        }
        let passed = i32::try_from(scans).unwrap_or(i32::MAX).saturating_mul(self.system.scan_ms);
        for index in 0..self.robots.len() {
            let robot = &mut self.robots[index];
            if !robot.stopped {
                robot.elapsed = robot.elapsed.saturating_add(passed);
                self.wait(index, passed);
            }
        }
    }

    fn power_up(&mut self) {
        self.begin_with_what_is_retained();
    }

    fn trace(&self, out: &mut Vec<f64>) {
        (0..self.robots.len()).for_each(|index| self.trace_of(index, out));
    }
}

impl Executor<'_> {
    fn trace_of(&self, index: usize, out: &mut Vec<f64>) {
        let robot = &self.robots[index];
        out.push(robot.state as f64);
        out.push(f64::from(robot.elapsed));
        robot.locals.iter().flatten().for_each(|v| v.push_words(out));
        let automaton = self.system.automaton_of(index);
        for (implemented, row) in automaton.implements.iter().zip(&self.system.instances[index].rows) {
            self.cells[implemented.interface.0][*row].iter().flatten().for_each(|v| v.push_words(out));
        }
        self.outputs(index).flat_map(|(_, values)| values).for_each(|v| v.push_words(out));
        if automaton.can_stop() {
            out.push(f64::from(u8::from(robot.stopped)));
        }
        robot.alarms.iter().for_each(|alarm| alarm.push_words(out));
    }
}
