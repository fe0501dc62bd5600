//! Layouts, with the library and the built-in scenario.

use super::Effort;
use super::line::text;
use crate::judge;
use autogen::layout;
use autogen::source::Sources;
use autogen_tests::Texts;

pub fn answer(input: &[u8], effort: Effort) {
    let text = text(input);
    let mut sources = Sources::default();
    let file = sources.add("layout.json", text.as_str());
    let (layout, found) = layout::parse(&sources, file);
    judge::diagnostics(&sources, &found, input, effort);
    assert!(layout.is_some() || !found.is_empty(), "nothing was read, and nothing is wrong");
    if effort.takes(input, if found.is_empty() { 1 } else { 64 }) {
        judge::line(&Texts::of_layout(text), input, effort);
    }
}
