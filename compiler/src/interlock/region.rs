//! Where points of a line may be, as far as its texts and its layout tell.

use super::few::{Few, around, few};
use super::writers::Writers;
use super::written::{Written, WrittenBy};
use crate::ir::{
    Asking, Domain, Expr, ExprKind, InterfaceId, Operator, Place, Scalar, System, Target, Transition, Update,
    UpdateKind, Value,
};
use runtime_sim::line::Line;
use runtime_sim::part::Primitive;
use runtime_sim::wiring::Source;
use std::cell::RefCell;
use std::collections::{BTreeSet, HashMap};
use std::rc::Rc;

/// Both bounds, included.
pub type Span = [f64; 2];

/// A box, by its bounds along x, y and z.
pub type Region = [Span; 3];

/// Values of values: deeper ones are not followed.
const DEEPEST: usize = 12;

/// Of one instance, which of its references to others stand where they stand.
#[derive(Clone, Debug, Default)]
pub struct Bound {
    /// A local, and its row.
    pub rows: Vec<(usize, usize)>,
    asked: RefCell<BTreeSet<(usize, Option<usize>)>>,
}

impl Bound {
    pub fn new(rows: Vec<(usize, usize)>) -> Self {
        Self { rows, ..Self::default() }
    }

    pub fn row(&self, local: usize) -> Option<usize> {
        let row = self.rows.iter().find(|(bound, _)| *bound == local).map(|(_, row)| *row);
        self.asked.borrow_mut().insert((local, row));
        row
    }

    /// Locals that were asked for, with the answers.
    pub fn asked(&self) -> BTreeSet<(usize, Option<usize>)> {
        self.asked.borrow().clone()
    }
}

/// A cell, and how deep it was asked for.
type Cell = (InterfaceId, usize, usize);

/// A parameter that all members show, and the bounds of the index.
type Shown = (InterfaceId, usize, Option<[u64; 2]>);

/// What is the same for whoever asks.
#[derive(Default)]
struct Known {
    written: RefCell<HashMap<Cell, Rc<Written>>>,
    shown: RefCell<HashMap<Shown, Vec<Region>>>,
}

/// A line, and who writes what in it.
pub struct Given<'a> {
    pub system: &'a System,
    pub line: &'a Line,
    writers: Writers<'a>,
    known: Known,
}

impl<'a> Given<'a> {
    pub fn new(system: &'a System, line: &'a Line) -> Self {
        Self { system, line, writers: Writers::new(system), known: Known::default() }
    }
}

/// Evaluates for one instance, in one of its transitions.
pub struct Regions<'a> {
    pub system: &'a System,
    pub line: &'a Line,
    writers: &'a Writers<'a>,
    known: &'a Known,
    pub instance: usize,
    pub bound: &'a Bound,
    pub transition: &'a Transition,
    depth: usize,
}

impl<'a> Regions<'a> {
    pub fn new(given: &'a Given<'a>, instance: usize, bound: &'a Bound, transition: &'a Transition) -> Self {
        let Given { system, line, writers, known } = given;
        Self { system, line, writers, known, instance, bound, transition, depth: 0 }
    }

    fn deeper(&self) -> Option<Self> {
        (self.depth < DEEPEST).then(|| Self { depth: self.depth + 1, ..*self })
    }

    /// Where a point may be; none where that is not known.
    pub fn points(&self, expr: &Expr) -> Option<Vec<Region>> {
        let inner = self.deeper()?;
        let found = match &expr.kind {
            ExprKind::Constant(Value::Point(point)) => vec![point.map(|value| [value, value])],
            ExprKind::Define(define) => {
                inner.points(&self.system.automaton_of(self.instance).defines[*define].value)?
            }
            ExprKind::Binary(operator @ (Operator::Add | Operator::Subtract), a, b) => {
                let (a, b) = (inner.points(a)?, inner.points(b)?);
                let sum = |a: Span, b: Span| match operator {
                    Operator::Add => [a[0] + b[0], a[1] + b[1]],
                    _ => [a[0] - b[1], a[1] - b[0]],
                };
                let with =
                    |a: &Region| b.iter().map(|b| [0, 1, 2].map(|i| sum(a[i], b[i]))).collect::<Vec<_>>();
                a.iter().flat_map(with).collect()
            }
            ExprKind::MakePoint(parts) => {
                vec![[inner.span(&parts[0])?, inner.span(&parts[1])?, inner.span(&parts[2])?]]
            }
            ExprKind::Min(a, b) | ExprKind::Max(a, b) => [inner.points(a)?, inner.points(b)?].concat(),
            ExprKind::Read(place) => inner.points_at(place)?,
            _ => return None,
        };
        Some(few(found))
    }

    fn points_at(&self, place: &Place) -> Option<Vec<Region>> {
        match place {
            Place::Parameter { parameter, index } => {
                let elements = &self.system.instances[self.instance].parameters[*parameter];
                Some(points_of(elements_of(elements, self.numbers(index.as_deref()))))
            }
            Place::Shown { interface, parameter, of, index } => {
                Some(self.shown(*interface, &self.rows(of), *parameter, self.numbers(index.as_deref())))
            }
            Place::Port { port, .. } => self.seen(*port),
            Place::Local { local, .. } => {
                let automaton = self.system.automaton_of(self.instance);
                let transitions = automaton.states.iter().flat_map(|state| &state.transitions);
                let itself = Asking::new(
                    automaton,
                    |kind| matches!(kind, ExprKind::Read(Place::Local { local: of, .. }) if of == local),
                );
                let mut all = Vec::new();
                for transition in transitions {
                    let here = Self { transition, ..*self };
                    for update in &transition.updates {
                        let is_it = |target: &Target| matches!(target.place, Place::Local { local: of, .. } if of == *local);
                        if !update.kind.target().is_some_and(is_it) {
                            continue;
                        }
                        // How far it goes step by step is not known.
                        if let Some(value) = update.kind.value().filter(|value| !itself.expression(value)) {
                            all.extend(here.points(value)?);
                        }
                        if let UpdateKind::Copy { source, .. } = &update.kind {
                            all.extend(here.points_at(source)?);
                        }
                    }
                }
                Some(all)
            }
            Place::Cell { interface, cell, of, .. } => {
                let rows = match of {
                    Some(of) => self.rows(of),
                    None => self.own(*interface).into_iter().collect(),
                };
                self.written(*interface, *cell, &rows)
            }
        }
    }

    /// What these members show, in some elements of an array.
    fn shown(
        &self,
        interface: InterfaceId,
        rows: &[usize],
        parameter: usize,
        numbers: Option<Span>,
    ) -> Vec<Region> {
        let evaluate = || {
            let mut all = Few::default();
            for row in rows {
                match elements_of(self.system.shown(interface, *row, parameter), numbers) {
                    [one] => all.extend(point_of(one)),
                    values => all.extend(points_of(values)),
                }
            }
            all.regions
        };
        if rows.len() < self.system.members[interface.0].len() {
            return evaluate();
        }
        let key = (interface, parameter, numbers.map(|span| span.map(f64::to_bits)));
        self.known.shown.borrow_mut().entry(key).or_insert_with(evaluate).clone()
    }

    /// All that anybody writes into a cell of these members.
    fn written(&self, interface: InterfaceId, cell: usize, rows: &[usize]) -> Option<Vec<Region>> {
        self.deeper()?.all_written(interface, cell).of_members(rows)
    }

    /// All that anybody writes into a cell of any member: whoever asks, it is the same.
    fn all_written(&self, interface: InterfaceId, cell: usize) -> Rc<Written> {
        let key = (interface, cell, self.depth);
        if let Some(known) = self.known.written.borrow().get(&key) {
            return known.clone();
        }
        let unbound = Bound::default();
        let updates = self.writers.of(interface, cell).filter_map(|(instance, write)| {
            let here = Regions { instance, bound: &unbound, transition: write.transition, ..*self };
            let rows = match write.of {
                Some(of) => here.rows(of),
                None => here.own(interface).into_iter().collect(),
            };
            let regions = || write.value.and_then(|value| here.points(value));
            (!rows.is_empty()).then(|| WrittenBy { rows, regions: regions() })
        });
        let written = Rc::new(Written::new(self.system.members[interface.0].len(), updates));
        self.known.written.borrow_mut().insert(key, written.clone());
        written
    }

    /// What an input shows.
    fn seen(&self, port: usize) -> Option<Vec<Region>> {
        let device = &self.system.automaton_of(self.instance).device;
        let machine = &self.line.machines[self.instance];
        let input =
            device.ports[..port].iter().filter(|p| p.direction == device.ports[port].direction).count();
        let Source::Signal { part, signal } = machine.wiring.inputs.get(input)?.source else { return None };
        let name = machine.parts[part].schema().signals[signal].name;
        match (&machine.parts[part].primitive, name) {
            (Primitive::Route(route), _) => Some(route.stops.iter().map(|stop| exactly(*stop)).collect()),
            (Primitive::Zone(zone), "foremost") => {
                let Primitive::Lane(lane) = &machine.parts[zone.lane].primitive else { return None };
                let (middle, _) = lane.centre_line.find(zone.middle)?;
                let corner = |along: f64, across: f64| {
                    exactly(lane.centre_line.point(middle + along * zone.half, across * lane.width / 2.0))
                };
                let corners = [corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, -1.0), corner(1.0, 1.0)];
                Some(vec![around(&corners)?])
            }
            _ => None,
        }
    }

    /// What an index may be; none without one.
    fn numbers(&self, index: Option<&Expr>) -> Option<Span> {
        let span = |index: &Expr| self.deeper()?.span(index);
        index.map(|index| span(index).unwrap_or([0.0, f64::MAX]))
    }

    /// Between what a number may be; none where that is not known.
    pub fn span(&self, expr: &Expr) -> Option<Span> {
        let inner = self.deeper()?;
        let number = |value: &Value| match value {
            Value::Int(i) => Some(f64::from(*i)),
            Value::Real(r) => Some(*r),
            Value::Bool(_) | Value::Point(_) => None,
        };
        match &expr.kind {
            ExprKind::Constant(value) => number(value).map(|value| [value, value]),
            ExprKind::Define(define) => {
                inner.span(&self.system.automaton_of(self.instance).defines[*define].value)
            }
            ExprKind::ToReal(of) => inner.span(of),
            ExprKind::Negate(of) => inner.span(of).map(|[low, high]| [-high, -low]),
            ExprKind::Coordinate(of, axis) => around(&inner.points(of)?).map(|region| region[*axis]),
            ExprKind::Min(a, b) => {
                let (a, b) = (inner.span(a)?, inner.span(b)?);
                Some([a[0].min(b[0]), a[1].min(b[1])])
            }
            ExprKind::Max(a, b) => {
                let (a, b) = (inner.span(a)?, inner.span(b)?);
                Some([a[0].max(b[0]), a[1].max(b[1])])
            }
            ExprKind::Binary(operator, a, b) => {
                let (a, b) = (inner.span(a)?, inner.span(b)?);
                match operator {
                    Operator::Add => Some([a[0] + b[0], a[1] + b[1]]),
                    Operator::Subtract => Some([a[0] - b[1], a[1] - b[0]]),
                    Operator::Multiply => {
                        let products = [a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]];
                        let least = products.iter().copied().fold(f64::INFINITY, f64::min);
                        let most = products.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                        Some([least, most])
                    }
                    Operator::Divide if b[0] == b[1] && b[0] > 0.0 && expr.ty == Scalar::Real => {
                        Some([a[0] / b[0], a[1] / b[0]])
                    }
                    _ => declared(expr.ty),
                }
            }
            ExprKind::Read(Place::Parameter { parameter, index }) => {
                let elements = &self.system.instances[self.instance].parameters[*parameter];
                spanned(elements_of(elements, inner.numbers(index.as_deref())).iter().map(number))
            }
            ExprKind::Read(Place::Shown { interface, parameter, of, index }) => {
                let (rows, numbers) = (inner.rows(of), inner.numbers(index.as_deref()));
                let elements = rows
                    .iter()
                    .flat_map(|row| elements_of(self.system.shown(*interface, *row, *parameter), numbers));
                spanned(elements.map(number))
            }
            ExprKind::Read(Place::Local { local, .. }) if expr.ty == Scalar::Real => {
                let automaton = self.system.automaton_of(self.instance);
                let itself = Asking::new(
                    automaton,
                    |kind| matches!(kind, ExprKind::Read(Place::Local { local: of, .. }) if of == local),
                );
                let mut all = vec![number(&automaton.locals[*local].initial)];
                for transition in automaton.states.iter().flat_map(|state| &state.transitions) {
                    let here = Self { transition, ..inner };
                    for update in &transition.updates {
                        let UpdateKind::Assign { target, value, .. } = &update.kind else { continue };
                        let is_it = matches!(target.place, Place::Local { local: of, .. } if of == *local);
                        if is_it && !itself.expression(value) {
                            all.extend(here.span(value)?.map(Some));
                        }
                    }
                }
                spanned(all.into_iter())
            }
            _ => declared(expr.ty),
        }
    }

    fn own(&self, interface: InterfaceId) -> Option<usize> {
        let position = self.system.automaton_of(self.instance).implementing(interface)?;
        Some(self.system.instances[self.instance].rows[position])
    }

    /// The members that a reference may name.
    pub fn rows(&self, expr: &Expr) -> Vec<usize> {
        match &expr.kind {
            ExprKind::Constant(Value::Int(row)) => vec![*row as usize],
            ExprKind::Own(interface) => self.own(*interface).into_iter().collect(),
            ExprKind::Variable(variable) => {
                let assigned = self.transition.updates.iter().find_map(|update| assigns(update, expr));
                if let Some(row) = assigned.and_then(|local| self.bound.row(local)) {
                    return vec![row];
                }
                let mut binders = self.transition.clauses.iter().filter_map(|clause| match clause {
                    crate::ir::Clause::Bind(binder) if binder.variable == *variable => Some(&binder.domain),
                    _ => None,
                });
                match binders.next_back() {
                    Some(Domain::Role(role)) => self.system.instances[self.instance].roles[role.0].clone(),
                    _ => self.all(expr.ty),
                }
            }
            ExprKind::Read(Place::Local { local, index: None }) => match self.bound.row(*local) {
                Some(row) => vec![row],
                None => rows_of_local(self.system, self.instance, *local),
            },
            ExprKind::Define(define) => match self.deeper() {
                Some(inner) => inner.rows(&self.system.automaton_of(self.instance).defines[*define].value),
                None => self.all(expr.ty),
            },
            _ => self.all(expr.ty),
        }
    }

    fn all(&self, ty: Scalar) -> Vec<usize> {
        match ty {
            Scalar::Ref(interface) => (0..self.system.members[interface.0].len()).collect(),
            _ => Vec::new(),
        }
    }
}

/// The local to which an update assigns this variable.
fn assigns(update: &Update, variable: &Expr) -> Option<usize> {
    match &update.kind {
        UpdateKind::Assign { target, value, .. } if value == variable => match target.place {
            Place::Local { local, index: None } => Some(local),
            _ => None,
        },
        _ => None,
    }
}

/// The members that a local may name once it has been written.
pub fn rows_of_local(system: &System, instance: usize, local: usize) -> Vec<usize> {
    let automaton = system.automaton_of(instance);
    let mut rows: Vec<usize> = Vec::new();
    for transition in automaton.states.iter().flat_map(|state| &state.transitions) {
        for update in &transition.updates {
            let UpdateKind::Assign { target, value, .. } = &update.kind else { continue };
            if target.place != (Place::Local { local, index: None }) {
                continue;
            }
            let mut binders = transition.clauses.iter().filter_map(|clause| match (clause, &value.kind) {
                (crate::ir::Clause::Bind(binder), ExprKind::Variable(variable))
                    if binder.variable == *variable =>
                {
                    Some(&binder.domain)
                }
                _ => None,
            });
            match (binders.next_back(), value.ty) {
                (Some(Domain::Role(role)), _) => rows.extend(&system.instances[instance].roles[role.0]),
                (_, Scalar::Ref(interface)) => rows.extend(0..system.members[interface.0].len()),
                _ => {}
            }
        }
    }
    rows.sort_unstable();
    rows.dedup();
    rows
}

/// Those elements of an array that an index may name.
fn elements_of(values: &[Value], numbers: Option<Span>) -> &[Value] {
    let Some([low, high]) = numbers else { return values };
    let last = values.len().saturating_sub(1);
    let (low, high) = ((low.max(0.0) as usize).min(last), (high.max(0.0) as usize).min(last));
    values.get(low..=high).unwrap_or(values)
}

fn declared(ty: Scalar) -> Option<Span> {
    match ty {
        Scalar::Int { lo, hi } => Some([f64::from(lo), f64::from(hi)]),
        _ => None,
    }
}

fn spanned(values: impl Iterator<Item = Option<f64>>) -> Option<Span> {
    let mut all: Option<Span> = None;
    for value in values {
        let value = value?;
        all = Some(all.map_or([value, value], |[low, high]| [low.min(value), high.max(value)]));
    }
    all
}

fn points_of(values: &[Value]) -> Vec<Region> {
    few(values.iter().filter_map(point_of))
}

fn point_of(value: &Value) -> Option<Region> {
    match value {
        Value::Point(point) => Some(point.map(|value| [value, value])),
        _ => None,
    }
}

fn exactly(point: runtime_sim::point::Point) -> Region {
    [[point.x, point.x], [point.y, point.y], [point.z, point.z]]
}
