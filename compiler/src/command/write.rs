//! Writing the output: whole or not at all, and never over a file that is somebody else's.

use super::interrupt::{self, Temporary};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Name of the file that lists all others.
pub const MANIFEST: &str = "manifest.json";

/// Files by their path within the output folder.
pub type Files = BTreeMap<String, String>;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overwrite {
    /// Only files that autogen wrote and nobody changed since.
    Own,
    Everything,
}

#[derive(Debug)]
pub enum Refusal {
    /// These would be overwritten or are in the way.
    NotOurs(Vec<PathBuf>),
    /// Files where folders have to be, or folders where files have to be.
    InTheWay(Vec<PathBuf>),
    Io(PathBuf, io::Error),
}

fn in_the_way(folder: &Path, files: &Files) -> Vec<PathBuf> {
    if folder.symlink_metadata().is_ok() && !folder.is_dir() {
        return vec![folder.into()];
    }
    let mut found: Vec<PathBuf> = Vec::new();
    for name in files.keys().map(String::as_str).chain([MANIFEST]) {
        let path = folder.join(name);
        if path.is_dir() {
            found.push(path.clone());
        }
        let within = Path::new(name)
            .ancestors()
            .skip(1)
            .filter(|part| part.file_name().is_some())
            .map(|part| folder.join(part));
        found.extend(within.filter(|part| part.symlink_metadata().is_ok() && !part.is_dir()));
    }
    found.sort();
    found.dedup();
    found
}

pub fn hash(text: &str) -> String {
    Sha256::digest(text.as_bytes()).iter().map(|b| format!("{b:02x}")).collect()
}

/// Writes the files and a manifest of them, with `about` first in it, and removes those of the last
/// time that are no more. Everything is written beside the folder first.
pub fn write(folder: &Path, files: &Files, about: Value, overwrite: Overwrite) -> Result<(), Refusal> {
    let in_the_way = in_the_way(folder, files);
    if !in_the_way.is_empty() {
        return Err(Refusal::InTheWay(in_the_way));
    }
    let before = manifest(folder);
    let is_own = |name: &str| match (fs::read(folder.join(name)), before.get(name)) {
        (Err(e), _) => e.kind() == io::ErrorKind::NotFound,
        (Ok(bytes), Some(hash_before)) => {
            String::from_utf8(bytes).is_ok_and(|text| hash(&text) == *hash_before)
        }
        (Ok(_), None) => false,
    };
    if overwrite == Overwrite::Own {
        let has_manifest = folder.join(MANIFEST).exists() && before.is_empty();
        let mut foreign: Vec<PathBuf> =
            files.keys().filter(|name| !is_own(name)).map(|n| folder.join(n)).collect();
        if has_manifest {
            foreign.push(folder.join(MANIFEST));
        }
        if !foreign.is_empty() {
            return Err(Refusal::NotOurs(foreign));
        }
    }
    let mut manifest = about;
    manifest["files"] = files
        .iter()
        .map(|(name, text)| (name.clone(), json!(hash(text))))
        .collect::<serde_json::Map<_, _>>()
        .into();
    let manifest = format!("{manifest:#}\n");

    let _writing = interrupt::writing();
    let staged = Temporary::new(staging(folder));
    stage(staged.path(), files, &manifest)?;
    let stale = before.keys().filter(|name| !files.contains_key(*name) && is_own(name));
    for name in stale {
        remove(folder, name)?;
    }
    for name in files.keys().map(String::as_str).chain([MANIFEST]) {
        let (from, to) = (staged.path().join(name), folder.join(name));
        create_parent(&to)?;
        fs::rename(&from, &to).map_err(|e| Refusal::Io(to, e))?;
    }
    Ok(())
}

/// Where the files wait until all of them are written: on the same disk as the folder.
fn staging(folder: &Path) -> PathBuf {
    let name = folder.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    folder.with_file_name(format!(".{name}.{}.partial", std::process::id()))
}

fn stage(staged: &Path, files: &Files, manifest: &str) -> Result<(), Refusal> {
    for (name, text) in files.iter().map(|(n, t)| (n.as_str(), t.as_str())).chain([(MANIFEST, manifest)]) {
        let path = staged.join(name);
        create_parent(&path)?;
        fs::write(&path, text).map_err(|e| Refusal::Io(path, e))?;
    }
    Ok(())
}

fn create_parent(path: &Path) -> Result<(), Refusal> {
    match path.parent() {
        Some(parent) => fs::create_dir_all(parent).map_err(|e| Refusal::Io(parent.into(), e)),
        None => Ok(()),
    }
}

/// Removes a file, and its folder if that is empty then.
fn remove(folder: &Path, name: &str) -> Result<(), Refusal> {
    let path = folder.join(name);
    fs::remove_file(&path).map_err(|e| Refusal::Io(path.clone(), e))?;
    if let Some(parent) = path.parent() {
        let _ = fs::remove_dir(parent);
    }
    Ok(())
}

/// Names and hashes of the files written the last time; none if there is no manifest that can be read.
fn manifest(folder: &Path) -> BTreeMap<String, String> {
    let text = fs::read_to_string(folder.join(MANIFEST)).unwrap_or_default();
    let value: Value = serde_json::from_str(&text).unwrap_or_default();
    let files = value["files"].as_object().cloned().unwrap_or_default();
    files.into_iter().filter_map(|(name, hash)| Some((name, hash.as_str()?.to_string()))).collect()
}
