//! One scan: every instance makes one step, then outputs act.

use crate::choice::Choices;
use crate::decision::{Decisions, Question};
use crate::model::{Model, Reductions};
use crate::occurred::Occurred;
use crate::plant::status;
use crate::postponed::{Postponed, Postponing};
use crate::program::{
    Argument, Bounds, Cells, Clause, Command, Domain, Int, Key, Target, Transition, Update, bit,
};
use crate::unread::Needed;
use crate::value::{Point, Values, Var};
use crate::violation::Violation;

/// A scan under way on the bytes of a state.
pub struct Scan<'a> {
    pub(crate) model: &'a Model,
    pub(crate) bytes: &'a mut [u8],
    /// The state before devices did anything; only its values are read.
    pub(crate) before: &'a mut [u8],
    pub(crate) values: &'a mut Values,
    pub(crate) choices: &'a mut Choices,
    pub(crate) variables: &'a mut [i32],
    pub(crate) decisions: &'a mut Decisions,
    /// Values that have changed, and their owners.
    pub(crate) written: Cells,
    /// Instances that have fired.
    pub(crate) fired: u64,
    /// Machines that were given a command.
    pub(crate) given: u64,
    /// Those of them to which the one under way was given again.
    pub(crate) repeated: u64,
    /// Instances that may do something in the next scan even if no device does.
    pub(crate) restless: u64,
    /// What of the state is forgotten, and of the state before.
    pub(crate) forgotten: u128,
    pub(crate) forgotten_before: u128,
    /// Both states are interchanged.
    pub(crate) looks_back: bool,
    /// What is forgotten and has to be known, if there is any.
    pub(crate) needed: &'a mut Vec<Needed>,
    /// Answers that are postponed, and what they change.
    pub(crate) postponed: (&'a Postponed, &'a Postponing),
    /// Memory for the values of a machine.
    pub(crate) own: &'a mut Vec<u8>,
    /// Machines of which somebody needs the answer that is postponed.
    pub(crate) observed: u64,
    /// The instance that makes its step, as a bit.
    pub(crate) stepping: u64,
    /// It is the first one since a fault was reset: no property has been checked.
    pub(crate) is_reset: bool,
    /// This time has not passed in its state in this scan, in scans.
    pub(crate) not_passed: i32,
    /// Violations after which the line continues.
    pub(crate) noted: &'a mut Vec<Violation>,
    /// What is hardly meant.
    pub(crate) remarked: &'a mut Vec<Violation>,
    pub(crate) occurred: &'a mut Occurred,
    pub(crate) story: Option<&'a mut Told>,
}

/// A transition that has fired.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fired {
    pub instance: usize,
    pub state: usize,
    pub transition: usize,
}

/// What is told of a scan.
#[derive(Clone, Debug, Default)]
pub struct Told {
    /// In the order of the steps.
    pub fired: Vec<Fired>,
    /// Inputs that change by themselves, and what was chosen for them.
    pub read: Vec<(usize, i32)>,
}

/// A step ends here.
pub(crate) struct Fault(pub usize);

impl Scan<'_> {
    /// All instances in this order; those alone that can do anything: `touched` are those whose inputs have changed or
    /// that were not at rest.
    pub fn run(&mut self, order: &[usize], touched: u64) -> Result<(), Violation> {
        for &instance in order {
            self.step_if_due(instance, touched)?;
        }
        self.finish(touched)
    }

    /// What comes after the steps.
    pub(crate) fn finish(&mut self, touched: u64) -> Result<(), Violation> {
        let model = self.model;
        self.properties(touched)?;
        self.act(touched)?;
        self.forget();
        self.forget_starts();
        self.restless |= self.fired;
        if self.written.owners == 0 {
            return Ok(());
        }
        for (instance, program) in model.instances.iter().enumerate() {
            if self.restless & bit(instance) != 0 {
                continue;
            }
            let state = program.state.load(self.bytes) as usize;
            if self.written.meets(program.states[state].reads) {
                self.restless |= bit(instance);
            }
        }
        Ok(())
    }

    /// The step of one instance, with what comes after it of it alone.
    pub(crate) fn run_alone(&mut self, instance: usize) -> Result<(), Violation> {
        self.step_if_due(instance, u64::MAX)?;
        self.properties(bit(instance))?;
        self.forget_answer(instance, &self.model.machines[instance]);
        self.model.open_shown(self.bytes);
        self.forget();
        self.forget_starts();
        Ok(())
    }

    pub(crate) fn step_if_due(&mut self, instance: usize, touched: u64) -> Result<(), Violation> {
        let program = &self.model.instances[instance];
        let state = program.state.load(self.bytes) as usize;
        let is_due = touched & bit(instance) != 0 || self.written.meets(program.states[state].reads);
        let is_due = is_due || self.model.reductions == Reductions::Off;
        let waits = self.postponed.0.waiting & bit(instance) != 0;
        if !is_due && !waits || self.model.stands(self.bytes, instance) {
            return Ok(());
        }
        self.step_if_ended(instance);
        if !is_due {
            return Ok(());
        }
        let made = self.choices.count();
        self.stepping = bit(instance);
        let result = self.step(instance, state);
        self.stepping = 0;
        if self.choices.count() != made {
            self.restless |= bit(instance);
        }
        result.map_err(|Fault(fault)| Violation::Fault { instance, fault })
    }

    /// Whether the instance would do something here if its command had ended.
    fn step_if_ended(&mut self, instance: usize) {
        let (postponed, postponing) = self.postponed;
        let Some(end) = postponed.end(postponing, instance) else { return };
        let program = &self.model.instances[instance].states[end.state];
        if !self.written.meets(program.reads) {
            return;
        }
        let mut now = std::mem::take(self.own);
        postponing.read_own(instance, self.bytes, &mut now);
        let forgotten = self.forgotten;
        postponing.replace(instance, self.bytes, &end.after);
        self.forgotten = self.forgotten & !self.model.unread.owned(bit(instance))
            | self.model.unread.in_state(&self.model.instances, self.bytes, bit(instance));
        self.stepping = bit(instance);
        let begin = self.choices.mark();
        let fires = self.decide(instance, end.state).is_some();
        if fires || self.choices.mark() != begin {
            self.observed |= bit(instance);
        }
        self.choices.go_back(begin);
        self.stepping = 0;
        self.forgotten = forgotten;
        postponing.replace(instance, self.bytes, &now);
        *self.own = now;
    }

    fn step(&mut self, instance: usize, number: usize) -> Result<(), Fault> {
        let Some(index) = self.decide(instance, number) else { return Ok(()) };
        let transition = &self.model.instances[instance].states[number].transitions[index];
        self.fire(instance, number, index, transition)
    }

    fn fire(
        &mut self,
        instance: usize,
        state: usize,
        index: usize,
        transition: &Transition,
    ) -> Result<(), Fault> {
        let program = &self.model.instances[instance];
        self.fired |= bit(instance);
        if let Some(story) = &mut self.story {
            story.fired.push(Fired { instance, state, transition: index });
        }
        for update in &transition.updates {
            self.update(instance, update)?;
        }
        if let Some(target) = transition.target {
            program.state.store(self.bytes, target as i32);
            if target != state {
                self.written.owners |= bit(instance);
            }
            for times in program.times_come.into_iter().chain(program.elapsed) {
                times.store(self.bytes, 0);
            }
            program.states[target].dead.iter().for_each(|(var, value)| var.store(self.bytes, *value));
            for unread in &program.states[target].unread {
                let held = unread.input.load(self.bytes);
                unread.input.store(self.bytes, unread.instead(held));
            }
        }
        Ok(())
    }

    /// Whether the clauses hold together; leaves the variables of their binders as chosen.
    pub(crate) fn choose(&mut self, clauses: &[Clause]) -> bool {
        match clauses.split_first() {
            None => true,
            Some((Clause::Condition(condition), rest)) => self.holds(condition) && self.choose(rest),
            Some((Clause::Bind { variable, domain, condition, key: None }, rest)) => {
                self.first(*variable, domain, condition.as_ref(), rest)
            }
            Some((Clause::Bind { variable, domain, condition, key: Some(key) }, rest)) => {
                self.least(*variable, domain, condition.as_ref(), key, rest)
            }
        }
    }

    fn first(&mut self, variable: usize, domain: &Domain, condition: Option<&Int>, rest: &[Clause]) -> bool {
        let mut found = false;
        self.values_of(domain, |scan, value| {
            scan.variables[variable] = value;
            found = condition.is_none_or(|condition| scan.holds(condition)) && scan.choose(rest);
            found
        });
        found
    }

    fn least(
        &mut self,
        variable: usize,
        domain: &Domain,
        condition: Option<&Int>,
        key: &Key,
        rest: &[Clause],
    ) -> bool {
        let mut best: Option<(f64, Vec<i32>)> = None;
        self.values_of(domain, |scan, value| {
            scan.variables[variable] = value;
            if !condition.is_none_or(|condition| scan.holds(condition)) {
                return false;
            }
            // Whole numbers of 32 bits are exact as reals.
            let key = match key {
                Key::Int(key) => f64::from(scan.int(key)),
                Key::Real(key) => scan.real(key),
            };
            let is_less = best.as_ref().is_none_or(|(least, _)| key < *least);
            if is_less && scan.choose(rest) {
                best = Some((key, scan.variables.to_vec()));
            }
            false
        });
        let found = best.is_some();
        if let Some((_, variables)) = best {
            self.variables.copy_from_slice(&variables);
        }
        found
    }

    fn update(&mut self, instance: usize, update: &Update) -> Result<(), Fault> {
        match update {
            Update::Int(target, value, bounds) => {
                let value = self.int(value);
                self.store_int(target, value, bounds)
            }
            Update::Real(target, value, fault) => {
                let value = self.real(value);
                self.store_real(target, value, *fault)
            }
            Update::Point(target, value, fault) => {
                let value = self.point(value);
                self.store_point(target, value, *fault)
            }
            Update::Copy(updates) => self.copy(updates),
            Update::Command(command) => self.command(instance, command),
        }
    }

    fn copy(&mut self, updates: &[Update]) -> Result<(), Fault> {
        enum Read {
            Int(i32),
            Real(f64),
            Point([f64; 3]),
        }
        let mut read = Vec::with_capacity(updates.len());
        for update in updates {
            match update {
                Update::Int(_, value, _) => read.push(Read::Int(self.int(value))),
                Update::Real(_, value, _) => read.push(Read::Real(self.real(value))),
                Update::Point(_, value, _) => read.push(Read::Point(self.point(value))),
                Update::Copy(_) | Update::Command(_) => {}
            }
        }
        for (update, value) in updates.iter().zip(read) {
            match (update, value) {
                (Update::Int(target, _, bounds), Read::Int(value)) => {
                    self.store_int(target, value, bounds)?
                }
                (Update::Real(target, _, fault), Read::Real(value)) => {
                    self.store_real(target, value, *fault)?
                }
                (Update::Point(target, _, fault), Read::Point(value)) => {
                    self.store_point(target, value, *fault)?
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn store_int(&mut self, target: &Target, value: i32, bounds: &Bounds) -> Result<(), Fault> {
        self.store(target, value.clamp(bounds.low, bounds.high).wrapping_sub(bounds.base));
        match bounds.fault {
            Some(fault) if value < bounds.low || value > bounds.high => Err(Fault(fault)),
            _ => Ok(()),
        }
    }

    /// A number that is not finite is not stored.
    fn store_real(&mut self, target: &Target, value: f64, fault: Option<usize>) -> Result<(), Fault> {
        if !value.is_finite() {
            return fault.map_or(Ok(()), |fault| Err(Fault(fault)));
        }
        let number = self.values.number_of_real(value);
        self.store(target, number);
        Ok(())
    }

    /// The same of a place of which a coordinate is not finite.
    fn store_point(&mut self, target: &Target, value: Point, fault: Option<usize>) -> Result<(), Fault> {
        if value.iter().any(|c| !c.is_finite()) {
            return fault.map_or(Ok(()), |fault| Err(Fault(fault)));
        }
        let number = self.values.number_of_point(value);
        self.store(target, number);
        Ok(())
    }

    fn store(&mut self, target: &Target, value: i32) {
        if target.vars.is_empty() {
            return;
        }
        let index = self.int(&target.index) as usize;
        let var = target.vars[index];
        let forgotten = self.model.unread.part(self.forgotten, var);
        if var.load(self.bytes) != value || forgotten != 0 {
            var.store(self.bytes, value);
            self.written = self.written | self.model.cells_at(var);
            self.forgotten &= !forgotten;
        }
    }

    /// What an expression reads.
    pub(crate) fn load(&mut self, var: Var) -> i32 {
        let value = self.read(var);
        self.decisions.note(Question::Value(var), value);
        value
    }

    #[inline]
    pub(crate) fn read(&mut self, var: Var) -> i32 {
        if self.forgotten != 0 {
            let forgotten = self.model.unread.part(self.forgotten, var);
            if forgotten != 0 {
                self.need(forgotten);
            }
        }
        self.observe(var);
        var.load(self.bytes)
    }

    #[cold]
    fn need(&mut self, forgotten: u128) {
        let before: &[u8] = if self.looks_back { self.bytes } else { self.before };
        self.model.unread.needed(&self.model.instances, forgotten, before, self.needed);
    }

    /// A value is read.
    #[inline]
    pub(crate) fn observe(&mut self, var: Var) {
        if let Some(machines) = self.postponed.0.watched.get(var.at as usize) {
            self.observed |= machines & !self.stepping;
        }
    }

    /// Forgets what nobody reads in the state that is reached. Something of its owner was written, so all who read from it
    /// are asked again.
    fn forget(&mut self) {
        let Model { unread, instances, .. } = self.model;
        let changed = self.fired | self.written.owners;
        let known = self.forgotten & !unread.owned(changed);
        let forgotten = known | unread.in_state(instances, self.bytes, changed);
        let again = self.forgotten & !forgotten;
        if again != 0 {
            unread.needed(instances, again, self.before, self.needed);
        }
        for cell in unread.of(forgotten & !self.forgotten) {
            cell.var.store(self.bytes, cell.instead);
            self.written = self.written | self.model.cells_at(cell.var);
        }
        self.forgotten = forgotten;
    }

    fn command(&mut self, instance: usize, command: &Command) -> Result<(), Fault> {
        let mut places = Vec::new();
        for argument in &command.arguments {
            match argument {
                Argument::Output(output) => self.update(instance, output)?,
                Argument::Place(target, value, fault) => {
                    let place = self.point(value);
                    self.store_point(target, place, *fault)?;
                    places.push(place);
                }
            }
        }
        self.occurred.give(instance, command.command);
        let before = self.model.machines[instance].head.as_ref().map(|head| head.status.load(self.bytes));
        self.begin(instance, command.command, &places, before == Some(status::UNDER_WAY));
        Ok(())
    }

    /// The value of an input that changes by itself: chosen where it is first read.
    pub(crate) fn input(&mut self, number: usize) -> i32 {
        let input = &self.model.inputs[number];
        let held = input.var.load(self.bytes);
        let value = if (1..=input.values as i32).contains(&held) {
            held - 1 + input.low
        } else {
            self.choose_input(number)
        };
        self.decisions.note(Question::Input(number), value);
        value
    }

    fn choose_input(&mut self, number: usize) -> i32 {
        let input = &self.model.inputs[number];
        let value = self.choices.take(input.values) as i32;
        input.var.store(self.bytes, value + 1);
        if let Some(story) = &mut self.story {
            story.read.push((number, value + input.low));
        }
        value + input.low
    }
}
