//! Where the I/O trace is written: beside its place first, and never over a file that is none.

use super::write::Overwrite;
use std::fs::{self, File};
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

/// How every I/O trace begins.
const BEGINNING: &str = "run_permit,start,reset,";

/// A file to come.
#[derive(Debug)]
pub struct IoTrace {
    path: PathBuf,
    partial: PathBuf,
}

impl IoTrace {
    /// An error says what is in the way.
    pub fn new(path: &Path, overwrite: Overwrite) -> Result<Self, String> {
        let name = path.file_name().ok_or_else(|| format!("{}: this is no file", path.display()))?;
        let own = Self {
            path: path.into(),
            partial: path.with_file_name(format!(
                ".{}.{}.partial",
                name.to_string_lossy(),
                std::process::id()
            )),
        };
        if path.metadata().is_ok_and(|there| !there.is_file()) {
            return Err(format!("{}: this is no file", path.display()));
        }
        if overwrite == Overwrite::Own && !is_free(path)? {
            return Err(format!(
                "{}: this file is no I/O trace; choose another one, or overwrite it with --force",
                path.display()
            ));
        }
        File::create(&own.partial).map_err(|e| format!("{}: {e}", path.display()))?;
        Ok(own)
    }

    /// Where to write while the run goes on; removed when this is dropped.
    pub fn partial(&self) -> &Path {
        &self.partial
    }

    /// What was written is whole.
    pub fn keep(self) -> Result<(), String> {
        fs::rename(&self.partial, &self.path).map_err(|e| format!("{}: {e}", self.path.display()))
    }
}

impl Drop for IoTrace {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.partial);
    }
}

/// Whether there is nothing yet, an empty file, or an I/O trace.
fn is_free(path: &Path) -> Result<bool, String> {
    let mut beginning = Vec::new();
    match File::open(path).and_then(|file| file.take(BEGINNING.len() as u64).read_to_end(&mut beginning)) {
        Ok(_) => Ok(beginning.is_empty() || beginning == BEGINNING.as_bytes()),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(true),
        Err(error) => Err(format!("{}: {error}", path.display())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_trace_is_overwritten() {
        let folder = std::env::temp_dir().join(format!("autogen-io-trace-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("layout.json");
        fs::write(&path, "{}").unwrap();
        assert!(IoTrace::new(&path, Overwrite::Own).unwrap_err().contains("no I/O trace"));
        assert!(IoTrace::new(&folder, Overwrite::Everything).unwrap_err().contains("no file"));
        assert!(IoTrace::new(&folder.join("none/trace.csv"), Overwrite::Own).is_err());
        let trace = IoTrace::new(&path, Overwrite::Everything).unwrap();
        fs::write(trace.partial(), format!("{BEGINNING}running\n")).unwrap();
        trace.keep().unwrap();
        assert!(fs::read_to_string(&path).unwrap().starts_with(BEGINNING));
        drop(IoTrace::new(&path, Overwrite::Own).unwrap());
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1, "what was begun is removed");
        fs::remove_dir_all(&folder).unwrap();
    }
}
