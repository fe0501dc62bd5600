//! Constructs of the language by name, and which of them were never executed.

use crate::check::Checked;
use crate::finding::Span;
use crate::view::{ExpressionKind, Statement, StatementKind, each_part, each_statement, expressions};
use std::collections::{BTreeSet, HashMap};

/// The constructs of each statement, without those of the statements inside of it.
pub(super) fn of_text(checked: &Checked) -> HashMap<Span, BTreeSet<String>> {
    let mut constructs = HashMap::new();
    for unit in &checked.text.units {
        each_statement(&unit.body, &mut |statement| {
            constructs.insert(statement.span, of_statement(statement));
        });
    }
    constructs
}

fn of_statement(statement: &Statement) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    let name = match &statement.kind {
        StatementKind::Assign { .. } => "assignment",
        StatementKind::Call(_) => "call of a function block",
        StatementKind::If { branches, .. } if branches.len() > 1 => "IF with ELSIF",
        StatementKind::If { otherwise: Some(_), .. } => "IF with ELSE",
        StatementKind::If { .. } => "IF",
        StatementKind::Case { .. } => "CASE",
        StatementKind::While { .. } => "WHILE",
        StatementKind::Exit => "EXIT",
        StatementKind::Return => "RETURN",
        StatementKind::Other => "other",
    };
    names.insert(name.to_string());
    for expression in expressions(statement) {
        each_part(expression, &mut |part| {
            names.insert(match &part.kind {
                ExpressionKind::Bool(_) => "literal BOOL".into(),
                ExpressionKind::Int(_) => "literal DINT".into(),
                ExpressionKind::Real(_) => "literal LREAL".into(),
                ExpressionKind::Index { .. } => "element of an array".into(),
                ExpressionKind::Member { .. } => "output of a function block".into(),
                ExpressionKind::Unary { operator, .. } => format!("{operator:?}"),
                ExpressionKind::Binary { operator, .. } => format!("{operator:?}"),
                ExpressionKind::Call(call) => format!("call of {}", call.name.text),
                _ => "variable or parenthesis".into(),
            });
        });
    }
    names
}
