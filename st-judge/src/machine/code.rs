//! The internal form: names are resolved to words of memory, types to the kind of the node.

use super::TrapKind;
use crate::finding::Span;
use crate::view::Binary;

#[derive(Clone, Debug, Default)]
pub(super) struct Code {
    /// Functions and function blocks.
    pub(super) units: Vec<Body>,
    /// Body and first word of each program, in the order in which they run.
    pub(super) programs: Vec<(usize, usize)>,
    pub(super) branches: Vec<BranchInfo>,
    pub(super) statements: Vec<Span>,
    /// Of IF and ELSIF.
    pub(super) conditions: Vec<Span>,
    pub(super) interval_ms: Option<u32>,
}

#[derive(Clone, Debug)]
pub(super) struct BranchInfo {
    pub(super) unit: String,
    pub(super) label: String,
    pub(super) at: usize,
}

pub(super) type Body = Vec<Numbered>;

#[derive(Clone, Debug)]
pub(super) struct Numbered {
    pub(super) number: usize,
    pub(super) step: Step,
}

#[derive(Clone, Debug)]
pub(super) enum Step {
    Store(Cell, Any),
    Call(BlockCall),
    If(Vec<Arm>, Body),
    Case(Box<Case>),
    While(Truth, Body, usize),
    Exit,
    Return,
}

#[derive(Clone, Debug)]
pub(super) struct Arm {
    /// Number of the condition.
    pub(super) number: usize,
    pub(super) condition: Truth,
    pub(super) body: Body,
}

#[derive(Clone, Debug)]
pub(super) struct Case {
    pub(super) subject: Whole,
    /// Label and number of the arm, sorted by label.
    pub(super) labels: Vec<(i32, usize)>,
    /// Number of the branch and its statements; the last is that of ELSE.
    pub(super) arms: Vec<(usize, Body)>,
}

#[derive(Clone, Debug)]
pub(super) struct BlockCall {
    pub(super) unit: usize,
    pub(super) instance: Slot,
    /// Offset in the frame, value.
    pub(super) inputs: Vec<(usize, Any)>,
    /// What is copied back: offset in the frame, first word outside, number of words.
    pub(super) copied_back: Vec<(usize, Slot, usize)>,
}

#[derive(Clone, Debug)]
pub(super) struct FunctionCall {
    pub(super) unit: usize,
    pub(super) base: usize,
    pub(super) size: usize,
    pub(super) inputs: Vec<(usize, Any)>,
}

/// A word: of the present frame, or of memory.
#[derive(Clone, Copy, Debug)]
pub(super) enum Slot {
    Frame(usize),
    Memory(usize),
}

#[derive(Clone, Debug)]
pub(super) enum Cell {
    Slot(Slot),
    Element { start: Slot, length: usize, index: Box<Whole>, at: usize },
}

#[derive(Clone, Debug)]
pub(super) enum Any {
    Truth(Truth),
    Whole(Whole),
    Real(Real),
    /// First word and number of words.
    Array(Slot, usize),
}

#[derive(Clone, Debug)]
pub(super) enum Truth {
    Constant(bool),
    Load(Cell),
    Not(Box<Truth>),
    And(Box<(Truth, Truth)>),
    Or(Box<(Truth, Truth)>),
    Xor(Box<(Truth, Truth)>),
    Wholes(Binary, Box<(Whole, Whole)>),
    Reals(Binary, Box<(Real, Real)>),
    Select(Box<(Truth, Truth, Truth)>),
    Call(FunctionCall),
}

#[derive(Clone, Debug)]
pub(super) enum Whole {
    Constant(i32),
    Load(Cell),
    Minus(Box<Whole>, usize),
    Binary(Binary, Box<(Whole, Whole)>, usize),
    Abs(Box<Whole>, usize),
    Min(Box<(Whole, Whole)>),
    Max(Box<(Whole, Whole)>),
    Limit(Box<(Whole, Whole, Whole)>),
    Select(Box<(Truth, Whole, Whole)>),
    Trunc(Box<Real>, usize),
    OfTruth(Box<Truth>),
    /// A value that has to be within bounds.
    Within(Box<Whole>, (i32, i32), usize),
    Call(FunctionCall),
}

#[derive(Clone, Debug)]
pub(super) enum Real {
    Constant(f64),
    Load(Cell),
    Minus(Box<Real>),
    Binary(Binary, Box<(Real, Real)>, usize),
    Function(Function, Box<Real>, usize),
    Power(Box<(Real, Real)>),
    Min(Box<(Real, Real)>),
    Max(Box<(Real, Real)>),
    Limit(Box<(Real, Real, Real)>),
    Select(Box<(Truth, Real, Real)>),
    OfWhole(Box<Whole>),
    Call(FunctionCall),
}

#[derive(Clone, Copy, Debug)]
pub(super) enum Function {
    Abs,
    Sqrt,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Exp,
    Ln,
}

/// Why execution ends, and at which byte of the text.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trap {
    pub(super) kind: TrapKind,
    pub(super) at: usize,
}
