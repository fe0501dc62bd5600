//! Kinds of ports, and the answers of commands.
//!
//! Whatever moves is driven by numbered commands: the controller writes a
//! command's arguments, its `verb` and a new number `cmd` in one scan; the
//! device answers with the number it has accepted (`got`), the number it has
//! ended (`ack`) and an `error` (0: reached). While the output `hold` is true the
//! device halts on its path; it continues with the same command when `hold` falls.
//!
//! A process image holds one number (`f64`) for each point of I/O: booleans as
//! 0 and 1, whole numbers, reals; a `point` takes three. Inputs and outputs of a
//! machine stand in the order of its device, arrays element by element.

/// Seen from the controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    Input,
    Output,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PortType {
    Bool,
    Int { lo: i32, hi: i32 },
    Real,
    Point,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    One,
    /// One element for each kind of part.
    PerKind,
    Times(usize),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stop {
    /// The last value written stays.
    Hold,
    Value(f64),
}

impl PortType {
    /// All whole numbers that a type of the language has.
    pub const WHOLE: Self = Self::Int { lo: -i32::MAX, hi: i32::MAX };

    /// Numbers that one value takes in a process image.
    pub const fn words(self) -> usize {
        match self {
            PortType::Point => 3,
            _ => 1,
        }
    }
}

impl Extent {
    /// Number of elements when there are `kinds` kinds of part.
    pub const fn elements(self, kinds: usize) -> usize {
        match self {
            Extent::One => 1,
            Extent::PerKind => kinds,
            Extent::Times(n) => n,
        }
    }
}

/// Highest command number; the number after it is 1. 0 means that no command was given yet.
pub const LAST_COMMAND: i32 = 32767;

/// Answers of a device in `error`.
pub mod error {
    pub const NONE: i32 = 0;
    /// The goal, or a place to pass, has no inverse-kinematic solution within the limits.
    pub const UNREACHABLE: i32 = 1;
    /// The tool came to its goal and nothing was gripped.
    pub const NO_PART: i32 = 2;
    /// The device refused the command.
    pub const REFUSED: i32 = 3;
    /// The number of the command became 0, after a loss of power.
    pub const WITHDRAWN: i32 = 6;
}
