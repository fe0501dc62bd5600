//! Automata of one line, each by itself: every name is a place in the state, a table or a number.

use crate::plant::sight;
use crate::property::Property;
use crate::value::{Point, Var};
use std::ops::BitOr;
use std::sync::Arc;

/// Whole numbers, truths (0 and 1), times in ms, members of enumerations and rows.
#[derive(Clone, Debug)]
pub enum Int {
    Constant(i32),
    /// What the state holds, and how much less it holds than is meant.
    Load(Var, i32),
    Element(Arc<Elements>, Box<Int>),
    /// Of a binder or a quantifier.
    Variable(usize),
    Table(Arc<[i32]>, Box<Int>),
    /// An input that changes by itself.
    Input(usize),
    InputElement(Arc<[usize]>, Box<Int>),
    /// Number of the stop at which a vehicle stands, -1 between stops.
    AtStop(usize),
    /// Whether a time of `after` that the layout does not fix has passed in the state of an instance.
    After(Box<After>),
    Shared(Arc<Int>),
    Not(Box<Int>),
    Negate(Box<Int>),
    Absolute(Box<Int>),
    Binary(Operator, Box<[Int; 2]>),
    And(Box<[Int]>),
    Or(Box<[Int]>),
    Total(Box<[Int]>),
    Min(Box<[Int; 2]>),
    Max(Box<[Int; 2]>),
    CompareReals(Operator, Box<[Real; 2]>),
    ComparePoints(Operator, Box<[PointValue; 2]>),
    /// Whether a number is one of these.
    OneOf(Arc<[i32]>, Box<Int>),
    Exists(Box<Each<Int>>),
    ForAll(Box<Each<Int>>),
    Count(Box<Each<Int>>),
    Sum(Box<Each<Int>>),
}

#[derive(Clone, Debug)]
pub enum Real {
    Constant(f64),
    Load(Var),
    Element(Arc<[Var]>, Box<Int>),
    Table(Arc<[f64]>, Box<Int>),
    OfInt(Box<Int>),
    Negate(Box<Real>),
    Absolute(Box<Real>),
    Binary(Operator, Box<[Real; 2]>),
    Min(Box<[Real; 2]>),
    Max(Box<[Real; 2]>),
    Coordinate(Box<PointValue>, usize),
    SquaredDistance(Box<[PointValue; 2]>),
    Sum(Box<Each<Real>>),
}

#[derive(Clone, Debug)]
pub enum PointValue {
    Constant(Point),
    Load(Var),
    /// Where a vehicle is shown to be.
    Position(usize),
    Element(Arc<[Var]>, Box<Int>),
    Table(Arc<[Point]>, Box<Int>),
    Make(Box<[Real; 3]>),
    Add(Box<[PointValue; 2]>),
    Subtract(Box<[PointValue; 2]>),
}

/// Values of one type by their numbers, and how much less the state holds than is meant.
#[derive(Clone, Debug)]
pub struct Elements {
    pub vars: Vec<Var>,
    pub low: i32,
}

#[derive(Clone, Debug)]
pub struct After {
    pub instance: usize,
    /// ms.
    pub time: Int,
}

#[derive(Clone, Debug)]
pub struct Each<T> {
    pub variable: usize,
    pub domain: Domain,
    pub body: T,
}

#[derive(Clone, Debug)]
pub enum Domain {
    List(Arc<[i32]>),
    /// Both ends included.
    Range(Box<[Int; 2]>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Add,
    Subtract,
    Multiply,
    Divide,
    Modulo,
}

/// What a binder prefers.
#[derive(Clone, Debug)]
pub enum Key {
    Int(Int),
    Real(Real),
}

#[derive(Clone, Debug)]
pub enum Clause {
    Condition(Int),
    Bind { variable: usize, domain: Domain, condition: Option<Int>, key: Option<Key> },
}

/// Where an update writes.
#[derive(Clone, Debug)]
pub struct Target {
    /// None: nobody reads it.
    pub vars: Arc<[Var]>,
    pub index: Int,
}

/// What may be stored; beyond it the nearest bound is, and the step faults if there is a fault for it.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    pub low: i32,
    pub high: i32,
    /// The least number that the type has: what the state holds is counted from it.
    pub base: i32,
    pub fault: Option<usize>,
}

#[derive(Clone, Debug)]
pub enum Update {
    Int(Target, Int, Bounds),
    Real(Target, Real, Option<usize>),
    Point(Target, PointValue, Option<usize>),
    /// All values are read before one is written. Lists of equal length.
    Copy(Vec<Update>),
    Command(Command),
}

/// A numbered command of a machine.
#[derive(Clone, Debug)]
pub struct Command {
    /// Index into [`crate::plant::Head::commands`].
    pub command: usize,
    /// In the order in which they are stored; each is evaluated once.
    pub arguments: Vec<Argument>,
}

#[derive(Clone, Debug)]
pub enum Argument {
    /// An output that the state holds, or that may fault.
    Output(Update),
    /// Where the machine goes; stored like [`Update::Point`].
    Place(Target, PointValue, Option<usize>),
}

#[derive(Clone, Debug)]
pub struct Transition {
    pub clauses: Vec<Clause>,
    pub target: Option<usize>,
    pub updates: Vec<Update>,
}

/// Cells of interfaces, and the values of the instances that own them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Cells {
    /// Instances, a bit each; instance 64 has the bit of instance 0.
    pub owners: u64,
    /// Which cells of interfaces they may be, a bit each; cell 64 of all interfaces has the bit of cell 0.
    pub columns: u64,
}

impl Cells {
    /// A cell of all interfaces, by its number, of an instance.
    pub fn of(owner: usize, cell: usize) -> Self {
        Self { owners: bit(owner), columns: 1 << (cell % 64) }
    }

    /// Whether some may be among both.
    #[inline]
    pub fn meets(self, other: Self) -> bool {
        self.owners & other.owners != 0 && self.columns & other.columns != 0
    }
}

impl BitOr for Cells {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        Self { owners: self.owners | other.owners, columns: self.columns | other.columns }
    }
}

#[derive(Clone, Debug)]
pub struct State {
    pub transitions: Vec<Transition>,
    /// What its guards read.
    pub reads: Cells,
    /// Times of `after` in ascending order, in scans; those that have come at the first test are left out, and those that
    /// come in the same scan are one.
    pub times: Vec<i32>,
    /// What is of no use here, and what it holds then.
    pub dead: Vec<(Var, i32)>,
    /// What a sensor tells over a conveyor at rest, and nobody reads here before it moves.
    pub unread: Vec<Unread>,
    /// Whether the last command has ended, and how, is of no use here.
    pub is_answer_dead: bool,
    /// So is the port `error`.
    pub is_error_dead: bool,
}

/// What the state holds of an input, one of [`crate::plant::sight`], instead of what was told.
#[derive(Clone, Copy, Debug)]
pub struct Unread {
    pub input: Var,
    pub seen: i32,
    pub not_seen: i32,
}

impl Unread {
    pub fn instead(&self, held: i32) -> i32 {
        match held {
            sight::SEEN => self.seen,
            sight::NOT_SEEN => self.not_seen,
            other => other,
        }
    }
}

#[derive(Clone, Debug)]
pub struct Instance {
    pub state: Var,
    /// Whether it is stopped by itself; none if nothing can stop it.
    pub stopped: Option<Var>,
    /// How many times of its state have come; none if none of its states waits for a time.
    pub times_come: Option<Var>,
    /// So many scans of its state have begun at least, as far as an [`After`] has told; none if it has none.
    pub elapsed: Option<Var>,
    pub states: Vec<State>,
    pub properties: Vec<Property>,
    /// As [`Property::reads_of_all`] of these.
    pub property_reads: Option<Cells>,
    /// Variables of binders and quantifiers.
    pub variables: usize,
}

/// The bit of an instance in a mask.
pub fn bit(instance: usize) -> u64 {
    1 << (instance % 64)
}

/// The instances of a mask, in order.
pub(crate) fn members(mut mask: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let instance = (mask != 0).then(|| mask.trailing_zeros() as usize)?;
        mask &= mask - 1;
        Some(instance)
    })
}
