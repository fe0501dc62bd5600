//! Reading the files that a command and a layout name.

use super::named::{Folder, Unusable, automata};
use super::options::InputOptions;
use super::read::{self, Unread};
use autogen::diagnostic::{self, Diagnostic};
use autogen::layout;
use autogen::lower::{Input, Setting};
use autogen::source::{FileId, Sources, Span, Spanned};
use autogen::{library, scenario};
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// Why nothing could be compiled.
pub enum Failure {
    /// A file cannot be read.
    Unreadable(String),
    /// A file is too large, or its text is in another encoding.
    Unfit(String),
    /// What the command line says is wrong.
    Wrong(Sources, Vec<Diagnostic>),
    /// What the layout names cannot be read, or a file is not what it should be.
    Refused(Sources, Vec<Diagnostic>),
}

/// Bytes that all files of a line may have together.
const MOST_BYTES: usize = 20_000_000;
/// Files of automata that a line may have.
const MOST_SPECS: usize = 1000;
/// Names of a layout that cannot be used; more of them say nothing new.
const MOST_WRONG: usize = 100;

/// All texts of a compilation.
pub fn load(options: &InputOptions) -> Result<Input, Failure> {
    let mut sources = Sources::default();
    let Texts { layout, specs, scenario, .. } =
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

/// The layout of a line, and its other texts by their numbers in the sources.
pub struct Texts {
    pub layout: layout::Reading,
    pub layout_file: FileId,
    pub specs: Vec<FileId>,
    pub scenario: FileId,
}

/// Reads a layout, the library, the files and folders of types and the scenario. What is named here stands
/// above what the layout names. The layout names nothing outside of its own folder.
pub fn texts(
    sources: &mut Sources,
    path: &Path,
    given: &[PathBuf],
    scenario: Option<&Path>,
) -> Result<Texts, Failure> {
    let layout = object(sources, path, "layout")?;
    texts_of(sources, path, layout, given, scenario)
}

/// The same of a layout whose text has been read; the path says where it stands.
pub fn texts_of(
    sources: &mut Sources,
    path: &Path,
    layout: FileId,
    given: &[PathBuf],
    scenario: Option<&Path>,
) -> Result<Texts, Failure> {
    let mut specs: Vec<FileId> =
        library::FILES.iter().map(|(name, text)| sources.add(*name, *text)).collect();
    // What is wrong with the layout the compiler reports; here only the files it names are of interest.
    let mut reading = layout::parse(sources, layout);
    let (named, found) = &mut reading;
    if found.iter().any(|d| d.code == layout::OUTSIDE) {
        return Err(Failure::Refused(std::mem::take(sources), reading.1));
    }
    let folder = Folder::of(path);
    let mut wrong = Vec::new();
    for name in named.iter().flat_map(|l| &l.specs) {
        match folder.automata(&name.value) {
            Ok(files) => {
                for (name, text) in files {
                    add_spec(sources, &mut specs, name, text)?;
                }
            }
            Err(why) => wrong.push(unusable("specs", name, &why)),
        }
        if wrong.len() == MOST_WRONG {
            break;
        }
    }
    for path in given {
        for path in automata(path).map_err(|why| unreadable(path, &why))? {
            let text = text(&path)?;
            add_spec(sources, &mut specs, path.display().to_string(), text)?;
        }
    }
    let scenario = match (scenario, named.as_ref().and_then(|l| l.scenario.as_ref())) {
        (Some(path), _) => object(sources, path, "scenario")?,
        (None, Some(name)) => match folder.object(&name.value) {
            Ok((name, text)) => add_text(sources, name, text)?,
            Err(why) => {
                wrong.push(unusable("scenario", name, &why));
                layout
            }
        },
        (None, None) if folder.has(SCENARIO) => {
            let (name, text) = folder.object(SCENARIO).map_err(|why| {
                let given = "give another one by --scenario";
                Failure::Unreadable(format!("{}: {why}; {given}", folder.0.join(SCENARIO).display()))
            })?;
            add_text(sources, name, text)?
        }
        (None, None) => sources.add(scenario::BUILT_IN, scenario::DEFAULT),
    };
    if !wrong.is_empty() {
        found.extend(wrong);
        diagnostic::sort(found);
        return Err(Failure::Refused(std::mem::take(sources), reading.1));
    }
    Ok(Texts { layout: reading, layout_file: layout, specs, scenario })
}

/// The scenario of a layout that names none.
const SCENARIO: &str = "scenario.json";

/// A setting from the command line.
pub fn setting(sources: &mut Sources, text: &str) -> Result<Setting, Vec<Diagnostic>> {
    let file = sources.add("--set", text);
    Setting::parse(sources, file)
}

pub fn add(sources: &mut Sources, path: &Path) -> Result<FileId, Failure> {
    let text = text(path)?;
    add_text(sources, path.display().to_string(), text)
}

/// A table that a person has filled, with nothing of it lost.
pub fn table(sources: &mut Sources, path: &Path) -> Result<FileId, Failure> {
    let text = text_of_table(path)?;
    add_text(sources, path.display().to_string(), text)
}

pub fn text_of_table(path: &Path) -> Result<String, Failure> {
    read::utf_8(path).map_err(|why| unread(path, &why))
}

pub fn text(path: &Path) -> Result<String, Failure> {
    read::text(path).map_err(|why| unread(path, &why))
}

fn add_text(sources: &mut Sources, name: String, text: String) -> Result<FileId, Failure> {
    let bytes: usize = sources.files().iter().map(|file| file.text.len()).sum();
    if bytes + text.len() > MOST_BYTES {
        let most = MOST_BYTES / 1_000_000;
        return Err(Failure::Unreadable(format!(
            "{name}: with this file the line has more than {most} MB of text, which is the limit"
        )));
    }
    Ok(sources.add(name, text))
}

fn add_spec(
    sources: &mut Sources,
    specs: &mut Vec<FileId>,
    name: String,
    text: String,
) -> Result<(), Failure> {
    if specs.len() == MOST_SPECS {
        return Err(Failure::Unreadable(format!(
            "{name}: with this file the line has more than {MOST_SPECS} files of automata, which is the limit"
        )));
    }
    specs.push(add_text(sources, name, text)?);
    Ok(())
}

/// A file of JSON that the command line names. Text of a file of another kind is not shown.
fn object(sources: &mut Sources, path: &Path, what: &str) -> Result<FileId, Failure> {
    let text = text(path)?;
    let name = path.display().to_string();
    if begins_as_object(&text) {
        return add_text(sources, name, text);
    }
    let file = sources.add(name, "");
    let diagnostic = Diagnostic::new("E0109", Span::new(file, 0, 0), format!("this file is not a {what}"))
        .note("it does not begin with `{`, so its content is not shown")
        .help(format!("name the file of a {what}: one JSON object in braces"));
    Err(Failure::Refused(std::mem::take(sources), vec![diagnostic]))
}

/// Whether it begins as an object of JSON, or holds nothing.
pub fn begins_as_object(text: &str) -> bool {
    let text = text.trim_start_matches(|c: char| c.is_whitespace() || c == '\u{feff}');
    text.is_empty() || text.starts_with('{')
}

/// What a layout names that cannot be used.
fn unusable(key: &str, name: &Spanned<String>, why: &Unusable) -> Diagnostic {
    let (code, help) = match why {
        Unusable::LeadsOut | Unusable::LinkLeadsOut(_) => {
            (layout::OUTSIDE, format!("put it into the folder of the layout, or give it by --{key}"))
        }
        _ => ("E0141", format!("correct \"{key}\", or remove it and give --{key}")),
    };
    Diagnostic::new(code, name.span, format!("`{key}` names \"{}\", which cannot be used", name.value))
        .label(why.to_string())
        .help(help)
}

fn unread(path: &Path, why: &Unread) -> Failure {
    match why.is_content() {
        true => Failure::Unfit(format!("{}: {why}", path.display())),
        false => unreadable(path, why),
    }
}

fn unreadable(path: &Path, why: &impl Display) -> Failure {
    Failure::Unreadable(format!("{}: {why}", path.display()))
}
