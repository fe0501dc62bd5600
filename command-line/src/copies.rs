//! Copies of all texts of which a line is built, in its output: the build can be repeated without anything else.

use super::named::automata;
use super::options::{Addresses, BuildOptions};
use super::titles::{apart, is_found, title};
use autogen::backend::Files;
use autogen::library;
use autogen::plain;
use autogen::scenario;
use autogen::source::{SourceFile, Sources};
use clap::ValueEnum;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The folder of what was given; the library stands beside it.
const FOLDER: &str = "sources";

pub struct Copies {
    pub files: Files,
    /// The command that builds the same again in [`FOLDER`].
    pub command: String,
    /// What the layout names, and its copy, if the copy of the layout does not lead to it.
    pub not_found: Vec<(String, String)>,
}

/// `sources` have the names under which they were read.
pub fn copies(options: &BuildOptions, sources: &Sources) -> Copies {
    let mut files: Files =
        library::FILES.iter().map(|(name, text)| (name.to_string(), text.to_string())).collect();
    let mut names: BTreeMap<&str, String> = BTreeMap::new();
    let mut taken = BTreeSet::new();
    for file in sources.files().iter().filter(|file| is_given(file)) {
        let copy = names
            .entry(&file.name)
            .or_insert_with(|| apart(title(&options.input.layout, &file.name), &mut taken));
        files.insert(format!("{FOLDER}/{copy}"), file.text.clone());
    }
    let name = |path: &Path| plain::line(&path.display().to_string());
    let copy = |path: &Path| argument(names.get(&*name(path)).cloned().unwrap_or_default());
    let specs = options.input.specs.iter().flat_map(|path| automata(path).unwrap_or_default());
    let specs: Vec<PathBuf> = specs.collect();
    let others = [&options.input.scenario, &options.io, &options.texts].into_iter().flatten();
    let of_command: BTreeSet<String> =
        specs.iter().chain(others).chain([&options.input.layout]).map(|path| name(path)).collect();
    let of_layout = names.iter().filter(|(name, _)| !of_command.contains(**name));
    let not_found = of_layout
        .filter(|(name, copy)| !is_found(&options.input.layout, name, copy))
        .map(|(name, copy)| (name.to_string(), copy.clone()))
        .collect();
    let mut words = vec!["autogen".into(), "build".into(), copy(&options.input.layout)];
    let mut option = |name: &str, value: String| words.extend([format!("--{name}"), value]);
    specs.iter().for_each(|file| option("specs", copy(file)));
    if let Some(path) = &options.input.scenario {
        option("scenario", copy(path));
    }
    options.input.settings.iter().for_each(|setting| option("set", setting.clone()));
    if let Some(seed) = options.input.order {
        option("order", seed.to_string());
    }
    if let Some(path) = &options.io {
        option("io", copy(path));
        option("addresses", counted(options.addresses));
    }
    if let Some(path) = &options.texts {
        option("texts", copy(path));
    }
    words.extend(options.no_plcopen.then(|| "--no-plcopen".into()));
    words.extend(options.drives.then(|| "--drives".into()));
    let command = words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ");
    Copies { files, command, not_found }
}

/// Whether somebody gave it as a file.
fn is_given(file: &SourceFile) -> bool {
    !library::has(file) && file.name != "--set" && file.name != scenario::BUILT_IN
}

fn counted(addresses: Addresses) -> String {
    addresses.to_possible_value().map_or_else(String::new, |value| value.get_name().into())
}

/// A path that is taken for no option.
pub fn argument(path: String) -> String {
    if path.starts_with('-') { format!("./{path}") } else { path }
}

/// A word as a shell takes it.
pub fn quoted(text: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "/._-+:=,".contains(c) || cfg!(windows) && c == '\\';
    match !text.is_empty() && text.chars().all(is_plain) {
        true => text.into(),
        false => format!("'{}'", text.replace('\'', "'\\''")),
    }
}
