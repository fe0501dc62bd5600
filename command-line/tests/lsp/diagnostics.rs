//! Diagnostics of what is typed and not saved, and formatting.

use super::client::{Client, place, uri};
use super::{new_line, read};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

fn codes(found: &[Value]) -> Vec<&str> {
    found.iter().map(|diagnostic| diagnostic["code"].as_str().unwrap_or("none")).collect()
}

#[test]
fn what_is_typed_is_checked() {
    let folder = new_line("typed");
    let file = folder.join("specs/stamp.aut");
    let text = read(&file);
    let mut client = Client::in_folder(&folder);
    client.open(&file, &text);
    assert_eq!(client.diagnostics(&file), Vec::<Value>::new());

    // Columns are units of UTF-16: an umlaut is one, the robot is two.
    let wrong = text.replace("when at_stamp and", "/* Größe \u{1f916} */ when at_stmp and");
    let wrong = wrong.replace("/*", "//").replace(" */ when", "\n    when");
    client.change(&file, &wrong);
    let found = client.diagnostics(&file);
    assert_eq!(codes(&found), ["E0311"], "{found:?}");
    assert_eq!(found[0]["range"]["start"], place(&wrong, "at_stmp", 0));
    let message = found[0]["message"].as_str().expect("a text");
    assert!(message.contains("is `at_stamp` meant?"), "{message}");
    assert_eq!(read(&file), text, "nothing is written");

    let wrong = text.replace("/// How long", "/// Größe \u{1f916}").replace("the stamp stays", "\u{1f916}");
    let wrong = wrong.replace("parameter hold_time: time", "/* \u{e4}\u{1f916} */ parameter hold_time: time");
    client.change(&file, &wrong);
    let found = client.diagnostics(&file);
    assert_eq!(codes(&found), ["E0201"], "{found:?}");
    assert_eq!(found[0]["range"]["start"], place(&wrong, "/* \u{e4}", 0));

    client.change(&file, &text);
    assert_eq!(client.diagnostics(&file), Vec::<Value>::new());
}

#[test]
fn columns_behind_characters_of_two_units_are_right() {
    let folder = new_line("columns");
    let file = folder.join("specs/stamp.aut");
    let text = read(&file).replace("when at_end ->", "when \u{1f916} at_end ->");
    let mut client = Client::in_folder(&folder);
    client.open(&file, &text);
    let found = client.diagnostics(&file);
    let robot = place(&text, "\u{1f916}", 0);
    assert_eq!(found[0]["range"]["start"], robot, "{found:?}");
    let end = found[0]["range"]["end"]["character"].as_u64();
    assert_eq!(end, robot["character"].as_u64().map(|start| start + 2));
}

#[test]
fn layouts_scenarios_and_tests_are_checked_and_files_act_on_one_another() {
    let folder = new_line("together");
    let (layout, scenario) = (folder.join("line.json"), folder.join("scenario.json"));
    let (automata, tests) = (folder.join("specs/stamp.aut"), folder.join("station.test"));
    let mut client = Client::in_folder(&folder);
    client.open(&layout, &read(&layout));
    assert_eq!(client.diagnostics(&layout), Vec::<Value>::new());

    let wrong = read(&layout).replace("hold_time", "hold_tim");
    client.change(&layout, &wrong);
    let found = client.diagnostics(&layout);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0]["range"]["start"], place(&wrong, "\"hold_tim", 0));

    // The same name in the automaton, which is not saved: now the layout is right.
    client.open(&automata, &read(&automata).replace("hold_time", "hold_tim"));
    assert_eq!(client.diagnostics(&automata), Vec::<Value>::new());
    client.change(&layout, &wrong);
    assert_eq!(client.diagnostics(&layout), Vec::<Value>::new());

    let text = read(&scenario);
    client.open(&scenario, &text.replacen('{', "{ \"time_limit\": 1,", 1));
    let found = client.diagnostics(&scenario);
    assert_eq!(found.len(), 1, "{found:?}");
    client.change(&scenario, &text);
    assert_eq!(client.diagnostics(&scenario), Vec::<Value>::new());

    client.open(&tests, &read(&tests).replacen(';', "", 1));
    assert!(!client.diagnostics(&tests).is_empty());

    // A file that is closed is again as on the disk, and what was said of it is taken back.
    client.notify("textDocument/didClose", json!({"textDocument": {"uri": uri(&automata)}}));
    client.change(&layout, &wrong);
    assert_eq!(client.diagnostics(&layout).len(), 1);
}

#[test]
fn automata_without_a_layout_are_checked_with_their_folder() {
    let folder = new_line("alone");
    fs::remove_file(folder.join("line.json")).expect("the layout");
    let file = folder.join("specs/stamp.aut");
    let mut client = Client::in_folder(&folder);
    let text = read(&file);
    client.open(&file, &text.replace("-> Holding", "-> Holdin"));
    let found = client.diagnostics(&file);
    assert!(codes(&found).contains(&"E0311"), "{found:?}");
    // A file that exists in the editor only stands beside it.
    let other = folder.join("specs/other.aut");
    client.open(&other, "enum Side { Left, Right }\nenum Side { Up }\n");
    assert_eq!(codes(&client.diagnostics(&other)), ["E0301"]);
}

#[cfg(unix)]
#[test]
fn why_nothing_is_checked_is_said_in_the_files_that_are_open() {
    let folder = new_line("unchecked");
    fs::remove_file(folder.join("line.json")).expect("the layout");
    std::os::unix::fs::symlink("/etc/passwd", folder.join("specs/link.aut")).expect("a link");
    let file = folder.join("specs/stamp.aut");
    let mut client = Client::in_folder(&folder);
    client.open(&file, &read(&file));
    let found = client.diagnostics(&file);
    let text = found[0]["message"].as_str().expect("a text");
    assert!(text.contains("link.aut is a symbolic link that leads out of it"), "{text}");
}

#[test]
fn formatting_is_that_of_the_command() {
    let folder = new_line("formatted");
    let file = folder.join("specs/stamp.aut");
    let text = read(&file);
    let mut client = Client::in_folder(&folder);
    let params =
        json!({"textDocument": {"uri": uri(&file)}, "options": {"tabSize": 8, "insertSpaces": false}});
    client.open(&file, &text);
    assert_eq!(client.result("textDocument/formatting", params.clone()), json!([]));
    client.change(&file, &text.replace("    state", "  state").replace(" := 500 ms", ":=500   ms"));
    let edits = client.result("textDocument/formatting", params.clone());
    assert_eq!(edits[0]["newText"], text.as_str());
    assert_eq!(edits[0]["range"]["start"], json!({"line": 0, "character": 0}));
    // Nothing is done to a text with errors.
    client.change(&file, &text.replace(';', ""));
    assert_eq!(client.result("textDocument/formatting", params), Value::Null);
}

#[test]
fn what_is_wrong_in_a_built_in_text_is_shown_in_the_layout() {
    let folder = new_line("built-in");
    fs::remove_file(folder.join("scenario.json")).expect("the scenario");
    let (layout, automata) = (folder.join("line.json"), folder.join("queue_of_items.aut"));
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/scenes/queue_of_items.aut");
    fs::copy(example, &automata).expect("a copy");
    // Orders of the built-in scenario have no station here.
    let text = r#"{"specs": "queue_of_items.aut", "robots": [{"name": "queue", "type": "queue_of_items", "pose": [0, 0, 0]}]}"#;
    let mut client = Client::in_folder(&folder);
    client.open(&layout, text);
    client.open(&automata, &read(&automata));
    let found = client.diagnostics(&layout);
    assert!(codes(&found).contains(&"E0135"), "{found:?}");
    let of_it = found.iter().find(|one| one["code"] == "E0135").expect("it is there");
    assert_eq!(of_it["range"]["start"], json!({"line": 0, "character": 0}));
    assert!(
        of_it["message"].as_str().is_some_and(|text| text.contains("in the built-in scenario")),
        "{of_it}"
    );
    assert!(!codes(&client.diagnostics(&automata)).contains(&"E0135"));
}
