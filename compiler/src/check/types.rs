//! Types and constants of declarations.

use super::Checker;
use super::names::Space;
use crate::diagnostic::{Diagnostic, suggestion};
use crate::ir::{self, Extent, Scalar, Value};
use crate::spec::ast::{self, ExprKind};

/// Largest number of elements of an array.
const LARGEST_ARRAY: i64 = 1024;

/// Whether a value may be computed if it cannot be a constant.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Computed {
    Never,
    /// In the updates of `initial ->`, which may write it.
    AtTheBeginning,
}

impl Checker<'_> {
    /// `None` has been reported.
    pub(super) fn resolve_type(&mut self, tree: &ast::Type) -> Option<ir::Type> {
        let scalar = match &tree.scalar {
            ast::Scalar::Bool => Scalar::Bool,
            ast::Scalar::Real => Scalar::Real,
            ast::Scalar::Time => Scalar::Time,
            ast::Scalar::Point => Scalar::Point,
            ast::Scalar::Int { lo, hi } => {
                let (low, high) = (self.whole_constant(lo)?, self.whole_constant(hi)?);
                if low > high {
                    self.report(
                        Diagnostic::new(
                            "E0305",
                            tree.span,
                            format!("no number is within the bounds {low}..{high}"),
                        )
                        .help("write the lower bound first"),
                    );
                    return None;
                }
                Scalar::Int { lo: low, hi: high }
            }
            ast::Scalar::Named(name) => self.named_scalar(name)?,
        };
        let extent = match &tree.extent {
            None => Extent::One,
            Some(expr) => self.extent(expr)?,
        };
        Some(ir::Type { scalar, extent })
    }

    fn named_scalar(&mut self, name: &ast::Name) -> Option<Scalar> {
        self.uses(name.span, Space::Types, "", &name.value);
        if let Some(id) = self.enum_named(&name.value) {
            return Some(Scalar::Enum(id));
        }
        if let Some(id) = self.interface_named(&name.value) {
            return Some(Scalar::Ref(id));
        }
        let known: Vec<String> = self.type_names();
        let help = suggestion(&name.value, known.iter().map(String::as_str)).map_or(
            "types are bool, int lo..hi, real, time, point, enumerations and interfaces".into(),
            |n| format!("is `{n}` meant?"),
        );
        self.report(
            Diagnostic::new("E0306", name.span, format!("there is no type `{}`", name.value)).help(help),
        );
        None
    }

    fn type_names(&self) -> Vec<String> {
        let plain = ["bool", "int", "real", "time", "point"].map(String::from);
        let enums = self.model.enums.iter().map(|e| e.name.clone());
        plain.into_iter().chain(enums).chain(self.model.interfaces.iter().map(|i| i.name.clone())).collect()
    }

    pub(super) fn enum_named(&self, name: &str) -> Option<ir::EnumId> {
        self.model.enums.iter().position(|e| e.name == name).map(ir::EnumId)
    }

    pub(super) fn interface_named(&self, name: &str) -> Option<ir::InterfaceId> {
        self.model.interfaces.iter().position(|i| i.name == name).map(ir::InterfaceId)
    }

    pub(super) fn interface_or_report(&mut self, name: &ast::Name) -> Option<ir::InterfaceId> {
        let found = self.interface_named(&name.value);
        self.uses(name.span, Space::Types, "", &name.value);
        if found.is_none() {
            let known: Vec<String> = self.model.interfaces.iter().map(|i| i.name.clone()).collect();
            let help = suggestion(&name.value, known.iter().map(String::as_str))
                .map_or("declare an `interface` of this name".into(), |n| format!("is `{n}` meant?"));
            self.report(
                Diagnostic::new("E0306", name.span, format!("there is no interface `{}`", name.value))
                    .help(help),
            );
        }
        found
    }

    fn extent(&mut self, expr: &ast::Expr) -> Option<Extent> {
        if let ExprKind::Name(name) = &expr.kind {
            if let Some(id) = self.enum_named(name) {
                self.uses(expr.span, Space::Types, "", name);
                return Some(Extent::By(id));
            }
            self.report(
                Diagnostic::new("E0305", expr.span, format!("`{name}` cannot be the size of an array"))
                    .help("write a whole number, or the name of an enumeration"),
            );
            return None;
        }
        let size = i64::from(self.whole_constant(expr)?);
        if !(1..=LARGEST_ARRAY).contains(&size) {
            self.report(
                Diagnostic::new("E0305", expr.span, format!("an array cannot have {size} elements"))
                    .help(format!("write a number from 1 to {LARGEST_ARRAY}")),
            );
            return None;
        }
        Some(Extent::Count(size as usize))
    }

    fn whole_constant(&mut self, expr: &ast::Expr) -> Option<i32> {
        match &expr.kind {
            ExprKind::Int(value) => i32::try_from(*value).ok(),
            ExprKind::Negate(inner) => match inner.kind {
                ExprKind::Int(value) => i32::try_from(-value).ok(),
                _ => self.not_whole(expr),
            },
            ExprKind::Error => None,
            _ => self.not_whole(expr),
        }
    }

    fn not_whole(&mut self, expr: &ast::Expr) -> Option<i32> {
        self.report(
            Diagnostic::new("E0305", expr.span, "a whole number is expected here")
                .help("bounds and sizes are written as numbers, such as 12 or -1"),
        );
        None
    }

    /// Where a parameter with this default takes its value from.
    pub(super) fn parameter_source(
        &mut self,
        ty: ir::Type,
        default: Option<&ast::Expr>,
    ) -> Option<ir::ParameterSource> {
        let Some(expr) = default else { return Some(ir::ParameterSource::Layout(None)) };
        if !is_scenario_parts(expr) {
            let value = self.constant(ty.scalar, expr, Computed::Never);
            return value.map(|value| ir::ParameterSource::Layout(Some(value)));
        }
        if matches!(ty.scalar, Scalar::Int { .. }) && ty.extent == Extent::By(ir::KIND) {
            return Some(ir::ParameterSource::Scenario);
        }
        self.report(
            Diagnostic::new("E0305", expr.span, "`scenario.parts` is a whole number for each kind")
                .help("declare the parameter as `int 0..9999[Kind]`"),
        );
        None
    }

    /// What a variable of this type holds at first.
    pub(super) fn initial(&mut self, ty: ir::Type, expr: Option<&ast::Expr>) -> Option<Value> {
        match expr {
            Some(expr) => self.constant(ty.scalar, expr, Computed::AtTheBeginning),
            None => Some(match ty.scalar {
                Scalar::Bool => Value::Bool(false),
                Scalar::Int { lo, hi } => Value::Int(0.clamp(lo, hi)),
                Scalar::Time | Scalar::Enum(_) | Scalar::Ref(_) => Value::Int(0),
                Scalar::Real => Value::Real(0.0),
                Scalar::Point => Value::Point([0.0; 3]),
            }),
        }
    }

    /// A constant of a type, as declarations and defaults need it.
    pub(super) fn constant(&mut self, ty: Scalar, expr: &ast::Expr, computed: Computed) -> Option<Value> {
        let value = match (ty, &expr.kind) {
            (_, ExprKind::Error) => return None,
            (Scalar::Bool, ExprKind::Bool(b)) => Value::Bool(*b),
            (Scalar::Time, ExprKind::Duration(ms)) => Value::Int(*ms as i32),
            (Scalar::Real, _) if number(expr).is_some() => Value::Real(number(expr)?),
            (Scalar::Int { lo, hi }, ExprKind::Int(_) | ExprKind::Negate(_)) => {
                let value = self.whole_constant(expr)?;
                if value < lo || value > hi {
                    self.report(
                        Diagnostic::new("E0305", expr.span, format!("{value} is not in {lo}..{hi}"))
                            .help("choose a value within the bounds, or widen them"),
                    );
                    return None;
                }
                Value::Int(value)
            }
            (Scalar::Enum(id), ExprKind::Name(name)) => {
                let ir::Enum { name: of, members, .. } = &self.model.enums[id.0];
                match members.iter().position(|m| m == name) {
                    Some(ordinal) => {
                        let of = of.clone();
                        self.uses(expr.span, Space::OfType, &of, name);
                        Value::Int(ordinal as i32)
                    }
                    None if self.takes_for_kind(id) => return None,
                    None => return self.not_constant(ty, expr, computed),
                }
            }
            (Scalar::Point, ExprKind::Call(name, arguments))
                if name.value == "point" && arguments.len() == 3 =>
            {
                match (number(&arguments[0]), number(&arguments[1]), number(&arguments[2])) {
                    (Some(x), Some(y), Some(z)) => Value::Point([x, y, z]),
                    _ => return self.not_constant(ty, expr, computed),
                }
            }
            _ => return self.not_constant(ty, expr, computed),
        };
        Some(value)
    }

    fn not_constant(&mut self, ty: Scalar, expr: &ast::Expr, computed: Computed) -> Option<Value> {
        let name = self.type_name(ty);
        let mut help = self.constant_help(ty, expr);
        let is_literal = matches!(
            expr.kind,
            ExprKind::Bool(_)
                | ExprKind::Int(_)
                | ExprKind::Real(_)
                | ExprKind::Duration(_)
                | ExprKind::List(_)
        );
        if computed == Computed::AtTheBeginning && !is_literal {
            help += "; compute it in the updates of `initial ->`";
        }
        self.report(
            Diagnostic::new("E0305", expr.span, format!("this is not a constant of type {name}")).help(help),
        );
        None
    }

    /// How a constant of a type is written.
    fn constant_help(&self, ty: Scalar, expr: &ast::Expr) -> String {
        match (ty, &expr.kind) {
            (_, ExprKind::List(_)) => "write one value without brackets: all elements have it".into(),
            (Scalar::Time, ExprKind::Int(_) | ExprKind::Real(_)) => super::expression::unit_help(expr),
            (Scalar::Time, _) => "write a time, such as `3 s`".into(),
            (Scalar::Bool, _) => "write `true` or `false`".into(),
            (Scalar::Int { .. }, _) => "write a whole number".into(),
            (Scalar::Real, _) => "write a number, such as `0.5`".into(),
            (Scalar::Point, _) => "write three numbers, such as `point(0, 0.5, -1)`".into(),
            (Scalar::Enum(id), _) => {
                let ir::Enum { name, members, .. } = &self.model.enums[id.0];
                format!("write a member of `{name}`: {}", members.join(", "))
            }
            (Scalar::Ref(_), _) => "remove the value: a reference has no constants".into(),
        }
    }

    pub(super) fn type_with_size(&self, ty: ir::Type) -> String {
        let scalar = self.type_name(ty.scalar);
        match ty.extent {
            Extent::One => scalar,
            Extent::Count(size) => format!("{scalar}[{size}]"),
            Extent::By(id) => format!("{scalar}[{}]", self.model.enums[id.0].name),
        }
    }

    /// A type in the user's words.
    pub(super) fn type_name(&self, ty: Scalar) -> String {
        match ty {
            Scalar::Bool => "bool".into(),
            Scalar::Int { lo, hi } => format!("int {lo}..{hi}"),
            Scalar::Real => "real".into(),
            Scalar::Time => "time".into(),
            Scalar::Point => "point".into(),
            Scalar::Enum(id) => self.model.enums[id.0].name.clone(),
            Scalar::Ref(id) => self.model.interfaces[id.0].name.clone(),
        }
    }
}

fn number(expr: &ast::Expr) -> Option<f64> {
    match &expr.kind {
        ExprKind::Int(value) => Some(*value as f64),
        ExprKind::Real(value) => Some(*value),
        ExprKind::Negate(inner) => number(inner).map(|v| -v),
        _ => None,
    }
}

fn is_scenario_parts(expr: &ast::Expr) -> bool {
    match &expr.kind {
        ExprKind::Member(base, member) => {
            matches!(&base.kind, ExprKind::Name(name) if name == "scenario") && member.value == "parts"
        }
        _ => false,
    }
}
