//! The types of the portable core.

use std::fmt;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Scalar {
    Bool,
    Dint,
    Lreal,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Type {
    Scalar(Scalar),
    /// `ARRAY[0..upper]`.
    Array(Scalar, usize),
    /// An instance of the function block with this key.
    Block(String),
}

pub const BOOL: Type = Type::Scalar(Scalar::Bool);
pub const DINT: Type = Type::Scalar(Scalar::Dint);
pub const LREAL: Type = Type::Scalar(Scalar::Lreal);

impl Scalar {
    pub fn named(name: &str) -> Option<Self> {
        match name.to_ascii_uppercase().as_str() {
            "BOOL" => Some(Scalar::Bool),
            "DINT" => Some(Scalar::Dint),
            "LREAL" => Some(Scalar::Lreal),
            _ => None,
        }
    }
}

impl fmt::Display for Scalar {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Scalar::Bool => "BOOL",
            Scalar::Dint => "DINT",
            Scalar::Lreal => "LREAL",
        })
    }
}

impl fmt::Display for Type {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Type::Scalar(scalar) => scalar.fmt(f),
            Type::Array(element, upper) => write!(f, "ARRAY[0..{upper}] OF {element}"),
            Type::Block(name) => write!(f, "function block {name}"),
        }
    }
}
