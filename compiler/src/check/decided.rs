//! What the bounds of values decide whatever the machine does: comparisons, ranges without a number, and values that never
//! fit. All of it is hardly meant.

use super::context::Context;
use super::expression::arithmetic::whole;
use super::facts::{self, Interval};
use crate::diagnostic::{Diagnostic, MOST};
use crate::ir::{Domain, Expr, ExprKind, KIND, Operator, Place, Scalar};
use crate::source::Span;
use crate::spec::written;

/// What the declarations say of a definition.
pub(super) struct Defined {
    /// The text alone gives its value.
    is_fixed: bool,
    bounds: Option<Interval>,
}

impl Context<'_, '_> {
    /// Definitions read those before them: each is looked at once.
    pub(super) fn defined_as(&self, value: &Expr) -> Defined {
        Defined { is_fixed: self.is_fixed(value), bounds: self.declared(value) }
    }

    fn remark(&mut self, remark: Diagnostic) {
        let remarks = &mut self.checker.remarks;
        // A transition of `any state` is checked for each state.
        if remarks.len() < MOST && !remarks.contains(&remark) {
            remarks.push(remark);
        }
    }

    /// Parameters differ by machine, and requirements by type: only declared bounds count.
    pub(super) fn remark_decided(&mut self, operator: Operator, a: &Expr, b: &Expr, span: Span) {
        if self.is_fixed(a) && self.is_fixed(b) {
            return;
        }
        let Some((x, y)) = self.declared(a).zip(self.declared(b)) else { return };
        let Some(holds) = decided(operator, x, y) else { return };
        let text = written::on_one_line(self.checker.sources.text(span));
        let message = format!("`{text}` {} holds", if holds { "always" } else { "never" });
        self.remark(
            Diagnostic::new("W0112", span, message)
                .note(format!("the left side is {}, the right side {}", shown(x), shown(y)))
                .help("compare with a value within these bounds, or declare wider ones; without need of the comparison, remove it"),
        );
    }

    pub(super) fn remark_empty(&mut self, low: &Expr, high: &Expr, span: Span) {
        let Some((x, y)) = self.declared(low).zip(self.declared(high)) else { return };
        if x.lo > y.hi {
            let text = written::on_one_line(self.checker.sources.text(span));
            self.remark(
                Diagnostic::new("W0112", span, format!("no number is in `{text}`"))
                    .note(
                        "`exists` is false, `forall` is true, and a transition that chooses one never fires",
                    )
                    .help("write the lower end first"),
            );
        }
    }

    /// A value that is stored where none of those that it can have fits.
    pub(super) fn remark_misfit(&mut self, name: &str, value: Interval, bounds: Interval, span: Span) {
        let is_possible = value.lo <= value.hi;
        if is_possible && (value.hi < bounds.lo || value.lo > bounds.hi) {
            let message =
                format!("`{name}` would always leave {}: the value is {}", shown(bounds), shown(value));
            self.remark(
                Diagnostic::new("W0115", span, message)
                    .note("this update is a fault whenever it is executed")
                    .help("write a value within the bounds, or declare wider ones"),
            );
        }
    }

    /// Whether the text alone gives the value, as a constant or by a definition.
    fn is_fixed(&self, expr: &Expr) -> bool {
        match &expr.kind {
            ExprKind::Constant(_) => true,
            ExprKind::Define(define) => self.defined[*define].is_fixed,
            ExprKind::Negate(_)
            | ExprKind::Absolute(_)
            | ExprKind::Min(..)
            | ExprKind::Max(..)
            | ExprKind::Binary(..) => expr.parts().all(|part| self.is_fixed(part)),
            _ => false,
        }
    }

    /// The bounds of a whole number or a time by the declarations of what it reads.
    fn declared(&self, expr: &Expr) -> Option<Interval> {
        if !matches!(expr.ty, Scalar::Int { .. } | Scalar::Time) {
            return None;
        }
        let of = |a: &Expr, b: &Expr| self.declared(a).zip(self.declared(b));
        Some(match &expr.kind {
            ExprKind::Constant(_) => facts::Facts::default().of(expr),
            ExprKind::Read(place) => facts::of_type(self.declared_type(place)),
            ExprKind::Variable(id) => facts::of_type(self.automaton.variables[id.0].ty.scalar),
            ExprKind::Define(define) => self.defined[*define].bounds?,
            ExprKind::Negate(inner) => {
                let inner = self.declared(inner)?;
                Interval::new(-inner.hi, -inner.lo)
            }
            ExprKind::Min(a, b) => {
                let (a, b) = of(a, b)?;
                Interval::new(a.lo.min(b.lo), a.hi.min(b.hi))
            }
            ExprKind::Max(a, b) => {
                let (a, b) = of(a, b)?;
                Interval::new(a.lo.max(b.lo), a.hi.max(b.hi))
            }
            ExprKind::Binary(operator @ (Operator::Divide | Operator::Modulo), a, b) => {
                let (a, b) = of(a, b)?;
                if b == Interval::new(0.0, 0.0) {
                    return None;
                }
                whole(*operator, a, b)
            }
            ExprKind::Binary(operator, a, b) => {
                let (a, b) = of(a, b)?;
                whole(*operator, a, b)
            }
            // Another scenario may have more kinds.
            ExprKind::Count { domain, .. } if !matches!(**domain, Domain::Enum(id) if id == KIND) => {
                facts::of_type(expr.ty)
            }
            ExprKind::Members(_) => facts::of_type(expr.ty),
            _ => return None,
        })
    }

    fn declared_type(&self, place: &Place) -> Scalar {
        match place {
            Place::Local { local, .. } => self.automaton.locals[*local].ty.scalar,
            Place::Port { port, .. } => self.port_type(*port).scalar,
            Place::Parameter { parameter, .. } => self.automaton.parameters[*parameter].ty.scalar,
            Place::Cell { interface, cell, .. } => {
                self.checker.model.interfaces[interface.0].cells[*cell].ty.scalar
            }
            Place::Shown { interface, parameter, .. } => {
                self.checker.model.interfaces[interface.0].parameters[*parameter].ty.scalar
            }
        }
    }
}

/// Whether a comparison of any values within these bounds holds; none if it depends on them.
fn decided(operator: Operator, x: Interval, y: Interval) -> Option<bool> {
    let is_less = match () {
        () if x.hi < y.lo => Some(true),
        () if x.lo >= y.hi => Some(false),
        () => None,
    };
    let is_greater = match () {
        () if x.lo > y.hi => Some(true),
        () if x.hi <= y.lo => Some(false),
        () => None,
    };
    let is_equal = match () {
        () if x.hi < y.lo || x.lo > y.hi => Some(false),
        () if x.lo == x.hi && x == y => Some(true),
        () => None,
    };
    let not = |holds: Option<bool>| holds.map(|holds| !holds);
    match operator {
        Operator::Less => is_less,
        Operator::GreaterEqual => not(is_less),
        Operator::Greater => is_greater,
        Operator::LessEqual => not(is_greater),
        Operator::Equal => is_equal,
        Operator::NotEqual => not(is_equal),
        _ => None,
    }
}

fn shown(bounds: Interval) -> String {
    match bounds.lo == bounds.hi {
        true => bounds.lo.to_string(),
        false => format!("{}..{}", bounds.lo, bounds.hi),
    }
}
