//! What a person is told.

use crate::target::Effort;
use autogen::diagnostic::{Diagnostic, explain, render_plain, render_styled};
use autogen::source::{Sources, Span};
use std::cell::RefCell;
use std::collections::BTreeSet;

/// Rendered of those of one input, since each shows a piece of its file.
const MOST_RENDERED: usize = 4;

/// Each has a code that is explained, a line that stands alone, places in the text, and can be shown.
pub fn diagnostics(sources: &Sources, found: &[Diagnostic], input: &[u8], effort: Effort) {
    for diagnostic in found {
        explained(diagnostic.code);
        assert!(!diagnostic.message.trim().is_empty(), "{diagnostic:?} says nothing");
        place(sources, diagnostic.place, diagnostic);
        diagnostic.others.iter().for_each(|(span, _)| place(sources, *span, diagnostic));
    }
    if !effort.takes(input, 8) {
        return;
    }
    let shown = match effort {
        Effort::Whole => found,
        Effort::Sampled | Effort::Rare => &found[..found.len().min(MOST_RENDERED)],
    };
    let text = render_plain(sources, shown);
    for diagnostic in shown {
        assert!(text.contains(&format!("error[{}]", diagnostic.code)), "{diagnostic:?} is not shown");
    }
    let is_obeyed =
        |c: &char| (c.is_control() && !matches!(*c, '\n' | '\t')) || ('\u{202a}'..='\u{202e}').contains(c);
    let control = text.chars().find(is_obeyed);
    assert!(control.is_none(), "a report holds {control:?}: {found:?}");
    if effort == Effort::Whole {
        render_styled(sources, shown);
    }
}

/// Every code stands in the list of errors, which is searched once for each.
fn explained(code: &'static str) {
    thread_local!(static KNOWN: RefCell<BTreeSet<&'static str>> = const { RefCell::new(BTreeSet::new()) });
    KNOWN.with_borrow_mut(|known| {
        if !known.contains(code) {
            assert!(explain(code).is_some_and(|text| !text.is_empty()), "{code} is not explained");
            known.insert(code);
        }
    });
}

fn place(sources: &Sources, span: Span, diagnostic: &Diagnostic) {
    assert!((span.file.0 as usize) < sources.files().len(), "no such file: {diagnostic:?}");
    let text = &sources.file(span.file).text;
    let (start, end) = (span.start as usize, span.end as usize);
    assert!(start <= end && end <= text.len(), "beyond its file: {diagnostic:?}");
    assert!(text.is_char_boundary(start) && text.is_char_boundary(end), "within a letter: {diagnostic:?}");
}
