//! YAML as files of parameters use it: maps and lists by indentation, lists in brackets, words and numbers. Whatever else
//! YAML has (anchors, tags, texts over several lines, several documents) is refused with its place.

use crate::diagnostic::Diagnostic;
use crate::import::stop;
use crate::source::{FileId, Span, Spanned};

#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    pub value: Value,
    pub span: Span,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Without quotes.
    Scalar(String),
    List(Vec<Node>),
    Map(Vec<Entry>),
}

#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    pub key: Spanned<String>,
    pub node: Node,
}

/// Maps and lists may be nested this deep.
const DEEPEST: usize = 16;
/// Lines and values of a file: those of an arm have 20.
const MOST: usize = 10_000;
/// Keys of a map, which are compared with one another.
const MOST_KEYS: usize = 500;

/// A line with something on it.
#[derive(Clone, Copy)]
struct Line<'a> {
    /// Of its first character.
    at: usize,
    indent: usize,
    /// Without a comment and white space.
    text: &'a str,
}

/// The first error ends the reading.
pub fn parse(text: &str, file: FileId) -> Result<Node, Box<Diagnostic>> {
    let mut reader = Reader { file, lines: Vec::new(), next: 0, values: 0 };
    if let Some(at) = text.find(char::REPLACEMENT_CHARACTER) {
        let place = Span::new(file, at, at + char::REPLACEMENT_CHARACTER.len_utf8());
        return stop(
            Diagnostic::new("E1109", place, "here is a byte that is not UTF-8")
                .help("save the file again as UTF-8"),
        );
    }
    reader.lines(text)?;
    if reader.lines.is_empty() {
        return stop(reader.wrong(0, 0, "there is nothing in this file"));
    }
    let node = reader.block(0, 0)?;
    match reader.peek() {
        Some(line) => {
            stop(reader.wrong(line.at, line.text.len(), "this line is not indented as those before it"))
        }
        None => Ok(node),
    }
}

struct Reader<'a> {
    file: FileId,
    lines: Vec<Line<'a>>,
    next: usize,
    values: usize,
}

impl<'a> Reader<'a> {
    fn wrong(&self, at: usize, length: usize, message: &str) -> Diagnostic {
        Diagnostic::new("E1109", Span::new(self.file, at, at + length), message)
            .help("write `key: value`, a line each; deeper lines belong to the key above them")
    }

    fn lines(&mut self, text: &'a str) -> Result<(), Box<Diagnostic>> {
        let mut at = 0;
        for whole in text.split_inclusive('\n') {
            let start = at;
            at += whole.len();
            let line = without_comment(whole).trim_end();
            let inner = line.trim_start_matches(' ');
            let indent = line.len() - inner.len();
            if inner.is_empty() || (indent == 0 && inner == "---" && self.lines.is_empty()) {
                continue;
            }
            let place = start + indent;
            if inner.starts_with('\t') {
                return stop(self.wrong(place, 1, "a tab is no indentation in YAML"));
            }
            if indent == 0 && (inner.starts_with("---") || inner.starts_with('%') || inner == "...") {
                return stop(self.wrong(
                    place,
                    inner.len(),
                    "only one YAML document without directives is read",
                ));
            }
            if self.lines.len() == MOST {
                return stop(self.wrong(place, inner.len(), &format!("the file has more than {MOST} lines")));
            }
            self.lines.push(Line { at: place, indent, text: inner });
        }
        Ok(())
    }

    fn peek(&self) -> Option<Line<'a>> {
        self.lines.get(self.next).copied()
    }

    fn deeper(&self, line: Line, depth: usize) -> Result<(), Box<Diagnostic>> {
        match depth < DEEPEST {
            true => Ok(()),
            false => stop(self.wrong(
                line.at,
                line.text.len(),
                &format!("more than {DEEPEST} maps and lists are nested"),
            )),
        }
    }

    /// The map or list whose lines are indented so.
    fn block(&mut self, indent: usize, depth: usize) -> Result<Node, Box<Diagnostic>> {
        let Some(first) = self.peek() else { return stop(self.wrong(0, 0, "there is nothing in this file")) };
        self.deeper(first, depth)?;
        if first.indent != indent {
            return stop(self.wrong(first.at, first.text.len(), "this line is indented more than it may be"));
        }
        match is_item(first.text) {
            true => self.list(indent, depth),
            false => self.map(indent, depth),
        }
    }

    fn list(&mut self, indent: usize, depth: usize) -> Result<Node, Box<Diagnostic>> {
        let mut items = Vec::new();
        let begin = self.peek().map_or(0, |line| line.at);
        let mut end = begin;
        while let Some(line) = self.peek().filter(|line| line.indent == indent && is_item(line.text)) {
            self.deeper(line, depth)?;
            let rest = line.text[1..].trim_start();
            end = line.at + line.text.len();
            let at = end - rest.len();
            if rest.is_empty() || key(rest).is_some() {
                // What stands behind the dash is a line of its own.
                match rest.is_empty() {
                    true => self.next += 1,
                    false => self.lines[self.next] = Line { at, indent: indent + (at - line.at), text: rest },
                }
                let inner = self.peek().filter(|next| next.indent > indent);
                let Some(inner) = inner else {
                    return stop(self.wrong(line.at, line.text.len(), "there is nothing behind this dash"));
                };
                let node = self.block(inner.indent, depth + 1)?;
                end = node.span.end as usize;
                items.push(node);
            } else {
                self.next += 1;
                items.push(self.value(rest, at, depth)?);
            }
        }
        Ok(Node { value: Value::List(items), span: Span::new(self.file, begin, end) })
    }

    fn map(&mut self, indent: usize, depth: usize) -> Result<Node, Box<Diagnostic>> {
        let mut entries: Vec<Entry> = Vec::new();
        let begin = self.peek().map_or(0, |line| line.at);
        let mut end = begin;
        while let Some(line) = self.peek().filter(|line| line.indent == indent) {
            self.deeper(line, depth)?;
            let Some((name, rest)) = key(line.text) else {
                return stop(self.wrong(line.at, line.text.len(), "this is no `key: value`"));
            };
            let name = self.word(name, line.at)?;
            if let Some(first) = entries.iter().find(|entry| entry.key.value == name.value) {
                return stop(
                    self.wrong(line.at, name.value.len(), &format!("the key {} occurs twice", name.value))
                        .other(first.key.span, "first here")
                        .help("remove one of them"),
                );
            }
            if entries.len() == MOST_KEYS {
                return stop(self.wrong(
                    line.at,
                    line.text.len(),
                    &format!("a map has more than {MOST_KEYS} keys"),
                ));
            }
            self.next += 1;
            let at = line.at + line.text.len() - rest.len();
            let node = match (rest.is_empty(), self.peek()) {
                // A list may stand below its key without indentation.
                (true, Some(next))
                    if next.indent > indent || (next.indent == indent && is_item(next.text)) =>
                {
                    self.block(next.indent, depth + 1)?
                }
                (true, _) => Node { value: Value::Scalar(String::new()), span: Span::new(self.file, at, at) },
                (false, _) => self.value(rest, at, depth)?,
            };
            end = (node.span.end as usize).max(at);
            entries.push(Entry { key: name, node });
        }
        Ok(Node { value: Value::Map(entries), span: Span::new(self.file, begin, end) })
    }

    /// What stands behind a key or a dash, on its line.
    fn value(&mut self, text: &str, at: usize, depth: usize) -> Result<Node, Box<Diagnostic>> {
        self.values += 1;
        if self.values > MOST {
            return stop(self.wrong(at, text.len(), &format!("the file has more than {MOST} values")));
        }
        let span = Span::new(self.file, at, at + text.len());
        let Some(inner) = text.strip_prefix('[') else {
            let word = self.word(text, at)?;
            return Ok(Node { value: Value::Scalar(word.value), span });
        };
        let Some(inner) = inner.strip_suffix(']') else {
            return stop(self.wrong(at, text.len(), "the bracket is not closed on this line"));
        };
        if depth + 1 >= DEEPEST || inner.contains(['[', ']', '{', '}']) {
            return stop(self.wrong(at, text.len(), "brackets in brackets are not read"));
        }
        let mut items = Vec::new();
        let mut place = at + 1;
        let count = inner.split(',').count();
        for (index, item) in inner.split(',').enumerate() {
            let word = item.trim();
            let begin = place + (item.len() - item.trim_start().len());
            place += item.len() + 1;
            match word.is_empty() {
                // Behind the last comma, or in empty brackets.
                true if index + 1 == count => {}
                true => return stop(self.wrong(begin, 0, "there is nothing between two commas")),
                false => items.push(self.value(word, begin, depth + 1)?),
            }
        }
        Ok(Node { value: Value::List(items), span })
    }

    /// A word with or without quotes.
    fn word(&self, text: &str, at: usize) -> Result<Spanned<String>, Box<Diagnostic>> {
        let span = Span::new(self.file, at, at + text.len());
        let plain = text.strip_prefix("!!float").or(text.strip_prefix("!!int")).map_or(text, str::trim_start);
        let quoted = ['"', '\''].into_iter().find_map(|quote| plain.strip_prefix(quote)?.strip_suffix(quote));
        match quoted {
            Some(inner) if !inner.contains(['"', '\'', '\\']) => Ok(Spanned { value: inner.into(), span }),
            None if !plain.starts_with([
                '&', '*', '!', '|', '>', '"', '\'', '{', '}', '[', ']', '?', '@', '`', '%',
            ]) =>
            {
                Ok(Spanned { value: plain.into(), span })
            }
            _ => stop(self
                .wrong(at, text.len(), "this part of YAML is not read")
                .note("anchors, tags, braces and texts over several lines are not read, nor signs in quotes")
                .help("write a number or a plain word")),
        }
    }
}

fn is_item(text: &str) -> bool {
    text == "-" || text.starts_with("- ")
}

/// The key of a line and what stands behind its colon.
fn key(text: &str) -> Option<(&str, &str)> {
    let colon = text
        .char_indices()
        .find(|(at, c)| *c == ':' && text[at + 1..].chars().next().is_none_or(char::is_whitespace));
    let (at, _) = colon.filter(|_| !text.starts_with(['[', '{']))?;
    let name = text[..at].trim_end();
    (!name.is_empty()).then(|| (name, text[at + 1..].trim_start()))
}

/// A comment begins with `#` at the beginning of a line or behind white space, not in quotes.
fn without_comment(line: &str) -> &str {
    let mut quote = None;
    let mut before = ' ';
    for (at, c) in line.char_indices() {
        match quote {
            Some(open) if c == open => quote = None,
            Some(_) => {}
            None if c == '#' && before.is_whitespace() => return &line[..at],
            None if matches!(c, '"' | '\'') && !before.is_alphanumeric() => quote = Some(c),
            None => {}
        }
        before = c;
    }
    line
}
