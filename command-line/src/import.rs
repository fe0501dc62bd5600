//! `autogen import`.

use super::options::{ImportFormat, ImportOptions, LifOptions, OpwOptions, UrdfOptions};
use super::{load, print, read};
use crate::Status;
use autogen::diagnostic::Diagnostic;
use autogen::import::{Imported, lif, opw, urdf};
use autogen::plain;
use autogen::source::{FileId, Sources};
use std::path::{Component, Path, PathBuf};

pub fn run(options: &ImportOptions) -> Status {
    match &options.format {
        ImportFormat::Urdf(UrdfOptions { file, base, tip, meshes, name, quiet }) => {
            let read = meshes.as_ref().map(|folder| move |name: &str| mesh(folder, name));
            let options = urdf::Options {
                base: base.as_deref(),
                tip: tip.as_deref(),
                name: name.as_deref(),
                mesh: read.as_ref().map(|read| read as _),
            };
            write(file, *quiet, |sources, file| urdf::import(sources, file, &options))
        }
        ImportFormat::Opw(OpwOptions { file, name, quiet }) => {
            let own = file.file_stem().map(|name| name.to_string_lossy().into_owned());
            let name = name.clone().or(own).unwrap_or_default();
            write(file, *quiet, |sources, file| opw::import(sources, file, &name))
        }
        ImportFormat::Lif(LifOptions { file, vehicle, name, quiet }) => {
            let options = lif::Options { vehicle: vehicle.as_deref(), name: name.as_deref() };
            write(file, *quiet, |sources, file| lif::import(sources, file, &options))
        }
    }
}

/// The text on standard output, what is to be told on standard error.
fn write(
    path: &Path,
    quiet: bool,
    import: impl FnOnce(&Sources, FileId) -> Result<Imported, Vec<Diagnostic>>,
) -> Status {
    let mut sources = Sources::default();
    let file = match load::text(path) {
        // The name without its folder: it is written into the text.
        Ok(text) => {
            let name = path.file_name().map_or_else(|| path.to_string_lossy(), |name| name.to_string_lossy());
            sources.add(name, text)
        }
        Err(failure) => return print::failure_in(super::options::Format::Text, &failure),
    };
    match import(&sources, file) {
        Ok(Imported { text, notes }) => {
            say_part!("{text}");
            if !quiet {
                notes.iter().for_each(|note| complain!("note: {}", plain::line(note)));
            }
            Status::Done
        }
        Err(found) => {
            print::diagnostics(&sources, &found);
            Status::WrongInput
        }
    }
}

/// A mesh of the package in this folder; an error says why it is not read.
fn mesh(folder: &Path, name: &str) -> Result<Vec<u8>, String> {
    let inner = match name.strip_prefix("package://") {
        Some(rest) => {
            rest.split_once('/').map(|(_, path)| path).ok_or("the name has no path in its package")?
        }
        None if name.contains("://") => return Err("only package:// and names of files are read".into()),
        None => name,
    };
    let relative: PathBuf = Path::new(inner).components().filter(|part| *part != Component::CurDir).collect();
    if !relative.components().all(|part| matches!(part, Component::Normal(_))) {
        return Err("the name leads out of the folder".into());
    }
    let path = folder.join(relative);
    let stays = path.canonicalize().and_then(|path| Ok(path.starts_with(folder.canonicalize()?)));
    match stays {
        Ok(true) => read::bytes_of(&path).map_err(|why| why.to_string()),
        Ok(false) => Err("a link leads out of the folder".into()),
        Err(error) => Err(super::io_error::text(&error)),
    }
}
