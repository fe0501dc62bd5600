//! Texts of screens in other languages: a table that a person fills in a spreadsheet.
//!
//! The table is `plc/texts.csv` as `build` writes it, with a column for each language behind the others. An empty
//! field leaves the text as it is.

use crate::csv::{self, Field};
use crate::diagnostic::{self, Diagnostic};
use crate::plain;
use crate::source::{FileId, Sources, Span};
use std::collections::{BTreeMap, BTreeSet};

/// The column of the texts as the specification has them.
pub const TEXT: &str = "text";
/// The column that says what a text is.
pub const USE: &str = "use";
/// More languages than a plant has.
const MOST_LANGUAGES: usize = 30;

/// The texts of one language.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Language {
    /// Such as `de` or `pt-BR`, as written.
    pub tag: String,
    texts: BTreeMap<String, String>,
}

/// The languages of a table. Only [`read`] makes some, so no tag is there twice, whatever its case.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Translations {
    pub languages: Vec<Language>,
    /// Texts of the table that were not asked for.
    pub strangers: Vec<String>,
}

impl Language {
    /// The text in this language; as it is, if the table has none.
    pub fn text<'t>(&'t self, text: &'t str) -> &'t str {
        self.texts.get(text).map_or(text, String::as_str)
    }

    pub fn has(&self, text: &str) -> bool {
        self.texts.contains_key(text)
    }
}

/// The table of a person against the texts of a line. All that is wrong with it is reported at once.
pub fn read(
    sources: &Sources,
    file: FileId,
    texts: &BTreeSet<&str>,
) -> Result<Translations, Vec<Diagnostic>> {
    let mut found = Vec::new();
    let table = csv::parse(file, &sources.file(file).text, &mut found);
    let mut translations = Translations::default();
    let head = table.records.first().map_or(&[][..], Vec::as_slice);
    if let Some((at, columns)) = columns(file, head, &mut found) {
        translations.languages =
            columns.iter().map(|(tag, _)| Language { tag: tag.to_string(), ..Language::default() }).collect();
        let mut known: BTreeSet<&str> = BTreeSet::new();
        for record in table.records.iter().skip(1) {
            if let Some(extra) = record.iter().skip(head.len()).find(|field| !field.text.is_empty()) {
                found.push(
                    Diagnostic::new(
                        "E0601",
                        extra.span,
                        "the row has more fields than the first line has columns",
                    )
                    .help("put a text that holds the separator into quotes"),
                );
                continue;
            }
            let Some(text) = record.get(at).filter(|field| !field.text.is_empty()) else {
                let place = record.first().map_or(Span::new(file, 0, 0), |first| first.span);
                found.push(
                    Diagnostic::new("E0615", place, "the row has no text that is translated")
                        .help("copy the row from plc/texts.csv, or remove it"),
                );
                continue;
            };
            if !known.insert(&text.text) {
                found.push(
                    Diagnostic::new("E0615", text.span, "this text has a second row")
                        .help("keep one of them"),
                );
            }
            if !texts.contains(text.text.as_str()) {
                translations.strangers.push(text.text.clone());
            }
            for ((_, column), language) in columns.iter().zip(&mut translations.languages) {
                if let Some(field) = record.get(*column).filter(|field| !field.text.is_empty()) {
                    language.texts.insert(text.text.clone(), shown(&field.text));
                }
            }
        }
    }
    diagnostic::sort(&mut found);
    if found.is_empty() { Ok(translations) } else { Err(found) }
}

/// As it may be in a table, on as many lines as it has.
fn shown(text: &str) -> String {
    plain::lines(&text.replace("\r\n", "\n").replace('\r', "\n")).into_owned()
}

/// Where the texts are, and the languages with their columns.
fn columns<'h>(
    file: FileId,
    head: &'h [Field],
    found: &mut Vec<Diagnostic>,
) -> Option<(usize, Vec<(&'h str, usize)>)> {
    let help = "begin with plc/texts.csv as `build` writes it, and add a column with the name of its language, such as de, fr or pt-BR";
    let count = found.len();
    let place = head.first().map_or(Span::new(file, 0, 0), |first| first.span);
    let at = head.iter().position(|field| field.text.eq_ignore_ascii_case(TEXT));
    if at.is_none() {
        found.push(Diagnostic::new("E0614", place, format!("the table has no column `{TEXT}`")).help(help));
    }
    let mut languages: Vec<(&str, usize)> = Vec::new();
    for (number, field) in head.iter().enumerate() {
        if Some(number) == at || field.text.is_empty() || field.text.eq_ignore_ascii_case(USE) {
            continue;
        }
        if !is_tag(&field.text) {
            let message = format!("`{}` is not the name of a language", field.text);
            found.push(Diagnostic::new("E0614", field.span, message).help(help));
        } else if languages.iter().any(|(tag, _)| tag.eq_ignore_ascii_case(&field.text)) {
            let message = format!("`{}` has a second column", field.text);
            found.push(Diagnostic::new("E0614", field.span, message).help("rename or remove one of them"));
        } else {
            languages.push((&field.text, number));
        }
    }
    if languages.is_empty() && found.len() == count {
        found.push(Diagnostic::new("E0614", place, "the table has no column of a language").help(help));
    }
    if languages.len() > MOST_LANGUAGES {
        let message = format!("{} languages: the limit is {MOST_LANGUAGES}", languages.len());
        found.push(Diagnostic::new("E0614", place, message).help("divide the table into several tables"));
    }
    (found.len() == count).then_some((at?, languages))
}

/// A tag of a language as BCP 47 has them, in the parts that name files: letters and digits with hyphens between.
fn is_tag(text: &str) -> bool {
    let mut parts = text.split('-');
    let is_language = parts.next().is_some_and(|first| {
        (2..=3).contains(&first.len()) && first.bytes().all(|b| b.is_ascii_alphabetic())
    });
    is_language
        && parts.clone().count() <= 3
        && parts.all(|part| (1..=8).contains(&part.len()) && part.bytes().all(|b| b.is_ascii_alphanumeric()))
}
