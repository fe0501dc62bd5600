//! What every part of the emitter reads, and the state of lowering one automaton.

use super::code::{Ex, Member, Stmt, written};
use super::declaration::{Basic, Variable};
use super::name::Name;
use super::names::{AutomatonNames, Names};
use super::role::{self, Members};
use crate::ir::{Automaton, AutomatonId, EnumId, RoleId, System, Value};
use crate::naming::st::Scope;
use crate::source::{Sources, Span};
use std::collections::{BTreeMap, HashSet};
use std::ops::Deref;

#[derive(Clone, Copy)]
pub struct Shared<'a> {
    pub system: &'a System,
    pub sources: &'a Sources,
    pub names: &'a Names,
}

/// Where an expression stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// Nothing has been written in this step.
    Guard,
    /// Behind updates: what was computed for the guard may be out of date.
    Update,
}

/// The lowering of one automaton: the variables that it makes on its way.
pub struct Lowering<'a> {
    pub shared: Shared<'a>,
    pub id: AutomatonId,
    pub phase: Phase,
    /// Temporary variables, in the order in which they were made.
    pub temporaries: Vec<Variable>,
    /// Computations of defines, which come before the statement or guard that reads them.
    pub hoisted: Vec<Stmt>,
    /// Defines whose variables hold their present value, with all names that were read for it.
    pub known: BTreeMap<usize, HashSet<Name>>,
    scope: Scope,
    /// By what they are for and their number among those in use at once.
    given: BTreeMap<(String, Basic, usize), String>,
    in_use: BTreeMap<(String, Basic), usize>,
}

impl<'a> Deref for Lowering<'a> {
    type Target = Shared<'a>;

    fn deref(&self) -> &Shared<'a> {
        &self.shared
    }
}

impl<'a> Lowering<'a> {
    pub fn new(shared: Shared<'a>, id: AutomatonId) -> Self {
        Self {
            shared,
            id,
            phase: Phase::Guard,
            temporaries: Vec::new(),
            hoisted: Vec::new(),
            known: BTreeMap::new(),
            scope: shared.names.automata[id.0].scope.inner(),
            given: BTreeMap::new(),
            in_use: BTreeMap::new(),
        }
    }

    pub fn automaton(&self) -> &'a Automaton {
        self.shared.system.model.automaton(self.id)
    }

    pub fn own(&self) -> &'a AutomatonNames {
        &self.shared.names.automata[self.id.0]
    }

    /// A variable that holds a value within one guard or update.
    pub fn temporary(&mut self, purpose: &str, basic: Basic) -> String {
        let number = self.in_use.entry((purpose.into(), basic)).or_default();
        *number += 1;
        let key = (purpose.to_string(), basic, *number);
        if let Some(known) = self.given.get(&key) {
            return known.clone();
        }
        let name = self.scope.take(purpose);
        self.temporaries.push(Variable::new(name.clone(), basic));
        self.given.insert(key, name.clone());
        name
    }

    /// A name that nothing else of the block has.
    pub fn free_name(&mut self, wanted: &str) -> String {
        self.scope.take(wanted)
    }

    /// Forgets the defines that read what these statements write.
    pub fn forget(&mut self, statements: &[Stmt]) {
        let mut written = written(statements);
        if self.answer_names().iter().any(|name| written.contains(name)) {
            written.extend(["done".into(), "failed".into()]);
        }
        self.known.retain(|_, read| read.is_disjoint(&written));
    }

    /// Temporary variables hold nothing any more that is needed.
    pub fn release(&mut self) {
        self.in_use.clear();
    }
}

impl Shared<'_> {
    /// How the members of a role are known to the block of a type.
    pub fn members(&self, id: AutomatonId, role: RoleId) -> Members {
        role::members(self.system, id, role)
    }

    /// `agv.aut:12`
    pub fn line(&self, place: Span) -> String {
        let file = &self.sources.file(place.file).name;
        let file = file.rsplit(['/', '\\']).next().unwrap_or(file);
        format!("{file}:{}", self.sources.position(place).0)
    }

    /// A place of the specification, on one line.
    pub fn text(&self, place: Span) -> String {
        one_line(self.sources.text(place))
    }

    /// A define as written, from its name on.
    pub fn definition(&self, name: Span) -> String {
        let rest = &self.sources.file(name.file).text[name.start as usize..];
        one_line(rest.split(';').next().unwrap_or_default())
    }

    pub fn member(&self, id: EnumId, value: i32) -> Ex {
        let names = &self.names.enums[id.0];
        let number = value.max(0) as usize;
        Ex::Member(Member {
            value,
            note: self.system.model.enums[id.0].members.get(number).cloned().unwrap_or_default(),
            qualified: names.members.get(number).map(|member| format!("{}.{member}", names.ty)),
        })
    }

    pub fn state(&self, automaton: AutomatonId, state: usize) -> Member {
        let names = &self.names.automata[automaton.0].states;
        Member {
            value: state as i32,
            note: self.system.model.automaton(automaton).states[state].name.clone(),
            qualified: Some(format!("{}.{}", names.ty, names.members[state])),
        }
    }

    /// The constants of one value, members by name.
    pub fn constants(&self, scalar: crate::ir::Scalar, value: Value) -> Vec<Ex> {
        match (scalar, value) {
            (crate::ir::Scalar::Enum(id), Value::Int(i)) => vec![self.member(id, i)],
            _ => super::declaration::constants(value),
        }
    }

    /// Instances of a type, in layout order.
    pub fn instances(&self, id: AutomatonId) -> Vec<usize> {
        (0..self.system.instances.len()).filter(|i| self.system.instances[*i].automaton == id).collect()
    }
}

/// Without line breaks and comments.
fn one_line(text: &str) -> String {
    let lines = text.lines().map(|line| line.split("//").next().unwrap_or_default());
    lines.flat_map(str::split_whitespace).collect::<Vec<_>>().join(" ")
}
