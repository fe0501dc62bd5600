//! The bytes of files that somebody else may have written or named.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::fs::{File, OpenOptions};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Bytes that a file may have; the largest real layout has 4 MB.
pub const MOST_BYTES: u64 = 10_000_000;

static FILES: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Texts that an editor has open, which stand above those on the disk.
static OPEN: Mutex<BTreeMap<PathBuf, String>> = Mutex::new(BTreeMap::new());

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// All files that this process has read, without symbolic links: none of them is written over.
pub fn files() -> Vec<PathBuf> {
    lock(&FILES).iter().cloned().collect()
}

/// A path without symbolic links, of a file too that is not on the disk yet.
pub fn real(path: &Path) -> Option<PathBuf> {
    let whole = path.canonicalize().ok();
    whole.or_else(|| Some(path.parent()?.canonicalize().ok()?.join(path.file_name()?)))
}

/// From now on this is the text of the file, given by its real path; with `None` it is that on the disk again.
pub fn open_as(path: &Path, text: Option<String>) {
    match text {
        Some(text) => lock(&OPEN).insert(path.into(), text),
        None => lock(&OPEN).remove(path),
    };
}

/// The real path of a file that is open in an editor.
pub fn opened(path: &Path) -> Option<PathBuf> {
    real(path).filter(|path| lock(&OPEN).contains_key(path))
}

/// The files of a folder that are open in an editor, by their real paths.
pub fn open_in(folder: &Path) -> Vec<PathBuf> {
    let Ok(folder) = folder.canonicalize() else { return Vec::new() };
    lock(&OPEN).keys().filter(|path| path.parent() == Some(&folder)).cloned().collect()
}

/// Why a file is not read. As text it says so without the file's name.
#[derive(Debug)]
pub enum Unread {
    /// It cannot be opened or read.
    Io(io::Error),
    /// A folder, a device, a pipe or a socket.
    NotRegular,
    TooLarge,
    Utf16,
    /// A byte that is in no text in UTF-8, with its line.
    NotUtf8 {
        line: usize,
        byte: u8,
    },
}

/// How a text in another encoding becomes one that is read.
const SAVE_AGAIN: &str = "Save it again as UTF-8: a spreadsheet calls it `CSV UTF-8`, Notepad `Encoding: UTF-8`, \
                          PowerShell `Out-File -Encoding utf8`";

impl Unread {
    /// Whether the content is wrong, so that the same file is never read.
    pub fn is_content(&self) -> bool {
        match self {
            Unread::Io(_) | Unread::NotRegular => false,
            Unread::TooLarge | Unread::Utf16 | Unread::NotUtf8 { .. } => true,
        }
    }
}

impl fmt::Display for Unread {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Unread::Io(error) => error.fmt(f),
            Unread::NotRegular => f.write_str("this is not a regular file"),
            Unread::TooLarge => {
                write!(f, "this file is larger than {} MB, which is the limit", MOST_BYTES / 1_000_000)
            }
            Unread::Utf16 => write!(f, "this file is UTF-16, and only UTF-8 is read. {SAVE_AGAIN}"),
            Unread::NotUtf8 { line, byte } => write!(
                f,
                "line {line} has a byte that is not UTF-8, 16#{byte:02X}, and only UTF-8 is read. {SAVE_AGAIN}"
            ),
        }
    }
}

/// The text of a file without a byte order mark; what is no UTF-8 is replaced. UTF-16 is refused: nothing in
/// it could be read. Neither a pipe nor a device that never ends holds this up.
pub fn text(path: &Path) -> Result<String, Unread> {
    Ok(unmarked(&String::from_utf8_lossy(&bytes_of_text(path)?)))
}

/// The same of a file that holds texts of people, of which nothing may be lost.
pub fn utf_8(path: &Path) -> Result<String, Unread> {
    let bytes = bytes_of_text(path)?;
    let text = std::str::from_utf8(&bytes).map_err(|error| {
        let (before, rest) = bytes.split_at(error.valid_up_to());
        Unread::NotUtf8 { line: line_behind(before), byte: rest[0] }
    })?;
    Ok(unmarked(text))
}

fn unmarked(text: &str) -> String {
    text.strip_prefix('\u{feff}').unwrap_or(text).into()
}

/// The number of the line that goes on behind these bytes. Lines end with LF, CR or both.
fn line_behind(bytes: &[u8]) -> usize {
    let is_end = |at: usize| match bytes[at] {
        b'\n' => true,
        b'\r' => bytes.get(at + 1) != Some(&b'\n'),
        _ => false,
    };
    1 + (0..bytes.len()).filter(|at| is_end(*at)).count()
}

fn bytes_of_text(path: &Path) -> Result<Vec<u8>, Unread> {
    let open = real(path).and_then(|path| lock(&OPEN).get(&path).cloned());
    if let Some(text) = open {
        return Ok(text.into_bytes());
    }
    let bytes = bytes(regular(path)?)?;
    if let Ok(path) = path.canonicalize() {
        lock(&FILES).insert(path);
    }
    match is_utf_16(&bytes) {
        true => Err(Unread::Utf16),
        false => Ok(bytes),
    }
}

/// The bytes of a file that is no text.
pub fn bytes_of(path: &Path) -> Result<Vec<u8>, Unread> {
    bytes(regular(path)?)
}

/// A regular file that may be of any size, to be read piece by piece.
pub fn regular(path: &Path) -> Result<File, Unread> {
    let file = open(path).map_err(Unread::Io)?;
    match file.metadata().map_err(Unread::Io)?.is_file() {
        true => Ok(file),
        false => Err(Unread::NotRegular),
    }
}

#[cfg(unix)]
fn open(path: &Path) -> io::Result<File> {
    use std::os::unix::fs::OpenOptionsExt;
    let at_once = rustix::fs::OFlags::NONBLOCK | rustix::fs::OFlags::NOCTTY;
    OpenOptions::new().read(true).custom_flags(at_once.bits() as i32).open(path)
}

#[cfg(not(unix))]
fn open(path: &Path) -> io::Result<File> {
    OpenOptions::new().read(true).open(path)
}

fn bytes(file: File) -> Result<Vec<u8>, Unread> {
    // It may grow while it is read, and some regular files of the system have no length.
    let mut bytes = Vec::new();
    file.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(Unread::Io)?;
    match bytes.len() as u64 > MOST_BYTES {
        true => Err(Unread::TooLarge),
        false => Ok(bytes),
    }
}

/// By its byte order mark, or since each second byte of what begins it is 0.
fn is_utf_16(bytes: &[u8]) -> bool {
    match *bytes {
        [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] => true,
        [a, b, c, d, ..] => (a == 0) != (b == 0) && (a == 0) == (c == 0) && (b == 0) == (d == 0),
        _ => false,
    }
}
