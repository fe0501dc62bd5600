//! The layouts that a file belongs to: they stand in its folder or above it, since a layout names nothing outside
//! of its own folder.

use crate::read;
use autogen::layout::{self, Panel};
use autogen::lsp::json::{self, Member, Node};
use autogen::source::Sources;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// Folders above that of a file in which its layouts are looked for, at most to that of the workspace.
const MOST_ABOVE: usize = 4;
/// JSON files of one folder that are read.
const MOST_FILES: usize = 200;
/// Bytes of all files that are read for one question.
const MOST_BYTES: usize = 20_000_000;
/// Layouts of one file.
pub const MOST_LAYOUTS: usize = 16;
/// Names of automata of one layout.
const MOST_SPECS: usize = 1000;
/// The scenario of a layout that names none.
pub const SCENARIO: &str = "scenario.json";

/// What files of JSON name, as it was when they were read last.
#[derive(Debug, Default)]
pub struct Layouts {
    known: HashMap<PathBuf, (Version, Option<Named>)>,
    /// Of layouts that are open, when their texts could be read last.
    last: HashMap<PathBuf, Names>,
}

/// A layout, and what it names if its text cannot be read.
pub type Found = (PathBuf, Option<Names>);

/// What a layout names, in its own words.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Names {
    pub specs: Vec<String>,
    pub scenario: Option<String>,
    pub panel: Panel,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Version {
    changed: Option<SystemTime>,
    bytes: u64,
}

/// What a layout names, by real paths.
#[derive(Clone, Debug)]
struct Named {
    specs: Vec<PathBuf>,
    scenario: Option<PathBuf>,
    unread: Option<Names>,
}

impl Layouts {
    /// The layouts that name a file or its folder, in the order of their names, the nearest folder first. `folders` are
    /// those of the workspace.
    pub fn naming(&mut self, file: &Path, folders: &[PathBuf]) -> Vec<Found> {
        self.first_naming(file, folders, MOST_LAYOUTS)
    }

    /// Whether there are more than [`Self::naming`] gives.
    pub fn are_too_many(&mut self, file: &Path, folders: &[PathBuf]) -> bool {
        self.first_naming(file, folders, MOST_LAYOUTS + 1).len() > MOST_LAYOUTS
    }

    fn first_naming(&mut self, file: &Path, folders: &[PathBuf], most: usize) -> Vec<Found> {
        let mut found = Vec::new();
        let mut left = MOST_BYTES;
        for folder in above(file, folders) {
            for path in json_files(folder) {
                let named = self.named(&path, &mut left);
                let names = |named: &Named| {
                    let is_spec =
                        named.specs.iter().any(|spec| spec == file || Some(&**spec) == file.parent());
                    is_spec || named.scenario.as_deref() == Some(file)
                };
                if let Some(named) = named.filter(names) {
                    found.push((path, named.unread));
                }
                if found.len() == most {
                    return found;
                }
            }
        }
        found
    }

    fn named(&mut self, path: &Path, left: &mut usize) -> Option<Named> {
        if read::opened(path).is_some() {
            let text = read::text(path).ok()?;
            let names = self.is_layout(path, &text).then(|| self.open_names(path, &text))?;
            return of_names(path, names);
        }
        let data = path.metadata().ok()?;
        let version = Version { changed: data.modified().ok(), bytes: data.len() };
        if let Some((known, named)) = self.known.get(path)
            && *known == version
        {
            return named.clone();
        }
        let text =
            Some(()).filter(|()| version.bytes <= *left as u64).and_then(|()| read::text(path).ok())?;
        *left = left.saturating_sub(text.len());
        let names = is_layout(&text).then(|| names(path, &text));
        let named = names.and_then(|names| of_names(path, names));
        self.known.insert(path.into(), (version, named.clone()));
        named
    }

    /// Whether an open file is a layout, or was one before its text was changed.
    pub fn is_layout(&self, path: &Path, text: &str) -> bool {
        self.last.contains_key(path) || is_layout(text)
    }

    /// A layout that is open.
    pub fn open(&mut self, path: &Path, text: &str) -> Found {
        let names = self.open_names(path, text);
        (path.into(), names.err())
    }

    fn open_names(&mut self, path: &Path, text: &str) -> Result<Names, Names> {
        match names(path, text) {
            Ok(names) => {
                self.last.insert(path.into(), names.clone());
                Ok(names)
            }
            Err(understood) => Err(self.last.get(path).cloned().unwrap_or(understood)),
        }
    }

    /// The text on the disk counts again.
    pub fn close(&mut self, path: &Path) {
        self.last.remove(path);
    }
}

/// The folder of a file and those above it.
fn above<'p>(file: &'p Path, folders: &[PathBuf]) -> Vec<&'p Path> {
    let mut found: Vec<&Path> = Vec::new();
    for folder in file.ancestors().skip(1) {
        found.push(folder);
        if found.len() > MOST_ABOVE || folders.iter().any(|root| root == folder) {
            return found;
        }
    }
    found
}

fn json_files(folder: &Path) -> Vec<PathBuf> {
    let is_json = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "json");
    let mut files = read::open_in(folder);
    files.retain(is_json);
    let entries = folder.read_dir().into_iter().flatten().flatten().map(|entry| entry.path());
    files.extend(entries.filter(is_json).take(MOST_FILES).filter(|path| path.is_file()));
    files.sort();
    files.dedup();
    files
}

/// Whether a text is meant as a layout, be it right or not.
pub fn is_layout(text: &str) -> bool {
    let names_specs = || text.contains("\"specs\"") && json::parse(text).get("specs").is_some();
    text.contains("\"robots\"") || text.contains("\"stationary\"") || names_specs()
}

/// Whether a text may be the beginning of a layout: all its keys begin as those of a layout.
pub fn is_begun(text: &str) -> bool {
    let tree = json::parse(text);
    let keys = || layout::KEYS.into_iter().chain(["$schema"]);
    let is_known = |member: &Member| keys().any(|key| key.starts_with(&member.name));
    text.trim_start().starts_with('{') && tree.members().iter().all(is_known)
}

/// Whether a file is meant as a scenario.
pub fn is_scenario(path: &Path) -> bool {
    path.file_name().and_then(|name| name.to_str()).is_some_and(|name| name.ends_with(SCENARIO))
}

/// What a layout names; as an error what can be understood of a text that cannot be read.
fn names(path: &Path, text: &str) -> Result<Names, Names> {
    let mut sources = Sources::default();
    let file = sources.add(path.display().to_string(), text);
    let Some(layout) = layout::parse(&sources, file).0 else {
        return Err(understood(&json::parse(text)));
    };
    Ok(Names {
        specs: layout.specs.into_iter().map(|spec| spec.value).collect(),
        scenario: layout.scenario.map(|scenario| scenario.value),
        panel: layout.panel,
    })
}

pub fn understood(layout: &Node) -> Names {
    let specs = layout.get("specs");
    let specs = specs.into_iter().flat_map(|specs| specs.items().iter().chain([specs]));
    let text = |key| layout.get(key).and_then(Node::text);
    let panel = Panel::ALL.into_iter().find(|(word, _)| Some(*word) == text("panel"));
    Names {
        specs: specs.filter_map(Node::text).map(String::from).collect(),
        scenario: text("scenario").map(String::from),
        panel: panel.map_or_else(Panel::default, |(_, panel)| panel),
    }
}

fn of_names(path: &Path, names: Result<Names, Names>) -> Option<Named> {
    let unread = names.as_ref().err().cloned();
    let (Ok(names) | Err(names)) = names;
    let folder = path.parent()?;
    let real = |name: &str| read::real(&folder.join(name));
    Some(Named {
        specs: names.specs.iter().take(MOST_SPECS).filter_map(|spec| real(spec)).collect(),
        scenario: real(names.scenario.as_deref().unwrap_or(SCENARIO)),
        unread,
    })
}
