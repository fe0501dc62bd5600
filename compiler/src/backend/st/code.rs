//! Statements and expressions of Structured Text, as values: they are printed, counted and searched.

use super::name::Name;
use super::values::List;
use std::collections::HashSet;

#[derive(Clone, Debug, PartialEq)]
pub enum Ex {
    Bool(bool),
    Int(i32),
    Real(f64),
    /// A member of an enumeration or a state, by its number.
    Member(Member),
    Name(Name),
    Element(Name, Box<Ex>),
    /// The index of an element of a table that has so many for each row: row, number of them, which of them.
    Within(Box<Ex>, i32, Box<Ex>),
    /// A field of a structure.
    Part(Box<Ex>, Name),
    /// An element of what is no variable by itself, or of an array of two dimensions.
    Item(Box<Ex>, Vec<Ex>),
    /// The values of an array.
    List(List),
    /// The values of a structure. Many have the same fields.
    Fields(Vec<(Name, Ex)>),
    /// An output of a function block.
    Field(Name, Name),
    Not(Box<Ex>),
    Minus(Box<Ex>),
    Binary(&'static str, Box<Ex>, Box<Ex>),
    /// Operands of AND or OR.
    Chain(&'static str, Vec<Ex>),
    Call(&'static str, Vec<(&'static str, Ex)>),
}

#[derive(Clone, Debug, PartialEq)]
pub struct Member {
    pub value: i32,
    /// As the specification has it.
    pub note: String,
    /// Type and member, such as `E_Slot.Full`.
    pub qualified: Option<String>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Stmt {
    Comment(String),
    Assign(Ex, Ex),
    If(Vec<Arm>, Vec<Stmt>),
    Case {
        selector: Ex,
        branches: Vec<(Member, Vec<Stmt>)>,
        otherwise: Vec<Stmt>,
    },
    /// Runs at most so often.
    While {
        condition: Ex,
        body: Vec<Stmt>,
        most: u64,
    },
    Exit,
    Return,
    Call {
        instance: Name,
        arguments: Vec<(Name, Ex)>,
    },
}

/// What is done if a condition holds and none before it.
#[derive(Clone, Debug, PartialEq)]
pub struct Arm {
    pub comments: Vec<String>,
    pub condition: Ex,
    pub body: Vec<Stmt>,
}

pub fn name(name: impl Into<Name>) -> Ex {
    Ex::Name(name.into())
}

pub fn binary(operator: &'static str, a: Ex, b: Ex) -> Ex {
    Ex::Binary(operator, Box::new(a), Box::new(b))
}

pub fn assign(target: impl Into<Name>, value: Ex) -> Stmt {
    Stmt::Assign(name(target), value)
}

/// `counter := counter + 1`
pub fn advance(counter: &str) -> Stmt {
    assign(counter, binary("+", name(counter), Ex::Int(1)))
}

pub fn when(condition: Ex, body: Vec<Stmt>) -> Stmt {
    Stmt::If(vec![Arm { comments: Vec::new(), condition, body }], Vec::new())
}

/// STruC++ takes no `NOT` of an `AND` or `OR` of comparisons, so these are negated one by one.
pub fn not(a: Ex) -> Ex {
    match a {
        Ex::Bool(b) => Ex::Bool(!b),
        Ex::Not(inner) => *inner,
        Ex::Chain("AND", operands) => or(operands.into_iter().map(not).collect()),
        Ex::Chain("OR", operands) => and(operands.into_iter().map(not).collect()),
        Ex::Binary("=", a, b) => Ex::Binary("<>", a, b),
        Ex::Binary("<>", a, b) => Ex::Binary("=", a, b),
        other => Ex::Not(Box::new(other)),
    }
}

pub fn and(operands: Vec<Ex>) -> Ex {
    chain("AND", operands, true)
}

pub fn or(operands: Vec<Ex>) -> Ex {
    chain("OR", operands, false)
}

/// Without operands that change nothing; `neutral` is the value of no operands.
fn chain(operator: &'static str, operands: Vec<Ex>, neutral: bool) -> Ex {
    let mut flat = Vec::new();
    for operand in operands {
        match operand {
            Ex::Bool(b) if b == neutral => {}
            Ex::Chain(inner, parts) if inner == operator => flat.extend(parts),
            other => flat.push(other),
        }
    }
    if flat.contains(&Ex::Bool(!neutral)) {
        return Ex::Bool(!neutral);
    }
    match flat.len() {
        0 => Ex::Bool(neutral),
        1 => flat.remove(0),
        _ => Ex::Chain(operator, flat),
    }
}

/// A sum of whole numbers, computed as far as it is known.
pub fn sum(a: Ex, b: Ex) -> Ex {
    match (&a, &b) {
        (Ex::Int(x), Ex::Int(y)) => Ex::Int(x.saturating_add(*y)),
        (Ex::Int(0), _) => b,
        (_, Ex::Int(0)) => a,
        _ => binary("+", a, b),
    }
}

pub fn times(a: Ex, factor: i32) -> Ex {
    match a {
        Ex::Int(x) => Ex::Int(x.saturating_mul(factor)),
        a if factor == 1 => a,
        a => binary("*", a, Ex::Int(factor)),
    }
}

impl Ex {
    /// Names that are read: variables, instances of blocks.
    pub fn names(&self, found: &mut HashSet<Name>) {
        match self {
            // A list has constants.
            Ex::Bool(_) | Ex::Int(_) | Ex::Real(_) | Ex::Member(_) | Ex::List(_) => {}
            Ex::Name(name) | Ex::Field(name, _) => add(name, found),
            Ex::Element(name, index) => {
                add(name, found);
                index.names(found);
            }
            Ex::Not(a) | Ex::Minus(a) | Ex::Part(a, _) => a.names(found),
            Ex::Binary(_, a, b) | Ex::Within(a, _, b) => {
                a.names(found);
                b.names(found);
            }
            Ex::Item(a, indices) => {
                a.names(found);
                indices.iter().for_each(|index| index.names(found));
            }
            Ex::Chain(_, parts) => parts.iter().for_each(|p| p.names(found)),
            Ex::Fields(fields) => fields.iter().for_each(|(_, value)| value.names(found)),
            Ex::Call(_, arguments) => arguments.iter().for_each(|(_, a)| a.names(found)),
        }
    }

    /// Functions that are called.
    pub fn functions(&self, found: &mut Vec<&'static str>) {
        match self {
            Ex::Bool(_)
            | Ex::Int(_)
            | Ex::Real(_)
            | Ex::Member(_)
            | Ex::Name(_)
            | Ex::Field(..)
            | Ex::List(_) => {}
            Ex::Element(_, a) | Ex::Not(a) | Ex::Minus(a) | Ex::Part(a, _) => a.functions(found),
            Ex::Binary(_, a, b) | Ex::Within(a, _, b) => {
                a.functions(found);
                b.functions(found);
            }
            Ex::Item(a, indices) => {
                a.functions(found);
                indices.iter().for_each(|index| index.functions(found));
            }
            Ex::Chain(_, parts) => parts.iter().for_each(|p| p.functions(found)),
            Ex::Fields(fields) => fields.iter().for_each(|(_, value)| value.functions(found)),
            Ex::Call(function, arguments) => {
                found.push(function);
                arguments.iter().for_each(|(_, a)| a.functions(found));
            }
        }
    }
}

fn add(name: &Name, found: &mut HashSet<Name>) {
    if !found.contains(name) {
        found.insert(name.clone());
    }
}

/// The index of an element of a table that has `each` for a row.
pub fn within(row: Ex, each: usize, element: Ex) -> Ex {
    Ex::Within(Box::new(row), each as i32, Box::new(element))
}

/// A whole number as a real one. Inside of a call without names truST takes none with names.
pub fn real(whole: Ex) -> Ex {
    let mut called = Vec::new();
    whole.functions(&mut called);
    match called.iter().any(|function| function.starts_with("F_")) {
        true => Ex::Call("F_real", vec![("value", whole)]),
        false => Ex::Call("DINT_TO_LREAL", vec![("", whole)]),
    }
}

/// Calls `visit` with every expression, and with those inside statements that stand in others.
pub fn expressions<'a>(statements: &'a [Stmt], visit: &mut impl FnMut(&'a Ex)) {
    for statement in statements {
        match statement {
            Stmt::Comment(_) | Stmt::Exit | Stmt::Return => {}
            Stmt::Assign(target, value) => {
                visit(target);
                visit(value);
            }
            Stmt::If(arms, otherwise) => {
                for arm in arms {
                    visit(&arm.condition);
                    expressions(&arm.body, visit);
                }
                expressions(otherwise, visit);
            }
            Stmt::Case { selector, branches, otherwise } => {
                visit(selector);
                branches.iter().for_each(|(_, body)| expressions(body, visit));
                expressions(otherwise, visit);
            }
            Stmt::While { condition, body, .. } => {
                visit(condition);
                expressions(body, visit);
            }
            Stmt::Call { arguments, .. } => arguments.iter().for_each(|(_, a)| visit(a)),
        }
    }
}

/// All names that statements read or write.
pub fn names(statements: &[Stmt]) -> HashSet<Name> {
    let mut found = HashSet::new();
    expressions(statements, &mut |e| e.names(&mut found));
    found
}

/// Variables and arrays to which statements assign.
pub fn written(statements: &[Stmt]) -> HashSet<Name> {
    let mut found = HashSet::new();
    for statement in statements {
        match statement {
            Stmt::Assign(Ex::Name(name) | Ex::Element(name, _), _) => {
                found.insert(name.clone());
            }
            Stmt::If(arms, otherwise) => {
                arms.iter().for_each(|arm| found.extend(written(&arm.body)));
                found.extend(written(otherwise));
            }
            Stmt::While { body, .. } => found.extend(written(body)),
            Stmt::Case { branches, otherwise, .. } => {
                branches.iter().for_each(|(_, body)| found.extend(written(body)));
                found.extend(written(otherwise));
            }
            Stmt::Comment(_) | Stmt::Assign(..) | Stmt::Exit | Stmt::Return | Stmt::Call { .. } => {}
        }
    }
    found
}
