//! From JSON to values, with a diagnostic for whatever is not as it should be.

use super::json::{Json, Member, Value};
use crate::diagnostic::{Diagnostic, MOST, collect, suggestion};
use crate::naming::letters::in_ascii;
use crate::source::{Span, Spanned};
use rustc_hash::FxHashSet;
use std::collections::BTreeMap;
use std::fmt::Display;
use std::ops::RangeInclusive;

/// Collects what is wrong while values are read; a reading that fails has said why.
#[derive(Default)]
pub struct Decoder {
    pub diagnostics: Vec<Diagnostic>,
    /// Where keys stand that their objects may have: none of them is another key misspelt.
    known: FxHashSet<Span>,
}

impl Value {
    /// What this is, for messages.
    fn noun(&self) -> &'static str {
        match self {
            Value::Null => "null",
            Value::Bool(_) => "a boolean",
            Value::Number(_) => "a number",
            Value::Text(_) => "a text",
            Value::List(_) => "a list",
            Value::Object(_) => "an object",
        }
    }
}

pub fn find<'a>(members: &'a [Member], key: &str) -> Option<&'a Json> {
    members.iter().find(|m| m.key.value == key).map(|m| &m.value)
}

/// A key of a file that is for editors.
pub const SCHEMA: &str = "$schema";

/// Names that one message lists.
const MOST_LISTED: usize = 100;

/// `a`, `b`, `c`
pub fn some(names: &[&str]) -> String {
    match names.get(MOST_LISTED..) {
        Some(rest @ [_, ..]) => format!("{}, and {} more", names[..MOST_LISTED].join(", "), rest.len()),
        _ => names.join(", "),
    }
}

/// `a`, `b` and `c`
pub fn listing(names: &[&str]) -> String {
    match names {
        [] => "none".into(),
        [only] => (*only).into(),
        [front @ .., _] if front.len() >= MOST_LISTED => {
            format!("{} and {} more", names[..MOST_LISTED].join(", "), names.len() - MOST_LISTED)
        }
        [front @ .., last] => format!("{} and {last}", front.join(", ")),
    }
}

/// A number as people would write it.
pub fn readable(number: f64) -> String {
    match number.abs() < 1e9 {
        true => number.to_string(),
        false => format!("{number:e}"),
    }
}

/// Help for a name that is not among `known`.
pub fn instead(name: &str, known: &[&str]) -> String {
    match suggestion(name, known.iter().copied()) {
        Some(meant) => format!("did you mean \"{meant}\"?"),
        None if known.is_empty() => "remove it".into(),
        None => format!("write one of: {}", some(known)),
    }
}

impl Decoder {
    pub fn new(diagnostics: Vec<Diagnostic>) -> Self {
        Self { diagnostics, ..Self::default() }
    }

    /// Whether further errors are not reported.
    pub fn is_full(&self) -> bool {
        self.diagnostics.len() >= MOST
    }

    pub fn report(&mut self, diagnostic: Diagnostic) {
        collect(&mut self.diagnostics, diagnostic);
    }

    pub fn wrong_type(&mut self, json: &Json, what: impl Display, wanted: &str) {
        let found = json.value.noun();
        self.report(
            Diagnostic::new("E0110", json.span, format!("{what} must be {wanted}, not {found}"))
                .label(format!("this is {found}"))
                .help(format!("write {wanted} here")),
        );
    }

    pub fn object<'a>(&mut self, json: &'a Json, what: &str) -> Option<&'a [Member]> {
        match &json.value {
            Value::Object(members) => Some(members),
            _ => {
                self.wrong_type(json, what, "an object");
                None
            }
        }
    }

    pub fn list<'a>(&mut self, json: &'a Json, what: impl Display) -> Option<&'a [Json]> {
        match &json.value {
            Value::List(items) => Some(items),
            _ => {
                self.wrong_type(json, what, "a list");
                None
            }
        }
    }

    pub fn text(&mut self, json: &Json, what: &str) -> Option<Spanned<String>> {
        match &json.value {
            Value::Text(text) => Some(Spanned { value: text.clone(), span: json.span }),
            _ => {
                self.wrong_type(json, what, "a text");
                None
            }
        }
    }

    /// One of these words: what it stands for.
    pub fn one_of<T: Copy>(&mut self, json: &Json, what: &str, words: &[(&str, T)]) -> Option<T> {
        let text = self.text(json, what)?;
        let found = words.iter().find(|(word, _)| *word == text.value);
        if found.is_none() {
            let known: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
            let message = format!("{what} cannot be \"{}\"", text.value);
            self.report(Diagnostic::new("E0115", json.span, message).help(instead(&text.value, &known)));
        }
        found.map(|(_, meant)| *meant)
    }

    pub fn number(&mut self, json: &Json, what: &str) -> Option<f64> {
        match json.value {
            Value::Number(number) => Some(number),
            _ => {
                self.wrong_type(json, what, "a number");
                None
            }
        }
    }

    pub fn number_in(&mut self, json: &Json, what: &str, bounds: RangeInclusive<f64>) -> Option<f64> {
        let number = self.number(json, what)?;
        if !bounds.contains(&number) {
            self.out_of_bounds(json.span, what, number, "a number", bounds);
            return None;
        }
        Some(number)
    }

    pub fn whole(&mut self, json: &Json, what: &str, bounds: RangeInclusive<u32>) -> Option<u32> {
        let number = self.number(json, what)?;
        let limits = f64::from(*bounds.start())..=f64::from(*bounds.end());
        if number.fract() != 0.0 || !limits.contains(&number) {
            self.out_of_bounds(json.span, what, number, "a whole number", bounds);
            return None;
        }
        Some(number as u32)
    }

    fn out_of_bounds<T: Display>(
        &mut self,
        place: Span,
        what: &str,
        found: f64,
        wanted: &str,
        bounds: RangeInclusive<T>,
    ) {
        let range = format!("from {} to {}", bounds.start(), bounds.end());
        self.report(
            Diagnostic::new(
                "E0114",
                place,
                format!("{what} must be {wanted} {range}, not {}", readable(found)),
            )
            .help(format!("write {wanted} {range}")),
        );
    }

    /// A list of exactly these elements.
    pub fn exactly<'a>(
        &mut self,
        json: &'a Json,
        what: impl Display,
        elements: &[&str],
    ) -> Option<&'a [Json]> {
        let items = self.list(json, &what)?;
        let (wanted, found) = (elements.len(), items.len());
        if found != wanted {
            self.report(
                Diagnostic::new(
                    "E0113",
                    json.span,
                    format!("{what} must have {wanted} elements, not {found}"),
                )
                .note(format!("the elements are {}", listing(elements)))
                .help(format!("write [{}]", elements.join(", "))),
            );
            return None;
        }
        Some(items)
    }

    pub fn texts(&mut self, json: &Json, what: &str) -> Option<Vec<Spanned<String>>> {
        let items = self.list(json, what)?;
        let element = format!("an element of {what}");
        Some(items.iter().filter_map(|item| self.text(item, &element)).collect())
    }

    pub fn required<'a>(
        &mut self,
        members: &'a [Member],
        key: &str,
        place: Span,
        what: impl Display,
    ) -> Option<&'a Json> {
        let found = find(members, key);
        if found.is_none() {
            self.missing(members, &[key], place, what);
        }
        found
    }

    /// None of these keys is there, of which one is required; a key that is one of them but for its spelling is the place.
    pub fn missing(&mut self, members: &[Member], keys: &[&str], place: Span, what: impl Display) {
        let unknown = members.iter().map(|member| &member.key).filter(|key| !self.known.contains(&key.span));
        let written = unknown.clone().map(|key| key.value.as_str());
        let near = keys.iter().find_map(|key| Some((*key, suggestion(key, written.clone())?)));
        let misspelt = near.and_then(|(_, near)| unknown.clone().find(|key| key.value == near));
        let place = misspelt.map_or(Span { end: place.start + 1, ..place }, |key| key.span);
        let quoted =
            |behind: &str| -> Vec<String> { keys.iter().map(|key| format!("\"{key}\"{behind}")).collect() };
        let help = match near {
            Some((key, written)) => format!("write \"{key}\" instead of \"{written}\""),
            None => format!("add {}", quoted(": ...").join(" or ")),
        };
        let keys = quoted("").join(" or ");
        self.report(
            Diagnostic::new("E0112", place, format!("{what} has no key {keys}"))
                .note(format!("{keys} is required"))
                .help(help),
        );
    }

    /// The keys of a whole file, which may name its schema for an editor; the help for a key that stands elsewhere.
    pub fn unknown_keys_of_file(
        &mut self,
        members: &[Member],
        known: &[&str],
        what: &str,
        elsewhere: impl Fn(&str) -> Option<String>,
    ) {
        if let Some(schema) = find(members, SCHEMA) {
            self.text(schema, SCHEMA);
        }
        let keys = members.iter().map(|m| &m.key).filter(|k| k.value != SCHEMA);
        self.unknown_among(keys, known, what, elsewhere);
    }

    pub fn unknown_keys(&mut self, members: &[Member], known: &[&str], what: impl Display) {
        self.unknown_among(members.iter().map(|m| &m.key), known, what, |_| None);
    }

    fn unknown_among<'a>(
        &mut self,
        keys: impl Iterator<Item = &'a Spanned<String>>,
        known: &[&str],
        what: impl Display,
        elsewhere: impl Fn(&str) -> Option<String>,
    ) {
        for key in keys {
            if known.contains(&key.value.as_str()) {
                self.known.insert(key.span);
                continue;
            }
            if self.is_full() {
                return;
            }
            self.report(
                Diagnostic::new("E0111", key.span, format!("{what} has no key \"{}\"", key.value))
                    .label("unknown key")
                    .note(format!("known keys: {}", listing(known)))
                    .help(elsewhere(&key.value).unwrap_or_else(|| instead(&key.value, known))),
            );
        }
    }

    /// A name that can be in the text of a program.
    pub fn identifier(&mut self, name: &Spanned<String>, what: &str) -> bool {
        let good = is_identifier(&name.value);
        if !good {
            self.report(
                Diagnostic::new("E0120", name.span, format!("\"{}\" cannot be the name of {what}", name.value))
                    .note("a name begins with a letter a to z, continues with letters, digits and single underscores, does not end in an underscore, and has at most 32 characters")
                    .help(format!("write for example \"{}\"", make_identifier(&name.value, "name"))),
            );
        }
        good
    }

    /// Names of one kind differ in more than upper and lower case, which Structured Text does not tell apart.
    pub fn distinct<'a>(&mut self, names: impl IntoIterator<Item = &'a Spanned<String>>, what: &str) {
        let mut seen: BTreeMap<String, &Spanned<String>> = BTreeMap::new();
        for name in names {
            let first = *seen.entry(name.value.to_ascii_lowercase()).or_insert(name);
            if std::ptr::eq(first, name) {
                continue;
            }
            let mut diagnostic = Diagnostic::new(
                "E0121",
                name.span,
                format!("the name \"{}\" of {what} is taken", name.value),
            )
            .label("second use")
            .other(first.span, "first use");
            if first.value != name.value {
                diagnostic = diagnostic.note(format!(
                    "\"{}\" and \"{}\" differ only in case, which Structured Text ignores",
                    first.value, name.value
                ));
            }
            self.report(diagnostic.help("give one of them another name"));
        }
    }
}

const LONGEST_NAME: usize = 32;

fn is_identifier(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
        && !name.contains("__")
        && !name.ends_with('_')
        && name.len() <= LONGEST_NAME
}

/// The identifier nearest to `text`; `prefix` stands before one that begins with a digit.
pub fn make_identifier(text: &str, prefix: &str) -> String {
    let text = in_ascii(text);
    let words: Vec<&str> =
        text.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty()).collect();
    let mut name = words.join("_");
    if !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
        name = if name.is_empty() { prefix.to_string() } else { format!("{prefix}_{name}") };
    }
    name.truncate(LONGEST_NAME);
    name.trim_end_matches('_').to_string()
}
