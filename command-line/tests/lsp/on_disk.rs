//! Files that change, move or are shared while a session goes on.

use super::client::{Client, place, uri};
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};

fn folder(name: &str) -> PathBuf {
    let above = Path::new(env!("CARGO_TARGET_TMPDIR")).join("lsp");
    fs::create_dir_all(&above).expect("a folder that can be made");
    let folder = above.canonicalize().expect("the folder").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder that can be made");
    folder
}

fn put(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(name);
    fs::write(&path, text).expect("a file that can be written");
    path
}

const DEVICE: &str = "device mill { part pedal = button {}; in closed: bool = pedal.on; }\n";
const AUTOMATON: &str = "automaton Mill on mill {
    parameter speed: int 1..9 := 2;
    local n: int 0..9;
    initial state Idle { when closed and n < 9 -> Idle { n := speed; } }
}
";

fn layout(specs: &str) -> String {
    format!(
        r#"{{"specs": {specs}, "robots": [{{"name": "m", "type": "mill", "pose": [0, 0, 0], "parameters": {{"speed": 3}}}}]}}"#
    )
}

fn rename(client: &mut Client, file: &Path, text: &str, word: &str, new: &str) -> Value {
    let mut params = json!({"textDocument": {"uri": uri(file)}, "position": place(text, word, 0)});
    params["newName"] = new.into();
    client.request("textDocument/rename", params)
}

/// Where the edits of a file begin.
fn begins(answer: &Value, file: &Path) -> Vec<Value> {
    let edits = answer["result"]["changes"][uri(file)].as_array().cloned().unwrap_or_default();
    edits.iter().map(|edit| edit["range"]["start"].clone()).collect()
}

#[test]
fn a_file_that_has_changed_on_the_disk_is_renamed_as_it_is_now() {
    let folder = folder("changed_on_disk");
    let text = format!("{DEVICE}{AUTOMATON}");
    let file = put(&folder, "m.aut", &text);
    let line = put(&folder, "line.json", &layout("\"m.aut\""));
    let mut client = Client::in_folder(&folder);
    client.open(&file, &text);
    let hover = json!({"textDocument": {"uri": uri(&file)}, "position": place(&text, "speed", 0)});
    client.result("textDocument/hover", hover);
    let changed = format!("\n\n{}", layout("\"m.aut\""));
    put(&folder, "line.json", &changed);
    let answer = rename(&mut client, &file, &text, "speed", "feed");
    assert_eq!(begins(&answer, &line), [place(&changed, "speed", 0)], "{answer}");
}

/// Two lines have the same automaton on a device of their own.
#[test]
fn all_lines_that_have_a_file_that_is_changed_are_changed() {
    let folder = folder("shared_by_lines");
    let [of_a, of_b] = ["a", "b"].map(|name| put(&folder, &format!("mill_{name}.aut"), DEVICE));
    let shared = put(&folder, "auto.aut", AUTOMATON);
    for name in ["a", "b"] {
        put(&folder, &format!("{name}.json"), &layout(&format!(r#"["mill_{name}.aut", "auto.aut"]"#)));
    }
    let mut client = Client::in_folder(&folder);
    client.open(&of_a, DEVICE);
    let answer = rename(&mut client, &of_a, DEVICE, "closed", "is_shut");
    for (file, text) in [(&of_a, DEVICE), (&of_b, DEVICE), (&shared, AUTOMATON)] {
        assert_eq!(begins(&answer, file), [place(text, "closed", 0)], "{}: {answer}", file.display());
    }
    let answer = rename(&mut client, &of_a, DEVICE, "closed", "closed");
    assert_eq!(answer["result"]["changes"], json!({}), "{answer}");
    // What the other line does not allow is not done.
    let other = DEVICE.replace("in closed", "in is_shut: bool = pedal.on; in closed");
    put(&folder, "mill_b.aut", &other);
    let answer = rename(&mut client, &of_a, DEVICE, "closed", "is_shut");
    assert_eq!(answer["error"]["code"], -32803, "{answer}");
    put(&folder, "b.json", &layout(r#"["mill_b.aut", "auto.aut", "gone.aut"]"#));
    let answer = rename(&mut client, &of_a, DEVICE, "closed", "is_shut");
    let why = answer["error"]["message"].as_str().unwrap_or_default();
    assert!(why.contains("b.json cannot be read with all that it names"), "{answer}");
}

#[test]
fn with_more_lines_than_are_looked_at_nothing_is_renamed() {
    let folder = folder("many_lines");
    let text = format!("{DEVICE}{AUTOMATON}");
    let file = put(&folder, "m.aut", &text);
    (0..16).for_each(|n| drop(put(&folder, &format!("line{n:02}.json"), &layout("\"m.aut\""))));
    let mut client = Client::in_folder(&folder);
    client.open(&file, &text);
    let answer = rename(&mut client, &file, &text, "speed", "feed");
    assert_eq!(answer["result"]["changes"].as_object().map(serde_json::Map::len), Some(17), "{answer}");
    put(&folder, "line16.json", &layout("\"m.aut\""));
    let answer = rename(&mut client, &file, &text, "speed", "feed");
    let why = answer["error"]["message"].as_str().unwrap_or_default();
    assert!(why.contains("m.aut belongs to more than 16 layouts"), "{answer}");
}

#[test]
fn a_file_whose_folder_has_gone_can_be_closed() {
    let above = folder("folder_that_goes");
    let sub = above.join("sub");
    fs::create_dir(&sub).expect("a folder");
    let wrong = "automaton Mill on nothing {}";
    let file = put(&sub, "m.aut", wrong);
    let mut client = Client::in_folder(&above);
    client.open(&file, wrong);
    assert!(!client.diagnostics(&file).is_empty());
    fs::rename(&sub, above.join("other")).expect("a folder that can be renamed");
    client.notify("textDocument/didClose", json!({"textDocument": {"uri": uri(&file)}}));
    while client.told[&uri(&file)]["diagnostics"] != json!([]) {
        client.message();
    }
}

#[cfg(unix)]
#[test]
fn diagnostics_are_cleared_under_the_address_under_which_they_were_told() {
    let above = folder("linked");
    let real = above.join("real");
    fs::create_dir(&real).expect("a folder");
    std::os::unix::fs::symlink(&real, above.join("ws")).expect("a link");
    let (good, wrong) = (format!("{DEVICE}{AUTOMATON}"), "automaton Other on nothing {}");
    put(&real, "m.aut", &good);
    put(&real, "other.aut", wrong);
    let [file, other] = ["m.aut", "other.aut"].map(|name| above.join("ws").join(name));
    let mut client = Client::in_folder(&above.join("ws"));
    client.open(&file, &good);
    client.diagnostics(&file);
    // Not open yet: as the file is called in truth.
    let in_truth = uri(&real.join("other.aut"));
    while client.told.get(&in_truth).is_none_or(|told| told["diagnostics"] == json!([])) {
        client.message();
    }
    client.open(&other, wrong);
    assert!(!client.diagnostics(&other).is_empty());
    assert_eq!(client.told[&in_truth]["diagnostics"], json!([]));
    // Under a second address the file stays open when the first one is closed.
    client.open(&real.join("other.aut"), wrong);
    client.notify("textDocument/didClose", json!({"textDocument": {"uri": uri(&real.join("other.aut"))}}));
    let hover = json!({"textDocument": {"uri": uri(&other)}, "position": place(wrong, "Other", 0)});
    client.change(&other, "// nothing");
    assert_eq!(client.diagnostics(&other), Vec::<Value>::new());
    client.result("textDocument/hover", hover);
}

#[cfg(unix)]
#[test]
fn hidden_files_beside_a_file_are_passed_over_and_others_are_named() {
    let folder = folder("entries");
    let text = format!("{DEVICE}{AUTOMATON}");
    let file = put(&folder, "m.aut", &text);
    std::os::unix::fs::symlink("user@host.1234", folder.join(".#m.aut")).expect("a link");
    put(&folder, "._m.aut", "\u{0}\u{5}");
    let mut client = Client::in_folder(&folder);
    client.open(&file, &text);
    assert_eq!(client.diagnostics(&file), Vec::<Value>::new());
    std::os::unix::fs::symlink("nowhere", folder.join("gone.aut")).expect("a link");
    client.change(&file, &format!("{text} "));
    let found = client.diagnostics(&file);
    assert!(found[0]["message"].as_str().expect("a text").contains("gone.aut cannot be read"), "{found:?}");
}

#[test]
fn a_client_that_can_tells_of_changed_files() {
    let folder = folder("watched");
    let mut client = Client::spawned();
    let capabilities = json!({"workspace": {"didChangeWatchedFiles": {"dynamicRegistration": true}}});
    client.request("initialize", json!({"rootUri": uri(&folder), "capabilities": capabilities}));
    client.notify("initialized", json!({}));
    let asked = client.message();
    assert_eq!(asked["method"], "client/registerCapability", "{asked}");
    assert_eq!(asked["params"]["registrations"][0]["method"], "workspace/didChangeWatchedFiles", "{asked}");
    client.send(&json!({"jsonrpc": "2.0", "id": asked["id"], "result": null}));
    let (text, wrong) = (format!("{DEVICE}{AUTOMATON}"), "automaton Other on nothing {}");
    let file = put(&folder, "m.aut", &text);
    client.open(&file, &text);
    assert_eq!(client.diagnostics(&file), Vec::<Value>::new());
    let other = put(&folder, "other.aut", wrong);
    let changes = json!({"changes": [{"uri": uri(&other), "type": 1}]});
    client.notify("workspace/didChangeWatchedFiles", changes);
    while client.told.get(&uri(&other)).is_none_or(|told| told["diagnostics"] == json!([])) {
        client.message();
    }
}
