//! Updates of a transition. A store that does not fit keeps what it can, latches the fault and ends the step.

use super::code::{Ex, Member, Stmt, advance, assign, binary, name, not, or, when};
use super::context::{Lowering, Phase};
use super::declaration::Basic;
use super::expression::{Spot, limited};
use super::name::Name;
use super::names::ELEMENT;
use crate::ir::{Expr, Extent, FaultId, Place, Scalar, Target, Type, Update, UpdateKind};
use std::collections::HashSet;

impl Lowering<'_> {
    pub fn updates(&mut self, updates: &[Update]) -> Vec<Stmt> {
        self.phase = Phase::Update;
        updates.iter().flat_map(|update| self.update(update)).collect()
    }

    fn update(&mut self, update: &Update) -> Vec<Stmt> {
        self.release();
        let mut body = Vec::new();
        match &update.kind {
            UpdateKind::Assign { target, value, check } => self.assignment(target, value, *check, &mut body),
            UpdateKind::Fill { target, value, check } => self.fill(target, value, *check, &mut body),
            UpdateKind::Copy { target, source, check } => self.copy(target, source, *check, &mut body),
            UpdateKind::Command { verb, arguments } => {
                body.push(Stmt::Comment(self.text(update.place)));
                for argument in arguments {
                    let ty = self.automaton().device.ports[argument.port].ty;
                    let ty = Type { scalar: Scalar::from(ty), extent: Extent::One };
                    let target = Target { place: Place::Port { port: argument.port, index: None }, ty };
                    let mut stored = Vec::new();
                    self.assignment(&target, &argument.value, argument.check, &mut stored);
                    // The next argument may read it, also through a definition.
                    self.forget(&stored);
                    body.append(&mut self.hoisted);
                    body.append(&mut stored);
                }
                body.extend(self.command(*verb));
            }
        }
        self.forget(&body);
        let mut first = std::mem::take(&mut self.hoisted);
        first.extend(body);
        first
    }

    /// Type and member of a command.
    fn verb(&self, verb: i32) -> Option<String> {
        let names = self.names.commands.get(&self.automaton().device.name)?;
        let number = names.values.iter().position(|value| *value == verb)?;
        Some(format!("{}.{}", names.ty, names.members[number]))
    }

    fn command(&self, verb: i32) -> Vec<Stmt> {
        let device = &self.automaton().device;
        let port = |wanted: &str| {
            let position = device.ports.iter().position(|p| p.name == wanted).unwrap_or_default();
            self.own().ports[position][0].clone()
        };
        let note = device.verbs.iter().find(|v| v.number == verb).map_or("", |v| v.name.as_str()).to_string();
        let number =
            [("last", "cmd"), ("got", "got"), ("ack", "ack")].map(|(input, p)| (input, name(port(p))));
        let mut out = vec![
            assign(port("verb"), Ex::Member(Member { value: verb, note, qualified: self.verb(verb) })),
            assign(port("cmd"), Ex::Call("F_next_command", number.into())),
        ];
        let answer_counts = self.automaton().abandoned.into_iter().chain(self.automaton().interrupted);
        out.extend(answer_counts.map(|local| assign(&self.own().locals[local][0], Ex::Bool(false))));
        out
    }

    fn assignment(&mut self, target: &Target, value: &Expr, check: Option<FaultId>, out: &mut Vec<Stmt>) {
        let values = match target.ty.scalar {
            Scalar::Point => self.coordinates(value, out),
            _ => vec![self.value(value, out)],
        };
        let spot = self.spot(&target.place, out);
        self.store(spot, target.ty.scalar, values, range(value), check, out);
    }

    /// Every element of an array becomes the same value.
    fn fill(&mut self, target: &Target, value: &Expr, check: Option<FaultId>, out: &mut Vec<Stmt>) {
        let scalar = target.ty.scalar;
        let values = match scalar {
            Scalar::Point => self.coordinates(value, out),
            _ => vec![self.value(value, out)],
        };
        let basic = Basic::of(scalar);
        let values = values.into_iter().map(|v| self.kept(v, new_value(basic), basic, out)).collect();
        let mut to = self.spot(&at_element(&target.place), out);
        let written = to.names.clone();
        self.keep_row(&mut to, &written, out);
        self.elements(to, target.ty, out, |lowering, to, out| {
            lowering.store(to, scalar, values, range(value), check, out);
        });
    }

    fn copy(&mut self, target: &Target, source: &Place, check: Option<FaultId>, out: &mut Vec<Stmt>) {
        let scalar = target.ty.scalar;
        let ty = target.ty;
        let mut from = self.spot(&at_element(source), out);
        let mut to = self.spot(&at_element(&target.place), out);
        let written = to.names.clone();
        self.keep_row(&mut from, &written, out);
        self.keep_row(&mut to, &written, out);
        self.elements(to, ty, out, |lowering, to, out| {
            let from = lowering.at(from, ty);
            let values = (0..from.names.len()).map(|part| from.value(part)).collect();
            let range = from.limit.unwrap_or((i32::MIN, i32::MAX));
            lowering.store(to, scalar, values, range, check, out);
        });
    }

    /// A loop over the elements of an array that was looked up without index.
    fn elements(
        &mut self,
        array: Spot,
        ty: Type,
        out: &mut Vec<Stmt>,
        body: impl FnOnce(&mut Self, Spot, &mut Vec<Stmt>),
    ) {
        let n = self.system.model.elements(ty.extent);
        let spot = self.at(array, ty);
        out.push(assign(ELEMENT, Ex::Int(0)));
        let mut inner = Vec::new();
        body(self, spot, &mut inner);
        inner.push(advance(ELEMENT));
        out.push(Stmt::While {
            condition: binary("<", name(ELEMENT), Ex::Int(n as i32)),
            body: inner,
            most: n as u64,
        });
    }

    /// Looks up the row of an array before the loop over its elements, if the loop writes what leads to the row.
    fn keep_row(&mut self, spot: &mut Spot, written: &[Name], out: &mut Vec<Stmt>) {
        let Some(row) = &spot.index else { return };
        let mut read = HashSet::new();
        row.names(&mut read);
        if written.iter().any(|name| read.contains(name)) {
            let row = row.clone();
            spot.index = Some(self.kept(row, "row", Basic::Dint, out));
        }
    }

    /// The element `e` of a place that was looked up without index.
    fn at(&self, spot: Spot, ty: Type) -> Spot {
        let element = name(ELEMENT);
        let index = match spot.index {
            None => element,
            Some(row) => self.in_table(row, ty, Some(element)),
        };
        Spot { index: Some(index), ..spot }
    }

    /// A value that is read more than once.
    fn kept(&mut self, value: Ex, purpose: &str, basic: Basic, out: &mut Vec<Stmt>) -> Ex {
        if matches!(value, Ex::Bool(_) | Ex::Int(_) | Ex::Real(_) | Ex::Member(_)) {
            return value;
        }
        let variable = self.temporary(purpose, basic);
        out.push(assign(&variable, value));
        name(&variable)
    }

    fn store(
        &mut self,
        spot: Spot,
        scalar: Scalar,
        values: Vec<Ex>,
        range: (i32, i32),
        check: Option<FaultId>,
        out: &mut Vec<Stmt>,
    ) {
        let bounds = match scalar {
            Scalar::Int { lo, hi } => Some((lo, hi)),
            Scalar::Time => Some((0, i32::MAX)),
            _ => None,
        };
        match (check, bounds, scalar) {
            (Some(fault), Some(bounds), _) => {
                self.store_whole(
                    spot,
                    values.into_iter().next().unwrap_or(Ex::Int(0)),
                    bounds,
                    range,
                    fault,
                    out,
                );
            }
            (Some(fault), None, Scalar::Real | Scalar::Point) => {
                let is_point = scalar == Scalar::Point;
                let purposes: &[&str] = if is_point { &["new_x", "new_y", "new_z"] } else { &["new_value"] };
                let values: Vec<Ex> = values
                    .into_iter()
                    .zip(purposes)
                    .map(|(v, purpose)| self.kept(v, purpose, Basic::Lreal, out))
                    .collect();
                let function = if is_point { "F_is_finite_point" } else { "F_is_finite" };
                let inputs: &[&str] = if is_point { &["x", "y", "z"] } else { &["value"] };
                let is_finite =
                    Ex::Call(function, inputs.iter().copied().zip(values.iter().cloned()).collect());
                out.push(when(not(is_finite), self.raise(fault)));
                out.extend(
                    (0..values.len()).map(|part| Stmt::Assign(spot.target(part), values[part].clone())),
                );
            }
            _ => {
                let values = self.independent(&spot, values, out);
                let stores =
                    values.into_iter().enumerate().map(|(part, v)| Stmt::Assign(spot.target(part), v));
                out.extend(stores);
            }
        }
    }

    /// Coordinates that are not read after they were overwritten.
    fn independent(&mut self, spot: &Spot, values: Vec<Ex>, out: &mut Vec<Stmt>) -> Vec<Ex> {
        let reads_others = values.iter().enumerate().any(|(part, value)| {
            let mut read = HashSet::new();
            value.names(&mut read);
            spot.names.iter().enumerate().any(|(other, n)| other != part && read.contains(n))
        });
        if !reads_others {
            return values;
        }
        let purposes = ["new_x", "new_y", "new_z"];
        values
            .into_iter()
            .zip(purposes)
            .map(|(v, purpose)| self.kept(v, purpose, Basic::Lreal, out))
            .collect()
    }

    /// Stores a whole number, then limits it if it can leave its bounds.
    fn store_whole(
        &mut self,
        mut spot: Spot,
        value: Ex,
        (low, high): (i32, i32),
        range: (i32, i32),
        fault: FaultId,
        out: &mut Vec<Stmt>,
    ) {
        let before = spot.target(0);
        spot.index = match spot.index {
            Some(Ex::Within(row, each, element)) => {
                let row = self.index_kept("row", *row, &spot.names, out);
                let element = self.index_kept("element", *element, &spot.names, out);
                Some(Ex::Within(Box::new(row), each, Box::new(element)))
            }
            Some(index) => Some(self.index_kept("element", index, &spot.names, out)),
            None => None,
        };
        let value = replaced(value, &before, &spot.target(0));
        out.push(Stmt::Assign(spot.target(0), value));
        let place = spot.target(0);
        let under = (range.0 < low).then(|| binary("<", place.clone(), Ex::Int(low)));
        let over = (range.1 > high).then(|| binary(">", place.clone(), Ex::Int(high)));
        let nearest = match (&under, &over) {
            (Some(_), None) => Ex::Int(low),
            (None, Some(_)) => Ex::Int(high),
            _ => limited(place.clone(), (low, high)),
        };
        let leaves: Vec<Ex> = under.into_iter().chain(over).collect();
        if !leaves.is_empty() {
            let body = [Stmt::Assign(place, nearest)].into_iter().chain(self.raise(fault)).collect();
            out.push(when(or(leaves), body));
        }
    }

    /// An index that stays the same while these variables are written.
    fn index_kept(&mut self, purpose: &str, index: Ex, written: &[Name], out: &mut Vec<Stmt>) -> Ex {
        let stays = match &index {
            Ex::Int(_) => true,
            Ex::Name(index) => !written.contains(index),
            _ => false,
        };
        if stays {
            return index;
        }
        let kept = self.temporary(purpose, Basic::Dint);
        out.push(assign(&kept, index));
        name(&kept)
    }

    /// Latches a fault and ends the step.
    pub fn raise(&self, fault: FaultId) -> Vec<Stmt> {
        let site = &self.system.model.faults[fault.0];
        let note = format!("{}   {}", site.text, self.line(site.place));
        vec![
            assign("fault_code", Ex::Member(Member { value: fault.0 as i32 + 1, note, qualified: None })),
            assign("fault_robot", name("robot")),
            Stmt::Return,
        ]
    }
}

/// Between which numbers a value lies, as far as is known.
fn range(value: &Expr) -> (i32, i32) {
    match value.ty {
        Scalar::Int { lo, hi } => (lo, hi),
        _ => (i32::MIN, i32::MAX),
    }
}

fn new_value(basic: Basic) -> &'static str {
    match basic {
        Basic::Bool => "new_flag",
        Basic::Dint | Basic::Sint | Basic::Usint | Basic::Int | Basic::Uint => "new_number",
        Basic::Lreal => "new_value",
    }
}

/// The place of an array without index, so that only its row is looked up.
fn at_element(place: &Place) -> Place {
    let mut place = place.clone();
    match &mut place {
        Place::Local { index, .. }
        | Place::Cell { index, .. }
        | Place::Port { index, .. }
        | Place::Parameter { index, .. }
        | Place::Shown { index, .. } => *index = None,
    }
    place
}

/// The expression with one part of it replaced.
fn replaced(ex: Ex, old: &Ex, new: &Ex) -> Ex {
    if &ex == old {
        return new.clone();
    }
    let again = |e: Box<Ex>| Box::new(replaced(*e, old, new));
    match ex {
        Ex::Binary(operator, a, b) => Ex::Binary(operator, again(a), again(b)),
        Ex::Minus(a) => Ex::Minus(again(a)),
        Ex::Not(a) => Ex::Not(again(a)),
        Ex::Element(array, index) => Ex::Element(array, again(index)),
        Ex::Within(row, each, element) => Ex::Within(again(row), each, again(element)),
        other => other,
    }
}
