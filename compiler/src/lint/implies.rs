//! Whether one condition holds whenever others do, as far as their texts show it.

use crate::ir::{Automaton, Expr, ExprKind, Operator, Value};
use std::cell::Cell;

/// What holds if all of some conditions do.
pub struct Facts<'a> {
    automaton: &'a Automaton,
    facts: Vec<&'a Expr>,
    /// Steps that a proof may still take.
    left: Cell<u32>,
}

/// Definitions of definitions can be long; a warning is not worth waiting for.
const MOST_STEPS: u32 = 10_000;

impl<'a> Facts<'a> {
    pub fn new(automaton: &'a Automaton, conditions: impl Iterator<Item = &'a Expr>) -> Self {
        let mut facts = Self { automaton, facts: Vec::new(), left: Cell::new(MOST_STEPS) };
        conditions.for_each(|condition| facts.learn(condition));
        facts
    }

    fn learn(&mut self, condition: &'a Expr) {
        if !self.steps() {
            return;
        }
        self.facts.push(condition);
        match &condition.kind {
            ExprKind::Binary(Operator::And, a, b) => {
                self.learn(a);
                self.learn(b);
            }
            ExprKind::Define(define) => self.learn(&self.automaton.defines[*define].value),
            _ => {}
        }
    }

    /// Whether there is a step left, which is taken.
    fn steps(&self) -> bool {
        let left = self.left.get();
        self.left.set(left.saturating_sub(1));
        left > 0
    }

    /// Never says so of what may not hold.
    pub fn imply(&self, wanted: &Expr) -> bool {
        if !self.steps() {
            return false;
        }
        if self.facts.contains(&wanted) {
            return true;
        }
        match &wanted.kind {
            ExprKind::Constant(Value::Bool(holds)) => *holds,
            ExprKind::Binary(Operator::And, a, b) => self.imply(a) && self.imply(b),
            ExprKind::Binary(Operator::Or, a, b) => self.imply(a) || self.imply(b),
            ExprKind::Define(define) => self.imply(&self.automaton.defines[*define].value),
            ExprKind::After(time) => {
                let least = constant(time);
                self.facts.iter().any(|fact| match &fact.kind {
                    ExprKind::After(time) => least.is_some() && constant(time) >= least,
                    _ => false,
                })
            }
            _ => false,
        }
    }
}

/// A time that stands in the text, ms.
pub fn constant(time: &Expr) -> Option<i32> {
    match time.kind {
        ExprKind::Constant(Value::Int(ms)) => Some(ms),
        _ => None,
    }
}
