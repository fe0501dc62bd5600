//! New files on their way into the output folder.
//!
//! They are hashed and written while the next ones are made, and large ones wait for the disk meanwhile.

use super::manifest::{MANIFEST, Manifest, hash_of, hex};
use super::present::{Present, obstacles, present};
use super::transaction::{self, Change, create_parent, sync};
use super::{OF_A_RUN, Overwrite, Refusal, among};
use crate::interrupt::Temporary;
use autogen::backend::Sink;
use autogen::parallel::STACK;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fmt::{self, Display, Write};
use std::fs::{self, File};
use std::io::{self, Read, Write as _};
use std::panic::resume_unwind;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{self, JoinHandle};

/// Bytes of a text that are handed on at once.
const PIECE: usize = 64 * 1024;
/// Pieces that may wait.
const MOST_PIECES: usize = 32;
/// Bytes of a file that are in memory until it is known whether it is there already.
const MOST_BYTES: usize = 1_000_000;

/// Gives files, one at a time.
pub type Make<'a> = dyn Fn(&mut dyn Sink) + Sync + 'a;

/// The files that these give, all at the same time.
pub fn staged(folder: &Path, before: Manifest, make: &[&Make]) -> Staged {
    let staged = Staged::new(folder, before);
    thread::scope(|scope| {
        let (pieces, received) = sync_channel(MOST_PIECES);
        let (empty, mut all): (Vec<_>, Vec<_>) = (0..make.len())
            .map(|number| {
                let (empty, written) = sync_channel(MOST_PIECES);
                (empty, NewFiles { number, pieces: pieces.clone(), written })
            })
            .unzip();
        drop(pieces);
        let staging = scope.spawn(move || staged.all(received, &empty));
        let own = all.pop();
        let others = all.into_iter().zip(make).map(|(mut new, make)| {
            let thread = thread::Builder::new().stack_size(STACK);
            thread.spawn_scoped(scope, move || make(&mut new)).expect("a thread")
        });
        let others: Vec<_> = others.collect();
        if let (Some(mut new), Some(make)) = (own, make.last()) {
            make(&mut new);
        }
        for other in others {
            other.join().unwrap_or_else(|panic| resume_unwind(panic));
        }
        staging.join().unwrap_or_else(|panic| resume_unwind(panic))
    })
}

/// Takes files one at a time.
struct NewFiles {
    /// Among those that are made at the same time.
    number: usize,
    pieces: SyncSender<Piece>,
    /// Empty texts of pieces that were written, to be used again.
    written: Receiver<Vec<u8>>,
}

/// Of a file, with the number of who makes it.
enum Piece {
    Begin(usize, String),
    Text(usize, Vec<u8>),
    End(usize),
}

impl NewFiles {
    fn empty(&self) -> Vec<u8> {
        self.written.try_recv().unwrap_or_else(|_| Vec::with_capacity(PIECE))
    }

    /// The other end is there as long as this is.
    fn send(&self, piece: Piece) {
        let _ = self.pieces.send(piece);
    }
}

impl Sink for NewFiles {
    fn file(&mut self, name: &str, text: &dyn Display) {
        self.send(Piece::Begin(self.number, name.into()));
        let mut pieces = Pieces { to: self, rest: self.empty() };
        let _ = write!(pieces, "{text}");
        let rest = pieces.rest;
        self.send(Piece::Text(self.number, rest));
        self.send(Piece::End(self.number));
    }
}

/// A text on its way.
struct Pieces<'a> {
    to: &'a NewFiles,
    rest: Vec<u8>,
}

impl Write for Pieces<'_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let mut text = text.as_bytes();
        while self.rest.len() + text.len() > PIECE {
            let (now, later) = text.split_at(PIECE - self.rest.len());
            self.rest.extend_from_slice(now);
            let piece = std::mem::replace(&mut self.rest, self.to.empty());
            self.to.send(Piece::Text(self.to.number, piece));
            text = later;
        }
        self.rest.extend_from_slice(text);
        Ok(())
    }
}

/// The files that are not in the folder yet wait in that of a transaction.
pub struct Staged {
    folder: PathBuf,
    before: Manifest,
    waiting: Temporary,
    hashes: BTreeMap<String, String>,
    changes: Vec<Change>,
    obstacles: Vec<PathBuf>,
    /// These would be overwritten.
    foreign: Vec<PathBuf>,
    failed: Option<Refusal>,
    /// Large files on their way to the disk.
    syncing: Vec<JoinHandle<Result<(), Refusal>>>,
}

impl Staged {
    fn new(folder: &Path, before: Manifest) -> Self {
        Self {
            folder: folder.into(),
            before,
            waiting: transaction::begin(folder),
            hashes: BTreeMap::new(),
            changes: Vec::new(),
            obstacles: Vec::new(),
            foreign: Vec::new(),
            failed: None,
            syncing: Vec::new(),
        }
    }

    /// By their names.
    pub fn hashes(&self) -> &BTreeMap<String, String> {
        &self.hashes
    }

    /// `empty` gives the texts of pieces back, to each who makes files.
    fn all(mut self, pieces: Receiver<Piece>, empty: &[SyncSender<Vec<u8>>]) -> Self {
        let mut present: BTreeMap<usize, (String, NewFile)> = BTreeMap::new();
        for piece in pieces {
            match piece {
                Piece::Begin(from, name) => {
                    self.obstacles.extend(obstacles(&self.folder, [name.as_str()].into_iter()));
                    if self.obstacles.is_empty() && self.failed.is_none() {
                        let file = self.file(&name);
                        present.insert(from, (name, file));
                    }
                }
                Piece::Text(from, mut text) => {
                    if let Some((_, file)) = present.get_mut(&from) {
                        file.write(&text);
                    }
                    text.clear();
                    // Nobody waits for it.
                    let _ = empty[from].try_send(text);
                }
                Piece::End(from) => {
                    if let Some((name, file)) = present.remove(&from) {
                        let own = self.before.files.get(&name).cloned();
                        self.add(name, file, |there| there.is(own.as_deref()));
                    }
                }
            }
        }
        self.changes.sort_by(|a, b| a.name.cmp(&b.name));
        for syncing in std::mem::take(&mut self.syncing) {
            let synced = syncing.join().unwrap_or_else(|panic| resume_unwind(panic));
            self.failed = self.failed.take().or(synced.err());
        }
        self
    }

    fn file(&self, name: &str) -> NewFile {
        NewFile::new(transaction::waiting(&self.waiting, name), self.folder.join(name))
    }

    fn add(&mut self, name: String, file: NewFile, is_own: impl Fn(&Present) -> bool) {
        debug_assert!(!self.hashes.contains_key(&name), "{name} is written twice");
        match file.end().and_then(|hashed| self.compare(&name, hashed, is_own)) {
            Ok(hash) => drop(self.hashes.insert(name, hash)),
            Err(refusal) => drop(self.failed.get_or_insert(refusal)),
        }
    }

    /// Leaves only what is not in the folder already.
    fn compare(
        &mut self,
        name: &str,
        new: Hashed,
        is_own: impl Fn(&Present) -> bool,
    ) -> Result<String, Refusal> {
        let Hashed { path, hash, text } = new;
        if matches!(text, Made::There) {
            return Ok(hash);
        }
        let there = present(&self.folder, name)?;
        if there.is(Some(&hash)) {
            return Ok(hash);
        }
        let existed = there != Present::Nothing;
        if existed && !is_own(&there) {
            self.foreign.push(self.folder.join(name));
        }
        match text {
            Made::Text(text) => {
                create_parent(&path)?;
                fs::write(&path, text).map_err(|e| Refusal::Io(path, e))?;
            }
            _ => self.syncing.push(thread::spawn(move || sync(&path))),
        }
        self.changes.push(Change { name: name.into(), existed, hash: Some(hash.clone()) });
        Ok(hash)
    }

    /// Puts the files and the manifest of them in the place of the old ones, and removes what it no longer has.
    pub fn replace(
        mut self,
        after: &Manifest,
        inputs: &[PathBuf],
        overwrite: Overwrite,
    ) -> Result<(), Refusal> {
        self.obstacles.extend(obstacles(&self.folder, [MANIFEST].into_iter()));
        self.obstacles.extend(obstacles(&self.folder, self.before.files.keys().map(String::as_str)));
        if !self.obstacles.is_empty() {
            self.obstacles.sort();
            self.obstacles.dedup();
            return Err(Refusal::InTheWay(self.obstacles));
        }
        let mut manifest = self.file(MANIFEST);
        manifest.write(after.to_text().as_bytes());
        let is_whole = self.before.is_whole;
        self.add(MANIFEST.into(), manifest, |_| is_whole);
        let Self { folder, before, waiting, mut changes, mut foreign, failed, .. } = self;
        if let Some(refusal) = failed {
            return Err(refusal);
        }
        for (name, hash) in before.files.iter().filter(|(name, _)| !after.files.contains_key(*name)) {
            let there = present(&folder, name)?;
            let is_own = there.is(Some(hash));
            // One of a run that stays would be taken for one of what is in the folder now.
            let is_changed = !is_own && there != Present::Nothing && OF_A_RUN.contains(&name.as_str());
            if is_changed {
                foreign.push(folder.join(name));
            }
            if is_own || is_changed {
                changes.push(Change { name: name.clone(), existed: true, hash: None });
            }
        }
        if overwrite == Overwrite::Own && !foreign.is_empty() {
            foreign.sort();
            return Err(Refusal::NotOurs(foreign));
        }
        let read = among(inputs, changes.iter().map(|change| folder.join(&change.name)));
        if !read.is_empty() {
            return Err(Refusal::Inputs(read));
        }
        transaction::apply(&folder, waiting, &changes)
    }
}

/// A file that is compared with the one that is there while it comes, if it is large, and written from the first
/// difference on.
struct NewFile {
    path: PathBuf,
    /// Where it will stand.
    place: PathBuf,
    digest: Sha256,
    /// What is neither in the digest nor in the file yet.
    rest: Vec<u8>,
    target: Target,
    failed: Option<io::Error>,
}

enum Target {
    /// Not large yet.
    Memory,
    /// So many bytes are those of the file that is there.
    There(File, u64),
    File(File),
}

impl NewFile {
    fn new(path: PathBuf, place: PathBuf) -> Self {
        let (digest, rest) = (Sha256::new(), Vec::new());
        Self { path, place, digest, rest, target: Target::Memory, failed: None }
    }

    fn write(&mut self, text: &[u8]) {
        if self.failed.is_some() {
            return;
        }
        self.rest.extend_from_slice(text);
        if self.rest.len() >= MOST_BYTES {
            self.failed = self.write_rest().err();
        }
    }

    fn write_rest(&mut self) -> io::Result<()> {
        if matches!(self.target, Target::Memory) {
            self.target = match File::open(&self.place) {
                Ok(there) => Target::There(there, 0),
                Err(_) => Target::File(self.create()?),
            };
        }
        if let Target::There(there, same) = &mut self.target {
            let mut old = Vec::with_capacity(self.rest.len());
            there.take(self.rest.len() as u64).read_to_end(&mut old)?;
            if old == self.rest {
                *same += old.len() as u64;
            } else {
                let same = *same;
                self.target = Target::File(self.create_as_there(same)?);
            }
        }
        if let Target::File(file) = &mut self.target {
            file.write_all(&self.rest)?;
        }
        self.digest.update(&self.rest);
        self.rest.clear();
        Ok(())
    }

    fn create(&self) -> io::Result<File> {
        self.path.parent().map_or(Ok(()), fs::create_dir_all)?;
        File::create(&self.path)
    }

    /// Begins as the one that is there, which has not changed since it was compared.
    fn create_as_there(&self, same: u64) -> io::Result<File> {
        let mut file = self.create()?;
        io::copy(&mut File::open(&self.place)?.take(same), &mut file)?;
        let copied = hash_of(File::open(&self.path)?)?;
        match copied == hex(&self.digest.clone().finalize()) {
            true => Ok(file),
            false => Err(io::Error::other("this file was changed while it was read")),
        }
    }

    fn end(mut self) -> Result<Hashed, Refusal> {
        let is_large = !matches!(self.target, Target::Memory);
        if is_large && self.failed.is_none() {
            self.failed = self.write_rest().and_then(|()| self.end_of_file()).err();
        }
        if let Some(error) = self.failed {
            return Err(Refusal::Io(self.path, error));
        }
        self.digest.update(&self.rest);
        let hash = hex(&self.digest.finalize());
        let text = match self.target {
            Target::Memory => Made::Text(self.rest),
            Target::There(..) => Made::There,
            Target::File(_) => Made::File,
        };
        Ok(Hashed { path: self.path, hash, text })
    }

    /// The one that is there may be longer.
    fn end_of_file(&mut self) -> io::Result<()> {
        if let Target::There(there, same) = &mut self.target
            && there.read(&mut [0])? > 0
        {
            let same = *same;
            self.target = Target::File(self.create_as_there(same)?);
        }
        Ok(())
    }
}

struct Hashed {
    path: PathBuf,
    hash: String,
    text: Made,
}

/// Where a new text is.
enum Made {
    Text(Vec<u8>),
    File,
    /// In the file that is there.
    There,
}
