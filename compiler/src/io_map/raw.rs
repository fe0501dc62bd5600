//! The types of raw values.

use super::address::Size;

/// What all compilers convert to DINT and back alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Raw {
    Bool,
    Sint,
    Usint,
    Int,
    Uint,
    Dint,
}

pub const ALL: [Raw; 6] = [Raw::Bool, Raw::Sint, Raw::Usint, Raw::Int, Raw::Uint, Raw::Dint];

impl Raw {
    pub fn named(name: &str) -> Option<Self> {
        ALL.into_iter().find(|raw| raw.name().eq_ignore_ascii_case(name))
    }

    pub fn name(self) -> &'static str {
        match self {
            Raw::Bool => "BOOL",
            Raw::Sint => "SINT",
            Raw::Usint => "USINT",
            Raw::Int => "INT",
            Raw::Uint => "UINT",
            Raw::Dint => "DINT",
        }
    }

    pub fn size(self) -> Size {
        match self {
            Raw::Bool => Size::Bit,
            Raw::Sint | Raw::Usint => Size::Byte,
            Raw::Int | Raw::Uint => Size::Word,
            Raw::Dint => Size::Double,
        }
    }

    /// Least and greatest value.
    pub fn bounds(self) -> (i32, i32) {
        match self {
            Raw::Bool => (0, 1),
            Raw::Sint => (-128, 127),
            Raw::Usint => (0, 255),
            Raw::Int => (-32_768, 32_767),
            Raw::Uint => (0, 65_535),
            Raw::Dint => (i32::MIN, i32::MAX),
        }
    }

    /// The nearest raw value, halves away from 0; 0 for what is no number. As `F_rounded` of the text computes it.
    pub fn rounded(self, value: f64) -> i32 {
        let (low, high) = self.bounds();
        if value >= f64::from(high) {
            high
        } else if value <= f64::from(low) {
            low
        } else if value > 0.0 {
            (value + 0.5) as i32
        } else if value < 0.0 {
            (value - 0.5) as i32
        } else {
            0
        }
    }
}
