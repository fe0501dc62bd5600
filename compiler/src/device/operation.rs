//! Operators between values of devices.

use crate::spec::ast::Operator;
use runtime_sim::frame::Frame;
use runtime_sim::point::Point;
use runtime_sim::value::Value;

/// None where the operator does not take these.
pub fn joined(operator: Operator, left: &Value, right: &Value) -> Option<Value> {
    use Operator::{Add, Divide, Greater, GreaterEqual, Less, LessEqual, Multiply, Subtract};
    Some(match (operator, left, right) {
        (Add, Value::Number(a), Value::Number(b)) => Value::Number(a + b),
        (Subtract, Value::Number(a), Value::Number(b)) => Value::Number(a - b),
        (Multiply, Value::Number(a), Value::Number(b)) => Value::Number(a * b),
        (Divide, Value::Number(a), Value::Number(b)) => Value::Number(a / b),
        (Less, Value::Number(a), Value::Number(b)) => Value::Truth(a < b),
        (LessEqual, Value::Number(a), Value::Number(b)) => Value::Truth(a <= b),
        (Greater, Value::Number(a), Value::Number(b)) => Value::Truth(a > b),
        (GreaterEqual, Value::Number(a), Value::Number(b)) => Value::Truth(a >= b),
        (Operator::And, Value::Truth(a), Value::Truth(b)) => Value::Truth(*a && *b),
        (Operator::Or, Value::Truth(a), Value::Truth(b)) => Value::Truth(*a || *b),
        (Add, Value::Point(a), Value::Point(b)) => Value::Point(*a + *b),
        (Subtract, Value::Point(a), Value::Point(b)) => Value::Point(*a - *b),
        (Multiply, Value::Frame(frame), Value::Point(point)) => Value::Point(frame.point(*point)),
        (Multiply, Value::Frame(frame), Value::Frame(inner)) => Value::Frame(frame.then(*inner)),
        (Add | Subtract, Value::Point(_), Value::List(points))
        | (Multiply, Value::Frame(_), Value::List(points)) => {
            let each = points.iter().map(|point| match point {
                Value::Point(_) | Value::Frame(_) => joined(operator, left, point),
                _ => None,
            });
            Value::List(each.collect::<Option<_>>()?)
        }
        _ => return None,
    })
}

/// With 1 for what is not finite.
pub fn finite(value: Value) -> Value {
    let number = |number: f64| if number.is_finite() { number } else { 1.0 };
    let point = |Point { x, y, z }| Point::new(number(x), number(y), number(z));
    match value {
        Value::Number(value) => Value::Number(number(value)),
        Value::Point(value) => Value::Point(point(value)),
        Value::Frame(Frame { position, yaw }) => Value::Frame(Frame::new(point(position), number(yaw))),
        Value::List(values) => Value::List(values.into_iter().map(finite).collect()),
        other => other,
    }
}

/// A division by 0 has no value, nor has what is too large.
pub fn is_finite(value: &Value) -> bool {
    match value {
        Value::Number(number) => number.is_finite(),
        Value::Point(Point { x, y, z }) => [x, y, z].into_iter().all(|c| c.is_finite()),
        Value::Frame(Frame { position: Point { x, y, z }, yaw }) => {
            [x, y, z, yaw].into_iter().all(|c| c.is_finite())
        }
        Value::List(values) => values.iter().all(is_finite),
        _ => true,
    }
}
