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
use std::collections::BTreeMap;

/// Whether the tool has enumerations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Enumerated {
    ByType,
    ByNumber,
}

/// The enumeration of a variable: by its unit, empty for what all units share, and its name.
#[derive(Default)]
pub struct Typed(BTreeMap<(String, String), String>);

impl Typed {
    pub fn get(&self, unit: &str, variable: &str) -> Option<&String> {
        self.0.get(&(unit.into(), variable.into()))
    }

    fn add(&mut self, shared: Shared, unit: &str, held: &Held, scalar: Scalar) {
        if let (Scalar::Enum(id), Some(name)) = (scalar, held.first()) {
            self.0.insert((unit.into(), name.clone()), shared.names.enums[id.0].ty.clone());
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
            typed.0.insert((unit.clone(), "state".into()), names.states.ty.clone());
            let parameters = automaton.parameters.iter().zip(&names.parameters);
            parameters.for_each(|(p, held)| typed.add(shared, unit, held, p.ty.scalar));
            let locals = automaton.locals.iter().zip(&names.locals);
            locals.for_each(|(l, held)| typed.add(shared, unit, held, l.ty.scalar));
        }
        tables(shared, AutomatonId(number), names, &mut typed);
    }
    let blocks = line.program.instances.iter().map(|i| (i.name.as_str(), i.block.as_str())).collect();
    let not_of_it = |typed: &Typed| {
        line.units().find_map(|unit| Users { typed, blocks: &blocks, unit }.not_of_it(&unit.body))
    };
    while let Some(key) = not_of_it(&typed) {
        typed.0.remove(&key);
    }
    typed
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
    typed: &'a Typed,
    /// By the names of their instances.
    blocks: &'a BTreeMap<&'a str, &'a str>,
    unit: &'a Unit,
}

impl Users<'_> {
    /// A variable that gets what is no value of its enumeration.
    fn not_of_it(&self, statements: &[Stmt]) -> Option<(String, String)> {
        statements.iter().find_map(|statement| match statement {
            Stmt::Assign(target, value) => self.assigned(self.key(target)?, value),
            Stmt::If(arms, otherwise) => {
                let mut arms = arms.iter();
                arms.find_map(|arm| self.not_of_it(&arm.body)).or_else(|| self.not_of_it(otherwise))
            }
            Stmt::Case { branches, otherwise, .. } => {
                let mut branches = branches.iter();
                branches.find_map(|(_, body)| self.not_of_it(body)).or_else(|| self.not_of_it(otherwise))
            }
            Stmt::While { body, .. } => self.not_of_it(body),
            Stmt::Call { instance, arguments } => {
                let block = self.block(instance)?;
                arguments.iter().find_map(|(name, value)| self.assigned((block.into(), name.clone()), value))
            }
            Stmt::Comment(_) | Stmt::Exit | Stmt::Return => None,
        })
    }

    fn assigned(&self, key: (String, String), value: &Ex) -> Option<(String, String)> {
        let wanted = self.typed.0.get(&key)?;
        let is = match value {
            Ex::Member(member) => {
                let ty = member.qualified.as_ref().and_then(|q| q.split_once('.')).map(|(ty, _)| ty);
                ty == Some(wanted.as_str())
            }
            _ => self.key(value).and_then(|key| self.typed.0.get(&key)) == Some(wanted),
        };
        (!is).then_some(key)
    }

    fn key(&self, place: &Ex) -> Option<(String, String)> {
        match place {
            Ex::Name(name) | Ex::Element(name, _) => {
                let declared = [&self.unit.inputs, &self.unit.outputs, &self.unit.variables];
                let is_own = declared.into_iter().flatten().any(|variable| variable.name == *name);
                Some((if is_own { self.unit.name.clone() } else { String::new() }, name.clone()))
            }
            Ex::Field(instance, output) => Some((self.block(instance)?.into(), output.clone())),
            _ => None,
        }
    }

    fn block(&self, instance: &str) -> Option<&str> {
        self.blocks.get(instance).copied()
    }
}
