//! Types that replace those of the library.

use autogen::diagnostic::Diagnostic;
use autogen_tests::{Texts, ariac, plain};

const LAMP: &str =
    "device vehicle { part red = lamp { at: pose; colour: red; }; out lit: bool = red.on stop true; }";
const BIN: &str = r#"{"robots": [{"name": "m1", "type": "agv", "pose": [0, 0, 0]}]}"#;

/// What is wrong with a line that has this type too, and the rendered text.
fn told(line: Texts, own: &str) -> (Vec<Diagnostic>, String) {
    let outcome = Texts { specs: vec![own.into()], ..line }.compile();
    let text = plain(&outcome.sources, &outcome.diagnostics);
    assert_eq!(outcome.project.is_some(), outcome.diagnostics.is_empty(), "{text}");
    (outcome.diagnostics, text)
}

#[test]
fn roles_of_types_that_no_machine_has_need_nobody() {
    let own = "automaton Agv on bin { local n: int 0..9; initial state S { when n < 9 -> S { n += 1; } } }";
    let (found, text) = told(Texts::of_layout(BIN), own);
    assert_eq!(found, [], "{text}");
}

#[test]
fn an_automaton_that_takes_away_an_interface_is_named() {
    let own = "automaton Agv on vehicle { initial state S { when ready -> S {} } }";
    let (found, text) = told(ariac("default"), own);
    assert_eq!(found.iter().map(|d| d.code).collect::<Vec<_>>(), ["E0304"], "{text}");
    assert!(text.contains("--> specs/0.aut:1:11"), "{text}");
    assert!(text.contains("this replaces the `Agv` that had it"), "{text}");
    assert!(found[0].help.contains("choose another name"), "{text}");
}

#[test]
fn errors_of_the_library_are_those_of_what_replaces_its_types() {
    for (own, name) in [
        ("enum Slot { Low, High }", "OwnSlot"),
        ("interface Tray { shared open: bool; }", "OwnTray"),
        (LAMP, "own_vehicle"),
    ] {
        let (found, text) = told(Texts::of_layout(BIN), own);
        assert_eq!(found.iter().map(|d| d.code).collect::<Vec<_>>(), ["E0307"], "{text}");
        assert!(text.contains("--> specs/0.aut:1:"), "{text}");
        assert!(found[0].help.contains(name), "{text}");
    }
}
