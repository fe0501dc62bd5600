//! What a state consists of: where each value stands, and what it is at first.

use crate::ir::{Scalar, Value};
use autogen_search::model::{Form, Variable};
use autogen_search::value::{Values, Var};

/// The state, as far as it has been laid out.
#[derive(Default)]
pub struct Memory {
    pub initial: Vec<u8>,
    /// Of each byte the instance that owns it, as the number of a bit.
    pub owners: Vec<u8>,
    pub variables: Vec<Variable>,
    pub values: Values,
}

/// How a value of a type is kept.
#[derive(Clone, Copy, Debug)]
pub struct Kept {
    width: u8,
    /// The state holds so much less.
    pub low: i32,
}

pub fn kept(ty: Scalar, members: impl Fn(Scalar) -> usize) -> Kept {
    let width = |values: i64| match values {
        ..=256 => 1,
        257..=65_536 => 2,
        _ => 4,
    };
    match ty {
        Scalar::Bool => Kept { width: 1, low: 0 },
        Scalar::Int { lo, hi } => {
            let width = width(i64::from(hi) - i64::from(lo) + 1);
            Kept { width, low: if width == 4 { 0 } else { lo } }
        }
        Scalar::Time => Kept { width: 4, low: 0 },
        Scalar::Real | Scalar::Point => Kept { width: 2, low: 0 },
        Scalar::Enum(_) | Scalar::Ref(_) => Kept { width: width(members(ty) as i64), low: 0 },
    }
}

impl Memory {
    /// A value that is a number of the search itself.
    pub fn number(&mut self, owner: usize, name: String, most: usize, initial: i32) -> Var {
        let width = if most < 256 { 1 } else { 2 };
        self.add(owner, name, Kept { width, low: 0 }, Form::Int(0), initial)
    }

    pub fn point(&mut self, owner: usize, name: String, initial: [f64; 3]) -> Var {
        let number = self.values.number_of_point(initial);
        self.add(owner, name, Kept { width: 2, low: 0 }, Form::Point, number)
    }

    pub fn value(&mut self, owner: usize, name: String, ty: Scalar, kept: Kept, initial: Value) -> Var {
        let (form, number) = match (ty, initial) {
            (_, Value::Bool(b)) => (Form::Int(0), i32::from(b)),
            (_, Value::Int(i)) => (Form::Int(kept.low), i - kept.low),
            (_, Value::Real(r)) => (Form::Real, self.values.number_of_real(r)),
            (_, Value::Point(p)) => (Form::Point, self.values.number_of_point(p)),
        };
        self.add(owner, name, kept, form, number)
    }

    fn add(&mut self, owner: usize, name: String, kept: Kept, form: Form, initial: i32) -> Var {
        let var = Var { at: self.initial.len() as u32, width: kept.width };
        self.initial.resize(self.initial.len() + usize::from(kept.width), 0);
        self.owners.resize(self.initial.len(), (owner % 64) as u8);
        var.store(&mut self.initial, initial);
        self.variables.push(Variable { var, name, form });
        var
    }

    /// A whole number of words of 8 bytes.
    pub fn end(&mut self) {
        let length = self.initial.len().max(1).next_multiple_of(8);
        self.initial.resize(length, 0);
        self.owners.resize(length, 0);
    }
}
