//! The layouts that a file belongs to: they stand in its folder or above it, since a layout names nothing outside
//! of its own folder.

use crate::read;
use autogen::layout;
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
const MOST_LAYOUTS: usize = 16;
/// Names of automata of one layout.
const MOST_SPECS: usize = 1000;
/// The scenario of a layout that names none.
pub const SCENARIO: &str = "scenario.json";

/// What files of JSON name, as it was when they were read last.
#[derive(Debug, Default)]
pub struct Layouts {
    known: HashMap<PathBuf, (Version, Option<Named>)>,
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
}

impl Layouts {
    /// The layouts that name a file or its folder, in the order of their names, the nearest folder first. `folders` are
    /// those of the workspace.
    pub fn naming(&mut self, file: &Path, folders: &[PathBuf]) -> Vec<PathBuf> {
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
                if named.is_some_and(|named| names(&named)) {
                    found.push(path);
                }
                if found.len() == MOST_LAYOUTS {
                    return found;
                }
            }
        }
        found
    }

    fn named(&mut self, path: &Path, left: &mut usize) -> Option<Named> {
        if read::opened(path).is_some() {
            return of_text(path, &read::text(path).ok()?);
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
        let named = of_text(path, &text);
        self.known.insert(path.into(), (version, named.clone()));
        named
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
    text.contains("\"robots\"") || text.contains("\"stationary\"")
}

/// Whether a file is meant as a scenario.
pub fn is_scenario(path: &Path) -> bool {
    path.file_name().and_then(|name| name.to_str()).is_some_and(|name| name.ends_with(SCENARIO))
}

fn of_text(path: &Path, text: &str) -> Option<Named> {
    if !is_layout(text) {
        return None;
    }
    let mut sources = Sources::default();
    let file = sources.add(path.display().to_string(), text);
    let layout = layout::parse(&sources, file).0?;
    let folder = path.parent()?;
    let real = |name: &str| read::real(&folder.join(name));
    let scenario = layout.scenario.as_ref().map_or(SCENARIO, |scenario| &scenario.value);
    Some(Named {
        specs: layout.specs.iter().take(MOST_SPECS).filter_map(|spec| real(&spec.value)).collect(),
        scenario: real(scenario),
    })
}
