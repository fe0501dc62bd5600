//! What `commission` keeps in the cache: compiled controllers, and what runs have found.

use super::*;

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

#[test]
fn what_a_run_has_found_is_kept_and_a_damaged_file_is_replaced() {
    let folder = folder("found");
    let cache = folder.join("cache");
    let layout = example("tending/tending.json");
    let run = || {
        let output = autogen_in(&folder, &cache, &["commission", &layout, "-o", "out", "--no-report"]);
        assert_eq!(status(&output), 0, "{}", errors(&output));
        fs::read(folder.join("out/results.json")).expect("results")
    };
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
