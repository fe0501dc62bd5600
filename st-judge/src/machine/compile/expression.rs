//! Expressions, one method for each type.

use super::super::code::{Any, Cell, Function, FunctionCall, Real, Slot, Truth, Whole};
use super::{Compiler, Scope};
use crate::literal;
use crate::standard::{self, Narrowing};
use crate::types::{Scalar, Type};
use crate::view::{Binary, Call, Expression, ExpressionKind, Unary};

impl Compiler<'_> {
    fn type_of(&self, expression: &Expression) -> &Type {
        &self.checked.types[&expression.span]
    }

    fn scalar_of(&self, expression: &Expression) -> Scalar {
        match self.type_of(expression) {
            Type::Scalar(scalar) => *scalar,
            _ => unreachable!("the check wants a scalar"),
        }
    }

    pub(super) fn any(&mut self, scope: &Scope, expression: &Expression) -> Any {
        match self.type_of(expression) {
            Type::Scalar(Scalar::Bool) => Any::Truth(self.truth(scope, expression)),
            Type::Scalar(Scalar::Dint | Scalar::Narrow(_)) => Any::Whole(self.whole(scope, expression)),
            Type::Scalar(Scalar::Lreal) => Any::Real(self.real(scope, expression)),
            Type::Array(_, upper) => {
                let words = upper + 1;
                Any::Array(self.slot(scope, expression), words)
            }
            Type::Block(_) => unreachable!("the check refuses it"),
        }
    }

    fn slot(&self, scope: &Scope, expression: &Expression) -> Slot {
        match &expression.bare().kind {
            ExpressionKind::Name(name) => scope.spot(name).slot(),
            ExpressionKind::Member { object, member } => {
                let ExpressionKind::Name(object) = &object.kind else {
                    unreachable!("the check wants a name")
                };
                let spot = scope.spot(object);
                let Type::Block(block) = &spot.ty else { unreachable!("the check wants an instance") };
                let offset = self.layouts.unit(block).variables[&member.key()].offset;
                match spot.slot() {
                    Slot::Frame(start) => Slot::Frame(start + offset),
                    Slot::Memory(start) => Slot::Memory(start + offset),
                }
            }
            _ => unreachable!("the check wants a variable"),
        }
    }

    /// What can be loaded and, of own variables, stored.
    pub(super) fn cell(&mut self, scope: &Scope, expression: &Expression) -> Cell {
        let ExpressionKind::Index { array, index } = &expression.kind else {
            return Cell::Slot(self.slot(scope, expression));
        };
        let Type::Array(_, upper) = self.type_of(array) else { unreachable!("the check wants an array") };
        let length = upper + 1;
        let start = self.slot(scope, array);
        Cell::Element { start, length, index: Box::new(self.whole(scope, index)), at: index.span.start }
    }

    fn is_cell(expression: &Expression) -> bool {
        matches!(
            expression.kind,
            ExpressionKind::Name(_) | ExpressionKind::Index { .. } | ExpressionKind::Member { .. }
        )
    }

    pub(super) fn truth(&mut self, scope: &Scope, expression: &Expression) -> Truth {
        if Self::is_cell(expression) {
            return Truth::Load(self.cell(scope, expression));
        }
        match &expression.kind {
            ExpressionKind::Bool(value) => Truth::Constant(*value),
            ExpressionKind::Parenthesis(inner) => self.truth(scope, inner),
            ExpressionKind::Unary { operator: Unary::Not, operand } => {
                Truth::Not(Box::new(self.truth(scope, operand)))
            }
            ExpressionKind::Binary { operator, left, right } => {
                self.truth_of_two(scope, *operator, left, right)
            }
            ExpressionKind::Call(call) => match call.name.text.to_ascii_uppercase().as_str() {
                "SEL" => {
                    let [gate, zero, one] = &call.arguments[..] else { unreachable!("checked") };
                    let parts = (&gate.value, &zero.value, &one.value);
                    Truth::Select(Box::new((
                        self.truth(scope, parts.0),
                        self.truth(scope, parts.1),
                        self.truth(scope, parts.2),
                    )))
                }
                _ => Truth::Call(self.function(scope, call)),
            },
            _ => unreachable!("the check has seen a BOOL"),
        }
    }

    fn truth_of_two(
        &mut self,
        scope: &Scope,
        operator: Binary,
        left: &Expression,
        right: &Expression,
    ) -> Truth {
        match self.scalar_of(left) {
            Scalar::Dint | Scalar::Narrow(_) => {
                Truth::Wholes(operator, Box::new((self.whole(scope, left), self.whole(scope, right))))
            }
            Scalar::Lreal => {
                Truth::Reals(operator, Box::new((self.real(scope, left), self.real(scope, right))))
            }
            Scalar::Bool => {
                let both = Box::new((self.truth(scope, left), self.truth(scope, right)));
                match operator {
                    Binary::And => Truth::And(both),
                    Binary::Or => Truth::Or(both),
                    Binary::Xor | Binary::Unequal => Truth::Xor(both),
                    _ => Truth::Not(Box::new(Truth::Xor(both))),
                }
            }
        }
    }

    pub(super) fn whole(&mut self, scope: &Scope, expression: &Expression) -> Whole {
        if Self::is_cell(expression) {
            return Whole::Load(self.cell(scope, expression));
        }
        let at = expression.span.start;
        match &expression.kind {
            ExpressionKind::Int(text) => Whole::Constant(literal::int(text).expect("checked")),
            ExpressionKind::Parenthesis(inner) => self.whole(scope, inner),
            ExpressionKind::Unary { operand, .. } => Whole::Minus(Box::new(self.whole(scope, operand)), at),
            ExpressionKind::Binary { operator, left, right } => {
                Whole::Binary(*operator, Box::new((self.whole(scope, left), self.whole(scope, right))), at)
            }
            ExpressionKind::Call(call) if standard::is_standard(&call.name.text) => {
                let values: Vec<&Expression> = call.arguments.iter().map(|a| &a.value).collect();
                let mut whole = |i: usize| self.whole(scope, values[i]);
                match call.name.text.to_ascii_uppercase().as_str() {
                    "ABS" => Whole::Abs(Box::new(whole(0)), at),
                    "MIN" => Whole::Min(Box::new((whole(0), whole(1)))),
                    "MAX" => Whole::Max(Box::new((whole(0), whole(1)))),
                    "LIMIT" => Whole::Limit(Box::new((whole(0), whole(1), whole(2)))),
                    "SEL" => {
                        let (zero, one) = (whole(1), whole(2));
                        Whole::Select(Box::new((self.truth(scope, values[0]), zero, one)))
                    }
                    "TRUNC" => Whole::Trunc(Box::new(self.real(scope, values[0])), at),
                    "BOOL_TO_DINT" => Whole::OfTruth(Box::new(self.truth(scope, values[0]))),
                    name => match standard::narrow(name) {
                        Some(Narrowing::From(_)) => whole(0),
                        Some(Narrowing::To(narrow)) => Whole::Within(Box::new(whole(0)), narrow.bounds(), at),
                        None => unreachable!("`{name}` gives no DINT"),
                    },
                }
            }
            ExpressionKind::Call(call) => Whole::Call(self.function(scope, call)),
            _ => unreachable!("the check has seen a DINT"),
        }
    }

    pub(super) fn real(&mut self, scope: &Scope, expression: &Expression) -> Real {
        if Self::is_cell(expression) {
            return Real::Load(self.cell(scope, expression));
        }
        let at = expression.span.start;
        match &expression.kind {
            ExpressionKind::Real(text) => Real::Constant(literal::real(text).expect("checked")),
            ExpressionKind::Parenthesis(inner) => self.real(scope, inner),
            ExpressionKind::Unary { operand, .. } => Real::Minus(Box::new(self.real(scope, operand))),
            ExpressionKind::Binary { operator, left, right } => {
                Real::Binary(*operator, Box::new((self.real(scope, left), self.real(scope, right))), at)
            }
            ExpressionKind::Call(call) if standard::is_standard(&call.name.text) => {
                self.standard_real(scope, call, at)
            }
            ExpressionKind::Call(call) => Real::Call(self.function(scope, call)),
            _ => unreachable!("the check has seen an LREAL"),
        }
    }

    fn standard_real(&mut self, scope: &Scope, call: &Call, at: usize) -> Real {
        let values: Vec<&Expression> = call.arguments.iter().map(|a| &a.value).collect();
        let name = call.name.text.to_ascii_uppercase();
        if name == "DINT_TO_LREAL" {
            return Real::OfWhole(Box::new(self.whole(scope, values[0])));
        }
        let mut real = |i: usize| self.real(scope, values[i]);
        let function = match name.as_str() {
            "EXPT" => return Real::Power(Box::new((real(0), real(1)))),
            "MIN" => return Real::Min(Box::new((real(0), real(1)))),
            "MAX" => return Real::Max(Box::new((real(0), real(1)))),
            "LIMIT" => return Real::Limit(Box::new((real(0), real(1), real(2)))),
            "SEL" => {
                let (zero, one) = (real(1), real(2));
                return Real::Select(Box::new((self.truth(scope, values[0]), zero, one)));
            }
            "ABS" => Function::Abs,
            "SQRT" => Function::Sqrt,
            "SIN" => Function::Sin,
            "COS" => Function::Cos,
            "TAN" => Function::Tan,
            "ASIN" => Function::Asin,
            "ACOS" => Function::Acos,
            "ATAN" => Function::Atan,
            "EXP" => Function::Exp,
            "LN" => Function::Ln,
            name => unreachable!("`{name}` gives no LREAL"),
        };
        Real::Function(function, Box::new(real(0)), at)
    }

    fn function(&mut self, scope: &Scope, call: &Call) -> FunctionCall {
        let key = call.name.key();
        let frame = self.layouts.unit(&key);
        let inputs = call.arguments.iter().map(|argument| {
            let name = argument.name.as_ref().expect("the check wants names");
            (frame.variables[&name.key()].offset, self.any(scope, &argument.value))
        });
        let inputs = inputs.collect();
        FunctionCall { unit: self.numbers[&key], base: self.layouts.base(&key), size: frame.size, inputs }
    }
}
