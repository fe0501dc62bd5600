//! The output folder: written whole or not at all, by one process at a time, and never over a file that is
//! somebody else's.

mod manifest;
mod present;
mod transaction;

pub use manifest::{MANIFEST, hash, is_within};

use super::lock::Lock;
use autogen::backend::Files;
use manifest::Manifest;
use present::{Present, obstacles, present};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use transaction::{Change, NewText};

/// Written by `commission` beside the files of a build.
pub const RESULTS: &str = "results.json";
pub const REPORT: &str = "report.html";
/// What holds for the controllers in the folder alone.
pub const OF_A_RUN: [&str; 2] = [RESULTS, REPORT];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overwrite {
    /// Only files that autogen wrote and nobody changed since.
    Own,
    Everything,
}

#[derive(Debug)]
pub enum Refusal {
    /// These would be overwritten.
    NotOurs(Vec<PathBuf>),
    /// Symbolic links, files where folders have to be, or folders where files have to be.
    InTheWay(Vec<PathBuf>),
    /// Files that were read would be overwritten.
    Inputs(Vec<PathBuf>),
    Io(PathBuf, io::Error),
}

/// A folder that no other process writes to.
#[derive(Debug)]
pub struct Output {
    folder: PathBuf,
    /// Files that nothing is to happen to, without symbolic links.
    inputs: Vec<PathBuf>,
    is_new: bool,
    _lock: Lock,
}

impl Output {
    /// Makes the folder if there is none. What an interrupted process has left half written is undone first.
    /// Nothing happens to `inputs`, which are canonical paths. `waits` is called once if another process has the
    /// folder.
    pub fn open(folder: &Path, inputs: Vec<PathBuf>, waits: impl Fn()) -> Result<Self, Refusal> {
        if folder.symlink_metadata().is_ok() && !folder.is_dir() {
            return Err(Refusal::InTheWay(vec![folder.into()]));
        }
        let failed = |e: io::Error| Refusal::Io(folder.into(), e);
        let is_new = !folder.is_dir();
        let lock = loop {
            fs::create_dir_all(folder).map_err(failed)?;
            let lock = Lock::folder(folder, &waits).map_err(failed)?;
            if lock.is_on(folder) {
                break lock;
            }
        };
        let output = Self { folder: folder.into(), inputs, is_new, _lock: lock };
        transaction::recover(folder, &output.inputs)?;
        Ok(output)
    }

    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// The command that built what is there; none if there is nothing.
    pub fn last_command(&self) -> Option<String> {
        Some(Manifest::read(&self.folder).about.get("command")?.as_str()?.into())
    }

    /// Writes the files and a manifest of them, with `about` first in it, and removes those of the last time that
    /// are no more. Results stay only where nothing else changes: they are those of other controllers.
    pub fn write(
        &self,
        files: &Files,
        about: Map<String, Value>,
        overwrite: Overwrite,
    ) -> Result<(), Refusal> {
        let before = Manifest::read(&self.folder);
        let after = after(files, about, &before);
        self.replace(files, &before, after, overwrite)
    }

    /// Writes what has come of the controllers that are in the folder: files of [`OF_A_RUN`]. Those of the last run that
    /// are not among them go.
    pub fn write_results(&self, files: &Files, overwrite: Overwrite) -> Result<(), Refusal> {
        let before = Manifest::read(&self.folder);
        let mut hashes = before.files.clone();
        hashes.retain(|name, _| !OF_A_RUN.contains(&name.as_str()));
        hashes.extend(files.iter().map(|(name, text)| (name.clone(), hash(text.as_bytes()))));
        self.replace(files, &before, Manifest::new(before.about.clone(), hashes), overwrite)
    }

    /// Whether these may be written: a run may be long, and it is better to know before it.
    pub fn may_write_results(&self, names: &[&str], overwrite: Overwrite) -> Result<(), Refusal> {
        let before = Manifest::read(&self.folder);
        let names: Vec<String> = names.iter().map(|name| name.to_string()).collect();
        let found = obstacles(&self.folder, names.iter());
        if !found.is_empty() {
            return Err(Refusal::InTheWay(found));
        }
        let mut foreign = Vec::new();
        for name in &names {
            let present = present(&self.folder, name)?;
            if present != Present::Nothing && !present.is(before.files.get(name).map(String::as_str)) {
                foreign.push(self.folder.join(name));
            }
        }
        match overwrite {
            Overwrite::Own if !foreign.is_empty() => Err(Refusal::NotOurs(foreign)),
            _ => Ok(()),
        }
    }

    /// Writes those of `files` that are not there yet and the new manifest, and removes what it no longer has.
    fn replace(
        &self,
        files: &Files,
        before: &Manifest,
        after: Manifest,
        overwrite: Overwrite,
    ) -> Result<(), Refusal> {
        let manifest = after.to_text();
        let manifest_hash = hash(manifest.as_bytes());
        let manifest_name = MANIFEST.to_string();
        let texts = files.iter().map(|(name, text)| (name, NewText { text, hash: &after.files[name] }));
        let own = (&manifest_name, NewText { text: &manifest, hash: &manifest_hash });
        let texts: Vec<(&String, NewText)> = texts.chain([own]).collect();
        let found = obstacles(&self.folder, texts.iter().map(|(name, _)| *name).chain(before.files.keys()));
        if !found.is_empty() {
            return Err(Refusal::InTheWay(found));
        }
        let mut foreign = Vec::new();
        let mut changes = Vec::new();
        for name in before.files.keys().filter(|name| !after.files.contains_key(*name)) {
            if present(&self.folder, name)?.is(before.files.get(name).map(String::as_str)) {
                changes.push(Change { name, existed: true, text: None });
            }
        }
        for (name, text) in texts {
            let there = present(&self.folder, name)?;
            if there.is(Some(text.hash)) {
                continue;
            }
            let is_own = match name == MANIFEST {
                true => before.is_whole,
                false => there.is(before.files.get(name).map(String::as_str)),
            };
            if there != Present::Nothing && !is_own {
                foreign.push(self.folder.join(name));
            }
            let existed = there != Present::Nothing;
            changes.push(Change { name, existed, text: Some(text) });
        }
        if overwrite == Overwrite::Own && !foreign.is_empty() {
            return Err(Refusal::NotOurs(foreign));
        }
        let inputs = among(&self.inputs, changes.iter().map(|change| self.folder.join(change.name)));
        if !inputs.is_empty() {
            return Err(Refusal::Inputs(inputs));
        }
        transaction::apply(&self.folder, &changes)
    }
}

/// The manifest that a build writes over another one.
fn after(files: &Files, about: Map<String, Value>, before: &Manifest) -> Manifest {
    let mut hashes: BTreeMap<String, String> =
        files.iter().map(|(name, text)| (name.clone(), hash(text.as_bytes()))).collect();
    let same = |name: &String, hash: &String| before.files.get(name) == Some(hash);
    if about == before.about && hashes.iter().all(|(name, hash)| same(name, hash)) {
        let kept = OF_A_RUN.iter().filter_map(|name| before.files.get_key_value(*name));
        hashes.extend(kept.map(|(name, hash)| (name.clone(), hash.clone())));
    }
    Manifest::new(about, hashes)
}

/// A file of a folder that a build would change.
#[derive(Debug, PartialEq, Eq)]
pub struct Difference {
    pub name: String,
    pub kind: Kind,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    Missing,
    /// With the text that would be written.
    Changed(String),
    /// A build would remove it.
    Left,
}

/// What [`Output::write`] would change in a folder, which may be one that cannot be written to. Its manifest
/// stands last.
pub fn differences(
    folder: &Path,
    files: &Files,
    about: Map<String, Value>,
) -> Result<Vec<Difference>, Refusal> {
    let before = Manifest::read(folder);
    let after = after(files, about, &before);
    let manifest = (MANIFEST.to_string(), after.to_text());
    let all = || files.iter().chain([(&manifest.0, &manifest.1)]);
    let found = obstacles(folder, all().map(|(name, _)| name).chain(before.files.keys()));
    if !found.is_empty() {
        return Err(Refusal::InTheWay(found));
    }
    let mut differences = Vec::new();
    for (name, text) in files.iter() {
        differences.extend(difference(folder, name, text)?);
    }
    for name in before.files.keys().filter(|name| !after.files.contains_key(*name)) {
        if present(folder, name)?.is(before.files.get(name).map(String::as_str)) {
            differences.push(Difference { name: name.clone(), kind: Kind::Left });
        }
    }
    differences.sort_by(|a, b| a.name.cmp(&b.name));
    differences.extend(difference(folder, &manifest.0, &manifest.1)?);
    Ok(differences)
}

fn difference(folder: &Path, name: &str, text: &str) -> Result<Option<Difference>, Refusal> {
    let kind = match present(folder, name)? {
        Present::Nothing => Kind::Missing,
        there if there.is(Some(&hash(text.as_bytes()))) => return Ok(None),
        Present::File(_) => Kind::Changed(text.into()),
    };
    Ok(Some(Difference { name: name.into(), kind }))
}

/// Those of the paths that are one of `inputs`.
fn among(inputs: &[PathBuf], paths: impl Iterator<Item = PathBuf>) -> Vec<PathBuf> {
    paths.filter(|path| path.canonicalize().is_ok_and(|path| inputs.contains(&path))).collect()
}

impl Drop for Output {
    fn drop(&mut self) {
        if self.is_new {
            // It goes only if it is empty.
            let _ = fs::remove_dir(&self.folder);
        }
    }
}

#[cfg(test)]
mod tests;
