//! Rules of writing: what a write of a shared cell may do, as far as it can be decided.

use super::context::Context;
use super::facts::Interval;
use crate::diagnostic::Diagnostic;
use crate::ir::{self, Expr, ExprKind, Place, Rule, Value};
use crate::source::Span;
use crate::spec::ast::{Assign, Side};

impl Context<'_, '_> {
    /// `None` has been reported.
    pub(super) fn check_rule(&mut self, place: &Place, how: Assign, value: &Expr, span: Span) -> Option<()> {
        let Place::Cell { interface, cell, of, .. } = place else { return Some(()) };
        let rule = self.checker.model.interfaces[interface.0].cells[*cell].rule.clone();
        let side = if of.is_none() { Side::Owner } else { Side::Others };
        let name = self.checker.model.interfaces[interface.0].cells[*cell].name.clone();
        let wrong = |message: String, help: &str| Some(Diagnostic::new("E0333", span, message).help(help));
        let constant = match &value.kind {
            ExprKind::Constant(Value::Bool(b)) => Some(*b),
            _ => None,
        };
        let known = self.known(place);
        let diagnostic = match (&rule, side) {
            (Rule::Owner, Side::Others) => wrong(
                format!("only its owner may write `{name}`"),
                "ask the owner through a cell that others may set, or change the rule of the cell with `by ...`",
            ),
            (Rule::Handshake, Side::Others) if constant != Some(true) => {
                wrong(format!("others may only set `{name}` to true"), "write `:= true`; the owner resets it")
            }
            (Rule::Handshake, Side::Owner) if constant != Some(false) => wrong(
                format!("the owner may only reset `{name}` to false"),
                "write `:= false`; others set it",
            ),
            (Rule::Lock, _) => match constant {
                Some(true) if known.holds(1.0) => wrong(
                    format!("another machine may hold the lock `{name}` here"),
                    "a lock can be taken only when it is free: add `not` of it to the guard of this transition",
                ),
                None => wrong(
                    format!("the lock `{name}` is written with `true` or `false` only"),
                    "write `:= true` or `:= false`",
                ),
                _ => None,
            },
            (Rule::Counter, Side::Others) if how == Assign::Set => wrong(
                format!("`{name}` is a counter"),
                "others count with `+=` and `-=`; the owner may set it",
            ),
            (Rule::Token(sides), _) => self.token_holder(sides, known, side, &name, span, place),
            (Rule::With(token), _) => {
                let token = *token;
                let mut of_token = place.clone();
                if let Place::Cell { cell, .. } = &mut of_token {
                    *cell = token;
                }
                let known = self.known(&of_token);
                match self.checker.model.interfaces[interface.0].cells[token].rule.clone() {
                    Rule::Token(sides) => self.token_holder(&sides, known, side, &name, span, &of_token),
                    _ => None,
                }
            }
            _ => None,
        };
        match diagnostic {
            Some(diagnostic) => {
                self.report(diagnostic);
                None
            }
            None => Some(()),
        }
    }

    /// What the guard and the updates so far say of a cell's value before this write.
    fn known(&self, place: &Place) -> Interval {
        let Place::Cell { interface, cell, .. } = place else { return Interval::ALL };
        let ty = self.checker.model.interfaces[interface.0].cells[*cell].ty.scalar;
        self.facts.of(&Expr { ty, kind: ExprKind::Read(place.clone()) })
    }

    fn token_holder(
        &self,
        sides: &[Side],
        known: Interval,
        side: Side,
        name: &str,
        span: Span,
        place: &Place,
    ) -> Option<Diagnostic> {
        let possible: Vec<usize> = (0..sides.len()).filter(|v| known.holds(*v as f64)).collect();
        // Without any value nothing is written: the guard never holds, of which a warning tells.
        let first = *possible.first()?;
        if possible.iter().any(|v| sides[*v] == side) {
            return None;
        }
        let Place::Cell { interface, cell, .. } = place else { return None };
        let ir::Scalar::Enum(id) = self.checker.model.interfaces[interface.0].cells[*cell].ty.scalar else {
            return None;
        };
        let value = &self.checker.model.enums[id.0].members[first];
        let who = if side == Side::Owner { "only others may write" } else { "only the owner may write" };
        Some(Diagnostic::new("E0333", span, format!("while the token is `{value}`, {who} `{name}`")).help(
            "wait in the guard for a value that gives the right to write, or change the rule of the token",
        ))
    }
}
