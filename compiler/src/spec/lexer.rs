//! Text to tokens.

pub mod foreign;

pub use foreign::CAPITALS;

use crate::diagnostic::{Diagnostic, MOST};
use crate::naming::letters::in_ascii;
use crate::plain;
use crate::source::{FileId, Span};

#[derive(Clone, Debug, PartialEq)]
pub enum Token {
    /// A name or a keyword; the parser tells them apart by place.
    Word(String),
    Int(i64),
    Real(f64),
    Text(String),
    /// A line that begins with `///`, as it may be shown.
    Doc(String),
    /// Punctuation and operators.
    Sign(&'static str),
    End,
}

/// Longest first.
const SIGNS: &[&str] = &[
    ":=", "+=", "-=", "->", "..", "<>", "<=", ">=", "==", "!=", "=>", "&&", "||", "{", "}", "(", ")", "[",
    "]", ",", ";", ":", ".", "+", "-", "*", "/", "=", "<", ">",
];

/// All tokens of a text, the last one `End`; what is not a token is reported and left out. After `most` tokens,
/// or too many errors, the rest is not read.
pub fn tokens(file: FileId, text: &str, most: usize) -> (Vec<(Token, Span)>, Vec<Diagnostic>) {
    let mut found = Vec::new();
    let mut diagnostics = Vec::new();
    let mut at = 0;
    while let Some(c) = text[at..].chars().next() {
        let rest = &text[at..];
        let start = at;
        if found.len() >= most || diagnostics.len() >= MOST {
            break;
        }
        if c.is_whitespace() {
            at += c.len_utf8();
        } else if rest.starts_with("//") {
            let line = rest.lines().next().unwrap_or("");
            at += line.len();
            if let Some(doc) = line.strip_prefix("///") {
                found.push((Token::Doc(plain::line(doc.trim())), Span::new(file, start, at)));
            }
        } else if let Some(end) =
            [("/*", "*/"), ("(*", "*)")].iter().find_map(|(a, b)| rest.starts_with(a).then_some(b))
        {
            at += rest[2..].find(end).map_or(rest.len(), |length| length + 4);
            diagnostics.push(
                Diagnostic::new(
                    "E0201",
                    Span::new(file, start, start + 2),
                    "there are no comments of this kind",
                )
                .help("begin each line of a comment with `//`"),
            );
        } else if c.is_alphabetic() || c == '_' {
            at += rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
            let word = &text[start..at];
            if let Some(letter) = word.chars().find(|letter| !letter.is_ascii()) {
                let span = Span::new(file, start, at);
                let meant = in_ascii(word);
                let help = match meant.is_ascii() {
                    true => format!("write `{meant}`"),
                    false => {
                        "names have letters a to z, digits and underscores; comments begin with `//`".into()
                    }
                };
                let message = format!("`{letter}` is not a letter of a name");
                diagnostics.push(Diagnostic::new("E0201", span, message).help(help));
                found.push((Token::Word(meant), span));
                continue;
            }
            if text[at..].starts_with('#') && ["t", "time"].contains(&word.to_lowercase().as_str()) {
                at += foreign::literal_length(&text[at..]);
                let span = Span::new(file, start, at);
                found.extend(foreign::duration(&text[start..at], span, &mut diagnostics));
                continue;
            }
            let span = Span::new(file, start, at);
            found.push((Token::Word(foreign::word(word, span, &mut diagnostics).into()), span));
        } else if c.is_ascii_digit() {
            at += number_length(rest);
            let span = Span::new(file, start, at);
            found.push((number(&text[start..at], span, &mut diagnostics), span));
        } else if c == '"' {
            let length = rest[1..].find(['"', '\n']).unwrap_or(rest.len() - 1);
            at += 1 + length;
            let text = rest[1..1 + length].to_string();
            if rest[1 + length..].starts_with('"') {
                at += 1;
            } else {
                diagnostics.push(
                    Diagnostic::new(
                        "E0202",
                        Span::new(file, start, at),
                        "this text does not end on its line",
                    )
                    .help("close it with a double quote"),
                );
            }
            found.push((Token::Text(text), Span::new(file, start, at)));
        } else if let Some(sign) = SIGNS.iter().find(|s| rest.starts_with(**s)) {
            at += sign.len();
            let span = Span::new(file, start, at);
            let meant = match *sign {
                "==" => Some("="),
                "!=" => Some("<>"),
                "=>" => Some("->"),
                "&&" => Some("and"),
                "||" => Some("or"),
                _ => None,
            };
            if let Some(meant) = meant {
                diagnostics.push(
                    Diagnostic::new("E0201", span, format!("`{sign}` is not an operator here"))
                        .help(format!("write `{meant}`")),
                );
            }
            found.push(match meant {
                Some("and") => (Token::Word("and".into()), span),
                Some("or") => (Token::Word("or".into()), span),
                Some(sign) => (Token::Sign(sign), span),
                None => (Token::Sign(sign), span),
            });
        } else {
            at += c.len_utf8();
            let help = match c {
                '!' => "write `not`",
                '&' => "write `and`",
                '|' => "write `or`",
                '%' if foreign::is_address(rest) => {
                    "addresses stand in a table: `autogen build LAYOUT --io TABLE`"
                }
                '%' => "write `mod`",
                '\'' => "texts are in double quotes",
                _ => "names have letters a to z, digits and underscores; comments begin with `//`",
            };
            let shown = if c.is_control() { c.escape_default().to_string() } else { c.to_string() };
            diagnostics.push(
                Diagnostic::new(
                    "E0201",
                    Span::new(file, start, at),
                    format!("`{shown}` is not part of the language"),
                )
                .help(help),
            );
        }
    }
    let end = if at < text.len() { at } else { text.trim_end().len() };
    found.push((Token::End, Span::new(file, end, end)));
    (found, diagnostics)
}

fn number_length(rest: &str) -> usize {
    let bytes = rest.as_bytes();
    let digits = |mut i: usize| {
        while bytes.get(i).is_some_and(u8::is_ascii_digit) {
            i += 1;
        }
        i
    };
    let mut i = digits(0);
    if bytes.get(i) == Some(&b'.') && bytes.get(i + 1).is_some_and(u8::is_ascii_digit) {
        i = digits(i + 1);
    }
    if matches!(bytes.get(i), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(i + 1), Some(b'+' | b'-')));
        if bytes.get(i + 1 + sign).is_some_and(u8::is_ascii_digit) {
            i = digits(i + 1 + sign);
        }
    }
    i
}

fn number(text: &str, span: Span, diagnostics: &mut Vec<Diagnostic>) -> Token {
    if text.bytes().all(|b| b.is_ascii_digit()) {
        match text.parse::<i64>() {
            Ok(value) if value <= i64::from(i32::MAX) => return Token::Int(value),
            _ => diagnostics.push(
                Diagnostic::new("E0203", span, format!("`{text}` is too large for a whole number"))
                    .help("whole numbers go from -2147483647 to 2147483647; a real has a decimal point"),
            ),
        }
        return Token::Int(0);
    }
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Token::Real(value),
        _ => {
            diagnostics.push(
                Diagnostic::new("E0203", span, format!("`{text}` is too large for a real"))
                    .help("reals go to 1.7e308"),
            );
            Token::Real(0.0)
        }
    }
}
