//! `autogen build --check`: whether a folder holds what would be written now.

use super::build::{self, Built};
use super::options::{BuildOptions, Format};
use super::output::{self, Comparison, Difference, Kind};
use super::{diff, read};
use crate::Status;
use serde_json::json;

/// Differences that are shown line by line.
const MOST_SHOWN: usize = 5;
/// Files that are named.
const MOST_NAMED: usize = 50;

pub fn run(options: &BuildOptions, built: &Built) -> Status {
    let found = build::is_where_it_seems(options, built)
        .and_then(|()| output::compare(&built.folder, |files| built.write(files), built.about.clone()));
    let Comparison { files, differences: found } = match found {
        Ok(found) => found,
        Err(refusal) => return build::refused(options, &refusal),
    };
    match options.input.format {
        Format::Json => say_json(built, &found),
        Format::Text => say_text(options, built, files, &found),
    }
    if found.is_empty() { Status::Done } else { Status::WrongInput }
}

fn word(kind: &Kind) -> &'static str {
    match kind {
        Kind::Missing => "missing",
        Kind::Changed(_) => "differs",
        Kind::Left => "no longer written",
    }
}

fn say_json(built: &Built, found: &[Difference]) {
    let files: Vec<_> = found.iter().map(|d| json!({ "file": d.name, "is": word(&d.kind) })).collect();
    say!(
        "{}",
        json!({ "same": found.is_empty(), "folder": built.folder.display().to_string(), "differences": files, "diagnostics": [] })
    );
}

fn say_text(options: &BuildOptions, built: &Built, files: usize, found: &[Difference]) {
    let folder = built.folder.display();
    if found.is_empty() {
        if !options.input.quiet {
            say!("{} files in {folder} are the same as would be written now", files);
        }
        return;
    }
    if !built.folder.exists() {
        say!("there is no folder {folder}; write it with `autogen build`");
        return;
    }
    for Difference { name, kind } in found.iter().take(MOST_NAMED) {
        say!("{:17}  {name}", word(kind));
    }
    if found.len() > MOST_NAMED {
        say!("and {} more", found.len() - MOST_NAMED);
    }
    let texts = found.iter().filter_map(|d| match &d.kind {
        // The hashes of the manifest say nothing that other files do not say.
        Kind::Changed(text) if d.name != output::MANIFEST || found.len() == 1 => Some((&d.name, text)),
        _ => None,
    });
    for (name, text) in texts.take(MOST_SHOWN) {
        match read::text(&built.folder.join(name)) {
            Ok(old) => say_part!(
                "\n--- {name} in the folder\n+++ {name} as it would be written\n{}",
                diff::short(&old, text)
            ),
            Err(why) => say!("\n{name}: {why}"),
        }
    }
    say!("\n{} in {folder}; write them with `autogen build`", counted(found.len()));
}

fn counted(differences: usize) -> String {
    match differences {
        1 => "1 file differs".into(),
        n => format!("{n} files differ"),
    }
}
