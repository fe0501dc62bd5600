//! Renaming: the places that change, or why it cannot be done. What comes of it is checked before it is proposed: it has
//! no errors, and each name means what it meant.

use super::specs::{Specs, trees};
use crate::check;
use crate::check::names::{Number, What};
use crate::library;
use crate::lower::bind::{automaton_name, json_type};
use crate::source::{FileId, Sources, Span};
use crate::spec::parser::RESERVED;

/// A place and its new text.
pub type Edit = (Span, String);

/// The name at a place, if it can be renamed at all.
pub fn renamed_at(specs: &Specs, place: Span) -> Result<(Number, Span), String> {
    let (number, place) = specs.names.at(place).ok_or("there is no name here that can be renamed")?;
    for same in specs.names.same(number) {
        let declaration = &specs.names.declarations()[same];
        let Some(declared) = declaration.place else {
            let name = &declaration.name;
            return Err(match declaration.what {
                What::Member | What::Enumeration => {
                    format!("`{name}` is a kind of part, which the scenario names")
                }
                _ => format!("`{name}` is built into the language"),
            });
        };
        if is_of_library(specs, declared.file) {
            let name = &declaration.name;
            return Err(match same == number {
                true => format!("`{name}` is declared in the library, which is a part of autogen"),
                false => format!(
                    "`{name}` must have the name that it has in `{}` of the library",
                    declaration.owner
                ),
            });
        }
    }
    Ok((number, place))
}

/// All places in automata and the layout. Files of tests and tables are left alone.
pub fn rename(specs: &Specs, place: Span, new_name: &str) -> Result<Vec<Edit>, String> {
    let (number, _) = renamed_at(specs, place)?;
    let old_name = &specs.names.declarations()[number].name;
    is_name(new_name)?;
    if new_name == old_name {
        return Ok(Vec::new());
    }
    let same = specs.names.same(number);
    is_not_in_unread(specs, &same)?;
    let declared = same.iter().filter_map(|same| specs.names.declarations()[*same].place);
    let used = specs.names.uses().filter(|(_, used)| same.contains(used)).map(|(span, _)| span);
    let mut edits = Vec::new();
    for span in declared.chain(used) {
        let is_type = specs.layout.as_ref().is_some_and(|layout| layout.file == span.file)
            && specs.names.declarations()[number].what == What::Automaton;
        let (old_text, new_text) = match is_type {
            true => (json_type(old_name), json_type(new_name)),
            false => (old_name.clone(), new_name.to_string()),
        };
        if specs.sources.text(span) != old_text || is_type && automaton_name(&new_text) != new_name {
            let file = specs.sources.file(span.file);
            let (line, _) = specs.sources.position(span);
            let text = specs.sources.text(span);
            return Err(format!(
                "{}:{line} calls it `{text}`, which cannot be renamed to `{new_name}`",
                file.name
            ));
        }
        edits.push((span, new_text));
    }
    if specs.names.declarations()[number].what == What::Member
        && let Some(layout) = &specs.layout
        && specs.sources.file(layout.file).text.contains(&format!("\"{old_name}\""))
    {
        let file = &specs.sources.file(layout.file).name;
        return Err(format!("{file} may name `{old_name}` as a value: rename it there first"));
    }
    edits.sort();
    edits.dedup();
    proved(specs, &edits)?;
    Ok(edits)
}

/// Nothing is changed in a layout that cannot be read, so none that has the name may be left behind.
fn is_not_in_unread(specs: &Specs, numbers: &[Number]) -> Result<(), String> {
    let Some(layout) = specs.unread else { return Ok(()) };
    let file = specs.sources.file(layout);
    let words: Vec<&str> = file.text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').collect();
    for number in numbers {
        let declaration = &specs.names.declarations()[*number];
        let name = match declaration.what {
            What::Automaton => json_type(&declaration.name),
            What::Parameter | What::Key | What::Part | What::Member => declaration.name.clone(),
            _ => continue,
        };
        if words.contains(&name.as_str()) {
            return Err(format!("{} has `{name}` and cannot be read: correct it first", file.name));
        }
    }
    Ok(())
}

fn is_name(text: &str) -> Result<(), String> {
    let begins = text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    if !begins || text.contains(|c: char| !c.is_ascii_alphanumeric() && c != '_') {
        return Err(format!("`{text}` is not a name: a name has letters a to z, digits and underscores"));
    }
    if RESERVED.contains(&text) || text == "self" {
        return Err(format!("`{text}` is a word of the language"));
    }
    Ok(())
}

/// That what was right is right after the edits, and means the same.
fn proved(specs: &Specs, edits: &[Edit]) -> Result<(), String> {
    let before = meaning(specs, &specs.sources)
        .map_err(|why| format!("the files have errors, correct them first: {why}"))?;
    let mut sources = Sources::default();
    for (number, file) in specs.sources.files().iter().enumerate() {
        let of_file = edits.iter().filter(|(span, _)| span.file == FileId(number as u32));
        let mut text = file.text.clone();
        for (span, new_text) in of_file.rev() {
            text.replace_range(span.start as usize..span.end as usize, new_text);
        }
        sources.add(file.name.clone(), text);
    }
    match meaning(specs, &sources) {
        Ok(after) if after == before => Ok(()),
        Ok(_) => Err("another name would change its meaning: choose another one".into()),
        Err(why) => Err(why),
    }
}

/// The declaration of each name of the automata in the order of the text, or what is wrong first.
fn meaning(specs: &Specs, sources: &Sources) -> Result<Vec<Number>, String> {
    let files: Vec<FileId> = specs.files.iter().map(|(file, _)| *file).collect();
    let (trees, unread) = trees(sources, &files);
    if let Some(first) = unread.first() {
        return Err(first.message.clone());
    }
    if let Err(found) = check::check(sources, &trees, specs.kinds.as_deref()) {
        return Err(found.first().map_or_else(
            || "the kinds of part cannot be read: correct the scenario first".into(),
            |first| first.message.clone(),
        ));
    }
    Ok(check::names(sources, &trees, specs.kinds.as_deref()).uses().map(|(_, number)| number).collect())
}

fn is_of_library(specs: &Specs, file: FileId) -> bool {
    let name = &specs.sources.file(file).name;
    library::FILES.iter().any(|(known, _)| known == name)
}
