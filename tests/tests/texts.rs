//! Texts of a screen in other languages: what is wrong with a table of them, and the tables that come of it.

use autogen::backend::st;
use autogen::diagnostic::render_plain;
use autogen::source::Sources;
use autogen::translation::{self, Translations};
use autogen_tests::{ariac, root, text};
use std::collections::BTreeSet;

/// A table of the fixtures against the texts of the line of the paper.
fn read(name: &str, known: &[String]) -> Result<Translations, String> {
    let mut tables = Sources::default();
    let file = tables.add(name, text(&format!("tests/fixtures/texts/{name}")));
    let known: BTreeSet<&str> = known.iter().map(String::as_str).collect();
    translation::read(&tables, file, &known).map_err(|found| render_plain(&tables, &found))
}

#[test]
fn wrong_tables_of_texts_are_explained() {
    let outcome = ariac("default").compile();
    let system = outcome.project.expect("a layout that can be built").system;
    let known = st::screen_texts(&system, &outcome.sources);
    let mut names: Vec<_> = std::fs::read_dir(root().join("tests/fixtures/texts"))
        .expect("the folder of tables")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .filter(|name| name.starts_with("wrong_"))
        .collect();
    names.sort();
    assert!(!names.is_empty());
    for name in names {
        let found = read(&name, &known).expect_err(&name);
        let table = text(&format!("tests/fixtures/texts/{name}"));
        insta::assert_snapshot!(name.trim_end_matches(".csv"), format!("{table}\n----\n{found}"));
    }
}

/// What changes in a table is what was translated, and nothing else.
#[test]
fn a_screen_has_its_texts_in_other_languages() {
    let outcome = ariac("default").compile();
    let system = outcome.project.expect("a layout that can be built").system;
    let known = st::screen_texts(&system, &outcome.sources);
    let plain = st::files(&system, &outcome.sources);
    let translations = read("right.csv", &known).expect("a table without errors");
    assert_eq!(translations.strangers, ["No such text"]);
    let files = st::translated(&system, &outcome.sources, &translations);
    let names: Vec<&str> = files.keys().map(String::as_str).collect();
    assert_eq!(names, ["alarms.de.csv", "alarms.fr.csv", "states.de.csv", "states.fr.csv", "texts.csv"]);
    let mut shown = text("tests/fixtures/texts/right.csv");
    for name in &names[..4] {
        let original = &plain[&name.replace(".de", "").replace(".fr", "")];
        assert_eq!(original.lines().count(), files[*name].lines().count(), "{name}");
        shown += &format!("\n---- {name}\n");
        let changed = original.lines().zip(files[*name].lines()).filter(|(old, new)| old != new);
        changed.for_each(|(_, new)| shown += &format!("{new}\n"));
    }
    shown += &format!("\n---- texts.csv\n{}", files["texts.csv"]);
    insta::assert_snapshot!("texts", shown);
    // The table that is written can be filled, and then says the same.
    let mut tables = Sources::default();
    let file = tables.add("texts.csv", files["texts.csv"].as_str());
    let again = translation::read(&tables, file, &known.iter().map(String::as_str).collect());
    let again = again.unwrap_or_else(|found| panic!("{}", render_plain(&tables, &found)));
    assert_eq!(st::translated(&system, &outcome.sources, &again), files);
}
