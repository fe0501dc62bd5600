//! Where compiled controllers are kept: the user's cache, a folder for each set of types.

use super::super::cache;
use super::super::interrupt::{self, Temporary};
use super::super::io_error;
use super::super::lock::Lock;
use super::super::output::hash;
use super::Notice;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Changes with what is in the folders.
const FORMAT: &str = "controllers-2";
const LIBRARY: &str = "library";
/// Hash of the library, as a check that it is what was made.
const HASH: &str = "library.sha256";

/// The folder of a set of types. No other process works in it.
pub struct Entry {
    folder: PathBuf,
    _lock: Lock,
}

impl Entry {
    /// What processes that were killed have left there is removed.
    pub fn open(key: &str, notice: Notice) -> Result<Self, String> {
        let folder = cache::folder()?.join(FORMAT).join(key);
        let failed = |e: io::Error| format!("{}: {}", folder.display(), io_error::text(&e));
        fs::create_dir_all(&folder).map_err(failed)?;
        let waits = || notice.say("waiting for another autogen that compiles the same controllers ...");
        let lock = Lock::folder(&folder, waits).map_err(failed)?;
        for entry in fs::read_dir(&folder).map_err(failed)? {
            let entry = entry.map_err(failed)?;
            let is_own = entry.file_name() == LIBRARY || entry.file_name() == HASH;
            if !is_own || !entry.file_type().map_err(failed)?.is_file() {
                drop(Temporary::new(entry.path()));
            }
        }
        Ok(Self { folder, _lock: lock })
    }

    /// The compiled library, if it is what was made.
    pub fn library(&self, notice: Notice) -> Option<PathBuf> {
        let path = self.folder.join(LIBRARY);
        let bytes = fs::read(&path).ok()?;
        let made = fs::read_to_string(self.folder.join(HASH)).ok();
        if made.is_some_and(|made| made == hash(&bytes)) {
            return Some(path);
        }
        notice.say("the compiled controllers in the cache were changed, and are not used");
        None
    }

    /// Keeps what `make` has made in a folder of its own, which is removed.
    pub fn fill(&self, make: impl FnOnce(&Path) -> Result<PathBuf, String>) -> Result<PathBuf, String> {
        let failed = |e: io::Error| format!("{}: {}", self.folder.display(), io_error::text(&e));
        let workspace = Temporary::new(self.folder.join("workspace"));
        fs::create_dir(workspace.path()).map_err(failed)?;
        let made = make(workspace.path())?;
        let bytes = fs::read(&made).map_err(failed)?;
        let library = self.folder.join(LIBRARY);
        let _writing = interrupt::writing();
        let new_hash = workspace.path().join(HASH);
        fs::write(&new_hash, hash(&bytes)).map_err(failed)?;
        fs::rename(&new_hash, self.folder.join(HASH)).map_err(failed)?;
        fs::rename(&made, &library).map_err(failed)?;
        Ok(library)
    }
}
