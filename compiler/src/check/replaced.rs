//! Declarations that a later file replaces, and what others miss then.

use super::Checker;
use crate::diagnostic::Diagnostic;
use crate::library;
use crate::source::{Sources, Span};
use crate::spec::ast::{Automaton, Name};

/// A declaration that does not count, because a later file has one of its name.
#[derive(Clone, Debug)]
pub(super) struct Replaced {
    what: &'static str,
    before: Span,
    by: Name,
    /// Those that an automaton had.
    interfaces: Vec<String>,
}

impl Replaced {
    pub(super) fn new(what: &'static str, before: &Name, by: &Name) -> Self {
        Self { what, before: before.span, by: by.clone(), interfaces: Vec::new() }
    }

    pub(super) fn automaton(before: &Automaton, by: &Name) -> Self {
        let interfaces = before.implements.iter().map(|clause| clause.interface.value.clone()).collect();
        Self { interfaces, ..Self::new("automaton", &before.name, by) }
    }
}

impl Checker<'_> {
    /// A role needs somebody who can have it.
    pub(super) fn lonely_roles(&mut self) {
        let trees = &self.declarations;
        let is_implemented =
            |name: &str| trees.automata.iter().flat_map(|a| &a.implements).any(|i| i.interface.value == name);
        let roles = || trees.automata.iter().flat_map(|automaton| &automaton.roles);
        let asked = |name: &Name| {
            let mut names = roles().flat_map(|role| [&role.interface].into_iter().chain(&role.also));
            names.find(|asked| asked.value == name.value).map(|asked| asked.span)
        };
        let names = trees.interfaces.iter().map(|interface| &interface.name);
        let lonely: Vec<(Name, Span)> = names
            .filter(|name| !is_implemented(&name.value))
            .filter_map(|name| Some((name.clone(), asked(name)?)))
            .collect();
        for (name, asked) in lonely {
            let message = format!("no automaton has the interface `{}`, which a role asks for", name.value);
            let had = self.declarations.replaced.iter().find(|r| r.interfaces.contains(&name.value));
            let Some(had) = had else {
                let help = format!("write `automaton ... is {}`", name.value);
                let lonely = Diagnostic::new("E0304", name.span, message).help(help);
                self.report(lonely.other(asked, "asked for here"));
                continue;
            };
            let by = &had.by;
            let label = format!("this replaces the `{}` that had it", by.value);
            let help = format!(
                "choose another name for the automaton, or write `automaton {} ... is {}`",
                by.value, name.value
            );
            let lonely = Diagnostic::new("E0304", by.span, message).label(label).help(help);
            self.lonely.push(lonely.other(had.before, "replaced").other(name.span, "asked for"));
        }
    }
}

/// The library has no errors. So its types miss what another declaration has replaced: that is told instead.
pub(super) fn explain(sources: &Sources, replaced: &[Replaced], found: &mut Vec<Diagnostic>) {
    let is_of_library = |place: Span| library::has(sources.file(place.file));
    let replaced: Vec<&Replaced> =
        replaced.iter().filter(|r| is_of_library(r.before) && !is_of_library(r.by.span)).collect();
    if replaced.is_empty() {
        return;
    }
    let missing: Vec<Diagnostic> = found.extract_if(.., |error| is_of_library(error.place)).collect();
    let mut told: Vec<Span> = Vec::new();
    for error in missing {
        let line = sources.position(error.place).0;
        let line = sources.file(error.place.file).text.lines().nth(line - 1).unwrap_or_default();
        let is_named = |r: &&&Replaced| words(line).any(|word| word == r.by.value);
        let meant = replaced.iter().find(is_named).unwrap_or(&replaced[0]);
        let name = &meant.by.value;
        if told.contains(&meant.by.span) {
            continue;
        }
        told.push(meant.by.span);
        let message = format!("`{name}` replaces the {} of the library, which other types need", meant.what);
        let own = if name.starts_with(|c: char| c.is_ascii_uppercase()) { "Own" } else { "own_" };
        let help =
            format!("choose another name, such as `{own}{name}`, or replace the types that need it too");
        let explained = Diagnostic::new("E0307", meant.by.span, message).help(help);
        found.push(explained.other(meant.before, "replaced").other(error.place, error.message));
    }
}

fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split(|c: char| !c.is_ascii_alphanumeric() && c != '_')
}
