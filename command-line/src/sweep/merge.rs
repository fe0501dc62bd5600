//! `autogen merge`: the parts of a sweep become the table of the whole.
//!
//! The files are read twice: once to find out what is wrong with them, and again for the table. So nothing is printed
//! of parts that do not make a sweep, and no more than a line of each is held.

use super::super::load::Failure;
use super::super::options::MergeOptions;
use super::super::print;
use super::head::{COMMON, Head};
use super::page::Request;
use super::part::Part;
use super::part_file::{Line, PartFile, outcome};
use super::plan::Refusal;
use super::{facts, format, not_planned, shown, status_of_page};
use crate::Status;
use autogen::diagnostic::{Diagnostic, collect};
use autogen::source::{Sources, Span};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

pub fn run(options: &MergeOptions) -> Status {
    match merge(options) {
        Ok(status) => status,
        Err(Refusal::Failure(failure)) => print::failure_in(format(&options.table), &failure),
        Err(refusal @ Refusal::Said(_)) => not_planned(&options.table, &refusal),
    }
}

/// A part that was read, and where it was found.
struct Found<'a> {
    path: &'a Path,
    head: Head,
}

fn merge(options: &MergeOptions) -> Result<Status, Refusal> {
    let parts = parts(&options.parts).map_err(Refusal::Failure)?;
    let Some(first) = parts.first() else { return Ok(Status::Done) };
    let Head { design, about, .. } = &first.head;
    let page = Request::new(options.report.as_deref(), None, design).map_err(Refusal::Said)?;
    let mut rows = shown(design, &options.table, page.as_ref())?;
    let mut files = Vec::new();
    for part in &parts {
        let mut file = PartFile::open(part.path).map_err(Refusal::Failure)?;
        file.line().map_err(Refusal::Failure)?;
        files.push(file);
    }
    for index in 0..design.runs().unwrap_or(0) {
        let number = Part::having(design, index, parts.len());
        let line = match files[number].line().map_err(Refusal::Failure)? {
            Line::Text(text) => outcome(&text, &parts[number].head, index),
            Line::End | Line::Broken => Err("it ends".into()),
        };
        let outcome = line.map_err(|why| {
            let path = parts[number].path.display();
            Refusal::Said(format!("{path}: it was changed while it was read: {why}"))
        })?;
        rows.take(design.run(index), outcome);
    }
    let (status, table) = rows.end();
    let Some((page, table)) = page.zip(table) else { return Ok(status) };
    let facts = facts::of_sweep(design, about, None, &options.table);
    Ok(status_of_page(status, page.write(design, facts, table, BTreeMap::new())))
}

/// All parts of one sweep, in the order of their numbers.
fn parts(paths: &[PathBuf]) -> Result<Vec<Found<'_>>, Failure> {
    let mut sources = Sources::default();
    let mut wrong = Vec::new();
    let mut parts: Vec<Found> = Vec::new();
    for path in paths {
        let mut file = PartFile::open(path)?;
        let head = match file.head(&mut sources)? {
            Ok(head) => head,
            Err(diagnostic) => {
                collect(&mut wrong, diagnostic);
                continue;
            }
        };
        let clash = parts.first().and_then(|first| of_another_sweep(&mut sources, path, &head, first));
        let clash = clash.or_else(|| given_twice(&mut sources, path, &head, &parts));
        if let Some(diagnostic) = clash {
            collect(&mut wrong, diagnostic);
            continue;
        }
        if let Err(diagnostic) = file.check(&head, &mut sources)? {
            collect(&mut wrong, diagnostic);
        }
        parts.push(Found { path, head });
    }
    parts.sort_by_key(|part| part.head.part.number());
    wrong.extend(missing(&mut sources, &parts));
    if wrong.is_empty() { Ok(parts) } else { Err(Failure::Refused(sources, wrong)) }
}

/// The beginning of a file of which nothing is shown.
fn place(sources: &mut Sources, path: &Path) -> Span {
    Span::new(sources.add(path.display().to_string(), ""), 0, 0)
}

fn of_another_sweep(sources: &mut Sources, path: &Path, head: &Head, first: &Found) -> Option<Diagnostic> {
    let (_, what) = COMMON.iter().find(|(key, _)| head.json.get(*key) != first.head.json.get(*key))?;
    let (file, other) = (path.display(), first.path.display());
    let message = format!("{file} is a part of another sweep than {other}: {what}");
    Some(
        Diagnostic::new("E0804", place(sources, path), message)
            .note("the layouts, types, scenario, options and autogen of all parts have to be the same, by their hashes")
            .help("merge the parts of each sweep separately, or run this part again with the options of the others"),
    )
}

fn given_twice(sources: &mut Sources, path: &Path, head: &Head, parts: &[Found]) -> Option<Diagnostic> {
    let other = parts.iter().find(|other| other.head.part == head.part)?;
    let message =
        format!("part {} is given twice: {} and {}", head.part, other.path.display(), path.display());
    Some(Diagnostic::new("E0805", place(sources, path), message).help("name one of the two files"))
}

/// Numbers of missing parts that are reported.
const MOST_TOLD: usize = 20;

fn missing(sources: &mut Sources, parts: &[Found]) -> Option<Diagnostic> {
    let first = parts.first()?;
    let of = first.head.part.of();
    let numbers: Vec<usize> =
        (1..=of).filter(|number| !parts.iter().any(|part| part.head.part.number() == *number)).collect();
    let next = numbers.first()?;
    let told: Vec<String> = numbers.iter().take(MOST_TOLD).map(usize::to_string).collect();
    let more = if numbers.len() > MOST_TOLD { " and so on" } else { "" };
    let missing = numbers.len();
    let message = format!("{missing} of {of} parts missing: {}{more}", told.join(", "));
    Some(
        Diagnostic::new("E0806", place(sources, first.path), message)
            .note("a table has all runs of a sweep or none")
            .help(format!("name their files too, or run them: --part {next}/{of}")),
    )
}
