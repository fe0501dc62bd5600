//! Corpus, findings and seeds, from their places in the project.

use autogen_tests::root;
use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};

/// Where inputs of other tests stand: folder or file, and the end of their names.
const SEEDS: [(&str, &str, &str); 17] = [
    ("layout", "examples/ariac2021", "json"),
    ("layout", "examples/buffer", "json"),
    ("layout", "examples/shared_agv", "json"),
    ("layout", "tests/fixtures/layout", "txt"),
    ("layout", "tests/fixtures/collision", "json"),
    ("specification", "compiler/library", "aut"),
    ("specification", "examples/ariac2021/prototype", "aut"),
    ("specification", "examples/buffer/specs", "aut"),
    ("specification", "tests/fixtures/rust", "aut"),
    ("specification", "tests/fixtures/spec", "aut"),
    ("scenario", "examples/ariac2021", "scenario.json"),
    ("scenario", "tests/fixtures/scenario", "txt"),
    ("import", "tests/fixtures/import/urdf", "txt"),
    ("import", "tests/fixtures/import/opw", "txt"),
    ("import", "tests/fixtures/import/lif", "txt"),
    ("table", "tests/fixtures/io", "csv"),
    ("table", "examples/ariac2021", "csv"),
];

/// What stands in a fixture behind its input.
const EXPECTED: &[u8] = b"--- expect";

/// The same for the same bytes on every machine and in every run.
pub fn hash(bytes: &[u8]) -> u64 {
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    hasher.finish()
}

/// Inputs of a target to begin with.
pub fn seeds(target: &str) -> Vec<Vec<u8>> {
    let elsewhere = SEEDS.iter().filter(|(own, ..)| *own == target);
    let mut paths: Vec<PathBuf> =
        elsewhere.flat_map(|(_, folder, end)| listed(&root().join(folder), end)).collect();
    paths.extend(corpus(target));
    paths.extend(findings(target));
    paths.iter().map(|path| without_expectation(&bytes(path))).collect()
}

pub fn corpus(target: &str) -> Vec<PathBuf> {
    listed(&root().join("fuzz/corpus").join(target), "")
}

pub fn findings(target: &str) -> Vec<PathBuf> {
    listed(&root().join("fuzz/findings").join(target), "")
}

pub fn bytes(path: &Path) -> Vec<u8> {
    std::fs::read(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

fn without_expectation(bytes: &[u8]) -> Vec<u8> {
    let end = bytes.windows(EXPECTED.len()).position(|window| window == EXPECTED);
    bytes[..end.unwrap_or(bytes.len())].to_vec()
}

/// Files of a folder in the order of their names; none if it is not there.
fn listed(folder: &Path, end: &str) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut paths: Vec<PathBuf> =
        paths.filter(|path| path.is_file() && path.to_string_lossy().ends_with(end)).collect();
    paths.sort();
    paths
}
