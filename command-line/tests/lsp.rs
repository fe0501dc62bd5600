//! The language server as an editor talks to it: the real program, over pipes.

#[path = "lsp/client.rs"]
mod client;
#[path = "lsp/diagnostics.rs"]
mod diagnostics;
#[path = "lsp/json.rs"]
mod json;
#[path = "lsp/messages.rs"]
mod messages;
#[path = "lsp/names.rs"]
mod names;
#[path = "lsp/on_disk.rs"]
mod on_disk;
#[path = "lsp/unread.rs"]
mod unread;

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

/// A folder in which `autogen new` wrote its line.
fn new_line(name: &str) -> PathBuf {
    let above = Path::new(env!("CARGO_TARGET_TMPDIR")).join("lsp");
    fs::create_dir_all(&above).expect("a folder that can be made");
    let folder = above.canonicalize().expect("the folder").join(name);
    let _ = fs::remove_dir_all(&folder);
    let made = Command::new(env!("CARGO_BIN_EXE_autogen")).arg("new").arg(&folder).output();
    assert!(made.expect("autogen").status.success());
    folder
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|why| panic!("{}: {why}", path.display()))
}
