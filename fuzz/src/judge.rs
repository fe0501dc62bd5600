//! What holds of every answer.

mod diagnostics;
mod dot;
mod drawing;
mod outputs;

pub use diagnostics::diagnostics;
pub use outputs::structured_text;

use crate::target::Effort;
use autogen_tests::{Texts, plain};

/// Compiles a line, and judges what is said of it and what is made of it.
pub fn line(texts: &Texts, input: &[u8], effort: Effort) {
    let outcome = texts.compile();
    diagnostics(&outcome.sources, &outcome.diagnostics, input, effort);
    assert_eq!(outcome.project.is_some(), outcome.diagnostics.is_empty(), "right or wrong, not both");
    if let Some(verdict) = &outcome.verdict {
        assert!(verdict.feasible || outcome.project.is_none(), "what cannot work was compiled");
    }
    if let Some(project) = &outcome.project {
        outputs::cheap(project);
        if effort.takes(input, 64) {
            outputs::dear(project, &outcome.sources);
        }
    }
    if effort.takes(input, 128) {
        same(texts, &outcome);
    }
}

/// The same input, the same bytes.
fn same(texts: &Texts, outcome: &autogen::lower::Outcome) {
    let again = texts.compile();
    assert_eq!(
        plain(&again.sources, &again.diagnostics),
        plain(&outcome.sources, &outcome.diagnostics),
        "other diagnostics for the same input"
    );
    if let (Some(one), Some(other)) = (&outcome.project, &again.project) {
        assert!(
            outputs::all(one, &outcome.sources) == outputs::all(other, &again.sources),
            "other files for the same input"
        );
    }
}
