//! The tree of a specification file, as written: names are not yet resolved.

use crate::source::{Span, Spanned};

pub type Name = Spanned<String>;

#[derive(Clone, Debug, Default)]
pub struct File {
    pub enums: Vec<Enum>,
    pub interfaces: Vec<Interface>,
    pub automata: Vec<Automaton>,
    pub devices: Vec<Device>,
}

#[derive(Clone, Debug)]
pub struct Enum {
    pub doc: Vec<String>,
    pub name: Name,
    pub members: Vec<Name>,
}

/// A protocol between robots: its parameters and cells live at the robot that implements it.
#[derive(Clone, Debug)]
pub struct Interface {
    pub doc: Vec<String>,
    pub name: Name,
    pub parameters: Vec<Parameter>,
    pub cells: Vec<Cell>,
    /// Of each member.
    pub properties: Vec<Property>,
}

#[derive(Clone, Debug)]
pub struct Parameter {
    pub doc: Vec<String>,
    pub name: Name,
    pub ty: Type,
    pub default: Option<Expr>,
}

/// A shared variable.
#[derive(Clone, Debug)]
pub struct Cell {
    pub doc: Vec<String>,
    pub name: Name,
    pub ty: Type,
    pub initial: Option<Expr>,
    pub rule: Option<Rule>,
}

/// Who may write a cell.
#[derive(Clone, Debug)]
pub enum Rule {
    Owner,
    Handshake,
    Lock,
    Counter,
    /// For each value of the cell, who may write while it has that value.
    Token(Vec<(Name, Side)>),
    /// The same rule as another cell of the interface.
    With(Name),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    Owner,
    Others,
}

#[derive(Clone, Debug)]
pub struct Type {
    pub span: Span,
    pub scalar: Scalar,
    /// Number of elements, or the name of an enumeration, for an array.
    pub extent: Option<Expr>,
}

#[derive(Clone, Debug)]
pub enum Scalar {
    Bool,
    Int { lo: Expr, hi: Expr },
    Real,
    Time,
    Point,
    Named(Name),
}

/// A type of machine: its parts, and what they offer a controller.
#[derive(Clone, Debug)]
pub struct Device {
    pub doc: Vec<String>,
    pub name: Name,
    /// Its parts are for other devices: it has no I/O of its own.
    pub is_assembly: bool,
    pub parameters: Vec<DeviceParameter>,
    /// Definitions and parts, in their order.
    pub members: Vec<DeviceMember>,
    pub requires: Vec<Require>,
    pub ports: Vec<Port>,
    pub commands: Vec<Command>,
    pub constants: Vec<Constant>,
    pub handovers: Vec<Place>,
}

#[derive(Clone, Debug)]
pub struct DeviceParameter {
    pub doc: Vec<String>,
    pub name: Name,
    pub ty: Type,
    /// What each element of a list is.
    pub elements: Vec<String>,
    pub default: Option<Expr>,
}

#[derive(Clone, Debug)]
pub enum DeviceMember {
    Define(Define),
    Part(Part),
}

#[derive(Clone, Debug)]
pub struct Part {
    pub name: Name,
    /// A primitive or an assembly.
    pub kind: Name,
    pub settings: Vec<(Name, Expr)>,
}

#[derive(Clone, Debug)]
pub struct Port {
    pub doc: Vec<String>,
    pub direction: runtime_sim::device::Direction,
    pub name: Name,
    pub ty: Type,
    pub unit: String,
    /// A signal or a level of a part.
    pub wire: Option<Expr>,
    /// What is published while the system does not run.
    pub stop: Option<Expr>,
}

/// `command 2 pick(goal) = arm.joints(goal) then gripper.holds within 500 ms else 2;`
#[derive(Clone, Debug)]
pub struct Command {
    pub doc: Vec<String>,
    pub number: Spanned<i64>,
    pub name: Name,
    pub arguments: Vec<Name>,
    pub part: Expr,
    pub action: Name,
    pub given: Vec<Name>,
    pub then: Option<Await>,
}

#[derive(Clone, Debug)]
pub struct Await {
    pub signal: Expr,
    pub within: Expr,
    pub error: Expr,
}

#[derive(Clone, Debug)]
pub struct Constant {
    pub doc: Vec<String>,
    pub name: Name,
    pub ty: Type,
    pub unit: String,
    pub value: Expr,
}

/// Where items change hands.
#[derive(Clone, Debug)]
pub struct Place {
    pub name: Name,
    /// Number of places, if one of several is meant by an index.
    pub extent: Option<Expr>,
    /// Where the tool points; without it down.
    pub toward: Option<Expr>,
    /// A point or a list of points, and what each is called.
    pub points: Vec<(Expr, Spanned<String>)>,
}

impl Place {
    pub fn expressions(&self) -> impl Iterator<Item = &Expr> {
        self.points.iter().map(|(expr, _)| expr).chain(&self.toward)
    }
}

#[derive(Clone, Debug)]
pub struct Automaton {
    pub doc: Vec<String>,
    pub name: Name,
    pub device: Name,
    pub implements: Vec<Implements>,
    pub parameters: Vec<Parameter>,
    pub cells: Vec<Cell>,
    pub roles: Vec<Role>,
    pub locals: Vec<Local>,
    pub defines: Vec<Define>,
    pub requires: Vec<Require>,
    pub retain: Option<Retain>,
    pub properties: Vec<Property>,
    pub initial: Option<Initial>,
    pub any: Vec<AnyState>,
    pub states: Vec<State>,
}

#[derive(Clone, Debug)]
pub struct Implements {
    pub interface: Name,
    pub handover: Option<Handover>,
}

/// `accepts at stops[0] approach 0.5`: where and how items change hands.
#[derive(Clone, Debug)]
pub struct Handover {
    pub span: Span,
    pub direction: Direction,
    pub place: Name,
    pub index: Option<Expr>,
    pub approach: Option<Expr>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    Accepts,
    Offers,
}

#[derive(Clone, Debug)]
pub struct Role {
    pub doc: Vec<String>,
    pub kind: RoleKind,
    pub name: Name,
    pub interface: Name,
    /// Interfaces that a member must have besides.
    pub also: Vec<Name>,
    pub min: usize,
    pub max: Option<usize>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RoleKind {
    Takes,
    Hands,
    Serves,
    Knows,
}

#[derive(Clone, Debug)]
pub struct Local {
    pub doc: Vec<String>,
    pub name: Name,
    pub ty: Type,
    pub initial: Option<Expr>,
}

#[derive(Clone, Debug)]
pub struct Define {
    pub doc: Vec<String>,
    pub name: Name,
    pub value: Expr,
}

/// A condition that a type promises in addition to its states: it is checked after the steps of every scan.
#[derive(Clone, Debug)]
pub struct Property {
    /// Without its reaction.
    pub span: Span,
    pub kind: PropertyKind,
    pub reaction: Reaction,
}

#[derive(Clone, Debug)]
pub enum PropertyKind {
    /// `invariant C`
    Always(Expr),
    /// `keep E, F while C`
    Keep { values: Vec<Expr>, condition: Expr },
    /// `whenever P then Q within T`
    Whenever { trigger: Expr, goal: Expr, within: Expr },
    /// `answer within T`
    Answer { within: Expr },
}

/// The effect of a violation, with its text.
#[derive(Clone, Debug)]
pub enum Reaction {
    /// It stops the line.
    Fault,
    /// `else "text"`: it stops the line, which waits for the operator.
    Ask(String),
    /// `else stop line "text"`
    StopLine(String),
    /// `else stop machine "text"`
    StopMachine(String),
    /// `else warn "text"`
    Warn(String),
}

#[derive(Clone, Debug)]
pub struct Require {
    pub span: Span,
    pub condition: Expr,
    pub text: Vec<TextPart>,
}

/// A piece of a text that shows values: `"{count(trays)} trays"`.
#[derive(Clone, Debug)]
pub enum TextPart {
    Words(String),
    Value(Expr),
}

/// What outlasts a loss of power.
#[derive(Clone, Debug)]
pub struct Retain {
    pub span: Span,
    /// `all`, `state`, or a local, a shared variable or an output.
    pub names: Vec<Name>,
}

#[derive(Clone, Debug)]
pub struct Initial {
    pub span: Span,
    pub target: Name,
    pub updates: Vec<Update>,
}

/// Transitions that come before those of every state that is not excepted.
#[derive(Clone, Debug)]
pub struct AnyState {
    pub except: Vec<Name>,
    pub transitions: Vec<Transition>,
}

#[derive(Clone, Debug)]
pub struct State {
    pub doc: Vec<String>,
    pub name: Name,
    pub is_final: bool,
    /// Its machine may continue from here after it was moved by hand, or power was lost.
    pub is_resumable: bool,
    pub within: Option<Expr>,
    pub body: Body,
}

#[derive(Clone, Debug)]
pub enum Body {
    Transitions(Vec<Transition>),
    Sequence(Sequence),
}

#[derive(Clone, Debug)]
pub struct Sequence {
    pub steps: Vec<Step>,
    pub then: Outcome,
    pub otherwise: Option<Outcome>,
}

#[derive(Clone, Debug)]
pub struct Outcome {
    pub span: Span,
    pub target: Name,
    pub updates: Vec<Update>,
}

#[derive(Clone, Debug)]
pub enum Step {
    /// A command, waited for, or an assignment.
    Act(Update),
    Until {
        span: Span,
        condition: Expr,
        at_most: Option<Expr>,
    },
    Wait {
        span: Span,
        time: Expr,
    },
}

#[derive(Clone, Debug)]
pub struct Transition {
    pub span: Span,
    pub clauses: Vec<Clause>,
    pub guard: Guard,
    pub target: Option<Name>,
    pub updates: Vec<Update>,
}

/// What reports and comments say of a guard. A sequence waits for the end of steps, which have no guard in the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Guard {
    Written(Span),
    /// Of the beginning.
    FirstStep,
    AtOnce,
    Done(Span),
    Failed(Span),
    /// The time is written here.
    After(Span),
}

#[derive(Clone, Debug)]
pub enum Clause {
    Condition(Expr),
    Bind(Box<Binder>),
}

#[derive(Clone, Debug)]
pub struct Binder {
    pub span: Span,
    pub choice: Choice,
    pub variable: Name,
    pub domain: Domain,
    pub condition: Option<Expr>,
}

#[derive(Clone, Debug)]
pub enum Choice {
    First,
    Least(Expr),
    /// Least squared distance between two points.
    Nearest(Expr, Expr),
}

#[derive(Clone, Debug)]
pub enum Domain {
    /// A role or an enumeration.
    Named(Name),
    Range(Expr, Expr),
}

#[derive(Clone, Debug)]
pub struct Update {
    pub span: Span,
    pub kind: UpdateKind,
}

#[derive(Clone, Debug)]
pub enum UpdateKind {
    Assign { target: Expr, how: Assign, value: Expr },
    Command { verb: Name, arguments: Vec<Expr> },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Assign {
    Set,
    Add,
    Subtract,
}

#[derive(Clone, Debug)]
pub struct Expr {
    pub span: Span,
    pub kind: ExprKind,
}

#[derive(Clone, Debug)]
pub enum ExprKind {
    Bool(bool),
    Int(i64),
    Real(f64),
    /// Milliseconds.
    Duration(i64),
    Name(String),
    Member(Box<Expr>, Name),
    Index(Box<Expr>, Box<Expr>),
    /// In devices only.
    List(Vec<Expr>),
    Call(Name, Vec<Expr>),
    Not(Box<Expr>),
    Negate(Box<Expr>),
    Binary(Operator, Box<Expr>, Box<Expr>),
    Quantified {
        quantifier: Quantifier,
        variable: Name,
        domain: Box<Domain>,
        body: Box<Expr>,
    },
    After(Box<Expr>),
    In(Box<Expr>, Name),
    Reaches(Box<Expr>, Box<Expr>),
    /// Something that could not be read; it has been reported.
    Error,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantifier {
    Exists,
    Forall,
    Count,
    Sum,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    Or,
    And,
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
