//! `build --check`: generated code that is kept under version control.

use super::*;

fn check(folder: &Path, more: &[&str]) -> Output {
    let layout = example("scenes/lifting_table.json");
    autogen(folder, &[&["build", &layout, "-o", "made"][..], more].concat())
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn what_was_built_is_what_would_be_written() {
    let folder = folder("checked_in");
    let output = check(&folder, &["--check"]);
    assert_eq!(status(&output), 1);
    assert!(said(&output).contains("there is no folder made"), "{}", said(&output));
    assert!(!folder.join("made").exists(), "nothing is written");

    assert_eq!(status(&check(&folder, &[])), 0);
    let output = check(&folder, &["--check"]);
    assert_eq!(status(&output), 0, "{}", said(&output));
    assert!(said(&output).contains("are the same as would be written now"), "{}", said(&output));
}

#[test]
fn each_file_that_differs_is_named_with_a_short_diff() {
    let folder = folder("checked_in_differs");
    assert_eq!(status(&check(&folder, &[])), 0);
    let changed = folder.join("made/rust/controllers/src/system.rs");
    let text = fs::read_to_string(&changed).expect("a file");
    fs::write(&changed, text.replacen("pub fn", "pub  fn", 1)).expect("a file");
    fs::remove_file(folder.join("made/graph/plan.svg")).expect("a file");
    fs::write(folder.join("made/notes.txt"), "a person's own").expect("a file");
    let before = contents(&folder);

    let output = check(&folder, &["--check"]);
    assert_eq!(status(&output), 1);
    let text = said(&output);
    assert!(text.contains("missing            graph/plan.svg"), "{text}");
    assert!(text.contains("differs            rust/controllers/src/system.rs"), "{text}");
    assert!(text.contains("\n-") && text.contains("pub  fn") && text.contains("2 files differ"), "{text}");
    assert!(!text.contains("notes.txt"), "{text}");
    let output = check(&folder, &["--check", "--format", "json"]);
    assert_eq!(status(&output), 1);
    let answer = json(&output);
    assert_eq!(answer["same"], false);
    assert_eq!(answer["differences"][0]["file"], "graph/plan.svg");
    assert_eq!(answer["differences"][0]["is"], "missing");
    assert_eq!(answer["differences"].as_array().map(Vec::len), Some(2));
    assert_eq!(before, contents(&folder), "nothing is written");

    assert_eq!(status(&check(&folder, &["--check", "--force"])), 2);
}

#[test]
fn files_of_types_that_are_no_more_differ_too() {
    let folder = folder("checked_in_left");
    let (long, short) = (example("buffer/buffer.json"), example("ariac2021/default.json"));
    assert_eq!(status(&autogen(&folder, &["build", &long, "-o", "made"])), 0);
    let output = autogen(&folder, &["build", &short, "-o", "made", "--check"]);
    assert_eq!(status(&output), 1);
    let text = said(&output);
    assert!(text.contains("no longer written  plc/codesys/E_BufferState.st"), "{text}");
}
