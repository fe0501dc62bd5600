//! Values and their types.

use super::{EnumId, InterfaceId, KIND};
use runtime_sim::device::{self, PortType};

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scalar {
    Bool,
    Int {
        lo: i32,
        hi: i32,
    },
    Real,
    /// Whole milliseconds, never negative.
    Time,
    Point,
    Enum(EnumId),
    Ref(InterfaceId),
}

impl Scalar {
    /// Words that a value takes in an image and in a trace.
    pub fn words(self) -> usize {
        if self == Scalar::Point { 3 } else { 1 }
    }
}

impl From<PortType> for Scalar {
    fn from(ty: PortType) -> Self {
        match ty {
            PortType::Bool => Scalar::Bool,
            PortType::Int { lo, hi } => Scalar::Int { lo, hi },
            PortType::Real => Scalar::Real,
            PortType::Point => Scalar::Point,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    One,
    Count(usize),
    By(EnumId),
}

impl From<device::Extent> for Extent {
    fn from(extent: device::Extent) -> Self {
        match extent {
            device::Extent::One => Extent::One,
            device::Extent::PerKind => Extent::By(KIND),
            device::Extent::Times(n) => Extent::Count(n),
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Type {
    pub scalar: Scalar,
    pub extent: Extent,
}

/// A value of a scalar type; the elements of an array all begin with the same one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    Bool(bool),
    /// A whole number, a duration in ms, the ordinal of a member, a row.
    Int(i32),
    Real(f64),
    Point([f64; 3]),
}

impl Value {
    /// The value of words of an image or of a trace; words that are not there are 0.
    pub fn from_words(ty: Scalar, words: &[f64]) -> Self {
        let word = |i: usize| words.get(i).copied().unwrap_or(0.0);
        match ty {
            Scalar::Bool => Value::Bool(word(0) != 0.0),
            Scalar::Int { lo, hi } => Value::Int((word(0) as i32).clamp(lo, hi)),
            Scalar::Time | Scalar::Enum(_) | Scalar::Ref(_) => Value::Int(word(0) as i32),
            Scalar::Real => Value::Real(word(0)),
            Scalar::Point => Value::Point([word(0), word(1), word(2)]),
        }
    }

    /// Appends the words of the value.
    pub fn push_words(self, out: &mut Vec<f64>) {
        match self {
            Value::Bool(b) => out.push(f64::from(u8::from(b))),
            Value::Int(i) => out.push(f64::from(i)),
            Value::Real(r) => out.push(r),
            Value::Point(p) => out.extend(p),
        }
    }
}
