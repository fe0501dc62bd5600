//! Texts that a screen shows, and the tables that have them in other languages.

use super::context::Shared;
use super::table::row;
use super::{alarms, states};
use crate::backend::Files;
use crate::translation::{TEXT, Translations, USE};
use std::collections::BTreeSet;

/// What a text is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Use {
    Alarm,
    Remedy,
    State,
    Meaning,
}

impl Use {
    fn name(self) -> &'static str {
        match self {
            Use::Alarm => "alarm",
            Use::Remedy => "remedy",
            Use::State => "state",
            Use::Meaning => "meaning",
        }
    }
}

/// Makes the text for a screen of the text of the specification.
pub type Translate<'t> = dyn FnMut(Use, &str) -> String + 't;

/// A text as it is.
pub fn as_written(_: Use, text: &str) -> String {
    text.into()
}

/// Each text once, in the order in which the tables have them.
pub fn texts(shared: Shared) -> Vec<(Use, String)> {
    let mut known = BTreeSet::new();
    let mut texts = Vec::new();
    let mut collect = |kind: Use, text: &str| {
        if !text.is_empty() && known.insert(text.to_string()) {
            texts.push((kind, text.to_string()));
        }
        String::new()
    };
    alarms::table(shared, &mut collect);
    states::table(shared, &mut collect);
    texts
}

/// `texts.csv`, and for each language the tables of alarms and states.
pub fn files(shared: Shared, translations: &Translations) -> Files {
    let languages = &translations.languages;
    let head: Vec<&str> = [USE, TEXT].into_iter().chain(languages.iter().map(|l| l.tag.as_str())).collect();
    let mut table = row(&head);
    for (kind, text) in texts(shared) {
        let translated = languages.iter().map(|l| if l.has(&text) { l.text(&text) } else { "" });
        table += &row(&[kind.name(), &text].into_iter().chain(translated).collect::<Vec<_>>());
    }
    let mut files = Files::from([("texts.csv".into(), table)]);
    for language in languages {
        let mut translate = |_: Use, text: &str| language.text(text).to_string();
        files.insert(format!("alarms.{}.csv", language.tag), alarms::table(shared, &mut translate));
        files.insert(format!("states.{}.csv", language.tag), states::table(shared, &mut translate));
    }
    files
}
