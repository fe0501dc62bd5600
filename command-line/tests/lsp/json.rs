//! Completion and hover in layouts and scenarios.

use super::client::{Client, uri};
use super::{new_line, read};
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};

const LAYOUT: &str = r#"{
  "specs": "specs",
  "robots": [
    {"name": "station", "type": "stamping_station", "pose": [0, 0, 0], "parameters": {"hold_time": 0.5}},
    {"name": "belt", "type": "conveyor", "pose": [-0.573076, 0, 0], "orient": "y", "orient_range": [-5, 5]},
    {"name": "arm", "type": "kitting", "pose": [-1.3, 0, 1.127], "rail_dim": "y", "rail_range": [-4.8, 4.8]},
    |
  ],
  "stationary": [
    {"name": "as1", "type": "station", "pose": [-7.3, 3, 0]}
  ]
}
"#;

struct Open {
    client: Client,
    file: PathBuf,
}

fn open(name: &str, file: &str) -> Open {
    let folder = new_line(name);
    let mut client = Client::in_folder(&folder);
    let file = folder.join(file);
    let text = if file.exists() { read(&file) } else { "{}".into() };
    client.open(&file, &text);
    Open { client, file }
}

fn at(path: &Path, text: &str, offset: usize) -> Value {
    let line = text[..offset].matches('\n').count();
    let column = text[..offset].rsplit('\n').next().expect("a line").encode_utf16().count();
    json!({"textDocument": {"uri": uri(path)}, "position": {"line": line, "character": column}})
}

impl Open {
    /// What is offered at the mark `^` of a text.
    fn offered(&mut self, text: &str) -> Vec<Value> {
        let offset = text.find('^').expect("a mark");
        let text = text.replacen('^', "", 1);
        self.client.change(&self.file, &text);
        let found = self.client.result("textDocument/completion", at(&self.file, &text, offset));
        found.as_array().expect("a list").clone()
    }

    fn labels(&mut self, text: &str) -> Vec<String> {
        let offered = self.offered(text);
        offered.iter().map(|item| item["label"].as_str().expect("a label").to_string()).collect()
    }

    /// With a robot more in the layout.
    fn with_robot(&mut self, robot: &str) -> Vec<String> {
        self.labels(&LAYOUT.replacen('|', robot, 1))
    }

    fn hover(&mut self, text: &str) -> Value {
        let offset = text.find('^').expect("a mark");
        let text = text.replacen('^', "", 1);
        self.client.change(&self.file, &text);
        self.client.result("textDocument/hover", at(&self.file, &text, offset))["contents"]["value"].clone()
    }
}

#[test]
fn keys_of_a_layout_are_those_that_are_not_there_yet() {
    let mut open = open("layout-keys", "line.json");
    let found = open.labels(&LAYOUT.replacen('|', "", 1).replacen('{', "{\n  ^", 1));
    assert_eq!(found, ["$schema", "may_touch", "name", "panel", "routes", "scan_ms", "scenario"]);
    assert_eq!(
        open.with_robot("{\"^"),
        ["at", "hands_to", "name", "parameters", "pose", "takes_from", "type"]
    );
    // Of a type that is known its own keys too, wherever the type stands.
    let found = open.with_robot("{\"ori^\", \"name\": \"b\", \"type\": \"conveyor\"}");
    assert_eq!(found, ["at", "hands_to", "orient", "orient_range", "parameters", "pose", "takes_from"]);
}

#[test]
fn types_and_their_parameters_are_offered() {
    let mut open = open("layout-types", "line.json");
    let found = open.with_robot("{\"name\": \"b\", \"type\": \"^\"}");
    assert_eq!(found, ["agv", "conveyor", "gantry", "kitting", "stamping_station", "station"]);
    assert_eq!(open.with_robot("{\"name\": \"b\", \"type\": ^"), found);
    let found = open.with_robot("{\"type\": \"stamping_station\", \"parameters\": {^}}");
    assert_eq!(found, ["hold_time"]);
    assert_eq!(open.with_robot("{\"type\": \"kitting\", \"rail_dim\": \"^"), ["x", "y"]);
}

#[test]
fn types_are_known_while_their_files_have_errors() {
    let mut open = open("layout-wrong", "line.json");
    let automata = open.file.with_file_name("specs").join("stamp.aut");
    open.client.open(&automata, &read(&automata).replacen("hold_time", "hold_tim", 1));
    let found = open.with_robot("{\"name\": \"b\", \"type\": \"^\"}");
    assert!(found.contains(&"stamping_station".to_string()), "{found:?}");
    assert!(found.contains(&"agv".to_string()), "{found:?}");
}

#[test]
fn names_of_machines_are_offered() {
    let mut open = open("layout-names", "line.json");
    let found =
        open.with_robot("{\"name\": \"arm2\", \"type\": \"kitting\", \"takes_from\": [\"belt\", \"^\"]}");
    assert_eq!(found, ["arm", "as1", "belt", "station"]);
    let text = LAYOUT.replacen('|', "", 1).replacen('{', "{\"may_touch\": [{\"pair\": [\"arm\", ^]}],", 1);
    assert_eq!(open.labels(&text), ["arm", "as1", "belt", "station"]);
}

#[test]
fn a_word_replaces_what_is_typed_with_its_quotes() {
    let mut open = open("layout-edits", "line.json");
    let text = "{\"robots\": [{\"po^\n\"name\": \"a\"}]}";
    let pose = open.offered(text).into_iter().find(|item| item["label"] == "pose").expect("it is offered");
    assert_eq!(pose["textEdit"]["newText"], "\"pose\": ");
    assert_eq!(pose["textEdit"]["range"]["start"], json!({"line": 0, "character": 13}));
    assert_eq!(pose["textEdit"]["range"]["end"], json!({"line": 0, "character": 16}));
    assert_eq!(pose["filterText"], "\"pose\"");
    let text = "{\"robots\": [{\"ty^\n\"name\": \"a\"}]}";
    let found = open.offered(text);
    assert_eq!(found.iter().find(|item| item["label"] == "type").expect("it is offered")["detail"], "needed");
    let text = "{\"robots\": [{\"p^\": [0, 0, 0]}]}";
    let pose = open.offered(text).into_iter().find(|item| item["label"] == "pose").expect("it is offered");
    assert_eq!(pose["textEdit"]["newText"], "\"pose\"");
}

#[test]
fn scenarios_know_the_machines_of_their_layout() {
    let mut open = open("scenario-names", "scenario.json");
    let layout = open.file.with_file_name("line.json");
    open.client.open(&layout, &LAYOUT.replacen(",\n    |", "", 1));
    assert_eq!(
        open.labels("{\"kinds\": [], \"or^\"}"),
        ["$schema", "faults", "goal", "operator", "orders", "supply", "time_limit_s"]
    );
    let kinds = "{\"kinds\": [{\"name\": \"bolt\", \"height\": 1}, {\"name\": \"nut\", \"height\": 1}]";
    let mut labels = |rest: &str| open.labels(&format!("{kinds}, {rest}"));
    assert_eq!(labels("\"orders\": {\"stations\": ^"), ["in turn"]);
    assert_eq!(labels("\"orders\": {\"stations\": [\"^"), ["as1"]);
    assert_eq!(labels("\"orders\": [{\"station\": \"^\", \"parts\": {}}]}"), ["as1"]);
    assert_eq!(labels("\"orders\": {\"parts\": {\"bolt\": 1, ^"), ["nut"]);
    assert_eq!(labels("\"supply\": {\"items\": [\"^"), ["bolt", "nut"]);
    assert_eq!(labels("\"supply\": {\"items\": {\"^"), ["belt", "station"]);
    assert_eq!(labels("\"faults\": {\"slips\": [{\"robot\": \"^"), ["arm"]);
    assert_eq!(labels("\"faults\": {\"answers\": [{\"robot\": \"^"), ["arm", "belt"]);
    assert_eq!(labels("\"faults\": {\"jams\": [{\"robot\": \"^"), ["arm", "belt", "station"]);
    assert_eq!(labels("\"faults\": {\"jams\": [{\"robot\": \"arm\", \"part\": \"^"), ["joints"]);
    assert_eq!(labels("\"faults\": {\"slow\": [{\"robot\": \"^"), [] as [&str; 0]);
    assert!(labels("\"faults\": {\"sensors\": [{\"robot\": \"^").contains(&"belt".into()));
    let signals = labels("\"faults\": {\"sensors\": [{\"robot\": \"belt\", \"signal\": \"^");
    assert!(signals.contains(&"ready".into()) && !signals.contains(&"verb".into()), "{signals:?}");
    // A scenario has either of two, never both.
    let found = labels("\"supply\": {\"surplus\": [1, 3], ^");
    assert_eq!(found, ["every_s", "first_s", "seed", "times"]);
}

#[test]
fn buttons_and_sinks_are_offered() {
    let mut open = open("scenario-parts", "scenario.json");
    let folder = open.file.with_file_name("specs");
    let text = r#"device desk {
    part go = button {};
    part way = lane { from: origin * frame(0, 0, 0.7, 0); length: 1; width: 0.4; speed: 0.3; };
    part out = sink { of: way; inset: 0; };
    /// it is pressed
    in pressed: bool = go.on;
}
automaton Desk on desk { initial state S { when pressed -> S {} } }"#;
    open.client.open(&folder.join("desk.aut"), text);
    let layout = open.file.with_file_name("line.json");
    let robot = ", {\"name\": \"d1\", \"type\": \"desk\", \"pose\": [9, 0, 0]}";
    open.client.open(&layout, &LAYOUT.replacen(",\n    |", robot, 1));
    let robots = open.labels("{\"operator\": [{\"robot\": \"^");
    assert!(robots.contains(&"d1".to_string()) && !robots.contains(&"arm".to_string()), "{robots:?}");
    assert_eq!(open.labels("{\"operator\": [{\"robot\": \"d1\", \"part\": \"^"), ["go"]);
    assert_eq!(open.labels("{\"operator\": [{\"part\": \"^"), ["reset", "start"]);
    assert_eq!(open.labels("{\"goal\": {\"^"), ["belt.end", "d1.out", "station.store"]);
}

#[test]
fn hover_shows_what_a_key_means() {
    let mut open = open("layout-hover", "line.json");
    let text = LAYOUT.replacen('|', "{}", 1);
    let found = open.hover(&text.replacen("\"po", "\"p^o", 1));
    assert_eq!(found, "Its position\\: x\\, y\\, z in m\\, and degrees if it is turned");
    let found = open.hover(&text.replacen("kitting", "kitt^ing", 1));
    assert!(found.as_str().is_some_and(|text| text.contains("automaton Kitting on rail_arm")), "{found}");
    assert_eq!(open.hover("{\"robots\": [{\"name\": \"a\", \"ex^tra\": 1}]}"), Value::Null);
}

#[test]
fn what_a_panel_adds_is_offered() {
    let mut open = open("scenario-panel", "scenario.json");
    let layout = open.file.with_file_name("line.json");
    let text = LAYOUT.replacen(",\n    |", "", 1);
    open.client.open(&layout, &text);
    let operated = "{\"operator\": [{\"robot\": \"belt\", \"part\": \"^";
    assert_eq!(open.labels(operated), [] as [&str; 0]);
    open.client.change(&layout, &text.replacen('{', "{\"panel\": \"machines\",", 1));
    let found = open.labels(operated);
    for part in ["panel_enable", "panel_mode", "panel_step", "panel_jog"] {
        assert!(found.contains(&part.to_string()), "{part} in {found:?}");
    }
    assert!(open.labels("{\"operator\": [{\"robot\": \"^").contains(&"belt".into()));
    assert!(open.labels("{\"operator\": [{\"robot\": \"arm\", \"part\": \"^").contains(&"panel_verb".into()));
}

#[test]
fn items_that_can_be_removed_are_offered() {
    let mut open = open("scenario-removed", "scenario.json");
    let kinds = "{\"kinds\": [{\"name\": \"bolt\", \"height\": 1}, {\"name\": \"nut\", \"height\": 1}]";
    let mut labels = |supply: &str| {
        open.labels(&format!("{kinds}, \"supply\": {supply}, \"operator\": [{{\"at_s\": 1, \"remove\": \"^"))
    };
    assert_eq!(labels("{\"items\": [\"nut\", \"bolt\", \"nut\"]}"), ["bolt_1", "nut_1", "nut_2"]);
    let found = labels("{\"items\": {\"belt\": [\"nut\"], \"station\": [\"nut\"]}, \"times\": 2}");
    assert_eq!(found, ["nut_1", "nut_2", "nut_3", "nut_4"]);
    assert_eq!(labels("{\"seed\": 1}"), ["bolt_1", "nut_1"]);
}

#[test]
fn a_file_in_which_a_layout_is_begun_gets_help() {
    let mut open = open("layout-begun", "new.json");
    for text in [
        "{\n  ^\n}",
        "{\n  \"^\n}",
        "{ \"^",
        "{\"specs\": \"specs\",\n  \"ro^\n}",
        "{\"name\": \"a\", \"^\"}",
    ] {
        let found = open.labels(text);
        assert!(found.contains(&"robots".to_string()), "{text}: {found:?}");
    }
    // Of another program.
    assert_eq!(open.labels("{\"name\": \"a\", \"version\": \"1\", \"^\"}"), [] as [&str; 0]);
    let text = "{\"name\": \"a\", \"version\": \"1\"}";
    open.client.change(&open.file, text);
    assert_eq!(open.client.diagnostics(&open.file), Vec::<Value>::new());
}

#[test]
fn a_file_that_was_a_layout_is_one_still() {
    let mut open = open("layout-still", "line.json");
    let text = LAYOUT.replacen(",\n    |", "", 1);
    let layout = open.file.clone();
    for changed in ["\"robot\"", "\"\"", "\"robot"] {
        open.client
            .change(&layout, &text.replacen("\"robots\"", changed, 1).replacen("stationary", "other", 1));
        assert!(!open.client.diagnostics(&layout).is_empty(), "{changed}");
    }
    let typed = text.replacen("\"robots\"", "\"rob^\"", 1);
    assert!(open.labels(&typed).contains(&"robots".to_string()));
    // With the key `specs` alone a text is one.
    open.client.notify("textDocument/didClose", json!({"textDocument": {"uri": uri(&layout)}}));
    open.client.open(&layout, "{\"specs\": \"specs\"}");
    assert!(!open.client.diagnostics(&layout).is_empty());
}

/// Conveyors of which one begins where the other one ends.
const LANES: &str = r#"device bed {
    parameter length: real := 1.0;
    part chute = lane { from: origin * frame(0, 0, 0.7, 0); length: length; width: 0.4; speed: 0.3; };
    part eye = beam { across: chute; at: length - 0.15; };
    /// an item is at the end
    in at_end: bool = eye.sees;
}
automaton Bed on bed { initial state S { when at_end -> S {} } }"#;
const BEDS: &str = r#"{"specs": "beds", "robots": [
  {"name": "b1", "type": "bed", "pose": [0, 0, 0]},
  {"name": "b2", "type": "bed", "at": "b1.chute"},
  {"name": "b3", "type": "bed", "at": ["chute", "b2.chute"]}
]}"#;

#[test]
fn lanes_are_known_in_layouts() {
    let mut open = open("layout-lanes", "line.json");
    let file = open.file.with_file_name("beds").join("bed.aut");
    fs::create_dir(file.parent().expect("a folder")).expect("a new folder");
    fs::write(&file, LANES).expect("a new file");
    let layout = open.file.clone();
    open.client.open(&file, LANES);
    open.client.change(&layout, BEDS);
    let mut params = at(&file, LANES, LANES.find("chute").expect("it is there"));
    params["newName"] = "slide".into();
    let changes = open.client.result("textDocument/rename", params)["changes"].clone();
    assert_eq!(changes[uri(&file)].as_array().map(Vec::len), Some(2), "{changes}");
    let places: Vec<Value> = [("chute\"}", 0), ("chute\",", 0), ("chute\"]", 0)]
        .map(|(word, n)| super::client::place(BEDS, word, n))
        .into();
    let edits = changes[uri(&layout)].as_array().expect("edits").clone();
    let starts: Vec<Value> = edits.iter().map(|edit| edit["range"]["start"].clone()).collect();
    assert_eq!(starts, places);
    assert!(edits.iter().all(|edit| edit["newText"] == "slide"), "{edits:?}");
    // From the layout to the device.
    let asked = at(&layout, BEDS, BEDS.find("chute").expect("it is there"));
    let found = open.client.result("textDocument/definition", asked.clone());
    assert_eq!(found["range"]["start"], super::client::place(LANES, "chute", 0));
    let hover = open.client.result("textDocument/hover", asked)["contents"]["value"].clone();
    assert!(hover.as_str().is_some_and(|text| text.contains("part chute = lane")), "{hover}");
    assert_eq!(open.labels(&BEDS.replacen("b1.chute", "^", 1)), ["b1.chute", "b3.chute"]);
    assert_eq!(open.labels(&BEDS.replacen("[\"chute\"", "[\"^\"", 1)), ["chute"]);
    assert_eq!(open.labels(&BEDS.replacen("b2.chute", "^", 1)), ["b1.chute", "b2.chute"]);
}

#[test]
fn nodes_and_routes_are_offered() {
    let mut open = open("layout-nodes", "line.json");
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/scenes");
    for name in ["branches.aut", "branches.scenario.json"] {
        fs::copy(examples.join(name), open.file.with_file_name(name)).expect("a copy");
    }
    let text = read(&examples.join("branches.json"));
    let nodes = open.labels(&text.replacen("{\"from\": \"queue\"", "{\"from\": \"^\"", 1));
    assert!(nodes.contains(&"fork".to_string()) && nodes.len() == 12, "{nodes:?}");
    assert_eq!(open.labels(&text.replacen("\"to\": \"dock\"", "\"to\": \"^\"", 1)), nodes);
    assert_eq!(open.labels(&text.replacen("\"home\": \"queue\"", "\"home\": \"^\"", 1)), nodes);
    assert_eq!(open.labels(&text.replacen("\"hall\": \"floor\"", "\"hall\": \"^\"", 1)), ["floor"]);
}
