//! The dictionaries for libFuzzer are those of the grammars.

use autogen_fuzz::{dictionary, target};
use autogen_tests::{Texts, root, text};

#[test]
fn files_hold_the_words_of_the_grammars() {
    for target in &target::ALL {
        let path = format!("fuzz/dictionary/{}.dict", target.name);
        let wanted = dictionary::file(&(target.words)());
        if std::env::var_os("AUTOGEN_FUZZ_WRITE").is_some() {
            std::fs::write(root().join(&path), &wanted).expect("a folder");
        }
        assert!(text(&path) == wanted, "{path} is old: AUTOGEN_FUZZ_WRITE=1 renews it");
    }
}

/// A reader that meets an unknown key names those that it knows.
#[test]
fn layouts_have_every_key_of_their_reader() {
    let unknown = r#"{"?": 0, "may_touch": [{"?": 0}], "robots": [
        {"?": 0, "name": "a", "type": "agv", "pose": [0, 0, 0], "destinations": [[0, 0, 0], [1, 0, 0]]},
        {"?": 0, "name": "b", "type": "conveyor", "pose": [0, 0, 0], "orient": "y", "orient_range": [-5, 5]},
        {"?": 0, "name": "c", "type": "kitting", "pose": [0, 0, 0], "rail_dim": "y", "rail_range": [-5, 5]},
        {"?": 0, "name": "d", "type": "gantry", "pose": [0, 0, 0], "x_rail_range": [-5, 5], "y_rail_range": [-5, 5]}],
        "stationary": [{"?": 0, "name": "e", "type": "box", "pose": [0, 0, 0]}]}"#;
    let scenario = r#"{"?": 0, "kinds": [{"?": 0}], "orders": [{"?": 0}], "supply": {"?": 0},
        "faults": {"?": 0, "slips": [{"?": 0}], "refusals": [{"?": 0}], "answers": [{"?": 0}], "pauses": [{"?": 0}], "power_offs": [{"?": 0}],
        "sensors": [{"?": 0}], "jams": [{"?": 0}], "slow": [{"?": 0}]}}"#;
    let orders = r#"{"kinds": [{}], "orders": {"?": 0}}"#;
    let lines = [
        (dictionary::layout(), Texts::of_layout(unknown)),
        (dictionary::scenario(), Texts { scenario: Some(scenario.into()), ..Texts::default() }),
        (dictionary::scenario(), Texts { scenario: Some(orders.into()), ..Texts::default() }),
    ];
    for (words, texts) in lines {
        let outcome = texts.compile();
        let notes = outcome.diagnostics.iter().filter(|d| d.code == "E0111").flat_map(|d| &d.notes);
        let lists: Vec<String> =
            notes.filter_map(|n| Some(n.strip_prefix("known keys: ")?.replace(" and ", ", "))).collect();
        let known: Vec<&str> = lists.iter().flat_map(|list| list.split(", ")).collect();
        assert!(known.len() >= 3, "{known:?}");
        for key in known {
            assert!(words.contains(&format!("\"{key}\"")), "{key}");
        }
    }
}
