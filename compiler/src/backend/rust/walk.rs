//! What expressions and updates read: wiring, cells, variables.

use crate::ir::{
    Automaton, Clause, Domain, Expr, ExprKind, Place, Transition, Update, UpdateKind, VariableId,
};
use std::collections::BTreeSet;

/// What a piece of code reads or writes beside the robot itself.
#[derive(Clone, Debug, Default)]
pub struct Uses {
    pub wiring: bool,
    pub cells: Access,
    /// Whether the last command has ended successfully.
    pub done: bool,
    /// Whether it has ended in error.
    pub failed: bool,
    pub variables: BTreeSet<VariableId>,
    /// The number of the scan.
    pub scan: bool,
    /// Whether there is an edge of `start`.
    pub start: bool,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Access {
    #[default]
    None,
    Read,
    Write,
}

impl Uses {
    pub fn of_expr(automaton: &Automaton, expr: &Expr) -> Self {
        let mut uses = Self::default();
        uses.expr(automaton, expr);
        uses
    }

    pub fn of_clauses(automaton: &Automaton, clauses: &[Clause]) -> Self {
        let mut uses = Self::default();
        for clause in clauses {
            match clause {
                Clause::Condition(condition) => uses.expr(automaton, condition),
                Clause::Bind(binder) => {
                    uses.domain(automaton, &binder.domain);
                    binder.condition.iter().chain(&binder.key).for_each(|e| uses.expr(automaton, e));
                }
            }
        }
        uses
    }

    pub fn of_updates(automaton: &Automaton, updates: &[Update]) -> Self {
        let mut uses = Self::default();
        for update in updates {
            match &update.kind {
                UpdateKind::Assign { target, value, .. } | UpdateKind::Fill { target, value, .. } => {
                    uses.expr(automaton, value);
                    uses.written(automaton, &target.place);
                }
                UpdateKind::Copy { target, source, .. } => {
                    uses.place(automaton, source);
                    uses.written(automaton, &target.place);
                }
                UpdateKind::Command { arguments, .. } => {
                    arguments.iter().for_each(|a| uses.expr(automaton, &a.value));
                }
            }
        }
        uses
    }

    pub fn of_transition(automaton: &Automaton, transition: &Transition) -> Self {
        let mut uses = Self::of_clauses(automaton, &transition.clauses);
        uses.join(Self::of_updates(automaton, &transition.updates));
        uses
    }

    pub fn join(&mut self, other: Self) {
        self.wiring |= other.wiring;
        self.cells = self.cells.max(other.cells);
        self.done |= other.done;
        self.failed |= other.failed;
        self.scan |= other.scan;
        self.start |= other.start;
        self.variables.extend(other.variables);
    }

    pub fn expr(&mut self, automaton: &Automaton, expr: &Expr) {
        match &expr.kind {
            ExprKind::Constant(_)
            | ExprKind::Own(_)
            | ExprKind::Permit
            | ExprKind::Stopped
            | ExprKind::InState(_)
            | ExprKind::Members(_) => {}
            ExprKind::Done => self.done = true,
            ExprKind::Failed => self.failed = true,
            ExprKind::Read(place) => self.place(automaton, place),
            ExprKind::Variable(id) => {
                self.variables.insert(*id);
            }
            ExprKind::Define(define) => {
                let inner = Self::of_expr(automaton, &automaton.defines[*define].value);
                self.join(Self { variables: BTreeSet::new(), ..inner });
            }
            ExprKind::After(inner)
            | ExprKind::Not(inner)
            | ExprKind::Negate(inner)
            | ExprKind::Absolute(inner)
            | ExprKind::ToReal(inner)
            | ExprKind::IsFinite(inner)
            | ExprKind::Coordinate(inner, _)
            | ExprKind::IsMember(inner, _) => self.expr(automaton, inner),
            ExprKind::Binary(_, a, b)
            | ExprKind::Min(a, b)
            | ExprKind::Max(a, b)
            | ExprKind::SquaredDistance(a, b) => {
                self.expr(automaton, a);
                self.expr(automaton, b);
            }
            ExprKind::Reaches(_, a, b) => {
                self.wiring = true;
                self.expr(automaton, a);
                self.expr(automaton, b);
            }
            ExprKind::MakePoint(parts) => parts.iter().for_each(|p| self.expr(automaton, p)),
            ExprKind::Exists { domain, body, .. }
            | ExprKind::Forall { domain, body, .. }
            | ExprKind::Count { domain, body, .. }
            | ExprKind::Sum { domain, body, .. } => {
                self.domain(automaton, domain);
                self.expr(automaton, body);
            }
        }
    }

    fn domain(&mut self, automaton: &Automaton, domain: &Domain) {
        if let Domain::Range(low, high) = domain {
            self.expr(automaton, low);
            self.expr(automaton, high);
        }
    }

    fn written(&mut self, automaton: &Automaton, place: &Place) {
        self.place(automaton, place);
        if matches!(place, Place::Cell { .. }) {
            self.cells = Access::Write;
        }
    }

    fn place(&mut self, automaton: &Automaton, place: &Place) {
        let (of, index) = match place {
            Place::Local { index, .. } | Place::Port { index, .. } | Place::Parameter { index, .. } => {
                (None, index)
            }
            Place::Cell { of, index, .. } => {
                self.cells = self.cells.max(Access::Read);
                (of.as_ref(), index)
            }
            Place::Shown { of, index, .. } => {
                self.wiring = true;
                (Some(of), index)
            }
        };
        of.into_iter().chain(index).for_each(|e| self.expr(automaton, e));
    }
}
