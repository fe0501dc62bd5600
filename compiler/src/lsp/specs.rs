//! Specifications that belong together, with the layout that uses them, and what their names mean.

use crate::check;
use crate::check::names::{Names, Number, Space};
use crate::diagnostic::Diagnostic;
use crate::layout::{Layout, Object};
use crate::lower::bind::automaton_name;
use crate::source::{FileId, Sources, Span};
use crate::spec::{ast, parser};
use std::collections::HashMap;

#[derive(Debug)]
pub struct Specs {
    pub sources: Sources,
    pub files: Vec<(FileId, ast::File)>,
    pub layout: Option<Layout>,
    /// The layout, if it cannot be read.
    pub unread: Option<FileId>,
    pub names: Names,
    /// Of the scenario; `None`: they could not be read.
    pub kinds: Option<Vec<String>>,
}

impl Specs {
    /// What can be read of the files, and meant by them.
    pub fn new(
        sources: Sources,
        files: &[FileId],
        layout: Option<Layout>,
        kinds: Option<Vec<String>>,
    ) -> Self {
        let files = trees(&sources, files).0;
        let mut names = check::names(&sources, &files, kinds.as_deref());
        if let Some(layout) = &layout {
            uses_of_layout(&sources, layout, &mut names);
        }
        Self { sources, files, layout, unread: None, names, kinds }
    }

    /// Where a name is declared; none if it is in no specification.
    pub fn definition(&self, place: Span) -> Option<Span> {
        let (number, _) = self.names.at(place)?;
        self.names.declarations()[number].place
    }

    /// Where a name is used, in the order of the places, after its declaration.
    pub fn references(&self, place: Span) -> Option<(Option<Span>, Vec<Span>)> {
        let (number, _) = self.names.at(place)?;
        let uses = self.names.uses().filter(|(_, used)| *used == number).map(|(span, _)| span);
        Some((self.names.declarations()[number].place, uses.collect()))
    }
}

/// The trees of files, and what cannot be read.
pub fn trees(sources: &Sources, files: &[FileId]) -> (Vec<(FileId, ast::File)>, Vec<Diagnostic>) {
    let mut left = parser::MOST_TOKENS;
    let mut diagnostics = Vec::new();
    let read = |file: &FileId| {
        let (tree, found) = parser::parse_within(*file, &sources.file(*file).text, &mut left);
        diagnostics.extend(found);
        (*file, tree)
    };
    let trees = files.iter().map(read).collect();
    (trees, diagnostics)
}

/// The types, parameters and keys that a layout names.
fn uses_of_layout(sources: &Sources, layout: &Layout, names: &mut Names) {
    let device_of = |names: &Names, object: &Object| {
        let number = names.find(Space::Types, "", &automaton_name(&object.kind.value))?;
        Some((number, names.declarations()[number].ty.trim_start_matches("on ").to_string()))
    };
    let machines: HashMap<&str, &Object> =
        layout.objects.iter().map(|object| (object.name.value.as_str(), object)).collect();
    for object in &layout.objects {
        if let Some(at) = &object.at
            && let Some(of) = machines.get(at.machine.as_str())
            && let Some((_, device)) = device_of(names, of)
        {
            lane_at(sources, names, at.named, &format!("{}.", at.machine), &at.lane, &device);
        }
        let automaton = automaton_name(&object.kind.value);
        let Some((number, device)) = device_of(names, object) else { continue };
        if let Some(own) = object.at.as_ref().and_then(|at| at.own.as_ref()) {
            lane_at(sources, names, own.span, "", &own.value, &device);
        }
        names_at(sources, names, object.kind.span, number);
        let parameters = object.parameters.iter().map(|(name, _)| (Space::OfType, &automaton, name));
        let keys = object.members.iter().map(|member| (Space::OfDevice, &device, &member.key));
        for (space, owner, name) in parameters.chain(keys) {
            if let Some(number) = names.find(space, owner, &name.value) {
                names_at(sources, names, name.span, number);
            }
        }
    }
}

/// A lane within quotes, behind a text: a part of a device, or a part of an assembly there.
fn lane_at(sources: &Sources, names: &mut Names, span: Span, before: &str, lane: &str, device: &str) {
    if sources.text(span) != format!("\"{before}{lane}\"") {
        return;
    }
    let mut start = span.start as usize + 1 + before.len();
    let mut owner = device.to_string();
    for part in lane.split('.') {
        let Some(number) = names.find(Space::OfDevice, &owner, part) else { return };
        names.use_at(sources, Span::new(span.file, start, start + part.len()), number);
        owner = names.declarations()[number].ty.clone();
        start += part.len() + 1;
    }
}

/// A name within quotes.
fn names_at(sources: &Sources, names: &mut Names, span: Span, number: Number) {
    let inner = Span { start: span.start + 1, end: span.end.saturating_sub(1), ..span };
    if sources.text(span).starts_with('"') && inner.start < inner.end {
        names.use_at(sources, inner, number);
    }
}
