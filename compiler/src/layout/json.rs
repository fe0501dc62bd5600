//! JSON with the place of every value and key.

mod scalar;

use crate::diagnostic::Diagnostic;
use crate::source::{FileId, Span, Spanned};
use std::collections::HashMap;
use std::fmt::Display;

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

/// Lists and objects may be nested this deep.
const DEEPEST: usize = 64;
/// After so many errors the text is no JSON, and more of them would not help.
const MOST_ERRORS: usize = 20;
/// Passed over wherever there may be space.
const BYTE_ORDER_MARK: char = '\u{feff}';
/// Members of an object whose keys are compared one by one.
const FEW_MEMBERS: usize = 16;
/// Values of one text: a line of 10,000 robots has half of it.
const MOST_VALUES: usize = 500_000;

/// Reads on after an error where the rest can still be understood; there is no value if a part of it was lost.
pub fn parse(text: &str, file: FileId) -> (Option<Json>, Vec<Diagnostic>) {
    let mut reader =
        Reader { text, file, at: 0, depth: 0, values: 0, complete: true, diagnostics: Vec::new() };
    reader.space();
    let value = reader.value(&"a value");
    reader.space();
    if !reader.stopped() && reader.at < text.len() {
        let found =
            Diagnostic::new("E0108", reader.span(reader.at), "there is text after the end of the JSON value");
        let is_object = value.as_ref().is_none_or(|value| matches!(value.value, Value::Object(_)));
        reader.report(if is_object {
            found
                .note("a file has one value, here one object in braces")
                .help("remove the text, or the brace before it if the object was closed too early")
        } else {
            found.help("remove the text; several values of an option are separated by commas")
        });
    }
    (value.filter(|_| reader.complete), reader.diagnostics)
}

struct Reader<'a> {
    text: &'a str,
    file: FileId,
    at: usize,
    depth: usize,
    /// Read so far.
    values: usize,
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
            let bytes = &self.text.as_bytes()[self.at..];
            self.at += bytes.iter().take_while(|byte| byte.is_ascii_whitespace()).count();
            let rest = &self.text[self.at..];
            if rest.starts_with(BYTE_ORDER_MARK) {
                self.at += BYTE_ORDER_MARK.len_utf8();
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

    fn value(&mut self, wanted: &dyn Display) -> Option<Json> {
        let start = self.at;
        self.values += 1;
        if self.values > MOST_VALUES {
            let message = format!("a text has at most {MOST_VALUES} values");
            self.report(
                Diagnostic::new("E0142", self.span(start), message)
                    .note("numbers, texts, lists and objects count, each of them")
                    .help("make several lines of this one"),
            );
            self.give_up();
            return None;
        }
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
                Diagnostic::new("E0105", place, format!("more than {DEEPEST} lists and objects are nested"))
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
        self.elements(']', |reader| items.extend(reader.value(&"a value")));
        Value::List(items)
    }

    fn object(&mut self) -> Value {
        let mut members: Vec<Member> = Vec::new();
        // Few keys are looked through: a layout has thousands of small objects.
        let mut places: HashMap<String, Span> = HashMap::new();
        self.elements('}', |reader| {
            let Some(member) = reader.member() else { return };
            if members.len() == FEW_MEMBERS {
                places.extend(members.iter().map(|m| (m.key.value.clone(), m.key.span)));
            }
            let first = match members.len() < FEW_MEMBERS {
                true => members.iter().find(|m| m.key.value == member.key.value).map(|m| m.key.span),
                false => places.get(&member.key.value).copied(),
            };
            if let Some(place) = first {
                let key = &member.key.value;
                reader.report(
                    Diagnostic::new(
                        "E0106",
                        member.key.span,
                        format!("the key \"{key}\" occurs twice in one object"),
                    )
                    .label("again here")
                    .other(place, "first here")
                    .note("it is not defined which of the two counts")
                    .help("remove one of them"),
                );
            } else {
                if members.len() >= FEW_MEMBERS {
                    places.insert(member.key.value.clone(), member.key.span);
                }
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
        self.stopped() || self.diagnostics.iter().any(|d| matches!(d.code, "E0102" | "E0105" | "E0142"))
    }

    fn member(&mut self) -> Option<Member> {
        let start = self.at;
        let key = match self.peek() {
            Some('"' | '\'') => self.string(),
            Some(c) if c.is_alphanumeric() || c == '_' => {
                let word = self.take_word();
                self.syntax(
                    self.since(start),
                    format!("the key {word} has no quotes"),
                    format!("write \"{word}\""),
                );
                word
            }
            _ => {
                self.expected(&"a key in double quotes");
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
        let value = self.value(&format_args!("a value for \"{}\"", key.value))?;
        Some(Member { key, value })
    }

    fn syntax(&mut self, place: Span, message: impl Into<String>, help: impl Into<String>) {
        self.report(Diagnostic::new("E0101", place, message).help(help));
    }

    fn expected(&mut self, wanted: &dyn Display) {
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

    fn ended(&mut self, wanted: &dyn Display) {
        self.complete = false;
        if self.cut_off() {
            return;
        }
        let place = self.span(self.text.len());
        self.report(
            Diagnostic::new("E0102", place, format!("the text ends where {wanted} is expected"))
                .help("the file seems to be incomplete: complete it"),
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
