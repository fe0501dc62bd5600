//! The generated Rust workspace on disk, and what cargo makes of it.

use crate::compiled_simulator;
use autogen::backend::rust;
use autogen::ir::System;
use autogen::source::Sources;
use std::path::{Path, PathBuf};
use std::process::Output;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::{env, fs};

/// A workspace in a folder of its own, which stays.
pub struct Workspace {
    pub folder: PathBuf,
}

impl Workspace {
    pub fn write(name: &str, system: &System, sources: &Sources) -> Self {
        let workspace = Self::of_simulator(name);
        workspace.replace(system, sources);
        workspace
    }

    /// With the simulator only.
    pub fn of_simulator(name: &str) -> Self {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let tests = env::temp_dir().join(format!("autogen-tests-{}", std::process::id()));
        let folder = tests.join(format!("{number}-{name}"));
        let _ = fs::remove_dir_all(&folder);
        let workspace = Self { folder };
        for (path, text) in compiled_simulator::sources() {
            workspace.put(&path, text);
        }
        workspace
    }

    /// Another system in the place of the one before; what was compiled of the simulator stays.
    pub fn replace(&self, system: &System, sources: &Sources) {
        for (path, text) in rust::files(system, sources) {
            self.put(&path, &text);
        }
        self.put("parameters.txt", &rust::parameters_text(system));
    }

    pub fn put(&self, path: &str, text: &str) {
        let path = self.folder.join(path);
        fs::create_dir_all(path.parent().expect("a file in a folder")).expect("a folder that can be made");
        fs::write(path, text).expect("a file that can be written");
    }

    /// Runs cargo, which has to succeed. The simulator, the same in all workspaces, is compiled once for all.
    pub fn cargo(&self, arguments: &[&str]) -> Output {
        let profile = if arguments.contains(&"--release") { "release" } else { "debug" };
        if matches!(arguments[0], "build" | "test") && !self.target().join(profile).exists() {
            compiled_simulator::copy(&self.folder, profile);
        }
        let output = compiled_simulator::cargo(&self.folder)
            .args(arguments)
            .env("CARGO_TARGET_DIR", self.target())
            .output()
            .expect("cargo can be started");
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "cargo {arguments:?} in {}:\n{errors}", self.folder.display());
        output
    }

    pub fn target(&self) -> PathBuf {
        self.folder.join("target")
    }

    /// A program that was built without optimization: what overflows panics.
    pub fn debug_program(&self, path: &str) -> PathBuf {
        self.target().join("debug").join(path).with_extension(env::consts::EXE_EXTENSION)
    }

    /// A program that was built for release.
    pub fn program(&self, path: &str) -> PathBuf {
        self.target().join("release").join(path).with_extension(env::consts::EXE_EXTENSION)
    }
}

impl Drop for Workspace {
    fn drop(&mut self) {
        // What a failed test leaves is there to be looked at.
        if !std::thread::panicking() {
            let _ = fs::remove_dir_all(&self.folder);
            let _ = self.folder.parent().map(Path::to_path_buf).map(fs::remove_dir);
        }
    }
}
