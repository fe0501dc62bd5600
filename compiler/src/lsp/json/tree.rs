//! JSON that is being typed: what can be understood of a text that may end anywhere, and where a place is in it.

use std::ops::Range;

/// Lists and objects in one another that are looked into; what stands deeper is passed over.
const DEEPEST: usize = 64;

#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// In bytes; of a text with its quotes. What is not closed ends one byte later than what is known of it, so that
    /// the place there is within.
    pub span: Range<usize>,
    pub kind: Kind,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    Object(Vec<Member>),
    List(Vec<Node>),
    Text(String),
    /// A number, a word, or the beginning of one, as it is written.
    Bare(String),
    /// Only space, where a value has to be.
    Nothing,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Member {
    pub name: String,
    /// In bytes, with its quotes.
    pub key: Range<usize>,
    /// None without a colon.
    pub value: Option<Node>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    Key(String),
    Index(usize),
}

/// What a place in a text is for.
#[derive(Clone, Debug, PartialEq)]
pub enum Wanted {
    Key { has_colon: bool },
    Value,
}

/// Where somebody types.
#[derive(Debug)]
pub struct Place<'t> {
    /// To what is typed: of a key to its object, of a value to the value itself.
    pub path: Vec<Step>,
    /// The values on the path, from the whole text to the object or list in which the place is.
    pub around: Vec<&'t Node>,
    pub wanted: Wanted,
    /// What a word would replace.
    pub span: Range<usize>,
}

/// The value that a text holds, as far as it can be understood.
pub fn parse(text: &str) -> Node {
    let mut reader = Reader { text, at: 0, depth: 0 };
    reader.value()
}

impl Node {
    pub fn get(&self, key: &str) -> Option<&Node> {
        self.members().iter().find(|member| member.name == key)?.value.as_ref()
    }

    pub fn text(&self) -> Option<&str> {
        match &self.kind {
            Kind::Text(text) => Some(text),
            _ => None,
        }
    }

    /// Whole, and not negative.
    pub fn number(&self) -> Option<usize> {
        match &self.kind {
            Kind::Bare(text) => text.parse().ok(),
            _ => None,
        }
    }

    pub fn members(&self) -> &[Member] {
        match &self.kind {
            Kind::Object(members) => members,
            _ => &[],
        }
    }

    pub fn items(&self) -> &[Node] {
        match &self.kind {
            Kind::List(items) => items,
            _ => &[],
        }
    }

    /// Where a place in bytes is; none outside of all objects and lists.
    pub fn place(&self, offset: usize) -> Option<Place<'_>> {
        let mut place =
            Place { path: Vec::new(), around: Vec::new(), wanted: Wanted::Value, span: offset..offset };
        if self.holds(offset) {
            self.descend(offset, &mut place);
        }
        Some(place).filter(|place| !place.around.is_empty())
    }

    fn descend<'t>(&'t self, offset: usize, place: &mut Place<'t>) {
        match &self.kind {
            Kind::Object(members) => {
                place.around.push(self);
                place.wanted = Wanted::Key { has_colon: false };
                for member in members {
                    if touches(&member.key, offset) {
                        place.span = member.key.clone();
                        place.wanted = Wanted::Key { has_colon: member.value.is_some() };
                        return;
                    }
                    if let Some(value) = member.value.as_ref().filter(|value| value.holds(offset)) {
                        place.path.push(Step::Key(member.name.clone()));
                        return value.descend(offset, place);
                    }
                }
            }
            Kind::List(items) => {
                place.around.push(self);
                place.wanted = Wanted::Value;
                let number = items.iter().take_while(|item| item.span.end < offset).count();
                place.path.push(Step::Index(number));
                if let Some(item) = items.get(number).filter(|item| item.holds(offset)) {
                    item.descend(offset, place);
                }
            }
            Kind::Text(_) | Kind::Bare(_) => {
                place.wanted = Wanted::Value;
                place.span = self.span.clone();
            }
            Kind::Nothing => place.wanted = Wanted::Value,
        }
    }

    /// Before an opening bracket and behind a closing one is outside.
    fn holds(&self, offset: usize) -> bool {
        match self.kind {
            Kind::Object(_) | Kind::List(_) => self.span.start < offset && offset < self.span.end,
            Kind::Text(_) | Kind::Bare(_) | Kind::Nothing => touches(&self.span, offset),
        }
    }
}

fn touches(span: &Range<usize>, offset: usize) -> bool {
    (span.start..=span.end).contains(&offset)
}

struct Reader<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
}

impl Reader<'_> {
    fn peek(&self) -> Option<char> {
        self.text[self.at..].chars().next()
    }

    fn advance(&mut self) {
        self.at += self.peek().map_or(0, char::len_utf8);
    }

    fn space(&mut self) {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
    }

    fn value(&mut self) -> Node {
        let before = self.at;
        self.space();
        let start = self.at;
        let kind = match self.peek() {
            Some('{' | '[') if self.depth == DEEPEST => {
                self.advance();
                Kind::Bare(String::new())
            }
            Some('{') => return self.within(start, Self::members),
            Some('[') => return self.within(start, Self::items),
            Some('"') => Kind::Text(self.quoted()),
            None | Some('}' | ']' | ',' | ':') => return Node { span: before..start, kind: Kind::Nothing },
            Some(_) => Kind::Bare(self.word()),
        };
        Node { span: start..self.at, kind }
    }

    fn within(&mut self, start: usize, read: fn(&mut Self) -> Kind) -> Node {
        self.depth += 1;
        self.advance();
        let kind = read(self);
        self.depth -= 1;
        let closing = if matches!(kind, Kind::Object(_)) { '}' } else { ']' };
        match self.peek() == Some(closing) {
            true => {
                self.advance();
                Node { span: start..self.at, kind }
            }
            false => Node { span: start..self.at + 1, kind },
        }
    }

    /// To the closing brace, or to what shows that it is missing.
    fn members(&mut self) -> Kind {
        let mut members = Vec::new();
        loop {
            self.space();
            let start = self.at;
            let name = match self.peek() {
                None | Some('}') => return Kind::Object(members),
                Some(']') if self.depth > 1 => return Kind::Object(members),
                Some('"') => self.quoted(),
                Some(',' | ':' | '{' | '[' | ']') => {
                    self.advance();
                    continue;
                }
                Some(_) => self.word(),
            };
            let key = start..self.at;
            self.space();
            let value = (self.peek() == Some(':')).then(|| {
                self.advance();
                self.value_of_member()
            });
            members.push(Member { name, key, value });
        }
    }

    /// A text before a colon is the next key: nobody has written the value yet.
    fn value_of_member(&mut self) -> Node {
        let start = self.at;
        let value = self.value();
        let end = self.at;
        self.space();
        if self.peek() == Some(':') && matches!(value.kind, Kind::Text(_)) {
            self.at = value.span.start;
            return Node { span: start..value.span.start, kind: Kind::Nothing };
        }
        self.at = end;
        value
    }

    fn items(&mut self) -> Kind {
        let mut items = Vec::new();
        loop {
            self.space();
            match self.peek() {
                None | Some(']') => return Kind::List(items),
                Some('}') if self.depth > 1 => return Kind::List(items),
                Some(',' | ':' | '}') => self.advance(),
                Some(_) => items.push(self.value()),
            }
        }
    }

    /// To the end of the line, if it is not closed.
    fn quoted(&mut self) -> String {
        self.advance();
        let start = self.at;
        let mut is_escaped = false;
        while let Some(c) = self.peek().filter(|c| *c != '\n' && *c != '\r') {
            if c == '"' && !is_escaped {
                let text = self.text[start..self.at].into();
                self.advance();
                return text;
            }
            is_escaped = c == '\\' && !is_escaped;
            self.advance();
        }
        self.text[start..self.at].into()
    }

    fn word(&mut self) -> String {
        let start = self.at;
        let ends = |c: char| c.is_whitespace() || "{}[]\",:".contains(c);
        while self.peek().is_some_and(|c| !ends(c)) {
            self.advance();
        }
        self.text[start..self.at].into()
    }
}

#[cfg(test)]
mod tests {
    use super::{Kind, Step, Wanted, parse};

    /// The path to the mark `|` in a text, and what is wanted there.
    fn place(text: &str) -> Option<(String, Wanted, String)> {
        let offset = text.find('|').expect("a mark");
        let text = text.replacen('|', "", 1);
        let tree = parse(&text);
        let place = tree.place(offset)?;
        let path: Vec<String> = place
            .path
            .iter()
            .map(|step| match step {
                Step::Key(name) => name.clone(),
                Step::Index(number) => number.to_string(),
            })
            .collect();
        Some((path.join("/"), place.wanted, text[place.span].to_string()))
    }

    fn at(path: &str, wanted: Wanted, replaced: &str) -> Option<(String, Wanted, String)> {
        Some((path.into(), wanted, replaced.into()))
    }

    #[test]
    fn places_are_found_in_whole_texts() {
        let (new, old) = (Wanted::Key { has_colon: false }, Wanted::Key { has_colon: true });
        assert_eq!(place("|{}"), None);
        assert_eq!(place("{|}"), at("", new.clone(), ""));
        assert_eq!(place("{}|"), None);
        assert_eq!(place(r#"{"a|b": 1}"#), at("", old, "\"ab\""));
        assert_eq!(place(r#"{"a": 1, |}"#), at("", new.clone(), ""));
        assert_eq!(place(r#"{"a": "b|"}"#), at("a", Wanted::Value, "\"b\""));
        assert_eq!(place(r#"{"a": [1, {"b": tr|ue}]}"#), at("a/1/b", Wanted::Value, "true"));
        assert_eq!(place(r#"{"a": ["x", |]}"#), at("a/1", Wanted::Value, ""));
        assert_eq!(place(r#"{"a": [{}, {|}]}"#), at("a/1", new, ""));
    }

    #[test]
    fn places_are_found_in_texts_that_are_typed() {
        let new = Wanted::Key { has_colon: false };
        assert_eq!(place("{ \"na|"), at("", new.clone(), "\"na"));
        assert_eq!(place("{ na|"), at("", new.clone(), "na"));
        assert_eq!(place("{\"a\": |"), at("a", Wanted::Value, ""));
        assert_eq!(place("{\"a\": |\n  \"b\": 1}"), at("a", Wanted::Value, ""));
        assert_eq!(place("{\"a\": \"x|\n  \"b\": 1}"), at("a", Wanted::Value, "\"x"));
        assert_eq!(place("{\"a\": [{\"b\": 1, |], \"c\": 2}"), at("a/0", new.clone(), ""));
        assert_eq!(place("{\"a\": [|, \"c\": 2}"), at("a/0", Wanted::Value, ""));
        assert_eq!(place("{\"a\" |\n  \"b\": 1}"), at("", new, ""));
        // The key behind a missing value is a key.
        let old = Wanted::Key { has_colon: true };
        assert_eq!(place("{\"a\":\n  \"b|c\": 1}"), at("", old, "\"bc\""));
    }

    #[test]
    fn what_stands_deep_or_wrong_is_passed_over() {
        for text in ["[".repeat(100_000), "{\"a\":".repeat(100_000), "}]:,".repeat(1000), "\"\\".into()] {
            parse(&text).place(text.len());
        }
        let tree = parse("{\"a\": \"\\\"\", ]} }");
        assert_eq!(tree.get("a").map(|node| &node.kind), Some(&Kind::Text("\\\"".into())));
    }
}
