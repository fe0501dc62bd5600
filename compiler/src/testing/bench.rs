//! A machine on the bench: its inputs are given, scan by scan, and what it does is looked at.

use super::machine::{Engine, Poke, Step, Target, Wanted};
use super::names::{all, name_of, words};
use super::value::{Kind, Named};
use super::{Failure, Time};
use crate::ir::Element;
use crate::ir::{Scalar, System, Type, Value};
use crate::source::Span;
use runtime_sim::device::Direction;
use runtime_sim::scan::SystemInputs;
use std::collections::VecDeque;

/// Events that a failure tells.
const MOST_EVENTS: usize = 12;

pub(super) struct Bench<'e, 'a, 's> {
    system: &'s System,
    machine: usize,
    engine: Engine<'e, 'a>,
    /// Where the trace of each machine begins.
    begins: Vec<usize>,
    inputs: Vec<Vec<f64>>,
    outputs: Vec<Vec<f64>>,
    trace: Vec<f64>,
    /// Scans since the line was started; the one before is -1.
    now: i64,
    fault: Option<String>,
    events: VecDeque<(u64, String)>,
    /// What the machine writes, by name, with its place in the trace.
    values: Vec<(String, Named, usize)>,
}

impl<'e, 'a, 's> Bench<'e, 'a, 's> {
    pub fn new(system: &'s System, machine: usize, mut engine: Engine<'e, 'a>) -> Self {
        let kinds = system.kinds();
        let images = |direction: Direction| -> Vec<Vec<f64>> {
            let words =
                (0..system.instances.len()).map(|i| system.automaton_of(i).device.words(direction, kinds));
            words.map(|words| vec![0.0; words]).collect()
        };
        if let Engine::Executor(executor) = &mut engine {
            executor.step_only(machine);
        }
        // The time in a state stands behind the state.
        let begins = engine.controllers().stays().into_iter().map(|stay| stay - 1).collect();
        let (inputs, outputs) = (images(Direction::Input), images(Direction::Output));
        let mut bench = Self {
            system,
            machine,
            engine,
            begins,
            inputs,
            outputs,
            trace: Vec::new(),
            now: -2,
            fault: None,
            events: VecDeque::new(),
            values: Vec::new(),
        };
        let all = all(system, machine).into_iter();
        bench.values = all.map(|(name, named)| (name, named, bench.offset(named.element))).collect();
        bench
    }

    fn ms(&self) -> u64 {
        self.now.max(0) as u64 * self.system.scan_ms as u64
    }

    fn tell(&mut self, text: String) {
        let ms = self.ms();
        self.events.push_back((ms, text));
        if self.events.len() > MOST_EVENTS {
            self.events.pop_front();
        }
    }

    pub fn scan(&mut self, start: bool) {
        self.now += 1;
        let system = SystemInputs { run_permit: true, start, reset: false };
        let answer = self.engine.controllers().scan(system, &self.inputs, &mut self.outputs);
        let before = std::mem::take(&mut self.trace);
        let mut trace = Vec::new();
        self.engine.controllers().trace(&mut trace);
        self.trace = trace;
        if !before.is_empty() {
            self.tell_changes(&before);
        }
        let faults = &self.system.model.faults;
        let site = usize::try_from(answer.fault_code - 1).ok().and_then(|code| faults.get(code));
        let fault = site.filter(|_| answer.fault).map(|site| site.text.clone());
        if let Some(text) = &fault
            && self.fault.is_none()
        {
            self.tell(format!("fault: {text}"));
        }
        self.fault = fault;
    }

    fn tell_changes(&mut self, before: &[f64]) {
        let system = self.system;
        let begin = self.begins[self.machine];
        let automaton = system.automaton_of(self.machine);
        let state =
            |trace: &[f64]| automaton.states.get(trace[begin] as usize).map_or("?", |state| &state.name);
        if state(before) != state(&self.trace) {
            self.tell(state(&self.trace).to_string());
        }
        let values = std::mem::take(&mut self.values);
        for (name, named, at) in &values {
            let words = *at..*at + words(named.ty);
            if before[words.clone()] != self.trace[words] {
                let value = self.value(&self.trace, named);
                self.tell(format!("{name} = {}", system.shown_value(named.ty, value)));
            }
        }
        self.values = values;
    }

    /// A value of a trace.
    fn value(&self, trace: &[f64], named: &Named) -> Value {
        let at = self.offset(named.element);
        let word = |i: usize| trace.get(at + i).copied().unwrap_or(0.0);
        match named.ty {
            Scalar::Bool => Value::Bool(word(0) != 0.0),
            Scalar::Real => Value::Real(word(0)),
            Scalar::Point => Value::Point([word(0), word(1), word(2)]),
            Scalar::Int { .. } | Scalar::Time | Scalar::Enum(_) | Scalar::Ref(_) => {
                Value::Int(word(0) as i32)
            }
        }
    }

    /// Where the words of a value begin in a trace.
    fn offset(&self, element: Element) -> usize {
        let system = self.system;
        let of = |ty: Type| words(ty.scalar) * system.model.elements(ty.extent);
        let robot = match element {
            Element::Local { robot, .. } | Element::Port { robot, .. } => robot,
            Element::Cell { interface, row, .. } => system.members[interface.0][row],
        };
        let automaton = system.automaton_of(robot);
        // The state and the time in it come first.
        let mut at = self.begins[robot] + 2;
        for (number, local) in automaton.locals.iter().enumerate() {
            if let Element::Local { local: wanted, index, .. } = element
                && wanted == number
            {
                return at + index * words(local.ty.scalar);
            }
            at += of(local.ty);
        }
        for implements in &automaton.implements {
            for (number, cell) in system.model.interface(implements.interface).cells.iter().enumerate() {
                if let Element::Cell { interface, cell: wanted, index, .. } = element
                    && (interface, wanted) == (implements.interface, number)
                {
                    return at + index * words(cell.ty.scalar);
                }
                at += of(cell.ty);
            }
        }
        for (number, port) in automaton.device.ports.iter().enumerate() {
            if port.direction == Direction::Output {
                if let Element::Port { port: wanted, index, .. } = element
                    && wanted == number
                {
                    return at + index * port.ty.words();
                }
                at += port.ty.words() * port.extent.elements(system.kinds());
            }
        }
        at
    }

    /// Writes an input of a machine into its image.
    fn give(&mut self, given: &Poke) {
        let Element::Port { robot, port, index } = given.named.element else {
            if let Engine::Executor(executor) = &mut self.engine {
                executor.set(given.named.element, given.value);
            }
            return;
        };
        let (device, kinds) = (&self.system.automaton_of(robot).device, self.system.kinds());
        let before = device.ports[..port].iter().filter(|p| p.direction == Direction::Input);
        let begin: usize = before.map(|p| p.ty.words() * p.extent.elements(kinds)).sum();
        let at = begin + index * device.ports[port].ty.words();
        let words = match given.value {
            Value::Bool(b) => vec![f64::from(u8::from(b))],
            Value::Int(i) => vec![f64::from(i)],
            Value::Real(r) => vec![r],
            Value::Point(p) => p.to_vec(),
        };
        self.inputs[robot][at..at + words.len()].copy_from_slice(&words);
    }

    fn port(&self, name: &str) -> Option<(usize, Element)> {
        let ports = &self.system.automaton_of(self.machine).device.ports;
        let port = ports.iter().position(|port| port.name == name)?;
        Some((port, Element::Port { robot: self.machine, port, index: 0 }))
    }

    /// The device ends the last command.
    fn answer(&mut self, error: i32) {
        let Some((_, element)) = self.port("cmd") else { return };
        let command = Named { element, ty: Scalar::Int { lo: 0, hi: i32::MAX }, kind: Kind::Output };
        let number = self.value(&self.trace, &command);
        for (name, value) in [("got", number), ("ack", number), ("error", Value::Int(error))] {
            if let Some((_, element)) = self.port(name) {
                let named = Named { element, ty: command.ty, kind: Kind::Input };
                self.give(&Poke { named, value });
            }
        }
    }

    pub fn row(&mut self, step: &Step, target: Target) -> Result<(), Failure> {
        let (first, last) = match target {
            Target::At(scan) => (scan as i64, scan as i64),
            Target::After(scans) => (self.now.max(-1) + scans as i64, self.now.max(-1) + scans as i64),
            Target::Within(scans) => (self.now + 1, self.now + scans as i64),
        };
        while self.now + 1 < first {
            self.step(step.span, false)?;
        }
        for given in &step.given {
            self.give(given);
            let name = name_of(self.system, self.machine, &given.named);
            let text = self.system.shown_value(given.named.ty, given.value);
            self.events.push_back((
                first.max(0) as u64 * self.system.scan_ms as u64,
                format!("given {name} = {text}"),
            ));
        }
        if let Some(error) = step.answer {
            self.answer(error);
            let text = if error == 0 { "done".to_string() } else { format!("failed, error {error}") };
            self.events
                .push_back((first.max(0) as u64 * self.system.scan_ms as u64, format!("given {text}")));
        }
        let takes_fault = step.expected.iter().any(|wanted| matches!(wanted, Wanted::Fault(_)));
        loop {
            self.step(step.span, takes_fault)?;
            let wrong = self.wrong(&step.expected);
            let is_over = !matches!(step.time, Time::Within(_)) || self.now >= last;
            match (wrong.is_empty(), is_over) {
                (true, _) => return Ok(()),
                (false, true) => {
                    let (expected, found) = wrong.into_iter().unzip();
                    return Err(self.failure(step.span, expected, found));
                }
                (false, false) => {}
            }
        }
    }

    /// A scan; a fault that nobody expects ends the test.
    fn step(&mut self, span: Span, takes_fault: bool) -> Result<(), Failure> {
        let had = self.fault.is_some();
        self.scan(true);
        match self.fault.clone() {
            Some(text) if !had && !takes_fault => {
                Err(self.failure(span, vec!["no fault".into()], vec![format!("fault: {text}")]))
            }
            _ => Ok(()),
        }
    }

    fn failure(&self, place: Span, expected: Vec<String>, found: Vec<String>) -> Failure {
        let events = self.events.iter().cloned().collect();
        Failure { place, at_ms: Some(self.ms()), events, expected, found }
    }

    /// What is not as it should be, with what is.
    fn wrong(&self, expected: &[Wanted]) -> Vec<(String, String)> {
        let mut wrong = Vec::new();
        let automaton = self.system.automaton_of(self.machine);
        for wanted in expected {
            match wanted {
                Wanted::State(state) => {
                    let found = self.trace[self.begins[self.machine]] as usize;
                    if found != *state {
                        let name =
                            |state: usize| automaton.states.get(state).map_or("?", |s| &s.name).to_string();
                        wrong.push((name(*state), name(found)));
                    }
                }
                Wanted::Value(name, named, value) => {
                    let found = match named.kind {
                        Kind::Input => self.input(named),
                        _ => self.value(&self.trace, named),
                    };
                    if found != *value {
                        let shown =
                            |value: Value| format!("{name} = {}", self.system.shown_value(named.ty, value));
                        wrong.push((shown(*value), shown(found)));
                    }
                }
                Wanted::Fault(text) => {
                    let is_it = self
                        .fault
                        .as_ref()
                        .is_some_and(|fault| text.as_ref().is_none_or(|t| fault.contains(t)));
                    if !is_it {
                        let wanted = text.as_ref().map_or("a fault".into(), |text| format!("fault: {text}"));
                        wrong.push((
                            wanted,
                            self.fault.as_ref().map_or("no fault".into(), |f| format!("fault: {f}")),
                        ));
                    }
                }
            }
        }
        wrong
    }

    fn input(&self, named: &Named) -> Value {
        let Element::Port { robot, port, index } = named.element else { return Value::Bool(false) };
        let (device, kinds) = (&self.system.automaton_of(robot).device, self.system.kinds());
        let before = device.ports[..port].iter().filter(|p| p.direction == Direction::Input);
        let begin: usize = before.map(|p| p.ty.words() * p.extent.elements(kinds)).sum();
        let at = begin + index * device.ports[port].ty.words();
        let words = &self.inputs[robot][at..];
        match named.ty {
            Scalar::Bool => Value::Bool(words[0] != 0.0),
            Scalar::Real => Value::Real(words[0]),
            Scalar::Point => Value::Point([words[0], words[1], words[2]]),
            _ => Value::Int(words[0] as i32),
        }
    }
}
