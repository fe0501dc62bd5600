//! A layout that cannot be read while somebody types in it still has its automata.

use super::client::{Client, place, uri};
use super::{new_line, read};
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};

const FACE: &str = "interface Face {\n    shared busy: bool := false by owner;\n}\n";
const KEEPER: &str = r#"device shelf {
    part go = button {};
    /// it is pressed
    in pressed: bool = go.on;
}
automaton Keeper on shelf is Face {
    local last: Kind := cup;
    local n: int 0..3 := 0;
    initial state Waiting {
        when pressed and last = cup and n < 3 -> Waiting { n += 1; last := plate; busy := not busy; }
    }
}
"#;
const SCENARIO: &str =
    r#"{"kinds": [{"name": "cup", "height": 0.1}, {"name": "plate", "height": 0.1}], "time_limit_s": 5}"#;
const LAYOUT: &str = r#"{
  "specs": ["types/face.aut", "keeper.aut"], "scenario": "own.json",
  "robots": [{"name": "k1", "type": "keeper", "pose": [0, 0, 0]}]
}"#;

struct Line {
    client: Client,
    layout: PathBuf,
    face: PathBuf,
    keeper: PathBuf,
}

/// The layout is open with a text, and the automata as they are on the disk.
fn line(name: &str, text: &str) -> Line {
    let folder = new_line(name);
    fs::create_dir(folder.join("types")).expect("a new folder");
    fs::remove_file(folder.join("scenario.json")).expect("the scenario");
    let [layout, face, keeper] = ["line.json", "types/face.aut", "keeper.aut"].map(|name| folder.join(name));
    for (file, text) in [(&layout, LAYOUT), (&face, FACE), (&keeper, KEEPER)] {
        fs::write(file, text).expect("a new file");
    }
    fs::write(folder.join("own.json"), SCENARIO).expect("a new file");
    let mut client = Client::in_folder(&folder);
    client.open(&layout, text);
    client.open(&face, FACE);
    client.open(&keeper, KEEPER);
    Line { client, layout, face, keeper }
}

impl Line {
    fn rename(&mut self, file: &Path, word: &str, new: &str) -> Value {
        let place = place(&read(file), word, 0);
        let params = json!({"textDocument": {"uri": uri(file)}, "position": place, "newName": new});
        self.client.request("textDocument/rename", params)
    }

    fn refused(&mut self, file: &Path, word: &str) -> String {
        let answer = self.rename(file, word, "Another");
        assert_eq!(answer["error"]["code"], -32803, "{answer}");
        answer["error"]["message"].as_str().expect("a text").into()
    }
}

/// Texts on the way to another machine.
fn broken() -> [String; 3] {
    [
        LAYOUT.trim_end_matches(['}', '\n', ']']).to_string(),
        LAYOUT.replacen("0]}]", "0]}, {\"na]", 1),
        LAYOUT.replacen("\"robots\"", "\"robot", 1),
    ]
}

#[test]
fn automata_are_right_while_the_layout_cannot_be_read() {
    let mut line = line("unread-right", LAYOUT);
    let (layout, face, keeper) = (line.layout.clone(), line.face.clone(), line.keeper.clone());
    assert_eq!(line.client.diagnostics(&keeper), Vec::<Value>::new());
    for text in broken() {
        line.client.change(&layout, &text);
        // Each has a new version, so that the answer is of now.
        line.client.change(&face, FACE);
        line.client.change(&keeper, KEEPER);
        assert_eq!(line.client.diagnostics(&face), Vec::<Value>::new(), "{text}");
        assert_eq!(line.client.diagnostics(&keeper), Vec::<Value>::new(), "{text}");
        let found = line.client.diagnostics(&layout);
        assert!(found.iter().any(|one| one["severity"] == 1), "{text}: {found:?}");
    }
    // Its own errors are shown, and its kinds known.
    let wrong = KEEPER.replacen("n += 1", "n += m", 1);
    line.client.change(&keeper, &wrong);
    let found = line.client.diagnostics(&keeper);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0]["range"]["start"], place(&wrong, "m;", 0));
    line.client.change(&keeper, KEEPER);
    let at = |word| json!({"textDocument": {"uri": uri(&keeper)}, "position": place(KEEPER, word, 0)});
    let hover = line.client.result("textDocument/hover", at("cup"));
    assert!(hover["contents"]["value"].as_str().is_some_and(|text| text.contains("Kind.cup")), "{hover}");
    let found = line.client.result("textDocument/completion", at("cup"));
    assert!(
        found.as_array().is_some_and(|found| found.iter().any(|item| item["label"] == "plate")),
        "{found}"
    );
}

#[test]
fn a_layout_that_is_opened_unreadable_has_its_automata() {
    let [unclosed, typed, ..] = broken();
    for (name, text) in [("unread-unclosed", unclosed), ("unread-typed", typed)] {
        let mut line = line(name, &text);
        let keeper = line.keeper.clone();
        assert_eq!(line.client.diagnostics(&keeper), Vec::<Value>::new(), "{text}");
    }
}

#[test]
fn what_an_unreadable_layout_names_is_not_renamed() {
    let mut line = line("unread-renamed", LAYOUT);
    let (face, keeper) = (line.face.clone(), line.keeper.clone());
    for text in broken() {
        line.client.change(&line.layout.clone(), &text);
        let found = line.refused(&keeper, "Keeper");
        assert!(found.contains("line.json") && found.contains("`keeper`"), "{text}: {found}");
        // Names that are only in automata change in all of them.
        let answer = line.rename(&face, "Face", "Visage");
        let changes = &answer["result"]["changes"];
        assert_eq!(changes[uri(&face)].as_array().map(Vec::len), Some(1), "{text}: {answer}");
        assert_eq!(changes[uri(&keeper)].as_array().map(Vec::len), Some(1), "{text}: {answer}");
    }
}
