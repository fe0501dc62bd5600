//! Files that a run writes beside the output folder's own: first beside their place, and never over a file that
//! is something else.

use super::interrupt::{self, Temporary};
use super::io_error;
use super::lock;
use super::output::Overwrite;
use super::test::junit;
use autogen::backend::paths::MARK;
use autogen::backend::report;
use runtime_sim::path::{FORMAT, HEAD};
use std::fs::{self, File};
use std::io::{self, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

/// What a file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    IoTrace,
    Hashes,
    PathTable,
    PathSegments,
    PathDrawing,
    Scenario,
    JUnit,
    Report,
}

impl Content {
    fn name(self) -> &'static str {
        match self {
            Content::IoTrace => "I/O trace",
            Content::Hashes => "list of hashes",
            Content::PathTable => "table of paths",
            Content::PathSegments => "list of segments",
            Content::PathDrawing => "drawing of paths",
            Content::Scenario => "scenario",
            Content::JUnit => "list of test results",
            Content::Report => "report",
        }
    }

    /// Whether a file that begins so is one.
    fn is_begun_by(self, bytes: &[u8]) -> bool {
        match self {
            Content::IoTrace => bytes.starts_with(b"run_permit,start,reset,"),
            Content::Hashes => {
                let is_hash = |line: &[u8]| {
                    line.iter().take(16).all(u8::is_ascii_hexdigit)
                        && line.get(16).is_none_or(|end| *end == b'\n')
                };
                bytes.len() > 16 && bytes.chunks(17).all(is_hash)
            }
            Content::PathTable => bytes.starts_with(HEAD.as_bytes()),
            Content::PathSegments => bytes.starts_with(format!("{{\"format\":\"{FORMAT}\"").as_bytes()),
            // As `verify` writes it.
            Content::Scenario => bytes.starts_with(b"{\n  \"kinds\": ["),
            Content::PathDrawing => String::from_utf8_lossy(bytes).contains(MARK),
            Content::JUnit => bytes.starts_with(junit::HEAD.as_bytes()),
            Content::Report => bytes.starts_with(report::MARK.as_bytes()),
        }
    }
}

/// How the name of a file ends that is not whole, and the characters before that by which it cannot be foreseen.
const END: &str = ".partial";
const RANDOM: usize = 6;
/// Characters of the file's own name in it: names of files have 255 bytes at most.
const NAME: usize = 50;

/// Bytes by which contents are told from one another.
const BEGINNING: u64 = 256;

/// What becomes of a file that is something else.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Foreign {
    /// The command has no option to overwrite it.
    Stays,
    StaysWithoutForce,
    Overwritten,
}

impl From<Overwrite> for Foreign {
    fn from(overwrite: Overwrite) -> Self {
        match overwrite {
            Overwrite::Own => Self::StaysWithoutForce,
            Overwrite::Everything => Self::Overwritten,
        }
    }
}

/// An error says what is in the way of a file.
pub fn check(path: &Path, content: Content, foreign: Foreign) -> Result<(), String> {
    if path.metadata().is_ok_and(|there| !there.is_file()) {
        return Err(format!("{}: this is not a file", path.display()));
    }
    let instead = match foreign {
        Foreign::Stays => "choose another one, or move it to another place",
        Foreign::StaysWithoutForce => "choose another one, or overwrite it with --force",
        Foreign::Overwritten => return Ok(()),
    };
    match is_free(path, content)? {
        true => Ok(()),
        false => Err(format!("{}: this file is not a {}; {instead}", path.display(), content.name())),
    }
}

/// A file to come.
#[derive(Debug)]
pub struct Pending {
    path: PathBuf,
    partial: Temporary,
    file: File,
}

impl Pending {
    /// An error says what is in the way.
    pub fn new(path: &Path, content: Content, foreign: Foreign) -> Result<Self, String> {
        let failed = |e: io::Error| format!("{}: {}", path.display(), io_error::text(&e));
        let name = path.file_name().ok_or_else(|| format!("{}: this is not a file", path.display()))?;
        check(path, content, foreign)?;
        let folder = path.parent().filter(|f| !f.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let begin: String = name.to_string_lossy().chars().take(NAME).collect();
        let begin = format!(".{begin}.");
        remove_abandoned(folder, &begin, content).map_err(failed)?;
        let (partial, file) = create(folder, &begin).map_err(failed)?;
        Ok(Self { path: path.into(), partial, file })
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Where to write while the run continues; removed when this is dropped.
    pub fn file(&self) -> &File {
        &self.file
    }

    pub fn write(&self, text: &str) -> Result<(), String> {
        (&self.file)
            .write_all(text.as_bytes())
            .map_err(|e| format!("{}: {}", self.path.display(), io_error::text(&e)))
    }

    /// What was written is whole.
    pub fn keep(self) -> Result<(), String> {
        let kept = self.file.sync_all().and_then(|()| fs::rename(self.partial.path(), &self.path));
        kept.map_err(|e| format!("{}: {}", self.path.display(), io_error::text(&e)))
    }
}

/// A new file that nobody could have put there before, locked as long as this process writes it.
fn create(folder: &Path, begin: &str) -> io::Result<(Temporary, File)> {
    let _writing = interrupt::writing();
    let mut builder = tempfile::Builder::new();
    builder.prefix(begin).suffix(END);
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    loop {
        let (file, path) = builder.tempfile_in(folder)?.keep()?;
        let partial = Temporary::new(path);
        // Another process may have taken it for an abandoned one before it was locked.
        if lock::claim(&file) && partial.path().exists() {
            return Ok((partial, file));
        }
    }
}

/// Removes what processes have left that were killed.
fn remove_abandoned(folder: &Path, begin: &str, content: Content) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let is_partial = name.starts_with(begin) && name.len() == begin.len() + RANDOM + END.len();
        if is_partial && name.ends_with(END) && entry.file_type()?.is_file() {
            let is_abandoned = File::open(entry.path()).is_ok_and(|file| lock::claim(&file));
            if is_abandoned && is_free(&entry.path(), content).unwrap_or(false) {
                drop(Temporary::new(entry.path()));
            }
        }
    }
    Ok(())
}

/// Whether there is nothing yet, an empty file, or one with this content.
fn is_free(path: &Path, content: Content) -> Result<bool, String> {
    let mut beginning = Vec::new();
    match File::open(path).and_then(|file| file.take(BEGINNING).read_to_end(&mut beginning)) {
        Ok(_) => Ok(beginning.is_empty() || content.is_begun_by(&beginning)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(true),
        Err(error) => Err(format!("{}: {error}", path.display())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_file_of_the_same_content_is_overwritten() {
        let folder = std::env::temp_dir().join(format!("autogen-pending-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("layout.json");
        let texts = [
            (Content::IoTrace, "run_permit,start,reset,running\n"),
            (Content::Hashes, "0123456789abcdef\n"),
            (Content::PathTable, HEAD),
            (Content::PathSegments, &format!("{{\"format\":\"{FORMAT}\"}}")),
            (Content::PathDrawing, &format!("<svg>\n{MARK}: -->\n</svg>")),
            (Content::JUnit, &format!("{}>\n</testsuites>\n", junit::HEAD)),
            (Content::Report, report::MARK),
        ];
        for (content, text) in texts {
            fs::write(&path, "{}").unwrap();
            for (foreign, has_force) in [(Foreign::Stays, false), (Foreign::StaysWithoutForce, true)] {
                let refused = Pending::new(&path, content, foreign).unwrap_err();
                assert!(refused.contains(content.name()), "{refused}");
                assert_eq!(refused.contains("--force"), has_force, "{refused}");
            }
            assert!(Pending::new(&folder, content, Foreign::Overwritten).unwrap_err().contains("not a file"));
            assert!(Pending::new(&folder.join("none/file"), content, Foreign::Stays).is_err());
            let pending = Pending::new(&path, content, Foreign::Overwritten).unwrap();
            pending.write(text).unwrap();
            pending.keep().unwrap();
            assert_eq!(fs::read_to_string(&path).unwrap(), text);
            drop(Pending::new(&path, content, Foreign::Stays).unwrap());
            assert_eq!(fs::read_dir(&folder).unwrap().count(), 1, "what was begun is removed");
        }
        fs::remove_dir_all(&folder).unwrap();
    }
}
