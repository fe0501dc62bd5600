//! Places as the protocol counts them: lines, and units of UTF-16 in them, both from 0.

use crate::plain::boundary;
use crate::source::Span;
use gen_lsp_types::{Position, Range};

/// Where the lines of a text begin.
#[derive(Clone, Debug)]
pub struct Lines<'t> {
    text: &'t str,
    starts: Vec<usize>,
    /// Units of UTF-16 before each stretch of the text.
    marks: Vec<usize>,
}

/// From mark to mark, in bytes.
const STRIDE: usize = 1024;

/// Of characters that begin in these bytes.
fn units(bytes: &[u8]) -> usize {
    let of_byte = |byte: &u8| match byte {
        0x80..0xc0 => 0,
        0xf0.. => 2,
        _ => 1,
    };
    bytes.iter().map(of_byte).sum()
}

impl<'t> Lines<'t> {
    /// Lines end with `\n`, `\r\n` or `\r`.
    pub fn new(text: &'t str) -> Self {
        let bytes = text.as_bytes();
        let ends = |(at, byte): (usize, &u8)| match byte {
            b'\n' => Some(at + 1),
            b'\r' if bytes.get(at + 1) != Some(&b'\n') => Some(at + 1),
            _ => None,
        };
        let starts = std::iter::once(0).chain(bytes.iter().enumerate().filter_map(ends)).collect();
        let mut marks = vec![0];
        for stretch in bytes.chunks(STRIDE) {
            marks.push(marks[marks.len() - 1] + units(stretch));
        }
        Self { text, starts, marks }
    }

    /// Units of UTF-16 before a byte that begins a character.
    fn units_before(&self, offset: usize) -> usize {
        let mark = offset / STRIDE;
        self.marks[mark] + units(&self.text.as_bytes()[mark * STRIDE..offset])
    }

    /// A place in bytes; within a character, its beginning.
    pub fn position(&self, offset: usize) -> Position {
        let offset = boundary(self.text, offset);
        let line = self.starts.partition_point(|start| *start <= offset) - 1;
        let character = self.units_before(offset) - self.units_before(self.starts[line]);
        Position { line: line as u32, character: character as u32 }
    }

    pub fn range(&self, span: Span) -> Range {
        Range { start: self.position(span.start as usize), end: self.position(span.end as usize) }
    }

    /// The byte at which a place is. Behind the end of a line it is that end, behind the last line the end of the text;
    /// between the two units of a character it is the beginning of the character.
    pub fn offset(&self, position: Position) -> usize {
        let line = position.line as usize;
        let Some(start) = self.starts.get(line).copied() else { return self.text.len() };
        let next = self.starts.get(line + 1).copied().unwrap_or(self.text.len());
        let end = start + self.text[start..next].trim_end_matches(['\n', '\r']).len();
        let wanted = self.units_before(start) + position.character as usize;
        let mark = self.marks.partition_point(|units| *units <= wanted).saturating_sub(1);
        let mut offset = boundary(self.text, (mark * STRIDE).min(end)).max(start);
        let mut before = self.units_before(offset);
        for c in self.text[offset..end].chars() {
            before += c.len_utf16();
            if before > wanted {
                break;
            }
            offset += c.len_utf8();
        }
        offset
    }

    /// All of the text.
    pub fn whole(&self) -> Range {
        Range { start: Position { line: 0, character: 0 }, end: self.position(self.text.len()) }
    }
}

#[cfg(test)]
mod tests {
    use super::Lines;
    use gen_lsp_types::Position;

    fn at(line: u32, character: u32) -> Position {
        Position { line, character }
    }

    #[test]
    fn columns_are_units_of_utf_16() {
        let text = "// Größe \u{1f916} here\r\nlocal x\rend";
        let lines = Lines::new(text);
        let here = text.find("here").unwrap();
        assert_eq!(lines.position(here), at(0, 12));
        assert_eq!(lines.offset(at(0, 12)), here);
        // Between the two halves of the robot.
        assert_eq!(lines.offset(at(0, 10)), text.find('\u{1f916}').unwrap());
        assert_eq!(lines.position(text.find("local").unwrap()), at(1, 0));
        assert_eq!(lines.position(text.find("end").unwrap()), at(2, 0));
    }

    #[test]
    fn places_in_long_lines_come_back() {
        let text = "ab\u{e4}\u{1f916}\u{4e2d}".repeat(1000) + "\n" + &"\u{1f916}x".repeat(900);
        let lines = Lines::new(&text);
        for (offset, _) in text.char_indices().chain([(text.len(), ' ')]) {
            let position = lines.position(offset);
            assert_eq!(lines.offset(position), offset);
            let start = text[..offset].rfind('\n').map_or(0, |end| end + 1);
            assert_eq!(position.character as usize, text[start..offset].encode_utf16().count());
        }
        assert_eq!(lines.offset(at(0, 1_000_000)), text.find('\n').unwrap());
    }

    #[test]
    fn places_outside_are_brought_in() {
        let lines = Lines::new("ab\ncd");
        assert_eq!(lines.offset(at(0, 99)), 2);
        assert_eq!(lines.offset(at(9, 0)), 5);
        assert_eq!(lines.position(99), at(1, 2));
        assert_eq!(Lines::new("").whole().end, at(0, 0));
    }
}
