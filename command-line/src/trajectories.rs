//! The option `--trajectories`: what is asked for, and writing it.

use super::interrupt;
use super::options::{CommissionOptions, TrajectoryOptions};
use super::pending::{Content, Pending};
use autogen::backend::paths;
use autogen::lower::Project;
use runtime_sim::item;
use runtime_sim::line::Line;
use runtime_sim::path::{self, segments_json, table_csv};
use std::path::Path;

/// A drawing is made from samples so far apart.
const DRAWN_EVERY_MS: u64 = 20;

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
                Ok((Pending::new(path, content, options.build.overwrite().into())?, content))
            })
            .collect::<Result<_, String>>()?;
        let every_ms = milliseconds(every).ok_or_else(|| {
            format!("--every {every}: it takes seconds, 0.001 to 3600 in whole milliseconds")
        })?;
        Ok(Self { files, every_ms, items: items.clone() })
    }

    /// Whether the line has the items asked for.
    pub fn check(&self, line: &Line) -> Result<(), String> {
        let known = item::Names::new(line).all();
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

    /// No path is asked for.
    pub fn is_empty(&self) -> bool {
        self.files.is_empty()
    }

    /// Writes the paths of the items asked for, or of all that came onto the line: all files, or none. `paths` are those
    /// of all items of the supply.
    pub fn write(self, project: &Project, line: &Line, paths: &[path::Path]) -> Result<(), String> {
        let names = item::Names::new(line).all();
        let chosen: Vec<usize> = match self.items.is_empty() {
            true => (0..names.len()).filter(|item| !paths[*item].segments.is_empty()).collect(),
            false => self.items.iter().filter_map(|own| names.iter().position(|name| name == own)).collect(),
        };
        for (file, content) in &self.files {
            let text = match content {
                Content::PathSegments => segments_json(line, paths, &chosen) + "\n",
                Content::PathDrawing => paths::svg(project, &table_csv(line, paths, &chosen, DRAWN_EVERY_MS)),
                _ => table_csv(line, paths, &chosen, self.every_ms),
            };
            file.write(&text)?;
        }
        let _writing = interrupt::writing();
        self.files.into_iter().try_for_each(|(file, _)| file.keep())
    }
}

/// What `--every` says, if it is whole and within bounds.
pub fn milliseconds(seconds: &str) -> Option<u64> {
    let ms = seconds.parse::<f64>().ok()? * 1000.0;
    ((ms - ms.round()).abs() < 1e-6 && (1.0..=3_600_000.0).contains(&ms)).then_some(ms.round() as u64)
}
