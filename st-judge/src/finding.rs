//! What is wrong with a text, and where.

use std::fmt;

/// A part of a text, in bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    pub start: usize,
    pub end: usize,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// Names the rule.
    pub code: &'static str,
    pub span: Span,
    pub text: String,
}

impl Finding {
    pub fn new(code: &'static str, span: Span, text: impl Into<String>) -> Self {
        Self { code, span, text: text.into() }
    }

    /// The finding with its place in the text it is about.
    pub fn located(&self, source: &str) -> String {
        format!("{}: {}: {}", Place::of(source, self.span.start), self.code, self.text)
    }
}

/// Line and column, both from 1; columns count characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    pub line: usize,
    pub column: usize,
}

impl Place {
    pub fn of(source: &str, byte: usize) -> Self {
        let before = source.get(..byte).unwrap_or(source);
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        Self { line: before.matches('\n').count() + 1, column: before[line_start..].chars().count() + 1 }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}:{}", self.line, self.column)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_count_lines_and_characters() {
        let source = "a\nüb c\n";
        assert_eq!(Place::of(source, 0).to_string(), "1:1");
        assert_eq!(Place::of(source, source.find('c').unwrap()).to_string(), "2:4");
    }
}
