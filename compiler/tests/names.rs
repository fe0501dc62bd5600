//! What the names of the library and of all examples mean: every word that is no word of the language is declared
//! somewhere, and unfinished texts are understood as far as they go.

use autogen::library;
use autogen::lsp::completion::completion;
use autogen::lsp::hover::hover;
use autogen::lsp::specs::Specs;
use autogen::source::{FileId, Sources, Span};
use autogen::spec::lexer::{Token, tokens};
use std::fs;
use std::path::{Path, PathBuf};

/// Words of docs/language.md that stand for themselves wherever they stand in these texts.
const OF_LANGUAGE: &[&str] = &[
    "abs",
    "accepts",
    "after",
    "all",
    "and",
    "answer",
    "any",
    "approach",
    "assembly",
    "at",
    "automaton",
    "bool",
    "by",
    "command",
    "constant",
    "count",
    "counter",
    "define",
    "device",
    "done",
    "else",
    "enum",
    "except",
    "exists",
    "failed",
    "false",
    "final",
    "first",
    "forall",
    "from",
    "handover",
    "hands",
    "handshake",
    "in",
    "initial",
    "int",
    "interface",
    "invariant",
    "is",
    "keep",
    "knows",
    "least",
    "line",
    "local",
    "lock",
    "machine",
    "max",
    "min",
    "mod",
    "most",
    "ms",
    "nearest",
    "not",
    "of",
    "offers",
    "on",
    "or",
    "others",
    "out",
    "owner",
    "parameter",
    "part",
    "parts",
    "point",
    "reaches",
    "real",
    "require",
    "resume",
    "retain",
    "s",
    "scenario",
    "self",
    "sequence",
    "serves",
    "shared",
    "squared_distance",
    "state",
    "stop",
    "sum",
    "takes",
    "then",
    "time",
    "to",
    "token",
    "true",
    "unit",
    "until",
    "up",
    "wait",
    "warn",
    "when",
    "whenever",
    "while",
    "with",
    "within",
    "x",
    "y",
    "z",
];

fn example_files() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples");
    let (mut open, mut found) = (vec![root], Vec::new());
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path()) {
            match entry.is_dir() {
                true => open.push(entry),
                false if entry.extension().is_some_and(|e| e == "aut") => found.push(entry),
                false => {}
            }
        }
    }
    found.sort();
    found
}

/// The library and one file more.
fn specs(name: &str, text: &str) -> (Specs, FileId) {
    let mut sources = Sources::default();
    let mut files: Vec<FileId> =
        library::FILES.iter().map(|(name, text)| sources.add(*name, *text)).collect();
    let file = sources.add(name, text);
    files.push(file);
    (Specs::new(sources, &files, None, Some(vec!["battery".into(), "pump".into()])), file)
}

/// Line and word of each name in an automaton, interface or enumeration that means nothing.
fn unknown(specs: &Specs, file: FileId) -> Vec<(usize, String)> {
    let (words, _) = tokens(file, &specs.sources.file(file).text, 200_000);
    let mut depth = 0;
    let mut in_device = false;
    let mut found = Vec::new();
    for (token, span) in &words {
        match token {
            Token::Word(word) => {
                if depth == 0 && ["device", "assembly"].contains(&word.as_str()) {
                    in_device = true;
                }
                let known = OF_LANGUAGE.contains(&word.as_str()) || specs.names.at(*span).is_some();
                if !in_device && !known {
                    found.push((specs.sources.position(*span).0, word.clone()));
                }
            }
            Token::Sign("{") => depth += 1,
            Token::Sign("}") => {
                depth -= 1;
                in_device &= depth > 0;
            }
            _ => {}
        }
    }
    found
}

#[test]
fn every_name_is_known() {
    let (all, _) = specs("none.aut", "");
    for number in 0..library::FILES.len() {
        let name = library::FILES[number].0;
        assert_eq!(unknown(&all, FileId(number as u32)), [], "{name}");
    }
    let files = example_files();
    assert!(files.len() > 20);
    for path in files {
        // Folders of automata are taken as a whole.
        if path.parent().is_some_and(|folder| folder.ends_with("specs") || folder.ends_with("prototype")) {
            continue;
        }
        let text = fs::read_to_string(&path).expect("a text");
        let (all, file) = specs(&path.display().to_string(), &text);
        assert_eq!(unknown(&all, file), [], "{}", path.display());
    }
}

#[test]
fn every_use_reads_as_its_declaration() {
    let (all, _) = specs("none.aut", "");
    let mut count = 0;
    for (span, number) in all.names.uses() {
        let declaration = &all.names.declarations()[number];
        let text = all.sources.text(span);
        // The paper's word for a vehicle's command.
        assert!(text == declaration.name || text == "goto", "{text} {declaration:?}");
        count += 1;
    }
    assert!(count > 1000, "{count}");
}

#[test]
fn unfinished_texts_are_understood_as_far_as_they_go() {
    let example = example_files().into_iter().find(|path| path.ends_with("tending.aut")).expect("an example");
    let example = fs::read_to_string(example).expect("a text");
    let texts = [example.as_str(), library::FILES[9].1, library::FILES[4].1];
    for text in texts {
        let (words, _) = tokens(FileId(0), text, 200_000);
        for (number, (_, span)) in words.iter().enumerate().filter(|(number, _)| number % 29 == 0) {
            let (start, end) = (span.start as usize, span.end as usize);
            let cut = &text[..end];
            let without = format!("{}{}", &text[..start], &text[end..]);
            let point = format!("{}.{}", &text[..end], &text[end..]);
            for (broken, at) in [(cut, end), (without.as_str(), start), (point.as_str(), end + 1)] {
                let (specs, file) = specs("broken.aut", broken);
                completion(&specs, file, at);
                hover(&specs, Span::new(file, start.saturating_sub(1), start));
                assert!(number == 0 || specs.names.uses().next().is_some());
            }
        }
    }
}
