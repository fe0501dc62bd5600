//! The program in which controllers and simulator are linked.

use super::build::files_of_rust;
use super::write;
use autogen::ir::System;
use autogen::source::Sources;
use std::io::Read;
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
        eprintln!("compiling the controllers and the simulator (once for these types) ...");
    }
    // Of this process alone: another one may be compiling the same.
    let workspace = folder.join(format!("workspace-{}", std::process::id()));
    let made = write::put(&workspace, &files)
        .map_err(|e| format!("{}: {e}", workspace.display()))
        .and_then(|()| compile(&workspace))
        .and_then(|made| fs::rename(&made, &program).map_err(|e| format!("{}: {e}", made.display())));
    let _ = fs::remove_dir_all(&workspace);
    made.map(|()| program)
}

fn compile(workspace: &Path) -> Result<PathBuf, String> {
    let target = workspace.join("target");
    let result = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
        .args(["build", "--release", "--quiet", "-p", "commissioning", "--manifest-path"])
        .arg(workspace.join("Cargo.toml"))
        .arg("--target-dir")
        .arg(&target)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn();
    let mut child = result
        .map_err(|e| format!("cargo cannot be started, and the controllers need it to be compiled: {e}"))?;
    let mut errors = String::new();
    if let Some(mut stderr) = child.stderr.take() {
        let _ = stderr.read_to_string(&mut errors);
    }
    let status = child.wait().map_err(|e| e.to_string())?;
    if !status.success() {
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
