//! Expressions, and the places that they read.

use super::{Domain, InterfaceId, Operator, RelationId, RoleId, Scalar, StateId, Value, VariableId};

/// Where a value is kept.
#[derive(Clone, Debug, PartialEq)]
pub enum Place {
    Local {
        local: usize,
        index: Option<Box<Expr>>,
    },
    /// A cell of this instance, or of another one.
    Cell {
        interface: InterfaceId,
        cell: usize,
        of: Option<Box<Expr>>,
        index: Option<Box<Expr>>,
    },
    /// A port of this instance's device.
    Port {
        port: usize,
        index: Option<Box<Expr>>,
    },
    /// A parameter of this instance.
    Parameter {
        parameter: usize,
        index: Option<Box<Expr>>,
    },
    /// A parameter that another instance shows.
    Shown {
        interface: InterfaceId,
        parameter: usize,
        of: Box<Expr>,
        index: Option<Box<Expr>>,
    },
}

#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    pub ty: Scalar,
    pub kind: ExprKind,
}

#[derive(Clone, Debug, PartialEq)]
pub enum ExprKind {
    Constant(Value),
    Read(Place),
    Variable(VariableId),
    Define(usize),
    /// This instance's own row in an interface.
    Own(InterfaceId),
    /// The stay in the present state has lasted so many ms.
    After(Box<Expr>),
    /// The last command has ended successfully.
    Done,
    /// The last command has ended in error.
    Failed,
    /// The line has its permit to run.
    Permit,
    /// The instance makes no steps.
    Stopped,
    /// The present state is one of these.
    InState(Vec<StateId>),
    /// A real or all coordinates of a point are neither infinite nor NaN.
    IsFinite(Box<Expr>),
    Not(Box<Expr>),
    Negate(Box<Expr>),
    /// Both operands have the same type, but for durations times whole numbers.
    Binary(Operator, Box<Expr>, Box<Expr>),
    Min(Box<Expr>, Box<Expr>),
    Max(Box<Expr>, Box<Expr>),
    Absolute(Box<Expr>),
    /// Whole number to real.
    ToReal(Box<Expr>),
    MakePoint(Box<[Expr; 3]>),
    /// x, y or z of a point, by number.
    Coordinate(Box<Expr>, usize),
    /// Squared distance of two points.
    SquaredDistance(Box<Expr>, Box<Expr>),
    Exists {
        variable: VariableId,
        domain: Box<Domain>,
        body: Box<Expr>,
    },
    Forall {
        variable: VariableId,
        domain: Box<Domain>,
        body: Box<Expr>,
    },
    Count {
        variable: VariableId,
        domain: Box<Domain>,
        body: Box<Expr>,
    },
    Sum {
        variable: VariableId,
        domain: Box<Domain>,
        body: Box<Expr>,
    },
    /// Number of members of a role.
    Members(RoleId),
    IsMember(Box<Expr>, RoleId),
    Reaches(RelationId, Box<Expr>, Box<Expr>),
}

impl Expr {
    /// The expressions of which this one directly consists, those of places and domains included.
    pub fn parts(&self) -> impl Iterator<Item = &Expr> {
        use ExprKind as Kind;
        let parts = match &self.kind {
            Kind::Constant(_)
            | Kind::Variable(_)
            | Kind::Define(_)
            | Kind::Own(_)
            | Kind::Done
            | Kind::Failed
            | Kind::Permit
            | Kind::Stopped
            | Kind::InState(_)
            | Kind::Members(_) => [None; 3],
            Kind::Read(place) => {
                let [of, index] = place.pair();
                [of, index, None]
            }
            Kind::After(a)
            | Kind::Not(a)
            | Kind::Negate(a)
            | Kind::Absolute(a)
            | Kind::ToReal(a)
            | Kind::IsFinite(a)
            | Kind::Coordinate(a, _)
            | Kind::IsMember(a, _) => [Some(&**a), None, None],
            Kind::Binary(_, a, b)
            | Kind::Min(a, b)
            | Kind::Max(a, b)
            | Kind::SquaredDistance(a, b)
            | Kind::Reaches(_, a, b) => [Some(&**a), Some(&**b), None],
            Kind::MakePoint(parts) => parts.each_ref().map(Some),
            Kind::Exists { domain, body, .. }
            | Kind::Forall { domain, body, .. }
            | Kind::Count { domain, body, .. }
            | Kind::Sum { domain, body, .. } => match &**domain {
                Domain::Range(low, high) => [Some(low), Some(high), Some(&**body)],
                Domain::Role(_) | Domain::Enum(_) => [Some(&**body), None, None],
            },
        };
        parts.into_iter().flatten()
    }
}

impl Place {
    /// The expressions that say which instance and which element is meant.
    pub fn parts(&self) -> impl Iterator<Item = &Expr> {
        self.pair().into_iter().flatten()
    }

    /// The instance and the element.
    fn pair(&self) -> [Option<&Expr>; 2] {
        let (of, index) = match self {
            Place::Local { index, .. } | Place::Port { index, .. } | Place::Parameter { index, .. } => {
                (None, index)
            }
            Place::Cell { of, index, .. } => (of.as_ref(), index),
            Place::Shown { of, index, .. } => (Some(of), index),
        };
        [of.map(|of| &**of), index.as_deref()]
    }
}
