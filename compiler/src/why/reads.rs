//! What the parts of guards read: values, who writes them, and when they changed last.

use super::guard::Look;
use super::watch::By;
use super::{Await, Changed, Read};
use crate::ir::{Element, Expr, ExprKind, Place, Scalar, Value};
use runtime_sim::device::Direction;

/// What is read by `done` and `failed`, and by `after`.
pub(super) const COMMAND: &str = "command";
pub(super) const STAY: &str = "time in the state";

/// Values that are shown of one part of a guard, and things that one machine waits for.
const MOST_READS: usize = 12;
const MOST_AWAITED: usize = 64;

impl<'a> Look<'_, 'a> {
    /// What a condition reads, as it is now. If it does not hold, all of it is waited for.
    pub(super) fn reads(&mut self, expr: &'a Expr, holds: bool) -> Vec<Read> {
        let mut found = Vec::new();
        self.collect(expr, holds, &mut found);
        found.dedup();
        found.truncate(MOST_READS);
        found
    }

    fn awaits(&mut self, holds: bool, awaited: Await) {
        if !holds && self.awaits.len() < MOST_AWAITED && !self.awaits.contains(&awaited) {
            self.awaits.push(awaited);
        }
    }

    /// The same time may be enough for one guard, and not for another one.
    fn awaits_time(&mut self, holds: bool, text: String, left_ms: u64, is_enough: bool) {
        let known = self.awaits.iter_mut().find_map(|awaited| match awaited {
            Await::Time { text: other, suffices, .. } if *other == text => Some(suffices),
            _ => None,
        });
        match known {
            Some(suffices) => *suffices |= is_enough && !holds,
            None => self.awaits(holds, Await::Time { text, left_ms, suffices: is_enough }),
        }
    }

    fn collect(&mut self, expr: &'a Expr, holds: bool, found: &mut Vec<Read>) {
        if found.len() > MOST_AWAITED {
            return;
        }
        match &expr.kind {
            ExprKind::Read(place) => self.read(place, expr.ty, holds, found),
            ExprKind::Done | ExprKind::Failed => self.command(holds, found),
            ExprKind::After(time) => {
                let wanted = self.watch.executor.value(self.robot, time);
                let stay = self.watch.executor.elapsed(self.robot);
                if let Value::Int(wanted) = wanted
                    && wanted > stay
                {
                    let left_ms = (wanted - stay) as u64;
                    let text = self.words().expr(expr);
                    let saved = self.watch.executor.variables(self.robot);
                    let suffices = self.watch.executor.guard_holds_after(self.robot, self.clauses, wanted);
                    self.watch.executor.restore(self.robot, saved);
                    self.awaits_time(holds, text, left_ms, suffices);
                }
                let value = format!("{} s", f64::from(stay) / 1000.0);
                found.push(Read { name: STAY.into(), value, set: None, changed: None, writers: vec![] });
            }
            ExprKind::Define(define) => {
                let value = &self.words().automaton.defines[*define].value;
                self.collect(value, holds, found);
            }
            ExprKind::Exists { variable, domain, body }
            | ExprKind::Forall { variable, domain, body }
            | ExprKind::Count { variable, domain, body }
            | ExprKind::Sum { variable, domain, body } => {
                for candidate in self.watch.executor.candidates(self.robot, domain) {
                    self.watch.executor.bind(self.robot, *variable, candidate);
                    self.collect(body, holds, found);
                }
            }
            _ => expr.parts().for_each(|part| self.collect(part, holds, found)),
        }
    }

    fn read(&mut self, place: &'a Place, ty: Scalar, holds: bool, found: &mut Vec<Read>) {
        place.parts().for_each(|part| self.collect(part, holds, found));
        let Some(element) = self.element(place) else { return };
        let read = self.value(element, ty);
        match element {
            Element::Cell { .. } => {
                for robot in self.writers.of_now(self.watch, element) {
                    let awaited = match robot == self.robot {
                        true => Await::Own(read.clone()),
                        false => Await::Machine(robot, read.clone()),
                    };
                    self.awaits(holds, awaited);
                }
            }
            Element::Port { port, .. }
                if self.words().automaton.device.ports[port].direction == Direction::Input =>
            {
                self.awaits(holds, Await::Input(read.clone()));
            }
            Element::Port { .. } | Element::Local { .. } => {}
        }
        found.push(read);
    }

    fn value(&self, element: Element, ty: Scalar) -> Read {
        let (system, watch) = (self.watch.system, &*self.watch);
        let changed = watch.last.get(&element).map(|change| {
            let by = match change.by {
                By::LossOfPower => "the loss of power".into(),
                By::Machine(robot) if watch.is_input(element) => {
                    format!("the device of {}", system.instances[robot].name)
                }
                By::Machine(robot) => system.instances[robot].name.clone(),
            };
            Changed { at_ms: watch.ms(change.scan), by }
        });
        let writers = match element {
            Element::Cell { .. } => {
                let writers = self.writers.of_now(watch, element);
                writers.into_iter().map(|robot| system.instances[robot].name.clone()).collect()
            }
            _ => Vec::new(),
        };
        let name = match element {
            Element::Cell { .. } => {
                format!("{}.{}", system.instances[system.owner(element)].name, system.name_of(element))
            }
            Element::Local { .. } | Element::Port { .. } => system.name_of(element),
        };
        let value = system.shown_value(ty, watch.executor.element(element));
        let set = self.set(element).map(|set| system.shown_value(ty, set)).filter(|set| *set != value);
        Read { name, value, set, changed, writers }
    }

    /// What the automaton has set, of an output that properties see as it is put out.
    fn set(&self, element: Element) -> Option<Value> {
        let Element::Port { robot, port, index } = element else { return None };
        self.watch.executor.exchanged(robot, self.seen_by?, port, index)
    }

    /// Where a place is kept. None for what the layout fixes, which nobody waits for.
    fn element(&mut self, place: &Place) -> Option<Element> {
        let (robot, executor) = (self.robot, &mut self.watch.executor);
        Some(match place {
            Place::Local { local, index } => {
                Element::Local { robot, local: *local, index: executor.element_of(robot, index) }
            }
            Place::Port { port, index } => {
                Element::Port { robot, port: *port, index: executor.element_of(robot, index) }
            }
            Place::Cell { interface, cell, of, index } => {
                let row = executor.row_of(robot, *interface, of);
                let index = executor.element_of(robot, index);
                Element::Cell { interface: *interface, row, cell: *cell, index }
            }
            Place::Parameter { .. } | Place::Shown { .. } => return None,
        })
    }

    /// What came of the last command.
    fn command(&mut self, holds: bool, found: &mut Vec<Read>) {
        let device = &self.words().automaton.device;
        let executor = &self.watch.executor;
        let [cmd, ack, error, verb] =
            ["cmd", "ack", "error", "verb"].map(|name| executor.port_of(self.robot, name));
        let name = device.verbs.iter().find(|known| known.number == verb).map_or("?", |known| &known.name);
        let since = |port: &str| {
            let port = device.ports.iter().position(|known| known.name == port)?;
            self.watch.last.get(&Element::Port { robot: self.robot, port, index: 0 }).copied()
        };
        let (value, change) = match (cmd, error) {
            (0, _) => ("none was given".to_string(), None),
            _ if ack != cmd => (format!("{cmd}, `{name}`, is being executed"), since("cmd")),
            (_, 0) => (format!("{cmd}, `{name}`, has ended successfully"), since("ack")),
            _ => (format!("{cmd}, `{name}`, has ended with error {error}"), since("ack")),
        };
        let own = &self.watch.system.instances[self.robot].name;
        let by = if ack == cmd { format!("the device of {own}") } else { own.clone() };
        let changed = change.map(|change| Changed { at_ms: self.watch.ms(change.scan), by });
        if cmd != 0 && ack != cmd {
            let since = changed
                .as_ref()
                .map_or(String::new(), |c| format!(" since {:.2} s", c.at_ms as f64 / 1000.0));
            self.awaits(holds, Await::Command { text: format!("its command {value}{since}") });
        }
        let read = Read { name: COMMAND.into(), value, set: None, changed, writers: Vec::new() };
        if !found.contains(&read) {
            found.push(read);
        }
    }
}
