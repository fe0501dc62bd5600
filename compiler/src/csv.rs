//! Values separated by commas, semicolons or tabs, as spreadsheets write them.

use crate::diagnostic::Diagnostic;
use crate::source::{FileId, Span};
use std::borrow::Cow;

/// A field as it is written: in quotes if it needs them, and with an apostrophe before it if a spreadsheet would
/// compute it, or if it begins with apostrophes before such a text. Numbers stay as they are. [`parse`] takes the
/// apostrophe away.
pub fn field(text: &str) -> Cow<'_, str> {
    let is_computed = is_formula(text.trim_start_matches('\''));
    let text = if is_computed { Cow::Owned(format!("'{text}")) } else { Cow::Borrowed(text) };
    match text.contains([',', ';', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")).into(),
        false => text,
    }
}

fn is_formula(text: &str) -> bool {
    text.starts_with(['=', '+', '-', '@', '\t', '\r']) && text.parse::<f64>().is_err()
}

pub struct Table {
    /// The one of `,`, `;` and tab that stands most often in the first line.
    pub separator: u8,
    /// Without lines that hold nothing.
    pub records: Vec<Vec<Field>>,
}

/// A field without its quotes and the blanks around it.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    pub text: String,
    pub span: Span,
}

/// Lines end with LF, CR or both; a quoted field may hold them, separators, and quotes that stand twice.
pub fn parse(file: FileId, text: &str, found: &mut Vec<Diagnostic>) -> Table {
    let separator = separator(text);
    let mut reader = Reader { file, text, at: 0, separator };
    let mut records = Vec::new();
    while reader.at < text.len() {
        let record = reader.record(found);
        if record.iter().any(|field| !field.text.is_empty()) {
            records.push(record);
        }
    }
    Table { separator, records }
}

fn separator(text: &str) -> u8 {
    let mut is_quoted = false;
    let mut counts = [(b',', 0), (b';', 0), (b'\t', 0)];
    for byte in text.bytes() {
        match byte {
            b'"' => is_quoted = !is_quoted,
            b'\n' | b'\r' if !is_quoted && counts.iter().any(|(_, n)| *n > 0) => break,
            byte if !is_quoted => counts.iter_mut().filter(|(b, _)| *b == byte).for_each(|(_, n)| *n += 1),
            _ => {}
        }
    }
    counts.into_iter().rev().max_by_key(|(_, n)| *n).map_or(b',', |(byte, _)| byte)
}

struct Reader<'t> {
    file: FileId,
    text: &'t str,
    at: usize,
    separator: u8,
}

impl Reader<'_> {
    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    fn record(&mut self, found: &mut Vec<Diagnostic>) -> Vec<Field> {
        let mut fields = vec![self.field(found)];
        while self.peek() == Some(self.separator) {
            self.at += 1;
            fields.push(self.field(found));
        }
        // What ends a line.
        let rest = &self.text[self.at..];
        self.at += if rest.starts_with("\r\n") { 2 } else { rest.len().min(1) };
        fields
    }

    fn field(&mut self, found: &mut Vec<Diagnostic>) -> Field {
        while matches!(self.peek(), Some(b' ' | b'\t')) && self.peek() != Some(self.separator) {
            self.at += 1;
        }
        let start = self.at;
        let mut text = String::new();
        if self.peek() == Some(b'"') {
            self.at += 1;
            self.quoted(start, &mut text, found);
        }
        let plain = self.at;
        while self.peek().is_some_and(|b| b != self.separator && b != b'\n' && b != b'\r') {
            self.at += 1;
        }
        text += self.text[plain..self.at].trim_end();
        let end = start + self.text[start..self.at].trim_end().len();
        let text = text.trim();
        let text =
            text.strip_prefix('\'').filter(|rest| is_formula(rest.trim_start_matches('\''))).unwrap_or(text);
        Field { text: text.into(), span: Span::new(self.file, start, end.max(start)) }
    }

    /// From behind the opening quote to behind the closing one.
    fn quoted(&mut self, start: usize, text: &mut String, found: &mut Vec<Diagnostic>) {
        loop {
            let Some(length) = self.text[self.at..].find('"') else {
                // What it holds would only be reported again.
                self.at = self.text.len();
                found.push(
                    Diagnostic::new("E0601", Span::new(self.file, start, start + 1), "a quote has no end")
                        .label("opened here")
                        .help("close the quote; a quote within a quoted field is written twice: \"\""),
                );
                return;
            };
            *text += &self.text[self.at..self.at + length];
            self.at += length + 1;
            if self.peek() != Some(b'"') {
                return;
            }
            text.push('"');
            self.at += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> (Vec<Vec<String>>, usize) {
        let mut found = Vec::new();
        let table = parse(FileId(0), text, &mut found);
        let records = table.records.into_iter().map(|r| r.into_iter().map(|f| f.text).collect());
        (records.collect(), found.len())
    }

    #[test]
    fn tables_are_read_as_spreadsheets_write_them() {
        let wanted = vec![vec!["a", "b,\"c\"", ""], vec!["1", "2\n3", "x y"]];
        for text in [
            "a,\"b,\"\"c\"\"\",\n1,\"2\n3\",x y\n",
            "a;\"b,\"\"c\"\"\";\r\n\r\n;;\r\n1;\"2\n3\"; x y",
            "a\t\"b,\"\"c\"\"\"\t\r1\t\"2\n3\"\tx y \r",
        ] {
            let (records, errors) = read(text);
            assert_eq!(records, wanted, "{text:?}");
            assert_eq!(errors, 0, "{text:?}");
        }
    }

    #[test]
    fn what_a_spreadsheet_would_compute_is_marked_and_read_back() {
        for (text, written) in [
            ("=1+1", "'=1+1"),
            ("@SUM(1;2)", "\"'@SUM(1;2)\""),
            ("+a", "'+a"),
            ("'+a", "''+a"),
            ("''=", "'''="),
            ("'a", "'a"),
            ("'-5", "'-5"),
            ("-x < 3", "'-x < 3"),
            ("-0.5", "-0.5"),
            ("+1e-3", "+1e-3"),
            ("a, b", "\"a, b\""),
            ("'quoted'", "'quoted'"),
        ] {
            assert_eq!(field(text), written);
            assert_eq!(read(&format!("{written},2\n")).0, [[text, "2"]], "{text}");
        }
    }

    #[test]
    fn a_quote_without_an_end_is_reported_once() {
        assert_eq!(
            read("a,b\n1,\"2\n3,4\n"),
            (vec![vec!["a".into(), "b".into()], vec!["1".into(), "".into()]], 1)
        );
        assert_eq!(read(""), (vec![], 0));
    }
}
