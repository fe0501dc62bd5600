//! Values with which conditions hold: each is assumed where it is first read, one after the other of some candidates.

use crate::ir::{
    Automaton, Clause, Domain, Element, Expr, ExprKind, InterfaceId, Operator, Place, Scalar, StateId,
    System, Transition, Value, VariableId, less,
};
use std::collections::{BTreeSet, HashMap};

/// Choices of values that are tried.
const MOST_TRIED: usize = 5_000;
/// Steps of evaluation for one choice.
const MOST_STEPS: usize = 20_000;
/// The same for all pairs of transitions of a state.
pub const MOST_STEPS_OF_STATE: usize = 2_000_000;
/// Errors of commands that are assumed.
const MOST_ERROR: i32 = 3;
/// Candidates for one value.
const MOST_CANDIDATES: usize = 12;

/// What a guard may read of a running machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Source {
    Element(Element),
    /// Whether the last command has ended.
    Answered,
    /// How long the present state has lasted, ms.
    Stay,
    Permit,
}

/// Values of one instance, in one of its states.
pub struct Assumed<'a> {
    system: &'a System,
    instance: usize,
    state: StateId,
    guards: [&'a Transition; 2],
    always: &'a [&'a Expr],
    /// Numbers that the conditions name, and those beside them.
    ints: Vec<i32>,
    reals: Vec<f64>,
    values: HashMap<Source, Value>,
    /// In the order in which they were read.
    read: Vec<(Source, Scalar)>,
    /// Of each value which of its candidates, and how many there are.
    choices: Vec<[usize; 2]>,
    variables: Vec<Value>,
    steps: usize,
    /// A condition reads the number of an error, beside `done` and `failed`.
    asks_error: bool,
}

impl<'a> Assumed<'a> {
    pub fn new(
        system: &'a System,
        instance: usize,
        state: StateId,
        guards: [&'a Transition; 2],
        always: &'a [&'a Expr],
    ) -> Self {
        let automaton = system.automaton_of(instance);
        let mut named =
            Numbers { automaton, ints: BTreeSet::new(), reals: Vec::new(), seen: BTreeSet::new() };
        guards.iter().flat_map(|guard| guard.guard_expressions()).for_each(|expr| named.collect(expr));
        always.iter().for_each(|expr| named.collect(expr));
        let ints = named.ints.iter().flat_map(|int| [*int, int.saturating_sub(1), int.saturating_add(1)]);
        let reals = named.reals.iter().flat_map(|real| [*real, real - 1.0, real + 1.0]);
        Self {
            system,
            instance,
            state,
            guards,
            always,
            ints: ints.collect(),
            reals: [0.0, 1.0].into_iter().chain(reals).collect(),
            values: HashMap::new(),
            read: Vec::new(),
            choices: Vec::new(),
            variables: vec![Value::Int(0); automaton.variables.len()],
            steps: 0,
            asks_error: false,
        }
    }

    /// Values with which both guards hold, as `name = value`; none if none were found before `left` steps were used up.
    pub fn find(mut self, left: &mut usize) -> Option<Vec<String>> {
        for _ in 0..MOST_TRIED {
            *left = left.checked_sub(self.steps)?;
            self.values.clear();
            self.read.clear();
            (self.steps, self.asks_error) = (0, false);
            let [first, second] = self.guards;
            if self.choose(&first.clauses) == Some(true) && self.choose(&second.clauses) == Some(true) {
                let read = self.read.clone();
                if self.always.iter().all(|always| self.holds(always) == Some(true))
                    && self.is_answer_possible()
                {
                    return Some(self.shown(&read));
                }
            }
            // Candidates of what was read behind are those of another choice.
            self.choices.truncate(self.read.len());
            while self.choices.pop_if(|[choice, count]| *choice + 1 >= *count).is_some() {}
            let [choice, _] = self.choices.last_mut()?;
            *choice += 1;
        }
        None
    }

    /// A command is answered exactly if its number is not 0 and is that of the last answer.
    fn is_answer_possible(&self) -> bool {
        let number = |name: &str| self.port(name).and_then(|port| self.values.get(&port).copied());
        let none = Some(Value::Int(0));
        match (self.values.get(&Source::Answered), number("cmd"), number("ack")) {
            (Some(Value::Bool(true)), Some(cmd), Some(ack)) => Some(cmd) != none && cmd == ack,
            (Some(Value::Bool(true)), cmd, ack) => cmd != none && ack != none,
            (Some(_), Some(cmd), Some(ack)) => Some(cmd) == none || cmd != ack,
            _ => true,
        }
    }

    fn shown(&self, read: &[(Source, Scalar)]) -> Vec<String> {
        let answer = |error: &Value| if *error == Value::Int(0) { "done" } else { "failed" };
        let error = self.port("error").filter(|_| !self.asks_error);
        let read = read.iter().filter(|(source, _)| Some(*source) != error);
        let shown = read.map(|(source, ty)| match (source, &self.values[source]) {
            (Source::Answered, Value::Bool(true)) => {
                let error = self.port("error").and_then(|error| self.values.get(&error));
                error.map_or("an answer", answer).to_string()
            }
            (Source::Answered, _) => "no answer yet".to_string(),
            (Source::Stay, Value::Int(ms)) => format!("a stay of {} s", f64::from(*ms) / 1000.0),
            (Source::Stay | Source::Permit, value) => {
                format!("run_permit = {}", self.system.shown_value(*ty, *value))
            }
            (Source::Element(element), value) => {
                let owner = self.system.owner(*element);
                let name = self.system.name_of(*element);
                let whose = &self.system.instances[owner].name;
                let name = if owner == self.instance { name } else { format!("{whose}.{name}") };
                format!("{name} = {}", self.system.shown_value(*ty, *value))
            }
        });
        shown.collect()
    }

    fn automaton(&self) -> &'a Automaton {
        self.system.automaton_of(self.instance)
    }

    fn port(&self, name: &str) -> Option<Source> {
        let port = self.automaton().device.ports.iter().position(|port| port.name == name)?;
        Some(Source::Element(Element::Port { robot: self.instance, port, index: 0 }))
    }

    /// Assumes a value where it is read for the first time.
    fn assume(&mut self, source: Source, ty: Scalar) -> Option<Value> {
        if let Some(value) = self.values.get(&source) {
            return Some(*value);
        }
        let candidates = self.candidates(ty);
        let number = self.read.len();
        if number == self.choices.len() {
            self.choices.push([0, candidates.len()]);
        }
        let value = *candidates.get(self.choices[number][0])?;
        self.values.insert(source, value);
        self.read.push((source, ty));
        Some(value)
    }

    fn candidates(&self, ty: Scalar) -> Vec<Value> {
        let first = |count: usize| (0..count.min(MOST_CANDIDATES) as i32).map(Value::Int).collect();
        let mut all: Vec<Value> = match ty {
            Scalar::Bool => vec![Value::Bool(false), Value::Bool(true)],
            Scalar::Int { lo, hi } => {
                let named = [0, lo, hi].into_iter().chain(self.ints.iter().copied());
                named.filter(|int| (lo..=hi).contains(int)).map(Value::Int).collect()
            }
            Scalar::Time => [0]
                .into_iter()
                .chain(self.ints.iter().copied())
                .filter(|ms| *ms >= 0)
                .map(Value::Int)
                .collect(),
            Scalar::Enum(id) => first(self.system.model.enums[id.0].members.len()),
            Scalar::Ref(id) => first(self.system.members[id.0].len()),
            Scalar::Real => self.reals.iter().copied().map(Value::Real).collect(),
            Scalar::Point => self.reals.iter().map(|real| Value::Point([*real; 3])).collect(),
        };
        let mut seen: Vec<Value> = Vec::new();
        all.retain(|value| {
            let is_new = !seen.contains(value);
            seen.push(*value);
            is_new
        });
        all.truncate(MOST_CANDIDATES);
        all
    }

    /// Whether the clauses hold together.
    fn choose(&mut self, clauses: &[Clause]) -> Option<bool> {
        let Some((clause, rest)) = clauses.split_first() else { return Some(true) };
        match clause {
            Clause::Condition(condition) => Some(self.holds(condition)? && self.choose(rest)?),
            Clause::Bind(binder) => {
                for value in self.domain(&binder.domain)? {
                    self.variables[binder.variable.0] = value;
                    let is_right = match &binder.condition {
                        Some(condition) => self.holds(condition)?,
                        None => true,
                    };
                    if is_right && self.choose(rest)? {
                        return Some(true);
                    }
                }
                Some(false)
            }
        }
    }

    fn domain(&mut self, domain: &Domain) -> Option<Vec<Value>> {
        let ints = |low: i32, high: i32| (low..=high).take(MOST_STEPS).map(Value::Int).collect();
        Some(match domain {
            Domain::Role(role) => {
                let rows = &self.system.instances[self.instance].roles[role.0];
                rows.iter().map(|row| Value::Int(*row as i32)).collect()
            }
            Domain::Enum(id) => ints(0, self.system.model.enums[id.0].members.len() as i32 - 1),
            Domain::Range(low, high) => {
                let (low, high) = (self.int(low)?, self.int(high)?);
                ints(low, high)
            }
        })
    }

    fn holds(&mut self, expr: &Expr) -> Option<bool> {
        Some(self.value(expr)? == Value::Bool(true))
    }

    fn int(&mut self, expr: &Expr) -> Option<i32> {
        match self.value(expr)? {
            Value::Int(int) => Some(int),
            _ => None,
        }
    }

    fn real(&mut self, expr: &Expr) -> Option<f64> {
        match self.value(expr)? {
            Value::Real(real) => Some(real),
            _ => None,
        }
    }

    fn point(&mut self, expr: &Expr) -> Option<[f64; 3]> {
        match self.value(expr)? {
            Value::Point(point) => Some(point),
            _ => None,
        }
    }

    /// None where it has no value, or it would take too long.
    fn value(&mut self, expr: &Expr) -> Option<Value> {
        self.steps += 1;
        if self.steps > MOST_STEPS {
            return None;
        }
        let error = Scalar::Int { lo: 0, hi: MOST_ERROR };
        Some(match &expr.kind {
            ExprKind::Constant(value) => *value,
            ExprKind::Read(place) => self.place(place)?,
            ExprKind::Variable(VariableId(variable)) => self.variables[*variable],
            ExprKind::Define(define) => self.value(&self.automaton().defines[*define].value)?,
            ExprKind::Own(interface) => Value::Int(self.own(*interface)? as i32),
            ExprKind::After(time) => {
                let time = self.int(time)?;
                let Value::Int(stay) = self.assume(Source::Stay, Scalar::Time)? else { return None };
                Value::Bool(stay >= time)
            }
            ExprKind::Done | ExprKind::Failed => {
                let is_failure = expr.kind == ExprKind::Failed;
                if self.assume(Source::Answered, Scalar::Bool)? == Value::Bool(false) {
                    return Some(Value::Bool(false));
                }
                let port = self.port("error")?;
                Value::Bool((self.assume(port, error)? != Value::Int(0)) == is_failure)
            }
            ExprKind::Permit => self.assume(Source::Permit, Scalar::Bool)?,
            // A machine that is stopped makes no steps.
            ExprKind::Stopped => Value::Bool(false),
            ExprKind::InState(states) => Value::Bool(states.contains(&self.state)),
            ExprKind::IsFinite(inner) => {
                self.value(inner)?;
                Value::Bool(true)
            }
            ExprKind::Not(inner) => Value::Bool(!self.holds(inner)?),
            ExprKind::Negate(inner) => match self.value(inner)? {
                Value::Int(int) => Value::Int(int.checked_neg()?),
                Value::Real(real) => Value::Real(-real),
                other => other,
            },
            ExprKind::Binary(Operator::And, a, b) => Value::Bool(self.holds(a)? && self.holds(b)?),
            ExprKind::Binary(Operator::Or, a, b) => Value::Bool(self.holds(a)? || self.holds(b)?),
            ExprKind::Binary(operator, a, b) => operator.apply(self.value(a)?, self.value(b)?)?,
            ExprKind::Min(a, b) | ExprKind::Max(a, b) => {
                let (a, b) = (self.value(a)?, self.value(b)?);
                let is_first = less(a, b) == matches!(expr.kind, ExprKind::Min(..));
                if is_first { a } else { b }
            }
            ExprKind::Absolute(inner) => match self.value(inner)? {
                Value::Int(int) => Value::Int(int.checked_abs()?),
                Value::Real(real) => Value::Real(real.abs()),
                other => other,
            },
            ExprKind::ToReal(inner) => Value::Real(f64::from(self.int(inner)?)),
            ExprKind::MakePoint(parts) => {
                let [x, y, z] = &**parts;
                Value::Point([self.real(x)?, self.real(y)?, self.real(z)?])
            }
            ExprKind::Coordinate(inner, axis) => Value::Real(self.point(inner)?[*axis]),
            ExprKind::SquaredDistance(a, b) => {
                let (a, b) = (self.point(a)?, self.point(b)?);
                Value::Real((0..3).map(|axis| (a[axis] - b[axis]) * (a[axis] - b[axis])).sum())
            }
            ExprKind::Exists { variable, domain, body } => {
                let mut holds = false;
                for value in self.domain(domain)? {
                    holds |= self.bound(*variable, value, body)? == Value::Bool(true);
                    if holds {
                        break;
                    }
                }
                Value::Bool(holds)
            }
            ExprKind::Forall { variable, domain, body } => {
                let mut holds = true;
                for value in self.domain(domain)? {
                    holds &= self.bound(*variable, value, body)? == Value::Bool(true);
                    if !holds {
                        break;
                    }
                }
                Value::Bool(holds)
            }
            ExprKind::Count { variable, domain, body } => {
                let mut count = 0;
                for value in self.domain(domain)? {
                    count += i32::from(self.bound(*variable, value, body)? == Value::Bool(true));
                }
                Value::Int(count)
            }
            ExprKind::Sum { variable, domain, body } => {
                let mut sum = if expr.ty == Scalar::Real { Value::Real(0.0) } else { Value::Int(0) };
                for value in self.domain(domain)? {
                    sum = Operator::Add.apply(sum, self.bound(*variable, value, body)?)?;
                }
                sum
            }
            ExprKind::Members(role) => {
                Value::Int(self.system.instances[self.instance].roles[role.0].len() as i32)
            }
            ExprKind::IsMember(value, role) => {
                let row = self.int(value)? as usize;
                Value::Bool(self.system.instances[self.instance].roles[role.0].contains(&row))
            }
            ExprKind::Reaches(relation, from, to) => {
                let (from, to) = (self.int(from)? as usize, self.int(to)? as usize);
                Value::Bool(*self.system.reaches[relation.0].get(from)?.get(to)?)
            }
        })
    }

    fn bound(&mut self, VariableId(variable): VariableId, value: Value, body: &Expr) -> Option<Value> {
        self.variables[variable] = value;
        self.value(body)
    }

    fn own(&self, interface: InterfaceId) -> Option<usize> {
        let position = self.automaton().implementing(interface)?;
        Some(self.system.instances[self.instance].rows[position])
    }

    fn place(&mut self, place: &Place) -> Option<Value> {
        let (system, robot) = (self.system, self.instance);
        let automaton = self.automaton();
        match place {
            Place::Local { local, index } => {
                let ty = automaton.locals[*local].ty;
                let index = self.index(index, system.model.elements(ty.extent))?;
                self.assume(Source::Element(Element::Local { robot, local: *local, index }), ty.scalar)
            }
            Place::Port { port, index } => {
                let declared = &automaton.device.ports[*port];
                let index = self.index(index, declared.extent.elements(system.kinds()))?;
                let source = Source::Element(Element::Port { robot, port: *port, index });
                self.asks_error |= Some(source) == self.port("error");
                self.assume(source, declared.ty.into())
            }
            Place::Parameter { parameter, index } => {
                let elements = &system.instances[robot].parameters[*parameter];
                elements.get(self.index(index, elements.len())?).copied()
            }
            Place::Cell { interface, cell, of, index } => {
                let row = match of {
                    Some(of) => self.int(of)? as usize,
                    None => self.own(*interface)?,
                };
                let ty = system.model.interface(*interface).cells[*cell].ty;
                let index = self.index(index, system.model.elements(ty.extent))?;
                let element = Element::Cell { interface: *interface, row, cell: *cell, index };
                self.assume(Source::Element(element), ty.scalar)
            }
            Place::Shown { interface, parameter, of, index } => {
                let row = self.int(of)? as usize;
                let elements = system.shown(*interface, row, *parameter);
                elements.get(self.index(index, elements.len())?).copied()
            }
        }
    }

    /// None if there is no such element.
    fn index(&mut self, index: &Option<Box<Expr>>, count: usize) -> Option<usize> {
        let index = match index {
            Some(index) => usize::try_from(self.int(index)?).ok()?,
            None => 0,
        };
        (index < count).then_some(index)
    }
}

/// Numbers that stand in expressions, through definitions.
struct Numbers<'a> {
    automaton: &'a Automaton,
    ints: BTreeSet<i32>,
    reals: Vec<f64>,
    seen: BTreeSet<usize>,
}

impl Numbers<'_> {
    fn collect(&mut self, expr: &Expr) {
        match &expr.kind {
            ExprKind::Constant(Value::Int(int)) => {
                self.ints.insert(*int);
            }
            ExprKind::Constant(Value::Real(real)) if !self.reals.contains(real) => self.reals.push(*real),
            ExprKind::Define(define) => {
                if self.seen.insert(*define) {
                    let automaton = self.automaton;
                    self.collect(&automaton.defines[*define].value);
                }
            }
            _ => expr.parts().for_each(|part| self.collect(part)),
        }
    }
}
