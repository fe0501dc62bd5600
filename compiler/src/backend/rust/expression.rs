//! Expressions.

use super::context::Context;
use super::walk::Uses;
use crate::ir::{Domain, Expr, ExprKind, InterfaceId, Operator, Place, Scalar, Value, VariableId};
use runtime_sim::device::Direction;

/// How tightly the outermost operator of a text binds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Cast,
    Or,
    And,
    Comparison,
    Sum,
    Product,
    Unary,
    Primary,
}

struct Code {
    text: String,
    level: Level,
}

/// A condition by itself, and as an operand of `&&`.
#[derive(Clone)]
pub struct Condition {
    pub alone: String,
    operand: String,
}

impl Condition {
    pub fn new(text: String) -> Self {
        Self { alone: text.clone(), operand: text }
    }
}

/// All of them together; `None` if there are none.
pub fn all(conditions: &[Condition]) -> Option<String> {
    match conditions {
        [] => None,
        [one] => Some(one.alone.clone()),
        many => Some(many.iter().map(|c| c.operand.as_str()).collect::<Vec<_>>().join(" && ")),
    }
}

impl Code {
    fn primary(text: impl Into<String>) -> Self {
        Self { text: text.into(), level: Level::Primary }
    }

    /// In brackets unless it binds at least so tightly.
    fn at(self, level: Level) -> String {
        if self.level >= level { self.text } else { format!("({})", self.text) }
    }
}

impl Context<'_> {
    pub fn expr(&self, expr: &Expr) -> String {
        self.code(expr).text
    }

    /// Unless it is always true.
    pub fn condition(&self, expr: &Expr) -> Option<Condition> {
        let alone = self.expr(expr);
        (alone != "true").then(|| Condition { alone, operand: self.code(expr).at(Level::And) })
    }

    fn code(&self, expr: &Expr) -> Code {
        match &expr.kind {
            ExprKind::Constant(value) => constant(self.value(expr.ty, *value)),
            ExprKind::Read(place) => Code::primary(self.place(place)),
            ExprKind::Variable(id) => Code::primary(self.variable(*id)),
            ExprKind::Define(define) => {
                let uses = Uses::of_expr(self.automaton(), &self.automaton().defines[*define].value);
                Code::primary(format!("self.{}({})", self.own().defines[*define], self.arguments(&uses)))
            }
            ExprKind::Own(interface) => Code::primary(self.own_row(*interface)),
            ExprKind::After(time) => compared("self.elapsed".into(), ">=", self.code(time).at(Level::Sum)),
            ExprKind::Done => Code::primary("self.command_done()"),
            ExprKind::Failed => Code::primary("self.command_failed()"),
            ExprKind::Permit => Code::primary("permit"),
            ExprKind::Stopped => Code::primary("self.stopped"),
            ExprKind::InState(states) => {
                let names = states.iter().map(|state| format!("State::{}", self.own().states[state.0]));
                let names: Vec<String> = names.collect();
                Code::primary(format!("matches!(self.state, {})", names.join(" | ")))
            }
            ExprKind::IsFinite(inner) => {
                Code::primary(format!("{}.is_finite()", self.code(inner).at(Level::Primary)))
            }
            ExprKind::Not(inner) => {
                Code { text: format!("!{}", self.code(inner).at(Level::Unary)), level: Level::Unary }
            }
            ExprKind::Negate(inner) => {
                Code { text: format!("-{}", self.code(inner).at(Level::Primary)), level: Level::Unary }
            }
            ExprKind::Binary(operator, a, b) => self.binary(*operator, a, b),
            ExprKind::Min(a, b) => self.extreme(expr.ty, ["i32::min", "lesser"], a, b),
            ExprKind::Max(a, b) => self.extreme(expr.ty, ["i32::max", "greater"], a, b),
            ExprKind::Absolute(inner) => {
                let ty = if expr.ty == Scalar::Real { "f64" } else { "i32" };
                Code::primary(format!("{ty}::abs({})", self.expr(inner)))
            }
            ExprKind::ToReal(inner) => Code::primary(format!("f64::from({})", self.expr(inner))),
            ExprKind::MakePoint(parts) => {
                let [x, y, z] = &**parts;
                Code::primary(format!("Point::new({}, {}, {})", self.expr(x), self.expr(y), self.expr(z)))
            }
            ExprKind::Coordinate(inner, axis) => {
                let axis = ["x", "y", "z"][*axis];
                Code::primary(format!("{}.{axis}", self.code(inner).at(Level::Primary)))
            }
            ExprKind::SquaredDistance(a, b) => Code::primary(format!(
                "{}.squared_distance({})",
                self.code(a).at(Level::Primary),
                self.expr(b)
            )),
            ExprKind::Exists { variable, domain, body } => self.quantified("any", *variable, domain, body),
            ExprKind::Forall { variable, domain, body } => self.quantified("all", *variable, domain, body),
            ExprKind::Count { variable, domain, body } => {
                let parameter = self.parameter(*variable, domain, body);
                let reference = if parameter == "_" { parameter } else { format!("&{parameter}") };
                let text = format!(
                    "{}.filter(|{reference}| {}).count() as i32",
                    self.iterator(domain),
                    self.expr(body)
                );
                Code { text, level: Level::Cast }
            }
            ExprKind::Sum { variable, domain, body } => {
                let parameter = self.parameter(*variable, domain, body);
                let zero = if expr.ty == Scalar::Real { "0.0" } else { "0" };
                let summand = self.code(body).at(Level::Product);
                Code::primary(format!(
                    "{}.fold({zero}, |sum, {parameter}| sum + {summand})",
                    self.iterator(domain)
                ))
            }
            ExprKind::Members(role) => Code {
                text: format!("self.parameters.{}.len() as i32", self.own().roles[role.0]),
                level: Level::Cast,
            },
            ExprKind::IsMember(value, role) => Code::primary(format!(
                "self.parameters.{}.contains(&{})",
                self.own().roles[role.0],
                self.code(value).at(Level::Primary)
            )),
            ExprKind::Reaches(relation, from, to) => {
                let relation = &self.names.relations[relation.0];
                Code::primary(format!("wiring.{relation}.holds({}, {})", self.expr(from), self.expr(to)))
            }
        }
    }

    fn quantified(&self, method: &str, variable: VariableId, domain: &Domain, body: &Expr) -> Code {
        let parameter = self.parameter(variable, domain, body);
        Code::primary(format!("{}.{method}(|{parameter}| {})", self.iterator(domain), self.expr(body)))
    }

    /// The parameter of a closure over a domain: `_` if its body does not read it.
    fn parameter(&self, variable: VariableId, domain: &Domain, body: &Expr) -> String {
        if Uses::of_expr(self.automaton(), body).variables.contains(&variable) {
            self.pattern(variable, domain)
        } else {
            "_".into()
        }
    }

    /// A variable that takes the values of [`Context::iterator`].
    pub fn pattern(&self, variable: VariableId, domain: &Domain) -> String {
        let name = self.variable(variable);
        if matches!(domain, Domain::Role(_)) { format!("&{name}") } else { name }
    }

    /// The values of a domain in order; references to them for a role.
    pub fn iterator(&self, domain: &Domain) -> String {
        match domain {
            Domain::Role(role) => format!("self.parameters.{}.iter()", self.own().roles[role.0]),
            Domain::Enum(id) => format!("{}::ALL.into_iter()", self.names.enums[id.0].ty),
            Domain::Range(low, high) => format!("({})", self.range(low, high)),
        }
    }

    /// Both bounds are in it. `0..capacity - 1` of a specification is `0..capacity`: without its last value a range is
    /// counted with fewer instructions.
    pub fn range(&self, low: &Expr, high: &Expr) -> String {
        let before = match &high.kind {
            ExprKind::Binary(Operator::Subtract, before, one)
                if one.kind == ExprKind::Constant(Value::Int(1)) =>
            {
                Some(before)
            }
            _ => None,
        };
        match before {
            Some(before) => format!("{}..{}", self.expr(low), self.expr(before)),
            None => format!("{}..={}", self.expr(low), self.expr(high)),
        }
    }

    fn extreme(&self, ty: Scalar, [whole, real]: [&str; 2], a: &Expr, b: &Expr) -> Code {
        let function = if ty == Scalar::Real { real } else { whole };
        Code::primary(format!("{function}({}, {})", self.expr(a), self.expr(b)))
    }

    fn binary(&self, operator: Operator, a: &Expr, b: &Expr) -> Code {
        let is_whole = matches!(a.ty, Scalar::Int { .. } | Scalar::Time);
        match operator {
            Operator::Or => self.joined(Level::Or, "||", a, b),
            Operator::And => self.joined(Level::And, "&&", a, b),
            Operator::Equal | Operator::NotEqual => self.equality(operator, a, b),
            Operator::Less => self.comparison("<", a, b),
            Operator::LessEqual => self.comparison("<=", a, b),
            Operator::Greater => self.comparison(">", a, b),
            Operator::GreaterEqual => self.comparison(">=", a, b),
            Operator::Add => self.joined(Level::Sum, "+", a, b),
            Operator::Subtract => self.joined(Level::Sum, "-", a, b),
            Operator::Multiply => self.joined(Level::Product, "*", a, b),
            Operator::Divide if is_whole && !is_plain_divisor(b) => {
                self.extreme(a.ty, ["quotient", ""], a, b)
            }
            Operator::Divide => self.joined(Level::Product, "/", a, b),
            Operator::Modulo if is_plain_divisor(b) => self.joined(Level::Product, "%", a, b),
            Operator::Modulo => self.extreme(a.ty, ["remainder", ""], a, b),
        }
    }

    /// Operators of one level are evaluated from the left.
    fn joined(&self, level: Level, operator: &str, a: &Expr, b: &Expr) -> Code {
        let tighter = match level {
            Level::Cast => Level::Or,
            Level::Or => Level::And,
            Level::And => Level::Comparison,
            Level::Comparison => Level::Sum,
            Level::Sum => Level::Product,
            Level::Product => Level::Unary,
            Level::Unary | Level::Primary => Level::Primary,
        };
        let text = format!("{} {operator} {}", self.code(a).at(level), self.code(b).at(tighter));
        Code { text, level }
    }

    fn comparison(&self, operator: &str, a: &Expr, b: &Expr) -> Code {
        compared(self.code(a).at(Level::Sum), operator, self.code(b).at(Level::Sum))
    }

    fn equality(&self, operator: Operator, a: &Expr, b: &Expr) -> Code {
        let truth = |expr: &Expr| match expr.kind {
            ExprKind::Constant(Value::Bool(truth)) => Some(truth),
            _ => None,
        };
        let against = |truth: bool, other: &Expr| {
            if truth == (operator == Operator::Equal) {
                self.code(other)
            } else {
                Code { text: format!("!{}", self.code(other).at(Level::Unary)), level: Level::Unary }
            }
        };
        match (truth(a), truth(b)) {
            (_, Some(truth)) => against(truth, a),
            (Some(truth), None) => against(truth, b),
            (None, None) => self.comparison(if operator == Operator::Equal { "==" } else { "!=" }, a, b),
        }
    }

    pub fn place(&self, place: &Place) -> String {
        self.place_at(place, |_, part| self.expr(part))
    }

    /// A place, with the texts of what finds it: of the `row` of a cell, of the `element` of an array.
    pub fn place_at(&self, place: &Place, mut part: impl FnMut(&'static str, &Expr) -> String) -> String {
        match place {
            Place::Local { local, index: i } => {
                format!("self.{}{}", self.own().locals[*local], index(i, &mut part))
            }
            Place::Port { port, index: i } => {
                let image = match self.automaton().device.ports[*port].direction {
                    Direction::Input => "inputs",
                    Direction::Output => "outputs",
                };
                format!("self.{image}.{}{}", self.own().ports[*port], index(i, &mut part))
            }
            Place::Parameter { parameter, index: i } => {
                format!("self.parameters.{}{}", self.own().parameters[*parameter], index(i, &mut part))
            }
            Place::Cell { interface, cell, of, index: i } => {
                let names = &self.names.interfaces[interface.0];
                let row = of.as_ref().map_or_else(|| self.own_row(*interface), |of| part("row", of));
                format!("cells.{}[{row}].{}{}", names.field, names.cell[*cell], index(i, &mut part))
            }
            Place::Shown { interface, parameter, of, index: i } => {
                let names = &self.names.interfaces[interface.0];
                format!(
                    "wiring.{}[{}].{}{}",
                    names.field,
                    part("row", of),
                    names.parameter[*parameter],
                    index(i, &mut part)
                )
            }
        }
    }

    pub fn own_row(&self, interface: InterfaceId) -> String {
        let position = self.automaton().implementing(interface);
        position.map_or_else(
            || format!("{}(0)", self.names.interfaces[interface.0].reference),
            |p| format!("self.parameters.{}", self.own().rows[p]),
        )
    }

    pub fn variable(&self, id: VariableId) -> String {
        self.own().variables[id.0].clone()
    }
}

fn index(index: &Option<Box<Expr>>, part: &mut impl FnMut(&'static str, &Expr) -> String) -> String {
    index.as_ref().map_or(String::new(), |i| format!("[{}]", part("element", i)))
}

fn constant(text: String) -> Code {
    let level = if text.starts_with('-') { Level::Unary } else { Level::Primary };
    Code { text, level }
}

fn compared(left: String, operator: &str, right: String) -> Code {
    Code { text: format!("{left} {operator} {right}"), level: Level::Comparison }
}

/// Neither 0 nor -1, with which a division could overflow.
fn is_plain_divisor(expr: &Expr) -> bool {
    matches!(expr.kind, ExprKind::Constant(Value::Int(v)) if v != 0 && v != -1)
}
