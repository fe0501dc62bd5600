//! How much a scan may have to do: nested loops and definitions multiply, and a scan has to end in time.

use super::context::Context;
use crate::diagnostic::Diagnostic;
use crate::ir::{
    Automaton, Clause, Domain, Expr, ExprKind, Model, Scalar, Transition, UpdateKind, VariableId,
};
use crate::source::Span;

/// Operations that one transition, definition or condition may take at most.
pub(crate) const MOST: u64 = 1_000_000;
/// Members that a role without a greatest number is taken to have, before a layout is known.
const MEMBERS: u64 = 16;

impl Context<'_, '_> {
    /// Refuses what could take too long.
    pub(super) fn bounded_work(&mut self) {
        let roles = self.automaton.roles.iter();
        let members = roles.map(|role| role.max.map_or(MEMBERS, |max| max as u64)).collect();
        let work = Work::new(&self.checker.model, &self.automaton, members);
        let automaton = &self.automaton;
        let mut found: Vec<(Span, u64)> =
            automaton.defines.iter().zip(&work.defines).map(|(define, work)| (define.place, *work)).collect();
        found.extend(work.of_scans());
        found.extend(automaton.requires.iter().map(|r| (r.place, work.of(&r.condition))));
        for (place, work) in found.into_iter().filter(|(_, work)| *work > MOST) {
            self.report(
                Diagnostic::new("E0320", place, "this could take too long for one scan")
                    .label(format!("up to {work} operations, {MOST} are allowed"))
                    .note(format!("nested ranges multiply; a role counts with the most members that it may have, `[]` and `[1..]` as {MEMBERS}"))
                    .help("use shorter ranges, nest fewer of them, or keep a result in a local variable"),
            );
        }
    }
}

/// Operations, as numbers of expressions that are evaluated.
pub(crate) struct Work<'a> {
    model: &'a Model,
    automaton: &'a Automaton,
    /// Of each role.
    members: Vec<u64>,
    /// Of each definition.
    defines: Vec<u64>,
}

impl<'a> Work<'a> {
    pub fn new(model: &'a Model, automaton: &'a Automaton, members: Vec<u64>) -> Self {
        let mut work = Self { model, automaton, members, defines: Vec::new() };
        for define in &automaton.defines {
            let of = work.of(&define.value);
            work.defines.push(of);
        }
        work
    }

    /// Of each transition and each property, with its place.
    pub fn of_scans(&self) -> Vec<(Span, u64)> {
        let transitions = self.automaton.states.iter().flat_map(|state| &state.transitions);
        let mut found: Vec<_> = transitions.map(|t| (t.place, self.transition(t))).collect();
        found.extend(self.automaton.properties.iter().map(|property| {
            let exprs = property.exprs().into_iter();
            (property.place, exprs.fold(0, |sum, expr| u64::saturating_add(sum, self.of(expr))))
        }));
        found
    }

    pub fn of(&self, expr: &Expr) -> u64 {
        match &expr.kind {
            // A definition reads only those before it.
            ExprKind::Define(define) => self.defines.get(*define).copied().unwrap_or(1).saturating_add(1),
            ExprKind::Exists { variable, domain, body }
            | ExprKind::Forall { variable, domain, body }
            | ExprKind::Count { variable, domain, body }
            | ExprKind::Sum { variable, domain, body } => {
                self.size(*variable, domain).saturating_mul(self.of(body)).saturating_add(1)
            }
            _ => expr.parts().fold(1, |sum, part| sum.saturating_add(self.of(part))),
        }
    }

    /// Updates come once, after the guard.
    fn transition(&self, transition: &Transition) -> u64 {
        let updates = transition.updates.iter().map(|update| self.update(&update.kind));
        updates.fold(self.guard(&transition.clauses), u64::saturating_add)
    }

    fn update(&self, update: &UpdateKind) -> u64 {
        let elements = match update {
            UpdateKind::Fill { target, .. } | UpdateKind::Copy { target, .. } => {
                self.model.elements(target.ty.extent) as u64
            }
            UpdateKind::Assign { .. } | UpdateKind::Command { .. } => 1,
        };
        update.exprs().into_iter().fold(elements, |sum, expr| sum.saturating_add(self.of(expr)))
    }

    /// Clauses are nested loops.
    fn guard(&self, clauses: &[Clause]) -> u64 {
        clauses.iter().rev().fold(1, |inner, clause| match clause {
            Clause::Condition(condition) => inner.saturating_add(self.of(condition)),
            Clause::Bind(binder) => {
                let own = [&binder.condition, &binder.key].into_iter().flatten();
                let once = own.fold(inner, |sum, expr| sum.saturating_add(self.of(expr)));
                self.size(binder.variable, &binder.domain).saturating_mul(once)
            }
        })
    }

    fn size(&self, variable: VariableId, domain: &Domain) -> u64 {
        match domain {
            Domain::Role(id) => self.members[id.0],
            Domain::Enum(id) => self.model.enums[id.0].members.len() as u64,
            Domain::Range(..) => match self.automaton.variables[variable.0].ty.scalar {
                Scalar::Int { lo, hi } => (i64::from(hi) - i64::from(lo)).unsigned_abs() + 1,
                _ => 1,
            },
        }
    }
}
