//! Files that a layout names, which come from within its folder, and files of automata.

use super::load;
use super::read::{self, Unread};
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// Files of automata that are taken from one folder, and one more.
const MOST_LISTED: usize = 1001;

/// Why what is named cannot be used.
#[derive(Debug)]
pub enum Unusable {
    Unread(Unread),
    /// It stands elsewhere than below the folder of the layout.
    LeadsOut,
    /// A symbolic link in a folder of automata that leads out of it.
    LinkLeadsOut(PathBuf),
    /// One of the files of a folder of automata cannot be read.
    EntryUnread(PathBuf, io::Error),
    /// A folder without automata.
    NoAutomata,
    /// Neither a folder nor a file of automata.
    NotAutomata,
    /// No object of JSON.
    NoObject,
    /// The path goes through a file as if it were a folder.
    ThroughFile,
}

impl fmt::Display for Unusable {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Unusable::Unread(why) => return why.fmt(f),
            Unusable::LinkLeadsOut(link) => {
                return write!(f, "{} is a symbolic link that leads out of it", link.display());
            }
            Unusable::EntryUnread(entry, why) => {
                return write!(f, "{} cannot be read: {why}", entry.display());
            }
            Unusable::LeadsOut => "this leads out of the folder of the layout",
            Unusable::NoAutomata => "this folder has no *.aut file",
            Unusable::NotAutomata => "this is neither a folder nor a *.aut file",
            Unusable::ThroughFile => "a part of this path is a file, not a folder",
            Unusable::NoObject => "this file does not begin with `{`, so it is not a scenario",
        })
    }
}

impl From<io::Error> for Unusable {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::NotADirectory => Unusable::ThroughFile,
            _ => Unusable::Unread(Unread::Io(error)),
        }
    }
}

/// The folder of a layout.
pub struct Folder(pub PathBuf);

impl Folder {
    pub fn of(layout: &Path) -> Self {
        Self(layout.parent().unwrap_or(Path::new("")).into())
    }

    pub fn has(&self, name: &str) -> bool {
        self.0.join(name).symlink_metadata().is_ok()
    }

    /// The text of a file by its path as reports show it.
    fn text(&self, path: &Path) -> Result<(String, String), Unusable> {
        let own = if self.0.as_os_str().is_empty() { Path::new(".") } else { &self.0 };
        let real = path.canonicalize().or_else(|error| read::opened(path).ok_or(error))?;
        if !real.starts_with(own.canonicalize()?) {
            return Err(Unusable::LeadsOut);
        }
        let text = read::text(&real).map_err(Unusable::Unread)?;
        Ok((path.display().to_string(), text))
    }

    /// A file that holds an object of JSON.
    pub fn object(&self, name: &str) -> Result<(String, String), Unusable> {
        let (path, text) = self.text(&self.0.join(name))?;
        match load::begins_as_object(&text) {
            true => Ok((path, text)),
            false => Err(Unusable::NoObject),
        }
    }

    /// The automata of a folder or a file.
    pub fn automata(&self, name: &str) -> Result<Vec<(String, String)>, Unusable> {
        automata(&self.0.join(name))?.iter().map(|path| self.text(path)).collect()
    }
}

/// A file of automata, or those of a folder in the order of their names, without hidden ones: some editors and systems put
/// files of their own beside a file, `.#mill.aut` or `._mill.aut`.
pub fn automata(path: &Path) -> Result<Vec<PathBuf>, Unusable> {
    let is_automata = |path: &Path| path.extension().is_some_and(|e| e == "aut");
    let is_hidden =
        |path: &Path| path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
    if !path.metadata()?.is_dir() {
        return if is_automata(path) { Ok(vec![path.into()]) } else { Err(Unusable::NotAutomata) };
    }
    let mut files = Vec::new();
    for entry in path.read_dir()? {
        let entry = entry?.path();
        if is_automata(&entry) && !is_hidden(&entry) {
            let real = entry.canonicalize().map_err(|why| Unusable::EntryUnread(entry.clone(), why))?;
            if !real.starts_with(path.canonicalize()?) {
                return Err(Unusable::LinkLeadsOut(entry));
            }
            files.push(entry);
        }
        if files.len() == MOST_LISTED {
            break;
        }
    }
    let is_listed = |path: &PathBuf| files.iter().any(|listed| listed.file_name() == path.file_name());
    let unsaved = read::open_in(path)
        .into_iter()
        .filter(|open| is_automata(open) && !is_hidden(open) && !is_listed(open));
    let unsaved: Vec<_> = unsaved.filter_map(|open| Some(path.join(open.file_name()?))).collect();
    files.extend(unsaved);
    files.sort();
    if files.is_empty() { Err(Unusable::NoAutomata) } else { Ok(files) }
}
