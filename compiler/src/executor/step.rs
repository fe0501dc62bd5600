//! One step of one instance.

use super::{Element, Entry, Executor};
use crate::ir::{Binder, Clause, FaultId, Place, Scalar, Type, Update, UpdateKind, Value, less};
use runtime_sim::device::LAST_COMMAND;

impl Executor<'_> {
    pub(super) fn step(&mut self, robot: usize) -> Result<(), FaultId> {
        let system = self.system;
        let automaton = system.automaton_of(robot);
        if self.robots[robot].stopped {
            self.robots[robot].elapsed = 0;
            return Ok(());
        }
        self.robots[robot].elapsed = self.robots[robot].elapsed.saturating_add(system.scan_ms);
        if automaton.modes.as_ref().is_some_and(|modes| !self.is_set(robot, modes.steps)) {
            return Ok(());
        }
        let number = self.robots[robot].state;
        let state = &automaton.states[number];
        for (index, transition) in state.transitions.iter().enumerate() {
            if !self.guard_holds(robot, &transition.clauses) {
                continue;
            }
            self.fired[system.instances[robot].automaton.0][number][index] += 1;
            self.note(Entry::Fired { robot, transition: index });
            for update in &transition.updates {
                self.update(robot, update)?;
            }
            if let Some(target) = transition.target {
                self.robots[robot].state = target.0;
                self.robots[robot].elapsed = 0;
                return Ok(());
            }
            break;
        }
        let is_single = self.is_single(robot);
        if let Some((longest, fault)) = &state.within
            && !is_single
            && let Value::Int(longest) = self.value(robot, longest)
            && self.robots[robot].elapsed >= longest
        {
            return Err(*fault);
        }
        Ok(())
    }

    /// Whether the clauses hold together; leaves the variables of their binders as chosen.
    pub(crate) fn guard_holds(&mut self, robot: usize, clauses: &[Clause]) -> bool {
        match clauses.split_first() {
            None => true,
            Some((Clause::Condition(condition), rest)) => {
                self.holds(robot, condition) && self.guard_holds(robot, rest)
            }
            Some((Clause::Bind(binder), rest)) => self.choose_candidate(robot, binder, rest),
        }
    }

    /// The same, if the state had lasted for so many ms.
    pub(crate) fn guard_holds_after(&mut self, robot: usize, clauses: &[Clause], ms: i32) -> bool {
        let elapsed = std::mem::replace(&mut self.robots[robot].elapsed, ms);
        let holds = self.guard_holds(robot, clauses);
        self.robots[robot].elapsed = elapsed;
        holds
    }

    fn choose_candidate(&mut self, robot: usize, binder: &Binder, rest: &[Clause]) -> bool {
        let mut best: Option<(Value, Vec<Value>)> = None;
        for candidate in self.candidates(robot, &binder.domain) {
            self.robots[robot].variables[binder.variable.0] = candidate;
            if let Some(condition) = &binder.condition
                && !self.holds(robot, condition)
            {
                continue;
            }
            let Some(key) = &binder.key else {
                if self.guard_holds(robot, rest) {
                    return true;
                }
                continue;
            };
            let key = self.value(robot, key);
            if best.as_ref().is_some_and(|(least, _)| !less(key, *least)) {
                continue;
            }
            if self.guard_holds(robot, rest) {
                best = Some((key, self.robots[robot].variables.clone()));
            }
        }
        match best {
            Some((_, variables)) => {
                self.robots[robot].variables = variables;
                true
            }
            None => false,
        }
    }

    pub(super) fn update(&mut self, robot: usize, update: &Update) -> Result<(), FaultId> {
        match &update.kind {
            UpdateKind::Assign { target, value, check } => {
                let value = self.value(robot, value);
                let row = self.target_row(robot, &target.place);
                let index = self.target_index(robot, &target.place);
                self.store(robot, &target.place, (row, index), target.ty.scalar, value, *check)
            }
            UpdateKind::Fill { target, value, check } => {
                let value = self.value(robot, value);
                let row = self.target_row(robot, &target.place);
                for index in 0..self.size(target.ty) {
                    self.store(robot, &target.place, (row, index), target.ty.scalar, value, *check)?;
                }
                Ok(())
            }
            UpdateKind::Copy { target, source, check } => {
                let values: Vec<Value> =
                    (0..self.size(target.ty)).map(|index| self.read_element(robot, source, index)).collect();
                let row = self.target_row(robot, &target.place);
                for (index, value) in values.into_iter().enumerate() {
                    self.store(robot, &target.place, (row, index), target.ty.scalar, value, *check)?;
                }
                Ok(())
            }
            UpdateKind::Command { verb, arguments } => {
                for argument in arguments {
                    let value = self.value(robot, &argument.value);
                    let place = Place::Port { port: argument.port, index: None };
                    let ty = Scalar::from(self.system.automaton_of(robot).device.ports[argument.port].ty);
                    self.store(robot, &place, (0, 0), ty, value, argument.check)?;
                }
                let number = self.next_command(robot);
                self.set_port(robot, "verb", *verb);
                self.set_port(robot, "cmd", number);
                self.commanded(robot);
                Ok(())
            }
        }
    }

    /// The number after the last one that the device does not show at present: 1 follows the highest.
    fn next_command(&self, robot: usize) -> i32 {
        let mut number = self.port_of(robot, "cmd");
        loop {
            number = if number >= LAST_COMMAND { 1 } else { number + 1 };
            if number != self.port_of(robot, "got") && number != self.port_of(robot, "ack") {
                return number;
            }
        }
    }

    fn set_port(&mut self, robot: usize, name: &str, value: i32) {
        let ports = &self.system.automaton_of(robot).device.ports;
        if let Some(port) = ports.iter().position(|p| p.name == name) {
            self.robots[robot].ports[port][0] = Value::Int(value);
            self.note(Entry::Changed { robot, what: Element::Port { robot, port, index: 0 } });
        }
    }

    fn size(&self, ty: Type) -> usize {
        self.system.model.elements(ty.extent)
    }

    /// The row whose cell is written; of no meaning for other places.
    fn target_row(&mut self, robot: usize, place: &Place) -> usize {
        match place {
            Place::Cell { interface, of, .. } => self.row_of(robot, *interface, of),
            _ => 0,
        }
    }

    fn target_index(&mut self, robot: usize, place: &Place) -> usize {
        match place {
            Place::Local { index, .. } | Place::Cell { index, .. } | Place::Port { index, .. } => {
                self.element_of(robot, index)
            }
            Place::Parameter { .. } | Place::Shown { .. } => 0,
        }
    }

    fn read_element(&mut self, robot: usize, place: &Place, index: usize) -> Value {
        match place {
            Place::Local { local, .. } => self.robots[robot].locals[*local][index],
            Place::Port { port, .. } => self.robots[robot].ports[*port][index],
            Place::Parameter { parameter, .. } => self.system.instances[robot].parameters[*parameter][index],
            Place::Cell { interface, cell, of, .. } => {
                let row = self.row_of(robot, *interface, of);
                self.cells[interface.0][row][*cell][index]
            }
            Place::Shown { interface, parameter, of, .. } => {
                let row = self.row_of(robot, *interface, &Some(of.clone()));
                self.system.shown(*interface, row, *parameter)[index]
            }
        }
    }

    /// Stores a value that fits at a row and an index; otherwise the nearest bound, or nothing if it is not finite, and reports the fault.
    fn store(
        &mut self,
        robot: usize,
        place: &Place,
        (row, index): (usize, usize),
        ty: Scalar,
        value: Value,
        check: Option<FaultId>,
    ) -> Result<(), FaultId> {
        let (kept, fits) = fitted(ty, value);
        if let (Some(kept), Some(what)) = (kept, element(robot, place, (row, index))) {
            self.put(robot, what, kept);
        }
        match check {
            Some(fault) if !fits => Err(fault),
            _ => Ok(()),
        }
    }
}

/// Where a place of an instance is kept; none for what the layout fixes.
fn element(robot: usize, place: &Place, (row, index): (usize, usize)) -> Option<Element> {
    match *place {
        Place::Local { local, .. } => Some(Element::Local { robot, local, index }),
        Place::Port { port, .. } => Some(Element::Port { robot, port, index }),
        Place::Cell { interface, cell, .. } => Some(Element::Cell { interface, row, cell, index }),
        Place::Parameter { .. } | Place::Shown { .. } => None,
    }
}

/// What is stored for a value, and whether it is the value.
fn fitted(ty: Scalar, value: Value) -> (Option<Value>, bool) {
    match (ty, value) {
        (Scalar::Int { lo, hi }, Value::Int(i)) => {
            (Some(Value::Int(i.clamp(lo, hi))), (lo..=hi).contains(&i))
        }
        (Scalar::Time, Value::Int(i)) => (Some(Value::Int(i.max(0))), i >= 0),
        (_, Value::Real(r)) if !r.is_finite() => (None, false),
        (_, Value::Point(p)) if p.iter().any(|c| !c.is_finite()) => (None, false),
        _ => (Some(value), true),
    }
}
