//! What types promise: it is checked after the steps of each scan.

use crate::decision::Kept;
use crate::program::{Cells, Instance, Int, PointValue, Real, bit};
use crate::scan::Scan;
use crate::value::{Point, Var};
use crate::violation::Violation;

#[derive(Clone, Debug)]
pub struct Property {
    pub check: Check,
    /// Index into the faults of the model.
    pub fault: usize,
    pub effect: Effect,
    pub reads: Cells,
    /// It reads what may change in scans in which nothing else does.
    pub asks_inputs: bool,
    /// It stops the machine, and reads outputs that have stop values then: it sees these from the next scan on.
    pub sees_stop: bool,
}

#[derive(Clone, Debug)]
pub enum Check {
    Always(Always),
    Keep(Keep),
    Whenever(Whenever),
}

impl Check {
    /// What it knows of the last check.
    pub fn remembered(&self) -> impl Iterator<Item = Var> {
        let (first, others): (Option<Var>, &[Var]) = match self {
            Self::Always(_) => (None, &[]),
            Self::Keep(keep) => match &keep.memory {
                Some(memory) => (Some(memory.held), &memory.before),
                None => (None, &[]),
            },
            Self::Whenever(whenever) => (Some(whenever.waits), &[]),
        };
        first.into_iter().chain(others.iter().copied())
    }
}

/// What a violation does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effect {
    Fault,
    /// A stop that is meant: somebody has to come.
    AsksOperator,
    StopsMachine,
    /// It stops nothing.
    Warns,
}

#[derive(Clone, Debug)]
pub struct Always {
    pub condition: Int,
    /// Of `not a or b` it is `not a`: where it holds, nothing else is asked.
    pub excuse: Option<Int>,
}

/// Values that stay as they are while a condition holds.
#[derive(Clone, Debug)]
pub struct Keep {
    pub condition: Int,
    pub values: Vec<Value>,
    /// None: the state before the scan tells what was at the last check.
    pub memory: Option<Memory>,
}

/// What was at the last check.
#[derive(Clone, Debug)]
pub struct Memory {
    /// Whether the condition held.
    pub held: Var,
    /// The values, while it holds.
    pub before: Vec<Var>,
}

/// A goal that has to follow a trigger, after any number of scans.
#[derive(Clone, Debug)]
pub struct Whenever {
    pub trigger: Int,
    pub goal: Int,
    /// Whether the goal is waited for. If the state behind a scan tells whether trigger and goal hold, it is kept only
    /// where neither of them does.
    pub waits: Var,
    pub is_told: bool,
}

#[derive(Clone, Debug)]
pub enum Value {
    /// With how much less the memory holds.
    Int(Int, i32),
    Real(Real),
    Point(PointValue),
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Read {
    Int(i32),
    Real(f64),
    Point(Point),
}

impl Scan<'_> {
    /// All properties of those instances of which anything has changed.
    pub(crate) fn properties(&mut self, touched: u64) -> Result<(), Violation> {
        let model = self.model;
        for (instance, program) in model.instances.iter().enumerate() {
            let is_touched = |scan: &Self| (touched | scan.fired) & bit(instance) != 0;
            let may_be_due = program.property_reads.is_none_or(|reads| self.written.meets(reads));
            let was_stopped = program.stopped.is_some_and(|stopped| stopped.load(self.before) != 0);
            if !may_be_due && !was_stopped && !is_touched(self) {
                continue;
            }
            let mut stops = false;
            for (number, property) in program.properties.iter().enumerate() {
                if stops && property.effect != Effect::StopsMachine {
                    self.stop(instance);
                    stops = false;
                }
                let stands = program.stopped.is_some_and(|stopped| stopped.load(self.bytes) != 0);
                let is_due = is_touched(self)
                    || self.written.meets(property.reads)
                    || property.is_due_always()
                    || was_stopped && property.sees_stop;
                if is_due && self.is_violated(instance, number, stands) {
                    let fault = property.fault;
                    match property.effect {
                        Effect::Fault => return Err(Violation::Fault { instance, fault }),
                        Effect::AsksOperator => return Err(Violation::Stop { fault }),
                        Effect::StopsMachine => {
                            self.noted.push(Violation::MachineStops { instance, fault });
                            stops = true;
                        }
                        Effect::Warns => self.noted.push(Violation::Warning { instance, fault }),
                    }
                }
            }
            if stops {
                self.stop(instance);
            }
        }
        Ok(())
    }

    fn stop(&mut self, instance: usize) {
        if let Some(stopped) = self.model.instances[instance].stopped {
            stopped.store(self.bytes, 1);
        }
        self.fired |= bit(instance);
    }

    /// `stands`: the instance is stopped.
    fn is_violated(&mut self, instance: usize, property: usize, stands: bool) -> bool {
        let program = &self.model.instances[instance];
        match &program.properties[property].check {
            Check::Always(always) => {
                let kept = self.decide_always(instance, property, always);
                if kept != Some(Kept::Excused) {
                    self.occurred.test(instance, property);
                }
                kept.is_none()
            }
            Check::Keep(keep) => match &keep.memory {
                None => !stands && self.has_changed(instance, property, keep),
                Some(memory) => {
                    let has_changed = self.has_changed_since(keep, memory, stands);
                    if memory.held.load(self.bytes) != 0 {
                        self.occurred.test(instance, property);
                    }
                    has_changed
                }
            },
            Check::Whenever(whenever) => {
                let waits = !stands && self.has_to_wait(program, whenever);
                if waits {
                    self.occurred.test(instance, property);
                }
                let is_told = whenever.is_told && self.holds(&whenever.trigger);
                whenever.waits.store(self.bytes, i32::from(waits && !is_told));
                false
            }
        }
    }

    fn has_changed(&mut self, instance: usize, property: usize, keep: &Keep) -> bool {
        // In the beginning nothing has been checked.
        let is_first = self.is_reset || self.model.instances[instance].state.load(self.before) == 0;
        if is_first {
            self.test_first(instance, property, &keep.condition);
            return false;
        }
        if !self.decide_condition(instance, property, &keep.condition) {
            return false;
        }
        self.occurred.test(instance, property);
        self.swap();
        let held = self.decide_condition(instance, property, &keep.condition);
        self.swap();
        held && keep.values.iter().any(|value| {
            let now = self.read_value(value);
            self.swap();
            let before = self.read_value(value);
            self.swap();
            now != before
        })
    }

    /// The condition of a `keep` may hold from the first scan on, and nothing that it reads change any more. What is forgotten
    /// then has its right value, and nobody needs what is postponed for this.
    fn test_first(&mut self, instance: usize, property: usize, condition: &Int) {
        let (needed, observed) = (self.needed.len(), self.observed);
        if self.holds(condition) {
            self.occurred.test(instance, property);
        }
        self.needed.truncate(needed);
        self.observed = observed;
    }

    fn has_changed_since(&mut self, keep: &Keep, memory: &Memory, stands: bool) -> bool {
        let held = memory.held.load(self.bytes) != 0;
        let holds = !stands && self.holds(&keep.condition);
        memory.held.store(self.bytes, i32::from(holds));
        let mut has_changed = false;
        for (value, before) in keep.values.iter().zip(&memory.before) {
            // What was while it did not hold is of no use.
            let now = if holds { self.number(value) } else { 0 };
            has_changed |= held && holds && before.load(self.bytes) != now;
            before.store(self.bytes, now);
        }
        has_changed
    }

    /// Whether the goal is waited for behind this scan.
    fn has_to_wait(&mut self, program: &Instance, whenever: &Whenever) -> bool {
        if self.holds(&whenever.goal) {
            return false;
        }
        if self.holds(&whenever.trigger) {
            return true;
        }
        if !whenever.is_told {
            return whenever.waits.load(self.bytes) != 0;
        }
        self.swap();
        let waited = self.is_waiting(program, whenever);
        self.swap();
        waited
    }

    /// Whether the goal is waited for in a state between two scans.
    pub(crate) fn is_waiting(&mut self, program: &Instance, whenever: &Whenever) -> bool {
        if program.stopped.is_some_and(|stopped| stopped.load(self.bytes) != 0) {
            return false;
        }
        if !whenever.is_told || whenever.waits.load(self.bytes) != 0 {
            return whenever.waits.load(self.bytes) != 0;
        }
        // In the beginning nothing has been checked.
        program.state.load(self.bytes) != 0 && !self.holds(&whenever.goal) && self.holds(&whenever.trigger)
    }

    /// Expressions read the state before the scan, or again the other one.
    fn swap(&mut self) {
        std::mem::swap(&mut self.bytes, &mut self.before);
        std::mem::swap(&mut self.forgotten, &mut self.forgotten_before);
        self.looks_back = !self.looks_back;
    }

    fn read_value(&mut self, value: &Value) -> Read {
        match value {
            Value::Int(value, _) => Read::Int(self.int(value)),
            Value::Real(value) => Read::Real(self.real(value)),
            Value::Point(value) => Read::Point(self.point(value)),
        }
    }

    /// A value as the memory holds it.
    fn number(&mut self, value: &Value) -> i32 {
        match self.read_value(value) {
            Read::Int(now) => match value {
                Value::Int(_, low) => now.wrapping_sub(*low),
                _ => now,
            },
            Read::Real(now) => self.values.number_of_real(now),
            Read::Point(now) => self.values.number_of_point(now),
        }
    }
}

impl Property {
    /// Whether it asks for nothing as long as a condition does not hold.
    pub fn is_conditional(&self) -> bool {
        match &self.check {
            Check::Always(always) => always.excuse.is_some(),
            Check::Keep(_) | Check::Whenever(_) => true,
        }
    }

    /// What any of these reads; none if one of them is due in each scan.
    pub fn reads_of_all(properties: &[Self]) -> Option<Cells> {
        let all = |reads, property: &Self| (!property.is_due_always()).then_some(reads | property.reads);
        properties.iter().try_fold(Cells::default(), all)
    }

    /// Whether it is checked, or remembers anything, in scans in which nothing else changes too.
    fn is_due_always(&self) -> bool {
        self.asks_inputs
            || match &self.check {
                Check::Always(_) => false,
                Check::Keep(keep) => keep.memory.is_some(),
                Check::Whenever(whenever) => !whenever.is_told,
            }
    }
}
