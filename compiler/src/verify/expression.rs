//! Expressions of one instance: names become places in the state, and what the layout fixes becomes numbers.

use super::automaton::Instance;
use super::plant::Signal;
use crate::ir::{self, Domain, Expr, ExprKind, Operator, Place, Scalar, Value};
use autogen_search::plant::{phase, status};
use autogen_search::program::{Domain as Values, Operator as Op};
use autogen_search::program::{Each, Elements, Int, PointValue, Real};
use autogen_search::value::Var;
use runtime_sim::device::PortType;
use std::sync::Arc;

/// What stands where a name is read: a place in the state of each element, or values that never change.
pub enum Stored {
    Vars(Vec<Var>, i32),
    Fixed(Vec<Value>),
    Signal(Signal),
}

impl Instance<'_> {
    pub fn int(&mut self, expr: &Expr) -> Int {
        let pair = |this: &mut Self, a: &Expr, b: &Expr| Box::new([this.int(a), this.int(b)]);
        match &expr.kind {
            ExprKind::Constant(value) => Int::Constant(whole(*value)),
            ExprKind::Read(place) => {
                let set = self.read_int(place);
                self.whole_put_out(place, set)
            }
            ExprKind::Variable(variable) => match self.fixed_variables.get(&variable.0) {
                Some(value) => Int::Constant(*value),
                None => Int::Variable(variable.0),
            },
            ExprKind::Define(define) => self.define(*define),
            ExprKind::Own(interface) => Int::Constant(self.own_row(*interface) as i32),
            ExprKind::After(time) => self.after(time),
            ExprKind::Done => self.answer(status::DONE),
            ExprKind::Failed => self.answer(status::FAILED),
            ExprKind::Permit | ExprKind::Stopped | ExprKind::InState(_) | ExprKind::IsFinite(_) => {
                unreachable!("only operating modes ask for this, and they are not searched")
            }
            ExprKind::Not(a) => Int::Not(Box::new(self.int(a))),
            ExprKind::Negate(a) => Int::Negate(Box::new(self.int(a))),
            ExprKind::Absolute(a) => Int::Absolute(Box::new(self.int(a))),
            ExprKind::Min(a, b) => Int::Min(pair(self, a, b)),
            ExprKind::Max(a, b) => Int::Max(pair(self, a, b)),
            ExprKind::Binary(Operator::And, a, b) => all(vec![self.int(a), self.int(b)]),
            ExprKind::Binary(Operator::Or, a, b) => any(vec![self.int(a), self.int(b)]),
            ExprKind::Binary(operator, a, b) => match a.ty {
                Scalar::Real => Int::CompareReals(op(*operator), Box::new([self.real(a), self.real(b)])),
                Scalar::Point => Int::ComparePoints(op(*operator), Box::new([self.point(a), self.point(b)])),
                _ => binary(op(*operator), self.int(a), self.int(b)),
            },
            ExprKind::Exists { variable, domain, body } => match self.unrolled(variable.0, domain, body) {
                Some(parts) => any(parts),
                None => Int::Exists(self.each(variable.0, domain, |this| this.int(body))),
            },
            ExprKind::Forall { variable, domain, body } => match self.unrolled(variable.0, domain, body) {
                Some(parts) => all(parts),
                None => Int::ForAll(self.each(variable.0, domain, |this| this.int(body))),
            },
            ExprKind::Count { variable, domain, body } => match self.unrolled(variable.0, domain, body) {
                Some(parts) => Int::Total(parts.into()),
                None => Int::Count(self.each(variable.0, domain, |this| this.int(body))),
            },
            ExprKind::Sum { variable, domain, body } => match self.unrolled(variable.0, domain, body) {
                Some(parts) => Int::Total(parts.into()),
                None => Int::Sum(self.each(variable.0, domain, |this| this.int(body))),
            },
            ExprKind::Members(role) => Int::Constant(self.role(*role).len() as i32),
            ExprKind::IsMember(value, role) => {
                let members = self.role(*role).iter().map(|row| *row as i32).collect();
                Int::OneOf(members, Box::new(self.int(value)))
            }
            ExprKind::Reaches(relation, from, to) => {
                let table = &self.line.system.reaches[relation.0];
                let width = table.first().map_or(0, Vec::len);
                let flat: Arc<[i32]> = table.iter().flatten().map(|reaches| i32::from(*reaches)).collect();
                let (from, to) = (self.int(from), self.int(to));
                match at(from, width, to) {
                    Int::Constant(index) => Int::Constant(element(&flat, index).unwrap_or(0)),
                    index => Int::Table(flat, Box::new(index)),
                }
            }
            ExprKind::MakePoint(_)
            | ExprKind::Coordinate(..)
            | ExprKind::SquaredDistance(..)
            | ExprKind::ToReal(_) => unreachable!("a checked whole number is no {:?}", expr.ty),
        }
    }

    pub fn real(&mut self, expr: &Expr) -> Real {
        let pair = |this: &mut Self, a: &Expr, b: &Expr| Box::new([this.real(a), this.real(b)]);
        match &expr.kind {
            ExprKind::Constant(Value::Real(value)) => Real::Constant(*value),
            ExprKind::Constant(value) => Real::Constant(f64::from(whole(*value))),
            ExprKind::Read(place) => match self.stored(place) {
                (Stored::Vars(vars, _), index) => {
                    let set = match index {
                        Int::Constant(index) => element(&vars, index).map_or(Real::Constant(0.0), Real::Load),
                        index => Real::Element(vars.into(), Box::new(index)),
                    };
                    self.real_put_out(place, set)
                }
                (Stored::Fixed(values), index) => match index {
                    Int::Constant(index) => Real::Constant(element(&values, index).map_or(0.0, real)),
                    index => Real::Table(values.into_iter().map(real).collect(), Box::new(index)),
                },
                (Stored::Signal(_), _) => {
                    self.refuse(place);
                    Real::Constant(0.0)
                }
            },
            ExprKind::Define(define) => {
                let value = &self.automaton.defines[*define].value;
                self.real(value)
            }
            ExprKind::ToReal(a) => Real::OfInt(Box::new(self.int(a))),
            ExprKind::Negate(a) => Real::Negate(Box::new(self.real(a))),
            ExprKind::Absolute(a) => Real::Absolute(Box::new(self.real(a))),
            ExprKind::Min(a, b) => Real::Min(pair(self, a, b)),
            ExprKind::Max(a, b) => Real::Max(pair(self, a, b)),
            ExprKind::Binary(operator, a, b) => Real::Binary(op(*operator), pair(self, a, b)),
            ExprKind::Coordinate(a, axis) => Real::Coordinate(Box::new(self.point(a)), *axis),
            ExprKind::SquaredDistance(a, b) => {
                Real::SquaredDistance(Box::new([self.point(a), self.point(b)]))
            }
            ExprKind::Sum { variable, domain, body } => {
                Real::Sum(self.each(variable.0, domain, |this| this.real(body)))
            }
            other => unreachable!("a checked real is {other:?}"),
        }
    }

    pub fn point(&mut self, expr: &Expr) -> PointValue {
        match &expr.kind {
            ExprKind::Constant(Value::Point(point)) => PointValue::Constant(*point),
            ExprKind::Read(place) => match self.stored(place) {
                (Stored::Vars(vars, _), index) => match index {
                    Int::Constant(index) => {
                        element(&vars, index).map_or(PointValue::Constant([0.0; 3]), PointValue::Load)
                    }
                    index => PointValue::Element(vars.into(), Box::new(index)),
                },
                (Stored::Fixed(values), index) => points(values.into_iter().map(point).collect(), index),
                (Stored::Signal(Signal::At(var)), _) => PointValue::Load(var),
                (Stored::Signal(Signal::Position), _) => {
                    self.asks_inputs = true;
                    PointValue::Position(self.number)
                }
                (Stored::Signal(Signal::Found(found)), index) => points(found, index),
                (Stored::Signal(_), _) => {
                    self.refuse(place);
                    PointValue::Constant([0.0; 3])
                }
            },
            ExprKind::Define(define) => {
                let value = &self.automaton.defines[*define].value;
                self.point(value)
            }
            ExprKind::MakePoint(parts) => {
                let [x, y, z] = &**parts;
                PointValue::Make(Box::new([self.real(x), self.real(y), self.real(z)]))
            }
            ExprKind::Binary(operator, a, b) => {
                let pair = Box::new([self.point(a), self.point(b)]);
                match operator {
                    Operator::Add => PointValue::Add(pair),
                    _ => PointValue::Subtract(pair),
                }
            }
            other => unreachable!("a checked point is {other:?}"),
        }
    }

    fn each<T>(
        &mut self,
        variable: usize,
        domain: &Domain,
        body: impl FnOnce(&mut Self) -> T,
    ) -> Box<Each<T>> {
        let domain = self.domain(domain);
        Box::new(Each { variable, domain, body: body(self) })
    }

    /// The body for each value of a domain that the layout fixes, unless that is too much text.
    fn unrolled(&mut self, variable: usize, domain: &Domain, body: &Expr) -> Option<Vec<Int>> {
        let values: Vec<i32> = match self.domain(domain) {
            Values::List(values) => values.to_vec(),
            Values::Range(ends) => match *ends {
                [Int::Constant(low), Int::Constant(high)] => (low..=high).take(MOST_PARTS + 1).collect(),
                _ => return None,
            },
        };
        if values.len() * self.copies > MOST_PARTS {
            return None;
        }
        let copies = self.copies;
        self.copies *= values.len().max(1);
        let parts = values.into_iter().map(|value| {
            self.fixed_variables.insert(variable, value);
            self.int(body)
        });
        let parts = parts.collect();
        self.fixed_variables.remove(&variable);
        self.copies = copies;
        Some(parts)
    }

    pub fn domain(&mut self, domain: &Domain) -> Values {
        match domain {
            Domain::Role(role) => Values::List(self.role(*role).iter().map(|row| *row as i32).collect()),
            Domain::Enum(id) => {
                Values::List((0..self.line.system.model.enums[id.0].members.len() as i32).collect())
            }
            Domain::Range(low, high) => Values::Range(Box::new([self.int(low), self.int(high)])),
        }
    }

    fn read_int(&mut self, place: &Place) -> Int {
        match self.stored(place) {
            (Stored::Vars(vars, low), Int::Constant(index)) => {
                element(&vars, index).map_or(Int::Constant(0), |var| Int::Load(var, low))
            }
            (Stored::Vars(vars, low), index) => {
                Int::Element(Arc::new(Elements { vars, low }), Box::new(index))
            }
            (Stored::Fixed(values), Int::Constant(index)) => {
                Int::Constant(element(&values, index).map_or(0, whole))
            }
            (Stored::Fixed(values), index) => {
                Int::Table(values.into_iter().map(whole).collect(), Box::new(index))
            }
            (Stored::Signal(signal), index) => self.signal(place, signal, index),
        }
    }

    fn signal(&mut self, place: &Place, signal: Signal, index: Int) -> Int {
        match (signal, index) {
            (Signal::Fixed(value), _) => self.latched(place, Int::Constant(value), [value; 2]),
            (Signal::Free(inputs), index) => {
                self.asks_inputs = true;
                match index {
                    Int::Constant(index) => element(&inputs, index).map_or(Int::Constant(0), Int::Input),
                    index => Int::InputElement(inputs.into(), Box::new(index)),
                }
            }
            (Signal::Held(var), _) => Int::Load(var, 0),
            (Signal::Is(var, value), _) => {
                Int::Binary(Op::Equal, Box::new([Int::Load(var, 0), Int::Constant(value)]))
            }
            (Signal::Moves(motion, shown), _) => {
                let is = |operator, var, value| {
                    Int::Binary(operator, Box::new([Int::Load(var, 0), Int::Constant(value)]))
                };
                let moves = is(Op::NotEqual, motion, 0);
                let Some(shown) = shown else { return moves };
                // The state behind a scan with a command does not tell what was shown in it.
                self.asks_inputs = true;
                any(vec![is(Op::Equal, shown, 2), all(vec![is(Op::Equal, shown, 0), moves])])
            }
            (Signal::AtStop, _) => {
                self.asks_inputs = true;
                let stops = self.machine().route.as_ref().map_or(0, |route| route.stops.len());
                self.latched(place, Int::AtStop(self.number), [-1, stops as i32 - 1])
            }
            (Signal::IsOpen, _) => self.is_open(),
            (Signal::Parts, index) => {
                let Some(desk) = self.machine().desk.clone() else { return Int::Constant(0) };
                let parts = self.line.plant.scenario.orders.iter().flat_map(|order| &order.parts);
                let mut parts: Vec<i32> = parts.map(|count| *count as i32).collect();
                let kinds = self.line.plant.kinds.len();
                if parts.is_empty() {
                    parts = vec![0; kinds];
                }
                let most = parts.iter().copied().max().unwrap_or(0);
                let parts = Int::Table(parts.into(), Box::new(at(Int::Load(desk.order, 0), kinds, index)));
                let parts = Int::Binary(Op::Multiply, Box::new([self.is_open(), parts]));
                self.latched(place, parts, [0, most])
            }
            (Signal::OrderNumber, _) => {
                let Some(desk) = self.machine().desk.clone() else { return Int::Constant(0) };
                let number = Int::Binary(Op::Multiply, Box::new([self.is_open(), Int::Load(desk.order, 1)]));
                self.latched(place, number, [0, self.line.plant.scenario.orders.len() as i32])
            }
            (Signal::Error, _) => match self.machine().head.as_ref().and_then(|head| head.error) {
                Some(port) => Int::Load(port, 0),
                None => Int::Constant(0),
            },
            (Signal::Unbounded | Signal::At(_) | Signal::Position | Signal::Found(_), _) => {
                self.refuse(place);
                Int::Constant(0)
            }
        }
    }

    /// What a port shows of a number that is one of these: the nearest number within its bounds.
    fn latched(&self, place: &Place, value: Int, [least, most]: [i32; 2]) -> Int {
        let Place::Port { port, .. } = place else { return value };
        let PortType::Int { lo, hi } = self.automaton.device.ports[*port].ty else { return value };
        let value = if most > hi { Int::Min(Box::new([value, Int::Constant(hi)])) } else { value };
        if least < lo { Int::Max(Box::new([value, Int::Constant(lo)])) } else { value }
    }

    fn is_open(&self) -> Int {
        let Some(desk) = &self.machine().desk else { return Int::Constant(0) };
        Int::OneOf([phase::OPEN, phase::TAKEN].into(), Box::new(Int::Load(desk.phase, 0)))
    }

    fn answer(&self, wanted: i32) -> Int {
        let Some(head) = &self.machine().head else { return Int::Constant(0) };
        Int::Binary(Op::Equal, Box::new([Int::Load(head.status, 0), Int::Constant(wanted)]))
    }

    /// What stands at a place, and which element of it is meant.
    pub fn stored(&mut self, place: &Place) -> (Stored, Int) {
        match place {
            Place::Local { local, index } => {
                let (vars, low) = self.line.locals[self.number][*local].clone();
                (Stored::Vars(vars, low), self.element(index))
            }
            Place::Cell { interface, cell, of, index } => {
                let rows = &self.line.cells[interface.0];
                let elements = rows.first().map_or(1, |row| row[*cell].0.len());
                let low = rows.first().map_or(0, |row| row[*cell].1);
                let vars = rows.iter().flat_map(|row| row[*cell].0.clone()).collect();
                let row = match of {
                    Some(of) => self.int(of),
                    None => Int::Constant(self.own_row(*interface) as i32),
                };
                (Stored::Vars(vars, low), at(row, elements, self.element(index)))
            }
            Place::Port { port, index } => (self.port(*port), self.element(index)),
            Place::Parameter { parameter, index } => {
                let values = self.instance().parameters[*parameter].clone();
                (Stored::Fixed(values), self.element(index))
            }
            Place::Shown { interface, parameter, of, index } => {
                let system = self.line.system;
                let rows = 0..system.members[interface.0].len();
                let values: Vec<&[Value]> =
                    rows.map(|row| system.shown(*interface, row, *parameter)).collect();
                let elements = values.first().map_or(1, |values| values.len());
                let row = self.int(of);
                (Stored::Fixed(values.concat()), at(row, elements, self.element(index)))
            }
        }
    }

    pub fn element(&mut self, index: &Option<Box<Expr>>) -> Int {
        index.as_ref().map_or(Int::Constant(0), |index| self.int(index))
    }
}

/// Copies of an expression that stand for one with a variable, at most.
const MOST_PARTS: usize = 256;

fn all(parts: Vec<Int>) -> Int {
    let mut kept = Vec::new();
    for part in parts {
        match part {
            Int::Constant(0) => return Int::Constant(0),
            Int::Constant(_) => {}
            Int::And(inner) => kept.extend(inner),
            part => kept.push(part),
        }
    }
    match kept.len() {
        0 => Int::Constant(1),
        1 => kept.remove(0),
        _ => Int::And(kept.into()),
    }
}

fn any(parts: Vec<Int>) -> Int {
    let mut kept = Vec::new();
    for part in parts {
        match part {
            Int::Constant(0) => {}
            // What stands before it has no effect.
            Int::Constant(_) => return Int::Constant(1),
            Int::Or(inner) => kept.extend(inner),
            part => kept.push(part),
        }
    }
    match kept.len() {
        0 => Int::Constant(0),
        1 => kept.remove(0),
        _ => Int::Or(kept.into()),
    }
}

fn binary(operator: Op, a: Int, b: Int) -> Int {
    match (operator, &a, &b) {
        (Op::Equal, Int::Constant(a), Int::Constant(b)) => Int::Constant(i32::from(a == b)),
        (Op::NotEqual, Int::Constant(a), Int::Constant(b)) => Int::Constant(i32::from(a != b)),
        (Op::Add, Int::Constant(a), Int::Constant(b)) => Int::Constant(a.wrapping_add(*b)),
        (Op::Subtract, Int::Constant(a), Int::Constant(b)) => Int::Constant(a.wrapping_sub(*b)),
        // A number as the state holds it.
        (Op::Equal | Op::NotEqual, Int::Load(var, low), Int::Constant(value)) => {
            let pair = Box::new([Int::Load(*var, 0), Int::Constant(value.wrapping_sub(*low))]);
            Int::Binary(operator, pair)
        }
        _ => Int::Binary(operator, Box::new([a, b])),
    }
}

/// The element of this number; none where it is never read, because a condition before it does not hold.
fn element<T: Copy>(values: &[T], index: i32) -> Option<T> {
    usize::try_from(index).ok().and_then(|index| values.get(index).copied())
}

/// The number of an element in a row of a table.
fn at(row: Int, elements: usize, element: Int) -> Int {
    match (row, element) {
        (Int::Constant(row), Int::Constant(element)) => {
            Int::Constant(row.wrapping_mul(elements as i32).wrapping_add(element))
        }
        (row, element) => {
            let begin = match row {
                Int::Constant(row) => Int::Constant(row.wrapping_mul(elements as i32)),
                row if elements == 1 => row,
                row => Int::Binary(Op::Multiply, Box::new([row, Int::Constant(elements as i32)])),
            };
            match (begin, element) {
                (begin, Int::Constant(0)) => begin,
                (Int::Constant(0), element) => element,
                (begin, element) => Int::Binary(Op::Add, Box::new([begin, element])),
            }
        }
    }
}

fn points(points: Vec<[f64; 3]>, index: Int) -> PointValue {
    match index {
        Int::Constant(index) => PointValue::Constant(element(&points, index).unwrap_or_default()),
        index => PointValue::Table(points.into(), Box::new(index)),
    }
}

pub fn whole(value: Value) -> i32 {
    match value {
        Value::Bool(b) => i32::from(b),
        Value::Int(i) => i,
        other => unreachable!("a checked whole number is {other:?}"),
    }
}

fn real(value: Value) -> f64 {
    match value {
        Value::Real(r) => r,
        other => f64::from(whole(other)),
    }
}

fn point(value: Value) -> [f64; 3] {
    match value {
        Value::Point(p) => p,
        other => unreachable!("a checked point is {other:?}"),
    }
}

fn op(operator: ir::Operator) -> Op {
    match operator {
        Operator::Equal => Op::Equal,
        Operator::NotEqual => Op::NotEqual,
        Operator::Less => Op::Less,
        Operator::LessEqual => Op::LessEqual,
        Operator::Greater => Op::Greater,
        Operator::GreaterEqual => Op::GreaterEqual,
        Operator::Add => Op::Add,
        Operator::Subtract => Op::Subtract,
        Operator::Multiply => Op::Multiply,
        Operator::Divide => Op::Divide,
        Operator::Modulo => Op::Modulo,
        Operator::And | Operator::Or => unreachable!("both are decided from left to right"),
    }
}
