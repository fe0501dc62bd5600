//! Back ends: pure functions from the intermediate representation to files. They cannot fail.

pub mod dot;
mod footprint;
pub mod paths;
pub mod plan;
pub mod report;
pub mod rust;
pub mod sdf;
pub mod st;

use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};

/// Files in memory: text by path.
pub type Files = BTreeMap<String, String>;

/// What takes the files of a back end, one at a time.
pub trait Sink {
    /// The text is made while it is written; nobody has to hold the whole of it.
    fn file(&mut self, path: &str, text: &dyn Display);
}

impl Sink for Files {
    fn file(&mut self, path: &str, text: &dyn Display) {
        self.insert(path.into(), text.to_string());
    }
}

/// A folder of a sink.
pub struct Folder<'a> {
    pub name: &'static str,
    pub sink: &'a mut dyn Sink,
}

impl Sink for Folder<'_> {
    fn file(&mut self, path: &str, text: &dyn Display) {
        self.sink.file(&format!("{}/{path}", self.name), text);
    }
}

/// A text that a function writes.
struct Text<F>(F);

impl<F: Fn(&mut Formatter) -> fmt::Result> Display for Text<F> {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        (self.0)(f)
    }
}

/// Part of a text: it is made when it is written.
type Part<'a> = Box<dyn Display + 'a>;

fn part<'a>(write: impl Fn(&mut Formatter) -> fmt::Result + 'a) -> Part<'a> {
    Box::new(Text(write))
}
