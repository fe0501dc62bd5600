//! Who may write a cell, from the text of the types, the rule of the cell and its present value.

use super::watch::{By, Watch};
use crate::ir::Element;
use crate::ir::{Automaton, Expr, ExprKind, InterfaceId, Place, Rule, System, Value};
use crate::spec::ast::Side;
use std::collections::BTreeSet;

/// A cell that an automaton writes somewhere.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Written {
    interface: InterfaceId,
    cell: usize,
    of: Whose,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Whose {
    Own,
    /// Of members of its roles.
    Roles,
    /// Of those to which a parameter refers, by its number.
    Parameter(usize),
    /// Of whomever it was told of.
    Anyone,
}

/// For each automaton the cells that it writes.
pub struct Writers(Vec<BTreeSet<Written>>);

impl Writers {
    pub fn new(system: &System) -> Self {
        Self(system.model.automata.iter().map(written).collect())
    }

    fn writes(&self, system: &System, instance: usize, written: Written) -> bool {
        self.0[system.instances[instance].automaton.0].contains(&written)
    }

    /// The instances other than the owner that may write a cell of this row.
    fn others(&self, system: &System, interface: InterfaceId, row: usize, cell: usize) -> Vec<usize> {
        let owner = system.members[interface.0][row];
        let knows = |instance: usize| {
            let mut roles = system.automaton_of(instance).roles.iter().zip(&system.instances[instance].roles);
            roles.any(|(role, rows)| role.interface == interface && rows.contains(&row))
        };
        let writes =
            |instance: usize, of: Whose| self.writes(system, instance, Written { interface, cell, of });
        let refers = |instance: usize| {
            let parameters = system.instances[instance].parameters.iter().enumerate();
            let mut parameters = parameters
                .filter(|(_, values)| values.contains(&Value::Int(row as i32)))
                .map(|(number, _)| number);
            parameters.any(|number| writes(instance, Whose::Parameter(number)))
        };
        let may_write = |instance: usize| {
            writes(instance, Whose::Anyone)
                || writes(instance, Whose::Roles) && knows(instance)
                || refers(instance)
        };
        (0..system.instances.len()).filter(|i| *i != owner && may_write(*i)).collect()
    }

    /// The instances that may change an element of a cell as it is now. Of a lock that is taken, and of a token
    /// that is with others, the one that wrote it last.
    pub fn of_now(&self, watch: &Watch, element: Element) -> Vec<usize> {
        let Element::Cell { interface, row, cell, index } = element else { return Vec::new() };
        let system = watch.system;
        let own = system.members[interface.0][row];
        let owner = || -> Vec<usize> {
            let writes = self.writes(system, own, Written { interface, cell, of: Whose::Own });
            writes.then_some(own).into_iter().collect()
        };
        let others = || self.others(system, interface, row, cell);
        let last = |element: Element| match watch.last.get(&element)?.by {
            By::Machine(robot) => Some(robot),
            By::LossOfPower => None,
        };
        let rules = &system.model.interface(interface).cells;
        let token = |sides: &[Side], cell: usize| {
            let element = Element::Cell { interface, row, cell, index };
            let Value::Int(value) = watch.executor.element(element) else { return Vec::new() };
            match (sides.get(value as usize), last(element)) {
                (Some(Side::Owner), _) => owner(),
                (Some(Side::Others), Some(robot)) if robot != own => vec![robot],
                _ => others(),
            }
        };
        let is_true = watch.executor.element(element) == Value::Bool(true);
        match &rules[cell].rule {
            Rule::Owner => owner(),
            Rule::Handshake if is_true => owner(),
            Rule::Handshake => others(),
            Rule::Lock if is_true => last(element).map_or_else(others, |robot| vec![robot]),
            // Whoever wants it takes it: nobody has to be waited for.
            Rule::Lock => Vec::new(),
            Rule::Counter => owner().into_iter().chain(others()).collect(),
            Rule::Token(sides) => token(sides, cell),
            Rule::With(other) => match &rules[*other].rule {
                Rule::Token(sides) => token(sides, *other),
                _ => Vec::new(),
            },
        }
    }
}

fn written(automaton: &Automaton) -> BTreeSet<Written> {
    let cells = targets(automaton).filter_map(|(place, _)| match place {
        Place::Cell { interface, cell, of, .. } => {
            let of = of.as_ref().map_or_else(|| vec![Whose::Own], |of| whose(automaton, of));
            Some(of.into_iter().map(|of| Written { interface: *interface, cell: *cell, of }))
        }
        _ => None,
    });
    cells.flatten().collect()
}

/// What is written, with the value if it is one expression.
fn targets(automaton: &Automaton) -> impl Iterator<Item = (&Place, Option<&Expr>)> {
    let transitions = automaton.states.iter().flat_map(|state| &state.transitions);
    let updates = transitions.flat_map(|transition| &transition.updates);
    updates.filter_map(|update| Some((&update.kind.target()?.place, update.kind.value())))
}

/// To whom a reference may lead: a variable of a guard to a member of a role, a parameter to what the layout says, and a
/// local to whatever it is told.
fn whose(automaton: &Automaton, reference: &Expr) -> Vec<Whose> {
    let Some(local) = local(reference) else { return vec![directly(reference)] };
    let values = targets(automaton).filter(|(place, _)| is_local(place, local));
    let found: Vec<Whose> = values.map(|(_, value)| value.map_or(Whose::Anyone, directly)).collect();
    if found.is_empty() { vec![Whose::Anyone] } else { found }
}

fn local(reference: &Expr) -> Option<usize> {
    match &reference.kind {
        ExprKind::Read(Place::Local { local, .. }) => Some(*local),
        _ => None,
    }
}

fn is_local(place: &Place, number: usize) -> bool {
    matches!(place, Place::Local { local, .. } if *local == number)
}

fn directly(reference: &Expr) -> Whose {
    match &reference.kind {
        ExprKind::Own(_) => Whose::Own,
        ExprKind::Variable(_) => Whose::Roles,
        ExprKind::Read(Place::Parameter { parameter, .. }) => Whose::Parameter(*parameter),
        _ => Whose::Anyone,
    }
}
