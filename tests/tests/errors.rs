//! `docs/errors.md` has every code that the compiler and the command line use, and no other.

use autogen::diagnostic::explain;
use autogen_tests::{root, text};
use std::collections::BTreeSet;
use std::path::Path;

fn codes_of(text: &str, found: &mut BTreeSet<String>) {
    let begins = ["\"E", "\"W0", "\"N0"].into_iter().flat_map(|begin| text.match_indices(begin));
    for (at, _) in begins {
        let code: String = text[at + 1..].chars().take_while(char::is_ascii_alphanumeric).collect();
        if code.len() == 5 && code[1..].bytes().all(|b| b.is_ascii_digit()) {
            found.insert(code);
        }
    }
}

fn codes_in(folder: &Path, found: &mut BTreeSet<String>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            codes_in(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            codes_of(&std::fs::read_to_string(&path).expect("a text"), found);
        }
    }
}

#[test]
fn every_code_is_explained_and_used() {
    let mut used = BTreeSet::new();
    for folder in ["compiler/src", "command-line/src"] {
        codes_in(&root().join(folder), &mut used);
    }
    let text = text("docs/errors.md");
    let headings: Vec<String> =
        text.lines().filter_map(|l| l.strip_prefix("## ")).map(String::from).collect();
    let explained: BTreeSet<String> = headings.iter().cloned().collect();
    assert_eq!(headings.len(), explained.len(), "a code stands twice");
    assert!(headings.is_sorted(), "the codes are not in order");
    let missing: Vec<_> = used.difference(&explained).collect();
    assert!(missing.is_empty(), "used and not explained: {missing:?}");
    let extra: Vec<_> = explained.difference(&used).collect();
    assert!(extra.is_empty(), "explained and not used: {extra:?}");
    for code in &used {
        assert!(explain(code).is_some_and(|t| t.len() > 20 && !t.contains("## ")), "{code}");
    }
    assert_eq!(explain("E9999"), None);
}
