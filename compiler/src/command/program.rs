//! The program in which controllers and simulator are linked.

use super::build::files_of_rust;
use super::interrupt::{self, Temporary};
use super::write::{self, Files};
use autogen::ir::System;
use autogen::source::Sources;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::{env, fs};

/// What is said when the program has to be compiled, on standard error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Notice {
    Compiling,
    None,
}

/// The program of this system's types. They and the kinds of part are all that it depends on, so it is
/// compiled once for all layouts and values, and kept.
pub fn linked(system: &System, sources: &Sources, notice: Notice) -> Result<PathBuf, String> {
    let files = files_of_rust(system, sources);
    let text: String =
        files.iter().filter(|(name, _)| !is_of_layout(name)).map(|(n, t)| format!("{n}\n{t}\n")).collect();
    let folder = cache().join(&write::hash(&text)[..16]);
    let program = folder.join("commissioning").with_extension(env::consts::EXE_EXTENSION);
    if program.is_file() {
        return Ok(program);
    }
    if notice == Notice::Compiling {
        complain!("compiling the controllers and the simulator (once for these types) ...");
    }
    // Of this process alone: another one may be compiling the same.
    let workspace = Temporary::new(folder.join(format!("workspace-{}", std::process::id())));
    put(workspace.path(), &files).map_err(|e| format!("{}: {e}", workspace.path().display()))?;
    let made = compile(workspace.path())?;
    fs::rename(&made, &program).map_err(|e| format!("{}: {e}", made.display()))?;
    Ok(program)
}

/// Writes files into a folder of the program's own, over whatever is there.
fn put(folder: &Path, files: &Files) -> io::Result<()> {
    let _writing = interrupt::writing();
    for (name, text) in files {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().unwrap_or(folder))?;
        fs::write(path, text)?;
    }
    Ok(())
}

fn compile(workspace: &Path) -> Result<PathBuf, String> {
    let target = workspace.join("target");
    let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo
        .args(["build", "--release", "--quiet", "-p", "commissioning", "--manifest-path"])
        .arg(workspace.join("Cargo.toml"))
        .arg("--target-dir")
        .arg(&target)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped());
    let output = interrupt::output(interrupt::in_group(&mut cargo))
        .map_err(|e| format!("cargo cannot be started, and the controllers need it to be compiled: {e}"))?;
    if !output.status.success() {
        let errors = String::from_utf8_lossy(&output.stderr);
        return Err(format!("the controllers could not be compiled:\n{errors}"));
    }
    Ok(target.join("release").join("commissioning").with_extension(env::consts::EXE_EXTENSION))
}

/// Files in which only the layout is written; the program reads its data at run time.
fn is_of_layout(name: &str) -> bool {
    name.starts_with("controllers/src/robots") || name == "controllers/src/line.rs"
}

/// Where compiled programs are kept: the user's cache.
fn cache() -> PathBuf {
    let set = |name: &str| env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    let base = set("XDG_CACHE_HOME").or_else(|| Some(set("HOME")?.join(".cache")));
    base.unwrap_or_else(env::temp_dir).join("autogen")
}
