//! What is checked together: a layout with all that it names, or the automata of a folder that no layout names.

use super::layouts::{self, Layouts, Names};
use crate::load::{self, Failure};
use crate::{named, read};
use autogen::check;
use autogen::device::panel;
use autogen::diagnostic::Diagnostic;
use autogen::layout::{self, Layout, Panel};
use autogen::lower::{Input, compile};
use autogen::lsp::json;
use autogen::lsp::specs::{Specs, trees};
use autogen::source::{FileId, Sources};
use autogen::{interlock, library, lint, scenario, testing};
use serde_json::json;
use std::path::{Path, PathBuf};

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Root {
    Layout(PathBuf),
    /// A layout that cannot be read, with what it names nevertheless.
    Unread(PathBuf, Names),
    /// Its automata, without a layout.
    Folder(PathBuf),
    /// A scenario that no layout has.
    Scenario(PathBuf),
    /// A file of tests.
    Tests(PathBuf),
}

/// What was found.
#[derive(Debug, Default)]
pub struct Found {
    pub sources: Sources,
    pub diagnostics: Vec<Diagnostic>,
    /// Why nothing could be checked.
    pub refused: Option<String>,
}

impl Root {
    /// What an open file belongs to; nothing if it is none of autogen's.
    pub fn all(file: &Path, text: &str, known: &mut Layouts, folders: &[PathBuf]) -> Vec<Root> {
        let extension = file.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
        let layouts = |known: &mut Layouts, alone: Root| match known.naming(file, folders) {
            found if found.is_empty() => vec![alone],
            found => found.into_iter().map(Root::of).collect(),
        };
        match extension {
            "aut" => layouts(known, Root::Folder(file.parent().unwrap_or(file).into())),
            "test" => vec![Root::Tests(file.into())],
            "json" if known.is_layout(file, text) => vec![Root::of(known.open(file, text))],
            "json" if layouts::is_scenario(file) => layouts(known, Root::Scenario(file.into())),
            "json" => known.naming(file, folders).into_iter().map(Root::of).collect(),
            _ => Vec::new(),
        }
    }

    fn of((path, unread): layouts::Found) -> Root {
        match unread {
            Some(names) => Root::Unread(path, names),
            None => Root::Layout(path),
        }
    }

    pub fn layout(&self) -> Option<&Path> {
        match self {
            Root::Layout(path) | Root::Unread(path, _) => Some(path),
            Root::Folder(_) | Root::Scenario(_) | Root::Tests(_) => None,
        }
    }

    pub fn check(&self) -> Found {
        match self {
            Root::Layout(path) => layout(path),
            Root::Unread(path, names) => unread(path, names),
            Root::Folder(path) => folder(path),
            Root::Scenario(path) => one(path, |sources, file| scenario::parse(sources, file).1),
            Root::Tests(path) => one(path, |sources, file| {
                testing::read(file, &sources.file(file).text).err().unwrap_or_default()
            }),
        }
    }
}

fn layout(path: &Path) -> Found {
    let mut sources = Sources::default();
    match load::texts(&mut sources, path, &[], None) {
        Ok(load::Texts { layout, specs, scenario, .. }) => {
            let names = layout.0.as_ref().map(Layout::names);
            let input = Input { sources, layout, specs, scenario, settings: Vec::new(), order: None };
            let outcome = compile(input);
            let mut diagnostics = outcome.diagnostics;
            diagnostics.extend(outcome.warnings);
            if let (Some(names), Some(project)) = (&names, &outcome.project) {
                diagnostics.extend(interlock::warnings(names, project));
            }
            Found { sources: outcome.sources, diagnostics, refused: None }
        }
        Err(Failure::Refused(sources, diagnostics) | Failure::Wrong(sources, diagnostics)) => {
            Found { sources, diagnostics, refused: None }
        }
        Err(Failure::Unreadable(why) | Failure::Unfit(why)) => {
            Found { refused: Some(why), ..Found::default() }
        }
    }
}

/// What is wrong with the text of a layout, and with what it names, as far as that does not depend on the layout.
fn unread(path: &Path, names: &Names) -> Found {
    let Some(text) = read::text(path).ok().filter(|text| load::begins_as_object(text)) else {
        return layout(path);
    };
    let mut sources = Sources::default();
    let file = sources.add(path.display().to_string(), text.as_str());
    let mut diagnostics = layout::parse(&sources, file).1;
    let Some(texts) = texts_named(&mut sources, path, names) else {
        let mut sources = Sources::default();
        sources.add(path.display().to_string(), text);
        return Found { sources, diagnostics, refused: None };
    };
    let kinds = scenario::kinds(&sources, texts.scenario);
    diagnostics.extend(scenario::parse(&sources, texts.scenario).1);
    diagnostics.extend(of_automata(&sources, &texts.specs, kinds.as_deref(), names.panel));
    Found { sources, diagnostics, refused: None }
}

fn one(path: &Path, check: impl Fn(&Sources, FileId) -> Vec<Diagnostic>) -> Found {
    match read::text(path) {
        Ok(text) => {
            let mut sources = Sources::default();
            let file = sources.add(path.display().to_string(), text);
            let diagnostics = check(&sources, file);
            Found { sources, diagnostics, refused: None }
        }
        Err(why) => Found { refused: Some(why.to_string()), ..Found::default() },
    }
}

/// The texts of the library, then those of a folder, and the kinds of part of its scenario if they can be read.
type OfFolder = (Sources, Vec<FileId>, Option<Vec<String>>);

fn texts(folder: &Path) -> Result<OfFolder, String> {
    let mut sources = Sources::default();
    let mut files = of_library(&mut sources);
    for path in named::automata(folder).map_err(|why| why.to_string())? {
        let file = load::add(&mut sources, &path);
        files.push(file.map_err(|_| format!("{}: this file cannot be read", path.display()))?);
    }
    let own = load::add(&mut sources, &folder.join(layouts::SCENARIO)).ok();
    let file = own.unwrap_or_else(|| sources.add(scenario::BUILT_IN, scenario::DEFAULT));
    let kinds = scenario::kinds(&sources, file);
    Ok((sources, files, kinds))
}

/// What the names of a root mean; none of one that has no automata, or cannot be read.
pub fn specs(root: &Root) -> Option<Specs> {
    match root {
        Root::Layout(path) => {
            let mut sources = Sources::default();
            let texts = load::texts(&mut sources, path, &[], None).ok()?;
            let kinds = scenario::kinds(&sources, texts.scenario);
            Some(Specs::new(sources, &texts.specs, texts.layout.0, kinds))
        }
        Root::Unread(path, names) => {
            let mut sources = Sources::default();
            let layout = load::add(&mut sources, path).ok()?;
            let texts = texts_named(&mut sources, path, names)?;
            let kinds = scenario::kinds(&sources, texts.scenario);
            let specs = Specs::new(sources, &texts.specs, None, kinds);
            Some(Specs { unread: Some(layout), ..specs })
        }
        Root::Folder(path) => {
            let (sources, files, kinds) = texts(path).ok()?;
            Some(Specs::new(sources, &files, None, kinds))
        }
        Root::Scenario(_) | Root::Tests(_) => None,
    }
}

/// What is known of the line to which a layout or a scenario belongs, however wrong its texts are just now.
pub fn line(root: &Root) -> Option<json::Line> {
    let path = match root {
        Root::Layout(path) | Root::Unread(path, _) | Root::Scenario(path) => path,
        Root::Folder(_) | Root::Tests(_) => return None,
    };
    let text = read::text(path).ok()?;
    let tree = json::parse(&text);
    let mut sources = Sources::default();
    let names = match root {
        Root::Unread(_, names) => names.clone(),
        _ => layouts::understood(&tree),
    };
    let (specs, kinds) = match root {
        Root::Scenario(_) => (of_library(&mut sources), json::kinds(&tree)),
        _ => match texts_named(&mut sources, path, &names) {
            Some(texts) => {
                let kinds = json::kinds(&json::parse(&sources.file(texts.scenario).text));
                (texts.specs, kinds)
            }
            None => (of_library(&mut sources), Vec::new()),
        },
    };
    let (mut trees, _) = trees(&sources, &specs);
    if names.panel == Panel::Machines {
        panel::add(&mut trees);
    }
    let automata = trees.iter().flat_map(|(_, file)| &file.automata);
    let declared = automata.map(|automaton| automaton.name.value.clone()).collect();
    let known = (!kinds.is_empty()).then_some(kinds.as_slice());
    let checked = check::check(&sources, &trees, known).or_else(|_| {
        trees.truncate(library::FILES.len());
        check::check(&sources, &trees, known)
    });
    let model = checked.ok()?.into_model();
    Some(json::Line { model, declared, kinds, things: json::things(&tree) })
}

fn of_library(sources: &mut Sources) -> Vec<FileId> {
    library::FILES.iter().map(|(name, text)| sources.add(*name, *text)).collect()
}

/// The other texts of a layout that names these.
fn texts_named(sources: &mut Sources, path: &Path, names: &Names) -> Option<load::Texts> {
    let mut named = json!({"robots": [], "specs": names.specs});
    if let Some(scenario) = &names.scenario {
        named["scenario"] = scenario.as_str().into();
    }
    let file = sources.add("the names of a layout", named.to_string());
    load::texts_of(sources, path, file, &[], None).ok()
}

fn folder(path: &Path) -> Found {
    let (sources, files, kinds) = match texts(path) {
        Ok(texts) => texts,
        Err(why) => return Found { refused: Some(why), ..Found::default() },
    };
    let diagnostics = of_automata(&sources, &files, kinds.as_deref(), Panel::Line);
    Found { sources, diagnostics, refused: None }
}

fn of_automata(
    sources: &Sources,
    files: &[FileId],
    kinds: Option<&[String]>,
    panel: Panel,
) -> Vec<Diagnostic> {
    let (trees, unread) = trees(sources, files);
    if !unread.is_empty() {
        return unread;
    }
    match check::check(sources, &trees, kinds) {
        Ok(checked) => lint::warnings(&checked, &trees, panel),
        Err(found) => found,
    }
}
