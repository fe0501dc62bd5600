//! What the client asks about a place in a text.

use super::documents::Documents;
use super::layouts::{self, Layouts, MOST_LAYOUTS};
use super::published::Files;
use super::root::{self, Root};
use crate::read;
use autogen::check::names::What;
use autogen::lsp::completion::completion;
use autogen::lsp::diagnostics::Located;
use autogen::lsp::hover::hover;
use autogen::lsp::json::{self, Completion, Of, Wanted};
use autogen::lsp::lines::Lines;
use autogen::lsp::protocol::{
    CompletionItem, CompletionItemKind, Hover, Location, MarkupContent, MarkupKind, Position, Range,
    TextEdit, Uri, WorkspaceEdit,
};
use autogen::lsp::rename;
use autogen::lsp::specs::Specs;
use autogen::source::{FileId, Span};
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::path::{Path, PathBuf};

/// What the texts mean, until one of them changes.
#[derive(Debug, Default)]
pub struct Questions {
    known: BTreeMap<Root, Option<Specs>>,
}

/// A place in one of the texts that belong together.
struct At<'a> {
    specs: &'a Specs,
    files: Files<'a>,
    file: FileId,
    offset: usize,
}

/// In texts that belong together; none if the file is none of them.
fn at<'a>(specs: &'a Specs, documents: &'a Documents, path: &Path, position: Position) -> Option<At<'a>> {
    let files = Files::new(&specs.sources, documents);
    let file = files.paths.iter().position(|known| known.as_deref() == Some(path))?;
    let file = FileId(file as u32);
    let offset = files.lines(file).offset(position);
    Some(At { specs, files, file, offset })
}

impl At<'_> {
    fn span(&self) -> Span {
        Span::new(self.file, self.offset, self.offset)
    }

    fn range(&self, span: Span) -> Range {
        self.files.lines(span.file).range(span)
    }
}

/// A layout or a scenario that is open.
struct OpenJson<'a> {
    of: Of,
    line: json::Line,
    text: &'a str,
    lines: Lines<'a>,
}

impl<'a> OpenJson<'a> {
    /// With what is known of its line, or of the nearest of its lines.
    fn of(asked: &Asked<'a>, layouts: &mut Layouts) -> Option<Self> {
        let (path, document) = asked.documents.get(asked.uri)?;
        let text = document.text.as_deref()?;
        path.extension().filter(|extension| *extension == "json")?;
        let found = Root::all(path, text, layouts, asked.folders).into_iter().next();
        let begun = || layouts::is_begun(text).then(|| Root::Layout(path.into()));
        let root = found.or_else(begun)?;
        let of = if root.layout() == Some(path) { Of::Layout } else { Of::Scenario };
        Some(Self { of, line: root::line(&root)?, text, lines: Lines::new(text) })
    }

    fn offset(&self, asked: &Asked) -> usize {
        self.lines.offset(asked.position)
    }

    fn range(&self, place: std::ops::Range<usize>) -> Range {
        Range { start: self.lines.position(place.start), end: self.lines.position(place.end) }
    }

    /// Each replaces what is typed, with its quotes: an editor takes them for a part of the word or not.
    fn completion(&self, asked: &Asked) -> Vec<CompletionItem> {
        let found = json::completion(&self.line, self.of, self.text, self.offset(asked));
        let Some(Completion { span, wanted, words }) = found else { return Vec::new() };
        let range = self.range(span);
        let words = words.into_iter().map(|word| {
            let (kind, behind) = match wanted {
                Wanted::Key { has_colon: false } => (CompletionItemKind::Property, ": "),
                Wanted::Key { has_colon: true } => (CompletionItemKind::Property, ""),
                Wanted::Value => (CompletionItemKind::Value, ""),
            };
            let new_text = format!("{}{behind}", word.value);
            CompletionItem {
                label: word.value.as_str().map_or_else(|| word.value.to_string(), str::to_string),
                kind: Some(kind),
                detail: Some(word.detail.to_string()).filter(|detail| !detail.is_empty()),
                documentation: Some(word.doc).filter(|doc| !doc.is_empty()).map(Into::into),
                filter_text: Some(word.value.to_string()),
                text_edit: Some(TextEdit { range, new_text }.into()),
                ..CompletionItem::default()
            }
        });
        words.collect()
    }
}

/// Where somebody asks.
pub struct Asked<'a> {
    pub documents: &'a Documents,
    pub folders: &'a [PathBuf],
    pub uri: &'a Uri,
    pub position: Position,
}

impl Questions {
    /// What was understood is not so any more.
    pub fn forget(&mut self) {
        self.known.clear();
    }

    /// The place in each line that has the file, the nearest first.
    fn at<'a>(&'a mut self, asked: &Asked<'a>, layouts: &mut Layouts) -> Vec<At<'a>> {
        let Some((path, document)) = asked.documents.get(asked.uri) else { return Vec::new() };
        let text = document.text.as_deref().unwrap_or_default();
        let roots = Root::all(path, text, layouts, asked.folders);
        self.learn(&roots);
        let specs = roots.iter().filter_map(|root| self.known.get(root)?.as_ref());
        specs.filter_map(|specs| at(specs, asked.documents, path, asked.position)).collect()
    }

    fn learn(&mut self, roots: &[Root]) {
        for root in roots {
            if !self.known.contains_key(root) {
                self.known.insert(root.clone(), root::specs(root));
            }
        }
    }

    pub fn hover(&mut self, asked: &Asked, layouts: &mut Layouts) -> Option<Hover> {
        let of_name = self.at(asked, layouts).iter().find_map(|at| {
            let (value, place) = hover(at.specs, at.span())?;
            Some((value, at.range(place)))
        });
        let (value, range) = of_name.or_else(|| {
            let open = OpenJson::of(asked, layouts)?;
            let (value, place) = json::hover(&open.line, open.of, open.text, open.offset(asked))?;
            Some((value, open.range(place)))
        })?;
        let contents = MarkupContent { kind: MarkupKind::Markdown, value };
        Some(Hover { contents: contents.into(), range: Some(range) })
    }

    /// None of what is declared in the library, which is in no file of this machine.
    pub fn definition(&mut self, asked: &Asked, layouts: &mut Layouts) -> Option<Location> {
        self.forget();
        let all = self.at(asked, layouts);
        all.iter().find_map(|at| at.files.location(at.specs.definition(at.span())?))
    }

    pub fn references(
        &mut self,
        asked: &Asked,
        layouts: &mut Layouts,
        and_declaration: bool,
    ) -> Vec<Location> {
        self.forget();
        let mut found = Vec::new();
        let mut known = HashSet::new();
        for at in self.at(asked, layouts) {
            let Some((declared, uses)) = at.specs.references(at.span()) else { continue };
            let spans = declared.filter(|_| and_declaration).into_iter().chain(uses);
            for location in spans.filter_map(|span| at.files.location(span)) {
                if known.insert(location.clone()) {
                    found.push(location);
                }
            }
        }
        found
    }

    /// The place and text of a name that can be renamed.
    pub fn renamed_at(&mut self, asked: &Asked, layouts: &mut Layouts) -> Result<(Range, String), String> {
        self.forget();
        let all = self.at(asked, layouts);
        let mut first = Err("there is no name here that can be renamed".to_string());
        for at in all.iter().rev() {
            let (_, place) = rename::renamed_at(at.specs, at.span())?;
            first = Ok((at.range(place), at.specs.sources.text(place).to_string()));
        }
        first
    }

    /// In all lines that have the file or one that is changed: if one of them refuses, nothing is renamed.
    pub fn rename(
        &mut self,
        asked: &Asked,
        layouts: &mut Layouts,
        name: &str,
    ) -> Result<WorkspaceEdit, String> {
        self.forget();
        let mut changes: HashMap<Uri, Vec<TextEdit>> = HashMap::new();
        let (mut known, mut searched) = (HashSet::new(), BTreeSet::new());
        let asked_in = asked.documents.get(asked.uri).map(|(path, _)| (path.to_path_buf(), asked.position));
        // Of each file of automata one place of the name.
        let mut places: Vec<(PathBuf, Position)> = asked_in.into_iter().collect();
        let (mut next, mut has_place) = (0, false);
        while let Some((path, position)) = places.get(next).cloned() {
            next += 1;
            let roots = roots_of_all(&path, asked, layouts)?;
            let new: Vec<Root> = roots.into_iter().filter(|root| searched.insert(root.clone())).collect();
            self.learn(&new);
            if let Some(layout) = new
                .iter()
                .filter(|root| self.known.get(*root).is_none_or(Option::is_none))
                .find_map(Root::layout)
            {
                return Err(format!(
                    "{} cannot be read with all that it names: correct that first",
                    layout.display()
                ));
            }
            let specs = new.iter().filter_map(|root| self.known.get(root)?.as_ref());
            for at in specs.filter_map(|specs| at(specs, asked.documents, &path, position)) {
                has_place = true;
                for (span, new_text) in rename::rename(at.specs, at.span(), name)? {
                    let location = at.files.location(span);
                    let location = location.ok_or("a file that has to be changed is not on this machine")?;
                    if let Some(changed) = &at.files.paths[span.file.0 as usize]
                        && changed.extension().is_some_and(|extension| extension == "aut")
                        && places.iter().all(|(place, _)| place != changed)
                    {
                        places.push((changed.clone(), location.range.start));
                    }
                    if known.insert(location.clone()) {
                        let edit = TextEdit { range: location.range, new_text };
                        changes.entry(location.uri).or_default().push(edit);
                    }
                }
            }
        }
        if !has_place {
            return Err("there is no name here that can be renamed".into());
        }
        Ok(WorkspaceEdit { changes: Some(changes), ..WorkspaceEdit::default() })
    }

    pub fn completion(&mut self, asked: &Asked, layouts: &mut Layouts) -> Vec<CompletionItem> {
        if let Some(open) = OpenJson::of(asked, layouts) {
            return open.completion(asked);
        }
        let all = self.at(asked, layouts);
        let Some(at) = all.first().filter(|at| at.specs.files.iter().any(|(file, _)| *file == at.file))
        else {
            return Vec::new();
        };
        let words = completion(at.specs, at.file, at.offset).into_iter();
        words
            .map(|word| CompletionItem {
                label: word.text,
                kind: Some(kind(word.what)),
                detail: Some(word.detail).filter(|detail| !detail.is_empty()),
                documentation: Some(word.doc).filter(|doc| !doc.is_empty()).map(Into::into),
                ..CompletionItem::default()
            })
            .collect()
    }
}

/// What a file belongs to; an error if that is more than is looked at.
fn roots_of_all(path: &Path, asked: &Asked, layouts: &mut Layouts) -> Result<Vec<Root>, String> {
    if layouts.are_too_many(path, asked.folders) {
        let file = path.file_name().unwrap_or_default().display();
        return Err(format!(
            "{file} belongs to more than {MOST_LAYOUTS} layouts, which is the limit: nothing is renamed"
        ));
    }
    let text = match asked.documents.at(path) {
        Some(document) => document.text.clone(),
        None => read::text(path).ok(),
    };
    Ok(Root::all(path, &text.unwrap_or_default(), layouts, asked.folders))
}

/// The sign beside a word.
fn kind(what: Option<What>) -> CompletionItemKind {
    match what {
        None => CompletionItemKind::Keyword,
        Some(What::Enumeration) => CompletionItemKind::Enum,
        Some(What::Member | What::State) => CompletionItemKind::EnumMember,
        Some(What::Interface) => CompletionItemKind::Interface,
        Some(What::Automaton | What::Device | What::Assembly | What::Primitive) => CompletionItemKind::Class,
        Some(What::Parameter | What::Constant | What::Key) => CompletionItemKind::Constant,
        Some(What::Cell | What::Port | What::Role | What::Part | What::Setting | What::Handover) => {
            CompletionItemKind::Field
        }
        Some(What::Local | What::Variable) => CompletionItemKind::Variable,
        Some(What::Define | What::DeviceDefine | What::Command | What::Wire) => CompletionItemKind::Function,
    }
}
