//! Calls of functions.

use super::domain::MEMBERS;
use super::{binary, constant};
use crate::check::context::{Context, Symbol};
use crate::check::path::Path;
use crate::diagnostic::Diagnostic;
use crate::ir::{self, Domain, Expr, ExprKind, Extent, Place, Scalar, Value, VariableId};
use crate::source::Span;
use crate::spec::ast;
use crate::spec::lexer::foreign;
use std::collections::BTreeSet;

impl Context<'_, '_> {
    pub(super) fn call(&mut self, name: &ast::Name, arguments: &[ast::Expr], span: Span) -> Option<Expr> {
        match (name.value.as_str(), arguments) {
            ("count", [_] | [_, _]) => self.count_call(arguments, span),
            ("min" | "max", [a, b]) => {
                let (a, b) = self.pair(a, b, None)?;
                let least = name.value == "min";
                let ty = match (a.ty, b.ty) {
                    (Scalar::Int { lo: a, hi: b }, Scalar::Int { lo: c, hi: d }) => {
                        if least {
                            Scalar::Int { lo: a.min(c), hi: b.min(d) }
                        } else {
                            Scalar::Int { lo: a.max(c), hi: b.max(d) }
                        }
                    }
                    (Scalar::Real, Scalar::Real) => Scalar::Real,
                    (Scalar::Time, Scalar::Time) => Scalar::Time,
                    _ => return self.wrong_arguments(name, span),
                };
                let (a, b) = (Box::new(a), Box::new(b));
                Some(Expr { ty, kind: if least { ExprKind::Min(a, b) } else { ExprKind::Max(a, b) } })
            }
            ("abs", [a]) => {
                let a = self.expr(a, None)?;
                let ty = match a.ty {
                    Scalar::Int { lo, hi } => {
                        let (x, y) = (i64::from(lo).abs(), i64::from(hi).abs());
                        let least = if lo <= 0 && hi >= 0 { 0 } else { x.min(y) };
                        self.fitting(least, x.max(y), span)?
                    }
                    Scalar::Real => Scalar::Real,
                    _ => return self.wrong_arguments(name, span),
                };
                Some(Expr { ty, kind: ExprKind::Absolute(Box::new(a)) })
            }
            ("point", [x, y, z]) => {
                let parts =
                    [self.typed(x, Scalar::Real), self.typed(y, Scalar::Real), self.typed(z, Scalar::Real)];
                let [Some(x), Some(y), Some(z)] = parts else { return None };
                Some(Expr { ty: Scalar::Point, kind: ExprKind::MakePoint(Box::new([x, y, z])) })
            }
            ("up", [height]) => {
                let height = self.typed(height, Scalar::Real)?;
                let zero = || constant(Scalar::Real, Value::Real(0.0));
                Some(Expr {
                    ty: Scalar::Point,
                    kind: ExprKind::MakePoint(Box::new([zero(), zero(), height])),
                })
            }
            ("squared_distance", [a, b]) => {
                let (a, b) = (self.typed(a, Scalar::Point)?, self.typed(b, Scalar::Point)?);
                Some(Expr { ty: Scalar::Real, kind: ExprKind::SquaredDistance(Box::new(a), Box::new(b)) })
            }
            ("count" | "min" | "max" | "abs" | "point" | "up" | "squared_distance", _) => {
                self.wrong_arguments(name, span)
            }
            _ => {
                let known = ["count", "min", "max", "abs", "point", "up", "squared_distance"];
                let help = match self.automaton.device.verbs.iter().find(|v| v.name == name.value) {
                    Some(verb) => format!("`{}` is a command: use it in updates", verb.name),
                    None => match foreign::function_block(&name.value) {
                        Some(help) => help.into(),
                        None => crate::diagnostic::suggestion(&name.value, known)
                            .map_or(format!("functions are {}", known.join(", ")), |n| {
                                format!("is `{n}` meant?")
                            }),
                    },
                };
                self.report(
                    Diagnostic::new("E0311", name.span, format!("there is no function `{}`", name.value))
                        .help(help),
                );
                None
            }
        }
    }

    fn wrong_arguments(&mut self, name: &ast::Name, span: Span) -> Option<Expr> {
        self.report(
            Diagnostic::new("E0319", span, format!("`{}` does not take these arguments", name.value)).help(
                "min(a, b), max(a, b), abs(a) of numbers; point(x, y, z); up(height); squared_distance(p, q); count(role) or count(array, value)",
            ),
        );
        None
    }

    /// `count(role)` and `count(array, value)`.
    fn count_call(&mut self, arguments: &[ast::Expr], span: Span) -> Option<Expr> {
        if let [ast::Expr { kind: ast::ExprKind::Name(name), .. }] = arguments
            && let Some(symbol @ Symbol::Role(id)) = self.symbols.get(name).cloned()
        {
            self.uses_symbol(name, &symbol, arguments[0].span);
            return Some(Expr { ty: Scalar::Int { lo: 0, hi: MEMBERS }, kind: ExprKind::Members(id) });
        }
        let [array, value] = arguments else {
            return self.wrong_arguments(&ast::Name { value: "count".into(), span }, span);
        };
        let Path::Place(mut place, ty) = self.path(array, None)? else {
            self.report(
                Diagnostic::new("E0312", array.span, "this is not an array").help("count a role or an array"),
            );
            return None;
        };
        let value = self.typed(value, ty.scalar)?;
        let (domain, scalar, size) = match ty.extent {
            Extent::One => {
                self.report(
                    Diagnostic::new("E0312", array.span, "this is not an array")
                        .help("count a role or an array"),
                );
                return None;
            }
            Extent::By(id) => (Domain::Enum(id), Scalar::Enum(id), self.checker.model.elements(ty.extent)),
            Extent::Count(n) => {
                let whole = |v: i32| constant(Scalar::Int { lo: v, hi: v }, Value::Int(v));
                let last = n as i32 - 1;
                (Domain::Range(whole(0), whole(last)), Scalar::Int { lo: 0, hi: last }, n)
            }
        };
        let within: Vec<&Expr> = place.parts().chain([&value]).collect();
        let name = self.hidden_name("element", &within);
        let variable = self.new_variable(&name, scalar);
        let index = Some(Box::new(Expr { ty: scalar, kind: ExprKind::Variable(variable) }));
        match &mut place {
            Place::Local { index: i, .. }
            | Place::Cell { index: i, .. }
            | Place::Port { index: i, .. }
            | Place::Parameter { index: i, .. }
            | Place::Shown { index: i, .. } => *i = index,
        }
        let element = Expr { ty: ty.scalar, kind: ExprKind::Read(place) };
        let body = Box::new(binary(ir::Operator::Equal, Scalar::Bool, element, value));
        let kind = ExprKind::Count { variable, domain: Box::new(domain), body };
        Some(Expr { ty: Scalar::Int { lo: 0, hi: size as i32 }, kind })
    }

    /// A name that no variable has around these expressions or within them: controllers give variables of one name one
    /// identifier, because those of a specification never meet.
    fn hidden_name(&self, wanted: &str, within: &[&Expr]) -> String {
        let mut met: BTreeSet<VariableId> = self.variables.iter().map(|(_, id, _)| *id).collect();
        within.iter().for_each(|expr| quantified(expr, &mut met));
        let is_met = |name: &str| met.iter().any(|id| self.automaton.variables[id.0].name == name);
        let numbered = (2..).map(|number| format!("{wanted}{number}"));
        let mut names = std::iter::once(wanted.to_string()).chain(numbered);
        names.find(|name| !is_met(name)).unwrap_or_default()
    }
}

/// The variables that go over something within an expression.
fn quantified(expr: &Expr, found: &mut BTreeSet<VariableId>) {
    if let ExprKind::Exists { variable, .. }
    | ExprKind::Forall { variable, .. }
    | ExprKind::Count { variable, .. }
    | ExprKind::Sum { variable, .. } = expr.kind
    {
        found.insert(variable);
    }
    expr.parts().for_each(|part| quantified(part, found));
}
