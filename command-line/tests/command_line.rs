//! The program as a user runs it.

#[path = "command_line/checked_in.rs"]
mod checked_in;
#[path = "command_line/compared_results.rs"]
mod compared_results;
#[path = "command_line/compiling.rs"]
mod compiling;
#[path = "command_line/conveyors.rs"]
mod conveyors;
#[cfg(unix)]
#[path = "command_line/copies.rs"]
mod copies;
#[path = "command_line/counterexample.rs"]
mod counterexample;
#[path = "command_line/daily.rs"]
mod daily;
#[path = "command_line/device_keys.rs"]
mod device_keys;
#[path = "command_line/drives.rs"]
mod drives;
#[cfg(unix)]
#[path = "command_line/hostile.rs"]
mod hostile;
#[cfg(target_os = "linux")]
#[path = "command_line/hostile_folder.rs"]
mod hostile_folder;
#[cfg(unix)]
#[path = "command_line/import.rs"]
mod import;
#[path = "command_line/interrupt.rs"]
mod interrupt;
#[cfg(target_os = "linux")]
#[path = "command_line/interrupted_write.rs"]
mod interrupted_write;
#[path = "command_line/inverted.rs"]
mod inverted;
#[path = "command_line/left_out.rs"]
mod left_out;
#[path = "../../tests/src/machines.rs"]
mod machines;
#[path = "command_line/misplaced.rs"]
mod misplaced;
#[path = "command_line/output_folder.rs"]
mod output_folder;
#[path = "command_line/parts.rs"]
mod parts;
#[path = "command_line/replications.rs"]
mod replications;
#[path = "command_line/report.rs"]
mod report;
#[path = "command_line/restarts.rs"]
mod restarts;
#[path = "command_line/scenario_of_violation.rs"]
mod scenario_of_violation;
#[path = "command_line/search_limits.rs"]
mod search_limits;
#[path = "command_line/side_by_side.rs"]
mod side_by_side;
#[path = "command_line/sweep.rs"]
mod sweep;
#[path = "command_line/sweep_page.rs"]
mod sweep_page;
#[path = "command_line/sweep_values.rs"]
mod sweep_values;
#[path = "command_line/tables.rs"]
mod tables;
#[path = "command_line/tests_apart.rs"]
mod tests_apart;
#[path = "command_line/tests_of_users.rs"]
mod tests_of_users;
#[path = "command_line/trajectories.rs"]
mod trajectories;
#[path = "command_line/unreached.rs"]
mod unreached;
#[path = "command_line/why.rs"]
mod why;

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::Once;
use std::{env, fs};

/// A new empty folder with the compiled programs of all tests beside it.
fn folder(name: &str) -> PathBuf {
    static EMPTIED: Once = Once::new();
    let above = Path::new(env!("CARGO_TARGET_TMPDIR")).join("command_line");
    EMPTIED.call_once(|| _ = fs::remove_dir_all(&above));
    let folder = above.join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder that can be made");
    folder
}

fn example(path: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples").join(path).display().to_string()
}

fn autogen(folder: &Path, arguments: &[&str]) -> Output {
    autogen_in(folder, &folder.with_file_name("cache"), arguments)
}

/// With a cache of its own.
fn autogen_in(folder: &Path, cache: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_autogen"))
        .args(arguments)
        .current_dir(folder)
        .env("XDG_CACHE_HOME", cache)
        .output()
        .expect("autogen can be started")
}

fn status(output: &Output) -> i32 {
    output.status.code().expect("it ends by itself")
}

fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(&output.stdout)))
}

fn errors(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// All files of a folder with their texts, and its symbolic links with what they lead to.
fn contents(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut found = Vec::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            match fs::read_link(&path) {
                Ok(target) => found.push((path, target.into_os_string().into_encoded_bytes())),
                Err(_) if path.is_dir() => open.push(path),
                Err(_) => found.push((path.clone(), fs::read(path).expect("a file"))),
            }
        }
    }
    found.sort();
    found
}

#[test]
fn check_answers_scripts() {
    let folder = folder("check");
    let output = autogen(&folder, &["check", &example("ariac2021/default.json"), "--format", "json"]);
    assert_eq!(status(&output), 0);
    let answer = json(&output);
    assert_eq!(answer["feasible"], true);
    assert_eq!(answer["edges"].as_array().map(Vec::len), Some(13));
    for key in ["robots", "sources", "destinations", "unreachable", "dead_ends", "diagnostics"] {
        assert!(answer[key].is_array(), "{key}");
    }
}

#[test]
fn an_infeasible_layout_is_status_1_with_place_and_help() {
    let folder = folder("infeasible");
    let layout = fs::read_to_string(example("ariac2021/default.json")).expect("the example");
    fs::write(
        folder.join("moved.json"),
        layout.replace("[-2.265685, -1.333917, 0]", "[-2.765685, -1.333917, 0]"),
    )
    .expect("a file");
    for command in ["check", "build", "commission"] {
        let output = autogen(&folder, &[command, "moved.json", "--format", "json"]);
        assert_eq!(status(&output), 1, "{command}");
        let answer = json(&output);
        assert_eq!(answer["feasible"], false);
        let diagnostic = &answer["diagnostics"][0];
        assert_eq!(diagnostic["code"], "E0401");
        assert_eq!(diagnostic["file"], "moved.json");
        assert!(diagnostic["line"].as_u64().is_some_and(|l| l > 1) && diagnostic["column"].is_u64());
        assert!(diagnostic["help"].as_str().is_some_and(|h| h.contains("pose[0]")), "{diagnostic}");
    }
    assert!(!folder.join("out").exists(), "nothing is written of a layout that has errors");
}

#[test]
fn a_value_with_its_unit_is_answered_with_the_unit_that_is_meant() {
    let folder = folder("unit");
    let layout = example("tending/tending.json");
    let output = autogen(&folder, &["check", &layout, "--set", "mill.cut=4s"]);
    assert_eq!(status(&output), 2);
    let errors = errors(&output);
    assert!(errors.contains("--set:1:10") && errors.contains("times in s"), "{errors}");
}

#[test]
fn wrong_command_lines_are_status_2() {
    let folder = folder("wrong");
    let layout = example("ariac2021/default.json");
    let cases: &[&[&str]] = &[
        &["check"],
        &["chek", &layout],
        &["check", "no_such_file.json"],
        &["check", &layout, "--set", "capacity"],
        &["check", &layout, "--specs", "no_such_folder"],
        &["check", &layout, "--scenario", "no_such_file.json"],
        &["commission", &layout, "--io-delay", "often"],
        &["commission", &layout, "--io-trace", "no_such_folder/trace.csv"],
        &["commission", &layout, "--io-trace", &layout],
        &["explain", "E9999"],
    ];
    for case in cases {
        let output = autogen(&folder, case);
        assert_eq!(status(&output), 2, "{case:?}: {}", errors(&output));
        assert!(!output.stderr.is_empty(), "{case:?}");
    }
    assert_eq!(status(&autogen(&folder, &["check", &layout])), 0, "the layout is still there");
}

#[test]
fn a_code_is_found_however_it_is_typed() {
    let folder = folder("explain");
    let text = |code: &str| autogen(&folder, &["explain", code]).stdout;
    assert!(!text("E0401").is_empty());
    for typed in ["e0401", "e401", "E401", "401", " E0401 "] {
        assert_eq!(text(typed), text("E0401"), "{typed}");
    }
}

#[test]
fn a_file_in_utf_16_is_called_so() {
    let folder = folder("utf_16");
    let layout = example("ariac2021/default.json");
    let utf_8 = fs::read_to_string(&layout).expect("the example");
    let bytes = |order: fn(u16) -> [u8; 2], mark: &str| -> Vec<u8> {
        format!("{mark}{utf_8}").encode_utf16().flat_map(order).collect()
    };
    let texts =
        [u16::to_le_bytes, u16::to_be_bytes].map(|order| [bytes(order, ""), bytes(order, "\u{feff}")]);
    for text in texts.as_flattened() {
        fs::write(folder.join("utf_16"), text).expect("a file");
        let asked: [&[&str]; 4] = [
            &["check", "utf_16"],
            &["check", &layout, "--scenario", "utf_16"],
            &["build", &layout, "--io", "utf_16"],
            &["sweep", &layout, "--beside", "utf_16"],
        ];
        for arguments in asked {
            let output = autogen(&folder, arguments);
            assert_eq!(status(&output), 1, "{arguments:?}");
            let said = errors(&output);
            assert!(said.contains("utf_16: this file is UTF-16") && said.contains("UTF-8"), "{said}");
        }
    }
    fs::write(folder.join("utf_8.json"), format!("\u{feff}{utf_8}")).expect("a file");
    assert_eq!(status(&autogen(&folder, &["check", "utf_8.json"])), 0);
}

#[test]
fn build_never_overwrites_what_is_not_its_own() {
    let folder = folder("overwrite");
    let layout = example("ariac2021/less_agv.json");
    let build = |more: &[&str]| {
        let mut arguments = vec!["build", layout.as_str(), "-o", "made"];
        arguments.extend(more);
        autogen(&folder, &arguments)
    };
    assert_eq!(status(&build(&[])), 0);
    let first = contents(&folder.join("made"));
    assert_eq!(status(&build(&[])), 0, "its own files may be written anew");
    assert_eq!(first, contents(&folder.join("made")), "the same input gives the same bytes");

    let changed = folder.join("made/rust/controllers/src/agv.rs");
    fs::write(&changed, "// changed by hand").expect("a file");
    let before = contents(&folder.join("made"));
    let output = build(&["--set", "agv.capacity=3"]);
    assert_eq!(status(&output), 2);
    assert!(errors(&output).contains("agv.rs"), "{}", errors(&output));
    assert_eq!(before, contents(&folder.join("made")), "nothing is written if something cannot be");
    assert_eq!(status(&build(&["--force"])), 0);
    assert_eq!(first, contents(&folder.join("made")));

    // Types that are no more leave no file behind.
    let larger = example("buffer/buffer.json");
    assert_eq!(status(&autogen(&folder, &["build", &larger, "-o", "made"])), 0);
    assert!(folder.join("made/rust/controllers/src/robots/buffer.rs").exists());
    assert_eq!(status(&build(&[])), 0);
    assert!(!folder.join("made/rust/controllers/src/robots/buffer.rs").exists());
    assert_eq!(first, contents(&folder.join("made")));
}

#[test]
fn commission_works_without_the_source_tree_and_twice_the_same() {
    let folder = folder("commission");
    let program = folder.join("autogen").with_extension(env::consts::EXE_EXTENSION);
    fs::copy(env!("CARGO_BIN_EXE_autogen"), &program).expect("a program that can be copied");
    fs::copy(example("ariac2021/default.json"), folder.join("default.json")).expect("the example");
    let run = |out: &str| {
        Command::new(&program)
            .args(["commission", "default.json", "--format", "json", "-o", out])
            .current_dir(&folder)
            .env("XDG_CACHE_HOME", folder.with_file_name("cache"))
            .output()
            .expect("autogen can be started")
    };
    let (first, second) = (run("a"), run("b"));
    assert_eq!(status(&first), 0, "{}", errors(&first));
    assert_eq!(status(&second), 0);
    let files = |out: &str| -> Vec<(PathBuf, Vec<u8>)> {
        let root = folder.join(out);
        contents(&root)
            .into_iter()
            .map(|(p, t)| (p.strip_prefix(&root).expect("within").to_path_buf(), t))
            .collect()
    };
    assert_eq!(files("a"), files("b"));
    let (mut first, mut second) = (json(&first), json(&second));
    assert_eq!(first["finished"], true);
    assert_eq!(first["orders_done"], 8);
    assert_eq!(first["orders"], 8);
    let contacts = first["collisions"].as_array().expect("a list");
    for contact in contacts {
        assert!(contact["allowed"] == true && contact["reason"].is_string(), "{contact}");
    }
    let total = first["simulated_s"].as_f64().expect("a number");
    for (name, robot) in first["robots"].as_object().expect("robots") {
        let sum: f64 = ["moving_s", "working_s", "waiting_s", "stopped_s"]
            .iter()
            .map(|k| robot[k].as_f64().expect("a number"))
            .sum();
        assert!((sum - total).abs() < 1e-6, "{name}: {sum} of {total}");
    }
    first["wall_s"].take();
    second["wall_s"].take();
    assert_eq!(first, second);
}

#[test]
fn a_run_that_misses_its_goal_is_status_3_and_names_part_and_place() {
    let folder = folder("missed");
    let scenario = r#"{
        "kinds": [{"name": "battery", "height": 0.053}],
        "orders": [{"station": "as1", "parts": {"battery": 1}}],
        "supply": {"items": ["battery"]},
        "faults": {"slips": [{"robot": "kitting", "pick": 1, "after_s": 2.8}]}
    }"#;
    fs::write(folder.join("scenario.json"), scenario).expect("a file");
    let layout = example("ariac2021/default.json");
    let output =
        autogen(&folder, &["commission", &layout, "--scenario", "scenario.json", "--format", "json"]);
    assert_eq!(status(&output), 3, "{}", errors(&output));
    let answer = json(&output);
    assert_eq!(answer["finished"], false);
    let reason = answer["reason"].as_str().expect("a reason");
    assert!(reason.contains("battery (item 0) lies on "), "{reason}");
    let waits: Vec<&str> =
        answer["waits"].as_array().expect("a list").iter().filter_map(Value::as_str).collect();
    assert!(waits.iter().any(|line| line.starts_with("as1 (Filling) waits for gantry: ")), "{waits:#?}");
    assert!(waits.iter().any(|line| line.starts_with("kitting (Waiting) waits for ")), "{waits:#?}");
}

#[test]
fn the_picture_of_the_readme_is_drawn_from_the_default_layout() {
    let folder = folder("picture");
    let output = autogen(&folder, &["graph", &example("ariac2021/default.json"), "--of", "plan"]);
    let picture =
        fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/default.svg")).expect("the picture");
    assert!(
        output.stdout == picture,
        "draw it anew: autogen graph examples/ariac2021/default.json --of plan > docs/default.svg"
    );
}

#[test]
fn what_is_in_the_way_is_named_and_nothing_is_written() {
    let folder = folder("in_the_way");
    let layout = example("ariac2021/less_agv.json");
    fs::write(folder.join("file"), "").expect("a file");
    let output = autogen(&folder, &["build", &layout, "-o", "file"]);
    assert_eq!(status(&output), 2);
    assert!(
        errors(&output).contains("a file instead of a folder") && errors(&output).lines().count() < 5,
        "{}",
        errors(&output)
    );
    fs::create_dir_all(folder.join("made/manifest.json")).expect("a folder");
    let output = autogen(&folder, &["build", &layout, "-o", "made", "--force"]);
    assert_eq!(status(&output), 2);
    assert!(contents(&folder.join("made")).is_empty(), "nothing is written");
}

#[test]
fn the_same_input_gives_the_same_bytes_from_any_folder() {
    let folder = folder("any_folder");
    let line = folder.join("line");
    fs::create_dir_all(line.join("types")).expect("a folder");
    let layout = fs::read_to_string(example("buffer/buffer.json")).expect("the example");
    fs::write(line.join("buffer.json"), layout.replace("\"specs\": \"specs\"", "\"specs\": \"types\""))
        .expect("a file");
    fs::copy(example("buffer/specs/buffer.aut"), line.join("types/buffer.aut")).expect("the example");
    let here = autogen(&folder, &["build", "line/buffer.json", "-o", "a"]);
    let there = autogen(&line, &["build", "buffer.json", "-o", "../b"]);
    let anywhere = autogen(&folder, &["build", &line.join("buffer.json").display().to_string(), "-o", "c"]);
    for output in [&here, &there, &anywhere] {
        assert_eq!(status(output), 0, "{}", errors(output));
    }
    let first = contents(&folder.join("a"));
    for other in ["b", "c"] {
        for ((path, text), (_, same)) in first.iter().zip(contents(&folder.join(other))) {
            assert!(*text == same, "{} differs in {other}", path.display());
        }
        assert_eq!(first.len(), contents(&folder.join(other)).len());
    }
}
