//! What the printers of one automaton share.

use super::names::{AutomatonNames, Names};
use super::walk::{Access, Uses};
use crate::ir::{Automaton, AutomatonId, Extent, Scalar, System, Type, Value};
use crate::source::{Sources, Span};

#[derive(Clone, Copy)]
pub struct Shared<'a> {
    pub system: &'a System,
    pub sources: &'a Sources,
    pub names: &'a Names,
}

#[derive(Clone, Copy)]
pub struct Context<'a> {
    shared: Shared<'a>,
    id: AutomatonId,
}

impl<'a> std::ops::Deref for Context<'a> {
    type Target = Shared<'a>;

    fn deref(&self) -> &Shared<'a> {
        &self.shared
    }
}

impl<'a> Context<'a> {
    pub fn new(shared: Shared<'a>, id: AutomatonId) -> Self {
        Self { shared, id }
    }

    pub fn automaton(&self) -> &'a Automaton {
        self.shared.system.model.automaton(self.id)
    }

    /// The names of the automaton.
    pub fn own(&self) -> &'a AutomatonNames {
        &self.shared.names.automata[self.id.0]
    }

    /// What a method is called with.
    pub fn arguments(&self, uses: &Uses) -> String {
        list([
            ("wiring", uses.wiring),
            ("cells", uses.cells != Access::None),
            ("scan", uses.scan),
            ("start", uses.start),
        ])
    }

    /// What a method declares behind `self`.
    pub fn parameters(&self, uses: &Uses) -> String {
        let reference = if uses.cells == Access::Write { "cells: &mut Cells" } else { "cells: &Cells" };
        list([
            ("wiring: &Wiring", uses.wiring),
            (reference, uses.cells != Access::None),
            ("scan: i32", uses.scan),
            ("start: bool", uses.start),
        ])
    }
}

fn list(entries: [(&str, bool); 4]) -> String {
    entries.iter().filter(|(_, is_used)| *is_used).map(|(text, _)| *text).collect::<Vec<_>>().join(", ")
}

impl Shared<'_> {
    pub fn scalar(&self, ty: Scalar) -> String {
        match ty {
            Scalar::Bool => "bool".into(),
            Scalar::Int { .. } | Scalar::Time => "i32".into(),
            Scalar::Real => "f64".into(),
            Scalar::Point => "Point".into(),
            Scalar::Enum(id) => self.names.enums[id.0].ty.clone(),
            Scalar::Ref(id) => self.names.interfaces[id.0].reference.clone(),
        }
    }

    pub fn ty(&self, ty: Type) -> String {
        let scalar = self.scalar(ty.scalar);
        match ty.extent {
            Extent::One => scalar,
            Extent::Count(n) => format!("Array<{scalar}, {n}>"),
            Extent::By(id) => format!("Array<{scalar}, {{ {}::COUNT }}>", self.names.enums[id.0].ty),
        }
    }

    pub fn value(&self, ty: Scalar, value: Value) -> String {
        match (ty, value) {
            (Scalar::Enum(id), Value::Int(i)) => {
                let names = &self.names.enums[id.0];
                format!("{}::{}", names.ty, names.members[(i.max(0) as usize).min(names.members.len() - 1)])
            }
            (Scalar::Ref(id), Value::Int(i)) => format!("{}({i})", self.names.interfaces[id.0].reference),
            (_, Value::Bool(b)) => b.to_string(),
            (_, Value::Int(i)) => i.to_string(),
            (_, Value::Real(r)) => format!("{r:?}"),
            (_, Value::Point([x, y, z])) => format!("Point::new({x:?}, {y:?}, {z:?})"),
        }
    }

    /// An array that begins with the same value everywhere, or the value.
    pub fn filled(&self, ty: Type, value: Value) -> String {
        let one = self.value(ty.scalar, value);
        if ty.extent == Extent::One { one } else { format!("Array::all({one})") }
    }

    /// `agv.aut:12`
    pub fn line(&self, place: Span) -> String {
        format!("{}:{}", self.sources.file(place.file).name, self.sources.position(place).0)
    }
}
