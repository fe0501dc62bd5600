//! A folder beside what would be written into it.

use super::manifest::{MANIFEST, Manifest, hash};
use super::present::{Present, obstacles, present};
use super::{Refusal, after};
use autogen::backend::Sink;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::fmt::Display;
use std::path::Path;

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

/// What [`Output::write`](super::Output::write) would change in a folder, which may be one that cannot be written to.
/// Its manifest stands last.
pub fn compare(
    folder: &Path,
    make: impl FnOnce(&mut dyn Sink),
    about: Map<String, Value>,
) -> Result<Comparison, Refusal> {
    let before = Manifest::read(folder);
    let mut compared = Compared { folder, hashes: BTreeMap::new(), found: Vec::new(), wrong: Vec::new() };
    make(&mut compared);
    let after = after(compared.hashes.clone(), about, &before);
    let of_files = std::mem::take(&mut compared.found);
    compared.file(MANIFEST, &after.to_text());
    let mut in_the_way = obstacles(folder, before.files.keys().map(String::as_str));
    for refusal in compared.wrong {
        match refusal {
            Refusal::InTheWay(paths) => in_the_way.extend(paths),
            refusal if in_the_way.is_empty() => return Err(refusal),
            _ => {}
        }
    }
    if !in_the_way.is_empty() {
        in_the_way.sort();
        in_the_way.dedup();
        return Err(Refusal::InTheWay(in_the_way));
    }
    let mut differences = of_files;
    for (name, hash) in before.files.iter().filter(|(name, _)| !after.files.contains_key(*name)) {
        if present(folder, name)?.is(Some(hash)) {
            differences.push(Difference { name: name.clone(), kind: Kind::Left });
        }
    }
    differences.sort_by(|a, b| a.name.cmp(&b.name));
    differences.extend(compared.found);
    Ok(Comparison { files: compared.hashes.len(), differences })
}

/// A folder, and what would be written now.
pub struct Comparison {
    /// How many would be written, with the manifest.
    pub files: usize,
    pub differences: Vec<Difference>,
}

/// Takes files and compares them with those of a folder.
struct Compared<'a> {
    folder: &'a Path,
    hashes: BTreeMap<String, String>,
    found: Vec<Difference>,
    wrong: Vec<Refusal>,
}

impl Sink for Compared<'_> {
    fn file(&mut self, name: &str, text: &dyn Display) {
        let found = obstacles(self.folder, [name].into_iter());
        if !found.is_empty() {
            return self.wrong.push(Refusal::InTheWay(found));
        }
        let text = text.to_string();
        let hash = hash(text.as_bytes());
        let kind = match present(self.folder, name) {
            Err(refusal) => return self.wrong.push(refusal),
            Ok(Present::Nothing) => Some(Kind::Missing),
            Ok(there) if there.is(Some(&hash)) => None,
            Ok(Present::File(_)) => Some(Kind::Changed(text)),
        };
        self.hashes.insert(name.into(), hash);
        self.found.extend(kind.map(|kind| Difference { name: name.into(), kind }));
    }
}
