//! Diagnostics are data; they are rendered once, at the edge.

mod rendered;

pub use rendered::{render, render_plain, render_styled};

use crate::plain::shortened;
use crate::source::Span;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// Nothing is made of the input.
    Error,
    /// A line that has warnings can be built and run.
    Warning,
    /// What somebody has asked for; nothing has to be wrong.
    Note,
}

impl Severity {
    pub fn name(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
            Self::Note => "note",
        }
    }
}

/// Something of the input: an error, a warning or a note.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// Stable, such as `E0104`, `W0101` of a warning or `N0101` of a note; every code is in `docs/errors.md`.
    pub code: &'static str,
    /// What is wrong, in one line that is complete by itself.
    pub message: String,
    pub place: Span,
    /// What is at `place`, in a few words; may be empty.
    pub label: String,
    /// Other places that matter, in any file.
    pub others: Vec<(Span, String)>,
    /// Facts, a line each.
    pub notes: Vec<String>,
    /// How to correct it.
    pub help: String,
}

impl Diagnostic {
    pub fn new(code: &'static str, place: Span, message: impl Into<String>) -> Self {
        Self {
            code,
            message: shortened(message.into()),
            place,
            label: String::new(),
            others: Vec::new(),
            notes: Vec::new(),
            help: String::new(),
        }
    }

    pub fn severity(&self) -> Severity {
        match self.code.as_bytes().first() {
            Some(b'W') => Severity::Warning,
            Some(b'N') => Severity::Note,
            _ => Severity::Error,
        }
    }

    pub fn label(mut self, text: impl Into<String>) -> Self {
        self.label = shortened(text.into());
        self
    }

    pub fn other(mut self, place: Span, text: impl Into<String>) -> Self {
        self.others.push((place, shortened(text.into())));
        self
    }

    pub fn note(mut self, text: impl Into<String>) -> Self {
        self.notes.push(shortened(text.into()));
        self
    }

    pub fn help(mut self, text: impl Into<String>) -> Self {
        self.help = shortened(text.into());
        self
    }
}

/// What every code means and how to correct it.
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

/// Diagnostics of one kind of text; nobody reads more.
pub const MOST: usize = 1000;

/// Adds a diagnostic to those of one kind of text, unless there are [`MOST`]; the last one says so.
pub fn collect(found: &mut Vec<Diagnostic>, diagnostic: Diagnostic) {
    match found.len() + 1 {
        next if next < MOST => found.push(diagnostic),
        MOST => found.push(diagnostic.note(format!("after {MOST} errors no more are reported"))),
        _ => {}
    }
}

/// Letters of a name that somebody mistyped, and names that are compared with it.
const LONGEST_SUGGESTED: usize = 100;
const MOST_COMPARED: usize = 500;

/// The name among `known` that is nearest to `name`, if it is near enough to be meant: first of all
/// one that differs in small and capital letters only.
pub fn suggestion<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if name.len() > LONGEST_SUGGESTED {
        return None;
    }
    known
        .into_iter()
        .take(MOST_COMPARED)
        .filter(|candidate| candidate.len() <= LONGEST_SUGGESTED)
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

#[cfg(test)]
mod tests {
    use super::suggestion;

    #[test]
    fn another_case_is_nearest() {
        assert_eq!(suggestion("FULL", ["FALL", "FUL", "full"]), Some("full"));
        assert_eq!(suggestion("Full", ["FULL", "full"]), Some("full"));
        assert_eq!(suggestion("full", ["fill", "Full", "bull"]), Some("Full"));
        assert_eq!(suggestion("full", ["empty"]), None);
    }
}
