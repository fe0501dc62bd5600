//! The files that the client has open.

use super::uri;
use crate::read::{self, MOST_BYTES};
use autogen::lsp::lines::Lines;
use autogen::lsp::protocol::{TextDocumentContentChangeEvent, Uri};
use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

/// Bytes of all texts that are open.
const MOST_OPEN: usize = 200_000_000;

#[derive(Debug)]
pub struct Document {
    pub uri: Uri,
    pub version: i32,
    /// None of a text that is too large to be kept.
    pub text: Option<String>,
}

/// By their real paths.
#[derive(Debug, Default)]
pub struct Documents {
    open: BTreeMap<PathBuf, Document>,
    /// By the addresses under which they were opened: later their folder may be gone, or be a link to another one.
    paths: HashMap<Uri, PathBuf>,
}

impl Documents {
    pub fn get(&self, uri: &Uri) -> Option<(&Path, &Document)> {
        let path = self.path(uri)?;
        self.open.get_key_value(&path).map(|(path, document)| (path.as_path(), document))
    }

    fn path(&self, uri: &Uri) -> Option<PathBuf> {
        self.paths.get(uri).cloned().or_else(|| read::real(&uri::path(uri)?))
    }

    pub fn at(&self, path: &Path) -> Option<&Document> {
        self.open.get(path)
    }

    pub fn all(&self) -> impl Iterator<Item = (&Path, &Document)> {
        self.open.iter().map(|(path, document)| (path.as_path(), document))
    }

    /// What is no file of this machine is left alone.
    pub fn open(&mut self, uri: Uri, version: i32, text: String) {
        if let Some(path) = uri::path(&uri).and_then(|path| read::real(&path)) {
            self.paths.insert(uri.clone(), path.clone());
            self.keep(path, Document { uri, version, text: Some(text) });
        }
    }

    pub fn change(&mut self, uri: &Uri, version: i32, changes: Vec<TextDocumentContentChangeEvent>) {
        let Some(path) = self.path(uri) else { return };
        let Some(mut document) = self.open.remove(&path) else { return };
        let mut text = document.text.take();
        for change in changes {
            text = match (change, text) {
                (TextDocumentContentChangeEvent::TextDocumentContentChangeWholeDocument(whole), _) => {
                    Some(whole.text)
                }
                (TextDocumentContentChangeEvent::TextDocumentContentChangePartial(part), Some(mut text)) => {
                    let lines = Lines::new(&text);
                    let (start, end) = (lines.offset(part.range.start), lines.offset(part.range.end));
                    text.replace_range(start..end.max(start), &part.text);
                    Some(text).filter(|text| text.len() as u64 <= MOST_BYTES)
                }
                (TextDocumentContentChangeEvent::TextDocumentContentChangePartial(_), None) => None,
            };
        }
        self.keep(path, Document { uri: uri.clone(), version, text });
    }

    /// A file that is open under another address too stays open. The file, if it does not.
    pub fn close(&mut self, uri: &Uri) -> Option<PathBuf> {
        let path = self.path(uri)?;
        self.paths.remove(uri);
        let other = self.paths.iter().find(|(_, open)| **open == path).map(|(uri, _)| uri.clone());
        match other {
            Some(other) => {
                if let Some(document) = self.open.get_mut(&path) {
                    document.uri = other;
                }
                None
            }
            None => {
                self.open.remove(&path);
                read::open_as(&path, None);
                Some(path)
            }
        }
    }

    fn keep(&mut self, path: PathBuf, mut document: Document) {
        let others: usize = self.open.values().filter_map(|other| other.text.as_ref()).map(String::len).sum();
        let fits = |text: &String| text.len() as u64 <= MOST_BYTES && others + text.len() <= MOST_OPEN;
        document.text = document.text.filter(fits);
        // Where the reader would leave out a byte order mark stands a blank, so that places stay what they are.
        if let Some(text) = document.text.as_mut()
            && text.starts_with('\u{feff}')
        {
            text.replace_range(..'\u{feff}'.len_utf8(), " ");
        }
        read::open_as(&path, document.text.clone());
        self.open.insert(path, document);
    }
}
