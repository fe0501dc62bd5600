//! What operators make of values.

use super::Value;
pub use crate::spec::ast::Operator;

impl Operator {
    /// None where it has no value: of whole numbers beyond 32 bits, of a division by 0, of operands that it does not take.
    /// `and` and `or` are not for it: they do not evaluate the second operand if the first one decides.
    pub fn apply(self, a: Value, b: Value) -> Option<Value> {
        Some(match self {
            Operator::Equal => Value::Bool(a == b),
            Operator::NotEqual => Value::Bool(a != b),
            Operator::Less => Value::Bool(less(a, b)),
            Operator::Greater => Value::Bool(less(b, a)),
            Operator::LessEqual => Value::Bool(less(a, b) || a == b),
            Operator::GreaterEqual => Value::Bool(less(b, a) || a == b),
            _ => match (a, b) {
                (Value::Int(a), Value::Int(b)) => Value::Int(self.whole(a, b)?),
                (Value::Real(a), Value::Real(b)) => Value::Real(match self {
                    Operator::Add => a + b,
                    Operator::Subtract => a - b,
                    Operator::Multiply => a * b,
                    _ => a / b,
                }),
                (Value::Point(a), Value::Point(b)) => Value::Point([0, 1, 2].map(|axis| match self {
                    Operator::Add => a[axis] + b[axis],
                    _ => a[axis] - b[axis],
                })),
                _ => return None,
            },
        })
    }

    fn whole(self, a: i32, b: i32) -> Option<i32> {
        match self {
            Operator::Add => a.checked_add(b),
            Operator::Subtract => a.checked_sub(b),
            Operator::Multiply => a.checked_mul(b),
            Operator::Divide => a.checked_div(b),
            _ => a.checked_rem(b),
        }
    }
}

/// Order of numbers; nothing is less than NaN, and NaN less than nothing.
pub fn less(a: Value, b: Value) -> bool {
    match (a, b) {
        (Value::Int(a), Value::Int(b)) => a < b,
        (Value::Real(a), Value::Real(b)) => a < b,
        _ => false,
    }
}
