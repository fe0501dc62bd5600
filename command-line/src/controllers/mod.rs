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
    let entry = Entry::open(&key(&rust::library_sources(system, sources)), notice)?;
    if let Some(path) = entry.library(notice) {
        // What was made here loads here, unless the system itself has changed since.
        if let Ok(library) = SharedLibrary::load(&path) {
            return Ok(library);
        }
    }
    notice.say("compiling the controllers (once for these types) ...");
    let files = rust::library_files(system, sources);
    let path = entry.fill(|workspace: &Path| cargo::compile(workspace, &files))?;
    SharedLibrary::load(&path)
}

/// What tells compiled controllers from others.
fn key(sources: &Files) -> String {
    let mut all = format!("{} {ARCH} {OS}\n", version::NUMBER);
    for (name, text) in sources {
        all += &format!("{name} {}\n{text}\n", text.len());
    }
    hash(all.as_bytes())
}
