//! `autogen fmt`.

use super::options::FmtOptions;
use super::{diff, interrupt, io_error, named, print, read};
use crate::Status;
use autogen::source::Sources;
use autogen::spec::format::format;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A file that is not formatted.
struct Change {
    path: PathBuf,
    old: String,
    new: String,
}

pub fn run(options: &FmtOptions) -> Status {
    let mut sources = Sources::default();
    let (mut changes, mut count, mut diagnostics) = (Vec::new(), 0, Vec::new());
    for path in &options.paths {
        let paths = match named::automata(path) {
            Ok(paths) => paths,
            Err(why) => return refused(path, &why),
        };
        for path in paths {
            let old = match read::text(&path) {
                Ok(old) => old,
                Err(why) => return refused(&path, &why),
            };
            count += 1;
            let file = sources.add(path.display().to_string(), old.as_str());
            match format(file, &old) {
                Ok(new) if new != old => changes.push(Change { path, old, new }),
                Ok(_) => {}
                Err(found) => diagnostics.extend(found),
            }
        }
    }
    if !diagnostics.is_empty() {
        print::diagnostics(&sources, &diagnostics);
        complain!("autogen: nothing was changed: a file with errors is not formatted");
        return Status::WrongInput;
    }
    match options.check {
        true => check(options, &changes, count),
        false => write(options, &changes, count),
    }
}

fn refused(path: &Path, why: &dyn std::fmt::Display) -> Status {
    complain!("autogen: {}: {why}", path.display());
    Status::WrongCommand
}

fn check(options: &FmtOptions, changes: &[Change], count: usize) -> Status {
    for Change { path, old, new } in changes {
        say!("{} is not formatted", path.display());
        if !options.quiet {
            say_part!("{}", diff::short(old, new));
        }
    }
    match changes.is_empty() {
        true if options.quiet => {}
        true => say!(
            "{} formatted",
            if count == 1 { "the file is".into() } else { format!("all {count} files are") }
        ),
        false => say!("{} of {count} files are not formatted; format them with `autogen fmt`", changes.len()),
    }
    if changes.is_empty() { Status::Done } else { Status::WrongInput }
}

fn write(options: &FmtOptions, changes: &[Change], count: usize) -> Status {
    for Change { path, new, .. } in changes {
        if let Err(why) = replace(path, new) {
            return refused(path, &format!("{}; the file is as it was", io_error::text(&why)));
        }
        if !options.quiet {
            say!("{}", path.display());
        }
    }
    if !options.quiet {
        say!("{} of {count} files formatted", changes.len());
    }
    Status::Done
}

/// The new text takes the place of the old one when it is on the disk as a whole.
fn replace(path: &Path, text: &str) -> io::Result<()> {
    let path = path.canonicalize()?;
    let _writing = interrupt::writing();
    let mut file = tempfile::NamedTempFile::new_in(path.parent().unwrap_or(Path::new(".")))?;
    file.write_all(text.as_bytes())?;
    file.as_file().set_permissions(path.metadata()?.permissions())?;
    file.as_file().sync_all()?;
    file.persist(&path)?;
    Ok(())
}
