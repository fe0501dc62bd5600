//! Properties as they are searched.

use super::automaton::Instance;
use super::memory::{Memory, kept};
use super::{Asked, Remembered, Warnings};
use crate::ir::{self, Automaton, Expr, ExprKind, Operator, Place, PropertyKind, Scalar, Severity, Value};
use crate::library;
use autogen_search::program::Cells;
use autogen_search::property::{self, Always, Check, Effect, Keep, Property, Whenever};

/// Which properties of a type are searched. Of obligations those are left out whose violation calls the operator, because
/// that is meant, and `answer` (which alone begins anew): contracts say that every command can be answered.
pub fn searched<'a>(automaton: &'a Automaton, asked: &'a Asked) -> impl Iterator<Item = &'a ir::Property> {
    let is_asked = |property: &&'a ir::Property| match (&property.kind, property.severity, asked.warnings) {
        (PropertyKind::Whenever { anew: Some(_), .. }, ..) => false,
        (PropertyKind::Whenever { .. }, ..) if property.asks_operator => false,
        (_, Severity::Machine | Severity::Line, _) | (_, _, Warnings::All) => true,
        (_, Severity::Warning, Warnings::None) => false,
        (_, Severity::Warning, Warnings::Own(sources)) => !library::has(sources.file(property.place.file)),
    };
    automaton.properties.iter().filter(is_asked)
}

/// What is read for a property.
pub fn read_by(property: &ir::Property) -> Vec<&Expr> {
    match &property.kind {
        PropertyKind::Always(condition) => vec![condition],
        PropertyKind::Keep { condition, values, .. } => {
            std::iter::once(condition).chain(values.iter().map(|kept| &kept.value)).collect()
        }
        PropertyKind::Whenever { trigger, goal, .. } => vec![trigger, goal],
    }
}

/// Whether a property that is searched stops the machine.
pub fn can_stop(automaton: &Automaton, asked: &Asked) -> bool {
    searched(automaton, asked).any(|property| {
        property.severity == Severity::Machine && !matches!(property.kind, PropertyKind::Whenever { .. })
    })
}

/// What an `invariant` denies before it asks for anything: of `not a or not b or c` it is `not a or not b`. If nothing else
/// follows, all but the first is asked for.
fn excuse(automaton: &Automaton, condition: &Expr) -> Option<Expr> {
    match &condition.kind {
        ExprKind::Define(define) => excuse(automaton, &automaton.defines[*define].value),
        ExprKind::Forall { variable, domain, body } => {
            let body = Box::new(excuse(automaton, body)?);
            let kind = ExprKind::Forall { variable: *variable, domain: domain.clone(), body };
            Some(Expr { ty: condition.ty, kind })
        }
        ExprKind::Binary(Operator::Or, ..) => {
            let parts = alternatives(condition);
            let denies = |part: &&&Expr| {
                matches!(part.kind, ExprKind::Not(_) | ExprKind::Binary(Operator::NotEqual, ..))
            };
            let denied = parts.iter().take_while(denies).count();
            let number = if denied == parts.len() { 1 } else { denied };
            let any = |a: Expr, b: &Expr| Expr {
                ty: condition.ty,
                kind: ExprKind::Binary(Operator::Or, Box::new(a), Box::new(b.clone())),
            };
            let (first, others) = parts[..number].split_first()?;
            Some(others.iter().fold((*first).clone(), |all, part| any(all, part)))
        }
        _ => None,
    }
}

fn alternatives(condition: &Expr) -> Vec<&Expr> {
    match &condition.kind {
        ExprKind::Binary(Operator::Or, a, b) => {
            [a, b].into_iter().flat_map(|part| alternatives(part)).collect()
        }
        _ => vec![condition],
    }
}

/// A property of an instance that cannot be searched: it reads what no contract describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Skipped {
    pub instance: usize,
    /// Number among the properties of its type.
    pub property: usize,
}

impl Instance<'_> {
    /// The properties that are searched, first those that stop the machine; what they remember is laid out in the state.
    pub fn properties(
        &mut self,
        asked: &Asked,
        memory: &mut Memory,
        skipped: &mut Vec<Skipped>,
    ) -> Vec<Property> {
        let mut found = Vec::new();
        self.sees_what_is_put_out = true;
        for property in searched(self.automaton, asked) {
            let refused = self.refused.len();
            self.begin_anew();
            let check = match &property.kind {
                PropertyKind::Always(condition) => Check::Always(self.always(condition)),
                PropertyKind::Keep { condition, values, .. } => {
                    self.keep(condition, values.iter().map(|kept| &kept.value), asked, memory)
                }
                PropertyKind::Whenever { trigger, goal, .. } => {
                    let (trigger, goal) = (self.int(trigger), self.int(goal));
                    let name = format!("{}.(waits)", self.instance().name);
                    let waits = memory.number(self.number, name, 1, 0);
                    let is_told = !self.asks_inputs && asked.remembered == Remembered::Least;
                    Check::Whenever(Whenever { trigger, goal, waits, is_told })
                }
            };
            let is_new_refusal = self.refused.len() > refused;
            let is_invariant =
                matches!(property.kind, PropertyKind::Always(_)) && property.severity != Severity::Warning;
            if is_new_refusal && !is_invariant {
                self.refused.truncate(refused);
                let number = self.automaton.properties.iter().position(|other| std::ptr::eq(other, property));
                skipped.extend(number.map(|property| Skipped { instance: self.number, property }));
                continue;
            }
            let effect = match property.severity {
                Severity::Warning => Effect::Warns,
                Severity::Machine => Effect::StopsMachine,
                _ if property.asks_operator => Effect::AsksOperator,
                _ => Effect::Fault,
            };
            let reads = read_by(property).into_iter().map(|expr| self.cells_of(expr));
            let reads = reads.fold(Cells::default(), |all, cells| all | cells);
            let asks_inputs = self.asks_inputs;
            let sees_stop = effect == Effect::StopsMachine
                && read_by(property).into_iter().any(|expr| self.reads_masked(expr));
            found.push(Property { check, fault: property.site.0, effect, reads, asks_inputs, sees_stop });
        }
        self.sees_what_is_put_out = false;
        found.sort_by_key(|property| property.effect != Effect::StopsMachine);
        found
    }

    fn always(&mut self, condition: &Expr) -> Always {
        let whole = self.int(condition);
        // It reads nothing else, so it is refused only where this is.
        let refused = self.refused.len();
        let excuse = excuse(self.automaton, condition).map(|excuse| self.int(&excuse));
        self.refused.truncate(refused);
        Always { condition: whole, excuse }
    }

    fn keep<'a>(
        &mut self,
        condition: &Expr,
        values: impl Iterator<Item = &'a Expr>,
        asked: &Asked,
        memory: &mut Memory,
    ) -> Check {
        let condition = self.int(condition);
        let types: Vec<(Scalar, property::Value)> =
            values.map(|value| (value.ty, self.property_value(value))).collect();
        let is_told = !self.asks_inputs && asked.remembered == Remembered::Least;
        let remembered = || {
            let name = |what: &str| format!("{}.(kept {what})", self.instance().name);
            let held = memory.number(self.number, name("while"), 1, 0);
            let before = types.iter().map(|(ty, _)| {
                let initial = match ty {
                    Scalar::Bool => Value::Bool(false),
                    Scalar::Real => Value::Real(0.0),
                    Scalar::Point => Value::Point([0.0; 3]),
                    _ => Value::Int(self.kept(*ty).low),
                };
                memory.value(self.number, name("value"), *ty, self.kept(*ty), initial)
            });
            property::Memory { held, before: before.collect() }
        };
        let memory = (!is_told).then(remembered);
        Check::Keep(Keep { condition, values: types.into_iter().map(|(_, value)| value).collect(), memory })
    }

    fn property_value(&mut self, value: &Expr) -> property::Value {
        match value.ty {
            Scalar::Real => property::Value::Real(self.real(value)),
            Scalar::Point => property::Value::Point(self.point(value)),
            ty => property::Value::Int(self.int(value), self.kept(ty).low),
        }
    }

    fn kept(&self, ty: Scalar) -> super::memory::Kept {
        kept(ty, |ty| self.line.members(ty))
    }

    /// Whether an expression reads an output that has a stop value while the machine is stopped.
    fn reads_masked(&self, expr: &Expr) -> bool {
        let own = match &expr.kind {
            ExprKind::Define(define) => self.reads_masked(&self.automaton.defines[*define].value),
            ExprKind::Read(Place::Port { port, .. }) => self.automaton.masked.contains(port),
            _ => false,
        };
        own || expr.parts().any(|part| self.reads_masked(part))
    }

    /// The cells that an expression reads.
    fn cells_of(&self, expr: &Expr) -> Cells {
        let own = match &expr.kind {
            ExprKind::Define(define) => self.cells_of(&self.automaton.defines[*define].value),
            ExprKind::Read(Place::Cell { interface, cell, of, .. }) => {
                self.line.cells_read(*interface, *cell, of.is_none().then_some(self.number))
            }
            _ => Cells::default(),
        };
        expr.parts().fold(own, |all, part| all | self.cells_of(part))
    }
}
