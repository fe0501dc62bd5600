//! `compare`, `fmt`, `completions` and the notes of `check`.

use super::*;

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn a_change_of_a_specification_is_found_where_it_acts_first() {
    let folder = folder("compare");
    let layout = example("scenes/lifting_table.json");
    for name in ["lifting_table.aut", "lifting_table.json", "lifting_table.scenario.json"] {
        fs::copy(example(&format!("scenes/{name}")), folder.join(name)).expect("the example");
    }
    let output = autogen(&folder, &["compare", &layout, "lifting_table.json"]);
    assert_eq!(status(&output), 0, "{}{}", said(&output), errors(&output));
    assert!(said(&output).starts_with("the same\n"), "{}", said(&output));

    let text = fs::read_to_string(folder.join("lifting_table.aut")).expect("the example");
    let slower = text.replace("warning_time: time := 1 s", "warning_time: time := 1500 ms");
    fs::write(folder.join("lifting_table.aut"), slower).expect("a file");
    let output = autogen(&folder, &["compare", &layout, "lifting_table.json"]);
    assert_eq!(status(&output), 3, "{}", errors(&output));
    let text = said(&output);
    assert!(
        text.starts_with("different\n\nfirst difference at 3.00 s, in scan 300: first, second\n"),
        "{text}"
    );
    assert!(text.contains("  table, in state: Lifting, unchanged\n"), "{text}");
    let output = autogen(&folder, &["compare", &layout, "lifting_table.json", "--format", "json"]);
    let answer = json(&output);
    assert_eq!(answer["same"], false);
    assert_eq!(answer["first_difference"]["scan"], 300);
    assert_eq!(answer["first_difference"]["values"][0]["machine"], "table");

    let output = autogen(&folder, &["compare", &layout, &example("scenes/from_a_to_b.json")]);
    assert_eq!(status(&output), 3);
    assert!(said(&output).contains("only the second has belt"), "{}", said(&output));
}

#[test]
fn files_are_formatted_all_or_none() {
    let folder = folder("fmt");
    let write = |name: &str, text: &str| fs::write(folder.join(name), text).expect("a file");
    write("a.aut", "enum A{B,C}\n");
    write("b.aut", "enum B { D }\n");
    write("c.aut", "enum {\n");
    let before = contents(&folder);
    let output = autogen(&folder, &["fmt", "."]);
    assert_eq!(status(&output), 1);
    assert!(errors(&output).contains("nothing was changed"), "{}", errors(&output));
    assert_eq!(before, contents(&folder));

    fs::remove_file(folder.join("c.aut")).expect("a file");
    let output = autogen(&folder, &["fmt", "--check", "."]);
    assert_eq!(status(&output), 1);
    let text = said(&output);
    assert!(
        text.contains("a.aut is not formatted") && text.contains("-enum A{B,C}\n+enum A { B, C }"),
        "{text}"
    );
    assert!(!text.contains("b.aut"), "{text}");

    assert_eq!(status(&autogen(&folder, &["fmt", "a.aut", "b.aut"])), 0);
    assert_eq!(fs::read_to_string(folder.join("a.aut")).expect("a file"), "enum A { B, C }\n");
    assert_eq!(status(&autogen(&folder, &["fmt", "--check", "."])), 0);
    assert_eq!(contents(&folder).len(), 2, "no file is left behind");
    assert_eq!(status(&autogen(&folder, &["fmt", "no_such_file.aut"])), 2);
    assert_eq!(status(&autogen(&folder, &["fmt"])), 2);
}

#[test]
fn every_command_is_completed() {
    let folder = folder("completions");
    let help = said(&autogen(&folder, &["--help"]));
    let commands =
        help.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    let commands: Vec<&str> = commands
        .filter(|line| line.starts_with("  ") && !line.starts_with("   "))
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    assert!(commands.len() > 8, "{help}");
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let output = autogen(&folder, &["completions", shell]);
        assert_eq!(status(&output), 0);
        let text = said(&output);
        assert!(commands.iter().all(|command| text.contains(command)), "{shell}");
    }
    assert_eq!(status(&autogen(&folder, &["completions", "csh"])), 2);
}

/// A scenario of one's own has nothing of the built-in one.
#[test]
fn a_line_of_which_nothing_is_asked_says_so() {
    let folder = folder("asks_nothing");
    let layout = example("ariac2021/default.json");
    fs::write(
        folder.join("none.json"),
        r#"{ "time_limit_s": 2, "faults": { "pauses": [{ "at_s": 5, "for_s": 1 }] } }"#,
    )
    .expect("a file");
    let arguments = ["commission", &layout, "--scenario", "none.json", "-o", "made"];
    let output = autogen(&folder, &arguments);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    let note = "the scenario has neither orders nor a goal, so as1 and the other stations have nothing to do";
    assert!(said(&output).contains(&format!("note: {note}; ")), "{}", said(&output));
    let late = "not reached: pause at 5.00 s, as the run ended at 2.00 s; give an earlier time";
    assert!(said(&output).contains(&format!("note: {late}\n")), "{}", said(&output));
    let output = autogen(&folder, &[&arguments[..], &["--format", "json"]].concat());
    let notes = &json(&output)["notes"];
    assert_eq!(notes[0], late);
    assert!(notes[1].as_str().expect("a text").starts_with(note), "{}", said(&output));
    let sweep = ["sweep", &layout, "--scenario", "none.json", "--set", "agv.capacity=2,4"];
    let output = autogen(&folder, &sweep);
    assert!(
        said(&output).ends_with(&format!("\nnote on 2 rows, the first default 2: {late}\n")),
        "{}",
        said(&output)
    );
    let output = autogen(&folder, &[&sweep[..], &["--format", "json"]].concat());
    assert_eq!(json(&output)["rows"][1]["notes"], serde_json::json!([late]));
}

#[test]
fn notes_are_given_on_request_and_never_fail_a_check() {
    let folder = folder("notes");
    let layout = example("ariac2021/default.json");
    let check = |more: &[&str]| autogen(&folder, &[&["check", &layout, "--deny", "warnings"], more].concat());
    let output = check(&["--notes"]);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    let text = errors(&output);
    assert!(text.contains("note[N0101]: "), "{text}");
    assert!(text.contains("for example with attached = false, done"), "{text}");
    assert!(!errors(&check(&[])).contains("N0101"));
}

#[test]
fn a_graph_is_no_json() {
    let layout = example("scenes/lifting_table.json");
    let output = autogen(&folder("graph_json"), &["graph", &layout, "--format", "json"]);
    assert_eq!(status(&output), 2);
    assert!(errors(&output).contains("a graph is DOT") && output.stdout.is_empty(), "{}", errors(&output));
}
