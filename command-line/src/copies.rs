//! Copies of all texts of which a line is built, in its output: the build can be repeated without anything else.

use super::build::{apart, title};
use super::named::automata;
use super::options::{Addresses, BuildOptions};
use super::output::is_within;
use autogen::backend::Files;
use autogen::library;
use autogen::plain;
use autogen::scenario;
use autogen::source::{SourceFile, Sources};
use clap::ValueEnum;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The folder of what was given; the library stands beside it.
const FOLDER: &str = "sources";

pub struct Copies {
    pub files: Files,
    /// The command that builds the same again in [`FOLDER`].
    pub command: String,
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
        // A name that no manifest takes: on other systems it leads elsewhere.
        if is_within(copy) {
            files.insert(format!("{FOLDER}/{copy}"), file.text.clone());
        }
    }
    let copy = |path: &Path| {
        let name = names.get(&*plain::line(&path.display().to_string())).cloned().unwrap_or_default();
        // It would be taken for an option.
        if name.starts_with('-') { format!("./{name}") } else { name }
    };
    let mut words = vec!["autogen".into(), "build".into(), copy(&options.input.layout)];
    let mut option = |name: &str, value: String| words.extend([format!("--{name}"), value]);
    for file in options.input.specs.iter().flat_map(|path| automata(path).unwrap_or_default()) {
        option("specs", copy(&file));
    }
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
    Copies { files, command: words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ") }
}

/// Whether somebody gave it as a file.
fn is_given(file: &SourceFile) -> bool {
    !library::has(file) && file.name != "--set" && file.name != scenario::BUILT_IN
}

fn counted(addresses: Addresses) -> String {
    addresses.to_possible_value().map_or_else(String::new, |value| value.get_name().into())
}

/// A word as a shell takes it.
pub fn quoted(text: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "/\\._-+:=,".contains(c);
    match !text.is_empty() && text.chars().all(is_plain) {
        true => text.into(),
        false => format!("'{}'", text.replace('\'', "'\\''")),
    }
}
