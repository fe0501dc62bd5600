//! Types of expressions. Nothing is converted.

use super::precedence::Side;
use super::{Checker, Scope};
use crate::literal;
use crate::types::{BOOL, DINT, LREAL, Scalar, Type};
use crate::view::{Binary, Expression, ExpressionKind, Name, Section, Unary, UnitKind};

impl Checker<'_> {
    /// The type; None if the expression has a finding.
    pub(super) fn expression(&mut self, scope: &Scope, expression: &Expression) -> Option<Type> {
        let ty = match &expression.kind {
            ExpressionKind::Bool(_) | ExpressionKind::Int(_) | ExpressionKind::Real(_) => {
                self.literal(expression)
            }
            ExpressionKind::Time(_) => {
                self.report("core", expression.span, "a TIME stands only at the INTERVAL of a TASK");
                None
            }
            ExpressionKind::Name(name) => self.variable(scope, name).map(|(_, ty)| ty),
            ExpressionKind::Index { array, index } => self.element(scope, array, index),
            ExpressionKind::Member { object, member } => self.member(scope, object, member),
            ExpressionKind::Unary { operator, operand } => self.unary(scope, *operator, operand),
            ExpressionKind::Binary { operator, left, right } => self.binary(scope, *operator, left, right),
            ExpressionKind::Parenthesis(inner) => self.expression(scope, inner),
            ExpressionKind::Call(call) => self.function(scope, call),
            ExpressionKind::Other => None,
        }?;
        self.types.insert(expression.span, ty.clone());
        Some(ty)
    }

    /// The type of an expression that has to be a scalar.
    pub(super) fn scalar(&mut self, scope: &Scope, expression: &Expression) -> Option<Scalar> {
        match self.expression(scope, expression)? {
            Type::Scalar(scalar) => Some(scalar),
            other => {
                self.report("type", expression.span, format!("{other} where one value is wanted"));
                None
            }
        }
    }

    pub(super) fn wants(&mut self, scope: &Scope, expression: &Expression, wanted: Scalar, place: &str) {
        if let Some(found) = self.scalar(scope, expression)
            && found != wanted
        {
            self.report("type", expression.span, format!("{found} where {place} wants {wanted}"));
        }
    }

    pub(super) fn literal(&mut self, expression: &Expression) -> Option<Type> {
        let result = match &expression.kind {
            ExpressionKind::Bool(_) => Ok(BOOL),
            ExpressionKind::Int(text) => literal::int(text).map(|_| DINT),
            ExpressionKind::Real(text) => literal::real(text).map(|_| LREAL),
            _ => return None,
        };
        result.map_err(|wrong| self.report("literal", expression.span, wrong)).ok()
    }

    pub(super) fn variable(&mut self, scope: &Scope, name: &Name) -> Option<(Section, Type)> {
        let found = scope.variables.get(&name.key()).cloned();
        if found.is_none() {
            let unit = &scope.unit;
            let text = if unit.kind == UnitKind::Function && unit.name.key() == name.key() {
                format!("the result of `{}` is read", name.text)
            } else {
                format!("there is no variable `{}` in `{}`", name.text, unit.name.text)
            };
            self.report("unknown-variable", name.span, text);
        }
        found
    }

    pub(super) fn element(&mut self, scope: &Scope, array: &Expression, index: &Expression) -> Option<Type> {
        let ty = match &array.kind {
            ExpressionKind::Name(_) | ExpressionKind::Member { .. } => self.expression(scope, array),
            _ => {
                self.report("core", array.span, "what is indexed is a name");
                None
            }
        };
        self.wants(scope, index, Scalar::Dint, "an index");
        match ty? {
            Type::Array(element, upper) => {
                if let ExpressionKind::Int(text) = &index.bare().kind
                    && let Ok(value) = literal::int(text)
                    && !usize::try_from(value).is_ok_and(|value| value <= upper)
                {
                    self.report("index", index.span, format!("{value} is outside of 0..{upper}"));
                }
                Some(Type::Scalar(element))
            }
            other => {
                self.report("type", array.span, format!("{other} has no elements"));
                None
            }
        }
    }

    fn member(&mut self, scope: &Scope, object: &Expression, member: &Name) -> Option<Type> {
        let ExpressionKind::Name(name) = &object.kind else {
            self.report("core", object.span, "what stands before `.` is a name");
            return None;
        };
        let Type::Block(block) = self.variable(scope, name)?.1 else {
            self.report("type", object.span, format!("`{}` is no instance of a function block", name.text));
            return None;
        };
        let unit = *self.units.get(&block)?;
        let Some(variable) = unit.variables.iter().find(|v| v.name.key() == member.key()) else {
            let text = format!("`{}` has no output `{}`", unit.name.text, member.text);
            self.report("unknown-output", member.span, text);
            return None;
        };
        if variable.section != Section::Output {
            self.report(
                "private",
                member.span,
                format!("`{}` is no output of `{}`", member.text, unit.name.text),
            );
        }
        self.type_of_name(&variable.ty)
    }

    fn unary(&mut self, scope: &Scope, operator: Unary, operand: &Expression) -> Option<Type> {
        self.operand_of_unary(operand);
        let found = self.scalar(scope, operand)?;
        let is_fine = match operator {
            Unary::Not => found == Scalar::Bool,
            Unary::Minus => found.is_number(),
        };
        if !is_fine {
            self.report("type", operand.span, format!("{operator:?} of {found}"));
            return None;
        }
        Some(Type::Scalar(found))
    }

    fn binary(
        &mut self,
        scope: &Scope,
        operator: Binary,
        left: &Expression,
        right: &Expression,
    ) -> Option<Type> {
        self.operand_of(operator, Side::Left, left);
        self.operand_of(operator, Side::Right, right);
        let (left_type, right_type) = (self.scalar(scope, left), self.scalar(scope, right));
        let (left_type, right_type) = (left_type?, right_type?);
        if left_type != right_type {
            self.report("type", right.span, format!("{operator:?} of {left_type} and {right_type}"));
            return None;
        }
        let (is_fine, result) = match operator {
            Binary::And | Binary::Or | Binary::Xor => (left_type == Scalar::Bool, Scalar::Bool),
            Binary::Equal | Binary::Unequal => {
                (left_type.is_number() || left_type == Scalar::Bool, Scalar::Bool)
            }
            Binary::Less | Binary::Greater | Binary::LessOrEqual | Binary::GreaterOrEqual => {
                (left_type.is_number(), Scalar::Bool)
            }
            Binary::Add | Binary::Subtract | Binary::Multiply | Binary::Divide => {
                (left_type.is_number(), left_type)
            }
            Binary::Modulo => (left_type == Scalar::Dint, Scalar::Dint),
        };
        if !is_fine {
            self.report("type", left.span, format!("{operator:?} of {left_type}"));
            return None;
        }
        Some(Type::Scalar(result))
    }
}
