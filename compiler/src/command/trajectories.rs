//! The option `--trajectories`: what is asked for, and writing it.

use super::options::{CommissionOptions, TrajectoryOptions};
use autogen::backend::paths;
use autogen::lower::Project;
use runtime_sim::item;
use runtime_sim::line::Line;
use runtime_sim::path::{FORMAT, HEAD};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A drawing is made from samples so far apart.
const DRAWN_EVERY_MS: u64 = 20;
/// Names in the temporary folder.
const SEGMENTS: &str = "segments.json";
const TABLE: &str = "table.csv";
const DRAWN: &str = "drawn.csv";

/// Which paths are to be written, where and how.
#[derive(Debug)]
pub struct Request {
    files: Vec<(PathBuf, Form)>,
    every_ms: u64,
    items: Vec<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    Table,
    Segments,
    Drawing,
}

impl Form {
    fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "csv" => Some(Form::Table),
            "json" => Some(Form::Segments),
            "svg" => Some(Form::Drawing),
            _ => None,
        }
    }

    /// Whether autogen wrote this text.
    fn is_own(self, text: &str) -> bool {
        match self {
            Form::Table => text.starts_with(HEAD),
            Form::Segments => text.starts_with(&format!("{{\"format\":\"{FORMAT}\"")),
            Form::Drawing => text.contains(paths::MARK),
        }
    }
}

impl Request {
    /// What the command line asks for; an error says what is wrong with it.
    pub fn new(options: &CommissionOptions) -> Result<Self, String> {
        let TrajectoryOptions { files, every, items } = &options.trajectories;
        let files = files
            .iter()
            .map(|path| {
                let form = Form::of(path).ok_or_else(|| {
                    format!("--trajectories {}: the name has to end in .csv, .json or .svg", path.display())
                })?;
                if path.metadata().is_ok_and(|there| !there.is_file()) {
                    return Err(format!("--trajectories {}: this is no file", path.display()));
                }
                let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
                if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
                    return Err(format!("--trajectories {}: there is no folder {}", path.display(), folder.display()));
                }
                let is_foreign = |text: Vec<u8>| {
                    !text.is_empty() && !String::from_utf8(text).is_ok_and(|text| form.is_own(&text))
                };
                if !options.build.force && fs::read(path).is_ok_and(is_foreign) {
                    return Err(format!(
                        "not written: {} is there and autogen did not write it; choose another name, or overwrite it with --force",
                        path.display()
                    ));
                }
                Ok((path.clone(), form))
            })
            .collect::<Result<_, String>>()?;
        let every_ms = milliseconds(every).ok_or_else(|| {
            format!("--every {every}: it takes seconds, 0.001 to 3600 in whole milliseconds")
        })?;
        Ok(Self { files, every_ms, items: items.clone() })
    }

    /// Whether the line has the items asked for.
    pub fn check(&self, line: &Line) -> Result<(), String> {
        let known = item::names(line);
        let Some(wrong) = self.items.iter().find(|name| !known.contains(name)) else { return Ok(()) };
        let kinds = line.kinds.iter().filter_map(|kind| {
            let of_kind = |name: &&String| name.rsplit_once('_').is_some_and(|(own, _)| own == kind.name);
            match known.iter().filter(of_kind).count() {
                0 => None,
                1 => Some(format!("{}_1", kind.name)),
                n => Some(format!("{}_1 to {}_{n}", kind.name, kind.name)),
            }
        });
        Err(format!("there is no item `{wrong}`; there are {}", kinds.collect::<Vec<_>>().join(", ")))
    }

    /// The options for the linked simulation that have it write into a temporary folder.
    pub fn ask(&self, command: &mut Command, folder: &Path) {
        let has = |form: Form| self.files.iter().any(|(_, own)| *own == form);
        if has(Form::Segments) {
            command.arg("--segments").arg(folder.join(SEGMENTS));
        }
        if has(Form::Table) {
            command.arg("--table").arg(folder.join(TABLE)).arg(self.every_ms.to_string());
        }
        if has(Form::Drawing) {
            command.arg("--table").arg(folder.join(DRAWN)).arg(DRAWN_EVERY_MS.to_string());
        }
        if !self.items.is_empty() {
            command.arg("--items").arg(self.items.join(","));
        }
    }

    /// Writes what the simulation has left in the temporary folder.
    pub fn write(&self, project: &Project, folder: &Path) -> Result<(), String> {
        let read = |name: &str| {
            let path = folder.join(name);
            fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))
        };
        for (path, form) in &self.files {
            let text = match form {
                Form::Table => read(TABLE)?,
                Form::Segments => read(SEGMENTS)? + "\n",
                Form::Drawing => paths::svg(project, &read(DRAWN)?),
            };
            fs::write(path, text).map_err(|e| format!("{}: {e}", path.display()))?;
        }
        Ok(())
    }
}

fn milliseconds(seconds: &str) -> Option<u64> {
    let ms = seconds.parse::<f64>().ok()? * 1000.0;
    ((ms - ms.round()).abs() < 1e-6 && (1.0..=3_600_000.0).contains(&ms)).then_some(ms.round() as u64)
}
