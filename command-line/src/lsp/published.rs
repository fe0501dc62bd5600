//! Diagnostics that the client has been told.

use super::documents::Documents;
use super::root::{Found, Root};
use super::uri;
use crate::read::{self, MOST_BYTES};
use autogen::lsp::diagnostics::{self, Located};
use autogen::lsp::lines::Lines;
use autogen::lsp::protocol::{Diagnostic, Location, PublishDiagnosticsParams, Uri};
use autogen::source::{FileId, Sources, Span};
use serde_json::{Value, json};
use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

/// By real paths, with the address that the client was told.
#[derive(Debug, Default)]
pub struct Published {
    told: BTreeMap<PathBuf, (Uri, Vec<Diagnostic>)>,
}

impl Published {
    /// Checks everything anew: a message for each file of which the client knows something else, or another version.
    /// Each root comes with the open files that belong to it.
    pub fn renewed(&mut self, roots: &BTreeMap<Root, Vec<PathBuf>>, documents: &Documents) -> Vec<Value> {
        let mut new: BTreeMap<PathBuf, Vec<Diagnostic>> = BTreeMap::new();
        for (path, document) in documents.all() {
            let of_file = new.entry(path.into()).or_default();
            if document.text.is_none() {
                let most = MOST_BYTES / 1_000_000;
                let text = format!("this file is larger than {most} MB, which is the limit");
                of_file.push(diagnostics::of_file(&text));
            }
        }
        for (root, open) in roots {
            let found = catch_unwind(AssertUnwindSafe(|| root.check())).unwrap_or_else(|_| Found {
                refused: Some("this is a bug in autogen, not in this file".into()),
                ..Found::default()
            });
            let holders = root.layout().map_or_else(|| open.clone(), |layout| vec![layout.into()]);
            add(&mut new, open, &holders, &found, documents);
        }
        let files: BTreeSet<&PathBuf> = self.told.keys().chain(new.keys()).collect();
        let (mut messages, mut told) = (Vec::new(), BTreeMap::new());
        let mut tell = |params: PublishDiagnosticsParams| {
            messages.push(json!({
                "jsonrpc": "2.0", "method": "textDocument/publishDiagnostics", "params": params,
            }));
        };
        for file in files {
            let document = documents.at(file);
            let diagnostics = new.get(file).cloned().unwrap_or_default();
            let uri = document.map_or_else(|| uri::of(file), |document| document.uri.clone());
            let last = self.told.get(file).filter(|(last, _)| *last == uri);
            if let Some((other, _)) = self.told.get(file).filter(|(last, _)| *last != uri) {
                tell(PublishDiagnosticsParams { uri: other.clone(), version: None, diagnostics: Vec::new() });
            }
            if document.is_some() || last.map_or(&[][..], |(_, last)| last) != diagnostics {
                let version = document.map(|document| document.version);
                tell(PublishDiagnosticsParams {
                    uri: uri.clone(),
                    version,
                    diagnostics: diagnostics.clone(),
                });
            }
            if !diagnostics.is_empty() {
                told.insert(file.clone(), (uri, diagnostics));
            }
        }
        self.told = told;
        messages
    }
}

/// Of what several roots find in a file each is reported once. What is wrong with a text that is no file is shown in
/// the files that hold it.
fn add(
    new: &mut BTreeMap<PathBuf, Vec<Diagnostic>>,
    open: &[PathBuf],
    holders: &[PathBuf],
    found: &Found,
    documents: &Documents,
) {
    let mut tell = |path: &Path, diagnostic: Diagnostic| {
        let of_file = new.entry(path.into()).or_default();
        if !of_file.contains(&diagnostic) {
            of_file.push(diagnostic);
        }
    };
    if let Some(why) = &found.refused {
        open.iter().for_each(|path| tell(path, diagnostics::of_file(why)));
    }
    let files = Files::new(&found.sources, documents);
    for diagnostic in &found.diagnostics {
        let file = diagnostic.place.file;
        let lines = files.lines(file);
        match &files.paths[file.0 as usize] {
            Some(path) => tell(path, diagnostics::shown(diagnostic, lines, &files)),
            None => {
                let name = &found.sources.file(file).name;
                let shown = diagnostics::of_built_in(diagnostic, name, lines, &files);
                holders.iter().for_each(|path| tell(path, shown.clone()));
            }
        }
    }
}

/// The texts of a check as files of the client.
pub struct Files<'a> {
    sources: &'a Sources,
    documents: &'a Documents,
    /// Real ones, by numbers of files; none for texts that are no files.
    pub paths: Vec<Option<PathBuf>>,
    lines: Vec<OnceCell<Lines<'a>>>,
}

impl<'a> Files<'a> {
    pub fn new(sources: &'a Sources, documents: &'a Documents) -> Self {
        let real = |name: &str| Some(Path::new(name)).filter(|path| path.is_absolute()).and_then(read::real);
        let paths = sources.files().iter().map(|file| real(&file.name)).collect();
        let lines = sources.files().iter().map(|_| OnceCell::new()).collect();
        Self { sources, documents, paths, lines }
    }

    pub fn lines(&self, file: FileId) -> &Lines<'a> {
        self.lines[file.0 as usize].get_or_init(|| Lines::new(&self.sources.file(file).text))
    }
}

impl Located for Files<'_> {
    fn location(&self, span: Span) -> Option<Location> {
        let path = self.paths[span.file.0 as usize].as_ref()?;
        let uri = self.documents.at(path).map_or_else(|| uri::of(path), |document| document.uri.clone());
        Some(Location { uri, range: self.lines(span.file).range(span) })
    }
}
