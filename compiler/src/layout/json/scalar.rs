//! Texts, numbers and words.

use super::{Reader, Value};
use crate::diagnostic::Diagnostic;

impl Reader<'_> {
    pub(super) fn string(&mut self) -> String {
        let start = self.at;
        let quote = self.peek().unwrap_or('"');
        self.advance();
        if quote == '\'' {
            self.syntax(self.span(start), "texts are in double quotes", "write \" instead of '");
        }
        let mut out = String::new();
        loop {
            let plain = |byte: &&u8| matches!(**byte, b' '..=b'~') && !matches!(**byte, b'"' | b'\'' | b'\\');
            let at = self.at + self.text.as_bytes()[self.at..].iter().take_while(plain).count();
            out.push_str(&self.text[self.at..at]);
            self.at = at;
            match self.peek() {
                Some(c) if c == quote => {
                    self.advance();
                    return out;
                }
                None | Some('\n') => {
                    self.report(
                        Diagnostic::new("E0102", self.span(start), "the text is not closed on its line")
                            .label("opened here")
                            .note("the rest was not read, because it is unknown which part of it is text")
                            .help(format!("add the closing {quote}; for a line break in a text write \\n")),
                    );
                    self.give_up();
                    return out;
                }
                Some('\\') => self.escape(&mut out),
                Some(c) if c.is_control() || c == char::REPLACEMENT_CHARACTER => {
                    self.advance();
                    let what =
                        if c.is_control() { "a control character" } else { "a byte that is not UTF-8" };
                    self.bad_text(at, format!("the text contains {what}"));
                }
                Some(c) => {
                    out.push(c);
                    self.advance();
                }
            }
        }
    }

    fn escape(&mut self, out: &mut String) {
        let start = self.at;
        self.advance();
        let c = self.peek();
        self.advance();
        match c {
            Some(c @ ('"' | '\\' | '/' | '\'')) => out.push(c),
            Some('n') => out.push('\n'),
            Some('t') => out.push('\t'),
            Some('r') => out.push('\r'),
            Some('b') => out.push('\u{8}'),
            Some('f') => out.push('\u{c}'),
            Some('u') => {
                let high = self.hex();
                let code = match high {
                    Some(high @ 0xd800..0xdc00) if self.text[self.at..].starts_with("\\u") => {
                        self.at += 2;
                        self.hex()
                            .filter(|low| (0xdc00..0xe000).contains(low))
                            .map(|low| 0x10000 + ((high - 0xd800) << 10) + (low - 0xdc00))
                    }
                    other => other,
                };
                match code.and_then(char::from_u32) {
                    Some(c) => out.push(c),
                    None => self.bad_text(start, "the escape names no character".into()),
                }
            }
            _ => self.bad_text(start, "JSON has no such escape".into()),
        }
    }

    /// Four hexadecimal digits.
    fn hex(&mut self) -> Option<u32> {
        let digits = self.text.get(self.at..self.at + 4)?;
        let value = digits
            .bytes()
            .all(|b| b.is_ascii_hexdigit())
            .then(|| u32::from_str_radix(digits, 16).ok())
            .flatten()?;
        self.at += 4;
        Some(value)
    }

    fn bad_text(&mut self, start: usize, message: String) {
        let place = self.since(start);
        self.report(
            Diagnostic::new("E0104", place, message)
                .note("texts are UTF-8; known escapes: \\\" \\\\ \\/ \\b \\f \\n \\r \\t \\uXXXX")
                .help("remove it, or write a known escape"),
        );
    }

    pub(super) fn number(&mut self) -> Option<Value> {
        let start = self.at;
        let in_number = |byte: &&u8| byte.is_ascii_digit() || matches!(**byte, b'+' | b'-' | b'.' | b'e');
        self.at += self.text.as_bytes()[start..].iter().take_while(in_number).count();
        while self.peek().is_some_and(|c| c.is_alphanumeric() || "+-._".contains(c)) {
            self.advance();
        }
        let word = &self.text[start..self.at];
        let place = self.since(start);
        let value = word.parse::<f64>().ok();
        if is_json_number(word) && value.is_some_and(f64::is_finite) {
            return value.map(Value::Number);
        }
        if is_json_number(word) {
            self.report(
                Diagnostic::new("E0107", place, "the number is too large")
                    .note(format!("the largest number of 64 bits is {:e}", f64::MAX))
                    .help("write a smaller number"),
            );
            return None;
        }
        let number = word.trim_end_matches(char::is_alphabetic);
        let (note, help) = match number.len() < word.len() && is_json_number(number) {
            true => (
                "numbers are written without a unit: lengths are in m, times in s",
                "convert it to this unit, and write the number alone, like 0.5",
            ),
            false => (
                "a number has digits before and after its point, no leading zero and no leading plus",
                "write it like 0.5, -3 or 1e-3",
            ),
        };
        let message = format!("`{word}` is not a number of JSON");
        self.report(Diagnostic::new("E0103", place, message).note(note).help(help));
        value.filter(|v| v.is_finite()).map(Value::Number)
    }

    pub(super) fn take_word(&mut self) -> String {
        let start = self.at;
        while self.peek().is_some_and(|c| c.is_alphanumeric() || c == '_') {
            self.advance();
        }
        self.text[start..self.at].to_string()
    }

    pub(super) fn word(&mut self) -> Option<Value> {
        let start = self.at;
        let word = self.take_word();
        let meant = match word.as_str() {
            "null" => return Some(Value::Null),
            "true" => return Some(Value::Bool(true)),
            "false" => return Some(Value::Bool(false)),
            _ => match word.to_lowercase().as_str() {
                "true" => "write true".into(),
                "false" => "write false".into(),
                "none" | "nil" | "undefined" => "write null".into(),
                "nan" | "inf" | "infinity" => "write a finite number".into(),
                _ => format!("write \"{word}\" if a text is meant"),
            },
        };
        self.syntax(self.since(start), format!("`{word}` is not a value of JSON"), meant);
        None
    }
}

fn is_json_number(word: &str) -> bool {
    let digits = |s: &str| !s.is_empty() && s.bytes().all(|b| b.is_ascii_digit());
    let unsigned = word.strip_prefix('-').unwrap_or(word);
    let is_e = |byte: u8| byte == b'e' || byte == b'E';
    let (mantissa, exponent) = match unsigned.bytes().position(is_e).map(|at| unsigned.split_at(at)) {
        Some((m, e)) => (m, Some(e[1..].strip_prefix(['+', '-']).unwrap_or(&e[1..]))),
        None => (unsigned, None),
    };
    let (whole, fraction) = match mantissa.split_once('.') {
        Some((w, f)) => (w, Some(f)),
        None => (mantissa, None),
    };
    digits(whole)
        && (whole == "0" || !whole.starts_with('0'))
        && fraction.is_none_or(digits)
        && exponent.is_none_or(digits)
}
