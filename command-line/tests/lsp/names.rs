//! Definitions, references, hover, renaming and completion.

use super::client::{Client, place, uri};
use super::{new_line, read};
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};

const DESKS: &str = r#"// Ein Büro \u{1f916}.
enum Phase { Idle, Busy }

/// A place with `code` and <b>markup</b>.
interface Desk {
    parameter size: int 1..8;
    shared phase: Phase := Idle by owner;
    shared ask: bool := false by handshake;
}

automaton Table on stamping_station is Desk {
    parameter size: int 1..8 := 4;
    initial -> Working {}
    state Working {
        when ask and phase = Idle { ask := false; phase := Busy; run := at_stamp; }
        when not ask -> Resting { phase := Phase.Idle; }
    }
    state Resting {
        when size > 3 -> Working;
    }
}

automaton Clerk on vehicle {
    knows desks: Desk[];
    local n: int 0..7 := 0;
    define some_idle = exists d in desks: d.phase = Idle;

    initial -> Waiting { goto(stops[0]); }
    state Waiting {
        when n < 3 and some_idle, /* */ first d in desks with d.phase = Idle -> Going { d.ask := true; n += 1; move(stops[1]); }
    }
    state Going = sequence {
        until n > 0 at most 2 s;
        move(stops[2]);
    } -> Waiting { n := 0; } else Waiting {}
}
"#;

/// The text with a robot before a name on its line, which is two units of UTF-16.
fn desks() -> String {
    DESKS.replace("\\u{1f916}", "\u{1f916}").replace("/* */ first", "\n            first")
}

struct Line {
    client: Client,
    folder: PathBuf,
    file: PathBuf,
    text: String,
}

/// The new line with a file more, which is open and not saved.
fn line(name: &str) -> Line {
    let folder = new_line(name);
    let file = folder.join("specs/desks.aut");
    let mut client = Client::in_folder(&folder);
    let text = desks();
    client.open(&file, &text);
    let found = client.diagnostics(&file);
    assert!(found.iter().all(|diagnostic| diagnostic["severity"] == 2), "{found:?}");
    Line { client, folder, file, text }
}

fn at(path: &Path, place: &Value) -> Value {
    json!({"textDocument": {"uri": uri(path)}, "position": place})
}

impl Line {
    fn ask(&mut self, method: &str, word: &str, n: usize) -> Value {
        let place = place(&self.text, word, n);
        self.client.result(method, at(&self.file, &place))
    }

    fn defined(&mut self, word: &str, n: usize) -> Value {
        self.ask("textDocument/definition", word, n)["range"]["start"].clone()
    }

    fn hover(&mut self, word: &str, n: usize) -> String {
        self.ask("textDocument/hover", word, n)["contents"]["value"].as_str().unwrap_or("none").into()
    }

    fn references(&mut self, word: &str, n: usize) -> Vec<Value> {
        let mut params = at(&self.file, &place(&self.text, word, n));
        params["context"] = json!({"includeDeclaration": true});
        let found = self.client.result("textDocument/references", params);
        found.as_array().expect("a list").iter().map(|found| found["range"]["start"].clone()).collect()
    }

    fn rename(&mut self, word: &str, n: usize, new: &str) -> Value {
        let mut params = at(&self.file, &place(&self.text, word, n));
        params["newName"] = new.into();
        self.client.request("textDocument/rename", params)
    }

    fn refused(&mut self, word: &str, n: usize, new: &str) -> String {
        let answer = self.rename(word, n, new);
        assert_eq!(answer["error"]["code"], -32803, "{answer}");
        answer["error"]["message"].as_str().expect("a text").into()
    }

    /// The text of the open file with a word at a mark, completed there.
    fn completed(&mut self, before: &str) -> Vec<String> {
        let end = self.text.find('|').expect("a mark") + before.len();
        let text = self.text.replacen('|', before, 1);
        self.client.change(&self.file, &text);
        let line = text[..end].matches('\n').count();
        let column = text[..end].rsplit('\n').next().expect("a line").encode_utf16().count();
        let params = at(&self.file, &json!({"line": line, "character": column}));
        let found = self.client.result("textDocument/completion", params);
        let labels = found.as_array().expect("a list").iter();
        labels.map(|item| item["label"].as_str().expect("a label").to_string()).collect()
    }
}

#[test]
fn definitions_are_found() {
    let mut line = line("definitions");
    let text = line.text.clone();
    // What is asked, and which of the places of the word is its declaration.
    for (word, asked, declared) in [
        ("Desk", 1, 0),
        ("Desk", 2, 0),
        ("Phase", 1, 0),
        ("Phase", 2, 0),
        ("Idle", 1, 0),
        ("Idle", 3, 0),
        ("Busy", 1, 0),
        ("size", 2, 1),
        ("phase", 1, 0),
        ("ask", 1, 0),
        ("some_idle", 1, 0),
        ("desks", 2, 0),
        ("Waiting", 0, 1),
        ("Going", 0, 1),
        ("Resting", 0, 1),
    ] {
        let mut asked = place(&text, word, asked);
        let declared = place(&text, word, declared);
        let found = line.client.result("textDocument/definition", at(&line.file, &asked));
        assert_eq!(found["range"]["start"], declared, "{word}");
        assert_eq!(found["uri"], uri(&line.file).as_str());
        // The place behind the last letter is of the name too.
        asked["character"] = (asked["character"].as_u64().expect("a number") + word.len() as u64).into();
        let behind = line.client.result("textDocument/definition", at(&line.file, &asked));
        assert_eq!(behind, found, "{word}");
    }
    // A variable of a binder and one of a quantifier have one name.
    assert_eq!(line.defined("d.ask", 0), place(&text, "d in desks", 1));
    assert_eq!(line.defined("d.phase", 0), place(&text, "d in desks", 0));
    // A device of another file of the folder, and its port.
    let stamp = line.folder.join("specs/stamp.aut");
    let found = line.ask("textDocument/definition", "stamping_station", 0);
    assert_eq!(found["uri"], uri(&stamp).as_str());
    assert_eq!(found["range"]["start"], place(&read(&stamp), "stamping_station", 0));
    let found = line.ask("textDocument/definition", "at_stamp", 0);
    assert_eq!(found["range"]["start"], place(&read(&stamp), "at_stamp:", 0));
    // The library is no file here; words of the language are declared nowhere.
    for word in ["stops", "vehicle", "goto", "exists", "// Ein"] {
        assert_eq!(line.ask("textDocument/definition", word, 0), Value::Null, "{word}");
    }
}

#[test]
fn references_are_found_in_layouts_too() {
    let mut line = line("references");
    let text = line.text.clone();
    let all = [
        place(&text, "n: int", 0),
        place(&text, "n < 3", 0),
        place(&text, "n += 1", 0),
        place(&text, "n > 0", 0),
        place(&text, "n := 0;", 0),
    ];
    for word in ["n: int", "n < 3", "n := 0;"] {
        assert_eq!(line.references(word, 0), all, "{word}");
    }
    assert_eq!(line.references("exists", 0), Vec::<Value>::new());
    let stamp = line.folder.join("specs/stamp.aut");
    let layout = line.folder.join("line.json");
    line.client.open(&stamp, &read(&stamp));
    let params = json!({
        "textDocument": {"uri": uri(&stamp)}, "position": place(&read(&stamp), "hold_time", 0),
        "context": {"includeDeclaration": false},
    });
    let found = line.client.result("textDocument/references", params);
    let places: Vec<_> = found
        .as_array()
        .expect("a list")
        .iter()
        .map(|f| (f["uri"].clone(), f["range"]["start"].clone()))
        .collect();
    let expected = [
        (uri(&layout).into(), place(&read(&layout), "hold_time", 0)),
        (uri(&stamp).into(), place(&read(&stamp), "hold_time", 1)),
    ];
    assert_eq!(places, expected);
    // From the layout to the type.
    line.client.open(&layout, &read(&layout));
    let asked = place(&read(&layout), "stamping_station", 0);
    let found = line.client.result("textDocument/definition", at(&layout, &asked));
    assert_eq!(found["range"]["start"], place(&read(&stamp), "StampingStation", 0));
}

#[test]
fn hover_shows_types_bounds_and_descriptions() {
    let mut line = line("hover");
    assert_eq!(line.hover("n: int", 0), "```autogen\nlocal n: int 0..7 := 0\n```\n\nof `Clerk`");
    // Behind the comparison of the guard it is known to be less.
    assert_eq!(line.hover("n += 1", 0), "```autogen\nlocal n: int 0..7 := 0\n```\n\nhere 0..2\n\nof `Clerk`");
    assert_eq!(
        line.hover("Desk {", 0),
        "```autogen\ninterface Desk\n```\n\nA place with `code` and \\<b\\>markup\\<\\/b\\>\\."
    );
    assert_eq!(line.hover("some_idle", 1), "```autogen\ndefine some_idle: bool\n```\n\nof `Clerk`");
    assert_eq!(line.hover("d.ask", 0), "```autogen\nd: Desk\n```\n\nof `Clerk`");
    assert_eq!(
        line.hover("ask :=", 0),
        "```autogen\nshared ask: bool := false by handshake\n```\n\nof `Desk`"
    );
    assert_eq!(line.hover("Busy", 1), "```autogen\nPhase.Busy\n```");
    let stops = line.hover("stops", 0);
    assert!(stops.starts_with("```autogen\nconstant stops: point[3] unit \"m\"\n```\n\n"), "{stops}");
    assert!(line.hover("goto", 0).starts_with("```autogen\ncommand move(goal)\n```"));
    assert_eq!(line.ask("textDocument/hover", "exists", 0), Value::Null);
    // The range is that of the name.
    let found = line.ask("textDocument/hover", "some_idle,", 0);
    assert_eq!(found["range"]["start"], place(&desks(), "some_idle", 1));
}

#[test]
fn renaming_changes_all_places() {
    let mut line = line("renamed");
    let answer = line.rename("Going", 0, "Driving");
    let changes = &answer["result"]["changes"][uri(&line.file)];
    let new: Vec<_> = changes.as_array().expect("edits").iter().map(|edit| edit["newText"].clone()).collect();
    assert_eq!(new, ["Driving", "Driving"], "{answer}");
    // A parameter of an interface is called as what supplies it.
    let answer = line.rename("size", 2, "places");
    assert_eq!(answer["result"]["changes"][uri(&line.file)].as_array().map(Vec::len), Some(3), "{answer}");
    // In layouts a type is written in another way.
    let stamp = line.folder.join("specs/stamp.aut");
    line.client.open(&stamp, &read(&stamp));
    let mut params = at(&stamp, &place(&read(&stamp), "StampingStation", 0));
    params["newName"] = "BigPress".into();
    let changes = line.client.result("textDocument/rename", params.clone())["changes"].clone();
    let layout = uri(&line.folder.join("line.json"));
    assert_eq!(changes[&layout][0]["newText"], "big_press", "{changes}");
    assert_eq!(
        changes[&layout][0]["range"]["start"],
        place(&read(&line.folder.join("line.json")), "stamping_station", 0)
    );
    assert_eq!(changes[uri(&stamp)].as_array().map(Vec::len), Some(1), "the device keeps its name");
    let asked = line.client.result("textDocument/prepareRename", params);
    assert_eq!(asked["placeholder"], "StampingStation");
}

#[test]
fn renaming_is_refused_with_a_reason() {
    let mut line = line("refused");
    for (word, n, new, reason) in [
        ("n: int", 0, "count", "word of the language"),
        ("n: int", 0, "größe", "is not a name"),
        ("n: int", 0, "", "is not a name"),
        ("n: int", 0, "some_idle", "is already the name of something else"),
        ("n: int", 0, "stops", "is already the name of a constant of the device"),
        ("n: int", 0, "d", "already has another meaning here"),
        ("n: int", 0, "Idle", "this comparison does not take"),
        ("Going", 0, "Waiting", "two states"),
        ("phase", 0, "ask", "declared twice"),
        ("stops", 0, "places", "in the library"),
        ("goto", 0, "drive", "in the library"),
        ("vehicle", 0, "car", "in the library"),
        ("exists", 0, "some", "there is no name here"),
    ] {
        let found = line.refused(word, n, new);
        assert!(found.contains(reason), "{word} to {new}: {found}");
    }
    let answer =
        line.client.request("textDocument/prepareRename", at(&line.file, &place(&line.text, "stops", 0)));
    assert_eq!(answer["error"]["code"], -32803, "{answer}");
    // A text with errors: nobody knows all places.
    let wrong = line.text.replace("some_idle,", "some_idl,");
    line.client.change(&line.file, &wrong);
    let found = line.refused("n: int", 0, "m");
    assert!(found.contains("correct them first"), "{found}");
    assert_eq!(fs::metadata(&line.file).ok().map(|data| data.len()), None, "nothing is written");
}

#[test]
fn completion_knows_what_can_stand_there() {
    let mut line = line("completion");
    line.text = desks().replace("when n < 3", "|when n < 3");
    let lacks = |found: &[String], other: &[&str]| {
        for word in other {
            assert!(!found.iter().any(|f| f == word), "{word} in {found:?}");
        }
    };
    let found = line.completed("when ");
    has(&found, &["n", "some_idle", "stops", "at_stop", "Idle", "exists", "not"]);
    lacks(&found, &["Waiting", "automaton", "at_stamp"]);
    assert_eq!(line.completed("when first q in desks with q."), ["ask", "phase", "size"]);
    assert_eq!(line.completed("when Phase."), ["Busy", "Idle"]);
    assert_eq!(line.completed("when pos."), ["x", "y", "z"]);
    assert_eq!(line.completed("when done -> "), ["Going", "Waiting"]);
    assert_eq!(line.completed("when done -> Go"), ["Going", "Waiting"]);
    let found = line.completed("when done -> Going { ");
    has(&found, &["move", "n", "goal"]);
    lacks(&found, &["when", "state"]);
    has(&line.completed("when exists q in "), &["desks", "Phase", "Kind"]);
    assert_eq!(line.completed("wh"), ["when"]);
    assert_eq!(line.completed("// a comment "), Vec::<String>::new());
    line.text = desks().replace("    knows", "    |\n    knows");
    has(&line.completed("loc"), &["local", "state", "any state", "require"]);
    has(&line.completed("local x: "), &["int", "Phase", "Desk"]);
    has(&line.completed("local x: "), &["Clerk"]);
    has(&line.completed("serves others: "), &["Desk"]);
    line.text = desks() + "|";
    assert_eq!(line.completed("aut"), ["assembly", "automaton", "device", "enum", "interface"]);
    has(&line.completed("automaton Other on "), &["vehicle", "stamping_station"]);
    assert_eq!(line.completed("automaton Other on vehicle is Desk accepts at "), ["stops"]);
    has(&line.completed("interface Shelf { shared full: bool := "), &["true", "false", "Idle"]);
    has(&line.completed("interface Shelf { shared full: bool by owner; invariant "), &["full", "not"]);
    has(&line.completed("device press { part p = "), &["cylinder", "lane", "route"]);
    has(&line.completed("device press { part p = cylinder { "), &["extend", "retract"]);
    has(
        &line.completed("device press { part p = cylinder {}; in up: bool = p."),
        &["is_in", "is_out", "extend"],
    );
}

fn has(found: &[String], wanted: &[&str]) {
    for word in wanted {
        assert!(found.iter().any(|f| f == word), "{word} in {found:?}");
    }
}

/// The text behind the steps of the sequence of the clerk.
const OUTCOMES: &str = "-> Waiting { n := 0; } else Waiting {}";

#[test]
fn behind_a_sequence_states_and_updates_are_offered() {
    let mut line = line("completion-sequence");
    let states = ["Going", "Waiting"];
    for outcomes in [
        "-> | { n := 0; } else Waiting {}",
        "-> | else Waiting {}",
        "-> |;",
        "-> |",
        "-> Waiting { n := 0; } else | {}",
        "-> Waiting {} else |",
        "-> Waiting; else |",
    ] {
        line.text = desks().replace(OUTCOMES, outcomes);
        assert_eq!(line.completed(""), states, "{outcomes}");
        assert_eq!(line.completed("W"), states, "{outcomes}");
    }
    for outcomes in [
        "-> Waiting { | } else Waiting {}",
        "-> Waiting { n := 0; | }",
        "-> Waiting { n := 0; } else Waiting { | }",
        "-> Waiting; else Waiting { | }",
    ] {
        line.text = desks().replace(OUTCOMES, outcomes);
        let found = line.completed("");
        has(&found, &["n", "move", "goal"]);
        assert!(!found.iter().any(|word| ["when", "until", "state"].contains(&word.as_str())), "{found:?}");
    }
    line.text = desks().replace(OUTCOMES, "-> Waiting {} |");
    has(&line.completed(""), &["else", "state"]);
    line.text = desks().replace(OUTCOMES, "-> Waiting {} else Waiting {} |");
    let found = line.completed("");
    has(&found, &["state"]);
    assert!(!found.contains(&"else".into()), "{found:?}");
    line.text = desks().replace(OUTCOMES, &format!("{OUTCOMES}\n    state Last {{ | }}"));
    assert_eq!(line.completed(""), ["when"]);
    line.text = desks().replace(OUTCOMES, "-> Waiting {}\n    state Last { | }");
    assert_eq!(line.completed(""), ["when"]);
}

#[test]
fn words_behind_words_of_the_language_are_offered() {
    let mut line = line("completion-phrases");
    line.text = desks().replace("    knows", "    |\n    knows");
    for (before, words) in [
        ("any ", &["state"][..]),
        ("any state ", &["except"]),
        ("resume ", &["state"]),
        ("takes ", &["from"]),
        ("hands ", &["to"]),
        ("shared x: int 0..9 := 0 by ", &["counter", "handshake", "lock", "owner", "token"]),
        ("shared x: bool := false by handshake ", &[]),
        ("invariant n < 5 else ", &["stop", "warn"]),
        ("invariant n < 5 else stop ", &["line", "machine"]),
        ("shared x: bool := false ", &["by"]),
        ("any state except Waiting, ", &["Going", "Waiting"]),
    ] {
        assert_eq!(line.completed(before), words, "{before}");
    }
    line.text = desks() + "|";
    assert_eq!(
        line.completed("interface A { shared b: bool by own"),
        line.completed("interface A { shared b: bool by ")
    );
    assert_eq!(line.completed("automaton Other on vehicle is Desk offers "), ["at"]);
    assert_eq!(line.completed("automaton Other on vehicle is Desk accepts "), ["at"]);
    assert_eq!(line.completed("device press { out up: bool = p.extend stop "), ["false", "true"]);
    assert_eq!(line.completed("device press { out up: real = p.extend stop "), [] as [&str; 0]);
}
