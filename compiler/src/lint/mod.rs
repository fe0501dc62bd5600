//! What is no error and hardly meant: warnings, from the texts of the types and from the layout.

mod answer;
mod beams;
mod contradiction;
mod driven;
mod failure;
mod floors;
mod flow;
mod implies;
mod lanes;
mod moving;
mod overwritten;
mod processes;
mod retained;
mod undriven;
mod unused;

use crate::check::Checked;
use crate::diagnostic::{self, Diagnostic};
use crate::ir::System;
use crate::layout::{Layout, Panel};
use crate::source::FileId;
use crate::spec::ast;
use runtime_sim::line::Line;

/// Warnings of all types that have no errors, in the order of the text. `files` are the texts of the types,
/// `panel` is that of the layout.
pub fn warnings(checked: &Checked, files: &[(FileId, ast::File)], panel: Panel) -> Vec<Diagnostic> {
    let model = checked.model();
    let mut found = checked.remarks().to_vec();
    for automaton in &model.automata {
        flow::check(model, automaton, &mut found);
        contradiction::check(model, automaton, &mut found);
        failure::check(automaton, &mut found);
        answer::check(automaton, &mut found);
        overwritten::check(automaton, &mut found);
    }
    unused::check(model, files, &mut found);
    undriven::check(model, panel, &mut found);
    moving::check(model, &mut found);
    diagnostic::sort(&mut found);
    found
}

/// Warnings of a layout that has no errors.
pub fn of_layout(layout: &Layout, system: &System, line: &Line) -> Vec<Diagnostic> {
    let mut found = lanes::check(layout, system, line);
    found.extend(beams::check(system, line));
    found.extend(processes::check(system, line));
    found.extend(driven::check(layout, line));
    found.extend(floors::check(layout, system, line));
    found.extend(retained::check(system));
    diagnostic::sort(&mut found);
    found
}
