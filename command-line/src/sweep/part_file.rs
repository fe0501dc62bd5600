//! The file of a part, line by line: it may be larger than memory.

use super::head::Head;
use super::outcome::Outcome;
use crate::load::Failure;
use crate::read;
use autogen::diagnostic::Diagnostic;
use autogen::source::{Sources, Span};
use serde_json::Value;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

/// Bytes that a line may have; a run without diagnostics has less than a thousandth of it.
const LONGEST: u64 = 10_000_000;

pub struct PartFile {
    name: String,
    bytes: BufReader<File>,
    /// Lines read so far.
    lines: usize,
}

/// A line of a part's file.
pub enum Line {
    Text(String),
    /// There is none any more.
    End,
    /// It has no end, or is too long.
    Broken,
}

impl PartFile {
    pub fn open(path: &Path) -> Result<Self, Failure> {
        let name = path.display().to_string();
        match read::regular(path) {
            Ok(file) => Ok(Self { name, bytes: BufReader::new(file), lines: 0 }),
            Err(why) => Err(Failure::Unreadable(format!("{name}: {why}"))),
        }
    }

    pub fn line(&mut self) -> Result<Line, Failure> {
        let mut line = Vec::new();
        let read = (&mut self.bytes).take(LONGEST + 1).read_until(b'\n', &mut line);
        read.map_err(|e| Failure::Unreadable(format!("{}: {e}", self.name)))?;
        self.lines += 1;
        Ok(match line.pop() {
            None => Line::End,
            Some(b'\n') => Line::Text(String::from_utf8_lossy(&line).into_owned()),
            Some(_) => Line::Broken,
        })
    }

    /// The first line; what is wrong if it is not that of a part.
    pub fn head(&mut self, sources: &mut Sources) -> Result<Result<Head, Diagnostic>, Failure> {
        if let Line::Text(text) = self.line()?
            && let Some(head) = Head::parse(&text)
        {
            return Ok(Ok(head));
        }
        // Nothing of a file of another kind is shown.
        let place = Span::new(sources.add(self.name.as_str(), ""), 0, 0);
        Ok(Err(Diagnostic::new("E0801", place, format!("{} is not a part of a sweep", self.name))
            .note("the first line of a part says which part of which sweep it is")
            .help("name files that `autogen sweep --part K/N` wrote")))
    }

    /// Whether all lines are those of the runs of this part, and none is missing. What is wrong is said once.
    pub fn check(&mut self, head: &Head, sources: &mut Sources) -> Result<Result<(), Diagnostic>, Failure> {
        let again = format!("run it again: --part {}", head.part);
        for (done, index) in head.part.runs(&head.design).enumerate() {
            let text = match self.line()? {
                Line::Text(text) => text,
                Line::End | Line::Broken => {
                    let all = head.part.runs(&head.design).count();
                    let message = format!("part {} ends after {done} of its {all} runs", head.part);
                    return Ok(Err(Diagnostic::new("E0803", self.place(sources, ""), message)
                        .note("it was interrupted, or is not finished")
                        .help(again)));
                }
            };
            if let Err(what) = outcome(&text, head, index) {
                let number = head.design.run(index);
                let (point, replication) = (number.point + 1, number.replication + 1);
                let message = format!(
                    "this is not the result of part {} for point {point}, replication {replication}: {what}",
                    head.part
                );
                return Ok(Err(Diagnostic::new("E0802", self.place(sources, &text), message)
                    .note("the file was changed, or two processes wrote into it")
                    .help(again)));
            }
        }
        match self.line()? {
            Line::End => Ok(Ok(())),
            Line::Text(_) | Line::Broken => {
                let message = format!("part {} continues after its last run", head.part);
                Ok(Err(Diagnostic::new("E0803", self.place(sources, ""), message)
                    .note("the file was changed, or two processes wrote into it")
                    .help(again)))
            }
        }
    }

    /// The line that was read last, or its beginning if nothing of it is to be shown.
    fn place(&self, sources: &mut Sources, text: &str) -> Span {
        let before = self.lines.saturating_sub(1);
        let file = sources.add(self.name.as_str(), format!("{}{text}", "\n".repeat(before)));
        Span::new(file, before, before + text.len())
    }
}

/// What came of the run with this index; an error says what is wrong with the line.
pub fn outcome(line: &str, head: &Head, index: usize) -> Result<Outcome, String> {
    match serde_json::from_str(line) {
        Ok(Value::Object(line)) => {
            let outcome = Outcome::from_line(&line, &head.design, head.design.run(index));
            outcome.map_err(|key| format!("`{key}` is different"))
        }
        Ok(_) => Err("it is not an object".into()),
        Err(error) => Err(format!("it is not JSON ({error})")),
    }
}
