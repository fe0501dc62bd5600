//! Expressions: those with loops become statements that come first.

use super::code::{Ex, Stmt, advance, and, assign, binary, name, not, or, real, when, within};
use super::context::{Lowering, Phase};
use super::declaration::Basic;
use super::name::Name;
use super::property::own_stop;
use super::role::Members;
use super::walk;
use super::watchdog;
use crate::ir::{
    Domain, Expr, ExprKind, InterfaceId, Operator, Place, RoleId, Scalar, StateId, Value, VariableId,
};
use runtime_sim::device::PortType;

/// A variable, or an element of an array: where a value is held.
pub struct Spot {
    /// One, or three for a point.
    pub names: Vec<Name>,
    pub index: Option<Ex>,
    /// Bounds to which a latched element is limited when it is read.
    pub limit: Option<(i32, i32)>,
}

impl Spot {
    pub fn target(&self, part: usize) -> Ex {
        match &self.index {
            None => name(&self.names[part]),
            Some(index) => Ex::Element(self.names[part].clone(), Box::new(index.clone())),
        }
    }

    pub fn value(&self, part: usize) -> Ex {
        match self.limit {
            None => self.target(part),
            Some(bounds) => limited(self.target(part), bounds),
        }
    }
}

/// The nearest value within bounds.
pub fn limited(value: Ex, (low, high): (i32, i32)) -> Ex {
    Ex::Call("F_limit", vec![("low", Ex::Int(low)), ("value", value), ("high", Ex::Int(high))])
}

/// Operands of AND.
pub fn conjuncts(expr: &Expr) -> Vec<&Expr> {
    match &expr.kind {
        ExprKind::Binary(Operator::And, a, b) => conjuncts(a).into_iter().chain(conjuncts(b)).collect(),
        _ => vec![expr],
    }
}

impl Lowering<'_> {
    pub fn may_fault(&self, expr: &Expr) -> bool {
        walk::may_fault(&self.system.model, self.automaton(), expr)
    }

    /// The value of an expression that is no point; `before` gets what must be computed first.
    pub fn value(&mut self, expr: &Expr, before: &mut Vec<Stmt>) -> Ex {
        match &expr.kind {
            ExprKind::Constant(Value::Int(i)) => match expr.ty {
                Scalar::Enum(id) => self.member(id, *i),
                _ => Ex::Int(*i),
            },
            ExprKind::Constant(Value::Bool(b)) => Ex::Bool(*b),
            ExprKind::Constant(Value::Real(r)) => Ex::Real(*r),
            ExprKind::Constant(Value::Point(_)) | ExprKind::MakePoint(_) => {
                self.coordinates(expr, before)[0].clone()
            }
            ExprKind::Read(place) => self.spot(place, before).value(0),
            ExprKind::Variable(id) => name(&self.own().variables[id.0]),
            ExprKind::Define(define) => self.define(*define),
            ExprKind::Own(interface) => self.own_row(*interface),
            ExprKind::After(time) => {
                let time = self.value(time, before);
                binary(">=", name("elapsed"), time)
            }
            ExprKind::Done if self.phase == Phase::Guard => name("done"),
            ExprKind::Failed if self.phase == Phase::Guard => name("failed"),
            ExprKind::Done => self.answered("="),
            ExprKind::Failed => self.failed(),
            ExprKind::Permit => name(watchdog::PANEL_PERMIT),
            ExprKind::Stopped => own_stop(),
            ExprKind::InState(states) => {
                let is =
                    |state: &StateId| binary("=", name("state"), Ex::Member(self.state(self.id, state.0)));
                or(states.iter().map(is).collect())
            }
            ExprKind::IsFinite(inner) if inner.ty == Scalar::Point => {
                let coordinates = self.coordinates(inner, before);
                Ex::Call("F_is_finite_point", ["x", "y", "z"].into_iter().zip(coordinates).collect())
            }
            ExprKind::IsFinite(inner) => Ex::Call("F_is_finite", vec![("value", self.value(inner, before))]),
            ExprKind::Not(inner) => not(self.value(inner, before)),
            ExprKind::Negate(inner) => Ex::Minus(Box::new(self.value(inner, before))),
            ExprKind::Binary(operator, a, b) => self.binary(*operator, a, b, before),
            ExprKind::Min(a, b) => self.function(["F_lesser", "F_lesser_real"], a, b, before),
            ExprKind::Max(a, b) => self.function(["F_greater", "F_greater_real"], a, b, before),
            ExprKind::Absolute(inner) => {
                let function = if inner.ty == Scalar::Real { "F_magnitude" } else { "F_absolute" };
                Ex::Call(function, vec![("value", self.value(inner, before))])
            }
            ExprKind::ToReal(inner) => match self.value(inner, before) {
                Ex::Int(i) => Ex::Real(f64::from(i)),
                value => real(value),
            },
            ExprKind::Coordinate(inner, axis) => self.coordinates(inner, before)[*axis].clone(),
            ExprKind::SquaredDistance(a, b) => {
                let from = self.coordinates(a, before);
                let to = self.coordinates(b, before);
                let names = ["from_x", "from_y", "from_z", "to_x", "to_y", "to_z"];
                Ex::Call("F_squared_distance", names.into_iter().zip(from.into_iter().chain(to)).collect())
            }
            ExprKind::Exists { variable, .. } => self.quantified("exists", *variable, expr, before),
            ExprKind::Forall { variable, .. } => self.quantified("all", *variable, expr, before),
            ExprKind::Count { variable, .. } => self.quantified("count", *variable, expr, before),
            ExprKind::Sum { variable, .. } => self.quantified("sum", *variable, expr, before),
            ExprKind::Members(role) => match self.members(self.id, *role) {
                Members::All(n) => Ex::Int(n as i32),
                Members::Listed(_) => name(&self.own().roles[role.0].count),
            },
            ExprKind::IsMember(value, role) => self.is_member(value, *role, before),
            ExprKind::Reaches(relation, from, to) => {
                let rows = &self.system.reaches[relation.0];
                let mut entries = rows.iter().flatten();
                let first = rows.iter().flatten().next().copied().unwrap_or_default();
                if entries.all(|entry| *entry == first) {
                    return Ex::Bool(first);
                }
                let width = rows.first().map_or(0, Vec::len);
                let from = self.value(from, before);
                let to = self.value(to, before);
                let index = within(from, width, to);
                Ex::Element(self.names.relations[relation.0].clone(), Box::new(index))
            }
        }
    }

    /// The coordinates of a point.
    pub fn coordinates(&mut self, expr: &Expr, before: &mut Vec<Stmt>) -> Vec<Ex> {
        match &expr.kind {
            ExprKind::Constant(value) => super::declaration::constants(*value),
            ExprKind::Read(place) => {
                let spot = self.spot(place, before);
                (0..spot.names.len()).map(|part| spot.value(part)).collect()
            }
            ExprKind::Define(define) => {
                let define = &self.automaton().defines[*define];
                self.coordinates(&define.value, before)
            }
            ExprKind::MakePoint(parts) => parts.iter().map(|p| self.value(p, before)).collect(),
            ExprKind::Binary(operator, a, b) => {
                let a = self.coordinates(a, before);
                let b = self.coordinates(b, before);
                let operator = if *operator == Operator::Add { "+" } else { "-" };
                a.into_iter().zip(b).map(|(a, b)| shifted(operator, a, b)).collect()
            }
            ExprKind::Negate(inner) => {
                self.coordinates(inner, before).into_iter().map(|c| Ex::Minus(Box::new(c))).collect()
            }
            _ => vec![self.value(expr, before); 3],
        }
    }

    fn failed(&self) -> Ex {
        or(self.is_interrupted().into_iter().chain([self.answered("<>")]).collect())
    }

    fn answered(&self, operator: &'static str) -> Ex {
        let port = |wanted: &str| {
            let position = self.automaton().device.ports.iter().position(|p| p.name == wanted);
            position.map_or(Ex::Int(0), |p| name(&self.own().ports[p][0]))
        };
        let counts = self.is_abandoned().map(not);
        let answered = [
            binary("<>", port("cmd"), Ex::Int(0)),
            binary("=", port("ack"), port("cmd")),
            binary(operator, port("error"), Ex::Int(0)),
        ];
        and(counts.into_iter().chain(answered).collect())
    }

    /// The variables from which `done` and `failed` are computed.
    pub fn answer_names(&self) -> Vec<Name> {
        let ports = self.automaton().device.ports.iter().zip(&self.own().ports);
        let ports = ports.filter(|(port, _)| ["cmd", "ack", "error"].contains(&port.name.as_str()));
        let locals = self.automaton().abandoned.into_iter().chain(self.automaton().interrupted);
        let locals = locals.map(|local| self.own().locals[local][0].clone());
        ports.map(|(_, held)| held[0].clone()).chain(locals).collect()
    }

    /// Statements that set `done` and `failed`.
    pub fn answer(&mut self) -> [Stmt; 2] {
        [assign("done", self.answered("=")), assign("failed", self.failed())]
    }

    /// A define has its own variable, which is computed once for all that reads it.
    fn define(&mut self, number: usize) -> Ex {
        let define = &self.automaton().defines[number];
        let variable = self.own().defines[number][0].clone();
        if !self.known.contains_key(&number) {
            let mut statements = Vec::new();
            let title = format!("{}   {}", self.definition(define.place), self.line(define.place));
            self.set(&variable, &define.value, &mut statements);
            let mut read = super::code::names(&statements);
            // What the defines among them read, it reads too.
            for (inner, names) in &self.known {
                if read.contains(&self.own().defines[*inner][0]) {
                    read.extend(names.clone());
                }
            }
            self.known.insert(number, read);
            self.hoisted.push(Stmt::Comment(title));
            self.hoisted.extend(statements);
        }
        name(&variable)
    }

    pub fn own_row(&self, interface: InterfaceId) -> Ex {
        let position = self.automaton().implementing(interface);
        position.map_or(Ex::Int(0), |p| name(&self.own().rows[p]))
    }

    fn function(
        &mut self,
        [whole, real]: [&'static str; 2],
        a: &Expr,
        b: &Expr,
        before: &mut Vec<Stmt>,
    ) -> Ex {
        let function = if a.ty == Scalar::Real { real } else { whole };
        let a = self.value(a, before);
        let b = self.value(b, before);
        Ex::Call(function, vec![("a", a), ("b", b)])
    }

    fn binary(&mut self, operator: Operator, a: &Expr, b: &Expr, before: &mut Vec<Stmt>) -> Ex {
        match operator {
            Operator::And => return self.logical(a, b, before, Operator::And),
            Operator::Or => return self.logical(a, b, before, Operator::Or),
            _ => {}
        }
        let left = self.value(a, before);
        let right = self.value(b, before);
        let operator = match operator {
            Operator::Equal | Operator::NotEqual if a.ty == Scalar::Bool => {
                return equal_truth(operator, left, right);
            }
            Operator::Equal => "=",
            Operator::NotEqual => "<>",
            Operator::Less => "<",
            Operator::LessEqual => "<=",
            Operator::Greater => ">",
            Operator::GreaterEqual => ">=",
            Operator::Subtract => "-",
            Operator::Multiply => "*",
            Operator::Divide => "/",
            Operator::Modulo => "MOD",
            Operator::Add | Operator::Or | Operator::And => "+",
        };
        binary(operator, left, right)
    }

    /// Whether a condition does not hold; order of reals is not turned round, because of NaN.
    pub fn contrary(&mut self, expr: &Expr, before: &mut Vec<Stmt>) -> Ex {
        let ExprKind::Binary(operator, a, b) = &expr.kind else { return not(self.value(expr, before)) };
        let turned = match operator {
            Operator::Less => ">=",
            Operator::LessEqual => ">",
            Operator::Greater => "<=",
            Operator::GreaterEqual => "<",
            Operator::And if is_plain(a) && is_plain(b) && !self.may_fault(b) => {
                let a = self.contrary(a, before);
                let b = self.contrary(b, before);
                return or(vec![a, b]);
            }
            _ => return not(self.value(expr, before)),
        };
        if a.ty == Scalar::Real {
            return not(self.value(expr, before));
        }
        let a = self.value(a, before);
        let b = self.value(b, before);
        binary(turned, a, b)
    }

    /// The right side is computed only if the left one does not decide, if that makes a difference.
    fn logical(&mut self, a: &Expr, b: &Expr, before: &mut Vec<Stmt>, operator: Operator) -> Ex {
        let left = self.value(a, before);
        let mut second = Vec::new();
        let right = self.value(b, &mut second);
        let is_and = operator == Operator::And;
        if second.is_empty() && !self.may_fault(b) {
            return if is_and { and(vec![left, right]) } else { or(vec![left, right]) };
        }
        let result = self.temporary("holds", Basic::Bool);
        before.push(assign(&result, left));
        second.push(assign(&result, right));
        let open = if is_and { name(&result) } else { not(name(&result)) };
        before.push(when(open, second));
        name(&result)
    }

    fn quantified(&mut self, word: &str, variable: VariableId, expr: &Expr, before: &mut Vec<Stmt>) -> Ex {
        let purpose = format!("{word}_{}", self.own().variables[variable.0]);
        let target = self.temporary(&purpose, Basic::of(expr.ty));
        self.set(&target, expr, before);
        name(&target)
    }

    /// Stores a value in a variable that the expression does not read.
    pub fn set(&mut self, target: &str, expr: &Expr, out: &mut Vec<Stmt>) {
        match &expr.kind {
            ExprKind::Exists { .. } => {
                out.push(assign(target, Ex::Bool(false)));
                self.search(target, expr, out);
            }
            ExprKind::Forall { .. } => {
                out.push(assign(target, Ex::Bool(true)));
                self.search(target, expr, out);
            }
            ExprKind::Count { variable, domain, body } => {
                out.push(assign(target, Ex::Int(0)));
                self.each(*variable, domain, out, |lowering| {
                    lowering.if_all(&conjuncts(body), vec![advance(target)])
                });
            }
            ExprKind::Sum { variable, domain, body } => {
                out.push(assign(target, Basic::of(expr.ty).zero()));
                self.each(*variable, domain, out, |lowering| {
                    let mut inner = Vec::new();
                    let summand = lowering.value(body, &mut inner);
                    inner.push(assign(target, binary("+", name(target), summand)));
                    inner
                });
            }
            _ => {
                let value = self.value(expr, out);
                out.push(assign(target, value));
            }
        }
    }

    /// The loops of `exists`, which set the target to true, or of `forall`, which set it to false.
    fn search(&mut self, target: &str, expr: &Expr, out: &mut Vec<Stmt>) {
        let (variable, domain, body, sought) = match &expr.kind {
            ExprKind::Exists { variable, domain, body } => (*variable, domain, body, true),
            ExprKind::Forall { variable, domain, body } => (*variable, domain, body, false),
            _ => return,
        };
        let is_nested = match &body.kind {
            ExprKind::Exists { .. } => sought,
            ExprKind::Forall { .. } => !sought,
            _ => false,
        };
        self.each(variable, domain, out, |lowering| {
            let found = vec![assign(target, Ex::Bool(sought)), Stmt::Exit];
            let mut inner = Vec::new();
            if is_nested {
                lowering.search(target, body, &mut inner);
                let is_found = if sought { name(target) } else { not(name(target)) };
                inner.push(when(is_found, vec![Stmt::Exit]));
            } else if sought {
                inner = lowering.if_all(&conjuncts(body), found);
            } else {
                let contrary = lowering.contrary(body, &mut inner);
                inner.extend(guarded(contrary, found));
            }
            inner
        });
    }

    fn is_member(&mut self, value: &Expr, role: RoleId, before: &mut Vec<Stmt>) -> Ex {
        let interface = self.automaton().roles[role.0].interface;
        let value = self.value(value, before);
        match self.members(self.id, role) {
            Members::All(n) if n == self.system.members[interface.0].len() => Ex::Bool(true),
            Members::All(n) => binary("<", value, Ex::Int(n as i32)),
            Members::Listed(most) => {
                let names = &self.own().roles[role.0];
                let result = self.temporary(&format!("in_{}", names.members), Basic::Bool);
                let number = self.temporary("number", Basic::Dint);
                let member = Ex::Element(names.members.clone(), Box::new(name(&number)));
                before.extend([assign(&result, Ex::Bool(false)), assign(&number, Ex::Int(0))]);
                before.push(Stmt::While {
                    condition: binary("<", name(&number), name(&names.count)),
                    body: vec![
                        when(binary("=", member, value), vec![assign(&result, Ex::Bool(true)), Stmt::Exit]),
                        advance(&number),
                    ],
                    most: most as u64,
                });
                name(&result)
            }
        }
    }

    /// `then` if all of these hold, tested from left to right.
    pub fn if_all(&mut self, conditions: &[&Expr], then: Vec<Stmt>) -> Vec<Stmt> {
        let mut group = Vec::new();
        for (i, condition) in conditions.iter().enumerate() {
            let mut before = Vec::new();
            if !group.is_empty() && self.may_fault(condition) {
                let inner = self.if_all(&conditions[i..], then);
                return guarded(and(group), inner);
            }
            let value = self.value(condition, &mut before);
            if before.is_empty() {
                group.push(value);
                continue;
            }
            let rest = self.if_all(&conditions[i + 1..], then);
            before.extend(guarded(value, rest));
            return guarded(and(group), before);
        }
        guarded(and(group), then)
    }

    /// A loop over the values of a domain, in order.
    pub fn each(
        &mut self,
        variable: VariableId,
        domain: &Domain,
        out: &mut Vec<Stmt>,
        body: impl FnOnce(&mut Self) -> Vec<Stmt>,
    ) {
        let counter = self.own().variables[variable.0].clone();
        match domain {
            Domain::Enum(id) => {
                let n = self.system.model.enums[id.0].members.len();
                out.push(assign(&counter, Ex::Int(0)));
                self.count_to(&counter, binary("<", name(&counter), Ex::Int(n as i32)), n as u64, out, body);
            }
            Domain::Range(low, high) => {
                let most = walk::narrowed_count(low, high).unwrap_or(0);
                let first = self.value(low, out);
                let condition = self.in_range(&counter, high, out);
                out.push(assign(&counter, first));
                let is_open = walk::may_be_greatest(&self.system.model, self.automaton(), high);
                self.count_to(&counter, condition, most.max(0) as u64, out, |lowering| {
                    let mut body = body(lowering);
                    if is_open && body.last() != Some(&Stmt::Exit) {
                        let is_greatest = binary("=", name(&counter), Ex::Int(i32::MAX));
                        body.push(when(is_greatest, vec![Stmt::Exit]));
                    }
                    body
                });
            }
            Domain::Role(role) => match self.members(self.id, *role) {
                Members::All(n) => {
                    out.push(assign(&counter, Ex::Int(0)));
                    self.count_to(
                        &counter,
                        binary("<", name(&counter), Ex::Int(n as i32)),
                        n as u64,
                        out,
                        body,
                    );
                }
                Members::Listed(most) => {
                    let names = &self.own().roles[role.0];
                    let number = self.temporary(&format!("{counter}_number"), Basic::Dint);
                    let member = Ex::Element(names.members.clone(), Box::new(name(&number)));
                    out.push(assign(&number, Ex::Int(0)));
                    let condition = binary("<", name(&number), name(&names.count));
                    self.count_to(&number, condition, most as u64, out, |lowering| {
                        [assign(&counter, member)].into_iter().chain(body(lowering)).collect()
                    });
                }
            },
        }
    }

    fn count_to(
        &mut self,
        counter: &str,
        condition: Ex,
        most: u64,
        out: &mut Vec<Stmt>,
        body: impl FnOnce(&mut Self) -> Vec<Stmt>,
    ) {
        let mut body = body(self);
        if body.last() != Some(&Stmt::Exit) {
            body.push(advance(counter));
        }
        out.push(Stmt::While { condition, body, most });
    }

    /// Whether the counter is not behind the end of a range: `i < n` for `i <= n - 1`.
    fn in_range(&mut self, counter: &str, high: &Expr, out: &mut Vec<Stmt>) -> Ex {
        match self.value(high, out) {
            Ex::Int(i) => match i.checked_add(1) {
                Some(end) => binary("<", name(counter), Ex::Int(end)),
                None => binary("<=", name(counter), Ex::Int(i)),
            },
            Ex::Binary("-", a, one) if *one == Ex::Int(1) && matches!(*a, Ex::Name(_)) => {
                binary("<", name(counter), *a)
            }
            simple @ Ex::Name(_) => binary("<=", name(counter), simple),
            other => {
                let last = self.temporary(&format!("{counter}_last"), Basic::Dint);
                out.push(assign(&last, other));
                binary("<=", name(counter), name(&last))
            }
        }
    }

    /// Where a value is held.
    pub fn spot(&mut self, place: &Place, before: &mut Vec<Stmt>) -> Spot {
        let names = self.own();
        match place {
            Place::Local { local, index } => {
                let index = self.index(index, before);
                Spot { names: names.locals[*local].clone(), index, limit: None }
            }
            Place::Parameter { parameter, index } => {
                let index = self.index(index, before);
                Spot { names: names.parameters[*parameter].clone(), index, limit: None }
            }
            Place::Port { port, index } => {
                let device_port = &self.automaton().device.ports[*port];
                let limit = match device_port.ty {
                    PortType::Int { lo, hi } if device_port.extent != runtime_sim::device::Extent::One => {
                        Some((lo, hi))
                    }
                    _ => None,
                };
                let index = self.index(index, before);
                Spot { names: names.ports[*port].clone(), index, limit }
            }
            Place::Cell { interface, cell, of, index } => {
                let row = match of {
                    Some(of) => self.value(of, before),
                    None => self.own_row(*interface),
                };
                let ty = self.system.model.interface(*interface).cells[*cell].ty;
                let index = self.index(index, before);
                let names = self.names.interfaces[interface.0].cells[*cell].clone();
                Spot { names, index: Some(self.in_table(row, ty, index)), limit: None }
            }
            Place::Shown { interface, parameter, of, index } => {
                let row = self.value(of, before);
                let ty = self.system.model.interface(*interface).parameters[*parameter].ty;
                let index = self.index(index, before);
                let names = self.names.interfaces[interface.0].parameters[*parameter].clone();
                Spot { names, index: Some(self.in_table(row, ty, index)), limit: None }
            }
        }
    }

    fn index(&mut self, index: &Option<Box<Expr>>, before: &mut Vec<Stmt>) -> Option<Ex> {
        index.as_ref().map(|i| self.value(i, before))
    }

    /// The index of an element in a table over the rows of an interface.
    pub fn in_table(&self, row: Ex, ty: crate::ir::Type, index: Option<Ex>) -> Ex {
        match index {
            None => row,
            Some(index) => within(row, self.system.model.elements(ty.extent), index),
        }
    }
}

/// Whether an expression is computed without statements before it.
fn is_plain(expr: &Expr) -> bool {
    let is_loop = matches!(
        expr.kind,
        ExprKind::Exists { .. }
            | ExprKind::Forall { .. }
            | ExprKind::Count { .. }
            | ExprKind::Sum { .. }
            | ExprKind::IsMember(..)
            | ExprKind::Define(_)
    );
    !is_loop && expr.parts().all(is_plain)
}

/// Nothing if there is nothing to be done.
pub fn guarded(condition: Ex, then: Vec<Stmt>) -> Vec<Stmt> {
    match condition {
        Ex::Bool(true) => then,
        Ex::Bool(false) => Vec::new(),
        _ if then.is_empty() => then,
        condition => vec![when(condition, then)],
    }
}

/// A coordinate with another one added or taken away. Zero is added once: it changes nothing but -0, and that
/// the first time. Taken away it changes nothing.
fn shifted(operator: &'static str, a: Ex, b: Ex) -> Ex {
    let is_zero = |e: &Ex| matches!(e, Ex::Real(r) if r.to_bits() == 0);
    let has_zero = matches!(&a, Ex::Binary("+", _, tail) if is_zero(tail));
    if is_zero(&b) && (operator == "-" || has_zero) { a } else { binary(operator, a, b) }
}

fn equal_truth(operator: Operator, a: Ex, b: Ex) -> Ex {
    let wanted = operator == Operator::Equal;
    match (a, b) {
        (a, Ex::Bool(truth)) | (Ex::Bool(truth), a) => {
            if truth == wanted {
                a
            } else {
                not(a)
            }
        }
        (a, b) => binary(if wanted { "=" } else { "<>" }, a, b),
    }
}
