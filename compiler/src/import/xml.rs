//! XML as a tree of elements with the places of all attributes. Nothing is fetched or expanded: a text with a document
//! type declaration or with entities of its own is refused.

use super::stop;
use crate::diagnostic::Diagnostic;
use crate::source::{FileId, Span, Spanned};
use quick_xml::Reader;
use quick_xml::escape::unescape;
use quick_xml::events::{BytesStart, Event};

#[derive(Debug)]
pub struct Element {
    pub name: String,
    /// Its start tag.
    pub span: Span,
    pub attributes: Vec<Attribute>,
    pub children: Vec<Element>,
}

#[derive(Debug)]
pub struct Attribute {
    pub name: String,
    pub value: Spanned<String>,
}

/// Elements may be nested this deep.
const DEEPEST: usize = 64;
/// Elements of one text: the largest descriptions of robots have some thousand.
const MOST_ELEMENTS: usize = 100_000;
/// Attributes of an element, which are compared with one another.
const MOST_ATTRIBUTES: usize = 32;

impl Element {
    pub fn attribute(&self, name: &str) -> Option<&Spanned<String>> {
        self.attributes.iter().find(|attribute| attribute.name == name).map(|attribute| &attribute.value)
    }

    pub fn child(&self, name: &str) -> Option<&Element> {
        self.children.iter().find(|child| child.name == name)
    }

    pub fn all<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Element> {
        self.children.iter().filter(move |child| child.name == name)
    }
}

/// The root element; the first error ends the reading.
pub fn parse(text: &str, file: FileId) -> Result<Element, Box<Diagnostic>> {
    if let Some(at) = text.find(char::REPLACEMENT_CHARACTER) {
        let place = Span::new(file, at, at + char::REPLACEMENT_CHARACTER.len_utf8());
        return stop(
            Diagnostic::new("E1101", place, "here is a byte that is not UTF-8")
                .help("save the file again as UTF-8"),
        );
    }
    Tree { text, file, count: 0, open: Vec::new(), root: None }.read()
}

struct Tree<'a> {
    text: &'a str,
    file: FileId,
    count: usize,
    open: Vec<Element>,
    root: Option<Element>,
}

impl Tree<'_> {
    fn read(mut self) -> Result<Element, Box<Diagnostic>> {
        let mut reader = Reader::from_str(self.text);
        loop {
            let start = reader.buffer_position() as usize;
            let event = reader.read_event().map_err(|error| {
                self.wrong(reader.error_position() as usize, None, format!("this is not XML: {error}"))
            })?;
            let end = reader.buffer_position() as usize;
            match event {
                Event::Start(tag) => {
                    let element = self.element(&tag, start, end)?;
                    self.open.push(element);
                }
                Event::Empty(tag) => {
                    let element = self.element(&tag, start, end)?;
                    self.close(element)?;
                }
                Event::End(_) => {
                    if let Some(element) = self.open.pop() {
                        self.close(element)?;
                    }
                }
                Event::DocType(_) => {
                    return stop(
                        self.wrong(start, Some(end), "a document type declaration is not read".into())
                            .note("it may name other files and may expand to any size")
                            .help("remove the declaration, and write what its entities stand for"),
                    );
                }
                Event::Text(text) if self.open.is_empty() && !text.trim().is_empty() => {
                    return stop(self.wrong(
                        start,
                        Some(end),
                        "there is text outside of the root element".into(),
                    ));
                }
                Event::Eof => break,
                _ => {}
            }
        }
        match (self.open.pop(), self.root.take()) {
            (None, Some(root)) => Ok(root),
            (Some(open), _) => stop(
                self.wrong(self.text.len(), None, format!("the text ends before </{}>", open.name))
                    .other(open.span, "the element begins here")
                    .help("the file seems to be incomplete: complete it"),
            ),
            (None, None) => stop(self.wrong(0, None, "there is no element in this text".into())),
        }
    }

    fn wrong(&self, start: usize, end: Option<usize>, message: String) -> Diagnostic {
        let boundary = |at: usize| {
            (0..=at.min(self.text.len())).rev().find(|at| self.text.is_char_boundary(*at)).unwrap_or(0)
        };
        let place = Span::new(self.file, boundary(start), boundary(end.unwrap_or(start)));
        Diagnostic::new("E1101", place, message).help("correct the XML; a program that checks XML shows more")
    }

    fn limit(&self, span: Span, message: String) -> Diagnostic {
        Diagnostic::new("E1102", span, message).help("remove what does not describe the arm")
    }

    fn element(&mut self, tag: &BytesStart, start: usize, end: usize) -> Result<Element, Box<Diagnostic>> {
        let span = Span::new(self.file, start, end);
        self.count += 1;
        if self.count > MOST_ELEMENTS {
            return stop(self.limit(span, format!("the text has more than {MOST_ELEMENTS} elements")));
        }
        if self.open.len() == DEEPEST {
            return stop(self.limit(span, format!("more than {DEEPEST} elements are nested")));
        }
        let mut attributes: Vec<Attribute> = Vec::new();
        // Names that occur twice are found here, in order to limit how many are compared.
        for attribute in tag.attributes().with_checks(false) {
            let attribute = attribute
                .map_err(|error| self.wrong(start, Some(end), format!("an attribute is wrong: {error}")))?;
            let name = attribute.key.as_ref().to_string();
            // Values are parts of the text.
            let at = (attribute.value.as_ptr() as usize).wrapping_sub(self.text.as_ptr() as usize);
            let place = match self.text.get(at..at.saturating_add(attribute.value.len())) {
                Some(_) => Span::new(self.file, at, at + attribute.value.len()),
                None => span,
            };
            if attributes.len() == MOST_ATTRIBUTES {
                return stop(
                    self.limit(span, format!("an element has more than {MOST_ATTRIBUTES} attributes")),
                );
            }
            if let Some(first) = attributes.iter().find(|other| other.name == name) {
                let message = format!("the attribute {name} occurs twice");
                return stop(
                    Diagnostic::new("E1101", place, message)
                        .other(first.value.span, "first here")
                        .help("remove one of them"),
                );
            }
            let value = unescape(&attribute.value).map_err(|error| {
                Diagnostic::new("E1101", place, format!("the value of {name} is wrong: {error}"))
                    .note("the entities that are read are lt, gt, amp, apos and quot")
                    .help("write what the entity stands for")
            })?;
            attributes.push(Attribute { name, value: Spanned { value: value.into_owned(), span: place } });
        }
        Ok(Element { name: tag.name().as_ref().to_string(), span, attributes, children: Vec::new() })
    }

    fn close(&mut self, element: Element) -> Result<(), Box<Diagnostic>> {
        match (self.open.last_mut(), &self.root) {
            (Some(parent), _) => parent.children.push(element),
            (None, None) => self.root = Some(element),
            (None, Some(first)) => {
                return stop(
                    Diagnostic::new("E1101", element.span, "there is a second root element")
                        .other(first.span, "the first one")
                        .help("a file has one root element: remove the other one"),
                );
            }
        }
        Ok(())
    }
}
