//! Cargo, run where nothing but the user's own configuration is found.

use super::super::interrupt;
use super::super::io_error;
use autogen::backend::Files;
use autogen::simulator::TARGET;
use serde_json::Value;
use std::env::{self, consts::DLL_SUFFIX};
use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Compiles the adapters' shared library in a folder, and returns its path. Cargo and rustup look for their
/// configuration in the working directory and above it, so that is the root.
pub fn compile(folder: &Path, files: &Files) -> Result<PathBuf, String> {
    put(folder, files).map_err(|e| format!("{}: {}", folder.display(), io_error::text(&e)))?;
    let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo
        .current_dir(folder.ancestors().last().unwrap_or(folder))
        // The controllers depend on nothing that would have to be fetched.
        .args(["build", "--release", "--offline", "--quiet", "-p", "adapters", "--lib"])
        .arg("--manifest-path")
        .arg(folder.join("Cargo.toml"))
        .args(["--message-format", "json-render-diagnostics", "--target", TARGET])
        .arg("--target-dir")
        .arg(folder.join("target"))
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    if let Some((name, flags)) = lenient_flags() {
        cargo.env(name, flags);
    }
    let output = interrupt::output(interrupt::in_group(&mut cargo)).map_err(|e| {
        format!(
            "cargo cannot be started, and the controllers need it to be compiled: {e}; \
                 install Rust from https://rustup.rs, or set CARGO to the path of cargo"
        )
    })?;
    if !output.status.success() {
        let errors = String::from_utf8_lossy(&output.stderr);
        return Err(format!("the controllers could not be compiled:\n{errors}"));
    }
    library(&output.stdout).ok_or_else(|| "cargo has compiled no shared library".into())
}

/// The user's flags for rustc, if there are any, under which a warning is no error: a later rustc warns of more.
fn lenient_flags() -> Option<(&'static str, OsString)> {
    // Cargo takes the first of these.
    let variables = [("CARGO_ENCODED_RUSTFLAGS", "\u{1f}"), ("RUSTFLAGS", " ")];
    variables.into_iter().find_map(|(name, between)| {
        let mut flags = env::var_os(name)?;
        if !flags.is_empty() {
            flags.push(between);
        }
        flags.push("--cap-lints=warn");
        Some((name, flags))
    })
}

fn put(folder: &Path, files: &Files) -> io::Result<()> {
    let _writing = interrupt::writing();
    for (name, text) in files {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().unwrap_or(folder))?;
        fs::write(path, text)?;
    }
    Ok(())
}

/// The shared library among the artifacts that cargo lists.
fn library(messages: &[u8]) -> Option<PathBuf> {
    let messages = serde_json::Deserializer::from_slice(messages).into_iter::<Value>().flatten();
    let files: Vec<Value> =
        messages.filter_map(|message| message["filenames"].as_array().cloned()).flatten().collect();
    let library = files.iter().filter_map(Value::as_str).find(|name| name.ends_with(DLL_SUFFIX));
    library.map(PathBuf::from)
}
