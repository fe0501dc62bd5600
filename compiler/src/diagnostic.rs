//! Diagnostics are data; they are rendered once, at the edge.

use crate::source::{Sources, Span};
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use std::borrow::Cow;

/// Something wrong with the input. All are errors: a line that may run is right, one that may not is not.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// Stable, such as `E0104`; every code stands in `docs/errors.md`.
    pub code: &'static str,
    /// What is wrong, in one line that stands alone.
    pub message: String,
    pub place: Span,
    /// What is at `place`, in a few words; may be empty.
    pub label: String,
    /// Other places that matter, in any file.
    pub others: Vec<(Span, String)>,
    /// Facts, a line each.
    pub notes: Vec<String>,
    /// How to mend it.
    pub help: String,
}

impl Diagnostic {
    pub fn new(code: &'static str, place: Span, message: impl Into<String>) -> Self {
        Self {
            code,
            message: message.into(),
            place,
            label: String::new(),
            others: Vec::new(),
            notes: Vec::new(),
            help: String::new(),
        }
    }

    pub fn label(mut self, text: impl Into<String>) -> Self {
        self.label = text.into();
        self
    }

    pub fn other(mut self, place: Span, text: impl Into<String>) -> Self {
        self.others.push((place, text.into()));
        self
    }

    pub fn note(mut self, text: impl Into<String>) -> Self {
        self.notes.push(text.into());
        self
    }

    pub fn help(mut self, text: impl Into<String>) -> Self {
        self.help = text.into();
        self
    }
}

/// What every code means and how to mend it.
const ERRORS: &str = include_str!("../../docs/errors.md");

/// The long text of a code, in Markdown without its heading.
pub fn explain(code: &str) -> Option<&'static str> {
    let section = ERRORS.split("\n## ").skip(1).find(|s| s.lines().next() == Some(code))?;
    section.split_once('\n').map(|(_, text)| text.trim())
}

/// Places in reading order, so that output never depends on the order of the checks.
pub fn sort(diagnostics: &mut Vec<Diagnostic>) {
    diagnostics.sort_by(|a, b| (a.place, a.code, &a.message).cmp(&(b.place, b.code, &b.message)));
    diagnostics.dedup();
}

/// The name among `known` that is nearest to `name`, if it is near enough to be meant: first of all
/// one that differs in small and capital letters only.
pub fn suggestion<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    known
        .into_iter()
        .map(|candidate| {
            let distance = edit_distance(&name.to_lowercase(), &candidate.to_lowercase());
            (distance, edit_distance(name, candidate), candidate)
        })
        .filter(|(distance, _, candidate)| *distance <= 1 + candidate.len().min(name.len()) / 3)
        .min()
        .map(|(_, _, candidate)| candidate)
}

fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut corner = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let change = corner + usize::from(x != *y);
            corner = row[j + 1];
            row[j + 1] = change.min(corner + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

/// All diagnostics as text without colours.
pub fn render_plain(sources: &Sources, diagnostics: &[Diagnostic]) -> String {
    render(sources, diagnostics, &Renderer::plain())
}

/// All diagnostics as text with colours.
pub fn render_styled(sources: &Sources, diagnostics: &[Diagnostic]) -> String {
    render(sources, diagnostics, &Renderer::styled())
}

pub fn render(sources: &Sources, diagnostics: &[Diagnostic], renderer: &Renderer) -> String {
    let mut out = String::new();
    for diagnostic in diagnostics {
        let message = visible(&diagnostic.message).replace('\n', "\\n");
        let mut group = Group::with_title(Level::ERROR.primary_title(message).id(diagnostic.code));
        let mut files = vec![diagnostic.place.file];
        for (span, _) in &diagnostic.others {
            if !files.contains(&span.file) {
                files.push(span.file);
            }
        }
        for file in files {
            let source = sources.file(file);
            let mut snippet = Snippet::source(excerpt(&source.text)).path(source.name.as_str()).fold(true);
            if file == diagnostic.place.file {
                let span = range(diagnostic.place, source.text.len());
                snippet =
                    snippet.annotation(AnnotationKind::Primary.span(span).label(visible(&diagnostic.label)));
            }
            for (span, text) in diagnostic.others.iter().filter(|(s, _)| s.file == file) {
                snippet = snippet.annotation(
                    AnnotationKind::Context.span(range(*span, source.text.len())).label(visible(text)),
                );
            }
            group = group.element(snippet);
        }
        for note in &diagnostic.notes {
            group = group.element(Level::NOTE.message(visible(note)));
        }
        if !diagnostic.help.is_empty() {
            group = group.element(Level::HELP.message(visible(&diagnostic.help)));
        }
        out.push_str(&renderer.render(&[group]));
        out.push_str("\n\n");
    }
    out
}

/// A piece of a file. The renderer replaces what a terminal obeys but for the controls beyond ASCII; what
/// stands for these is as long as they are, so that places stay.
fn excerpt(text: &str) -> Cow<'_, str> {
    let is_obeyed = |c: char| matches!(c, '\u{80}'..='\u{9f}');
    match text.contains(is_obeyed) {
        true => text.replace(is_obeyed, "\u{bf}").into(),
        false => text.into(),
    }
}

/// A text of a diagnostic may hold what an input holds; a terminal shall not obey that.
fn visible(text: &str) -> Cow<'_, str> {
    let is_obeyed = |c: char| {
        (c.is_control() && c != '\n')
            || matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    if !text.contains(is_obeyed) {
        return text.into();
    }
    let escaped = |c: char| if is_obeyed(c) { c.escape_default().to_string() } else { c.to_string() };
    text.chars().map(escaped).collect()
}

fn range(span: Span, len: usize) -> std::ops::Range<usize> {
    let start = (span.start as usize).min(len);
    start..(span.end as usize).clamp(start, len)
}

#[cfg(test)]
mod tests {
    use super::{suggestion, visible};

    #[test]
    fn nothing_that_a_terminal_obeys_is_left() {
        assert_eq!(visible("a `\u{1b}[31m\0\u{202e}` é\n"), "a `\\u{1b}[31m\\u{0}\\u{202e}` é\n");
    }

    #[test]
    fn another_case_is_nearest() {
        assert_eq!(suggestion("FULL", ["FALL", "FUL", "full"]), Some("full"));
        assert_eq!(suggestion("Full", ["FULL", "full"]), Some("full"));
        assert_eq!(suggestion("full", ["fill", "Full", "bull"]), Some("Full"));
        assert_eq!(suggestion("full", ["empty"]), None);
    }
}
