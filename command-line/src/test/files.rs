//! The files of tests: those that are named, and those below the folders that are.

use std::path::{Path, PathBuf};

/// The end of their names.
const END: &str = "test";
const MOST_FILES: usize = 1000;
/// Folders within folders.
const DEEPEST: usize = 8;

/// In the order of the command line, within a folder in that of their names. No link is followed.
pub fn find(paths: &[PathBuf]) -> Result<Vec<PathBuf>, String> {
    let mut found = Vec::new();
    for path in paths {
        let there = path.metadata().map_err(|e| format!("{}: {e}", path.display()))?;
        if !there.is_dir() {
            found.push(path.clone());
            continue;
        }
        let before = found.len();
        folder(path, DEEPEST, &mut found)?;
        if found.len() == before {
            return Err(format!("{}: there is no *.{END} file in this folder", path.display()));
        }
    }
    match found.len() > MOST_FILES {
        true => Err(format!("these are more than {MOST_FILES} files of tests: name fewer folders")),
        false => Ok(found),
    }
}

fn folder(path: &Path, depth: usize, found: &mut Vec<PathBuf>) -> Result<(), String> {
    let failed = |e: std::io::Error| format!("{}: {e}", path.display());
    let mut entries = Vec::new();
    for entry in path.read_dir().map_err(failed)? {
        let entry = entry.map_err(failed)?;
        entries.push((entry.path(), entry.file_type().map_err(failed)?));
    }
    entries.sort_by(|a, b| a.0.cmp(&b.0));
    for (path, kind) in entries {
        if kind.is_file() && path.extension().is_some_and(|end| end == END) {
            found.push(path);
        } else if kind.is_dir() && depth > 0 && found.len() <= MOST_FILES {
            folder(&path, depth - 1, found)?;
        }
    }
    Ok(())
}
