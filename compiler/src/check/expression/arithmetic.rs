//! Operators: their types, and the bounds of what they compute.

mod times;

use super::{binary, constant, to_real, unit_help};
use crate::check::context::Context;
use crate::check::facts::{self, Interval};
use crate::diagnostic::Diagnostic;
use crate::ir::{Expr, ExprKind, Scalar, Value};
use crate::source::Span;
use crate::spec::ast::{self, Operator};
use crate::spec::written;

impl Context<'_, '_> {
    pub(super) fn negate(&mut self, tree: &ast::Expr, expected: Option<Scalar>, span: Span) -> Option<Expr> {
        let inner = self.expr(tree, expected)?;
        match (&inner.kind, inner.ty) {
            (ExprKind::Constant(Value::Int(v)), Scalar::Int { .. }) => {
                Some(constant(Scalar::Int { lo: -v, hi: -v }, Value::Int(-v)))
            }
            (ExprKind::Constant(Value::Real(v)), _) => Some(constant(Scalar::Real, Value::Real(-v))),
            (_, Scalar::Int { lo, hi }) => {
                let ty = self.fitting(-i64::from(hi), -i64::from(lo), span)?;
                Some(Expr { ty, kind: ExprKind::Negate(Box::new(inner)) })
            }
            (_, Scalar::Real) => Some(Expr { ty: Scalar::Real, kind: ExprKind::Negate(Box::new(inner)) }),
            (_, other) => {
                let name = self.checker.type_name(other);
                self.report(
                    Diagnostic::new("E0315", span, format!("a value of type {name} cannot be negated"))
                        .help("`-` before a value is for numbers"),
                );
                None
            }
        }
    }

    /// The type of whole numbers in an interval, which must fit into 32 bits.
    pub(super) fn fitting(&mut self, lo: i64, hi: i64, span: Span) -> Option<Scalar> {
        match (i32::try_from(lo), i32::try_from(hi)) {
            (Ok(lo), Ok(hi)) => Some(Scalar::Int { lo, hi }),
            _ => {
                self.report(
                    Diagnostic::new("E0316", span, "this whole number is not proved to fit into 32 bits")
                        .label(format!("its derived bounds are {lo}..{hi}"))
                        .help("declare the variables with narrower bounds"),
                );
                None
            }
        }
    }

    pub(super) fn binary(
        &mut self,
        operator: Operator,
        left: &ast::Expr,
        right: &ast::Expr,
        expected: Option<Scalar>,
        span: Span,
    ) -> Option<Expr> {
        match operator {
            Operator::And | Operator::Or => self.logical(operator, left, right),
            Operator::Equal
            | Operator::NotEqual
            | Operator::Less
            | Operator::LessEqual
            | Operator::Greater
            | Operator::GreaterEqual => self.comparison(operator, left, right, span),
            _ => self.arithmetic(operator, left, right, expected, span),
        }
    }

    fn logical(&mut self, operator: Operator, left: &ast::Expr, right: &ast::Expr) -> Option<Expr> {
        let left = self.typed(left, Scalar::Bool);
        let before = self.facts.clone();
        if let Some(left) = &left {
            self.facts.learn(left, operator == Operator::And);
        }
        let right = self.typed(right, Scalar::Bool);
        self.facts = before;
        Some(binary(operator, Scalar::Bool, left?, right?))
    }

    /// Both operands in one type: whole numbers become reals, members of enumerations are found by the other side.
    pub(super) fn pair(
        &mut self,
        left: &ast::Expr,
        right: &ast::Expr,
        expected: Option<Scalar>,
    ) -> Option<(Expr, Expr)> {
        let is_bare = |tree: &ast::Expr| matches!(tree.kind, ast::ExprKind::Name(_));
        let (a, b) = if is_bare(left) && !is_bare(right) {
            let b = self.expr(right, expected)?;
            (self.expr(left, Some(b.ty))?, b)
        } else {
            let a = self.expr(left, expected)?;
            let b = self.expr(right, Some(a.ty))?;
            (a, b)
        };
        Some(match (a.ty, b.ty) {
            (Scalar::Int { .. }, Scalar::Real) => (to_real(a), b),
            (Scalar::Real, Scalar::Int { .. }) => (a, to_real(b)),
            _ => (a, b),
        })
    }

    fn comparison(
        &mut self,
        operator: Operator,
        left: &ast::Expr,
        right: &ast::Expr,
        span: Span,
    ) -> Option<Expr> {
        let (a, b) = self.pair(left, right, None)?;
        let is_equality = matches!(operator, Operator::Equal | Operator::NotEqual);
        let fits = match (a.ty, b.ty) {
            (Scalar::Int { .. }, Scalar::Int { .. })
            | (Scalar::Real, Scalar::Real)
            | (Scalar::Time, Scalar::Time) => true,
            (Scalar::Bool, Scalar::Bool) => is_equality,
            (Scalar::Enum(x), Scalar::Enum(y)) => is_equality && x == y,
            (Scalar::Ref(x), Scalar::Ref(y)) => is_equality && x == y,
            (Scalar::Point, Scalar::Point) => {
                self.report(
                    Diagnostic::new("E0317", span, "points cannot be compared")
                        .help("the device says whether the machine is in position: use `done`"),
                );
                return None;
            }
            _ => false,
        };
        if !fits {
            let help = match (a.ty, b.ty) {
                (Scalar::Time, Scalar::Int { .. } | Scalar::Real) => unit_help(right),
                (Scalar::Int { .. } | Scalar::Real, Scalar::Time) => unit_help(left),
                (Scalar::Bool, Scalar::Int { .. }) | (Scalar::Int { .. }, Scalar::Bool) => {
                    "a `bool` is `true` or `false` and stands alone: `when sensor`, `when not sensor`".into()
                }
                _ => "`<` and `>` are for two numbers or two times; values of one other type can be compared with `=` and `<>`".into(),
            };
            let (left, right) = (self.checker.type_name(a.ty), self.checker.type_name(b.ty));
            self.report(
                Diagnostic::new("E0315", span, format!("this comparison does not take {left} and {right}"))
                    .help(help),
            );
            return None;
        }
        self.remark_decided(operator, &a, &b, span);
        Some(binary(operator, Scalar::Bool, a, b))
    }

    fn arithmetic(
        &mut self,
        operator: Operator,
        left: &ast::Expr,
        right: &ast::Expr,
        expected: Option<Scalar>,
        span: Span,
    ) -> Option<Expr> {
        let hint = if expected == Some(Scalar::Real) { expected } else { None };
        let (a, b) = self.pair(left, right, hint)?;
        match (a.ty, b.ty, operator) {
            (Scalar::Int { .. }, Scalar::Int { .. }, _) => {
                self.whole_arithmetic(operator, a, b, right.span, span)
            }
            (Scalar::Real, Scalar::Real, Operator::Add | Operator::Subtract | Operator::Multiply) => {
                Some(binary(operator, Scalar::Real, a, b))
            }
            (Scalar::Real, Scalar::Real, Operator::Divide) => {
                self.prove_divisor(&b, right.span)?;
                Some(binary(operator, Scalar::Real, a, b))
            }
            (Scalar::Point, Scalar::Point, Operator::Add | Operator::Subtract) => {
                Some(binary(operator, Scalar::Point, a, b))
            }
            (Scalar::Time, Scalar::Int { .. }, Operator::Multiply) => {
                self.time_product((a, left.span), (b, right.span), span)
            }
            (Scalar::Int { .. }, Scalar::Time, Operator::Multiply) => {
                self.time_product((b, right.span), (a, left.span), span)
            }
            (Scalar::Time, Scalar::Time, Operator::Add) => {
                self.time_sum((a, left.span), (b, right.span), span)
            }
            (a, b, _) => {
                let help = match (a, b, operator) {
                    (Scalar::Time, Scalar::Int { .. } | Scalar::Real, Operator::Add) => unit_help(right),
                    (Scalar::Int { .. } | Scalar::Real, Scalar::Time, Operator::Add) => unit_help(left),
                    _ => "`+ - * /` are for numbers, `+ -` for points; a time can be added to a time or multiplied by a whole number".into(),
                };
                let (left, right) = (self.checker.type_name(a), self.checker.type_name(b));
                self.report(
                    Diagnostic::new("E0315", span, format!("this operator does not take {left} and {right}"))
                        .help(help),
                );
                None
            }
        }
    }

    fn prove_divisor(&mut self, divisor: &Expr, span: Span) -> Option<()> {
        if self.facts.differs_from_zero(divisor) {
            return Some(());
        }
        let text = written::on_one_line(self.checker.sources.text(span));
        let is_long = text.len() > LONGEST_IN_HELP;
        let help = match (&divisor.kind, facts::key(divisor)) {
            (ExprKind::Constant(_), _) => "divide by another number".to_string(),
            (ExprKind::Read(_), Some(_)) if matches!(divisor.ty, Scalar::Int { .. }) => {
                format!("compare it in the guard of this transition, such as `{text} > 0` or `{text} <> 0`, or declare bounds without 0")
            }
            (_, Some(_)) if !is_long => {
                format!("compare it as it stands here in the guard of this transition, such as `{text} > 0` or `{text} <> 0`")
            }
            _ => "name it with `define`, divide by the name, and compare the name in the guard of this transition, such as `name > 0`".to_string(),
        };
        let found = Diagnostic::new("E0318", span, "this divisor is not proved to differ from 0");
        let found = match &divisor.kind {
            ExprKind::Binary(Operator::Multiply | Operator::Divide, ..) if divisor.ty == Scalar::Real => {
                found.note("it may be 0 if its operands are not: a number that is too small is rounded to 0")
            }
            _ => found,
        };
        self.report(found.help(help));
        None
    }

    fn whole_arithmetic(
        &mut self,
        operator: Operator,
        a: Expr,
        b: Expr,
        divisor: Span,
        span: Span,
    ) -> Option<Expr> {
        let (x, y) = (self.facts.of(&a), self.facts.of(&b));
        if matches!(operator, Operator::Divide | Operator::Modulo) {
            self.prove_divisor(&b, divisor)?;
        }
        // Not every machine finds the remainder of a quotient that does not fit.
        if operator == Operator::Modulo && x.holds(f64::from(i32::MIN)) && y.holds(-1.0) {
            self.report(
                Diagnostic::new(
                    "E0316",
                    span,
                    "the quotient of this remainder is not proved to fit into 32 bits",
                )
                .label("the left side may be -2147483648, and the right side -1")
                .help("declare the variables with narrower bounds"),
            );
            return None;
        }
        let result = whole(operator, x, y);
        let ty = self.fitting(result.lo as i64, result.hi as i64, span)?;
        Some(binary(operator, ty, a, b))
    }
}

/// The bounds of what an operator makes of two whole numbers; of a divisor that is not 0.
pub(in crate::check) fn whole(operator: Operator, x: Interval, y: Interval) -> Interval {
    let corners = |f: fn(f64, f64) -> f64| {
        let all = [f(x.lo, y.lo), f(x.lo, y.hi), f(x.hi, y.lo), f(x.hi, y.hi)];
        all.iter().fold(Interval::new(f64::INFINITY, f64::NEG_INFINITY), |i, v| {
            Interval::new(i.lo.min(*v), i.hi.max(*v))
        })
    };
    match operator {
        Operator::Add => corners(|a, b| a + b),
        Operator::Subtract => corners(|a, b| a - b),
        Operator::Multiply => corners(|a, b| a * b),
        Operator::Divide => quotient(x, y),
        _ => remainder(x, y),
    }
}

/// A longer expression is not repeated in what helps.
const LONGEST_IN_HELP: usize = 60;

/// The bounds of a quotient, which is rounded towards 0. The divisor is not 0, but its bounds may be on both sides of it.
fn quotient(x: Interval, y: Interval) -> Interval {
    let beside_zero = [-1.0, 1.0].into_iter().filter(|divisor| y.holds(*divisor));
    let divisors = [y.lo, y.hi].into_iter().chain(beside_zero).filter(|divisor| *divisor != 0.0);
    let corners = divisors.flat_map(|divisor| [x.lo / divisor, x.hi / divisor]).map(f64::trunc);
    corners
        .fold(Interval::new(f64::INFINITY, f64::NEG_INFINITY), |i, v| Interval::new(i.lo.min(v), i.hi.max(v)))
}

/// The bounds of a remainder: it has the sign of the dividend and is not greater, and it is less than the divisor.
fn remainder(x: Interval, y: Interval) -> Interval {
    let most = y.lo.abs().max(y.hi.abs()) - 1.0;
    Interval::new(x.lo.clamp(-most, 0.0), x.hi.clamp(0.0, most))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All whole numbers of an interval.
    fn of(interval: Interval) -> std::ops::RangeInclusive<i32> {
        interval.lo as i32..=interval.hi as i32
    }

    /// Neither too wide nor too narrow a bound: each is met.
    #[test]
    fn bounds_of_quotients_are_those_of_all_operands() {
        let intervals =
            || (-7..=7).flat_map(|lo| (lo..=7).map(move |hi| Interval::new(lo.into(), hi.into())));
        for x in intervals() {
            for y in intervals().filter(|y| *y != Interval::new(0.0, 0.0)) {
                let pairs = || of(x).flat_map(|a| of(y).filter(|b| *b != 0).map(move |b| (a, b)));
                let all: Vec<i32> = pairs().map(|(a, b)| a / b).collect();
                let found = quotient(x, y);
                assert_eq!(Some(&(found.lo as i32)), all.iter().min(), "{x:?} / {y:?}");
                assert_eq!(Some(&(found.hi as i32)), all.iter().max(), "{x:?} / {y:?}");
                let found = remainder(x, y);
                assert!(pairs().all(|(a, b)| found.holds((a % b).into())), "{x:?} mod {y:?}: {found:?}");
            }
        }
        let least = f64::from(i32::MIN);
        let all = Interval::new(least, 0.0);
        assert_eq!(quotient(all, Interval::new(2.0, 2.0)), Interval::new(-1_073_741_824.0, 0.0));
        assert_eq!(quotient(all, Interval::new(-1.0, -1.0)), Interval::new(0.0, -least));
        assert_eq!(remainder(all, Interval::new(7.0, 7.0)), Interval::new(-6.0, 0.0));
    }
}
