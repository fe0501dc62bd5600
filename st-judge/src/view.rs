//! A small typed view of a text: what the rules and the evaluator look at.

use crate::finding::Span;

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Name {
    pub text: String,
    pub span: Span,
}

impl Name {
    /// The name as it is compared: case does not count.
    pub fn key(&self) -> String {
        self.text.to_ascii_lowercase()
    }
}

/// A whole text.
#[derive(Clone, Debug, Default)]
pub struct Text {
    /// Functions, function blocks and programs in the order of the text.
    pub units: Vec<Unit>,
    pub configurations: Vec<Configuration>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnitKind {
    Function,
    Block,
    Program,
}

/// A program organisation unit.
#[derive(Clone, Debug)]
pub struct Unit {
    pub kind: UnitKind,
    pub name: Name,
    /// Of a function.
    pub result: Option<TypeName>,
    pub variables: Vec<Variable>,
    pub body: Vec<Statement>,
    pub span: Span,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Section {
    Local,
    Input,
    Output,
    InOut,
    External,
    Global,
}

#[derive(Clone, Debug)]
pub struct Variable {
    pub section: Section,
    /// `RETAIN`: it outlasts a loss of power.
    pub is_retained: bool,
    pub name: Name,
    /// Such as `%IX0.3`, as written.
    pub address: Option<Name>,
    pub ty: TypeName,
    pub initial: Option<Expression>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub struct TypeName {
    pub kind: TypeKind,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub enum TypeKind {
    Named(String),
    Array {
        lower: Expression,
        upper: Expression,
        element: Box<TypeName>,
    },
    /// A type outside the portable core.
    Other,
}

#[derive(Clone, Debug)]
pub struct Expression {
    pub kind: ExpressionKind,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub enum ExpressionKind {
    Bool(bool),
    /// A whole number as written.
    Int(String),
    Real(String),
    /// A literal of time as written.
    Time(String),
    Name(Name),
    Index {
        array: Box<Expression>,
        index: Box<Expression>,
    },
    Member {
        object: Box<Expression>,
        member: Name,
    },
    Unary {
        operator: Unary,
        operand: Box<Expression>,
    },
    Binary {
        operator: Binary,
        left: Box<Expression>,
        right: Box<Expression>,
    },
    Parenthesis(Box<Expression>),
    Call(Call),
    /// Outside the portable core; a finding says so.
    Other,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unary {
    Not,
    Minus,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Binary {
    Or,
    Xor,
    And,
    Equal,
    Unequal,
    Less,
    Greater,
    LessOrEqual,
    GreaterOrEqual,
    Add,
    Subtract,
    Multiply,
    Divide,
    Modulo,
}

#[derive(Clone, Debug)]
pub struct Call {
    pub name: Name,
    pub arguments: Vec<Argument>,
}

#[derive(Clone, Debug)]
pub struct Argument {
    /// None if the argument is given by position.
    pub name: Option<Name>,
    pub value: Expression,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub struct Statement {
    pub kind: StatementKind,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub enum StatementKind {
    Assign {
        target: Expression,
        value: Expression,
    },
    Call(Call),
    If {
        branches: Vec<Branch>,
        otherwise: Option<Vec<Statement>>,
    },
    Case {
        subject: Expression,
        clauses: Vec<Clause>,
        otherwise: Option<Vec<Statement>>,
    },
    While {
        condition: Expression,
        body: Vec<Statement>,
    },
    Exit,
    Return,
    /// Outside the portable core; a finding says so.
    Other,
}

#[derive(Clone, Debug)]
pub struct Branch {
    pub condition: Expression,
    pub body: Vec<Statement>,
}

#[derive(Clone, Debug)]
pub struct Clause {
    pub labels: Vec<Expression>,
    pub body: Vec<Statement>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub struct Configuration {
    pub name: Name,
    pub globals: Vec<Variable>,
    pub resources: Vec<Resource>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub struct Resource {
    pub name: Name,
    pub tasks: Vec<Task>,
    pub programs: Vec<Assignment>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub struct Task {
    pub name: Name,
    pub settings: Vec<(Name, Expression)>,
    pub span: Span,
}

/// A program that a task runs.
#[derive(Clone, Debug)]
pub struct Assignment {
    pub name: Name,
    pub task: Option<Name>,
    pub program: Name,
    pub span: Span,
}

impl Expression {
    /// The expression without the parentheses around it.
    pub fn bare(&self) -> &Expression {
        match &self.kind {
            ExpressionKind::Parenthesis(inner) => inner.bare(),
            _ => self,
        }
    }
}

/// Calls `visit` with each statement, outer ones before inner ones.
pub fn each_statement<'a>(body: &'a [Statement], visit: &mut impl FnMut(&'a Statement)) {
    for statement in body {
        visit(statement);
        bodies(statement).into_iter().for_each(|inner| each_statement(inner, visit));
    }
}

/// The statement lists inside of a statement.
pub fn bodies(statement: &Statement) -> Vec<&[Statement]> {
    match &statement.kind {
        StatementKind::If { branches, otherwise } => {
            branches.iter().map(|b| &*b.body).chain(otherwise.as_deref()).collect()
        }
        StatementKind::Case { clauses, otherwise, .. } => {
            clauses.iter().map(|c| &*c.body).chain(otherwise.as_deref()).collect()
        }
        StatementKind::While { body, .. } => vec![body],
        _ => vec![],
    }
}

/// The expressions of a statement itself, not of the statements inside of it.
pub fn expressions(statement: &Statement) -> Vec<&Expression> {
    match &statement.kind {
        StatementKind::Assign { target, value } => vec![target, value],
        StatementKind::Call(call) => call.arguments.iter().map(|a| &a.value).collect(),
        StatementKind::If { branches, .. } => branches.iter().map(|b| &b.condition).collect(),
        StatementKind::Case { subject, .. } => vec![subject],
        StatementKind::While { condition, .. } => vec![condition],
        StatementKind::Exit | StatementKind::Return | StatementKind::Other => vec![],
    }
}

/// Calls `visit` with the expression and each part of it.
pub fn each_part<'a>(expression: &'a Expression, visit: &mut impl FnMut(&'a Expression)) {
    visit(expression);
    match &expression.kind {
        ExpressionKind::Index { array, index } => {
            each_part(array, visit);
            each_part(index, visit);
        }
        ExpressionKind::Member { object, .. } => each_part(object, visit),
        ExpressionKind::Unary { operand, .. } => each_part(operand, visit),
        ExpressionKind::Binary { left, right, .. } => {
            each_part(left, visit);
            each_part(right, visit);
        }
        ExpressionKind::Parenthesis(inner) => each_part(inner, visit),
        ExpressionKind::Call(call) => call.arguments.iter().for_each(|a| each_part(&a.value, visit)),
        _ => {}
    }
}
