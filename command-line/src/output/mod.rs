//! The output folder: written whole or not at all, by one process at a time, and never over a file that is
//! somebody else's.

mod comparison;
mod manifest;
mod new_files;
mod present;
mod transaction;

pub use comparison::{Comparison, Difference, Kind, compare};
pub use manifest::{MANIFEST, hash};

use super::lock::Lock;
use autogen::backend::{Files, Sink};
use manifest::Manifest;
pub use new_files::Make;
use present::{Present, obstacles, present};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

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
    /// The folder has what this command has built from another layout.
    OfAnotherLayout(PathBuf, String),
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

    /// Files of [`OF_A_RUN`] that are there.
    pub fn of_a_run(&self) -> Vec<&'static str> {
        OF_A_RUN.into_iter().filter(|name| self.folder.join(name).is_file()).collect()
    }

    /// The command that built what is there; none if there is nothing.
    pub fn last_command(&self) -> Option<String> {
        Some(Manifest::read(&self.folder).about.get("command")?.as_str()?.into())
    }

    /// Refuses a folder that was built from a layout file of another name.
    pub fn is_of_layout(&self, name: &str) -> Result<(), Refusal> {
        let about = Manifest::read(&self.folder).about;
        let was_read = about.get("inputs").and_then(Value::as_object).map(|inputs| inputs.contains_key(name));
        match (was_read, self.last_command()) {
            (Some(false), Some(command)) => Err(Refusal::OfAnotherLayout(self.folder.clone(), command)),
            _ => Ok(()),
        }
    }

    /// Writes the files that all of `make` give, at the same time, and a manifest of them, with `about` first in it, and removes
    /// those of the last time that are no more. Results stay only where nothing else changes: they are those of other controllers.
    /// Returns the names of the files.
    pub fn write(
        &self,
        make: &[&Make],
        about: Map<String, Value>,
        overwrite: Overwrite,
    ) -> Result<Vec<String>, Refusal> {
        let before = Manifest::read(&self.folder);
        let new = new_files::staged(&self.folder, before.clone(), make);
        let hashes = new.hashes().clone();
        let names = hashes.keys().cloned().collect();
        new.replace(&after(hashes, about, &before), &self.inputs, overwrite)?;
        Ok(names)
    }

    /// Writes what has come of the controllers that are in the folder: files of [`OF_A_RUN`]. Those of the last run that
    /// are not among them go.
    pub fn write_results(&self, files: &Files, overwrite: Overwrite) -> Result<(), Refusal> {
        let before = Manifest::read(&self.folder);
        let make = |sink: &mut dyn Sink| files.iter().for_each(|(name, text)| sink.file(name, text));
        let new = new_files::staged(&self.folder, before.clone(), &[&make]);
        let mut hashes = before.files.clone();
        hashes.retain(|name, _| !OF_A_RUN.contains(&name.as_str()));
        hashes.extend(new.hashes().clone());
        let after = Manifest::new(before.about.clone(), hashes);
        new.replace(&after, &self.inputs, overwrite)
    }

    /// Whether these of [`OF_A_RUN`] may be written, and the others removed: a run may be long, and it is better to know
    /// before it.
    pub fn may_write_results(&self, names: &[&str], overwrite: Overwrite) -> Result<(), Refusal> {
        let before = Manifest::read(&self.folder);
        let found = obstacles(&self.folder, names.iter().copied());
        if !found.is_empty() {
            return Err(Refusal::InTheWay(found));
        }
        let mut foreign = Vec::new();
        for name in OF_A_RUN {
            let present = present(&self.folder, name)?;
            let last = before.files.get(name).map(String::as_str);
            let concerns = names.contains(&name) || last.is_some();
            if concerns && present != Present::Nothing && !present.is(last) {
                foreign.push(self.folder.join(name));
            }
        }
        match overwrite {
            Overwrite::Own if !foreign.is_empty() => Err(Refusal::NotOurs(foreign)),
            _ => Ok(()),
        }
    }
}

/// The manifest that a build writes over another one.
fn after(mut hashes: BTreeMap<String, String>, about: Map<String, Value>, before: &Manifest) -> Manifest {
    let same = |name: &String, hash: &String| before.files.get(name) == Some(hash);
    if about == before.about && hashes.iter().all(|(name, hash)| same(name, hash)) {
        let kept = OF_A_RUN.iter().filter_map(|name| before.files.get_key_value(*name));
        hashes.extend(kept.map(|(name, hash)| (name.clone(), hash.clone())));
    }
    Manifest::new(about, hashes)
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
