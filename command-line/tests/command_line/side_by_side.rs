//! Two processes at once, in one folder and one cache.

use super::{autogen_in, contents, example, folder, json};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::{env, fs};

/// One battery: a run of a few seconds.
const SHORT: &str = r#"{
    "kinds": [{"name": "battery", "height": 0.053}],
    "orders": [{"station": "as1", "parts": {"battery": 1}}],
    "supply": {"items": ["battery"]}
}"#;

/// A report, and the files of the output folder.
type Expected = (Value, Vec<(PathBuf, Vec<u8>)>);

fn begin(folder: &Path, cache: &Path, arguments: &[String]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_autogen"))
        .args(arguments)
        .current_dir(folder)
        .env("XDG_CACHE_HOME", cache)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("autogen can be started")
}

/// With results of its own, so that it is told from the other one.
fn commission(layout: &str, capacity: usize) -> Vec<String> {
    let layout = example(&format!("ariac2021/{layout}.json"));
    let set = format!("agv.capacity={capacity}");
    ["commission", &layout, "--scenario", "short.json", "-o", "made", "--set", &set, "--format", "json"]
        .map(String::from)
        .to_vec()
}

fn report(output: &Output) -> Value {
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let mut report = json(output);
    report["wall_s"].take();
    report
}

#[test]
fn two_that_commission_into_one_folder_come_one_after_the_other() {
    let folder = folder("side_by_side");
    fs::write(folder.join("short.json"), SHORT).expect("a file");
    let pairs = [
        [commission("default", 2), commission("less_agv", 3)],
        [commission("default", 2), commission("default", 2)],
        [commission("spaced", 1), commission("default", 4)],
    ];
    let made = folder.join("made");
    let rounds = if env::var("AUTOGEN_CAMPAIGN").is_ok_and(|c| c == "full") { 67 } else { 1 };
    for (number, pair) in pairs.iter().enumerate() {
        let cache = folder.join(format!("cache{number}"));
        let alone: Vec<Expected> = (pair.iter())
            .map(|arguments| {
                let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
                let other = folder.join("cache");
                (report(&autogen_in(&folder, &other, &arguments)), contents(&made))
            })
            .collect();
        for _ in 0..rounds {
            // In the first round both find an empty cache.
            let children = [0, 1].map(|i| begin(&folder, &cache, &pair[i]));
            let outputs = children.map(|child| child.wait_with_output().expect("it ends"));
            for (output, (expected, _)) in outputs.iter().zip(&alone) {
                assert_eq!(report(output), *expected);
            }
            let found = contents(&made);
            assert!(
                alone.iter().any(|(_, expected)| *expected == found),
                "the folder is that of one of them"
            );
        }
    }
}
