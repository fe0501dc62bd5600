//! The greatest number of statements that a scan can execute.

use super::code::{Ex, Stmt};
use super::functions::statements;

/// The most statements that these execute, those of called functions included.
pub fn greatest(block: &[Stmt]) -> u64 {
    let mut total = 0u64;
    for statement in block {
        total = total.saturating_add(one(statement));
        if matches!(statement, Stmt::Exit | Stmt::Return) {
            break;
        }
    }
    total
}

fn one(statement: &Stmt) -> u64 {
    match statement {
        Stmt::Comment(_) => 0,
        Stmt::Exit | Stmt::Return => 1,
        Stmt::Assign(target, value) => 1 + called(target) + called(value),
        Stmt::Call { arguments, .. } => 1 + arguments.iter().map(|(_, a)| called(a)).sum::<u64>(),
        Stmt::If(arms, otherwise) => {
            let mut tested = 0u64;
            let mut most = 0u64;
            for arm in arms {
                tested += called(&arm.condition);
                most = most.max(tested.saturating_add(greatest(&arm.body)));
            }
            most.max(tested.saturating_add(greatest(otherwise))).saturating_add(1)
        }
        Stmt::Case { branches, otherwise, .. } => {
            let branches = branches.iter().map(|(_, body)| greatest(body));
            branches.max().unwrap_or(0).max(greatest(otherwise)).saturating_add(1)
        }
        Stmt::While { condition, body, most } => {
            // The test that ends the loop computes the condition once more.
            let tested = called(condition);
            let round = greatest(body).saturating_add(tested).saturating_add(1);
            most.saturating_mul(round).saturating_add(1 + tested)
        }
    }
}

fn called(ex: &Ex) -> u64 {
    let mut called = Vec::new();
    ex.functions(&mut called);
    called.into_iter().map(statements).sum()
}

/// Statements as they are written.
pub fn written(block: &[Stmt]) -> u64 {
    block
        .iter()
        .map(|statement| match statement {
            Stmt::Comment(_) => 0,
            Stmt::Assign(..) | Stmt::Exit | Stmt::Return | Stmt::Call { .. } => 1,
            Stmt::If(arms, otherwise) => {
                1 + arms.iter().map(|a| written(&a.body)).sum::<u64>() + written(otherwise)
            }
            Stmt::Case { branches, otherwise, .. } => {
                1 + branches.iter().map(|(_, body)| written(body)).sum::<u64>() + written(otherwise)
            }
            Stmt::While { body, .. } => 1 + written(body),
        })
        .sum()
}
