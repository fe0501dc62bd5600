//! Formatted specifications: the same tokens and comments, formatting twice changes nothing more, and what comes
//! with the tool is formatted.

use autogen::source::{FileId, Sources};
use autogen::spec::format::format;
use autogen::spec::lexer::{Token, tokens};
use autogen_tests::root;
use std::path::{Path, PathBuf};

/// All files of automata below a folder of the project.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(files(&path));
        } else if path.extension().is_some_and(|end| end == "aut") {
            found.push(path);
        }
    }
    found.sort();
    found
}

fn formatted(text: &str) -> Option<String> {
    let mut sources = Sources::default();
    let file = sources.add("a.aut", text);
    format(file, text).ok()
}

fn read(text: &str) -> Vec<Token> {
    tokens(FileId(0), text, usize::MAX - 1).0.into_iter().map(|(token, _)| token).collect()
}

/// The comments of a text in order, found line by line without its tokens: no text in quotes has two strokes.
fn comments(text: &str) -> Vec<String> {
    text.lines().filter_map(|line| Some(line[line.find("//")?..].trim_end().to_string())).collect()
}

/// Lines that are not blank.
fn lines(text: &str) -> usize {
    text.lines().filter(|line| !line.trim().is_empty()).count()
}

#[test]
fn tokens_and_comments_stay_and_twice_is_once() {
    let folders = ["compiler/library", "examples", "tests/fixtures", "fuzz/corpus/specification"];
    let paths: Vec<PathBuf> = folders.iter().flat_map(|folder| all(&root().join(folder))).collect();
    let (mut done, mut changed) = (0, 0);
    for path in paths {
        let Ok(text) = std::fs::read_to_string(&path) else { continue };
        let Some(new) = formatted(&text) else { continue };
        let name = path.display();
        assert_eq!(read(&text), read(&new), "{name}");
        assert_eq!(comments(&text), comments(&new), "{name}");
        assert_eq!(lines(&text), lines(&new), "{name}");
        assert_eq!(formatted(&new).as_ref(), Some(&new), "{name}");
        assert!(new.lines().all(|line| line.trim_end() == line), "{name}");
        assert!(!new.contains("\n\n\n") && !new.starts_with('\n') && !new.ends_with("\n\n"), "{name}");
        done += 1;
        changed += usize::from(new != text);
    }
    println!("{done} files, {changed} of them not formatted");
    assert!(done > 100, "{done}");
}

/// Files of automata, and those of the corpus, whose names have no end.
fn all(folder: &Path) -> Vec<PathBuf> {
    match folder.ends_with("specification") {
        true => std::fs::read_dir(folder)
            .expect("a folder")
            .map(|entry| entry.expect("an entry").path())
            .collect(),
        false => files(folder),
    }
}

#[test]
fn what_comes_with_the_tool_is_formatted() {
    let paths = ["compiler/library", "examples"].iter().flat_map(|folder| files(&root().join(folder)));
    let wrong: Vec<String> = paths
        .filter(|path| {
            let text = std::fs::read_to_string(path).expect("a text");
            formatted(&text).as_ref() != Some(&text)
        })
        .map(|path| path.display().to_string())
        .collect();
    assert!(wrong.is_empty(), "format them with `autogen fmt`: {wrong:#?}");
}

#[test]
fn a_file_with_all_constructs_looks_so() {
    let text = std::fs::read_to_string(root().join("tests/fixtures/format/all.aut")).expect("a text");
    insta::assert_snapshot!(format!(
        "{text}\n-------- formatted --------\n\n{}",
        formatted(&text).expect("no errors")
    ));
}

#[test]
fn a_text_with_errors_is_refused_and_ends_of_lines_are_kept() {
    assert_eq!(formatted("automaton A on {"), None);
    assert_eq!(
        formatted("enum  A { B,C }\r\n\r\n\r\n// d\r\n").as_deref(),
        Some("enum A { B, C }\r\n\r\n// d\r\n")
    );
    assert_eq!(formatted("").as_deref(), Some(""));
    assert_eq!(formatted("\n\n").as_deref(), Some(""));
}
