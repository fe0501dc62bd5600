//! Statements that lead to nothing: what they store nobody reads.
//!
//! A guard may name a value without looking at it, and a quantifier may be decided before its loop.

use super::code::{Ex, Stmt, expressions};
use super::name::Name;
use std::collections::{BTreeSet, HashSet};

/// Without assignments to those of the variables that nothing reads, their own assignments apart.
pub fn without_unread(mut statements: Vec<Stmt>, variables: &BTreeSet<Name>) -> Vec<Stmt> {
    loop {
        let mut read = HashSet::new();
        reads(&statements, &mut read);
        let unread: BTreeSet<&Name> = variables.iter().filter(|name| !read.contains(*name)).collect();
        let Some(fewer) = without(&statements, &unread) else { return statements };
        statements = fewer;
    }
}

/// Variables that are read, but for the one that the reading assignment sets.
fn reads(statements: &[Stmt], found: &mut HashSet<Name>) {
    for statement in statements {
        match statement {
            Stmt::Assign(target, value) => {
                let mut names = HashSet::new();
                value.names(&mut names);
                match target {
                    Ex::Name(name) => drop(names.remove(name)),
                    Ex::Element(_, index) => index.names(&mut names),
                    _ => {}
                }
                found.extend(names);
            }
            Stmt::If(arms, otherwise) => {
                for arm in arms {
                    arm.condition.names(found);
                    reads(&arm.body, found);
                }
                reads(otherwise, found);
            }
            Stmt::Case { selector, branches, otherwise } => {
                selector.names(found);
                branches.iter().for_each(|(_, body)| reads(body, found));
                reads(otherwise, found);
            }
            Stmt::While { condition, body, .. } => {
                condition.names(found);
                reads(body, found);
            }
            Stmt::Comment(_) | Stmt::Exit | Stmt::Return | Stmt::Call { .. } => {
                expressions(std::slice::from_ref(statement), &mut |e| e.names(found));
            }
        }
    }
}

/// The statements without some assignments; nothing if there are none of them. Branches must not become empty:
/// a test is left out with its last branch, and else the assignment stays.
fn without(statements: &[Stmt], unread: &BTreeSet<&Name>) -> Option<Vec<Stmt>> {
    let mut out = Vec::new();
    let mut is_shorter = false;
    for statement in statements {
        let fewer = match statement {
            Stmt::Assign(Ex::Name(name), _) if unread.contains(name) => Some(None),
            Stmt::If(arms, otherwise) if arms.len() == 1 && otherwise.is_empty() => {
                without(&arms[0].body, unread).map(|body| {
                    let mut arms = arms.clone();
                    arms[0].body = body;
                    is_of_substance(&arms[0].body).then(|| Stmt::If(arms, Vec::new()))
                })
            }
            Stmt::If(arms, otherwise) => {
                let mut fewer = arms.clone();
                let mut is_changed = false;
                for arm in &mut fewer {
                    is_changed |= replace(&mut arm.body, unread);
                }
                let mut otherwise = otherwise.clone();
                is_changed |= replace(&mut otherwise, unread);
                is_changed.then_some(Some(Stmt::If(fewer, otherwise)))
            }
            Stmt::Case { selector, branches, otherwise } => {
                let mut branches = branches.clone();
                let mut is_changed = false;
                for (_, body) in &mut branches {
                    is_changed |= replace(body, unread);
                }
                let (selector, otherwise) = (selector.clone(), otherwise.clone());
                is_changed.then_some(Some(Stmt::Case { selector, branches, otherwise }))
            }
            Stmt::While { condition, body, most } => {
                let mut body = body.clone();
                let (condition, most) = (condition.clone(), *most);
                replace(&mut body, unread).then_some(Some(Stmt::While { condition, body, most }))
            }
            _ => None,
        };
        is_shorter |= fewer.is_some();
        out.extend(fewer.unwrap_or_else(|| Some(statement.clone())));
    }
    is_shorter.then_some(out)
}

/// Whether a branch became shorter, which it does unless it became empty.
fn replace(body: &mut Vec<Stmt>, unread: &BTreeSet<&Name>) -> bool {
    match without(body, unread) {
        Some(fewer) if is_of_substance(&fewer) => {
            *body = fewer;
            true
        }
        _ => false,
    }
}

fn is_of_substance(body: &[Stmt]) -> bool {
    body.iter().any(|statement| !matches!(statement, Stmt::Comment(_)))
}

#[cfg(test)]
mod tests {
    use super::super::code::{assign, name, when};
    use super::*;

    fn one(variable: &str) -> Stmt {
        assign(variable, Ex::Int(1))
    }

    #[test]
    fn only_what_nobody_reads_is_left_out() {
        let variables = ["a", "b", "c"].map(Name::from).into();
        let from = |target: &str, source: &str| assign(target, name(source));
        // `c` is read; `b` is read for `a` only, and `a` by nobody but itself.
        let statements = vec![one("c"), one("b"), from("a", "b"), from("a", "a"), from("out", "c"), one("d")];
        assert_eq!(without_unread(statements, &variables), [one("c"), from("out", "c"), one("d")]);
    }

    #[test]
    fn a_test_goes_with_its_last_branch() {
        let variables = ["a"].map(Name::from).into();
        let body = |inner| vec![when(name("x"), inner), one("out")];
        assert_eq!(without_unread(body(vec![one("a")]), &variables), [one("out")]);
        assert_eq!(without_unread(body(vec![one("a"), one("d")]), &variables), body(vec![one("d")]));
    }
}
