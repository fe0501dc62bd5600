//! Diagnostics as text for people.

use super::{Diagnostic, Severity};
use crate::plain::{self, boundary};
use crate::source::{FileId, Sources, Span};
use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Origin, Renderer, Snippet};
use std::borrow::Cow;

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
        out.push_str(&rendered(sources, diagnostic, renderer));
        out.push_str("\n\n");
    }
    out
}

/// Bytes of text out of which lines are shown; of longer stretches only their places are named.
const LONGEST: usize = 1 << 13;
/// Other places that are shown.
const MOST_OTHERS: usize = 20;

fn rendered(sources: &Sources, diagnostic: &Diagnostic, renderer: &Renderer) -> String {
    let label = (diagnostic.place, diagnostic.label.as_str());
    let others = diagnostic.others.iter().take(MOST_OTHERS).map(|(span, text)| (*span, text.as_str()));
    let places: Vec<(Span, &str)> = [label].into_iter().chain(others).collect();
    let mut files: Vec<FileId> = Vec::new();
    for (span, _) in &places {
        if !files.contains(&span.file) {
            files.push(span.file);
        }
    }
    let mut shown: Vec<Vec<(usize, Span, &str)>> = Vec::new();
    for file in files {
        let own = places.iter().enumerate().filter(|(_, (span, _))| span.file == file);
        let own: Vec<_> = own.map(|(i, (span, text))| (i, *span, *text)).collect();
        match lines_of(sources, &own).len() <= LONGEST {
            true => shown.push(own),
            // Far apart: each by itself.
            false => shown.extend(own.into_iter().map(|place| vec![place])),
        }
    }
    let level = match diagnostic.severity() {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
        Severity::Note => Level::NOTE,
    };
    let mut group =
        Group::with_title(level.primary_title(plain::lines(&diagnostic.message)).id(diagnostic.code));
    for places in &shown {
        let lines = lines_of(sources, places);
        let file = sources.file(places[0].1.file);
        if lines.len() > LONGEST {
            for (_, span, text) in places {
                let (line, column) = sources.position(*span);
                group = group.element(Origin::path(file.name.as_str()).line(line).char_column(column));
                if !text.is_empty() {
                    group = group.element(Level::NOTE.message(plain::lines(text)));
                }
            }
            continue;
        }
        let whole = &file.text[lines.clone()];
        let first = sources.position(Span::new(places[0].1.file, lines.start, lines.start)).0;
        let mut snippet =
            Snippet::source(plain::excerpt(whole)).line_start(first).path(file.name.as_str()).fold(true);
        for (number, span, text) in places {
            let kind = if *number == 0 { AnnotationKind::Primary } else { AnnotationKind::Context };
            snippet = snippet.annotation(annotation(kind, whole, lines.start, *span, text));
        }
        group = group.element(snippet);
    }
    for note in &diagnostic.notes {
        group = group.element(Level::NOTE.message(plain::lines(note)));
    }
    if !diagnostic.help.is_empty() {
        group = group.element(Level::HELP.message(plain::lines(&diagnostic.help)));
    }
    renderer.render(&[group])
}

/// A span of a file whose stretch `whole` begins at `start`.
fn annotation<'t>(
    kind: AnnotationKind,
    whole: &str,
    start: usize,
    span: Span,
    text: &'t str,
) -> Annotation<'t> {
    // A sign may be longer than what it stands for.
    let at =
        |place: u32| plain::excerpt(&whole[..boundary(whole, (place as usize).saturating_sub(start))]).len();
    let (first, last) = (at(span.start), at(span.end));
    kind.span(first..last.max(first)).label(match plain::lines(text) {
        Cow::Borrowed(text) => Cow::Borrowed(text),
        Cow::Owned(text) => Cow::Owned(text),
    })
}

/// From the beginning of the first line to the end of the last of these places in one file; of lines that are
/// too long to be shown only a part that is too long as well.
fn lines_of(sources: &Sources, places: &[(usize, Span, &str)]) -> std::ops::Range<usize> {
    let text = &sources.file(places[0].1.file).text;
    let first = places.iter().map(|(_, span, _)| span.start).min().unwrap_or(0);
    let last = places.iter().map(|(_, span, _)| span.end).max().unwrap_or(0);
    let first = boundary(text, first as usize);
    let last = boundary(text, last as usize).max(first);
    let before = boundary(text, first.saturating_sub(LONGEST + 4));
    let behind = boundary(text, last + LONGEST + 4);
    let start = text[before..first].rfind('\n').map_or(before, |at| before + at + 1);
    let end = text[last..behind].find('\n').map_or(behind, |length| last + length + 1);
    start..end
}
