//! Reading the files that a command names.

use super::options::InputOptions;
use autogen::diagnostic::Diagnostic;
use autogen::layout::{self, Layout};
use autogen::lower::{Input, Setting};
use autogen::source::{FileId, Sources};
use autogen::{library, scenario};
use std::path::{Path, PathBuf};

/// Why nothing could be compiled.
pub enum Failure {
    /// A file cannot be read.
    Unreadable(String),
    /// What the command line says is wrong.
    Wrong(Sources, Vec<Diagnostic>),
}

/// All texts of a compilation.
pub fn load(options: &InputOptions) -> Result<Input, Failure> {
    let mut sources = Sources::default();
    let Texts { layout, specs, scenario } =
        texts(&mut sources, &options.layout, &options.specs, options.scenario.as_deref())?;
    let mut settings = Vec::new();
    let mut diagnostics = Vec::new();
    for text in &options.settings {
        match setting(&mut sources, text) {
            Ok(setting) => settings.push(setting),
            Err(found) => diagnostics.extend(found),
        }
    }
    if !diagnostics.is_empty() {
        return Err(Failure::Wrong(sources, diagnostics));
    }
    Ok(Input { sources, layout, specs, scenario, settings, order: options.order })
}

/// The texts of a line, by their numbers in the sources.
pub struct Texts {
    pub layout: FileId,
    pub specs: Vec<FileId>,
    pub scenario: FileId,
}

/// Reads a layout, the library, the folders of types and the scenario. What is named here stands above what
/// the layout names.
pub fn texts(
    sources: &mut Sources,
    path: &Path,
    folders: &[PathBuf],
    scenario: Option<&Path>,
) -> Result<Texts, Failure> {
    let layout = add(sources, path)?;
    let mut specs: Vec<FileId> =
        library::FILES.iter().map(|(name, text)| sources.add(*name, *text)).collect();
    // What is wrong with the layout the compiler reports; here only the files it names are of interest.
    let named = layout::parse(sources, layout).0;
    let beside = |name: &str| path.parent().unwrap_or(Path::new("")).join(name);
    let folders = named_specs(&named).into_iter().map(|name| beside(&name)).chain(folders.iter().cloned());
    for folder in folders {
        for path in automata(&folder)? {
            specs.push(add(sources, &path)?);
        }
    }
    let scenario = match (scenario, named.and_then(|l| l.scenario)) {
        (Some(path), _) => add(sources, path)?,
        (None, Some(name)) => add(sources, &beside(&name.value))?,
        (None, None) if beside("scenario.json").is_file() => add(sources, &beside("scenario.json"))?,
        (None, None) => sources.add("built-in scenario", scenario::DEFAULT),
    };
    Ok(Texts { layout, specs, scenario })
}

/// A setting from the command line.
pub fn setting(sources: &mut Sources, text: &str) -> Result<Setting, Vec<Diagnostic>> {
    let file = sources.add("--set", text);
    Setting::parse(sources, file)
}

fn named_specs(layout: &Option<Layout>) -> Vec<String> {
    layout.iter().flat_map(|l| l.specs.iter().map(|s| s.value.clone())).collect()
}

/// The automata of a folder in the order of their names.
fn automata(path: &Path) -> Result<Vec<PathBuf>, Failure> {
    let entries = std::fs::read_dir(path).map_err(|e| unreadable(path, &e))?;
    let mut files = Vec::new();
    for entry in entries {
        let path = entry.map_err(|e| unreadable(path, &e))?.path();
        if path.extension().is_some_and(|e| e == "aut") {
            files.push(path);
        }
    }
    files.sort();
    if files.is_empty() {
        return Err(Failure::Unreadable(format!("{}: this folder holds no *.aut file", path.display())));
    }
    Ok(files)
}

pub fn add(sources: &mut Sources, path: &Path) -> Result<FileId, Failure> {
    Ok(sources.add(path.display().to_string(), text(path)?))
}

/// Without a byte order mark; what is no UTF-8 is replaced. UTF-16 is refused: nothing in it could be read.
pub fn text(path: &Path) -> Result<String, Failure> {
    let bytes = std::fs::read(path).map_err(|e| unreadable(path, &e))?;
    if is_utf_16(&bytes) {
        return Err(Failure::Unreadable(format!(
            "{}: this file is UTF-16, and only UTF-8 is read. Save it again as UTF-8: a spreadsheet calls it \
             `CSV UTF-8`, Notepad `Encoding: UTF-8`, PowerShell `Out-File -Encoding utf8`",
            path.display()
        )));
    }
    let text = String::from_utf8_lossy(&bytes);
    Ok(text.strip_prefix('\u{feff}').unwrap_or(&text).into())
}

/// By its byte order mark, or since each second byte of what begins it is 0.
fn is_utf_16(bytes: &[u8]) -> bool {
    match *bytes {
        [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] => true,
        [a, b, c, d, ..] => (a == 0) != (b == 0) && (a == 0) == (c == 0) && (b == 0) == (d == 0),
        _ => false,
    }
}

fn unreadable(path: &Path, error: &std::io::Error) -> Failure {
    Failure::Unreadable(format!("{}: {error}", path.display()))
}
