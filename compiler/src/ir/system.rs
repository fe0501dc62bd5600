//! A model with the instances of one layout.

use super::{Automaton, AutomatonId, InterfaceId, KIND, Model, Scalar, Value};

/// A model with the instances of one layout.
#[derive(Clone, Debug)]
pub struct System {
    pub model: Model,
    pub scan_ms: i32,
    /// In layout order: the order in which they step.
    pub instances: Vec<Instance>,
    /// For each interface its members, in layout order: the instance of each row.
    pub members: Vec<Vec<usize>>,
    /// For each relation, `[row of from][row of to]`.
    pub reaches: Vec<Vec<Vec<bool>>>,
}

#[derive(Clone, Debug)]
pub struct Instance {
    pub name: String,
    pub automaton: AutomatonId,
    /// For each parameter its elements.
    pub parameters: Vec<Vec<Value>>,
    /// For each role its members, as rows of the role's interface, in layout order.
    pub roles: Vec<Vec<usize>>,
    /// For each interface that the automaton implements, this instance's row.
    pub rows: Vec<usize>,
}

impl System {
    pub fn automaton_of(&self, instance: usize) -> &Automaton {
        self.model.automaton(self.instances[instance].automaton)
    }

    /// The elements of a parameter that a member of an interface shows.
    pub fn shown(&self, interface: InterfaceId, row: usize, parameter: usize) -> &[Value] {
        let instance = self.members[interface.0][row];
        let implements = &self.automaton_of(instance).implements;
        let supplied = implements.iter().find(|i| i.interface == interface).map(|i| i.parameters[parameter]);
        supplied.map_or(&[], |p| &self.instances[instance].parameters[p])
    }

    pub fn kinds(&self) -> usize {
        self.model.enums[KIND.0].members.len()
    }

    /// A value for people: seconds with `s`, points in metres, members and robots by name.
    pub fn shown_value(&self, ty: Scalar, value: Value) -> String {
        match (value, ty) {
            (Value::Bool(b), _) => b.to_string(),
            (Value::Int(ms), Scalar::Time) => format!("{} s", f64::from(ms) / 1000.0),
            (Value::Int(ordinal), Scalar::Enum(id)) => {
                self.model.enums[id.0].members[ordinal as usize].clone()
            }
            (Value::Int(row), Scalar::Ref(id)) => {
                self.instances[self.members[id.0][row as usize]].name.clone()
            }
            (Value::Int(i), _) => i.to_string(),
            (Value::Real(r), _) => r.to_string(),
            (Value::Point([x, y, z]), _) => format!("({x}, {y}, {z})"),
        }
    }
}
