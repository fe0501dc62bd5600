//! What is known of values at a point of the text: intervals, from types, guards and earlier updates.
//!
//! Booleans and members of enumerations count by ordinal, so that `not open` and
//! `slot[i] = Free` are facts too.

use crate::ir::{Domain, Expr, ExprKind, Operator, Place, Scalar, Value};
use std::collections::{BTreeMap, BTreeSet};

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

    pub fn with(self, other: Interval) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    pub fn is_within(self, other: Interval) -> bool {
        self.lo >= other.lo && self.hi <= other.hi
    }

    pub fn holds(self, value: f64) -> bool {
        self.lo <= value && value <= self.hi
    }

    /// From the least of some bounds to the greatest; all, if one of them is none.
    fn between<const N: usize>(bounds: [f64; N]) -> Self {
        if bounds.iter().any(|bound| bound.is_nan()) {
            return Self::ALL;
        }
        let [least, greatest] = [f64::min, f64::max].map(|f| bounds.into_iter().reduce(f));
        least.zip(greatest).map_or(Self::ALL, |(lo, hi)| Self::new(lo, hi))
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
    /// What differs from 0, beyond what its interval says.
    not_zero: BTreeSet<String>,
}

impl Facts {
    /// Of a real, what it is unless it is NaN.
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
            // With NaN on the right, both are the left side.
            ExprKind::Min(left, right) => {
                let (a, b) = (self.of(left), self.of(right));
                let hi = if may_be_nan(right) { a.hi } else { a.hi.min(b.hi) };
                Interval::new(a.lo.min(b.lo), hi)
            }
            ExprKind::Max(left, right) => {
                let (a, b) = (self.of(left), self.of(right));
                let lo = if may_be_nan(right) { a.lo } else { a.lo.max(b.lo) };
                Interval::new(lo, a.hi.max(b.hi))
            }
            _ if expr.ty == Scalar::Real => self.computed(expr).meet(self.learnt(expr)),
            ExprKind::Read(_) | ExprKind::Variable(_) => of_type(expr.ty).meet(self.learnt(expr)),
            _ => of_type(expr.ty),
        }
    }

    fn learnt(&self, expr: &Expr) -> Interval {
        key(expr).and_then(|key| self.known.get(&key).copied()).unwrap_or(Interval::ALL)
    }

    /// What follows of a real from its operands. Rounding keeps the order, so bounds are those of rounded bounds.
    fn computed(&self, expr: &Expr) -> Interval {
        match &expr.kind {
            ExprKind::Negate(inner) => {
                let inner = self.of(inner);
                Interval::new(-inner.hi, -inner.lo)
            }
            ExprKind::Absolute(inner) => {
                let Interval { lo, hi } = self.of(inner);
                let least = if lo <= 0.0 && hi >= 0.0 { 0.0 } else { lo.abs().min(hi.abs()) };
                Interval::new(least, lo.abs().max(hi.abs()))
            }
            ExprKind::Binary(Operator::Add, a, b) => {
                let (a, b) = (self.of(a), self.of(b));
                Interval::between([a.lo + b.lo, a.hi + b.hi])
            }
            ExprKind::Binary(Operator::Subtract, a, b) => {
                let (a, b) = (self.of(a), self.of(b));
                Interval::between([a.lo - b.hi, a.hi - b.lo])
            }
            ExprKind::Binary(Operator::Multiply, a, b) => {
                let (a, b) = (self.of(a), self.of(b));
                Interval::between([a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi])
            }
            _ => Interval::ALL,
        }
    }

    /// Whether a value is proved to differ from 0; one that is NaN does.
    pub fn differs_from_zero(&self, expr: &Expr) -> bool {
        let known = self.of(expr).meet(self.learnt(expr));
        if !known.holds(0.0) {
            return true;
        }
        // A guard that says otherwise never holds.
        if known == Interval::new(0.0, 0.0) {
            return false;
        }
        key(expr).is_some_and(|key| self.not_zero.contains(&key))
            || match &expr.kind {
                ExprKind::ToReal(inner) | ExprKind::Negate(inner) | ExprKind::Absolute(inner) => {
                    self.differs_from_zero(inner)
                }
                _ => false,
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
                let differ = if truth { Operator::NotEqual } else { Operator::Equal };
                if *operator == differ {
                    self.differ(a, b);
                    self.differ(b, a);
                }
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

    fn differ(&mut self, expr: &Expr, from: &Expr) {
        if self.of(from) == Interval::new(0.0, 0.0) {
            self.not_zero.extend(key(expr));
        }
    }

    fn narrow(&mut self, expr: &Expr, interval: Interval) {
        if let Some(key) = key(expr) {
            let known = self.known.entry(key).or_insert(Interval::ALL);
            *known = known.meet(interval);
        }
    }

    /// Takes in what a write to a place may have changed, then knows the new value's interval.
    pub fn write(&mut self, place: &Place, ty: Scalar, value: Interval) {
        let others = self.elements(place);
        self.forget(place);
        // Another element, or the same one by another index.
        for (key, known) in others {
            self.known.insert(key, known.with(value));
        }
        let expr = Expr { ty, kind: ExprKind::Read(place.clone()) };
        // After `a[a[0]] := v` the place `a[a[0]]` may be another one, also if a definition is `a[0]`.
        if let Some(key) = key(&expr).filter(|key| is_element(key, &marker(place))) {
            self.known.insert(key, value);
        }
    }

    /// What is known of the elements of a variable whose indices it does not change.
    fn elements(&self, place: &Place) -> Vec<(String, Interval)> {
        let written = marker(place);
        let known =
            self.known.iter().filter(|(key, _)| key.starts_with(&written) && is_element(key, &written));
        known.map(|(key, known)| (key.clone(), *known)).collect()
    }

    /// Forgets what was known of a variable, and of all definitions: each may read it.
    pub fn forget(&mut self, place: &Place) {
        let written = marker(place);
        let stays = |key: &String| !key.contains(&written) && !key.contains(DEFINITION);
        self.known.retain(|key, _| stays(key));
        self.not_zero.retain(stays);
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

/// What the keys of definitions begin with, and no other key contains.
const DEFINITION: char = 'D';

/// A text that is equal only for expressions of the same value: of what is read, and of numbers computed from it.
pub fn key(expr: &Expr) -> Option<String> {
    let of_two = |sign: &str, a: &Expr, b: &Expr| Some(format!("({sign}{}{})", key(a)?, key(b)?));
    match &expr.kind {
        ExprKind::Read(place) => place_key(place),
        ExprKind::Variable(id) => Some(format!("v{};", id.0)),
        ExprKind::Define(define) => Some(format!("{DEFINITION}{define};")),
        ExprKind::Members(role) => Some(format!("m{};", role.0)),
        ExprKind::Constant(Value::Int(v)) => Some(format!("#{v};")),
        ExprKind::Constant(Value::Real(v)) => Some(format!("#{};", v.to_bits())),
        ExprKind::ToReal(inner) => Some(format!("(r{})", key(inner)?)),
        ExprKind::Negate(inner) => Some(format!("(-{})", key(inner)?)),
        ExprKind::Absolute(inner) => Some(format!("(|{})", key(inner)?)),
        ExprKind::Coordinate(inner, number) => Some(format!("(.{number}{})", key(inner)?)),
        ExprKind::Min(a, b) => of_two("<", a, b),
        ExprKind::Max(a, b) => of_two(">", a, b),
        ExprKind::Binary(operator, a, b) => {
            let sign = match operator {
                Operator::Add => "+",
                Operator::Subtract => "_",
                Operator::Multiply => "*",
                Operator::Divide => "/",
                Operator::Modulo => "%",
                _ => return None,
            };
            of_two(sign, a, b)
        }
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

/// Whether no index in the key of an element of a variable reads the variable itself, or a definition.
fn is_element(key: &str, marker: &str) -> bool {
    key.matches(marker).count() == 1 && !key.contains(DEFINITION)
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

/// What is stored is finite.
fn may_be_nan(expr: &Expr) -> bool {
    let is_finite = match &expr.kind {
        ExprKind::Constant(_) | ExprKind::ToReal(_) => true,
        ExprKind::Read(place) => !matches!(place, Place::Port { .. }),
        _ => false,
    };
    expr.ty == Scalar::Real && !is_finite
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
