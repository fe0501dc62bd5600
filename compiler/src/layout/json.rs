//! JSON with the place of every value and key.

use crate::diagnostic::Diagnostic;
use crate::source::{FileId, Span, Spanned};

#[derive(Clone, Debug, PartialEq)]
pub struct Json {
    pub value: Value,
    pub span: Span,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    Null,
    Bool(bool),
    Number(f64),
    Text(String),
    List(Vec<Json>),
    Object(Vec<Member>),
}

#[derive(Clone, Debug, PartialEq)]
pub struct Member {
    pub key: Spanned<String>,
    pub value: Json,
}

/// Lists and objects may stand in one another this deep.
const DEEPEST: usize = 64;
/// After so many errors the text is no JSON, and more of them would not help.
const MOST_ERRORS: usize = 20;

/// Reads on after an error where the rest can still be understood; there is no value if a part of it was lost.
pub fn parse(text: &str, file: FileId) -> (Option<Json>, Vec<Diagnostic>) {
    let mut reader = Reader { text, file, at: 0, depth: 0, complete: true, diagnostics: Vec::new() };
    reader.space();
    let value = reader.value("a value");
    reader.space();
    if !reader.stopped() && reader.at < text.len() {
        let place = reader.span(reader.at);
        reader.report(
            Diagnostic::new("E0108", place, "there is text after the end of the JSON value")
                .note("a file holds one value, here one object in braces")
                .help("remove the text, or the brace before it if the object was closed too early"),
        );
    }
    (value.filter(|_| reader.complete), reader.diagnostics)
}

struct Reader<'a> {
    text: &'a str,
    file: FileId,
    at: usize,
    depth: usize,
    /// False when a value was lost.
    complete: bool,
    diagnostics: Vec<Diagnostic>,
}

impl Reader<'_> {
    fn peek(&self) -> Option<char> {
        self.text[self.at..].chars().next()
    }

    fn advance(&mut self) {
        self.at += self.peek().map_or(0, char::len_utf8);
    }

    /// The next character, or nothing at the end.
    fn span(&self, start: usize) -> Span {
        let end = start + self.text[start..].chars().next().map_or(0, char::len_utf8);
        Span::new(self.file, start, end)
    }

    fn since(&self, start: usize) -> Span {
        Span::new(self.file, start, self.at)
    }

    fn stopped(&self) -> bool {
        self.diagnostics.len() >= MOST_ERRORS
    }

    /// Stops reading by going to the end when there are too many errors.
    fn report(&mut self, diagnostic: Diagnostic) {
        if !self.stopped() {
            let last = self.diagnostics.len() + 1 == MOST_ERRORS;
            let diagnostic =
                if last { diagnostic.note("after so many errors the rest was not read") } else { diagnostic };
            self.diagnostics.push(diagnostic);
        }
        if self.stopped() {
            self.give_up();
        }
    }

    fn give_up(&mut self) {
        self.complete = false;
        self.at = self.text.len();
    }

    fn space(&mut self) {
        loop {
            let rest = &self.text[self.at..];
            if let Some(c) = rest.chars().next().filter(|c| c.is_ascii_whitespace() || *c == '\u{feff}') {
                self.at += c.len_utf8();
            } else if rest.starts_with("//") || rest.starts_with("/*") {
                let start = self.at;
                let close = if rest.starts_with("//") { "\n" } else { "*/" };
                self.at += rest.find(close).map_or(rest.len(), |i| i + close.len());
                let place = Span::new(self.file, start, start + 2);
                self.report(
                    Diagnostic::new("E0101", place, "JSON has no comments")
                        .note("the standard (RFC 8259) allows only values and white space")
                        .help("remove the comment"),
                );
            } else {
                return;
            }
        }
    }

    fn value(&mut self, wanted: &str) -> Option<Json> {
        let start = self.at;
        let value = match self.peek() {
            Some('{') => self.nested(Self::object),
            Some('[') => self.nested(Self::list),
            Some('"' | '\'') => Some(Value::Text(self.string())),
            Some(c) if c.is_ascii_digit() || "+-.".contains(c) => self.number(),
            Some(c) if c.is_alphabetic() || c == '_' => self.word(),
            Some(c) => {
                self.expected(wanted);
                if !",:]}".contains(c) {
                    self.skip();
                }
                None
            }
            None => {
                self.ended(wanted);
                None
            }
        };
        if value.is_none() {
            self.complete = false;
        }
        value.map(|value| Json { value, span: self.since(start) })
    }

    fn nested(&mut self, read: fn(&mut Self) -> Value) -> Option<Value> {
        if self.depth == DEEPEST {
            let place = self.span(self.at);
            self.report(
                Diagnostic::new(
                    "E0105",
                    place,
                    format!("more than {DEEPEST} lists and objects stand in one another"),
                )
                .note("no key of a layout or a scenario needs more than 6")
                .help("look for a bracket that is repeated or not closed"),
            );
            self.give_up();
            return None;
        }
        self.depth += 1;
        let value = read(self);
        self.depth -= 1;
        Some(value)
    }

    fn list(&mut self) -> Value {
        let mut items = Vec::new();
        self.elements(']', |reader| items.extend(reader.value("a value")));
        Value::List(items)
    }

    fn object(&mut self) -> Value {
        let mut members: Vec<Member> = Vec::new();
        self.elements('}', |reader| {
            let Some(member) = reader.member() else { return };
            if let Some(first) = members.iter().find(|m| m.key.value == member.key.value) {
                let (key, place) = (&member.key.value, first.key.span);
                reader.report(
                    Diagnostic::new(
                        "E0106",
                        member.key.span,
                        format!("the key \"{key}\" stands twice in one object"),
                    )
                    .label("again here")
                    .other(place, "first here")
                    .note("which of the two counts would be left to chance")
                    .help("remove one of them"),
                );
            } else {
                members.push(member);
            }
        });
        Value::Object(members)
    }

    /// What stands between brackets, with its commas.
    fn elements(&mut self, close: char, mut element: impl FnMut(&mut Self)) {
        let open = self.at;
        self.advance();
        self.space();
        let mut comma: Option<usize> = None;
        let mut first = true;
        while let Some(c) = self.peek() {
            if c == close {
                if let Some(at) = comma {
                    self.syntax(self.span(at), "there is a comma after the last element", "remove the comma");
                }
                self.advance();
                return;
            }
            if c == ']' || c == '}' {
                break;
            }
            if !first && comma.is_none() {
                self.syntax(
                    self.span(self.at),
                    "a comma is missing between two elements",
                    "put a comma before this",
                );
            }
            let before = self.at;
            element(self);
            self.space();
            comma = None;
            while self.peek() == Some(',') {
                if comma.is_some() {
                    self.syntax(self.span(self.at), "there are two commas in a row", "remove one of them");
                }
                comma = Some(self.at);
                self.advance();
                self.space();
            }
            if self.at == before && self.peek() == Some(':') {
                self.advance();
                self.space();
            }
            first = false;
        }
        self.complete = false;
        let (code, end) = match self.at < self.text.len() {
            true => ("E0101", "here"),
            false => ("E0102", "at the end of the text"),
        };
        if code == "E0102" && self.cut_off() {
            return;
        }
        let bracket = if close == ']' { '[' } else { '{' };
        let message = format!("the bracket `{bracket}` is not closed {end}");
        self.report(
            Diagnostic::new(code, self.span(self.at), message)
                .label(format!("expected `{close}`"))
                .other(self.span(open), "opened here")
                .help(format!("add `{close}`")),
        );
    }

    /// The end of the text was met too early and is reported, or reading was given up.
    fn cut_off(&self) -> bool {
        self.stopped() || self.diagnostics.iter().any(|d| matches!(d.code, "E0102" | "E0105"))
    }

    fn member(&mut self) -> Option<Member> {
        let start = self.at;
        let key = match self.peek() {
            Some('"' | '\'') => self.string(),
            Some(c) if c.is_alphanumeric() || c == '_' => {
                let word = self.take_word();
                self.syntax(
                    self.since(start),
                    format!("the key {word} stands without quotes"),
                    format!("write \"{word}\""),
                );
                word
            }
            _ => {
                self.expected("a key in double quotes");
                self.complete = false;
                if self.peek() != Some(',') {
                    self.skip();
                }
                return None;
            }
        };
        let key = Spanned { value: key, span: self.since(start) };
        self.space();
        match self.peek() {
            Some(':') => self.advance(),
            Some('=') => {
                self.syntax(self.span(self.at), "a key and its value are joined by a colon", "write `:`");
                self.advance();
            }
            Some(c) if !",]}".contains(c) => {
                let place = self.span(self.at);
                self.syntax(
                    place,
                    format!("a colon is missing after the key \"{}\"", key.value),
                    "put `:` before this",
                );
            }
            _ => {}
        }
        self.space();
        let wanted = format!("a value for \"{}\"", key.value);
        let value = self.value(&wanted)?;
        Some(Member { key, value })
    }

    fn string(&mut self) -> String {
        let start = self.at;
        let quote = self.peek().unwrap_or('"');
        self.advance();
        if quote == '\'' {
            self.syntax(self.span(start), "texts stand in double quotes", "write \" instead of '");
        }
        let mut out = String::new();
        loop {
            let at = self.at;
            match self.peek() {
                Some(c) if c == quote => {
                    self.advance();
                    return out;
                }
                None | Some('\n') => {
                    self.report(
                        Diagnostic::new("E0102", self.span(start), "the text is not closed on its line")
                            .label("opened here")
                            .note("the rest was not read: what is text there and what is not cannot be told")
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
                    self.bad_text(at, format!("the text holds {what}"));
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
            _ => self.bad_text(start, "JSON knows no such escape".into()),
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

    fn number(&mut self) -> Option<Value> {
        let start = self.at;
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
        self.report(
            Diagnostic::new("E0103", place, format!("`{word}` is not a number of JSON"))
                .note("a number has digits before and after its point, no leading zero and no leading plus")
                .help("write it like 0.5, -3 or 1e-3"),
        );
        value.filter(|v| v.is_finite()).map(Value::Number)
    }

    fn take_word(&mut self) -> String {
        let start = self.at;
        while self.peek().is_some_and(|c| c.is_alphanumeric() || c == '_') {
            self.advance();
        }
        self.text[start..self.at].to_string()
    }

    fn word(&mut self) -> Option<Value> {
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

    fn syntax(&mut self, place: Span, message: impl Into<String>, help: impl Into<String>) {
        self.report(Diagnostic::new("E0101", place, message).help(help));
    }

    fn expected(&mut self, wanted: &str) {
        if self.at == self.text.len() {
            return self.ended(wanted);
        }
        let place = self.span(self.at);
        let found = self.peek().map_or(String::new(), |c| match c {
            char::REPLACEMENT_CHARACTER => "a byte that is not UTF-8".into(),
            c => format!("`{}`", c.escape_debug()),
        });
        let message = format!("expected {wanted}, found {found}");
        self.syntax(place, message, format!("put {wanted} here, or remove {found}"));
    }

    fn ended(&mut self, wanted: &str) {
        self.complete = false;
        if self.cut_off() {
            return;
        }
        let place = self.span(self.text.len());
        self.report(
            Diagnostic::new("E0102", place, format!("the text ends where {wanted} is expected"))
                .help("the file seems to be cut off: complete it"),
        );
    }

    /// To the next comma, bracket or line; always past one character at least.
    fn skip(&mut self) {
        self.advance();
        while self.peek().is_some_and(|c| !",[]{}\"\n".contains(c)) {
            self.advance();
        }
    }
}

fn is_json_number(word: &str) -> bool {
    let digits = |s: &str| !s.is_empty() && s.bytes().all(|b| b.is_ascii_digit());
    let unsigned = word.strip_prefix('-').unwrap_or(word);
    let (mantissa, exponent) = match unsigned.split_once(['e', 'E']) {
        Some((m, e)) => (m, Some(e.strip_prefix(['+', '-']).unwrap_or(e))),
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
