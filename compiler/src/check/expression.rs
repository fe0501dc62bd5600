//! Types of expressions.

pub(super) mod arithmetic;
mod call;
mod domain;

use super::context::Context;
use super::path::Path;
use crate::diagnostic::Diagnostic;
use crate::ir::{self, Expr, ExprKind, Extent, Place, Scalar, Value};
use crate::source::Span;
use crate::spec::ast;

impl Context<'_, '_> {
    /// An expression of any scalar type; `None` has been reported.
    pub(super) fn expr(&mut self, tree: &ast::Expr, expected: Option<Scalar>) -> Option<Expr> {
        use ast::ExprKind as Tree;
        match &tree.kind {
            Tree::Error => None,
            Tree::List(_) => {
                self.report(
                    Diagnostic::new("E0312", tree.span, "a list is allowed in devices only")
                        .help("an automaton has arrays: write one value for each element"),
                );
                None
            }
            Tree::Bool(b) => Some(constant(Scalar::Bool, Value::Bool(*b))),
            Tree::Int(i) => {
                let value = *i as i32;
                if expected == Some(Scalar::Real) {
                    return Some(constant(Scalar::Real, Value::Real(f64::from(value))));
                }
                Some(constant(Scalar::Int { lo: value, hi: value }, Value::Int(value)))
            }
            Tree::Real(r) => Some(constant(Scalar::Real, Value::Real(*r))),
            Tree::Duration(ms) => Some(constant(Scalar::Time, Value::Int(*ms as i32))),
            Tree::Name(_) | Tree::Member(..) | Tree::Index(..) => match self.path(tree, expected)? {
                Path::Value(expr) => Some(expr),
                Path::Place(place, ty) if ty.extent == Extent::One => {
                    let read = self.read(place, ty.scalar);
                    self.narrowed(tree, ty.scalar, read.ty);
                    Some(read)
                }
                Path::Place(..) => {
                    self.report(
                        Diagnostic::new("E0312", tree.span, "this is a whole array, not one value")
                            .help("write an index, such as `[i]`"),
                    );
                    None
                }
            },
            Tree::Call(name, arguments) => self.call(name, arguments, tree.span),
            Tree::Not(inner) => {
                let inner = self.typed(inner, Scalar::Bool)?;
                Some(Expr { ty: Scalar::Bool, kind: ExprKind::Not(Box::new(inner)) })
            }
            Tree::Negate(inner) => self.negate(inner, expected, tree.span),
            Tree::Binary(operator, left, right) => self.binary(*operator, left, right, expected, tree.span),
            Tree::Quantified { quantifier, variable, domain, body } => {
                self.quantified(*quantifier, variable, domain, body)
            }
            Tree::After(time) => {
                if !self.in_guard {
                    self.report(
                        Diagnostic::new("E0314", tree.span, "`after` is allowed in a guard only")
                            .help("move it after `when`"),
                    );
                    return None;
                }
                let time = self.typed(time, Scalar::Time)?;
                Some(Expr { ty: Scalar::Bool, kind: ExprKind::After(Box::new(time)) })
            }
            Tree::In(value, role) => {
                let id = self.role_named(role)?;
                let value = self.typed(value, Scalar::Ref(self.automaton.roles[id.0].interface))?;
                Some(Expr { ty: Scalar::Bool, kind: ExprKind::IsMember(Box::new(value), id) })
            }
            Tree::Reaches(from, to) => {
                let (from, to) = (self.reference(from)?, self.reference(to)?);
                let (Scalar::Ref(a), Scalar::Ref(b)) = (from.ty, to.ty) else { return None };
                let relation = self.checker.relation(a, b);
                let kind = ExprKind::Reaches(relation, Box::new(from), Box::new(to));
                Some(Expr { ty: Scalar::Bool, kind })
            }
        }
    }

    /// `done` or `failed`.
    pub(super) fn answer(&mut self, name: &str, span: Span) -> Option<Expr> {
        if !self.automaton.device.is_commanded() {
            let message = format!("the device `{}` has no commands", self.automaton.device.name);
            self.report(
                Diagnostic::new("E0314", span, message)
                    .help("`done` and `failed` say how a command has ended"),
            );
            return None;
        }
        let kind = if name == "done" { ExprKind::Done } else { ExprKind::Failed };
        Some(Expr { ty: Scalar::Bool, kind })
    }

    fn reference(&mut self, tree: &ast::Expr) -> Option<Expr> {
        let expr = self.expr(tree, None)?;
        if matches!(expr.ty, Scalar::Ref(_)) {
            return Some(expr);
        }
        let name = self.checker.type_name(expr.ty);
        self.report(
            Diagnostic::new("E0315", tree.span, format!("this has type {name}, and a robot is expected"))
                .help("write the names of two robots, one on each side of `reaches`"),
        );
        None
    }

    /// An expression of a given type; whole numbers become reals where a real is wanted.
    pub(super) fn typed(&mut self, tree: &ast::Expr, wanted: Scalar) -> Option<Expr> {
        let expr = self.expr(tree, Some(wanted))?;
        match (expr.ty, wanted) {
            (Scalar::Int { .. }, Scalar::Int { .. }) => Some(expr),
            (Scalar::Int { .. }, Scalar::Real) => Some(to_real(expr)),
            (a, b) if a == b => Some(expr),
            (found, _) => {
                let (found, wanted) = (self.checker.type_name(found), self.checker.type_name(wanted));
                self.report(
                    Diagnostic::new(
                        "E0315",
                        tree.span,
                        format!("this has type {found}, and {wanted} is expected"),
                    )
                    .help(type_help(&found, &wanted, tree)),
                );
                None
            }
        }
    }

    /// A whole number.
    pub(super) fn whole(&mut self, tree: &ast::Expr) -> Option<Expr> {
        self.typed(tree, Scalar::Int { lo: i32::MIN, hi: i32::MAX })
    }

    /// Notes what is known of a whole number beyond its type.
    fn narrowed(&mut self, tree: &ast::Expr, declared: Scalar, known: Scalar) {
        let span = match &tree.kind {
            ast::ExprKind::Name(_) => tree.span,
            ast::ExprKind::Member(_, member) => member.span,
            _ => return,
        };
        if let (Some(names), Scalar::Int { lo, hi }) = (&mut self.checker.names, known)
            && known != declared
        {
            names.narrow(self.checker.sources, span, (lo, hi));
        }
    }

    fn read(&self, place: Place, ty: Scalar) -> Expr {
        let mut expr = Expr { ty, kind: ExprKind::Read(place) };
        if let Scalar::Int { lo, hi } = ty {
            let known = self.facts.of(&expr);
            if known.lo <= known.hi {
                expr.ty = Scalar::Int {
                    lo: known.lo.max(f64::from(lo)) as i32,
                    hi: known.hi.min(f64::from(hi)) as i32,
                };
            }
        }
        expr
    }
}

fn constant(ty: Scalar, value: Value) -> Expr {
    Expr { ty, kind: ExprKind::Constant(value) }
}

fn to_real(expr: Expr) -> Expr {
    match expr.kind {
        ExprKind::Constant(Value::Int(v)) => constant(Scalar::Real, Value::Real(f64::from(v))),
        _ => Expr { ty: Scalar::Real, kind: ExprKind::ToReal(Box::new(expr)) },
    }
}

fn binary(operator: ir::Operator, ty: Scalar, left: Expr, right: Expr) -> Expr {
    Expr { ty, kind: ExprKind::Binary(operator, Box::new(left), Box::new(right)) }
}

/// How a number becomes a duration.
pub(super) fn unit_help(tree: &ast::Expr) -> String {
    match &tree.kind {
        ast::ExprKind::Int(number) => format!("write a unit: `{number} s`"),
        ast::ExprKind::Real(number) => format!("write a unit: `{number} s`"),
        _ => "write a duration with its unit, such as `60 s` or `300 ms`".into(),
    }
}

fn type_help(found: &str, wanted: &str, tree: &ast::Expr) -> String {
    match (found, wanted) {
        (_, "time") => unit_help(tree),
        ("real", _) if wanted.starts_with("int") => {
            "a real is not rounded to a whole number; compute with whole numbers".into()
        }
        _ => format!("write a value of type {wanted}"),
    }
}
