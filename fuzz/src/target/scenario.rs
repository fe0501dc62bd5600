//! Scenarios of a small line.

use super::Effort;
use super::line::{small, text};
use crate::judge;
use autogen::scenario;
use autogen::source::Sources;
use autogen_tests::Texts;

pub fn answer(input: &[u8], effort: Effort) {
    let text = text(input);
    let mut sources = Sources::default();
    let file = sources.add("scenario.json", text.as_str());
    let (scenario, found) = scenario::parse(&sources, file);
    judge::diagnostics(&sources, &found, input, effort);
    assert!(scenario.is_some() || !found.is_empty(), "nothing was read, and nothing is wrong");
    if effort.takes(input, if found.is_empty() { 1 } else { 64 }) {
        let texts = Texts { scenario: Some(text), ..Texts::of_layout(small("")) };
        judge::line(&texts, input, effort);
    }
}
