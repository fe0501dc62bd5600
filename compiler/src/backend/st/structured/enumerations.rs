//! Which variables are of an enumeration.
//!
//! Such a variable takes nothing but members, and values of variables like it. One that is counted up, as by a loop,
//! stays a number.

use crate::backend::st::Line;
use crate::backend::st::code::{Ex, Stmt};
use crate::backend::st::context::Shared;
use crate::backend::st::declaration::Unit;
use crate::backend::st::names::{AutomatonNames, Held};
use crate::ir::{AutomatonId, Scalar};
use std::collections::{HashMap, HashSet};

/// Whether the tool has enumerations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Enumerated {
    ByType,
    ByNumber,
}

/// The enumeration of a variable: by its name, behind its unit, which is empty for what all units share.
#[derive(Default)]
pub struct Typed(HashMap<String, Vec<(String, String)>>);

impl Typed {
    pub fn get(&self, unit: &str, variable: &str) -> Option<&String> {
        Some(&self.0.get(variable)?.iter().find(|(of, _)| of == unit)?.1)
    }

    fn has(&self, units: [&str; 2], variable: &str) -> bool {
        self.0.get(variable).is_some_and(|all| all.iter().any(|(unit, _)| units.contains(&unit.as_str())))
    }

    fn insert(&mut self, unit: &str, variable: &str, enumeration: &str) {
        self.remove(unit, variable);
        self.0.entry(variable.into()).or_default().push((unit.into(), enumeration.into()));
    }

    fn remove(&mut self, unit: &str, variable: &str) {
        if let Some(all) = self.0.get_mut(variable) {
            all.retain(|(of, _)| of != unit);
        }
    }

    fn add(&mut self, shared: Shared, unit: &str, held: &Held, scalar: Scalar) {
        if let (Scalar::Enum(id), Some(name)) = (scalar, held.first()) {
            self.insert(unit, name, &shared.names.enums[id.0].ty);
        }
    }
}

pub fn typed(shared: Shared, line: &Line, enumerated: Enumerated) -> Typed {
    let mut typed = Typed::default();
    if enumerated == Enumerated::ByNumber {
        return typed;
    }
    let model = &shared.system.model;
    for (interface, names) in model.interfaces.iter().zip(&shared.names.interfaces) {
        interface
            .cells
            .iter()
            .zip(&names.cells)
            .for_each(|(c, held)| typed.add(shared, "", held, c.ty.scalar));
        let parameters = interface.parameters.iter().zip(&names.parameters);
        parameters.for_each(|(p, held)| typed.add(shared, "", held, p.ty.scalar));
    }
    for (number, (automaton, names)) in model.automata.iter().zip(&shared.names.automata).enumerate() {
        for unit in [&names.block, &names.properties] {
            typed.insert(unit, "state", &names.states.ty);
            let parameters = automaton.parameters.iter().zip(&names.parameters);
            parameters.for_each(|(p, held)| typed.add(shared, unit, held, p.ty.scalar));
            let locals = automaton.locals.iter().zip(&names.locals);
            locals.for_each(|(l, held)| typed.add(shared, unit, held, l.ty.scalar));
        }
        tables(shared, AutomatonId(number), names, &mut typed);
    }
    let blocks = line.program.instances.iter().map(|i| (i.name.as_str(), i.block.as_str())).collect();
    let units: Vec<Users> = line.units().map(|unit| Users::new(&blocks, unit)).collect();
    // A variable that is none of its enumeration is no value of it for another one.
    loop {
        let mut found = Vec::new();
        for users in &units {
            users.unit.body.pieces().for_each(|piece| users.not_of_it(&typed, &piece, &mut found));
        }
        if found.is_empty() {
            return typed;
        }
        for (unit, name) in found {
            typed.remove(&unit, &name);
        }
    }
}

/// The arrays that the robots of a type are given.
fn tables(shared: Shared, id: AutomatonId, names: &AutomatonNames, typed: &mut Typed) {
    for (number, parameter) in shared.system.model.automaton(id).parameters.iter().enumerate() {
        typed.add(shared, "", &names.tables[number], parameter.ty.scalar);
        for robot in shared.instances(id) {
            typed.add(shared, "", &shared.names.robots[robot].parameters[number], parameter.ty.scalar);
        }
    }
}

/// The uses of variables in a unit.
struct Users<'a> {
    /// By the names of their instances.
    blocks: &'a HashMap<&'a str, &'a str>,
    unit: &'a Unit<'a>,
    own: HashSet<&'a str>,
}

/// A variable, behind its unit.
type Key<'a> = (&'a str, &'a str);

impl<'a> Users<'a> {
    fn new(blocks: &'a HashMap<&'a str, &'a str>, unit: &'a Unit<'a>) -> Self {
        let declared = [&unit.inputs, &unit.outputs, &unit.variables];
        let own = declared.into_iter().flatten().map(|variable| variable.name.as_str()).collect();
        Self { blocks, unit, own }
    }

    /// The variables that get what is no value of their enumeration.
    fn not_of_it(&self, typed: &Typed, statements: &[Stmt], found: &mut Vec<(String, String)>) {
        let owned = |(unit, name): Key| (unit.to_string(), name.to_string());
        for statement in statements {
            match statement {
                Stmt::Assign(target, value) => {
                    let target = self.key(typed, target);
                    found.extend(target.and_then(|target| self.assigned(typed, target, value)).map(owned));
                }
                Stmt::If(arms, otherwise) => {
                    arms.iter().for_each(|arm| self.not_of_it(typed, &arm.body, found));
                    self.not_of_it(typed, otherwise, found);
                }
                Stmt::Case { branches, otherwise, .. } => {
                    branches.iter().for_each(|(_, body)| self.not_of_it(typed, body, found));
                    self.not_of_it(typed, otherwise, found);
                }
                Stmt::While { body, .. } => self.not_of_it(typed, body, found),
                Stmt::Call { instance, arguments } => {
                    let Some(block) = self.block(instance) else { continue };
                    let assigned = arguments.iter();
                    let not = assigned.filter_map(|(name, value)| self.assigned(typed, (block, name), value));
                    found.extend(not.map(owned));
                }
                Stmt::Comment(_) | Stmt::Exit | Stmt::Return => {}
            }
        }
    }

    fn assigned<'k>(&self, typed: &Typed, target: Key<'k>, value: &Ex) -> Option<Key<'k>> {
        let wanted = typed.get(target.0, target.1)?;
        let is = match value {
            Ex::Member(member) => {
                let ty = member.qualified.as_ref().and_then(|q| q.split_once('.')).map(|(ty, _)| ty);
                ty == Some(wanted.as_str())
            }
            _ => self.key(typed, value).and_then(|(unit, name)| typed.get(unit, name)) == Some(wanted),
        };
        (!is).then_some(target)
    }

    /// None of what is of no enumeration.
    fn key<'k>(&'k self, typed: &Typed, place: &'k Ex) -> Option<Key<'k>> {
        let unit = self.unit.name.as_str();
        match place {
            Ex::Name(name) | Ex::Element(name, _) => typed
                .has([unit, ""], name)
                .then(|| (if self.own.contains(name.as_str()) { unit } else { "" }, name.as_str())),
            Ex::Field(instance, output) => Some((self.block(instance)?, output)),
            _ => None,
        }
    }

    fn block(&self, instance: &str) -> Option<&'a str> {
        self.blocks.get(instance).copied()
    }
}
