//! What is no error and hardly meant: warnings from the texts of the types alone.

mod failure;
mod flow;
mod implies;
mod unused;

use crate::diagnostic::{self, Diagnostic};
use crate::ir::Model;
use crate::source::FileId;
use crate::spec::ast;

/// Warnings of all types of a model that has no errors, in the order of the text. `files` are the texts of the model.
pub fn warnings(model: &Model, files: &[(FileId, ast::File)]) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for automaton in &model.automata {
        flow::check(automaton, &mut found);
        failure::check(automaton, &mut found);
    }
    unused::check(model, files, &mut found);
    diagnostic::sort(&mut found);
    found
}
