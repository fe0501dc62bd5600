//! What guards ask for, through definitions.

use super::{Automaton, Clause, Domain, Expr, ExprKind, Transition};

/// Expressions of an automaton that consist of one of a kind somewhere.
pub struct Asking<F> {
    is_wanted: F,
    /// Of each definition. It reads those before it only.
    defines: Vec<bool>,
}

impl<F: Fn(&ExprKind) -> bool> Asking<F> {
    pub fn new(automaton: &Automaton, is_wanted: F) -> Self {
        let mut asking = Self { is_wanted, defines: Vec::new() };
        for define in &automaton.defines {
            let asks = asking.expression(&define.value);
            asking.defines.push(asks);
        }
        asking
    }

    pub fn expression(&self, expr: &Expr) -> bool {
        match &expr.kind {
            ExprKind::Define(define) => self.defines.get(*define).is_some_and(|asks| *asks),
            kind => (self.is_wanted)(kind) || expr.parts().any(|part| self.expression(part)),
        }
    }

    pub fn guard(&self, transition: &Transition) -> bool {
        transition.guard_expressions().any(|expr| self.expression(expr))
    }
}

impl Transition {
    /// All that its guard consists of, keys and ranges of binders included.
    pub fn guard_expressions(&self) -> impl Iterator<Item = &Expr> {
        self.clauses.iter().flat_map(|clause| match clause {
            Clause::Condition(condition) => vec![condition],
            Clause::Bind(binder) => {
                let mut all: Vec<&Expr> = binder.condition.iter().chain(&binder.key).collect();
                if let Domain::Range(low, high) = &binder.domain {
                    all.extend([low, high]);
                }
                all
            }
        })
    }
}
