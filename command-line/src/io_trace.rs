//! The option `--io-trace`: a row for each scan, written while the run continues.

use super::pending::Pending;
use runtime_sim::io_trace::Columns;
use runtime_sim::run::Seen;
use std::io::{self, Write};

/// Bytes that are written at once.
const PORTION: usize = 1 << 16;

pub struct IoTrace {
    columns: Columns,
    file: Pending,
    text: String,
    written: io::Result<()>,
}

impl IoTrace {
    pub fn new(columns: &str, file: Pending) -> Result<Self, String> {
        let columns = Columns::from_text(columns)?;
        let text = columns.header();
        Ok(Self { columns, file, text, written: Ok(()) })
    }

    /// After an error nothing more is written.
    pub fn take(&mut self, seen: &Seen) {
        if self.written.is_ok() {
            self.columns.row(seen, &mut self.text);
            if self.text.len() >= PORTION {
                self.written = self.file.file().write_all(self.text.as_bytes());
                self.text.clear();
            }
        }
    }

    /// The run is over, and all was written.
    pub fn end(self) -> Result<(), String> {
        self.written.map_err(|e| format!("{}: {e}", self.file.path().display()))?;
        self.file.write(&self.text)?;
        self.file.keep()
    }
}
