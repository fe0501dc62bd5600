//! The tool's own folder in the user's cache: compiled controllers, and what runs have found.

use super::interrupt::Temporary;
use super::io_error;
use std::env;
use std::fs::{self, DirBuilder};
use std::io;
use std::path::{Path, PathBuf};

/// Nobody else can write to it: what is in it is run and believed.
pub fn folder() -> Result<PathBuf, String> {
    own(&cache()?)
}

/// The folder of caches. Relative paths are ignored, as the XDG specification demands: what is in the working
/// directory may be somebody else's.
fn cache() -> Result<PathBuf, String> {
    let set = |name: &str| env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    set("XDG_CACHE_HOME").or_else(|| Some(set("HOME")?.join(".cache"))).ok_or_else(|| {
        "there is no folder for compiled controllers: set HOME or XDG_CACHE_HOME to an absolute path".into()
    })
}

/// The tool's folder in it.
fn own(cache: &Path) -> Result<PathBuf, String> {
    let folder = cache.join("autogen");
    let failed = |e: io::Error| format!("{}: {}", folder.display(), io_error::text(&e));
    fs::create_dir_all(cache).map_err(failed)?;
    let mut builder = DirBuilder::new();
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    match builder.create(&folder) {
        Err(error) if error.kind() != io::ErrorKind::AlreadyExists => return Err(failed(error)),
        _ => {}
    }
    close_to_others(&folder)?;
    Ok(folder)
}

#[cfg(unix)]
fn close_to_others(folder: &Path) -> Result<(), String> {
    use std::os::unix::fs::{MetadataExt, PermissionsExt};
    let failed = |e: io::Error| format!("{}: {}", folder.display(), io_error::text(&e));
    let metadata = folder.symlink_metadata().map_err(failed)?;
    if !metadata.is_dir() || metadata.uid() != rustix::process::geteuid().as_raw() {
        return Err(format!(
            "{}: compiled controllers are kept here and run from here, so it has to be a folder of your own; \
             set XDG_CACHE_HOME to another place",
            folder.display()
        ));
    }
    if metadata.mode() & 0o022 != 0 {
        // Others could have put there what would be run.
        for entry in fs::read_dir(folder).map_err(failed)? {
            drop(Temporary::new(entry.map_err(failed)?.path()));
        }
    }
    if metadata.mode() & 0o077 != 0 {
        fs::set_permissions(folder, fs::Permissions::from_mode(0o700)).map_err(failed)?;
    }
    Ok(())
}

#[cfg(not(unix))]
fn close_to_others(_: &Path) -> Result<(), String> {
    Ok(())
}
