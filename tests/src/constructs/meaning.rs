//! Constructs of the intermediate representation.

use autogen::ir::{
    Automaton, Clause, Domain, Expr, ExprKind, Extent, Model, Operator, ParameterSource, Place, Property,
    PropertyKind, Require, RoleKind, Scalar, Severity, State, Target, Transition, Type, Update, UpdateKind,
    Value,
};
use runtime_sim::device::Direction;
use std::collections::BTreeSet;

/// Names of what was found.
pub struct Names<'a> {
    model: &'a Model,
    automaton: &'a Automaton,
    pub found: BTreeSet<String>,
}

impl<'a> Names<'a> {
    pub fn new(model: &'a Model, automaton: &'a Automaton) -> Self {
        Self { model, automaton, found: BTreeSet::new() }
    }

    pub fn add(&mut self, name: impl Into<String>) {
        self.found.insert(name.into());
    }

    pub fn declarations(&mut self) {
        self.add(format!("device: {}", self.automaton.device.name));
        for local in &self.automaton.locals {
            self.add(format!("local: {}", of_type(local.ty)));
        }
        for parameter in &self.automaton.parameters {
            let source = match parameter.source {
                ParameterSource::Layout(Some(_)) => "with a default",
                ParameterSource::Layout(None) => "from the layout",
                ParameterSource::Scenario => "from the scenario",
                ParameterSource::Device => "device constant",
            };
            self.add(format!("parameter: {source}"));
            self.add(format!("parameter: {}", of_type(parameter.ty)));
        }
        for role in &self.automaton.roles {
            let kind = match role.kind {
                RoleKind::Takes => "takes from",
                RoleKind::Hands => "hands to",
                RoleKind::Serves => "serves",
                RoleKind::Knows => "knows",
            };
            self.add(format!("role: {kind}"));
            if !role.also.is_empty() {
                self.add("role: of several interfaces");
            }
        }
        for implemented in &self.automaton.implements {
            let interface = self.model.interface(implemented.interface);
            for cell in &interface.cells {
                self.add(format!("cell: {}", of_type(cell.ty)));
            }
            if interface.name == self.automaton.name {
                self.add("cell: of the automaton itself");
            }
        }
    }

    pub fn state(&mut self, state: &State) {
        if let Some((longest, _)) = &state.within {
            self.add("state: within");
            self.expr(longest);
        }
        if state.is_final {
            self.add("state: final");
        }
    }

    pub fn transition(&mut self, state: &State, transition: &Transition) {
        match transition.target {
            None => self.add("transition: stays"),
            Some(target) if self.automaton.states[target.0].name == state.name => {
                self.add("transition: to itself")
            }
            Some(_) => self.add("transition: to another state"),
        }
        let binders = transition.clauses.iter().filter(|c| matches!(c, Clause::Bind(_))).count();
        if binders > 1 {
            self.add("guard: several binders");
        }
        if binders > 2 {
            self.add("guard: three binders");
        }
        for clause in &transition.clauses {
            match clause {
                Clause::Condition(condition) => self.expr(condition),
                Clause::Bind(binder) => {
                    let choice = match &binder.key {
                        None => "first".into(),
                        Some(key) => format!("least by {}", scalar(key.ty)),
                    };
                    self.add(format!("binder: {choice}"));
                    self.add(format!("binder: over {}", domain(&binder.domain)));
                    self.domain(&binder.domain);
                    if binder.condition.is_some() {
                        self.add("binder: with a condition");
                    }
                    binder.condition.iter().chain(&binder.key).for_each(|e| self.expr(e));
                }
            }
        }
        transition.updates.iter().for_each(|u| self.update(u));
    }

    pub fn property(&mut self, property: &Property) {
        let severity = match property.severity {
            Severity::Warning => "warns",
            Severity::Machine => "stops its machine",
            Severity::Line => "stops the line",
        };
        let kind = match property.kind {
            PropertyKind::Always(_) => "invariant",
            PropertyKind::Keep { .. } => "keep",
            PropertyKind::Whenever { .. } => "whenever",
        };
        self.add(kind);
        self.add(format!("property: {severity}"));
        property.exprs().into_iter().for_each(|expr| self.expr(expr));
    }

    pub fn require(&mut self, require: &Require) {
        self.add("require");
        self.expr(&require.condition);
    }

    fn update(&mut self, update: &Update) {
        let checked = |has: bool| if has { "checked" } else { "proved" };
        match &update.kind {
            UpdateKind::Assign { target, value, check } => {
                self.add(format!("assign: {}", scalar(target.ty.scalar)));
                if matches!(target.ty.scalar, Scalar::Int { .. } | Scalar::Real | Scalar::Point) {
                    let (ty, check) = (scalar(target.ty.scalar), checked(check.is_some()));
                    self.add(format!("assign: {ty}, {check}"));
                }
                self.target("assign", target);
                self.expr(value);
            }
            UpdateKind::Fill { target, value, check } => {
                self.add(format!("fill: {}", scalar(target.ty.scalar)));
                self.add(format!("fill: {}", checked(check.is_some())));
                self.target("fill", target);
                self.expr(value);
            }
            UpdateKind::Copy { target, source, check } => {
                self.add(format!("copy: {}", scalar(target.ty.scalar)));
                self.add(format!("copy: {}", checked(check.is_some())));
                self.add(format!("copy: from {}", self.place(source)));
                self.target("copy", target);
            }
            UpdateKind::Command { verb: _, arguments } => {
                self.add(format!("command: {} arguments", arguments.len()));
                for argument in arguments {
                    self.add(format!("command: argument {}", checked(argument.check.is_some())));
                    self.expr(&argument.value);
                }
            }
        }
    }

    fn target(&mut self, word: &str, target: &Target) {
        let place = self.place(&target.place);
        self.add(format!("{word}: to {place}"));
        target.place.parts().for_each(|e| self.expr(e));
    }

    fn place(&self, place: &Place) -> String {
        let (place, index) = match place {
            Place::Local { local: _, index } => ("local", index),
            Place::Cell { interface: _, cell: _, of: None, index } => ("own cell", index),
            Place::Cell { interface: _, cell: _, of: Some(_), index } => ("neighbour's cell", index),
            Place::Port { port, index } => match self.automaton.device.ports[*port].direction {
                Direction::Input => ("input", index),
                Direction::Output => ("output", index),
            },
            Place::Parameter { parameter: _, index } => ("parameter", index),
            Place::Shown { interface: _, parameter: _, of: _, index } => ("neighbour's parameter", index),
        };
        format!("{place}{}", if index.is_some() { " by index" } else { "" })
    }

    fn domain(&mut self, domain: &Domain) {
        if let Domain::Range(low, high) = domain {
            self.expr(low);
            self.expr(high);
        }
    }

    fn expr(&mut self, expr: &Expr) {
        use ExprKind as Kind;
        let name: String = match &expr.kind {
            Kind::Permit | Kind::Stopped | Kind::InState(_) | Kind::IsFinite(_) => "operating mode".into(),
            Kind::Constant(value) => match value {
                Value::Bool(_) => "constant: bool".into(),
                Value::Int(_) => format!("constant: {}", scalar(expr.ty)),
                Value::Real(_) => "constant: real".into(),
                Value::Point(_) => "constant: point".into(),
            },
            Kind::Read(place) => {
                for part in place.parts() {
                    match part.kind {
                        Kind::Read(_) => self.add("read: where another reading says"),
                        Kind::Own(_) => self.add("read: of itself"),
                        _ => {}
                    }
                }
                format!("read: {}", self.place(place))
            }
            Kind::Variable(_) => format!("variable: {}", scalar(expr.ty)),
            Kind::Define(define) => {
                let value = self.automaton.defines[*define].value.clone();
                self.expr(&value);
                format!("define: {}", scalar(expr.ty))
            }
            Kind::Own(_) => "self".into(),
            Kind::After(_) => "after".into(),
            Kind::Done => "done".into(),
            Kind::Failed => "failed".into(),
            Kind::Not(_) => "not".into(),
            Kind::Negate(_) => format!("- of {}", scalar(expr.ty)),
            Kind::Binary(operator, left, _) => binary(*operator, expr.ty, left.ty),
            Kind::Min(..) => format!("min of {}", scalar(expr.ty)),
            Kind::Max(..) => format!("max of {}", scalar(expr.ty)),
            Kind::Absolute(_) => format!("abs of {}", scalar(expr.ty)),
            Kind::ToReal(_) => "int as real".into(),
            Kind::MakePoint(_) => "point()".into(),
            Kind::Coordinate(_, axis) => format!("coordinate {}", ["x", "y", "z"][*axis]),
            Kind::SquaredDistance(..) => "squared_distance".into(),
            Kind::Exists { variable: _, domain: d, body: _ } => format!("exists: over {}", domain(d)),
            Kind::Forall { variable: _, domain: d, body: _ } => format!("forall: over {}", domain(d)),
            Kind::Count { variable: _, domain: d, body: _ } => format!("count: over {}", domain(d)),
            Kind::Sum { variable: _, domain: d, body: _ } => {
                self.add(format!("sum: over {}", domain(d)));
                format!("sum: of {}", scalar(expr.ty))
            }
            Kind::Members(_) => "count of a role".into(),
            Kind::IsMember(..) => "in".into(),
            Kind::Reaches(..) => "reaches".into(),
        };
        self.add(name);
        expr.parts().for_each(|part| self.expr(part));
    }
}

fn binary(operator: Operator, whole: Scalar, left: Scalar) -> String {
    match operator {
        Operator::Or => "or".into(),
        Operator::And => "and".into(),
        Operator::Equal => format!("= of {}", scalar(left)),
        Operator::NotEqual => format!("<> of {}", scalar(left)),
        Operator::Less => format!("< of {}", scalar(left)),
        Operator::LessEqual => format!("<= of {}", scalar(left)),
        Operator::Greater => format!("> of {}", scalar(left)),
        Operator::GreaterEqual => format!(">= of {}", scalar(left)),
        Operator::Add => format!("+ of {}", scalar(whole)),
        Operator::Subtract => format!("- between {}", scalar(whole)),
        Operator::Multiply => format!("* of {}", scalar(whole)),
        Operator::Divide => format!("/ of {}", scalar(whole)),
        Operator::Modulo => "mod".into(),
    }
}

fn scalar(ty: Scalar) -> &'static str {
    match ty {
        Scalar::Bool => "bool",
        Scalar::Int { lo: _, hi: _ } => "int",
        Scalar::Real => "real",
        Scalar::Time => "time",
        Scalar::Point => "point",
        Scalar::Enum(_) => "enum",
        Scalar::Ref(_) => "reference",
    }
}

fn of_type(ty: Type) -> String {
    let extent = match ty.extent {
        Extent::One => "",
        Extent::Count(_) => "[number]",
        Extent::By(id) if id == autogen::ir::KIND => "[Kind]",
        Extent::By(_) => "[enum]",
    };
    format!("{}{extent}", scalar(ty.scalar))
}

fn domain(domain: &Domain) -> &'static str {
    match domain {
        Domain::Role(_) => "a role",
        Domain::Enum(_) => "an enum",
        Domain::Range(..) => "a range",
    }
}
