//! What the step of an instance reads and writes of a state, whichever of its transitions fires.

use crate::model::Model;
use crate::plant::Machine;
use crate::program::{
    Argument, Clause, Domain, Each, Instance, Int, Key, PointValue, Real, Target, Transition, Update,
};
use crate::value::Var;

#[derive(Clone, Debug)]
pub(crate) struct Footprint {
    reads: Bytes,
    writes: Bytes,
}

/// Bytes of a state, a bit each.
#[derive(Clone, Debug)]
struct Bytes(Box<[u64]>);

impl Bytes {
    fn add(&mut self, var: Var) {
        for at in var.at as usize..var.at as usize + usize::from(var.width) {
            self.0[at / 64] |= 1 << (at % 64);
        }
    }

    fn meets(&self, other: &Self) -> bool {
        self.0.iter().zip(&other.0).any(|(a, b)| a & b != 0)
    }
}

/// Of each state of each instance.
pub(crate) fn footprints(model: &Model) -> Vec<Vec<Footprint>> {
    let instances = model.instances.iter().enumerate();
    let of_instance = instances.map(|(number, instance)| {
        let states = instance.states.iter().map(|state| {
            let mut found = Finder::new(model, number);
            found.read(instance.state);
            for transition in &state.transitions {
                found.transition(transition);
            }
            found.footprint
        });
        states.collect()
    });
    of_instance.collect()
}

impl Footprint {
    /// Whether a step with this footprint may change what one with the other reads.
    pub fn feeds(&self, other: &Self) -> bool {
        self.writes.meets(&other.reads)
    }

    /// Whether it makes a difference which of two steps is made first.
    pub fn depends_on(&self, other: &Self) -> bool {
        self.feeds(other) || other.feeds(self) || self.writes.meets(&other.writes)
    }
}

struct Finder<'a> {
    model: &'a Model,
    instance: usize,
    footprint: Footprint,
}

impl<'a> Finder<'a> {
    fn new(model: &'a Model, instance: usize) -> Self {
        let none = Bytes(vec![0; model.initial.len().div_ceil(64)].into());
        Self { model, instance, footprint: Footprint { reads: none.clone(), writes: none } }
    }

    fn read(&mut self, var: Var) {
        self.footprint.reads.add(var);
    }

    fn write(&mut self, var: Var) {
        self.footprint.writes.add(var);
    }

    fn transition(&mut self, transition: &Transition) {
        for clause in &transition.clauses {
            match clause {
                Clause::Condition(condition) => self.int(condition),
                Clause::Bind { domain, condition, key, .. } => {
                    self.domain(domain);
                    condition.iter().for_each(|condition| self.int(condition));
                    match key {
                        Some(Key::Int(key)) => self.int(key),
                        Some(Key::Real(key)) => self.real(key),
                        None => {}
                    }
                }
            }
        }
        transition.updates.iter().for_each(|update| self.update(update));
        if let Some(target) = transition.target {
            let instance = &self.model.instances[self.instance];
            self.write(instance.state);
            instance.times_come.into_iter().chain(instance.elapsed).for_each(|times| self.write(times));
            instance.states[target].dead.iter().for_each(|(var, _)| self.write(*var));
            instance.states[target].unread.iter().for_each(|unread| {
                self.read(unread.input);
                self.write(unread.input);
            });
        }
    }

    fn update(&mut self, update: &Update) {
        match update {
            Update::Int(target, value, _) => {
                self.target(target);
                self.int(value);
            }
            Update::Real(target, value, _) => {
                self.target(target);
                self.real(value);
            }
            Update::Point(target, value, _) => {
                self.target(target);
                self.point(value);
            }
            Update::Copy(updates) => updates.iter().for_each(|update| self.update(update)),
            Update::Command(command) => {
                for argument in &command.arguments {
                    match argument {
                        Argument::Output(output) => self.update(output),
                        Argument::Place(target, place, _) => {
                            self.target(target);
                            self.point(place);
                        }
                    }
                }
                for var in commanded(&self.model.machines[self.instance]) {
                    self.read(var);
                    self.write(var);
                }
            }
        }
    }

    fn target(&mut self, target: &Target) {
        target.vars.iter().for_each(|var| self.write(*var));
        self.int(&target.index);
    }

    /// Which element of an array it is, is not known.
    fn element(&mut self, vars: &[Var], index: &Int) {
        vars.iter().for_each(|var| self.read(*var));
        self.int(index);
    }

    fn input(&mut self, input: usize) {
        let var = self.model.inputs[input].var;
        self.read(var);
        self.write(var);
    }

    fn int(&mut self, expr: &Int) {
        match expr {
            Int::Constant(_) | Int::Variable(_) => {}
            Int::Load(var, _) => self.read(*var),
            Int::Element(elements, index) => self.element(&elements.vars, index),
            Int::Table(_, a) | Int::Not(a) | Int::Negate(a) | Int::Absolute(a) | Int::OneOf(_, a) => {
                self.int(a)
            }
            Int::Input(input) => self.input(*input),
            Int::InputElement(inputs, index) => {
                inputs.iter().for_each(|input| self.input(*input));
                self.int(index);
            }
            Int::AtStop(machine) => self.shown_stop(*machine),
            Int::After(after) => {
                let Instance { times_come, elapsed, .. } = &self.model.instances[after.instance];
                times_come.iter().for_each(|times| self.read(*times));
                elapsed.iter().for_each(|elapsed| {
                    self.read(*elapsed);
                    self.write(*elapsed);
                });
                self.int(&after.time);
            }
            Int::Shared(a) => self.int(a),
            Int::Binary(_, pair) | Int::Min(pair) | Int::Max(pair) => pair.iter().for_each(|a| self.int(a)),
            Int::And(all) | Int::Or(all) | Int::Total(all) => all.iter().for_each(|a| self.int(a)),
            Int::CompareReals(_, pair) => pair.iter().for_each(|a| self.real(a)),
            Int::ComparePoints(_, pair) => pair.iter().for_each(|a| self.point(a)),
            Int::Exists(each) | Int::ForAll(each) | Int::Count(each) | Int::Sum(each) => {
                let Each { domain, body, .. } = &**each;
                self.domain(domain);
                self.int(body);
            }
        }
    }

    fn domain(&mut self, domain: &Domain) {
        if let Domain::Range(ends) = domain {
            ends.iter().for_each(|end| self.int(end));
        }
    }

    fn real(&mut self, expr: &Real) {
        match expr {
            Real::Constant(_) => {}
            Real::Load(var) => self.read(*var),
            Real::Element(vars, index) => self.element(vars, index),
            Real::Table(_, index) => self.int(index),
            Real::OfInt(a) => self.int(a),
            Real::Negate(a) | Real::Absolute(a) => self.real(a),
            Real::Binary(_, pair) | Real::Min(pair) | Real::Max(pair) => {
                pair.iter().for_each(|a| self.real(a))
            }
            Real::Coordinate(point, _) => self.point(point),
            Real::SquaredDistance(pair) => pair.iter().for_each(|a| self.point(a)),
            Real::Sum(each) => {
                self.domain(&each.domain);
                self.real(&each.body);
            }
        }
    }

    fn shown_stop(&mut self, machine: usize) {
        let machine = &self.model.machines[machine];
        commanded(machine).into_iter().for_each(|var| self.read(var));
        machine.route.iter().filter_map(|route| route.shown).for_each(|shown| self.write(shown));
    }

    fn point(&mut self, expr: &PointValue) {
        match expr {
            PointValue::Constant(_) => {}
            PointValue::Load(var) => self.read(*var),
            PointValue::Position(machine) => self.shown_stop(*machine),
            PointValue::Element(vars, index) => self.element(vars, index),
            PointValue::Table(_, index) => self.int(index),
            PointValue::Make(parts) => parts.iter().for_each(|a| self.real(a)),
            PointValue::Add(pair) | PointValue::Subtract(pair) => pair.iter().for_each(|a| self.point(a)),
        }
    }
}

/// What a command to a machine changes of it.
fn commanded(machine: &Machine) -> Vec<Var> {
    let mut vars = Vec::new();
    if let Some(head) = &machine.head {
        vars.extend([head.status, head.command]);
        vars.extend(head.error);
    }
    if let Some(arm) = &machine.arm {
        vars.extend([arm.tool, arm.via, arm.goal]);
    }
    if let Some(route) = &machine.route {
        vars.extend([route.at, route.goal]);
        vars.extend(route.shown);
    }
    if let Some(lane) = &machine.lane {
        vars.push(lane.motion);
        vars.extend(lane.shown);
    }
    vars
}
