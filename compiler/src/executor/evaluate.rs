//! Values of expressions.

use super::Executor;
use crate::ir::{Domain, Expr, ExprKind, Operator, Place, Value, VariableId, less};

impl Executor<'_> {
    /// Whether a condition holds for an instance, in its state of now.
    pub fn holds(&mut self, robot: usize, expr: &Expr) -> bool {
        matches!(self.value(robot, expr), Value::Bool(true))
    }

    fn int(&mut self, robot: usize, expr: &Expr) -> i32 {
        match self.value(robot, expr) {
            Value::Int(i) => i,
            other => unreachable!("a checked whole number is {other:?}"),
        }
    }

    fn real(&mut self, robot: usize, expr: &Expr) -> f64 {
        match self.value(robot, expr) {
            Value::Real(r) => r,
            other => unreachable!("a checked real is {other:?}"),
        }
    }

    fn point(&mut self, robot: usize, expr: &Expr) -> [f64; 3] {
        match self.value(robot, expr) {
            Value::Point(p) => p,
            other => unreachable!("a checked point is {other:?}"),
        }
    }

    /// Whether all elements exist that a fixed expression reads for an instance: those of one that is never evaluated,
    /// because a condition before it does not hold, may not.
    pub fn can_evaluate(&mut self, robot: usize, expr: &Expr) -> bool {
        expr.parts().all(|part| self.can_evaluate(robot, part))
            && match &expr.kind {
                ExprKind::Define(define) => {
                    let system = self.system;
                    self.can_evaluate(robot, &system.automaton_of(robot).defines[*define].value)
                }
                ExprKind::Read(Place::Parameter { parameter, index: Some(index) }) => {
                    let count = self.system.instances[robot].parameters[*parameter].len();
                    usize::try_from(self.int(robot, index)).is_ok_and(|index| index < count)
                }
                _ => true,
            }
    }

    /// What an expression is for an instance, in its state of now.
    pub fn value(&mut self, robot: usize, expr: &Expr) -> Value {
        match &expr.kind {
            ExprKind::Constant(value) => *value,
            ExprKind::Read(place) => self.read(robot, place),
            ExprKind::Variable(id) => self.robots[robot].variables[id.0],
            ExprKind::Define(define) => {
                let system = self.system;
                self.value(robot, &system.automaton_of(robot).defines[*define].value)
            }
            ExprKind::Own(interface) => {
                let position = self.system.automaton_of(robot).implementing(*interface);
                Value::Int(position.map_or(0, |p| self.system.instances[robot].rows[p]) as i32)
            }
            ExprKind::After(time) => Value::Bool(self.robots[robot].elapsed >= self.int(robot, time)),
            ExprKind::Done => Value::Bool(self.answered(robot) && self.port_of(robot, "error") == 0),
            ExprKind::Failed => Value::Bool(
                self.is_interrupted(robot) || self.answered(robot) && self.port_of(robot, "error") != 0,
            ),
            ExprKind::Permit => Value::Bool(self.permit),
            ExprKind::Stopped => Value::Bool(self.robots[robot].stopped),
            ExprKind::InState(states) => {
                Value::Bool(states.iter().any(|state| state.0 == self.robots[robot].state))
            }
            ExprKind::IsFinite(inner) => Value::Bool(match self.value(robot, inner) {
                Value::Real(r) => r.is_finite(),
                Value::Point(p) => p.iter().all(|coordinate| coordinate.is_finite()),
                Value::Bool(_) | Value::Int(_) => true,
            }),
            ExprKind::Not(inner) => Value::Bool(!self.holds(robot, inner)),
            ExprKind::Negate(inner) => match self.value(robot, inner) {
                Value::Int(i) => Value::Int(-i),
                Value::Real(r) => Value::Real(-r),
                other => other,
            },
            ExprKind::Binary(operator, left, right) => self.binary(robot, *operator, left, right),
            ExprKind::Min(a, b) => {
                let (a, b) = (self.value(robot, a), self.value(robot, b));
                if less(b, a) { b } else { a }
            }
            ExprKind::Max(a, b) => {
                let (a, b) = (self.value(robot, a), self.value(robot, b));
                if less(a, b) { b } else { a }
            }
            ExprKind::Absolute(inner) => match self.value(robot, inner) {
                Value::Int(i) => Value::Int(i.abs()),
                Value::Real(r) => Value::Real(r.abs()),
                other => other,
            },
            ExprKind::ToReal(inner) => Value::Real(f64::from(self.int(robot, inner))),
            ExprKind::MakePoint(parts) => Value::Point([
                self.real(robot, &parts[0]),
                self.real(robot, &parts[1]),
                self.real(robot, &parts[2]),
            ]),
            ExprKind::Coordinate(inner, axis) => Value::Real(self.point(robot, inner)[*axis]),
            ExprKind::SquaredDistance(a, b) => {
                let (p, q) = (self.point(robot, a), self.point(robot, b));
                let (dx, dy, dz) = (p[0] - q[0], p[1] - q[1], p[2] - q[2]);
                Value::Real(dx * dx + dy * dy + dz * dz)
            }
            ExprKind::Exists { variable, domain, body } => Value::Bool(
                self.candidates(robot, domain)
                    .into_iter()
                    .any(|v| self.bound(robot, *variable, v, body) == Value::Bool(true)),
            ),
            ExprKind::Forall { variable, domain, body } => Value::Bool(
                self.candidates(robot, domain)
                    .into_iter()
                    .all(|v| self.bound(robot, *variable, v, body) == Value::Bool(true)),
            ),
            ExprKind::Count { variable, domain, body } => {
                let found = self
                    .candidates(robot, domain)
                    .into_iter()
                    .filter(|v| self.bound(robot, *variable, *v, body) == Value::Bool(true));
                Value::Int(found.count() as i32)
            }
            ExprKind::Sum { variable, domain, body } => {
                let is_real = expr.ty == crate::ir::Scalar::Real;
                let (mut whole, mut real) = (0, 0.0);
                for v in self.candidates(robot, domain) {
                    match self.bound(robot, *variable, v, body) {
                        Value::Int(i) => whole += i,
                        Value::Real(r) => real += r,
                        other => unreachable!("a checked summand is {other:?}"),
                    }
                }
                if is_real { Value::Real(real) } else { Value::Int(whole) }
            }
            ExprKind::Members(role) => Value::Int(self.system.instances[robot].roles[role.0].len() as i32),
            ExprKind::IsMember(value, role) => {
                let row = self.int(robot, value) as usize;
                Value::Bool(self.system.instances[robot].roles[role.0].contains(&row))
            }
            ExprKind::Reaches(relation, from, to) => {
                let (from, to) = (self.int(robot, from) as usize, self.int(robot, to) as usize);
                Value::Bool(self.system.reaches[relation.0][from][to])
            }
        }
    }

    fn bound(&mut self, robot: usize, variable: VariableId, value: Value, body: &Expr) -> Value {
        self.robots[robot].variables[variable.0] = value;
        self.value(robot, body)
    }

    /// The values of a domain in order.
    pub(crate) fn candidates(&mut self, robot: usize, domain: &Domain) -> Vec<Value> {
        match domain {
            Domain::Role(role) => {
                self.system.instances[robot].roles[role.0].iter().map(|row| Value::Int(*row as i32)).collect()
            }
            Domain::Enum(id) => {
                (0..self.system.model.enums[id.0].members.len() as i32).map(Value::Int).collect()
            }
            Domain::Range(low, high) => {
                let (low, high) = (self.int(robot, low), self.int(robot, high));
                (low..=high).map(Value::Int).collect()
            }
        }
    }

    fn binary(&mut self, robot: usize, operator: Operator, left: &Expr, right: &Expr) -> Value {
        match operator {
            Operator::And => return Value::Bool(self.holds(robot, left) && self.holds(robot, right)),
            Operator::Or => return Value::Bool(self.holds(robot, left) || self.holds(robot, right)),
            _ => {}
        }
        let (a, b) = (self.value(robot, left), self.value(robot, right));
        let value = operator.apply(a, b);
        value.unwrap_or_else(|| unreachable!("checked operands are {a:?} {operator:?} {b:?}"))
    }

    pub(super) fn read(&mut self, robot: usize, place: &Place) -> Value {
        match place {
            Place::Local { local, index } => {
                let index = self.element_of(robot, index);
                self.robots[robot].locals[*local][index]
            }
            Place::Port { port, index } => {
                let index = self.element_of(robot, index);
                self.robots[robot].ports[*port][index]
            }
            Place::Parameter { parameter, index } => {
                let index = self.element_of(robot, index);
                self.system.instances[robot].parameters[*parameter][index]
            }
            Place::Cell { interface, cell, of, index } => {
                let row = self.row_of(robot, *interface, of);
                let index = self.element_of(robot, index);
                self.cells[interface.0][row][*cell][index]
            }
            Place::Shown { interface, parameter, of, index } => {
                let row = self.int(robot, of) as usize;
                let index = self.element_of(robot, index);
                self.system.shown(*interface, row, *parameter)[index]
            }
        }
    }

    /// The row of the instance that `of` refers to: this one if there is none.
    pub(crate) fn row_of(
        &mut self,
        robot: usize,
        interface: crate::ir::InterfaceId,
        of: &Option<Box<Expr>>,
    ) -> usize {
        match of {
            Some(expr) => self.int(robot, expr) as usize,
            None => {
                let position = self.system.automaton_of(robot).implementing(interface);
                position.map_or(0, |p| self.system.instances[robot].rows[p])
            }
        }
    }

    pub(crate) fn element_of(&mut self, robot: usize, index: &Option<Box<Expr>>) -> usize {
        index.as_ref().map_or(0, |e| self.int(robot, e) as usize)
    }

    /// The device has ended the last command.
    fn answered(&self, robot: usize) -> bool {
        let command = self.port_of(robot, "cmd");
        !self.is_abandoned(robot) && command != 0 && self.port_of(robot, "ack") == command
    }

    /// Whether a port of type `bool` is there and true.
    pub(crate) fn is_true(&self, robot: usize, name: &str) -> bool {
        let ports = &self.system.automaton_of(robot).device.ports;
        let found = ports.iter().position(|port| port.name == name);
        found.is_some_and(|port| self.robots[robot].ports[port][0] == Value::Bool(true))
    }

    pub(crate) fn port_of(&self, robot: usize, name: &str) -> i32 {
        let ports = &self.system.automaton_of(robot).device.ports;
        match ports.iter().position(|p| p.name == name).map(|p| self.robots[robot].ports[p][0]) {
            Some(Value::Int(i)) => i,
            _ => 0,
        }
    }
}
