//! Values of which the search may find out where nobody reads them.

use super::Asked;
use super::automaton::Line;
use super::properties::{read_by, searched};
use crate::ir::{
    Automaton, Expr, ExprKind, Implements, InterfaceId, KeptBy, Place, PropertyKind, Rule, Scalar, Type,
};
use autogen_search::program::Instance;
use autogen_search::start::Start;
use autogen_search::unread::{Cell, Tell, Unread};
use autogen_search::value::Var;
use std::collections::BTreeSet;

/// A number that tells has so many values, at most.
const FEW: usize = 4;
/// So many of them tell about the values of an instance, at most.
const TELLS: usize = 4;

/// A local, or a cell of an interface, of an automaton.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Local(usize),
    Cell(InterfaceId, usize),
}

/// Locals and cells, but for those that obligations read, which are asked for between scans too. What their owner says with
/// a truth, or with a number of few values, tells about the others.
pub fn unread(line: &Line, asked: &Asked, instances: &[Instance], length: usize) -> Unread {
    let (mut kinds, mut told) = (Vec::new(), Vec::new());
    let (mut single, mut elements) = (Vec::new(), Vec::new());
    for (owner, instance) in line.system.instances.iter().enumerate() {
        let awaited = awaited(line, asked, owner);
        let mut tells = Vec::new();
        let mut own = Vec::new();
        for value in values(line, owner) {
            match (value.vars, few(value.ty)) {
                ([var], Some(values)) if value.is_own => tells.push(Tell { var: *var, values }),
                _ => own.push(value),
            }
        }
        tells.truncate(TELLS);
        told.push(tells);
        for Value { kind, vars, with, .. } in own.into_iter().filter(|value| !awaited.contains(&value.kind)) {
            let key = (instance.automaton, kind);
            let number = kinds.iter().position(|known| *known == key).unwrap_or(kinds.len());
            if number == kinds.len() {
                kinds.push(key);
            }
            for (element, var) in vars.iter().enumerate() {
                let token = with.and_then(|(tokens, values)| {
                    // One token may be that of all elements.
                    let var = tokens.get(element).or(tokens.first())?;
                    Some(Tell { var: *var, values })
                });
                let cell = Cell { var: *var, owner, kind: number, token, instead: var.load(line.initial) };
                if vars.len() == 1 { single.push(cell) } else { elements.push(cell) }
            }
        }
    }
    single.extend(elements);
    Unread::new(single, told, instances, length, starts(line, instances))
}

/// The vehicles: at first it is forgotten in every state where one that is under way has set out.
fn starts(line: &Line, instances: &[Instance]) -> Vec<Start> {
    let plants = line.plants.iter().enumerate();
    let vehicles = plants.filter_map(|(machine, plant)| Some((machine, plant.machine.route.as_ref()?)));
    let starts = vehicles.map(|(machine, route)| Start {
        machine,
        at: route.at,
        kind: line.system.instances[machine].automaton.0,
        known: vec![false; instances[machine].states.len()],
    });
    starts.collect()
}

struct Value<'a> {
    kind: Kind,
    ty: Type,
    vars: &'a [Var],
    /// Its owner alone writes it.
    is_own: bool,
    /// The tokens of its elements, and how many values they have.
    with: Option<(&'a [Var], usize)>,
}

/// What an instance shares, and what it remembers by itself.
fn values<'a>(line: &'a Line, owner: usize) -> impl Iterator<Item = Value<'a>> {
    let model = &line.system.model;
    let automaton = line.system.automaton_of(owner);
    let rows = automaton.implements.iter().zip(&line.system.instances[owner].rows);
    let cells = rows.flat_map(move |(Implements { interface, .. }, row)| {
        let shape = &model.interface(*interface).cells;
        let vars = move |cell: usize| &line.cells[interface.0][*row][cell].0[..];
        shape.iter().enumerate().filter_map(move |(cell, declared)| {
            let with = match declared.rule {
                Rule::Owner => None,
                Rule::With(token) => Some((vars(token), line.members(shape[token].ty.scalar))),
                _ => return None,
            };
            let kind = Kind::Cell(*interface, cell);
            let is_own = with.is_none();
            Some(Value { kind, ty: declared.ty, vars: vars(cell), is_own, with })
        })
    });
    let locals = automaton.locals.iter().zip(&line.locals[owner]).enumerate();
    let locals = locals.filter(|(_, (local, _))| local.kept_by == KeptBy::Steps);
    cells.chain(locals.map(|(number, (local, (vars, _)))| Value {
        kind: Kind::Local(number),
        ty: local.ty,
        vars,
        is_own: true,
        with: None,
    }))
}

/// How many values a truth has, or a number with few.
fn few(ty: Type) -> Option<usize> {
    match ty.scalar {
        Scalar::Bool => Some(2),
        Scalar::Int { lo, hi } => {
            usize::try_from(i64::from(hi) - i64::from(lo) + 1).ok().filter(|n| *n <= FEW)
        }
        _ => None,
    }
}

/// What obligations read: all cells of which any type asks, and the locals of this instance.
fn awaited(line: &Line, asked: &Asked, owner: usize) -> BTreeSet<Kind> {
    fn add(automaton: &Automaton, expr: &Expr, is_own: bool, found: &mut BTreeSet<Kind>) {
        match &expr.kind {
            ExprKind::Define(define) => add(automaton, &automaton.defines[*define].value, is_own, found),
            ExprKind::Read(Place::Cell { interface, cell, .. }) => {
                found.insert(Kind::Cell(*interface, *cell));
            }
            ExprKind::Read(Place::Local { local, .. }) if is_own => {
                found.insert(Kind::Local(*local));
            }
            _ => {}
        }
        expr.parts().for_each(|part| add(automaton, part, is_own, found));
    }
    let mut found = BTreeSet::new();
    for automaton in &line.system.model.automata {
        let is_own = std::ptr::eq(automaton, line.system.automaton_of(owner));
        for property in searched(automaton, asked) {
            if matches!(property.kind, PropertyKind::Whenever { .. }) {
                read_by(property).into_iter().for_each(|expr| add(automaton, expr, is_own, &mut found));
            }
        }
    }
    found
}
