//! What outlasts a loss of power.

use super::{Automaton, FaultId, InterfaceId, Model, Scalar, System, Type, Value};
use std::collections::BTreeSet;

/// What of the instances of a type outlasts a loss of power, and stays when an instance begins anew.
#[derive(Clone, Debug, Default)]
pub struct Retained {
    /// The state, and with it the number of the last command.
    pub state: bool,
    pub locals: BTreeSet<usize>,
    /// Cells of its own, by their interface.
    pub cells: BTreeSet<(InterfaceId, usize)>,
    /// Output ports of the device.
    pub ports: BTreeSet<usize>,
}

impl Retained {
    pub fn is_empty(&self) -> bool {
        !self.state && self.locals.is_empty() && self.cells.is_empty() && self.ports.is_empty()
    }
}

impl Automaton {
    /// States in which an instance continues after a loss of power, or after it was moved by hand.
    pub fn resumable(&self) -> impl Iterator<Item = usize> {
        self.states.iter().enumerate().filter(|(_, state)| state.is_resumable).map(|(number, _)| number)
    }
}

impl System {
    /// As of its model, and of the instances in layout order: their names, their types, their parameters, and the members
    /// of their roles. What is remembered of the places of one layout is wrong in another.
    pub fn shape_of_retained(&self) -> u32 {
        let mut shape = Shape::BEGIN;
        shape.number(self.model.shape_of_retained() as i32);
        self.add_instances(&mut shape);
        shape.end()
    }

    /// A number that changes when the instances do: as [`Self::shape_of_retained`], without what is retained.
    pub fn shape_of_instances(&self) -> u32 {
        let mut shape = Shape::BEGIN;
        self.add_instances(&mut shape);
        shape.end()
    }

    fn add_instances(&self, shape: &mut Shape) {
        for instance in &self.instances {
            shape.text(&instance.name);
            shape.text(&self.model.automaton(instance.automaton).name);
            for values in &instance.parameters {
                shape.number(values.len() as i32);
                values.iter().for_each(|value| shape.constant(*value));
            }
            for members in &instance.roles {
                shape.number(members.len() as i32);
                members.iter().for_each(|member| shape.number(*member as i32));
            }
        }
    }
}

impl Model {
    /// Whether any type retains something, also one without an instance: the fault then outlasts a loss of power.
    pub fn retains(&self) -> bool {
        self.automata.iter().any(|automaton| !automaton.retained.is_empty())
    }

    /// A number that changes when what is retained does: names of states, names and types of values, and the causes of
    /// faults with their codes, because the fault is retained too. The FNV-1a hash, 31 bits of it, never 0.
    pub fn shape_of_retained(&self) -> u32 {
        let mut shape = Shape::BEGIN;
        for automaton in self.automata.iter().filter(|automaton| !automaton.retained.is_empty()) {
            let retained = &automaton.retained;
            shape.text(&automaton.name);
            for state in automaton.states.iter().filter(|_| retained.state) {
                shape.text(&state.name);
                shape.number(i32::from(state.is_resumable));
            }
            for local in &retained.locals {
                shape.value(&automaton.locals[*local].name, automaton.locals[*local].ty, self);
            }
            for (interface, cell) in &retained.cells {
                let cell = &self.interface(*interface).cells[*cell];
                shape.value(&cell.name, cell.ty, self);
            }
            for port in &retained.ports {
                let port = &automaton.device.ports[*port];
                let ty = Type { scalar: port.ty.into(), extent: port.extent.into() };
                shape.value(&port.name, ty, self);
            }
        }
        for (number, site) in self.faults.iter().enumerate() {
            let automaton = self.automaton(site.automaton);
            shape.text(&automaton.name);
            automaton.situation(FaultId(number)).iter().for_each(|part| shape.text(part));
            shape.text(&site.text);
            shape.number(site.kind as i32);
            shape.number(site.severity as i32);
        }
        shape.end()
    }
}

struct Shape(u32);

impl Shape {
    const BEGIN: Self = Self(0x811c_9dc5);

    fn end(self) -> u32 {
        (self.0 & 0x7fff_ffff).max(1)
    }

    fn byte(&mut self, byte: u8) {
        self.0 = (self.0 ^ u32::from(byte)).wrapping_mul(0x0100_0193);
    }

    /// Ends with a byte that no text has.
    fn text(&mut self, text: &str) {
        text.bytes().chain([0xff]).for_each(|byte| self.byte(byte));
    }

    fn number(&mut self, number: i32) {
        number.to_le_bytes().into_iter().for_each(|byte| self.byte(byte));
    }

    fn constant(&mut self, value: Value) {
        let real =
            |shape: &mut Self, real: f64| real.to_le_bytes().into_iter().for_each(|byte| shape.byte(byte));
        match value {
            Value::Bool(truth) => self.number(i32::from(truth)),
            Value::Int(number) => self.number(number),
            Value::Real(number) => real(self, number),
            Value::Point(coordinates) => coordinates.into_iter().for_each(|number| real(self, number)),
        }
    }

    fn value(&mut self, name: &str, ty: Type, model: &Model) {
        self.text(name);
        self.number(model.elements(ty.extent) as i32);
        match ty.scalar {
            Scalar::Bool => self.text("bool"),
            Scalar::Real => self.text("real"),
            Scalar::Point => self.text("point"),
            Scalar::Time => self.text("time"),
            Scalar::Int { lo, hi } => {
                self.text("int");
                self.number(lo);
                self.number(hi);
            }
            Scalar::Enum(id) => {
                let declared = &model.enums[id.0];
                self.text(&declared.name);
                declared.members.iter().for_each(|member| self.text(member));
            }
            Scalar::Ref(id) => self.text(&model.interface(id).name),
        }
    }
}
