//! Diagnostics as editors show them.

use super::lines::Lines;
use crate::diagnostic::{Diagnostic, Severity};
use crate::plain;
use crate::source::Span;
use gen_lsp_types::{self as protocol, DiagnosticRelatedInformation, DiagnosticSeverity, Location};

/// Who found it, in the editor's list.
pub const SOURCE: &str = "autogen";

/// Where a file can be opened, and its lines; of a text that is no file there is nothing.
pub trait Located {
    fn location(&self, span: Span) -> Option<Location>;
}

/// A diagnostic of a file with these lines: what is wrong, then what the facts are and how to correct it.
pub fn shown(diagnostic: &Diagnostic, lines: &Lines, files: &dyn Located) -> protocol::Diagnostic {
    let mut related = Vec::new();
    let mut text = vec![diagnostic.message.clone()];
    text.extend(Some(&diagnostic.label).filter(|label| !label.is_empty()).cloned());
    for (span, what) in &diagnostic.others {
        if let Some(location) = files.location(*span) {
            let message = plain::lines(what).into_owned();
            related.push(DiagnosticRelatedInformation { location, message });
        }
    }
    text.extend(diagnostic.notes.iter().map(|note| format!("note: {note}")));
    if !diagnostic.help.is_empty() {
        text.push(format!("help: {}", diagnostic.help));
    }
    let severity = match diagnostic.severity() {
        Severity::Error => DiagnosticSeverity::Error,
        Severity::Warning => DiagnosticSeverity::Warning,
        Severity::Note => DiagnosticSeverity::Information,
    };
    protocol::Diagnostic {
        range: lines.range(diagnostic.place),
        severity: Some(severity),
        code: Some(diagnostic.code.to_string().into()),
        source: Some(SOURCE.into()),
        message: plain::lines(&text.join("\n")).into_owned().into(),
        related_information: Some(related).filter(|related| !related.is_empty()),
        ..protocol::Diagnostic::default()
    }
}

/// A diagnostic of a text that is a part of autogen, as what is wrong with a file that uses it.
pub fn of_built_in(
    diagnostic: &Diagnostic,
    name: &str,
    lines: &Lines,
    files: &dyn Located,
) -> protocol::Diagnostic {
    let article = if name.contains('/') { "" } else { "the " };
    let message = format!("in {article}{name}: {}", diagnostic.message);
    let shown = shown(&Diagnostic { message, ..diagnostic.clone() }, lines, files);
    protocol::Diagnostic { range: protocol::Range::default(), ..shown }
}

/// What is wrong with a file as a whole, such as that it cannot be read.
pub fn of_file(message: &str) -> protocol::Diagnostic {
    protocol::Diagnostic {
        severity: Some(DiagnosticSeverity::Error),
        source: Some(SOURCE.into()),
        message: plain::lines(message).into_owned().into(),
        ..protocol::Diagnostic::default()
    }
}
