//! Sums and products of times, which are counted in milliseconds of 32 bits.

use super::LONGEST_IN_HELP;
use crate::check::context::Context;
use crate::check::expression::binary;
use crate::diagnostic::Diagnostic;
use crate::ir::{self, Expr, ExprKind, Place, Scalar, Value};
use crate::source::Span;
use crate::spec::written;

/// The bound that is proposed for a time, ms.
const HOUR_MS: f64 = 3_600_000.0;

impl Context<'_, '_> {
    pub(super) fn time_sum(&mut self, a: (Expr, Span), b: (Expr, Span), span: Span) -> Option<Expr> {
        let (x, y) = (self.facts.of(&a.0).hi, self.facts.of(&b.0).hi);
        if x + y > f64::from(i32::MAX) {
            let is_short = |most_ms: f64| most_ms <= f64::from(i32::MAX) - HOUR_MS;
            let mut advice = Vec::new();
            for (operand, most_ms) in [(&a, x), (&b, y)] {
                if !is_short(most_ms) {
                    advice.extend(self.bounded(operand));
                }
            }
            // Two long times of which each would have room beside an hour.
            if advice.is_empty() {
                advice = self.bounded(if x > y { &a } else { &b });
            }
            advice.dedup();
            return self.too_long(x + y, &advice, span);
        }
        Some(binary(ir::Operator::Add, Scalar::Time, a.0, b.0))
    }

    pub(super) fn time_product(
        &mut self,
        time: (Expr, Span),
        factor: (Expr, Span),
        span: Span,
    ) -> Option<Expr> {
        if let Scalar::Int { lo, .. } = factor.0.ty
            && lo < 0
        {
            let text = self.short(factor.1);
            let found = Diagnostic::new("E0316", span, "this time could be negative").help(match text {
                Some(text) => {
                    format!("write `max({text}, 0)`, or declare the variable with bounds from 0 on")
                }
                None => "multiply by a number that is 0 or more".into(),
            });
            self.report(found);
            return None;
        }
        let (x, y) = (self.facts.of(&time.0).hi, self.facts.of(&factor.0).hi);
        if x * y > f64::from(i32::MAX) {
            let mut advice = Vec::new();
            let bounded_ms = if x > HOUR_MS { HOUR_MS } else { x };
            if x > HOUR_MS {
                advice.extend(self.bounded(&time));
            }
            let most = (f64::from(i32::MAX) / bounded_ms).floor();
            if y > most {
                advice.push(match self.short(factor.1) {
                    Some(text) if !is_constant(&factor.0) => format!("write `min({text}, {most})`"),
                    _ => format!("multiply by {most} at most"),
                });
            }
            return self.too_long(x * y, &advice, span);
        }
        Some(binary(ir::Operator::Multiply, Scalar::Time, time.0, factor.0))
    }

    /// `advice` is complete if all of it is followed.
    fn too_long(&mut self, most_ms: f64, advice: &[String], span: Span) -> Option<Expr> {
        let label = match most_ms < f64::from(i32::MAX) * 2.0 {
            true => "one of the two may have the greatest value of a time",
            false => "its derived bounds allow a longer time",
        };
        let found = Diagnostic::new(
            "E0316",
            span,
            "this time is not proved to stay below 2147483648 ms, about 24 days",
        );
        self.report(found.label(label).help(advice.join(", and ")));
        None
    }

    /// How an operand is bounded to an hour: each parameter in it by a requirement if nothing else is without a bound.
    fn bounded(&self, (operand, span): &(Expr, Span)) -> Vec<String> {
        if is_constant(operand) {
            return vec!["write a shorter time".into()];
        }
        let mut parameters = Vec::new();
        if self.are_parameters(operand, &mut parameters) {
            let bound = |name: &String| {
                format!("bound the parameter: `require {name} <= 60 min else \"{name} is over an hour\";`")
            };
            return parameters.iter().map(bound).collect();
        }
        let text = self.short(*span);
        vec![match text {
            Some(text) if matches!(operand.kind, ExprKind::Read(_)) => {
                format!("write `min({text}, 60 min)`, or compare it in the guard, such as `{text} <= 60 min`")
            }
            Some(text) => format!("write `min({text}, 60 min)`"),
            None => "name it with `define`, and write `min(name, 60 min)`".into(),
        }]
    }

    /// Whether all that has no bound in a time are parameters with one value, and which these are.
    fn are_parameters(&self, expr: &Expr, found: &mut Vec<String>) -> bool {
        if expr.ty != Scalar::Time || self.facts.of(expr).hi <= HOUR_MS {
            return true;
        }
        match &expr.kind {
            ExprKind::Read(Place::Parameter { parameter, index: None }) => {
                let name = &self.automaton.parameters[*parameter].name;
                if !found.contains(name) {
                    found.push(name.clone());
                }
                true
            }
            ExprKind::Min(a, b) | ExprKind::Max(a, b) => {
                self.are_parameters(a, found) && self.are_parameters(b, found)
            }
            _ => false,
        }
    }

    /// A text that can be repeated in what helps.
    fn short(&self, span: Span) -> Option<String> {
        let text = written::on_one_line(self.checker.sources.text(span));
        (text.len() <= LONGEST_IN_HELP).then_some(text)
    }
}

fn is_constant(expr: &Expr) -> bool {
    matches!(expr.kind, ExprKind::Constant(Value::Int(_)))
}
