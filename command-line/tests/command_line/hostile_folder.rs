//! Folders that somebody else has made: nothing in them is run, and nothing outside them is changed.

use super::{autogen, autogen_in, contents, errors, example, folder, status};
use std::fs;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::Command;

const UNFINISHED: &str = "autogen-unfinished";

const SHORT: &str = r#"{
    "kinds": [{"name": "battery", "height": 0.053}],
    "orders": [{"station": "as1", "parts": {"battery": 1}}],
    "supply": {"items": ["battery"]}
}"#;

/// A folder with the default layout and a short scenario.
fn line(name: &str) -> PathBuf {
    let folder = folder(name);
    fs::copy(example("ariac2021/default.json"), folder.join("default.json")).expect("the example");
    fs::write(folder.join("scenario.json"), SHORT).expect("a file");
    folder
}

/// A folder with a line of one lamp, under the same names: its controllers are compiled in a fourth of the time.
fn lamp(name: &str) -> PathBuf {
    let folder = folder(name);
    let layout = r#"{"specs": "lamp.aut", "robots": [{"name": "unit", "type": "unit", "pose": [0, 0, 0]}]}"#;
    let text = "device unit {
            part lamp = lamp { at: pose; colour: green; };
            out shines: bool = lamp.on;
        }
        automaton Unit on unit {
            initial -> Off {}
            state Off { when after 1 s -> On { shines := true; } }
            state On { when after 1 s -> Done { shines := false; } }
            final state Done;
        }";
    for (file, text) in
        [("default.json", layout), ("scenario.json", r#"{"time_limit_s": 60}"#), ("lamp.aut", text)]
    {
        fs::write(folder.join(file), text).expect("a file");
    }
    folder
}

/// A program that leaves a mark.
fn trap(folder: &Path, name: &str) -> PathBuf {
    let path = folder.join(name);
    fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
    fs::write(&path, format!("#!/bin/sh\ntouch {}\nexec \"$@\"\n", folder.join("sprung").display()))
        .expect("a script");
    fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).expect("a program");
    path
}

fn assert_unsprung(folder: &Path) {
    assert!(!folder.join("sprung").exists(), "a program of the folder was run");
}

#[test]
fn nothing_in_the_working_folder_is_run() {
    let folder = line("hostile_cargo");
    let trap = trap(&folder, "evil.sh").display().to_string();
    fs::create_dir_all(folder.join(".cargo")).expect("a folder");
    let configuration = format!(
        "[build]\nrustc = \"{trap}\"\nrustc-wrapper = \"{trap}\"\ntarget-dir = \"stolen\"\n\
         [target.'cfg(all())']\nlinker = \"{trap}\"\n"
    );
    fs::write(folder.join(".cargo/config.toml"), configuration).expect("a file");
    let toolchain = format!("[toolchain]\npath = \"{}\"\n", folder.display());
    fs::write(folder.join("rust-toolchain.toml"), toolchain).expect("a file");
    // The cache is below it too, as in a checkout.
    let cache = folder.join("cache");
    self::trap(&folder, "bin/cargo");
    self::trap(&folder, "bin/rustc");
    self::trap(&folder, "cargo");
    // Not the cargo that runs this test, which is set apart from rustup.
    let output = Command::new(env!("CARGO_BIN_EXE_autogen"))
        .args(["commission", "default.json"])
        .current_dir(&folder)
        .env("XDG_CACHE_HOME", &cache)
        .env_remove("CARGO")
        .env_remove("RUSTUP_TOOLCHAIN")
        .output()
        .expect("autogen can be started");
    assert_eq!(status(&output), 0, "{}", errors(&output));
    assert_unsprung(&folder);
    assert!(!folder.join("stolen").exists());
}

#[test]
fn the_cache_is_nowhere_near_the_working_folder() {
    let folder = line("hostile_cache_path");
    let commission = |variables: &[(&str, &str)]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_autogen"));
        command.args(["commission", "default.json"]).current_dir(&folder);
        command.env_remove("XDG_CACHE_HOME").env_remove("HOME").envs(variables.iter().copied());
        command.output().expect("autogen can be started")
    };
    for variables in [&[][..], &[("XDG_CACHE_HOME", "cache")], &[("HOME", ".")]] {
        let output = commission(variables);
        assert_eq!(status(&output), 2, "{variables:?}");
        assert!(errors(&output).contains("set HOME or XDG_CACHE_HOME"), "{}", errors(&output));
        assert!(!folder.join("cache").exists() && !folder.join(".cache").exists());
    }
}

#[test]
fn compiled_controllers_that_were_replaced_or_cut_are_made_anew() {
    let folder = lamp("hostile_library");
    let cache = folder.join("cache");
    let commission = || {
        let output = autogen_in(&folder, &cache, &["commission", "default.json"]);
        assert_eq!(status(&output), 0, "{}", errors(&output));
        errors(&output)
    };
    assert!(commission().contains("compiling"));
    assert_eq!(commission(), "");
    let compiled = || contents(&cache.join("autogen/controllers-2"));
    let files = compiled();
    let [(library, bytes), (hash, _)] = &files[..] else { panic!("a library and its hash: {files:?}") };
    let bad = |said: &str| said.contains("were changed, and are not used") && said.contains("compiling");
    fs::write(library, &bytes[..bytes.len() / 2]).expect("a file");
    assert!(bad(&commission()), "a library that was cut");
    fs::write(library, "something else").expect("a file");
    assert!(bad(&commission()), "a library that was replaced");
    fs::remove_file(hash).expect("a file");
    assert!(bad(&commission()), "a library without its hash");
    assert_eq!(commission(), "");
    assert_eq!(compiled().len(), 2);
}

/// Everything outside the output folder, which has to stay.
fn outside(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    contents(folder).into_iter().filter(|(path, _)| !path.starts_with(folder.join("out"))).collect()
}

#[test]
fn a_manifest_of_somebody_else_removes_nothing() {
    let folder = line("hostile_manifest");
    let precious = folder.join("precious.txt");
    fs::write(&precious, "precious").expect("a file");
    // `sha256sum` of the text.
    let hash = "e7cf4f4b5a1c2c6e4d";
    let names = [
        precious.display().to_string(),
        "../../precious.txt".into(),
        "rust/../../../precious.txt".into(),
        "/etc/hostname".into(),
        "..".into(),
        String::new(),
    ];
    let hash = sha256(&precious).unwrap_or_else(|| hash.into());
    let files: Vec<String> = names.iter().map(|name| format!("{name:?}: \"{hash}\"")).collect();
    fs::create_dir_all(folder.join("out/default")).expect("a folder");
    fs::write(
        folder.join("out/default/manifest.json"),
        format!("{{ \"files\": {{ {} }} }}", files.join(", ")),
    )
    .expect("a file");
    let before = outside(&folder);
    let output = autogen(&folder, &["build", "default.json", "--force"]);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    assert!(outside(&folder) == before);
}

/// As the tool of that name says it.
fn sha256(path: &Path) -> Option<String> {
    let output = Command::new("sha256sum").arg(path).output().ok()?;
    String::from_utf8_lossy(&output.stdout).split_whitespace().next().map(String::from)
}

#[test]
fn a_journal_of_somebody_else_moves_nothing() {
    let folder = line("hostile_journal");
    fs::write(folder.join("precious.txt"), "precious").expect("a file");
    let hash = sha256(&folder.join("precious.txt")).unwrap_or_default();
    let unfinished = folder.join("out/default/autogen-unfinished");
    let journals = [
        (format!(r#"[{{"name": "../../precious.txt", "existed": false, "hash": "{hash}"}}]"#), None),
        (r#"[{"name": "precious.txt", "existed": true, "hash": null}]"#.to_string(), Some("old")),
        ("[1, 2".to_string(), None),
    ];
    for (journal, link) in journals {
        let _ = fs::remove_dir_all(folder.join("out"));
        fs::create_dir_all(&unfinished).expect("a folder");
        fs::write(unfinished.join("journal.json"), journal).expect("a file");
        if let Some(link) = link {
            symlink(&folder, unfinished.join(link)).expect("a link");
        }
        let before = outside(&folder);
        let output = autogen(&folder, &["build", "default.json", "--force"]);
        assert!(outside(&folder) == before, "{}", errors(&output));
        assert_eq!(status(&output), 2, "{}", errors(&output));
    }
}

#[test]
fn links_within_the_output_lead_nowhere() {
    for (link, to) in [
        ("out", "elsewhere"),
        ("out/default", "elsewhere"),
        ("out/default/plc", "elsewhere"),
        ("out/default/rust/controllers/src", "elsewhere"),
        ("out/default/manifest.json", "elsewhere/manifest.json"),
        ("out/default/graph/plan.svg", "elsewhere/plan.svg"),
        ("out/default/results.json", "elsewhere/results.json"),
        ("out/default/autogen-unfinished", "elsewhere"),
    ] {
        let folder = line("hostile_links");
        fs::create_dir_all(folder.join("elsewhere")).expect("a folder");
        fs::write(folder.join("elsewhere/plan.svg"), "somebody else's").expect("a file");
        let from = folder.join(link);
        fs::create_dir_all(from.parent().expect("a folder")).expect("a folder");
        symlink(folder.join(to), &from).expect("a link");
        let before = outside(&folder);
        let output = autogen(&folder, &["commission", "default.json", "--force"]);
        assert_eq!(status(&output), 2, "{link}: {}", errors(&output));
        assert!(errors(&output).contains(link) && errors(&output).contains("link"), "{}", errors(&output));
        assert!(outside(&folder) == before, "{link}");
    }
    // What the user names may be a link.
    let folder = line("hostile_links");
    fs::create_dir_all(folder.join("elsewhere")).expect("a folder");
    symlink(folder.join("elsewhere"), folder.join("named")).expect("a link");
    assert_eq!(status(&autogen(&folder, &["build", "default.json", "-o", "named"])), 0);
    assert!(folder.join("elsewhere/manifest.json").exists());
}

#[test]
fn a_file_that_is_gone_is_written_again() {
    let folder = line("missing_files");
    let build = |more: &[&str]| autogen(&folder, &[&["build", "default.json"], more].concat());
    assert_eq!(status(&build(&[])), 0);
    let first = contents(&folder.join("out"));
    fs::remove_file(folder.join("out/default/rust/controllers/src/robots/agv.rs")).expect("a file");
    fs::remove_dir_all(folder.join("out/default/plc")).expect("a folder");
    assert_eq!(status(&build(&[])), 0);
    assert!(contents(&folder.join("out")) == first);
    // One that would be removed.
    let larger = example("buffer/buffer.json");
    assert_eq!(status(&autogen(&folder, &["build", &larger, "-o", "out/default"])), 0);
    fs::remove_file(folder.join("out/default/rust/controllers/src/robots/buffer.rs")).expect("a file");
    let output = build(&["-o", "out/default"]);
    assert_eq!(status(&output), 0, "{}", errors(&output));
}

#[test]
fn what_a_person_has_changed_stays() {
    let folder = line("changed_by_hand");
    let commission = |more: &[&str]| autogen(&folder, &[&["commission", "default.json"], more].concat());
    assert_eq!(status(&commission(&[])), 0);
    for name in ["manifest.json", "results.json"] {
        let path = folder.join("out/default").join(name);
        let text = fs::read_to_string(&path).expect("a file");
        let changed = text.replacen('{', "{\n  \"note\": \"mine\",", 1);
        fs::write(&path, &changed).expect("a file");
        let more: &[&str] = if name == "manifest.json" { &["--set", "agv.capacity=3"] } else { &[] };
        let output = commission(more);
        assert_eq!(status(&output), 2, "{name}");
        assert!(errors(&output).contains(name), "{}", errors(&output));
        assert_eq!(fs::read_to_string(&path).expect("a file"), changed);
        let output = commission(&["--force"]);
        assert_eq!(status(&output), 0, "{}", errors(&output));
        assert_eq!(fs::read_to_string(&path).expect("a file"), text);
    }
}

#[test]
fn results_of_other_controllers_do_not_stay() {
    let folder = line("other_results");
    let results = folder.join("out/default/results.json");
    assert_eq!(status(&autogen(&folder, &["commission", "default.json"])), 0);
    assert_eq!(status(&autogen(&folder, &["build", "default.json"])), 0);
    assert!(results.exists(), "nothing has changed");
    assert_eq!(status(&autogen(&folder, &["build", "default.json", "--set", "agv.capacity=3"])), 0);
    assert!(!results.exists());
}

#[test]
fn no_input_is_written_over() {
    let folder = line("over_the_input");
    let before = outside(&folder);
    for option in ["--hashes", "--io-trace"] {
        let output = autogen(&folder, &["commission", "default.json", option, "default.json", "--force"]);
        assert_eq!(status(&output), 2);
        assert!(errors(&output).contains("a file of the input"), "{}", errors(&output));
    }
    fs::rename(folder.join("default.json"), folder.join("manifest.json")).expect("a file");
    let output = autogen(&folder, &["build", "manifest.json", "-o", ".", "--force"]);
    assert_eq!(status(&output), 2, "{}", errors(&output));
    assert!(errors(&output).contains("are inputs"), "{}", errors(&output));
    fs::rename(folder.join("manifest.json"), folder.join("default.json")).expect("a file");
    assert!(outside(&folder) == before);
}

#[test]
fn a_planted_link_does_not_become_a_temporary_file() {
    let folder = line("planted_link");
    fs::write(folder.join("precious.txt"), "precious").expect("a file");
    // Names that were foreseen once.
    for number in 1..3000 {
        let _ = symlink("precious.txt", folder.join(format!(".trace.csv.{number}.partial")));
    }
    let _ = symlink("precious.txt", folder.join(".trace.csv.abcdef.partial"));
    let output = autogen(&folder, &["commission", "default.json", "--io-trace", "trace.csv"]);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    assert_eq!(fs::read_to_string(folder.join("precious.txt")).expect("a file"), "precious");
    assert!(folder.join(".trace.csv.abcdef.partial").symlink_metadata().is_ok());
}

#[test]
fn files_of_the_same_name_stay_apart() {
    let folder = line("same_names");
    for (number, types) in ["a", "b"].iter().enumerate() {
        fs::create_dir_all(folder.join(types)).expect("a folder");
        // One of them is named as a graph is that is no automaton's.
        let name = if number == 0 { "Connectivity" } else { "Plan" };
        let text = format!(
            "automaton {name} on bin {{\n    initial -> Idle {{}}\n    state Idle {{ when after 1 s -> Idle {{}} }}\n}}\n"
        );
        fs::write(folder.join(types).join("own.aut"), text).expect("a file");
    }
    fs::create_dir_all(folder.join("deep")).expect("a folder");
    let layout = fs::read_to_string(folder.join("default.json")).expect("a file");
    let layout = layout
        .replace("\"name\": \"bin1\", \"type\": \"bin\"", "\"name\": \"bin1\", \"type\": \"connectivity\"");
    fs::write(folder.join("deep/default.json"), layout).expect("a file");
    let arguments = ["deep/default.json", "--specs", "a", "--specs", "b"];
    let output = autogen(&folder, &[&["build", "-o", "made"], &arguments[..]].concat());
    assert_eq!(status(&output), 0, "{}", errors(&output));
    let text = |name: &str| fs::read_to_string(folder.join("made").join(name)).expect("a file");
    let manifest: serde_json::Value = serde_json::from_str(&text("manifest.json")).expect("JSON");
    let inputs = manifest["inputs"].as_object().expect("inputs");
    assert!(inputs.contains_key("own.aut") && inputs.contains_key("own (2).aut"), "{inputs:?}");
    assert!(text("graph/connectivity.dot").contains("conveyor_belt"));
    assert!(text("graph/connectivity_.dot").contains("Idle"));
    let graph = |of: &str| autogen(&folder, &[&["graph", "--of", of], &arguments[..]].concat()).stdout;
    assert_eq!(graph("connectivity_"), text("graph/connectivity_.dot").into_bytes());
    assert_eq!(graph("connectivity"), text("graph/connectivity.dot").into_bytes());
}

/// Its name begins as a file does that holds values only.
#[test]
fn a_type_that_was_changed_is_compiled_again() {
    let folder = line("changed_type");
    let layout = fs::read_to_string(folder.join("default.json")).expect("a file");
    let layout = layout
        .replacen("{", "{ \"specs\": \"robots.aut\",", 1)
        .replace("\"bin1\", \"type\": \"bin\"", "\"bin1\", \"type\": \"robots\"");
    fs::write(folder.join("default.json"), layout).expect("a file");
    let cache = folder.join("cache");
    for value in ["1", "2"] {
        let text = format!(
            "automaton Robots on bin {{\n    local n: int 0..9 := 0;\n    initial -> Idle {{ n := {value}; }}\n    \
             state Idle {{ when after 1 s -> Idle {{ n := {value}; }} }}\n}}\n"
        );
        fs::write(folder.join("robots.aut"), text).expect("a file");
        let output = autogen_in(&folder, &cache, &["commission", "default.json"]);
        assert_eq!(status(&output), 0, "{}", errors(&output));
        assert!(errors(&output).contains("compiling"), "{value}");
    }
}

#[test]
fn what_was_read_is_neither_removed_nor_restored_over() {
    let folder = line("planted_beside_the_layout");
    let hash = |name: &str| sha256(&folder.join(name)).expect("sha256sum");
    let build = || autogen(&folder, &["build", "default.json", "-o", "."]);
    // A manifest that says that the inputs are its own.
    let manifest = format!(
        "{{\"files\": {{\"default.json\": \"{}\", \"scenario.json\": \"{}\"}}}}",
        hash("default.json"),
        hash("scenario.json")
    );
    fs::write(folder.join("manifest.json"), manifest).expect("a file");
    let before = contents(&folder);
    let output = autogen(&folder, &["build", "default.json", "-o", ".", "--force"]);
    assert_eq!(status(&output), 2);
    assert!(errors(&output).contains("are inputs"), "{}", errors(&output));
    assert!(contents(&folder) == before);
    // A journal that says so.
    fs::remove_file(folder.join("manifest.json")).expect("a file");
    let unfinished = folder.join(UNFINISHED);
    fs::create_dir_all(unfinished.join("old")).expect("a folder");
    fs::write(unfinished.join("old/default.json"), "{}").expect("a file");
    let journal = format!(
        "[{{\"name\": \"default.json\", \"existed\": true, \"hash\": \"{}\"}}, \
          {{\"name\": \"scenario.json\", \"existed\": false, \"hash\": \"{}\"}}]",
        hash("default.json"),
        hash("scenario.json")
    );
    fs::write(unfinished.join("journal.json"), journal).expect("a file");
    let before = contents(&folder);
    assert_eq!(status(&build()), 2);
    assert!(contents(&folder) == before);
    // A folder of that name which is somebody's.
    fs::remove_dir_all(&unfinished).expect("a folder");
    fs::create_dir_all(&unfinished).expect("a folder");
    fs::write(unfinished.join("thesis.txt"), "mine").expect("a file");
    let output = build();
    assert_eq!(status(&output), 2);
    assert!(errors(&output).contains("thesis.txt"), "{}", errors(&output));
    assert!(unfinished.join("thesis.txt").exists());
}

#[test]
fn one_file_has_one_name() {
    let folder = line("other_spelling");
    fs::create_dir_all(folder.join("sub")).expect("a folder");
    let before = outside(&folder);
    for (names, said) in [
        (["--hashes", "n", "--io-trace", "sub/../n"], "named twice"),
        (["--hashes", "out/default/../default/manifest.json", "--force", "-q"], "a file of the output"),
        (["--hashes", "sub/../default.json", "--force", "-q"], "a file of the input"),
    ] {
        fs::create_dir_all(folder.join("out/default")).expect("a folder");
        let output = autogen(&folder, &[&["commission", "default.json"], &names[..]].concat());
        assert_eq!(status(&output), 2, "{names:?}");
        assert!(errors(&output).contains(said), "{}", errors(&output));
    }
    assert!(outside(&folder) == before);
}

#[test]
fn files_of_a_person_are_told_from_those_of_a_run() {
    let folder = line("own_files");
    fs::write(folder.join(".h.abcdef.partial"), "thesis").expect("a file");
    fs::write(folder.join("notes"), "0123456789abcdef\nmy own notes\n").expect("a file");
    let output = autogen(&folder, &["commission", "default.json", "--hashes", "h"]);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    assert!(folder.join(".h.abcdef.partial").exists());
    assert_eq!(status(&autogen(&folder, &["commission", "default.json", "--hashes", "notes"])), 2);
    let long = "h".repeat(250);
    assert_eq!(status(&autogen(&folder, &["commission", "default.json", "--hashes", &long])), 0);
}

#[test]
fn a_link_in_a_folder_of_automata_does_not_lead_out() {
    let folder = line("linked_automata");
    fs::create_dir_all(folder.join("types")).expect("a folder");
    fs::write(folder.join("secret"), "PRIVATE LINE").expect("a file");
    symlink(folder.join("secret"), folder.join("types/x.aut")).expect("a link");
    let output = autogen(&folder, &["check", "default.json", "--specs", "types"]);
    assert_eq!(status(&output), 2);
    assert!(
        errors(&output).contains("leads out") && !errors(&output).contains("PRIVATE"),
        "{}",
        errors(&output)
    );
}

#[test]
fn a_planted_file_is_not_read_whole() {
    let folder = line("planted_size");
    fs::create_dir_all(folder.join("out/default/graph")).expect("a folder");
    for name in ["manifest.json", "graph/plan.svg"] {
        let path = folder.join("out/default").join(name);
        fs::File::create(&path).and_then(|file| file.set_len(1_050_000_000)).expect("a sparse file");
        let limited = format!("ulimit -v 1000000; exec {} build default.json", env!("CARGO_BIN_EXE_autogen"));
        let output =
            Command::new("sh").args(["-c", &limited]).current_dir(&folder).output().expect("a shell");
        assert_eq!(status(&output), 2, "{name}: {}", errors(&output));
        assert!(errors(&output).contains(name), "{}", errors(&output));
        fs::remove_file(path).expect("a file");
    }
}

#[test]
fn a_cache_that_others_could_write_is_emptied() {
    let folder = lamp("open_cache");
    let cache = folder.join("cache");
    let commission = || autogen_in(&folder, &cache, &["commission", "default.json"]);
    assert_eq!(status(&commission()), 0);
    fs::set_permissions(cache.join("autogen"), fs::Permissions::from_mode(0o777)).expect("a folder");
    let output = commission();
    assert!(errors(&output).contains("compiling"), "{}", errors(&output));
    // The hash is a link to somewhere else.
    let files = contents(&cache);
    let (hash, _) = &files[1];
    fs::remove_file(hash).expect("a file");
    fs::write(folder.join("precious.txt"), "precious").expect("a file");
    symlink(folder.join("precious.txt"), hash).expect("a link");
    assert_eq!(status(&commission()), 0);
    assert_eq!(fs::read_to_string(folder.join("precious.txt")).expect("a file"), "precious");
    assert_eq!(errors(&commission()), "");
}

#[test]
fn escapes_of_the_command_line_do_not_reach_the_terminal() {
    let folder = line("escapes");
    let output = autogen(&folder, &["check", "default.json", "b\u{1b}]0;pwn\u{7}.json"]);
    assert_eq!(status(&output), 2);
    assert!(!output.stderr.contains(&0x1b), "{}", errors(&output));
}
