//! Statements and expressions with the places of structures.

use super::access::{COORDINATES, Places};
use crate::backend::st::code::{Arm, Ex, Stmt};

impl Places {
    pub fn statements(&self, statements: &[Stmt]) -> Vec<Stmt> {
        joined(statements.iter().map(|statement| self.statement(statement)).collect())
    }

    pub fn statement(&self, statement: &Stmt) -> Stmt {
        match statement {
            Stmt::Comment(_) | Stmt::Exit | Stmt::Return => statement.clone(),
            Stmt::Assign(target, value) => Stmt::Assign(self.ex(target), self.ex(value)),
            Stmt::If(arms, otherwise) => {
                let arm = |arm: &Arm| Arm {
                    comments: arm.comments.clone(),
                    condition: self.ex(&arm.condition),
                    body: self.statements(&arm.body),
                };
                Stmt::If(arms.iter().map(arm).collect(), self.statements(otherwise))
            }
            Stmt::Case { selector, branches, otherwise } => Stmt::Case {
                selector: self.ex(selector),
                branches: branches
                    .iter()
                    .map(|(label, body)| (label.clone(), self.statements(body)))
                    .collect(),
                otherwise: self.statements(otherwise),
            },
            Stmt::While { condition, body, most } => {
                Stmt::While { condition: self.ex(condition), body: self.statements(body), most: *most }
            }
            Stmt::Call { instance, arguments } => Stmt::Call {
                instance: instance.clone(),
                arguments: arguments.iter().map(|(name, value)| (name.clone(), self.ex(value))).collect(),
            },
        }
    }

    pub fn ex(&self, ex: &Ex) -> Ex {
        let boxed = |ex: &Ex| Box::new(self.ex(ex));
        let all = |parts: &[Ex]| parts.iter().map(|part| self.ex(part)).collect();
        match ex {
            Ex::Bool(_) | Ex::Int(_) | Ex::Real(_) | Ex::Member(_) | Ex::List(_) => ex.clone(),
            Ex::Name(name) => self.read(name, None),
            Ex::Element(name, index) => self.read(name, Some(self.ex(index))),
            Ex::Field(instance, output) => self.output(instance, output),
            Ex::Within(row, each, element) => Ex::Within(boxed(row), *each, boxed(element)),
            Ex::Part(of, field) => Ex::Part(boxed(of), field.clone()),
            Ex::Item(of, indices) => Ex::Item(boxed(of), all(indices)),
            Ex::Fields(fields) => {
                Ex::Fields(fields.iter().map(|(name, value)| (name.clone(), self.ex(value))).collect())
            }
            Ex::Not(a) => Ex::Not(boxed(a)),
            Ex::Minus(a) => Ex::Minus(boxed(a)),
            Ex::Binary(operator, a, b) => Ex::Binary(operator, boxed(a), boxed(b)),
            Ex::Chain(operator, parts) => Ex::Chain(operator, all(parts)),
            Ex::Call(function, arguments) => {
                Ex::Call(function, arguments.iter().map(|(name, value)| (*name, self.ex(value))).collect())
            }
        }
    }
}

/// Three assignments from point to point as one.
pub fn joined(statements: Vec<Stmt>) -> Vec<Stmt> {
    let mut out: Vec<Stmt> = Vec::new();
    for statement in statements {
        out.push(statement);
        let Some(last) = out.len().checked_sub(COORDINATES.len()) else { continue };
        if let Some(whole) = point(&out[last..]) {
            out.truncate(last);
            out.push(whole);
        }
    }
    out
}

fn point(statements: &[Stmt]) -> Option<Stmt> {
    let mut whole: Option<(&Ex, &Ex)> = None;
    for (statement, coordinate) in statements.iter().zip(COORDINATES) {
        let Stmt::Assign(Ex::Part(target, a), Ex::Part(value, b)) = statement else { return None };
        if a != coordinate || b != coordinate || whole.is_some_and(|known| known != (target, value)) {
            return None;
        }
        whole = Some((target, value));
    }
    whole.map(|(target, value)| Stmt::Assign(target.clone(), value.clone()))
}
