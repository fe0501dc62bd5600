//! Expressions of the IR as they are written in a specification.

use crate::ir::{Automaton, Domain, Expr, ExprKind, Model, Operator, Place, Scalar, Value};

/// How tightly the outermost operator of a text binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Or,
    And,
    Not,
    Comparison,
    Sum,
    Product,
    Sign,
    Primary,
}

/// The words of one automaton.
#[derive(Clone, Copy)]
pub struct Words<'a> {
    pub model: &'a Model,
    pub automaton: &'a Automaton,
}

impl Words<'_> {
    pub fn expr(&self, expr: &Expr) -> String {
        self.code(expr).0
    }

    /// `not` of it, or what stands behind its own `not`.
    pub fn negated(&self, expr: &Expr) -> String {
        match &expr.kind {
            ExprKind::Not(inner) => self.expr(inner),
            _ => format!("not {}", self.at(expr, Level::Comparison)),
        }
    }

    fn at(&self, expr: &Expr, least: Level) -> String {
        match self.code(expr) {
            (text, level) if level >= least => text,
            (text, _) => format!("({text})"),
        }
    }

    fn code(&self, expr: &Expr) -> (String, Level) {
        use Level::*;
        let call = |name: &str, parts: &[&Expr]| {
            let parts: Vec<String> = parts.iter().map(|part| self.expr(part)).collect();
            (format!("{name}({})", parts.join(", ")), Primary)
        };
        match &expr.kind {
            ExprKind::Constant(value) => (self.constant(expr.ty, *value), Primary),
            ExprKind::Read(place) => (self.place(place), Primary),
            ExprKind::Variable(id) => (self.automaton.variables[id.0].name.clone(), Primary),
            ExprKind::Define(define) => (self.automaton.defines[*define].name.clone(), Primary),
            ExprKind::Own(_) => ("self".into(), Primary),
            ExprKind::After(time) => (format!("after {}", self.at(time, Sum)), Primary),
            ExprKind::Done => ("done".into(), Primary),
            ExprKind::Failed => ("failed".into(), Primary),
            ExprKind::Permit => ("run_permit".into(), Primary),
            ExprKind::Stopped => ("stopped".into(), Primary),
            ExprKind::InState(states) => {
                let names = states.iter().map(|state| self.automaton.states[state.0].name.as_str());
                (format!("in {}", names.collect::<Vec<_>>().join(" or ")), Primary)
            }
            ExprKind::IsFinite(inner) => call("is_finite", &[inner]),
            ExprKind::Not(inner) => (format!("not {}", self.at(inner, Not)), Not),
            ExprKind::Negate(inner) => (format!("-{}", self.at(inner, Sign)), Sign),
            ExprKind::Binary(operator, a, b) => self.binary(*operator, a, b),
            ExprKind::Min(a, b) => call("min", &[a, b]),
            ExprKind::Max(a, b) => call("max", &[a, b]),
            ExprKind::Absolute(inner) => call("abs", &[inner]),
            ExprKind::ToReal(inner) => self.code(inner),
            ExprKind::MakePoint(parts) => call("point", &parts.iter().collect::<Vec<_>>()),
            ExprKind::Coordinate(inner, axis) => {
                (format!("{}.{}", self.at(inner, Primary), ["x", "y", "z"][*axis]), Primary)
            }
            ExprKind::SquaredDistance(a, b) => call("squared_distance", &[a, b]),
            ExprKind::Exists { variable, domain, body } => {
                self.quantified("exists", variable.0, domain, body)
            }
            ExprKind::Forall { variable, domain, body } => {
                self.quantified("forall", variable.0, domain, body)
            }
            ExprKind::Count { variable, domain, body } => self.quantified("count", variable.0, domain, body),
            ExprKind::Sum { variable, domain, body } => self.quantified("sum", variable.0, domain, body),
            ExprKind::Members(role) => (format!("count({})", self.automaton.roles[role.0].name), Primary),
            ExprKind::IsMember(value, role) => {
                (format!("{} in {}", self.at(value, Sum), self.automaton.roles[role.0].name), Comparison)
            }
            ExprKind::Reaches(_, from, to) => {
                (format!("{} reaches {}", self.at(from, Sum), self.at(to, Sum)), Comparison)
            }
        }
    }

    fn binary(&self, operator: Operator, a: &Expr, b: &Expr) -> (String, Level) {
        use Level::*;
        let (word, level, right) = match operator {
            Operator::Or => ("or", Or, And),
            Operator::And => ("and", And, Not),
            Operator::Equal => ("=", Comparison, Sum),
            Operator::NotEqual => ("<>", Comparison, Sum),
            Operator::Less => ("<", Comparison, Sum),
            Operator::LessEqual => ("<=", Comparison, Sum),
            Operator::Greater => (">", Comparison, Sum),
            Operator::GreaterEqual => (">=", Comparison, Sum),
            Operator::Add => ("+", Sum, Product),
            Operator::Subtract => ("-", Sum, Product),
            Operator::Multiply => ("*", Product, Sign),
            Operator::Divide => ("/", Product, Sign),
            Operator::Modulo => ("mod", Product, Sign),
        };
        let left = if level == Comparison { Sum } else { level };
        (format!("{} {word} {}", self.at(a, left), self.at(b, right)), level)
    }

    fn quantified(&self, word: &str, variable: usize, domain: &Domain, body: &Expr) -> (String, Level) {
        let variable = &self.automaton.variables[variable].name;
        (format!("{word} {variable} in {}: {}", self.domain(domain), self.expr(body)), Level::Or)
    }

    pub fn domain(&self, domain: &Domain) -> String {
        match domain {
            Domain::Role(role) => self.automaton.roles[role.0].name.clone(),
            Domain::Enum(id) => self.model.enums[id.0].name.clone(),
            Domain::Range(low, high) => {
                format!("{}..{}", self.at(low, Level::Sum), self.at(high, Level::Sum))
            }
        }
    }

    fn constant(&self, ty: Scalar, value: Value) -> String {
        match (value, ty) {
            (Value::Int(ms), Scalar::Time) if ms % 1000 == 0 => format!("{} s", ms / 1000),
            (Value::Int(ms), Scalar::Time) => format!("{ms} ms"),
            (Value::Int(ordinal), Scalar::Enum(id)) => {
                self.model.enums[id.0].members[ordinal as usize].clone()
            }
            (Value::Bool(b), _) => b.to_string(),
            (Value::Int(i), _) => i.to_string(),
            (Value::Real(r), _) => format!("{r:?}"),
            (Value::Point([x, y, z]), _) => format!("point({x}, {y}, {z})"),
        }
    }

    fn place(&self, place: &Place) -> String {
        let (base, index) = match place {
            Place::Local { local, index } => (self.automaton.locals[*local].name.clone(), index),
            Place::Port { port, index } => (self.automaton.device.ports[*port].name.clone(), index),
            Place::Parameter { parameter, index } => {
                (self.automaton.parameters[*parameter].name.clone(), index)
            }
            Place::Cell { interface, cell, of, index } => {
                let name = &self.model.interface(*interface).cells[*cell].name;
                match of {
                    None => (name.clone(), index),
                    Some(of) => (format!("{}.{name}", self.at(of, Level::Primary)), index),
                }
            }
            Place::Shown { interface, parameter, of, index } => {
                let name = &self.model.interface(*interface).parameters[*parameter].name;
                (format!("{}.{name}", self.at(of, Level::Primary)), index)
            }
        };
        match index {
            None => base,
            Some(index) => format!("{base}[{}]", self.expr(index)),
        }
    }
}
