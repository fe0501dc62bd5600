//! What is in the output folder. No symbolic link within it is followed.

use super::Refusal;
use super::manifest::hash_of;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Present {
    Nothing,
    /// With its hash.
    File(String),
}

impl Present {
    /// Whether this is a file with that hash.
    pub fn is(&self, hash: Option<&str>) -> bool {
        matches!((self, hash), (Present::File(own), Some(hash)) if own == hash)
    }
}

pub fn present(folder: &Path, name: &str) -> Result<Present, Refusal> {
    let path = folder.join(name);
    match File::open(&path).and_then(hash_of) {
        Ok(hash) => Ok(Present::File(hash)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Present::Nothing),
        Err(error) => Err(Refusal::Io(path, error)),
    }
}

/// Bytes of a manifest or a journal. That of 10,000 robots has 1.3 MB.
const MOST_BYTES: u64 = 10_000_000;

/// The text of a file of bounded size that is no link.
pub fn text(path: &Path) -> io::Result<String> {
    let there = path.symlink_metadata()?;
    match there.is_file() && there.len() <= MOST_BYTES {
        true => fs::read_to_string(path),
        false => Err(io::Error::other("autogen did not write this file")),
    }
}

/// What is no folder where one has to be, and what is no file where one has to be, in order.
pub fn obstacles<'a>(folder: &Path, names: impl Iterator<Item = &'a str>) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for name in names {
        let file = folder.join(name);
        if file.symlink_metadata().is_ok_and(|there| !there.is_file()) {
            found.push(file);
        }
        let above = Path::new(name).ancestors().skip(1).filter(|part| part.file_name().is_some());
        let above = above.map(|part| folder.join(part));
        found.extend(above.filter(|part| part.symlink_metadata().is_ok_and(|there| !there.is_dir())));
    }
    found.sort();
    found.dedup();
    found
}
