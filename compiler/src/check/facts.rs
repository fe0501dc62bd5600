//! What is known of values at a point of the text: intervals, from types, guards and earlier updates.
//!
//! Booleans and members of enumerations count by ordinal, so that `not open` and
//! `slot[i] = Free` are facts too.

use crate::ir::{Domain, Expr, ExprKind, Operator, Place, Scalar, Value};
use std::collections::BTreeMap;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    pub lo: f64,
    pub hi: f64,
}

impl Interval {
    pub const ALL: Interval = Interval { lo: f64::NEG_INFINITY, hi: f64::INFINITY };

    pub fn new(lo: f64, hi: f64) -> Self {
        Self { lo, hi }
    }

    pub fn meet(self, other: Interval) -> Self {
        Self { lo: self.lo.max(other.lo), hi: self.hi.min(other.hi) }
    }

    pub fn is_within(self, other: Interval) -> bool {
        self.lo >= other.lo && self.hi <= other.hi
    }

    pub fn holds(self, value: f64) -> bool {
        self.lo <= value && value <= self.hi
    }
}

/// What a type says of its values.
pub fn of_type(ty: Scalar) -> Interval {
    match ty {
        Scalar::Int { lo, hi } => Interval::new(f64::from(lo), f64::from(hi)),
        Scalar::Time => Interval::new(0.0, f64::from(i32::MAX)),
        Scalar::Bool => Interval::new(0.0, 1.0),
        _ => Interval::ALL,
    }
}

#[derive(Clone, Debug, Default)]
pub struct Facts {
    known: BTreeMap<String, Interval>,
}

impl Facts {
    pub fn of(&self, expr: &Expr) -> Interval {
        match &expr.kind {
            ExprKind::Constant(Value::Int(v)) => Interval::new(f64::from(*v), f64::from(*v)),
            ExprKind::Constant(Value::Real(v)) => Interval::new(*v, *v),
            ExprKind::Constant(Value::Bool(v)) => {
                Interval::new(f64::from(u8::from(*v)), f64::from(u8::from(*v)))
            }
            ExprKind::ToReal(inner) => self.of(inner),
            // Neither operand is negative.
            ExprKind::Binary(Operator::Add, a, b) if expr.ty == Scalar::Time => {
                Interval::new(0.0, self.of(a).hi + self.of(b).hi)
            }
            ExprKind::Binary(Operator::Multiply, a, b) if expr.ty == Scalar::Time => {
                Interval::new(0.0, self.of(a).hi * self.of(b).hi)
            }
            // Of reals one may be NaN, and then both say nothing.
            ExprKind::Min(a, b) if expr.ty != Scalar::Real => {
                let (a, b) = (self.of(a), self.of(b));
                Interval::new(a.lo.min(b.lo), a.hi.min(b.hi))
            }
            ExprKind::Max(a, b) if expr.ty != Scalar::Real => {
                let (a, b) = (self.of(a), self.of(b));
                Interval::new(a.lo.max(b.lo), a.hi.max(b.hi))
            }
            _ => {
                let declared = of_type(expr.ty);
                key(expr).and_then(|k| self.known.get(&k)).map_or(declared, |known| declared.meet(*known))
            }
        }
    }

    /// Takes in that a condition holds, or does not.
    pub fn learn(&mut self, condition: &Expr, truth: bool) {
        match &condition.kind {
            ExprKind::Not(inner) => self.learn(inner, !truth),
            ExprKind::Binary(Operator::And, a, b) if truth => {
                self.learn(a, true);
                self.learn(b, true);
            }
            ExprKind::Binary(Operator::Or, a, b) if !truth => {
                self.learn(a, false);
                self.learn(b, false);
            }
            ExprKind::Binary(operator, a, b) => {
                if let Some(operator) = if truth { Some(*operator) } else { opposite(*operator, a.ty) } {
                    self.compare(operator, a, b);
                }
            }
            _ if condition.ty == Scalar::Bool => {
                let value = if truth { 1.0 } else { 0.0 };
                self.narrow(condition, Interval::new(value, value));
            }
            _ => {}
        }
    }

    fn compare(&mut self, operator: Operator, a: &Expr, b: &Expr) {
        let (left, right) = (self.of(a), self.of(b));
        let below = |x: f64| if a.ty == Scalar::Real { x.next_down() } else { x - 1.0 };
        let above = |x: f64| if a.ty == Scalar::Real { x.next_up() } else { x + 1.0 };
        let (for_left, for_right) = match operator {
            Operator::Equal => (right, left),
            Operator::Less => (
                Interval::new(f64::NEG_INFINITY, below(right.hi)),
                Interval::new(above(left.lo), f64::INFINITY),
            ),
            Operator::LessEqual => {
                (Interval::new(f64::NEG_INFINITY, right.hi), Interval::new(left.lo, f64::INFINITY))
            }
            Operator::Greater => (
                Interval::new(above(right.lo), f64::INFINITY),
                Interval::new(f64::NEG_INFINITY, below(left.hi)),
            ),
            Operator::GreaterEqual => {
                (Interval::new(right.lo, f64::INFINITY), Interval::new(f64::NEG_INFINITY, left.hi))
            }
            _ => return,
        };
        self.narrow(a, for_left);
        self.narrow(b, for_right);
    }

    fn narrow(&mut self, expr: &Expr, interval: Interval) {
        if let Some(key) = key(expr) {
            let known = self.known.entry(key).or_insert(Interval::ALL);
            *known = known.meet(interval);
        }
    }

    /// Forgets what a write to a place may have changed, then knows the new value's interval.
    pub fn write(&mut self, place: &Place, ty: Scalar, value: Interval) {
        self.forget(place);
        let expr = Expr { ty, kind: ExprKind::Read(place.clone()) };
        // After `a[a[0]] := v` the place `a[a[0]]` may be another one.
        if key(&expr).is_some_and(|key| key.matches(&marker(place)).count() == 1) {
            self.narrow(&expr, value);
        }
    }

    /// Forgets what was known of a variable.
    pub fn forget(&mut self, place: &Place) {
        let written = marker(place);
        self.known.retain(|key, _| !key.contains(&written));
    }
}

/// The comparison that holds when this one does not. For reals there is none, since NaN fails all of them;
/// but no real that a step reads from a variable is NaN, only ports are.
fn opposite(operator: Operator, ty: Scalar) -> Option<Operator> {
    if ty == Scalar::Real {
        return None;
    }
    match operator {
        Operator::Less => Some(Operator::GreaterEqual),
        Operator::LessEqual => Some(Operator::Greater),
        Operator::Greater => Some(Operator::LessEqual),
        Operator::GreaterEqual => Some(Operator::Less),
        Operator::NotEqual => Some(Operator::Equal),
        _ => None,
    }
}

/// A text that is equal for expressions that read the same value; `None` if the expression is no reading.
fn key(expr: &Expr) -> Option<String> {
    match &expr.kind {
        ExprKind::Read(place) => place_key(place),
        ExprKind::Variable(id) => Some(format!("v{};", id.0)),
        _ => None,
    }
}

fn place_key(place: &Place) -> Option<String> {
    let at = |index: &Option<Box<Expr>>| match index {
        None => Some(String::new()),
        Some(e) => Some(format!("[{}]", index_key(e)?)),
    };
    let base = marker(place);
    Some(match place {
        Place::Local { index, .. } | Place::Port { index, .. } | Place::Parameter { index, .. } => {
            base + &at(index)?
        }
        Place::Cell { of, index, .. } => {
            base + "@" + &of.as_ref().map_or(Some(String::new()), |e| index_key(e))? + &at(index)?
        }
        Place::Shown { of, index, .. } => base + "@" + &index_key(of)? + &at(index)?,
    })
}

fn index_key(expr: &Expr) -> Option<String> {
    match &expr.kind {
        ExprKind::Constant(Value::Int(v)) => Some(v.to_string()),
        _ => key(expr),
    }
}

/// What every key that reads this variable contains.
fn marker(place: &Place) -> String {
    match place {
        Place::Local { local, .. } => format!("l{local};"),
        Place::Cell { interface, cell, .. } => format!("c{}.{cell};", interface.0),
        Place::Port { port, .. } => format!("p{port};"),
        Place::Parameter { parameter, .. } => format!("q{parameter};"),
        Place::Shown { interface, parameter, .. } => format!("s{}.{parameter};", interface.0),
    }
}

/// Whether a stored value could be infinite or not a number.
pub fn may_be_non_finite(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Read(place) => matches!(place, Place::Port { .. }),
        ExprKind::MakePoint(parts) => parts.iter().any(may_be_non_finite),
        ExprKind::Coordinate(inner, _) | ExprKind::Negate(inner) | ExprKind::Absolute(inner) => {
            may_be_non_finite(inner)
        }
        ExprKind::Min(a, b) | ExprKind::Max(a, b) => may_be_non_finite(a) || may_be_non_finite(b),
        ExprKind::Constant(_) | ExprKind::Variable(_) | ExprKind::ToReal(_) => false,
        _ => matches!(expr.ty, Scalar::Real | Scalar::Point),
    }
}

/// The interval of a variable that runs over a domain; for a range, of whole numbers.
pub fn of_domain(domain: &Domain, facts: &Facts) -> Option<Interval> {
    match domain {
        Domain::Range(low, high) => Some(Interval::new(facts.of(low).lo, facts.of(high).hi)),
        Domain::Role(_) | Domain::Enum(_) => None,
    }
}
