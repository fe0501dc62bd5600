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
    let mut assigned = HashSet::new();
    for users in line.units().map(|unit| Users::new(&blocks, unit)) {
        users.unit.body.pieces().for_each(|piece| users.assigned(&typed, &piece, &mut assigned));
    }
    // A variable that is none of its enumeration is no value of it for another one.
    loop {
        let known = assigned.len();
        assigned.retain(|(target, value)| {
            let is_of_it = typed.get(&target.0, &target.1).is_none_or(|wanted| value.is_of(&typed, wanted));
            if !is_of_it {
                typed.remove(&target.0, &target.1);
            }
            is_of_it
        });
        if assigned.len() == known {
            return typed;
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
type Variable = (String, String);

/// What a variable gets.
#[derive(PartialEq, Eq, Hash)]
enum Given {
    /// A member of an enumeration.
    Member(Option<String>),
    /// The value of a variable of an enumeration, or any other.
    Value(Option<Variable>),
}

impl Given {
    fn is_of(&self, typed: &Typed, wanted: &str) -> bool {
        let ty = match self {
            Given::Member(ty) => ty.as_deref(),
            Given::Value(of) => {
                of.as_ref().and_then(|(unit, name)| typed.get(unit, name)).map(String::as_str)
            }
        };
        ty == Some(wanted)
    }
}

impl<'a> Users<'a> {
    fn new(blocks: &'a HashMap<&'a str, &'a str>, unit: &'a Unit<'a>) -> Self {
        let declared = [&unit.inputs, &unit.outputs, &unit.variables];
        let own = declared.into_iter().flatten().map(|variable| variable.name.as_str()).collect();
        Self { blocks, unit, own }
    }

    /// Adds what variables of an enumeration get.
    fn assigned(&self, typed: &Typed, statements: &[Stmt], found: &mut HashSet<(Variable, Given)>) {
        for statement in statements {
            match statement {
                Stmt::Assign(target, value) => {
                    if let Some(target) = self.key(typed, target) {
                        self.assigned_to(typed, target, value, found);
                    }
                }
                Stmt::If(arms, otherwise) => {
                    arms.iter().for_each(|arm| self.assigned(typed, &arm.body, found));
                    self.assigned(typed, otherwise, found);
                }
                Stmt::Case { branches, otherwise, .. } => {
                    branches.iter().for_each(|(_, body)| self.assigned(typed, body, found));
                    self.assigned(typed, otherwise, found);
                }
                Stmt::While { body, .. } => self.assigned(typed, body, found),
                Stmt::Call { instance, arguments } => {
                    let Some(block) = self.block(instance) else { continue };
                    arguments
                        .iter()
                        .for_each(|(name, value)| self.assigned_to(typed, (block, name), value, found));
                }
                Stmt::Comment(_) | Stmt::Exit | Stmt::Return => {}
            }
        }
    }

    fn assigned_to(&self, typed: &Typed, target: Key, value: &Ex, found: &mut HashSet<(Variable, Given)>) {
        if typed.get(target.0, target.1).is_none() {
            return;
        }
        let owned = |(unit, name): Key| (unit.to_string(), name.to_string());
        let given = match value {
            Ex::Member(member) => {
                let ty = member.qualified.as_ref().and_then(|q| q.split_once('.')).map(|(ty, _)| ty);
                Given::Member(ty.map(String::from))
            }
            _ => Given::Value(self.key(typed, value).map(owned)),
        };
        found.insert((owned(target), given));
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
