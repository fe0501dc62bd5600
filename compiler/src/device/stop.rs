//! The value that an output has while the system does not run.

use super::check::Checker;
use super::type_text;
use crate::spec::ast::{self, ExprKind};
use runtime_sim::device::{Extent, PortType, Stop};
use std::ops::RangeInclusive;

impl Checker<'_> {
    /// One that does not fit its output is reported.
    pub(super) fn stop(&mut self, port: &ast::Port, ty: PortType) -> Stop {
        let Some(expr) = &port.stop else { return Stop::Hold };
        if matches!(expr.kind, ExprKind::Error) {
            return Stop::Hold;
        }
        if let Some(value) = value(ty, expr) {
            return Stop::Value(value);
        }
        let name = &port.name.value;
        let message = format!("`{name}` is {}: this cannot be its stop value", type_text(ty, Extent::One));
        let help = match ty {
            PortType::Bool => "write `stop false` or `stop true`".into(),
            PortType::Int { lo, hi } => format!("write a whole number from {lo} to {hi}, or wider bounds"),
            PortType::Real => {
                "write a number, such as `stop 0.0` or `stop -1.5`: 0, or one between 1e-37 and 1e38 in size"
                    .into()
            }
            PortType::Point => "remove `stop`: a point keeps its last value".into(),
        };
        self.report("E0712", expr.span, message, help);
        Stop::Hold
    }

    pub(super) fn no_stop(&mut self, port: &ast::Port) {
        if let Some(expr) = &port.stop {
            let message = format!("`{}` is an input: it has no stop value", port.name.value);
            self.report("E0712", expr.span, message, "remove `stop` and the value behind it");
        }
    }
}

/// Of reals, as old tools for Structured Text read them.
const SIZES: RangeInclusive<f64> = 1e-37..=1e38;

fn value(ty: PortType, expr: &ast::Expr) -> Option<f64> {
    match (ty, &expr.kind) {
        (PortType::Bool, ExprKind::Bool(truth)) => Some(f64::from(u8::from(*truth))),
        (PortType::Int { lo, hi }, _) => whole(expr)
            .filter(|value| (i64::from(lo)..=i64::from(hi)).contains(value))
            .map(|value| value as f64),
        (PortType::Real, _) => number(expr).filter(|value| *value == 0.0 || SIZES.contains(&value.abs())),
        _ => None,
    }
}

fn whole(expr: &ast::Expr) -> Option<i64> {
    match &expr.kind {
        ExprKind::Int(value) => Some(*value),
        ExprKind::Negate(inner) => whole(inner).map(|value| -value),
        _ => None,
    }
}

fn number(expr: &ast::Expr) -> Option<f64> {
    match &expr.kind {
        ExprKind::Int(value) => Some(*value as f64),
        ExprKind::Real(value) => Some(*value),
        ExprKind::Negate(inner) => number(inner).map(|value| -value),
        _ => None,
    }
}
