//! Faults in how a text is written.

use super::survey::{Survey, one};
use super::{Entry, Mutation};
use crate::finding::Span;

pub(super) const FAULTS: &[Entry] = &[
    ("missing semicolon", |s| characters(s, ';', "")),
    ("unbalanced parentheses", parentheses),
    ("`//` comment", line_comments),
    ("comment in a comment", |s| in_comments(s, " (* inner *) ")),
    ("comment that opens another", |s| in_comments(s, " (* ")),
    ("`/* */` comment", |s| characters(s, ';', "; /* note */")),
];

fn characters(survey: &Survey, wanted: char, text: &str) -> Vec<Mutation> {
    let code = survey.code().into_iter().filter(|(_, c)| *c == wanted);
    code.map(|(i, _)| one(Span { start: i, end: i + 1 }, text)).collect()
}

fn parentheses(survey: &Survey) -> Vec<Mutation> {
    [('(', ""), (')', ""), ('(', "(("), (')', "))")]
        .iter()
        .flat_map(|(c, text)| characters(survey, *c, text))
        .collect()
}

fn line_comments(survey: &Survey) -> Vec<Mutation> {
    characters(survey, '\n', " // note\n")
}

fn in_comments(survey: &Survey, text: &str) -> Vec<Mutation> {
    let ends = survey.source.match_indices("*)");
    ends.map(|(i, _)| one(Span { start: i, end: i }, text)).collect()
}
