//! The paths of the items, written to files.

use runtime_sim::item;
use runtime_sim::line::Line;
use runtime_sim::path::{Path, segments_json, table_csv};
use std::fs;

/// Which paths are to be written, and where.
#[derive(Default)]
pub struct Trajectories {
    segments: Option<String>,
    /// Files and milliseconds.
    tables: Vec<(String, u64)>,
    /// Names; all items if there are none.
    items: Option<String>,
}

impl Trajectories {
    /// Takes an option of the command line and its values; false if the option is another's.
    pub fn take<'a>(&mut self, option: &str, rest: &mut impl Iterator<Item = &'a String>) -> Result<bool, String> {
        let mut value = || rest.next().cloned().ok_or_else(|| format!("`{option}` wants more"));
        match option {
            "--segments" => self.segments = Some(value()?),
            "--table" => {
                let file = value()?;
                let every_ms = value()?.parse().map_err(|e| format!("`--table` wants milliseconds: {e}"))?;
                self.tables.push((file, every_ms));
            }
            "--items" => self.items = Some(value()?),
            _ => return Ok(false),
        }
        Ok(true)
    }

    pub fn are_wanted(&self) -> bool {
        self.segments.is_some() || !self.tables.is_empty()
    }

    pub fn write(&self, line: &Line, paths: &[Path]) -> Result<(), String> {
        let items = self.chosen(line)?;
        let write = |file: &String, text: String| fs::write(file, text).map_err(|e| format!("{file}: {e}"));
        if let Some(file) = &self.segments {
            write(file, segments_json(line, paths, &items))?;
        }
        for (file, every_ms) in &self.tables {
            write(file, table_csv(line, paths, &items, *every_ms))?;
        }
        Ok(())
    }

    fn chosen(&self, line: &Line) -> Result<Vec<usize>, String> {
        let all = item::names(line);
        let Some(names) = &self.items else { return Ok((0..all.len()).collect()) };
        let find = |name: &str| {
            all.iter().position(|known| known == name).ok_or_else(|| format!("there is no item `{name}`"))
        };
        names.split(',').map(find).collect()
    }
}
