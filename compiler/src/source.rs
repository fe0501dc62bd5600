//! Source texts and places in them.

use crate::plain;
use sha2::{Digest, Sha256};

/// Number of a file in [`Sources`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FileId(pub u32);

/// A stretch of a file, in bytes, end excluded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    pub file: FileId,
    pub start: u32,
    pub end: u32,
}

impl Span {
    pub fn new(file: FileId, start: usize, end: usize) -> Self {
        Self { file, start: start as u32, end: end as u32 }
    }

    /// The same piece of a text that begins `offset` bytes into the file.
    pub fn after(self, offset: usize) -> Self {
        Self::new(self.file, self.start as usize + offset, self.end as usize + offset)
    }

    /// From the beginning of this span to the end of `last`.
    pub fn to(self, last: Span) -> Self {
        Self { end: last.end.max(self.end), ..self }
    }
}

/// A value and where it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Spanned<T> {
    pub value: T,
    pub span: Span,
}

/// A file by the name under which reports show it.
#[derive(Clone, Debug)]
pub struct SourceFile {
    pub name: String,
    pub text: String,
    marks: Vec<Mark>,
}

/// Line and column of a place, both from 0.
#[derive(Clone, Copy, Debug, Default)]
struct Mark {
    line: u32,
    column: u32,
}

/// From mark to mark, in bytes.
const STRIDE: usize = 1024;

impl Mark {
    fn behind(self, text: &[u8]) -> Self {
        // A character counts where it begins.
        text.iter().fold(self, |Mark { line, column }, byte| match byte {
            b'\n' => Mark { line: line + 1, column: 0 },
            0x80..0xc0 => Mark { line, column },
            _ => Mark { line, column: column + 1 },
        })
    }
}

impl SourceFile {
    fn new(name: &str, text: String) -> Self {
        let mut marks = vec![Mark::default()];
        for stretch in text.as_bytes().chunks(STRIDE) {
            marks.push(marks[marks.len() - 1].behind(stretch));
        }
        Self { name: plain::line(name), text, marks }
    }
}

/// All texts of a run.
#[derive(Clone, Debug, Default)]
pub struct Sources {
    files: Vec<SourceFile>,
}

impl Sources {
    /// The name is kept as it may be shown.
    pub fn add(&mut self, name: impl Into<String>, text: impl Into<String>) -> FileId {
        self.files.push(SourceFile::new(&name.into(), text.into()));
        FileId(self.files.len() as u32 - 1)
    }

    pub fn file(&self, id: FileId) -> &SourceFile {
        &self.files[id.0 as usize]
    }

    pub fn files(&self) -> &[SourceFile] {
        &self.files
    }

    pub fn text(&self, span: Span) -> &str {
        self.file(span.file).text.get(span.start as usize..span.end as usize).unwrap_or("")
    }

    /// The same texts under other names.
    pub fn renamed(&self, mut name: impl FnMut(&str) -> String) -> Self {
        let rename = |file: &SourceFile| SourceFile { name: plain::line(&name(&file.name)), ..file.clone() };
        Self { files: self.files.iter().map(rename).collect() }
    }

    /// A number from 0 to 2147483647 that is another one if a name (without its folder) or a text is another one.
    pub fn hash(&self) -> i32 {
        let mut digest = Sha256::new();
        for file in &self.files {
            let name = file.name.rsplit(['/', '\\']).next().unwrap_or(&file.name);
            for part in [name, &file.text] {
                digest.update((part.len() as u64).to_le_bytes());
                digest.update(part);
            }
        }
        let first = digest.finalize().iter().take(4).fold(0, |number, byte| number << 8 | u32::from(*byte));
        (first >> 1) as i32
    }

    /// Line and column of the beginning of a span, both from 1; columns count characters.
    pub fn position(&self, span: Span) -> (usize, usize) {
        let file = self.file(span.file);
        let at = (span.start as usize).min(file.text.len());
        let mark = at / STRIDE;
        let place = file.marks[mark].behind(&file.text.as_bytes()[mark * STRIDE..at]);
        (place.line as usize + 1, place.column as usize + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hash(files: &[(&str, &str)]) -> i32 {
        let mut sources = Sources::default();
        files.iter().for_each(|(name, text)| {
            sources.add(*name, *text);
        });
        sources.hash()
    }

    #[test]
    fn other_files_have_another_hash() {
        let wanted = hash(&[("a/line.json", "{}"), ("arm.aut", "robot")]);
        assert!(wanted >= 0);
        assert_eq!(wanted, hash(&[("line.json", "{}"), ("b/arm.aut", "robot")]), "in another folder");
        for files in [
            [("line.json", "{ }"), ("arm.aut", "robot")],
            [("lines.json", "{}"), ("arm.aut", "robot")],
            [("line.json", "{}arm.aut"), ("", "robot")],
            [("arm.aut", "robot"), ("line.json", "{}")],
        ] {
            assert_ne!(wanted, hash(&files), "{files:?}");
        }
    }
}
