//! Blocks, and what they are given.

use super::POINT;
use super::access::Places;
use super::calls::Calls;
use super::enumerations::Typed;
use super::rewrite::joined;
use crate::backend::st::code::{self, Ex, Stmt};
use crate::backend::st::declaration::{Unit, Variable};
use crate::backend::st::globals::Index;
use crate::backend::st::name::Name;
use std::collections::BTreeSet;
use std::sync::Arc;

/// A block, and the shared variables that each call gives it.
#[derive(Clone)]
pub struct Given<'a> {
    pub unit: Unit<'a>,
    pub shared: Vec<Name>,
    pub places: Arc<Places>,
    /// What it is called with, and the point of which that is a coordinate.
    points: Vec<(Name, Option<Name>)>,
}

impl Given<'_> {
    /// The point of which an argument is a coordinate. Most calls have all arguments, in this order.
    pub fn point_of(&self, number: usize, argument: &str) -> Option<&Name> {
        let is_it = |known: &&(Name, Option<Name>)| known.0 == argument;
        let known = self.points.get(number).filter(is_it).or_else(|| self.points.iter().find(is_it));
        known?.1.as_ref()
    }
}

pub fn unit<'a>(unit: &Unit, places: &Places, globals: &Index, typed: &Typed) -> Given<'a> {
    let body: Vec<Stmt> = unit.body.pieces().flat_map(|piece| places.statements(&piece)).collect();
    let used = code::names(&body);
    let written = written(&body);
    let of = |variables: &[Variable]| variables_of(variables, &unit.name, places, typed);
    let mut inputs = of(&unit.inputs);
    let outputs = of(&unit.outputs);
    // A point of which others see a coordinate is an output as a whole.
    let mut variables = of(&unit.variables);
    variables.retain(|variable| outputs.iter().all(|output| output.name != variable.name));
    let mut references = Vec::new();
    let mut shared = Vec::new();
    for global in globals.among(&used) {
        let is_single = global.elements.is_none() && global.structure.is_none();
        let is_read = is_single && !written.contains(&global.name);
        if is_read { &mut inputs } else { &mut references }.push(global.external());
        shared.push(global.name.clone());
    }
    let point = |variable: &Variable| {
        let place = places.get(&variable.name).filter(|place| place.coordinate.is_some());
        (variable.name.clone(), place.map(|place| place.of.clone()))
    };
    let points = unit.inputs.iter().map(point).collect();
    let body = body.into();
    let unit = Unit { inputs, outputs, references, variables, body, ..unit.without_body() };
    Given { unit, shared, places: Arc::new(places.clone()), points }
}

/// The program: its calls give blocks what they need.
pub fn program<'a>(unit: &'a Unit<'a>, calls: Calls<'a>) -> Unit<'a> {
    let statement = move |statement: &Stmt| match statement {
        Stmt::Call { instance, arguments } => calls.call(instance, arguments),
        _ => calls.places.statement(statement),
    };
    let body = unit.body.map(move |piece| joined(piece.iter().map(&statement).collect()));
    Unit { body, ..unit.without_body() }
}

/// Coordinates as points, and members of enumerations as such.
pub fn variables_of<'v>(
    variables: impl IntoIterator<Item = &'v Variable>,
    unit: &str,
    places: &Places,
    typed: &Typed,
) -> Vec<Variable> {
    let mut out: Vec<Variable> = Vec::new();
    for variable in variables {
        let named = typed.get(unit, &variable.name).cloned();
        let variable = Variable { enumeration: named, ..variable.clone() };
        match places.get(&variable.name) {
            Some(place) if place.coordinate.is_some() => {
                if out.iter().all(|known| known.name != place.of) {
                    let structure = Some(POINT.into());
                    out.push(Variable { name: place.of.clone(), structure, initial: None, ..variable });
                }
            }
            _ => out.push(variable),
        }
    }
    out
}

/// The variables of which a part is written.
fn written(statements: &[Stmt]) -> BTreeSet<Name> {
    let mut found = BTreeSet::new();
    let mut targets = Vec::new();
    each_target(statements, &mut targets);
    targets.into_iter().for_each(|target| root(target, &mut found));
    found
}

fn each_target<'a>(statements: &'a [Stmt], found: &mut Vec<&'a Ex>) {
    for statement in statements {
        match statement {
            Stmt::Assign(target, _) => found.push(target),
            Stmt::If(arms, otherwise) => {
                arms.iter().for_each(|arm| each_target(&arm.body, found));
                each_target(otherwise, found);
            }
            Stmt::Case { branches, otherwise, .. } => {
                branches.iter().for_each(|(_, body)| each_target(body, found));
                each_target(otherwise, found);
            }
            Stmt::While { body, .. } => each_target(body, found),
            Stmt::Comment(_) | Stmt::Exit | Stmt::Return | Stmt::Call { .. } => {}
        }
    }
}

fn root(target: &Ex, found: &mut BTreeSet<Name>) {
    match target {
        Ex::Name(name) | Ex::Element(name, _) => drop(found.insert(name.clone())),
        Ex::Part(of, _) | Ex::Item(of, _) => root(of, found),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_point_of_an_argument_does_not_depend_on_its_number() {
        let points = [("robot", None), ("at_x", Some("at")), ("rest_x", Some("rest"))];
        let points = points.map(|(name, of)| (Name::from(name), of.map(Name::from))).to_vec();
        let given = Given { unit: Unit::default(), shared: Vec::new(), places: Arc::default(), points };
        for number in 0..4 {
            let point_of = |argument| given.point_of(number, argument).map(Name::as_str);
            let found = ["robot", "at_x", "rest_x", "speed"].map(point_of);
            assert_eq!(found, [None, Some("at"), Some("rest"), None], "{number}");
        }
    }
}
