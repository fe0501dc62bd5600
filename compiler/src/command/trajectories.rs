//! The option `--trajectories`: what is asked for, and writing it.

use super::interrupt;
use super::options::{CommissionOptions, TrajectoryOptions};
use super::pending::{Content, Pending};
use autogen::backend::paths;
use autogen::lower::Project;
use runtime_sim::item;
use runtime_sim::line::Line;
use std::fs;
use std::path::Path;
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
    files: Vec<(Pending, Content)>,
    every_ms: u64,
    items: Vec<String>,
}

/// What a name asks for by its end.
fn content(path: &Path) -> Option<Content> {
    match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
        "csv" => Some(Content::PathTable),
        "json" => Some(Content::PathSegments),
        "svg" => Some(Content::PathDrawing),
        _ => None,
    }
}

impl Request {
    /// What the command line asks for; an error says what is wrong with it.
    pub fn new(options: &CommissionOptions) -> Result<Self, String> {
        let TrajectoryOptions { files, every, items } = &options.trajectories;
        let files = files
            .iter()
            .map(|path| {
                let content = content(path).ok_or_else(|| {
                    format!("--trajectories {}: the name has to end in .csv, .json or .svg", path.display())
                })?;
                Ok((Pending::new(path, content, options.build.overwrite())?, content))
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
        let has = |content: Content| self.files.iter().any(|(_, own)| *own == content);
        if has(Content::PathSegments) {
            command.arg("--segments").arg(folder.join(SEGMENTS));
        }
        if has(Content::PathTable) {
            command.arg("--table").arg(folder.join(TABLE)).arg(self.every_ms.to_string());
        }
        if has(Content::PathDrawing) {
            command.arg("--table").arg(folder.join(DRAWN)).arg(DRAWN_EVERY_MS.to_string());
        }
        if !self.items.is_empty() {
            command.arg("--items").arg(self.items.join(","));
        }
    }

    /// Writes what the simulation has left in the temporary folder: all files, or none.
    pub fn write(self, project: &Project, folder: &Path) -> Result<(), String> {
        let read = |name: &str| {
            let path = folder.join(name);
            fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))
        };
        let _writing = interrupt::writing();
        for (file, content) in &self.files {
            let text = match content {
                Content::PathSegments => read(SEGMENTS)? + "\n",
                Content::PathDrawing => paths::svg(project, &read(DRAWN)?),
                _ => read(TABLE)?,
            };
            fs::write(file.partial(), text).map_err(|e| format!("{}: {e}", file.path().display()))?;
        }
        self.files.into_iter().try_for_each(|(file, _)| file.keep())
    }
}

/// What `--every` says, if it is whole and within bounds.
pub fn milliseconds(seconds: &str) -> Option<u64> {
    let ms = seconds.parse::<f64>().ok()? * 1000.0;
    ((ms - ms.round()).abs() < 1e-6 && (1.0..=3_600_000.0).contains(&ms)).then_some(ms.round() as u64)
}
