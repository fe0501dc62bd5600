//! Words of SCL.

use crate::finding::{Finding, Span};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A keyword, a type, a name behind a point, a number, a number with its type.
    Word,
    /// `#name` or `#"name"`, without the sign and the quotes.
    Local,
    /// `"name"`, without the quotes.
    Global,
    /// `{ ... }`.
    Attribute,
    Symbol,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token<'a> {
    pub kind: Kind,
    pub text: &'a str,
    pub span: Span,
}

impl Token<'_> {
    pub fn is(&self, kind: Kind, text: &str) -> bool {
        self.kind == kind && self.text == text
    }
}

fn is_word(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

/// The words of a source without its comments.
pub fn tokens(source: &str) -> Result<Vec<Token<'_>>, Finding> {
    let mut tokens = Vec::new();
    let mut at = 0;
    while let Some(first) = source[at..].chars().next() {
        let rest = &source[at..];
        let wrong = |text: &str| Finding::new("scl", Span { start: at, end: at + first.len_utf8() }, text);
        if first.is_whitespace() {
            at += first.len_utf8();
            continue;
        }
        if rest.starts_with("(*") {
            let length = rest.find("*)").ok_or_else(|| wrong("the comment has no end"))?;
            if rest[2..length].contains("(*") {
                return Err(wrong("a comment within a comment"));
            }
            at += length + 2;
            continue;
        }
        let (kind, begin, length, end) = match first {
            '#' if rest[1..].starts_with('"') => {
                (Kind::Local, 2, rest[2..].find('"').ok_or_else(|| wrong("no closing quote"))?, 1)
            }
            '#' => (Kind::Local, 1, word(&rest[1..]), 0),
            '"' => (Kind::Global, 1, rest[1..].find('"').ok_or_else(|| wrong("no closing quote"))?, 1),
            '{' => (Kind::Attribute, 1, rest[1..].find('}').ok_or_else(|| wrong("no closing bracket"))?, 1),
            c if is_word(c) => (Kind::Word, 0, number(rest).unwrap_or_else(|| word(rest)), 0),
            _ => {
                let two = [":=", "<>", "<=", ">=", "..", "=>"].iter().any(|two| rest.starts_with(two));
                (Kind::Symbol, 0, if two { 2 } else { first.len_utf8() }, 0)
            }
        };
        if length == 0 {
            return Err(wrong("a name is wanted"));
        }
        let span = Span { start: at, end: at + begin + length + end };
        tokens.push(Token { kind, text: &rest[begin..begin + length], span });
        at = span.end;
    }
    Ok(tokens)
}

fn word(text: &str) -> usize {
    text.find(|c| !is_word(c)).unwrap_or(text.len())
}

/// The length of a number, with its type if it has one: `12`, `LREAL#-1.5E-7`; none if this is a name.
fn number(text: &str) -> Option<usize> {
    let begin = text.find('#').filter(|&end| text[..end].chars().all(is_word)).map_or(0, |end| end + 1);
    let digits = text[begin..].strip_prefix('-').filter(|_| begin > 0).unwrap_or(&text[begin..]);
    if !digits.starts_with(|c: char| c.is_ascii_digit()) {
        return None;
    }
    let sign = text[begin..].len() - digits.len();
    let mut end = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
    if digits[end..].starts_with('.') && !digits[end..].starts_with("..") {
        end += 1 + digits[end + 1..].find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len() - end - 1);
        if let Some(power) = digits[end..].strip_prefix('E') {
            let unsigned = power.strip_prefix('-').unwrap_or(power);
            end += 1 + (power.len() - unsigned.len());
            end += unsigned.find(|c: char| !c.is_ascii_digit()).unwrap_or(unsigned.len());
        }
    }
    Some(begin + sign + end)
}
