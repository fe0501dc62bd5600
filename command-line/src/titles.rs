//! The names under which outputs show inputs and have copies of them. All systems take them, and a build of the
//! copies gives them again.

use autogen::library;
use autogen::source::Sources;
use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};

/// The sources under the names that outputs show, all of them different.
pub fn shown(sources: &Sources, layout: &Path) -> Sources {
    let mut taken = BTreeSet::new();
    sources.renamed(|name| {
        let title = title(layout, name);
        if name == "--set" {
            return title;
        }
        apart(title, &mut taken)
    })
}

/// A name that is free: the wanted one, or one with a number before its extension. Some file systems take names that
/// differ in case alone for one, and so does this.
pub fn apart(wanted: String, taken: &mut BTreeSet<String>) -> String {
    let (stem, extension) = match wanted.rsplit_once('.') {
        Some((stem, extension)) if !extension.contains('/') => (stem, format!(".{extension}")),
        _ => (wanted.as_str(), String::new()),
    };
    let numbered = (2..).map(|number| format!("{stem} ({number}){extension}"));
    std::iter::once(wanted.clone())
        .chain(numbered)
        .find(|name| taken.insert(name.to_lowercase()))
        .unwrap_or(wanted)
}

/// The name of an input as outputs show it: its path from the layout's folder, or its own name.
pub fn title(layout: &Path, name: &str) -> String {
    if library::FILES.iter().any(|(built_in, _)| *built_in == name) {
        return name.to_string();
    }
    match within(layout, name) {
        Some(path) => {
            let parts = path.components().map(|part| portable(&part.as_os_str().to_string_lossy()));
            parts.collect::<Vec<_>>().join("/")
        }
        None => portable(&Path::new(name).file_name().unwrap_or(name.as_ref()).to_string_lossy()),
    }
}

/// Whether a copy of a file that the layout names is where a copy of the layout looks for it.
pub fn is_found(layout: &Path, name: &str, copy: &str) -> bool {
    // Signs that stand for other characters make a name that is not that on the disk.
    within(layout, name).is_some_and(|path| path == Path::new(copy)) && Path::new(name).exists()
}

/// The path of an input from the layout's folder, if it leads straight down.
fn within(layout: &Path, name: &str) -> Option<PathBuf> {
    let folder = without_dots(layout.parent()?);
    let path = without_dots(Path::new(name));
    let rest = path.strip_prefix(folder).ok()?;
    rest.components().all(|part| matches!(part, Component::Normal(_))).then(|| rest.into())
}

fn without_dots(path: &Path) -> PathBuf {
    path.components().filter(|part| *part != Component::CurDir).collect()
}

/// A part of a path with a sign in the place of each character that separates paths or is in no name on some system.
fn portable(part: &str) -> String {
    part.replace(['\\', ':', '*', '?', '"', '<', '>', '|'], "_")
}
