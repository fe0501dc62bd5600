//! Specifications that belong together, with the layout that uses them, and what their names mean.

use crate::check;
use crate::check::names::{Names, Number, Space};
use crate::diagnostic::Diagnostic;
use crate::layout::Layout;
use crate::lower::bind::automaton_name;
use crate::source::{FileId, Sources, Span};
use crate::spec::{ast, parser};

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
    for object in &layout.objects {
        let automaton = automaton_name(&object.kind.value);
        let Some(number) = names.find(Space::Types, "", &automaton) else { continue };
        let device = names.declarations()[number].ty.trim_start_matches("on ").to_string();
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

/// A name within quotes.
fn names_at(sources: &Sources, names: &mut Names, span: Span, number: Number) {
    let inner = Span { start: span.start + 1, end: span.end.saturating_sub(1), ..span };
    if sources.text(span).starts_with('"') && inner.start < inner.end {
        names.use_at(sources, inner, number);
    }
}
