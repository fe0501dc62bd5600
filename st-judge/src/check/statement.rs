//! Statements.

use super::{Checker, Scope};
use crate::finding::Span;
use crate::literal;
use crate::types::{Scalar, Type};
use crate::view::{Clause, Expression, ExpressionKind, Section, Statement, StatementKind, UnitKind};
use std::collections::HashSet;

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Loop {
    Inside,
    Outside,
}

impl Checker<'_> {
    pub(super) fn body(&mut self, scope: &Scope, body: &[Statement], around: Span, within: Loop) {
        if body.is_empty() {
            self.report("empty-branch", around, "no statement stands in this");
        }
        for pair in body.windows(2) {
            if matches!(pair[0].kind, StatementKind::Exit | StatementKind::Return) {
                self.report("unreachable", pair[1].span, "nothing comes here");
            }
        }
        body.iter().for_each(|statement| self.statement(scope, statement, within));
    }

    fn statement(&mut self, scope: &Scope, statement: &Statement, within: Loop) {
        let span = statement.span;
        match &statement.kind {
            StatementKind::Assign { target, value } => self.assign(scope, target, value),
            StatementKind::Call(call) => self.block_call(scope, call),
            StatementKind::If { branches, otherwise } => {
                for branch in branches {
                    self.wants(scope, &branch.condition, Scalar::Bool, "IF");
                    self.body(scope, &branch.body, branch.condition.span, within);
                }
                if let Some(body) = otherwise {
                    self.body(scope, body, span, within);
                }
            }
            StatementKind::Case { subject, clauses, otherwise } => {
                self.wants(scope, subject, Scalar::Dint, "CASE");
                self.labels(clauses);
                clauses.iter().for_each(|clause| self.body(scope, &clause.body, clause.span, within));
                match otherwise {
                    Some(body) => self.body(scope, body, span, within),
                    None => self.report("case-else", span, "CASE without ELSE"),
                }
            }
            StatementKind::While { condition, body } => {
                self.wants(scope, condition, Scalar::Bool, "WHILE");
                self.body(scope, body, span, Loop::Inside);
            }
            StatementKind::Exit if within == Loop::Outside => {
                self.report("exit", span, "EXIT outside of a loop");
            }
            StatementKind::Return if scope.unit.kind == UnitKind::Program => {
                self.report("return", span, "RETURN in a PROGRAM");
            }
            StatementKind::Exit | StatementKind::Return | StatementKind::Other => {}
        }
    }

    fn labels(&mut self, clauses: &[Clause]) {
        let mut seen = HashSet::new();
        for label in clauses.iter().flat_map(|c| &c.labels) {
            let value = match &label.kind {
                ExpressionKind::Int(text) => literal::int(text),
                _ => Err("a label is a whole number"),
            };
            match value {
                Err(wrong) => self.report("label", label.span, wrong),
                Ok(value) if !seen.insert(value) => {
                    self.report("label", label.span, format!("{value} stands twice"))
                }
                Ok(_) => {}
            }
        }
    }

    fn assign(&mut self, scope: &Scope, target: &Expression, value: &Expression) {
        let wanted = self.assignable(scope, target);
        let found = self.expression(scope, value);
        let (Some(wanted), Some(found)) = (wanted, found) else { return };
        if wanted != found {
            self.report("type", value.span, format!("{found} is assigned to {wanted}"));
        } else if !matches!(wanted, Type::Scalar(_)) {
            self.report("whole", target.span, format!("{wanted} is assigned as a whole"));
        }
    }

    /// The type of what may stand before `:=`.
    pub(super) fn assignable(&mut self, scope: &Scope, target: &Expression) -> Option<Type> {
        let ty = match &target.kind {
            ExpressionKind::Name(name) => {
                if scope.unit.kind == UnitKind::Function && scope.unit.name.key() == name.key() {
                    scope.unit.result.as_ref().and_then(|ty| self.type_of_name(ty))
                } else {
                    let (section, ty) = self.variable(scope, name)?;
                    if section == Section::Input {
                        self.report("input", name.span, format!("the input `{}` is assigned to", name.text));
                    }
                    Some(ty)
                }
            }
            ExpressionKind::Index { array, index } => {
                if matches!(array.kind, ExpressionKind::Name(_)) {
                    self.assignable(scope, array);
                } else {
                    self.report("output", array.span, "only elements of own variables are assigned to");
                }
                self.element(scope, array, index)
            }
            ExpressionKind::Member { member, .. } => {
                self.report(
                    "output",
                    target.span,
                    format!("`{}` of a function block is assigned to", member.text),
                );
                None
            }
            _ => {
                self.report("target", target.span, "nothing can be assigned to this");
                None
            }
        }?;
        self.types.insert(target.span, ty.clone());
        Some(ty)
    }
}
