//! The manifest: what autogen wrote into the folder.

use super::present;
use serde_json::{Map, Value, json};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::io;
use std::path::Path;

/// Name of the file that lists all others.
pub const MANIFEST: &str = "manifest.json";
/// The key of the files, and that of the hash of the manifest without it.
const FILES: &str = "files";
const SELF: &str = "manifest";

pub fn hash(bytes: &[u8]) -> String {
    hex(&Sha256::digest(bytes))
}

/// A hash as text.
pub fn hex(digest: &[u8]) -> String {
    digest.iter().map(|b| format!("{b:02x}")).collect()
}

/// Hash of all that is still to be read.
pub fn hash_of(mut file: impl io::Read) -> io::Result<String> {
    let mut digest = Sha256::new();
    io::copy(&mut file, &mut digest)?;
    Ok(hex(&digest.finalize()))
}

#[derive(Clone, Debug, Default)]
pub struct Manifest {
    /// What stands before the list of files.
    pub about: Map<String, Value>,
    /// Hashes by names, which lead nowhere out of the folder.
    pub files: BTreeMap<String, String>,
    /// Nobody has changed it.
    pub is_whole: bool,
}

impl Manifest {
    pub fn new(about: Map<String, Value>, files: BTreeMap<String, String>) -> Self {
        Self { about, files, is_whole: true }
    }

    /// That of a folder; an empty one if there is none that can be read.
    pub fn read(folder: &Path) -> Self {
        let text = present::text(&folder.join(MANIFEST)).unwrap_or_default();
        let Ok(Value::Object(mut about)) = serde_json::from_str(&text) else { return Self::default() };
        let own = about.remove(SELF);
        let Some(Value::Object(files)) = about.remove(FILES) else { return Self::default() };
        let files = files.into_iter().filter(|(name, _)| is_within(name));
        let files = files.filter_map(|(name, hash)| Some((name, hash.as_str()?.to_string()))).collect();
        let mut manifest = Self::new(about, files);
        manifest.is_whole = own.is_some() && manifest.to_text() == text;
        manifest
    }

    pub fn to_text(&self) -> String {
        let mut all = self.about.clone();
        all.insert(FILES.into(), json!(self.files));
        let own = hash(format!("{:#}", Value::Object(all.clone())).as_bytes());
        all.insert(SELF.into(), json!(own));
        format!("{:#}\n", Value::Object(all))
    }
}

/// Whether a name can only be that of a file within a folder.
pub fn is_within(name: &str) -> bool {
    !name.contains(['\\', ':', '\0']) && name.split('/').all(|part| !matches!(part, "" | "." | ".."))
}
