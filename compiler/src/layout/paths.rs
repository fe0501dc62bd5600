//! Paths that a layout names stay below its folder.

use super::decode::Decoder;
use crate::diagnostic::Diagnostic;
use crate::source::Spanned;
use std::path::{Component, Path};

/// The code of a path that leads out of the layout's folder.
pub const OUTSIDE: &str = "E0140";

impl Decoder {
    /// What links the path leads over only the disk can say.
    pub(super) fn stays_within(&mut self, key: &str, path: &Spanned<String>) {
        if leads_out(&path.value) {
            self.report(
                Diagnostic::new(OUTSIDE, path.span, format!("`{key}` leads out of the folder of the layout"))
                    .note("a layout reads no files outside its own folder")
                    .help(format!("put it below the folder of the layout, or give it by --{key}")),
            );
        }
    }
}

fn leads_out(path: &str) -> bool {
    let mut depth = 0usize;
    for component in Path::new(path).components() {
        match component {
            Component::Prefix(_) | Component::RootDir => return true,
            Component::CurDir => {}
            Component::Normal(_) => depth += 1,
            Component::ParentDir if depth == 0 => return true,
            Component::ParentDir => depth -= 1,
        }
    }
    false
}
