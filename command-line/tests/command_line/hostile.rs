//! Input from outside that does harm, or a reader that has gone.

use super::{autogen, errors, example, folder, status};
use std::fs;
use std::io::pipe;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A pipe that nobody reads.
fn closed() -> Stdio {
    let (reader, writer) = pipe().expect("a pipe");
    drop(reader);
    writer.into()
}

fn status_unheard(folder: &Path, arguments: &[&str]) -> Option<i32> {
    let status = Command::new(env!("CARGO_BIN_EXE_autogen"))
        .args(arguments)
        .current_dir(folder)
        .stdout(closed())
        .stderr(closed())
        .status();
    status.expect("autogen can be started").code()
}

#[test]
fn a_reader_that_has_gone_changes_no_status() {
    let folder = folder("unheard");
    fs::write(folder.join("bad.json"), "{").expect("a file");
    for (arguments, wanted) in [
        (&["check", "bad.json", "-q"][..], 1),
        (&["check", "missing.json"][..], 2),
        (&["build", "bad.json"][..], 1),
        (&["commission", "bad.json"][..], 1),
        (&["sweep", "bad.json"][..], 1),
        (&["graph", "bad.json"][..], 1),
        (&["explain", "E9999"][..], 2),
        (&["explain"][..], 2),
        (&["--no-such-option"][..], 2),
        (&["--help"][..], 0),
    ] {
        assert_eq!(status_unheard(&folder, arguments), Some(wanted), "{arguments:?}");
    }
}

/// A folder with a layout that has these further keys, between the braces.
fn layout_with(name: &str, keys: &str) -> PathBuf {
    let folder = folder(name);
    let text = fs::read_to_string(example("ariac2021/default.json")).expect("the example");
    let text = text.replacen('{', &format!("{{{keys},"), 1);
    fs::create_dir(folder.join("line")).expect("a folder");
    fs::write(folder.join("line/line.json"), text).expect("a file");
    folder
}

/// What `check` says of the layout in such a folder, and its status.
fn checked(folder: &Path, further: &[&str]) -> (i32, String) {
    let output = autogen(folder, &[&["check", "line/line.json"], further].concat());
    (status(&output), errors(&output))
}

#[test]
fn a_layout_names_nothing_outside_of_its_folder() {
    let secret = "secret: of somebody else";
    for path in ["../secret", "link", "a/../../secret", "/etc/passwd"] {
        for key in ["scenario", "specs"] {
            let folder = layout_with("outside", &format!("\"{key}\": \"{path}\""));
            fs::write(folder.join("secret"), secret).expect("a file");
            symlink("../secret", folder.join("line/link")).expect("a link");
            let (status, said) = checked(&folder, &[]);
            assert_eq!(status, 1, "{key} {path}: {said}");
            let wanted = if (key, path) == ("specs", "link") { "E0141" } else { "E0140" };
            assert!(said.contains(wanted) && said.contains("line.json:1:"), "{key} {path}: {said}");
            assert!(!said.contains("secret:") && !said.contains("root:"), "{key} {path}: {said}");
        }
    }
    let folder = layout_with("outside", "\"specs\": \"types\"");
    fs::create_dir(folder.join("line/types")).expect("a folder");
    fs::write(folder.join("secret"), secret).expect("a file");
    symlink("../../secret", folder.join("line/types/a.aut")).expect("a link");
    let (status, said) = checked(&folder, &[]);
    assert!(status == 1 && said.contains("E0140") && !said.contains("secret:"), "{said}");
}

#[test]
fn what_is_no_object_is_not_shown() {
    let folder = layout_with("no_object", "\"scenario\": \"notes\"");
    fs::write(folder.join("line/notes"), "secret: of somebody else").expect("a file");
    let (status, said) = checked(&folder, &[]);
    assert!(status == 1 && said.contains("E0141") && !said.contains("secret"), "{said}");
    for arguments in [
        &["check", "line/notes"][..],
        &["check", "line/line.json", "--scenario", "line/notes"],
        &["sweep", "line/notes"],
    ] {
        let output = autogen(&folder, arguments);
        let said = errors(&output);
        assert_eq!(super::status(&output), 1, "{said}");
        assert!(said.contains("E0109") && said.contains("line/notes") && !said.contains("secret"), "{said}");
    }
}

#[test]
fn a_missing_file_is_reported_at_its_place_in_the_layout() {
    let folder = layout_with(
        "missing",
        "\"specs\": [\"nowhere\", \"line.json\", \"line.json/types\"], \"scenario\": \"none.json\"",
    );
    let (status, said) = checked(&folder, &[]);
    assert_eq!(status, 1);
    assert_eq!(said.matches("E0141").count(), 4, "{said}");
    assert!(said.contains("a part of this path is a file, not a folder"), "{said}");
    assert!(said.contains("No such file"), "{said}");
    assert!(said.contains("this is neither a folder nor a *.aut file"), "{said}");
}

#[test]
fn only_regular_files_of_bounded_size_are_read() {
    let folder = layout_with("sizes", "\"scenario\": \"odd\"");
    let odd = folder.join("line/odd");
    let made = Command::new("mkfifo").arg(&odd).status().expect("mkfifo");
    assert!(made.success());
    let (status, said) = checked(&folder, &[]);
    assert!(status == 1 && said.contains("this is not a regular file"), "{said}");
    for path in ["line/odd", "/dev/zero", "line"] {
        for option in ["--scenario", "--specs"] {
            let (status, said) = checked(&folder, &[option, path]);
            assert_eq!(status, 2, "{option} {path}: {said}");
        }
    }
    fs::remove_file(&odd).expect("a pipe");
    fs::write(&odd, format!("{{{}", " ".repeat(10_000_000))).expect("a file");
    let (status, said) = checked(&folder, &[]);
    assert!(status == 1 && said.contains("larger than 10 MB"), "{said}");
    fs::create_dir(folder.join("many")).expect("a folder");
    for number in 0..1000 {
        fs::write(folder.join(format!("many/t{number}.aut")), "").expect("a file");
    }
    let (status, said) = checked(&folder, &["--specs", "many"]);
    assert!(status == 2 && said.contains("more than 1000 files"), "{said}");
    fs::remove_dir_all(folder.join("many")).expect("a folder");
    fs::create_dir(folder.join("many")).expect("a folder");
    for number in 0..3 {
        fs::write(folder.join(format!("many/t{number}.aut")), "/".repeat(9_000_000)).expect("a file");
    }
    let (status, said) = checked(&folder, &["--specs", "many"]);
    assert!(status == 2 && said.contains("more than 20 MB"), "{said}");
}

#[test]
fn a_single_file_of_automata_is_enough() {
    let layout = fs::read_to_string(example("buffer/buffer.json")).expect("the example");
    let types = fs::read_to_string(example("buffer/specs/buffer.aut")).expect("the example");
    let folder = folder("single");
    fs::write(folder.join("own.aut"), types).expect("a file");
    let named = layout.replace("\"specs\": \"specs\"", "\"specs\": \"own.aut\"");
    fs::write(folder.join("named.json"), named).expect("a file");
    fs::write(folder.join("given.json"), layout.replace("\"specs\": \"specs\",", "")).expect("a file");
    let scenario = example("buffer/scenario.json");
    let further: &[&str] = if Path::new(&scenario).exists() { &["--scenario", &scenario] } else { &[] };
    for arguments in [&["check", "named.json"][..], &["check", "given.json", "--specs", "own.aut"]] {
        let output = autogen(&folder, &[arguments, further].concat());
        assert_eq!(status(&output), 0, "{}", errors(&output));
    }
}

/// What a terminal obeys, what no XML holds, and what turns the order of a text.
const ODD: &str = "\u{1b}[31m\u{9b}1m\u{8}\r\u{202e}\u{2066}\u{200f}\u{61c}\u{2028}\u{fffe}\u{7f}";

fn is_odd(c: char) -> bool {
    c != '\n' && (c.is_control() || ODD.contains(c) && !c.is_ascii())
}

#[test]
fn nothing_from_outside_reaches_the_terminal_as_a_command() {
    let folder = folder("escapes");
    let json = serde_json::to_string(&format!("a{ODD}b")).expect("a text");
    let layout = format!("{{\"robots\": [], \"name\": {json}, \"k{ODD}\": 1, \"specs\": {json}}}");
    let name = format!("line{ODD}.json");
    fs::write(folder.join(&name), layout).expect("a file");
    let odd_type = format!("automaton T on bin {{ // {ODD}\n /* {ODD} */ {ODD} }}");
    fs::write(folder.join("odd.aut"), odd_type).expect("a file");
    let default = example("ariac2021/default.json");
    let set = format!("agv.capacity={ODD}");
    for arguments in [
        &["check", &name][..],
        &["check", &default, "--specs", "odd.aut"],
        &["check", &default, "--set", &set],
        &["check", ODD],
        &["check", &default, "--scenario", ODD],
        &["check", &default, "--specs", ODD],
        &["graph", &default, "--of", ODD],
        &["explain", ODD],
        &["sweep", &name],
    ] {
        for format in ["text", "json"] {
            let output = match arguments[0] {
                "graph" | "explain" => autogen(&folder, arguments),
                _ => autogen(&folder, &[arguments, &["--format", format]].concat()),
            };
            assert_ne!(status(&output), 0);
            for shown in [&output.stdout, &output.stderr] {
                let shown = String::from_utf8(shown.clone()).expect("UTF-8");
                assert!(!shown.contains(is_odd), "{arguments:?}: {shown:?}");
            }
        }
    }
}

#[test]
fn what_is_generated_reads_as_it_runs() {
    let folder = folder("reads");
    let types = fs::read_to_string(example("buffer/specs/buffer.aut")).expect("the example");
    let marked: String = types
        .lines()
        .map(|line| match line.trim_start().starts_with("///") {
            true => format!("{line} a{ODD} (* b *) ]]> -- end\n"),
            false => format!("{line} // {ODD} *)\n"),
        })
        .collect();
    let marked = marked.replace("automaton", &format!("/// =first{ODD}\nautomaton"));
    let name = format!("own{ODD}.aut");
    fs::write(folder.join(&name), marked).expect("a file");
    let layout = fs::read_to_string(example("buffer/buffer.json")).expect("the example");
    fs::write(folder.join("line.json"), layout.replace("\"specs\": \"specs\",", "")).expect("a file");
    let output = autogen(&folder, &["build", "line.json", "--specs", &name, "-o", "out"]);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    for (path, bytes) in super::contents(&folder.join("out")) {
        // What was given is copied byte for byte.
        if path.starts_with(folder.join("out").join("sources")) {
            continue;
        }
        let text = String::from_utf8(bytes).expect("UTF-8");
        let path = path.display();
        if let Some(at) = text.find(is_odd) {
            panic!("{path}: {:?}", &text[at.saturating_sub(40)..(at + 40).min(text.len())]);
        }
    }
}
