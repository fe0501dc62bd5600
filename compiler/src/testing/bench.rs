//! A machine on the bench: its inputs are given, scan by scan, and what it does is checked.

use super::machine::{Engine, Played, Step, Target, Wanted};
use super::{Failure, Time};
use crate::device::panel;
use crate::ir::{Element, Group, KeptBy, Named, System, Value};
use crate::source::Span;
use runtime_sim::device::Direction;
use runtime_sim::monitor::ALARM_WORDS;
use runtime_sim::scan::SystemInputs;
use std::collections::VecDeque;

/// Events that a failure tells.
const MOST_EVENTS: usize = 12;

/// Ports of a device that obeys commands.
const COMMAND: [&str; 6] = ["cmd", "verb", "hold", "got", "ack", "error"];

pub(super) struct Bench<'e, 'a, 's> {
    system: &'s System,
    machine: usize,
    engine: Engine<'e, 'a>,
    /// Where the trace of the machine begins.
    begin: usize,
    inputs: Vec<Vec<f64>>,
    outputs: Vec<Vec<f64>>,
    trace: Vec<f64>,
    /// Scans since the line was started; the one before is -1.
    now: i64,
    fault: Option<String>,
    /// Another machine has a fault.
    is_stopped: bool,
    events: VecDeque<(u64, String)>,
    /// Of the machine, its ports for commands and what its properties keep apart.
    values: Vec<Named>,
    command: Vec<Named>,
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
        let begin = system.traces()[machine];
        let is_of_command = |value: &Named| COMMAND.contains(&value.name.as_str());
        let is_declared = |value: &Named| match value.element {
            Element::Local { robot, local, .. } => {
                system.automaton_of(robot).locals[local].kept_by == KeptBy::Steps
            }
            Element::Port { .. } | Element::Cell { .. } => true,
        };
        let values = system.values_of(machine, begin).into_iter().filter(is_declared);
        let (command, values) = values.partition(is_of_command);
        let mut inputs = images(Direction::Input);
        for (number, image) in inputs.iter_mut().enumerate() {
            // A panel is at rest: enabled, and in automatic.
            if let Some(enable) = system.automaton_of(number).device.offset(panel::ENABLE, kinds)
                && system.automaton_of(number).modes.is_some()
            {
                image[enable] = 1.0;
            }
        }
        Self {
            system,
            machine,
            engine,
            begin,
            inputs,
            outputs: images(Direction::Output),
            trace: Vec::new(),
            now: -2,
            fault: None,
            is_stopped: false,
            events: VecDeque::new(),
            values,
            command,
        }
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
        let whose = usize::try_from(answer.fault_robot).ok();
        self.is_stopped = answer.fault && whose.is_some_and(|machine| machine != self.machine);
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
        let begin = self.begin;
        let automaton = system.automaton_of(self.machine);
        let state =
            |trace: &[f64]| automaton.states.get(trace[begin] as usize).map_or("?", |state| &state.name);
        if state(before) != state(&self.trace) {
            self.tell(state(&self.trace).to_string());
        }
        let mut changes = Vec::new();
        for named in self.values.iter().filter(|named| named.group != Group::Input) {
            let Some(at) = named.trace else { continue };
            let words = at..at + named.ty.words();
            if before[words.clone()] != self.trace[words] {
                changes.push(format!("{} = {}", named.name, system.shown_value(named.ty, self.value(named))));
            }
        }
        changes.into_iter().for_each(|change| self.tell(change));
    }

    /// An input as it was given last; of anything else what the trace says.
    fn value(&self, named: &Named) -> Value {
        let (words, at) = match named.group {
            Group::Input => (&self.inputs[self.system.owner(named.element)], named.image),
            Group::Output | Group::Local | Group::Cell => (&self.trace, named.trace),
        };
        Value::from_words(named.ty, at.and_then(|at| words.get(at..)).unwrap_or_default())
    }

    /// Writes an input of the machine into its image, and a cell as another machine does.
    fn give(&mut self, named: &Named, value: Value) {
        if let (Group::Input, Some(at)) = (named.group, named.image) {
            let mut words = Vec::new();
            value.push_words(&mut words);
            self.inputs[self.machine][at..at + words.len()].copy_from_slice(&words);
        } else if let Engine::Executor(executor) = &mut self.engine {
            executor.set(named.element, value);
        }
    }

    /// The device ends the last command.
    fn answer(&mut self, error: i32) {
        let port = |name: &str| self.command.iter().find(|port| port.name == name).cloned();
        let Some(command) = port("cmd") else { return };
        let number = self.value(&command);
        let answers = [("got", number), ("ack", number), ("error", Value::Int(error))];
        for (port, value) in answers.map(|(name, value)| (port(name), value)) {
            if let Some(port) = port {
                self.give(&port, value);
            }
        }
    }

    pub fn row(&mut self, step: &Step, target: Target) -> Result<(), Played> {
        let (first, last) = match target {
            Target::At(scan) => (scan as i64, scan as i64),
            Target::After(scans) => (self.now.max(-1) + scans as i64, self.now.max(-1) + scans as i64),
            Target::Within(scans) => (self.now + 1, self.now + scans as i64),
        };
        while self.now + 1 < first {
            self.step(step.span, true, false)?;
        }
        if step.loses_power {
            self.engine.controllers().power_up();
            self.events.push_back((first.max(0) as u64 * self.system.scan_ms as u64, "power off".into()));
        }
        for given in &step.given {
            self.give(&given.named, given.value);
            let name = self.name(&given.named);
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
        // After a loss of power the line is started anew: an edge of `start` needs a scan without it.
        let mut start = !step.loses_power;
        loop {
            self.step(step.span, start, takes_fault)?;
            start = true;
            let wrong = self.wrong(&step.expected);
            let is_over = !matches!(step.time, Time::Within(_)) || self.now >= last;
            match (wrong.is_empty(), is_over) {
                (true, _) => return Ok(()),
                (false, true) => {
                    let (expected, found) = wrong.into_iter().unzip();
                    return Err(Played::Failed(self.failure(step.span, expected, found)));
                }
                (false, false) => {}
            }
        }
    }

    /// A scan; a fault that nobody expects ends the test.
    fn step(&mut self, span: Span, start: bool, takes_fault: bool) -> Result<(), Played> {
        let had = self.fault.is_some();
        self.scan(start);
        if self.is_stopped {
            return Err(Played::Stopped);
        }
        match self.fault.clone() {
            Some(text) if !had && !takes_fault => {
                let failure = self.failure(span, vec!["no fault".into()], vec![format!("fault: {text}")]);
                Err(Played::Failed(failure))
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
                    let found = self.trace[self.begin] as usize;
                    if found != *state {
                        let name =
                            |state: usize| automaton.states.get(state).map_or("?", |s| &s.name).to_string();
                        wrong.push((name(*state), name(found)));
                    }
                }
                Wanted::Value(name, named, value) => {
                    let found = self.value(named);
                    if found != *value {
                        let shown =
                            |value: Value| format!("{name} = {}", self.system.shown_value(named.ty, value));
                        wrong.push((shown(*value), shown(found)));
                    }
                }
                Wanted::Alarm(text) => {
                    let alarms = self.alarms();
                    if !alarms.iter().any(|alarm| text.as_ref().is_none_or(|t| alarm.contains(t))) {
                        let wanted = text.as_ref().map_or("an alarm".into(), |text| format!("alarm: {text}"));
                        wrong.push((wanted, shown_alarms(&alarms)));
                    }
                }
                Wanted::NoAlarm => {
                    let alarms = self.alarms();
                    if !alarms.is_empty() {
                        wrong.push(("no alarm".into(), shown_alarms(&alarms)));
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

    /// The texts of the machine's alarms that are active or not acknowledged.
    fn alarms(&self) -> Vec<&str> {
        let alarms = || self.system.automaton_of(self.machine).alarms();
        let begin = self.system.traces()[self.machine + 1] - ALARM_WORDS * alarms().count();
        let entries = self.trace[begin..].chunks(ALARM_WORDS);
        let open = alarms().zip(entries).filter(|(_, entry)| entry[0] != 0.0 || entry[1] == 0.0);
        open.map(|(alarm, _)| self.system.model.faults[alarm.site.0].text.as_str()).collect()
    }

    /// With its machine, if that is another one.
    fn name(&self, named: &Named) -> String {
        match self.system.owner(named.element) {
            owner if owner == self.machine => named.name.clone(),
            owner => format!("{}.{}", self.system.instances[owner].name, named.name),
        }
    }
}

fn shown_alarms(alarms: &[&str]) -> String {
    if alarms.is_empty() { "no alarm".into() } else { format!("alarm: {}", alarms.join("; ")) }
}
