//! Input from outside that does harm, or a reader that has gone.

use super::folder;
use std::fs;
use std::io::pipe;
use std::path::Path;
use std::process::{Command, Stdio};

/// A pipe that nobody reads.
fn closed() -> Stdio {
    let (reader, writer) = pipe().expect("a pipe");
    drop(reader);
    writer.into()
}

fn status_unheard(folder: &Path, arguments: &[&str]) -> Option<i32> {
    let status = Command::new(env!("CARGO_BIN_EXE_autogen"))
        .args(arguments)
        .current_dir(folder)
        .stdout(closed())
        .stderr(closed())
        .status();
    status.expect("autogen can be started").code()
}

#[test]
fn a_reader_that_has_gone_changes_no_status() {
    let folder = folder("unheard");
    fs::write(folder.join("bad.json"), "{").expect("a file");
    for (arguments, wanted) in [
        (&["check", "bad.json", "-q"][..], 1),
        (&["check", "missing.json"][..], 2),
        (&["build", "bad.json"][..], 1),
        (&["commission", "bad.json"][..], 1),
        (&["sweep", "bad.json"][..], 1),
        (&["graph", "bad.json"][..], 1),
        (&["explain", "E9999"][..], 2),
        (&["explain"][..], 2),
        (&["--no-such-option"][..], 2),
        (&["--help"][..], 0),
    ] {
        assert_eq!(status_unheard(&folder, arguments), Some(wanted), "{arguments:?}");
    }
}
