//! The controllers of a system's types, compiled apart from the simulator and loaded.

mod cache;
mod cargo;
mod shared_library;

pub use shared_library::{Controllers, SharedLibrary};

use super::output::hash;
use autogen::backend::Files;
use autogen::backend::rust;
use autogen::ir::System;
use autogen::source::Sources;
use autogen::version;
use cache::Entry;
use std::env::consts::{ARCH, OS};
use std::path::Path;

/// What is said on standard error while one waits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Notice {
    Compiling,
    None,
}

impl Notice {
    fn say(self, text: &str) {
        match self {
            Notice::Compiling => complain!("{text}"),
            Notice::None => {}
        }
    }
}

/// The controllers of this system's types. The types and the kinds of part are all that they depend on, so they
/// are compiled once for all layouts and values, and kept in the user's cache.
pub fn compiled(system: &System, sources: &Sources, notice: Notice) -> Result<SharedLibrary, String> {
    loaded(rust::library_files(system, sources), notice)
}

/// The same from the files of the workspace `rust/` of a line.
pub fn compiled_from(workspace: Files, notice: Notice) -> Result<SharedLibrary, String> {
    loaded(rust::library_of(workspace), notice)
}

fn loaded(files: Files, notice: Notice) -> Result<SharedLibrary, String> {
    let entry = Entry::open(&key(&files), notice)?;
    if let Some(path) = entry.library(notice) {
        // What was made here loads here, unless the system itself has changed since.
        if let Ok(library) = SharedLibrary::load(&path) {
            return Ok(library);
        }
    }
    notice.say("compiling the controllers (once for these types) ...");
    let path = entry.fill(|workspace: &Path| cargo::compile(workspace, &files))?;
    SharedLibrary::load(&path)
}

/// What tells compiled controllers from others.
fn key(files: &Files) -> String {
    let texts = files.iter().filter(|(name, _)| !is_of_layout(name));
    let mut all = format!("{} {ARCH} {OS}\n", version::NUMBER);
    for (name, text) in texts {
        all += &format!("{name} {}\n{text}\n", text.len());
    }
    hash(all.as_bytes())
}

/// Files in which only the layout is written; the library reads its data at run time.
fn is_of_layout(name: &str) -> bool {
    name.starts_with("controllers/src/robots/")
        || matches!(name, "controllers/src/robots.rs" | "controllers/src/line.rs")
}
