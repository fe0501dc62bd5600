//! The types of the portable core.

use std::fmt;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Scalar {
    Bool,
    Dint,
    Lreal,
    /// Of variables in the process image only.
    Narrow(Narrow),
}

/// Whole numbers of less than 32 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Narrow {
    Sint,
    Usint,
    Int,
    Uint,
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
            word => Narrow::named(word).map(Scalar::Narrow),
        }
    }

    /// What arithmetic and order are for.
    pub fn is_number(self) -> bool {
        matches!(self, Scalar::Dint | Scalar::Lreal)
    }
}

impl Narrow {
    const ALL: [Self; 4] = [Narrow::Sint, Narrow::Usint, Narrow::Int, Narrow::Uint];

    /// In capital letters.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|narrow| narrow.name() == name)
    }

    pub fn name(self) -> &'static str {
        match self {
            Narrow::Sint => "SINT",
            Narrow::Usint => "USINT",
            Narrow::Int => "INT",
            Narrow::Uint => "UINT",
        }
    }

    /// Least and greatest value.
    pub fn bounds(self) -> (i32, i32) {
        match self {
            Narrow::Sint => (-128, 127),
            Narrow::Usint => (0, 255),
            Narrow::Int => (-32_768, 32_767),
            Narrow::Uint => (0, 65_535),
        }
    }

    pub fn bits(self) -> u32 {
        match self {
            Narrow::Sint | Narrow::Usint => 8,
            Narrow::Int | Narrow::Uint => 16,
        }
    }
}

impl fmt::Display for Scalar {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Scalar::Bool => "BOOL",
            Scalar::Dint => "DINT",
            Scalar::Lreal => "LREAL",
            Scalar::Narrow(narrow) => narrow.name(),
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
