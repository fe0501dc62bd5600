//! What runs have found about a line, kept in the user's cache for the next process: the paths that were planned, and
//! what is free of contact. It changes no result. Where it cannot be read or written, a run takes longer.

use super::cache;
use super::interrupt::{self, Temporary};
use super::output::hash;
use autogen::simulator;
use autogen::version;
use runtime_sim::line::Line;
use runtime_sim::memory::Memory;
use std::env::consts::{ARCH, OS};
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::process;
use std::time::SystemTime;

/// Changes with what is in the files.
const FORMAT: &str = "runs-1";
/// So many lines are remembered; the one that was used least of late goes first.
const MOST_LINES: usize = 50;
/// Bytes of a word.
const WORD: usize = size_of::<u64>();

/// Runs a line with what earlier runs have found about it.
pub fn remembering<T>(line: &Line, run: impl FnOnce(&mut Memory) -> T) -> T {
    // Without arms there is little to find out.
    let has_arms = line.machines.iter().any(|machine| machine.arm().is_some());
    let Some(file) = has_arms.then(|| file(line)).flatten() else { return run(&mut Memory::default()) };
    let known = read(&file).and_then(|words| Some((Memory::restored(line, &words)?, words.len())));
    let (mut memory, count) = known.unwrap_or_default();
    let result = run(&mut memory);
    let words = memory.stored();
    if words.len() != count {
        // The next run finds it out again.
        let _ = write(&file, &words);
    }
    result
}

/// For all that paths and contacts depend on: the simulator, and where the machines and obstacles of the line are.
fn file(line: &Line) -> Option<PathBuf> {
    let mut all = format!("{} {ARCH} {OS}\n", version::NUMBER);
    for (name, text) in simulator::SOURCES {
        all += &format!("{name} {}\n{text}\n", text.len());
    }
    all += &Memory::text_of(line);
    Some(cache::folder().ok()?.join(FORMAT).join(hash(all.as_bytes())))
}

/// The words behind their hash. The file is now the one that was used last.
fn read(file: &Path) -> Option<Vec<u64>> {
    if !fs::symlink_metadata(file).ok()?.is_file() {
        return None;
    }
    let mut bytes = Vec::new();
    let mut opened = File::open(file).ok()?;
    opened.read_to_end(&mut bytes).ok()?;
    let _ = opened.set_modified(SystemTime::now());
    let (digest, words) = bytes.split_at_checked(hash(&[]).len())?;
    let is_whole = words.len() % WORD == 0 && hash(words).as_bytes() == digest;
    let words = words.as_chunks().0.iter().map(|word| u64::from_le_bytes(*word));
    is_whole.then(|| words.collect())
}

fn write(file: &Path, words: &[u64]) -> io::Result<()> {
    let folder = file.parent().unwrap_or(file);
    fs::create_dir_all(folder)?;
    let words: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    let new = Temporary::new(file.with_extension(process::id().to_string()));
    fs::write(new.path(), [hash(&words).as_bytes(), &words].concat())?;
    {
        let _writing = interrupt::writing();
        fs::rename(new.path(), file)?;
    }
    new.leave();
    forget_oldest(folder)
}

fn forget_oldest(folder: &Path) -> io::Result<()> {
    let mut files: Vec<(SystemTime, PathBuf)> = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let metadata = entry.metadata()?;
        if metadata.is_file() {
            files.push((metadata.modified()?, entry.path()));
        }
    }
    files.sort();
    let count = files.len().saturating_sub(MOST_LINES);
    files[..count].iter().try_for_each(|(_, file)| fs::remove_file(file))
}
