//! The simulator of a generated workspace, compiled once for the workspaces of all tests. It takes longer than all
//! else in them. Cargo judges what is copied as it judges its own results: what does not fit is compiled anew.

use autogen::simulator;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::{env, fs};

/// Paths in a workspace, and texts.
pub fn sources() -> impl Iterator<Item = (String, &'static str)> {
    let sources = simulator::SOURCES.iter().map(|(path, text)| (format!("runtime-sim/{path}"), *text));
    sources.chain([("runtime-sim/Cargo.toml".to_string(), simulator::MANIFEST)])
}

/// One at a time.
static BUILDING: Mutex<()> = Mutex::new(());

/// Copies the simulator, and what cargo has made of it, into a workspace where nothing was compiled in a profile yet.
pub fn copy(workspace: &Path, profile: &str) {
    let _one = BUILDING.lock().expect("no test panics here");
    let folder = folder();
    // With its profiles.
    let manifest = fs::read_to_string(workspace.join("Cargo.toml")).expect("the manifest of the workspace");
    let alone = |line: &str| match line.starts_with("members = ") {
        true => "members = [\"runtime-sim\"]\n".to_string(),
        false => format!("{line}\n"),
    };
    put(&folder.join("Cargo.toml"), &manifest.lines().map(alone).collect::<String>());
    for (path, text) in sources() {
        put(&folder.join(path), text);
    }
    let mut cargo = cargo(&folder);
    cargo.args(["build", "--quiet", "-p", "runtime-sim"]);
    cargo.env("CARGO_TARGET_DIR", folder.join("target"));
    if profile == "release" {
        cargo.arg("--release");
    }
    assert!(cargo.status().expect("cargo can be started").success(), "{}", folder.display());
    for part in ["runtime-sim".to_string(), format!("target/{profile}")] {
        copy_all(&folder.join(&part), &workspace.join(part));
    }
}

/// Cargo in a workspace that is compiled once: nothing is kept for a second time, and for no debugger.
pub fn cargo(workspace: &Path) -> Command {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.current_dir(workspace).env_remove("RUSTFLAGS");
    cargo.env("CARGO_INCREMENTAL", "0").env("CARGO_PROFILE_DEV_DEBUG", "false");
    cargo
}

/// Beside the tests themselves, so that it is there for the next ones and goes with `cargo clean`.
fn folder() -> PathBuf {
    let tests = env::current_exe().expect("the path of this program");
    let target = tests.ancestors().nth(3).expect("a program in a folder of a profile");
    target.join("tmp/simulator")
}

/// Cargo compiles again what is newer than its results.
fn put(path: &Path, text: &str) {
    if fs::read_to_string(path).is_ok_and(|found| found == text) {
        return;
    }
    fs::create_dir_all(path.parent().expect("a file in a folder")).expect("a folder that can be made");
    fs::write(path, text).expect("a file that can be written");
}

/// With the times by which cargo judges.
fn copy_all(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder that can be made");
    for entry in fs::read_dir(from).expect("a folder") {
        let entry = entry.expect("an entry");
        let to = to.join(entry.file_name());
        match entry.file_type().expect("its type").is_dir() {
            true => copy_all(&entry.path(), &to),
            false => {
                let time = entry.metadata().and_then(|found| found.modified()).expect("its time");
                fs::copy(entry.path(), &to).expect("a file that can be copied");
                let copy = File::options().write(true).open(to).expect("the copy");
                copy.set_modified(time).expect("a time that can be set");
            }
        }
    }
}
