//! What `commission` keeps in the cache: compiled controllers, and what runs have found.

use super::*;
use std::fs::File;
use std::time::{Duration, SystemTime};

/// Of public items without a description there are many.
#[test]
fn flags_that_make_warnings_errors_are_those_of_the_user_s_own_code() {
    let folder = folder("flags_of_rustc");
    for (name, flags) in
        [("RUSTFLAGS", "-D missing_docs"), ("CARGO_ENCODED_RUSTFLAGS", "-D\u{1f}missing_docs")]
    {
        let output = Command::new(env!("CARGO_BIN_EXE_autogen"))
            .args(["commission", &example("scenes/lifting_table.json"), "-o", name])
            .current_dir(&folder)
            .env("XDG_CACHE_HOME", folder.join(format!("cache of {name}")))
            .env(name, flags)
            .output()
            .expect("autogen can be started");
        assert_eq!(status(&output), 0, "{name}: {}", errors(&output));
    }
}

/// Of a line with an arm.
fn results_of(folder: &Path, cache: &Path) -> Vec<u8> {
    let layout = example("tending/tending.json");
    let output = autogen_in(folder, cache, &["commission", &layout, "-o", "out", "--no-report"]);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    fs::read(folder.join("out/results.json")).expect("results")
}

#[test]
fn what_a_run_has_found_is_kept_and_a_damaged_file_is_replaced() {
    let folder = folder("found");
    let cache = folder.join("cache");
    let run = || results_of(&folder, &cache);
    let kept = || {
        let files = contents(&cache.join("autogen/runs-1"));
        assert_eq!(files.len(), 1);
        files.into_iter().next().expect("a file")
    };
    let results = run();
    let (file, found) = kept();
    assert_eq!(run(), results);
    let path = cache.join("autogen/runs-1").join(file);
    // Behind the hash: an answer.
    let mut damaged = found.clone();
    damaged[80] ^= 1;
    for other in [&damaged[..], &found[..found.len() / 2], &[]] {
        fs::write(&path, other).expect("a file that can be written");
        assert_eq!(run(), results);
        assert_eq!(kept().1.len(), found.len());
    }
}

/// A run that finds nothing new has used its file all the same. What is no file is left alone.
#[test]
fn what_was_not_used_for_longest_is_forgotten() {
    let folder = folder("forgotten");
    let cache = folder.join("cache");
    let run = || results_of(&folder, &cache);
    let runs = cache.join("autogen/runs-1");
    let write = |name: &Path, hours: u64| {
        let file = File::create(runs.join(name)).expect("a file");
        file.set_modified(SystemTime::now() - Duration::from_secs(3600 * hours)).expect("a file of mine");
    };
    run();
    let (own, _) = contents(&runs).into_iter().next().expect("a file");
    let old = File::open(runs.join(&own)).expect("a file");
    let before = SystemTime::now() - Duration::from_secs(3600);
    old.set_modified(before).expect("a file of mine");
    run();
    let used = old.metadata().and_then(|file| file.modified()).expect("a time");
    assert!(used > before, "a run has used it");

    fs::create_dir(runs.join("folder")).expect("a folder");
    (0..50).for_each(|number| write(Path::new(&format!("other{number}")), if number == 7 { 3 } else { 1 }));
    write(&own, 0);
    run();
    let left: Vec<u64> = (0..50).filter(|number| !runs.join(format!("other{number}")).exists()).collect();
    assert_eq!(left, [7]);
    assert!(runs.join(own).exists() && runs.join("folder").exists());
}
