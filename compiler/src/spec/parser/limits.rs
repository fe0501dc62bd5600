//! How many declarations a type may have: what compares each of them with each other has to end.

use super::Parser;
use crate::diagnostic::{Diagnostic, collect};
use crate::spec::ast;

/// Of one kind in one place.
const MOST: usize = 1000;
/// Transitions of any state, in all states of an automaton together.
const MOST_OF_ANY_STATE: usize = 50_000;

/// Of which there are too many.
const FILE: &str = "enumerations, interfaces and automata";
const MEMBERS: &str = "members";
const UPDATES: &str = "updates in one transition";

impl Parser {
    pub(super) fn bounded(&mut self, file: &ast::File) {
        let names = file.enums.iter().map(|e| &e.name);
        let names =
            names.chain(file.interfaces.iter().map(|i| &i.name)).chain(file.automata.iter().map(|a| &a.name));
        let names: Vec<&ast::Name> = names.collect();
        if let Some(first) = names.get(MOST) {
            self.too_many(first, "a file", FILE, [names.len(), MOST]);
        }
        for tree in &file.enums {
            self.bound(&tree.name, MEMBERS, tree.members.len());
        }
        for tree in &file.interfaces {
            self.bound(&tree.name, "parameters", tree.parameters.len());
            self.bound(&tree.name, "cells", tree.cells.len());
            self.bound(&tree.name, "properties", tree.properties.len());
        }
        for tree in &file.automata {
            self.bound_automaton(tree);
        }
    }

    fn bound_automaton(&mut self, tree: &ast::Automaton) {
        for (what, count) in [
            ("interfaces", tree.implements.len()),
            ("parameters", tree.parameters.len()),
            ("cells", tree.cells.len()),
            ("roles", tree.roles.len()),
            ("local variables", tree.locals.len()),
            ("definitions", tree.defines.len()),
            ("requirements", tree.requires.len()),
            ("properties", tree.properties.len()),
            ("states", tree.states.len()),
            ("transitions of any state", tree.any.iter().map(|any| any.transitions.len()).sum()),
        ] {
            self.bound(&tree.name, what, count);
        }
        let of_any_state: usize = tree.any.iter().map(|any| any.transitions.len()).sum();
        let in_all_states = of_any_state.saturating_mul(tree.states.len());
        if in_all_states > MOST_OF_ANY_STATE {
            let who = format!("`{}`", tree.name.value);
            let what = "transitions of any state, counted in each of its states";
            self.too_many(&tree.name, &who, what, [in_all_states, MOST_OF_ANY_STATE]);
        }
        for state in &tree.states {
            let outcomes = match &state.body {
                ast::Body::Transitions(transitions) => {
                    self.bound(&state.name, "transitions", transitions.len());
                    transitions.iter().map(|t| t.updates.len()).max().unwrap_or(0)
                }
                ast::Body::Sequence(sequence) => {
                    self.bound(&state.name, "steps", sequence.steps.len());
                    0
                }
            };
            self.bound(&state.name, UPDATES, outcomes);
        }
    }

    fn bound(&mut self, name: &ast::Name, what: &str, count: usize) {
        if count > MOST {
            self.too_many(name, &format!("`{}`", name.value), what, [count, MOST]);
        }
    }

    fn too_many(&mut self, name: &ast::Name, who: &str, what: &str, [count, most]: [usize; 2]) {
        let diagnostic = Diagnostic::new("E0215", name.span, format!("{who} has more than {most} {what}"))
            .note(format!("there are {count}"))
            .help(match what {
                FILE => "divide it into several files",
                MEMBERS => "use fewer members, or a whole number with bounds",
                UPDATES => "divide the transition: the updates follow one another in several states",
                _ => "divide it into several, or compute values in updates instead",
            });
        collect(&mut self.diagnostics, diagnostic);
    }
}
