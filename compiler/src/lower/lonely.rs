//! A role whose interface a type has, but no machine of the layout.

use crate::diagnostic::Diagnostic;
use crate::source::{FileId, Sources};
use crate::spec::ast;
use std::collections::BTreeSet;

/// Of `found`, the diagnostics about interfaces that no used type has, if another type has it: then a machine is missing.
/// `used` are the names of the automata of the layout's machines.
pub fn explain(
    sources: &Sources,
    files: &[(FileId, ast::File)],
    used: &BTreeSet<String>,
    found: &mut [Diagnostic],
) {
    for diagnostic in found.iter_mut().filter(|diagnostic| diagnostic.code == "E0304") {
        let interface = sources.text(diagnostic.place).to_string();
        let automata = || files.iter().flat_map(|(_, file)| &file.automata);
        let has_it = |automaton: &&ast::Automaton| {
            automaton.implements.iter().any(|clause| clause.interface.value == interface)
        };
        let types: BTreeSet<&str> = automata().filter(has_it).map(|of| of.name.value.as_str()).collect();
        let mut roles = automata().filter(|of| used.contains(&of.name.value)).flat_map(|of| {
            let asks = |role: &&ast::Role| {
                role.interface.value == interface || role.also.iter().any(|also| also.value == interface)
            };
            of.roles.iter().filter(asks).map(move |role| (of, role))
        });
        let Some((automaton, role)) = roles.next().filter(|_| !types.is_empty()) else { continue };
        let message = format!(
            "no machine of the layout has the interface `{interface}`, which `{}` of `{}` asks for",
            role.name.value, automaton.name.value
        );
        let types = types.into_iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
        let help = format!("add a machine of a type that has it: {types}");
        *diagnostic = Diagnostic::new("E0304", role.name.span, message).help(help);
    }
}
