//! The intermediate representation: what every engine executes and every back end prints.
//!
//! A [`Model`] is the meaning of the types, independent of any layout: names are
//! resolved, types are known, sequences and `any state` are expanded into plain
//! states and transitions. A [`System`] is a model with the instances of one
//! layout. `docs/semantics.md` says how a system runs; what is written here is
//! how its parts are represented.
//!
//! - A reference is the *row* of an instance among the members of an interface,
//!   in layout order. Cells and parameters of an interface are tables over its rows.
//! - State 0 of an automaton is its beginning: it has one transition, which
//!   always fires, so that the first step of an instance is that transition.
//! - Every place at which a step can fault has a code, from 1, unique in the model.
//! - Values are in SI units, times in whole milliseconds.

mod asking;
mod element;
mod expression;
mod modes;
mod operator;
mod property;
mod retained;
mod situation;
mod system;
mod value;

pub use asking::Asking;
pub use element::{Element, Group, Named};
pub use expression::{Expr, ExprKind, Place};
pub use modes::{Action, ByHand, Modes};
pub use operator::Operator;
pub(crate) use operator::less;
pub use property::{Entry, Kept, Property, PropertyKind, Severity};
pub use retained::Retained;
pub use system::{Instance, System};
pub use value::{Extent, Scalar, Type, Value};

use crate::device::Device;
use crate::source::Span;
use crate::spec::ast::Side;
use std::sync::Arc;

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub usize);
    };
}

id!(
    /// Index into [`Model::enums`].
    EnumId
);
id!(
    /// Index into [`Model::interfaces`].
    InterfaceId
);
id!(
    /// Index into [`Model::automata`].
    AutomatonId
);
id!(
    /// Index into [`Automaton::states`].
    StateId
);
id!(
    /// Index into [`Automaton::roles`].
    RoleId
);
id!(
    /// A variable bound by a binder or a quantifier: index into [`Automaton::variables`].
    VariableId
);
id!(
    /// Index into [`Model::faults`]; the code that is published is one more.
    FaultId
);
id!(
    /// Index into [`Model::relations`].
    RelationId
);

/// The kinds of part, always the first enumeration.
pub const KIND: EnumId = EnumId(0);

#[derive(Clone, Debug)]
pub struct Model {
    pub enums: Vec<Enum>,
    pub interfaces: Vec<Interface>,
    pub automata: Vec<Automaton>,
    pub faults: Vec<FaultSite>,
    pub relations: Vec<Relation>,
}

#[derive(Clone, Debug)]
pub struct Enum {
    pub name: String,
    pub doc: Vec<String>,
    /// At least one. Those of `Kind` come from the scenario.
    pub members: Vec<String>,
}

/// What a member of an interface shows to others.
#[derive(Clone, Debug)]
pub struct Interface {
    pub name: String,
    pub doc: Vec<String>,
    pub parameters: Vec<Variable>,
    pub cells: Vec<Cell>,
}

/// A shared variable: one for each member of its interface.
#[derive(Clone, Debug)]
pub struct Cell {
    pub name: String,
    pub doc: Vec<String>,
    pub ty: Type,
    pub initial: Value,
    pub rule: Rule,
}

/// Who may write a cell.
#[derive(Clone, Debug)]
pub enum Rule {
    Owner,
    Handshake,
    Lock,
    Counter,
    /// Who may write, for each ordinal of the cell's enumeration.
    Token(Vec<Side>),
    /// As cell number so-and-so of the same interface.
    With(usize),
}

/// `from reaches to`: whether items can get from a member of one interface to one of the other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Relation {
    pub from: InterfaceId,
    pub to: InterfaceId,
}

#[derive(Clone, Debug)]
pub struct Automaton {
    pub name: String,
    pub doc: Vec<String>,
    pub place: Span,
    pub device: Arc<Device>,
    /// Interfaces of which each instance is a member.
    pub implements: Vec<Implements>,
    pub parameters: Vec<Parameter>,
    pub roles: Vec<Role>,
    pub locals: Vec<Local>,
    pub defines: Vec<Define>,
    /// Variables of binders and quantifiers.
    pub variables: Vec<Variable>,
    /// The first is the beginning.
    pub states: Vec<State>,
    /// Looked at behind the steps of every scan, in this order.
    pub properties: Vec<Property>,
    /// Outputs, by their numbers, that properties read and that are put out otherwise while an instance is stopped or
    /// moved by hand: properties see what is put out.
    pub masked: Vec<usize>,
    /// What of each instance outlasts a loss of power.
    pub retained: Retained,
    /// A local: the answer to the last command does not count, since a person has moved the machine or power was lost.
    /// The device is held until the next command.
    pub abandoned: Option<usize>,
    /// A local, there with that one: an instance has gone on in its state since. Until the next command it is `failed`.
    pub interrupted: Option<usize>,
    /// How a person operates each instance, if the layout gives the machines panels.
    pub modes: Option<Modes>,
    pub requires: Vec<Require>,
}

#[derive(Clone, Debug)]
pub struct Implements {
    pub interface: InterfaceId,
    /// For each parameter of the interface, the parameter of the automaton that supplies it.
    pub parameters: Vec<usize>,
    pub handover: Option<Handover>,
}

/// Where the items of a passive instance change hands.
#[derive(Clone, Debug)]
pub struct Handover {
    pub place: Span,
    pub direction: Direction,
    pub name: String,
    pub index: Option<Index>,
    /// Height over the contact from which an arm comes and to which it leaves, m.
    pub approach: f64,
}

/// Which one of several places of one name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Index {
    Number(usize),
    /// The one that a whole number of the automaton names, which stays within the places.
    Parameter(usize),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    Accepts,
    Offers,
}

#[derive(Clone, Debug)]
pub struct Parameter {
    pub name: String,
    pub doc: Vec<String>,
    pub ty: Type,
    pub source: ParameterSource,
    pub place: Span,
}

impl Parameter {
    /// Whether the layout or the command line may set it.
    pub fn is_settable(&self) -> bool {
        !matches!(self.source, ParameterSource::Device)
    }
}

#[derive(Clone, Debug)]
pub enum ParameterSource {
    /// Set in the layout or on the command line; with what it is if it is not set.
    Layout(Option<Value>),
    /// As of `Layout`; if it is not set, the parts of each kind that all orders of the scenario ask for.
    Scenario,
    /// A constant of the device, from the machine's place in the layout.
    Device,
}

#[derive(Clone, Debug)]
pub struct Role {
    pub name: String,
    pub doc: Vec<String>,
    pub kind: RoleKind,
    pub interface: InterfaceId,
    pub also: Vec<InterfaceId>,
    pub min: usize,
    pub max: Option<usize>,
    pub place: Span,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RoleKind {
    /// Members within reach that offer items.
    Takes,
    /// Members within reach that accept items.
    Hands,
    /// Members to which items can get from here.
    Serves,
    /// All members.
    Knows,
}

#[derive(Clone, Debug)]
pub struct Local {
    pub name: String,
    pub doc: Vec<String>,
    pub ty: Type,
    pub initial: Value,
    pub kept_by: KeptBy,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KeptBy {
    /// Declared in the text; transitions write it.
    Steps,
    /// A property needs it from scan to scan.
    Properties,
    /// The operating modes, or continuing after a loss of power, need it from scan to scan.
    Modes,
}

/// A name for an expression, evaluated whenever it is read.
#[derive(Clone, Debug)]
pub struct Define {
    pub name: String,
    pub doc: Vec<String>,
    pub place: Span,
    pub ty: Scalar,
    pub value: Expr,
}

#[derive(Clone, Debug)]
pub struct Variable {
    pub name: String,
    pub doc: Vec<String>,
    pub ty: Type,
}

#[derive(Clone, Debug)]
pub struct State {
    pub name: String,
    pub doc: Vec<String>,
    pub place: Span,
    pub is_final: bool,
    /// Its machine may continue from here after it was moved by hand, or power was lost.
    pub is_resumable: bool,
    /// Longest stay, ms; the fault if it is exceeded.
    pub within: Option<(Expr, FaultId)>,
    pub transitions: Vec<Transition>,
}

/// Fires if its guard holds. The binders stand for nested loops, the first one outermost.
#[derive(Clone, Debug)]
pub struct Transition {
    pub place: Span,
    /// The guard as written, on one line; `at once` if it always holds. In a sequence: which step is waited for.
    pub text: String,
    pub clauses: Vec<Clause>,
    /// `None` stays in the state and lets `after` run on.
    pub target: Option<StateId>,
    pub updates: Vec<Update>,
}

impl Transition {
    /// `when all_loaded`, `at once`
    pub fn title(&self) -> String {
        if self.is_unconditional() { self.text.clone() } else { format!("when {}", self.text) }
    }

    /// No transition behind it in its state can fire.
    pub fn is_unconditional(&self) -> bool {
        self.clauses.iter().all(|clause| {
            matches!(clause, Clause::Condition(Expr { kind: ExprKind::Constant(Value::Bool(true)), .. }))
        })
    }
}

#[derive(Clone, Debug)]
pub enum Clause {
    Condition(Expr),
    Bind(Binder),
}

#[derive(Clone, Debug)]
pub struct Binder {
    pub variable: VariableId,
    pub domain: Domain,
    pub condition: Option<Expr>,
    /// The candidate with the least key is chosen; the first one of equals. Without a key: the first.
    pub key: Option<Expr>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Domain {
    Role(RoleId),
    Enum(EnumId),
    /// Both ends included; empty if the first is greater.
    Range(Expr, Expr),
}

#[derive(Clone, Debug)]
pub struct Update {
    pub place: Span,
    pub kind: UpdateKind,
}

#[derive(Clone, Debug)]
pub enum UpdateKind {
    Assign {
        target: Target,
        value: Expr,
        /// The fault if the value does not fit; `None` if it is proved to fit.
        check: Option<FaultId>,
    },
    /// Every element of an array becomes this value.
    Fill { target: Target, value: Expr, check: Option<FaultId> },
    /// An array becomes a copy of another one of the same extent.
    /// `check` as for an assignment, element by element.
    Copy { target: Target, source: Place, check: Option<FaultId> },
    /// Writes the arguments, the verb and the next command number.
    Command { verb: i32, arguments: Vec<Argument> },
}

impl UpdateKind {
    /// None for a command.
    pub fn target(&self) -> Option<&Target> {
        match self {
            Self::Assign { target, .. } | Self::Fill { target, .. } | Self::Copy { target, .. } => {
                Some(target)
            }
            Self::Command { .. } => None,
        }
    }

    /// What the target, or each of its elements, becomes; none if that is not one expression.
    pub fn value(&self) -> Option<&Expr> {
        match self {
            Self::Assign { value, .. } | Self::Fill { value, .. } => Some(value),
            Self::Copy { .. } | Self::Command { .. } => None,
        }
    }

    /// All that is evaluated, once each.
    pub fn exprs(&self) -> Vec<&Expr> {
        let mut all: Vec<&Expr> = self.target().into_iter().flat_map(|target| target.place.parts()).collect();
        match self {
            Self::Assign { value, .. } | Self::Fill { value, .. } => all.push(value),
            Self::Copy { source, .. } => all.extend(source.parts()),
            Self::Command { arguments, .. } => all.extend(arguments.iter().map(|argument| &argument.value)),
        }
        all
    }
}

#[derive(Clone, Debug)]
pub struct Argument {
    /// Index into the ports of the device.
    pub port: usize,
    pub value: Expr,
    pub check: Option<FaultId>,
}

/// What an update writes.
#[derive(Clone, Debug)]
pub struct Target {
    pub place: Place,
    pub ty: Type,
}

#[derive(Clone, Debug)]
pub struct Require {
    pub place: Span,
    pub condition: Expr,
    pub text: Vec<TextPart>,
}

/// A piece of a text that shows values.
#[derive(Clone, Debug)]
pub enum TextPart {
    Words(String),
    Value(Expr),
}

#[derive(Clone, Debug)]
pub struct FaultSite {
    pub automaton: AutomatonId,
    pub kind: FaultKind,
    pub place: Span,
    pub severity: Severity,
    /// What went wrong, such as `i leaves 0..11`.
    pub text: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FaultKind {
    OutOfBounds,
    NotFinite,
    InvariantFails,
    NotKept,
    NotFollowed,
    TooLong,
}

impl Model {
    pub fn elements(&self, extent: Extent) -> usize {
        match extent {
            Extent::One => 1,
            Extent::Count(n) => n,
            Extent::By(id) => self.enums[id.0].members.len(),
        }
    }

    pub fn automaton(&self, id: AutomatonId) -> &Automaton {
        &self.automata[id.0]
    }

    pub fn interface(&self, id: InterfaceId) -> &Interface {
        &self.interfaces[id.0]
    }
}

impl Automaton {
    /// Position of an interface among those implemented.
    pub fn implementing(&self, interface: InterfaceId) -> Option<usize> {
        self.implements.iter().position(|i| i.interface == interface)
    }
}
