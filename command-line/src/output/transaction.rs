//! Several files changed at once.
//!
//! The new files wait in a folder within the output folder until all of them are on the disk. A journal says what
//! will be done. Then each old file goes into that folder and the new one takes its place. When the journal is
//! removed, the new output holds; as long as it is there, the old one does, and whoever opens the folder next
//! restores it. An error restores it at once.

use super::manifest::is_within;
use super::present::{self, Present, obstacles, present};
use super::{Refusal, among};
use crate::interrupt::{self, Temporary};
use serde_json::{Value, json};
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// The folder of what is not finished. Whoever sees it knows that the rest may be half.
const UNFINISHED: &str = "autogen-unfinished";
const JOURNAL: &str = "journal.json";
/// The journal while it is written.
const DRAFT: &str = "journal";
/// The folders of the files before and after.
const OLD: &str = "old";
const NEW: &str = "new";

/// What happens to a file.
#[derive(Clone, Debug)]
pub struct Change {
    pub name: String,
    pub existed: bool,
    /// Of the new file; `None` removes it.
    pub hash: Option<String>,
}

/// The folder of a transaction in which nothing has been done yet. It goes when this is dropped.
pub fn begin(folder: &Path) -> Temporary {
    Temporary::new(folder.join(UNFINISHED))
}

/// Where a new file waits.
pub fn waiting(staged: &Temporary, name: &str) -> PathBuf {
    staged.path().join(NEW).join(name)
}

/// Makes all changes, or none. The new files wait.
pub fn apply(folder: &Path, staged: Temporary, changes: &[Change]) -> Result<(), Refusal> {
    if changes.is_empty() {
        return Ok(());
    }
    let done = stage(folder, staged.path(), changes).and_then(|()| {
        let _writing = interrupt::writing();
        exchange(folder, staged.path(), changes)
    });
    if done.is_err() && staged.path().join(JOURNAL).exists() {
        let _writing = interrupt::writing();
        if let Err(error) = undo(folder, staged.path(), &[]) {
            // The next process tries again.
            staged.leave();
            return Err(error);
        }
    }
    if done.is_err() {
        remove_empty(folder, changes.iter().filter(|c| !c.existed).map(|c| c.name.as_str()));
    }
    done
}

/// Undoes what a process has begun that is no more.
pub fn recover(folder: &Path, inputs: &[PathBuf]) -> Result<(), Refusal> {
    let unfinished = folder.join(UNFINISHED);
    match unfinished.symlink_metadata() {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        Err(error) => return Err(Refusal::Io(unfinished, error)),
        Ok(there) if !there.is_dir() => return Err(Refusal::InTheWay(vec![unfinished])),
        Ok(_) => {}
    }
    let below: Vec<PathBuf> = match unfinished.canonicalize() {
        Ok(unfinished) => inputs.iter().filter(|input| input.starts_with(&unfinished)).cloned().collect(),
        Err(error) => return Err(Refusal::Io(unfinished, error)),
    };
    if !below.is_empty() {
        return Err(Refusal::Inputs(below));
    }
    let strange = strangers(&unfinished)?;
    if !strange.is_empty() {
        return Err(Refusal::InTheWay(strange));
    }
    let _writing = interrupt::writing();
    if unfinished.join(JOURNAL).symlink_metadata().is_ok() {
        undo(folder, &unfinished, inputs)?;
    }
    fs::remove_dir_all(&unfinished).map_err(|e| Refusal::Io(unfinished, e))
}

/// What is in the folder of what is not finished and was not put there by [`stage`].
fn strangers(unfinished: &Path) -> Result<Vec<PathBuf>, Refusal> {
    let failed = |e: io::Error| Refusal::Io(unfinished.into(), e);
    let mut found = Vec::new();
    for entry in fs::read_dir(unfinished).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        if ![OLD, NEW, DRAFT, JOURNAL].iter().any(|own| entry.file_name() == *own) {
            found.push(entry.path());
        }
    }
    Ok(found)
}

/// Makes sure that the new files are on the disk, and puts the journal there.
fn stage(folder: &Path, staged: &Path, changes: &[Change]) -> Result<(), Refusal> {
    create(staged)?;
    let mut journal = Vec::new();
    for Change { name, existed, hash } in changes {
        journal.push(json!({ "name": name, "existed": existed, "hash": hash }));
        if *existed {
            create_parent(&staged.join(OLD).join(name))?;
        }
        if hash.is_some() {
            create_parent(&folder.join(name))?;
        }
    }
    for change in changes.iter().filter(|change| change.hash.is_some()) {
        sync(&staged.join(NEW).join(&change.name))?;
    }
    let journal = format!("{:#}\n", Value::from(journal));
    let path = staged.join(DRAFT);
    fs::write(&path, journal).map_err(|e| Refusal::Io(path.clone(), e))?;
    sync(&path)?;
    rename(&path, &staged.join(JOURNAL))?;
    sync(staged)
}

/// Lets old and new files change places. The last step makes it so.
fn exchange(folder: &Path, staged: &Path, changes: &[Change]) -> Result<(), Refusal> {
    for Change { name, existed, hash } in changes {
        let place = folder.join(name);
        if *existed {
            rename(&place, &staged.join(OLD).join(name))?;
        }
        if hash.is_some() {
            rename(&staged.join(NEW).join(name), &place)?;
        }
    }
    for name in changes.iter().map(|c| &c.name) {
        if let Some(above) = folder.join(name).parent() {
            sync(above)?;
        }
    }
    let journal = staged.join(JOURNAL);
    fs::remove_file(&journal).map_err(|e| Refusal::Io(journal, e))?;
    remove_empty(folder, changes.iter().filter(|c| c.hash.is_none()).map(|c| c.name.as_str()));
    Ok(())
}

/// Restores the files that were there before, as the journal says. It may be done again from anywhere in it.
fn undo(folder: &Path, staged: &Path, inputs: &[PathBuf]) -> Result<(), Refusal> {
    let journal = staged.join(JOURNAL);
    let failed = |e: io::Error| Refusal::Io(journal.clone(), e);
    let text = present::text(&journal).map_err(failed)?;
    let all: Vec<Value> = serde_json::from_str(&text).map_err(|e| failed(e.into()))?;
    let named = |entry: &Value| Some(entry["name"].as_str()?.to_string());
    let names: Vec<String> = all.iter().filter_map(named).collect();
    if names.len() < all.len() || !names.iter().all(|name| is_within(name)) {
        return Err(failed(io::Error::other("this is not a journal of autogen; remove its folder")));
    }
    let read = among(inputs, names.iter().map(|name| folder.join(name)));
    if !read.is_empty() {
        return Err(Refusal::Inputs(read));
    }
    let olds: Vec<String> = names.iter().map(|name| format!("{OLD}/{name}")).collect();
    let [names_of, olds_of] = [&names, &olds].map(|names| names.iter().map(String::as_str));
    let found = [obstacles(folder, names_of), obstacles(staged, olds_of)].concat();
    if !found.is_empty() {
        return Err(Refusal::InTheWay(found));
    }
    for (name, entry) in names.iter().zip(&all) {
        let (old, place) = (staged.join(OLD).join(name), folder.join(name));
        let new = entry["hash"].as_str().map(String::from);
        let there = present(folder, name)?;
        if there != Present::Nothing && !there.is(new.as_deref()) {
            // The old file, or somebody has changed it since.
            continue;
        }
        if old.symlink_metadata().is_ok_and(|old| old.is_file()) {
            create_parent(&place)?;
            rename(&old, &place)?;
        } else if entry["existed"] == false && there != Present::Nothing {
            fs::remove_file(&place).map_err(|e| Refusal::Io(place, e))?;
        }
    }
    remove_empty(folder, names.iter().map(String::as_str));
    fs::remove_file(&journal).map_err(failed)
}

/// Removes the folders of these files that are empty.
fn remove_empty<'a>(folder: &Path, names: impl Iterator<Item = &'a str>) {
    let above = |name: &'a str| Path::new(name).ancestors().skip(1).filter(|part| part.file_name().is_some());
    let mut folders: Vec<PathBuf> = names.flat_map(above).map(PathBuf::from).collect();
    folders.sort();
    folders.dedup();
    for part in folders.iter().rev() {
        let _ = fs::remove_dir(folder.join(part));
    }
}

fn rename(from: &Path, to: &Path) -> Result<(), Refusal> {
    fs::rename(from, to).map_err(|e| Refusal::Io(to.into(), e))
}

fn create(folder: &Path) -> Result<(), Refusal> {
    fs::create_dir_all(folder).map_err(|e| Refusal::Io(folder.into(), e))
}

pub fn create_parent(path: &Path) -> Result<(), Refusal> {
    path.parent().map_or(Ok(()), create)
}

/// What is written there is on the disk. Elsewhere than on Unix, folders cannot be asked to be.
pub fn sync(path: &Path) -> Result<(), Refusal> {
    if cfg!(not(unix)) && path.is_dir() {
        return Ok(());
    }
    let synced = File::open(path).and_then(|file| file.sync_all());
    synced.map_err(|e| Refusal::Io(path.into(), e))
}
