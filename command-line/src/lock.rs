//! One process at a time where two would disturb each other.

use std::fs::File;
use std::io;
use std::path::Path;

/// A folder that is locked until this is dropped or the process ends, however it ends. Where there are no locks
/// on folders, as on some network drives and elsewhere than on Unix, it locks nothing.
#[derive(Debug)]
pub struct Lock {
    #[cfg_attr(not(unix), expect(dead_code))]
    folder: Option<File>,
}

impl Lock {
    /// Waits until no other process has locked the folder; `waits` is called once if one has.
    #[cfg(unix)]
    pub fn folder(path: &Path, waits: impl FnOnce()) -> io::Result<Self> {
        use rustix::fs::{FlockOperation, flock};
        use rustix::io::Errno;
        let folder = File::open(path)?;
        let locked = match flock(&folder, FlockOperation::NonBlockingLockExclusive) {
            Err(Errno::WOULDBLOCK) => {
                waits();
                loop {
                    match flock(&folder, FlockOperation::LockExclusive) {
                        Err(Errno::INTR) => {}
                        answer => break answer,
                    }
                }
            }
            answer => answer,
        };
        match locked {
            Ok(()) => Ok(Self { folder: Some(folder) }),
            Err(Errno::NOTSUP | Errno::NOSYS | Errno::NOLCK | Errno::INVAL | Errno::BADF) => {
                Ok(Self { folder: None })
            }
            Err(error) => Err(error.into()),
        }
    }

    /// Whether the locked folder is still the one of that path: the process that had it may have removed it.
    #[cfg(unix)]
    pub fn is_on(&self, path: &Path) -> bool {
        use std::os::unix::fs::MetadataExt;
        let Some(folder) = &self.folder else { return path.is_dir() };
        let place = |there: std::fs::Metadata| (there.dev(), there.ino());
        folder.metadata().map(place).ok() == path.metadata().map(place).ok()
    }

    #[cfg(not(unix))]
    pub fn is_on(&self, path: &Path) -> bool {
        path.is_dir()
    }

    #[cfg(not(unix))]
    pub fn folder(_: &Path, _: impl FnOnce()) -> io::Result<Self> {
        Ok(Self { folder: None })
    }
}

/// Locks a file as long as it is open; false if another process has locked it.
#[cfg(unix)]
pub fn claim(file: &File) -> bool {
    use rustix::fs::{FlockOperation, flock};
    flock(file, FlockOperation::NonBlockingLockExclusive) != Err(rustix::io::Errno::WOULDBLOCK)
}

#[cfg(not(unix))]
pub fn claim(_: &File) -> bool {
    true
}
