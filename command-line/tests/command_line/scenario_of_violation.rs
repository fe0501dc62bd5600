//! `verify --counterexample`: the scenario of a violation, and what is said of its run.

use super::sweep::printed;
use super::*;

/// A line of one machine; its automaton is that of the device `pad`.
fn put(name: &str, automaton: &str, scenario: &str) -> PathBuf {
    let folder = folder(name);
    let device = "device pad {
            part start = button {};
            part slide = positioner { positions: [0, 1]; slides: point(0, 0, 1); speed: 0.5; };
            in pressed: bool = start.on;
            out goal: int 0..1;
            command 1 go(goal) = slide.to(goal);
        }";
    let layout = r#"{"robots": [{"name": "pad", "type": "counter", "pose": [0, 0, 0]}], "specs": "pad.aut"}"#;
    for (file, text) in [
        ("pad.aut", format!("{device}\nautomaton Counter on pad {{ {automaton} }}").as_str()),
        ("line.json", layout),
        ("scenario.json", scenario),
    ] {
        fs::write(folder.join(file), text).expect("a file that can be written");
    }
    folder
}

/// What is said of the run in the simulator.
fn simulator(folder: &Path, more: &[&str]) -> String {
    let arguments = ["verify", "line.json", "--scenario", "scenario.json", "--format", "json"];
    let output = autogen(folder, &[&arguments[..], more].concat());
    assert_eq!(status(&output), 3, "{}", errors(&output));
    json(&output)["violations"][0]["simulator"].as_str().expect("a text").into()
}

/// Two refusals violate it, the second one after a second.
fn tries(condition: &str) -> String {
    format!(
        "local tries: int 0..9;
        initial state Waiting {{ when {condition} -> Going {{ go(1); }} }}
        state Going {{ when failed -> Failed {{ tries += 1; }} }}
        state Failed {{ when after 1 s -> Going {{ go(1); }} }}
        invariant tries < 2;"
    )
}

#[test]
fn a_run_of_the_file_ends_as_that_which_was_replayed() {
    for (name, condition, scenario) in [
        ("file_without_orders", "after 10 ms", r#"{"time_limit_s": 60}"#),
        (
            "file_with_operator",
            "pressed",
            r#"{"time_limit_s": 60, "operator": [{"robot": "pad", "part": "start", "at_s": 0.5}]}"#,
        ),
    ] {
        let folder = put(name, &tries(condition), scenario);
        let said = simulator(&folder, &["--counterexample", "found.json"]);
        assert!(said.contains("the same transitions have fired") && said.contains("tries < 2"), "{said}");
        let test =
            r#"layout "line.json"; scenario "found.json"; test "run" { expect fault "tries < 2" of pad; }"#;
        fs::write(folder.join("found.test"), test).expect("a file that can be written");
        let output = autogen(&folder, &["test", "found.test"]);
        assert_eq!(status(&output), 0, "{name}: {}{}", printed(&output), errors(&output));
    }
}

#[test]
fn transitions_that_have_not_fired_are_not_said_to_have() {
    for (name, automaton) in [
        (
            "other_fault",
            "local n: int 0..1;
            initial state Waiting within 1 s { when pressed -> Counted { n := 1; } }
            final state Counted;
            invariant n = 0;",
        ),
        ("stays", "local n: int 0..1; initial state Counting { when pressed -> Counting { n += 1; } }"),
    ] {
        let said = simulator(&put(name, automaton, r#"{"time_limit_s": 60}"#), &[]);
        assert!(!said.contains("the same transitions"), "{name}: {said}");
    }
}

/// Nobody presses the button in the run.
#[test]
fn a_violation_that_does_not_occur_in_the_run_is_not_said_to() {
    let automaton = "initial -> Waiting {} final state Waiting; invariant not pressed;";
    let folder = put("needs_button", automaton, r#"{"time_limit_s": 2}"#);
    let said = simulator(&folder, &["--report", "page.html"]);
    assert!(said.contains("; the violation does not occur; the run ends: time limit reached"), "{said}");
    let page = fs::read_to_string(folder.join("page.html")).expect("a page");
    assert!(page.contains("but the violation does not occur"));
}

/// What is violated is not promised below.
#[test]
fn what_is_waited_for_can_come_only_if_nothing_else_was_found() {
    let bounds = |name, goal: &str| {
        let automaton = format!(
            "local n: int 0..2;
            whenever n = 1 then n = 2 within 1 s;
            initial -> First {{ n := 1; }}
            state First {{ when pressed -> Second {{ n := {goal}; }} }}
            state Second {{ when pressed -> Second {{}} }}"
        );
        let folder = put(name, &automaton, r#"{"time_limit_s": 60}"#);
        let output = autogen(
            &folder,
            &["verify", "line.json", "--scenario", "scenario.json", "--all", "--format", "json"],
        );
        json(&output)["bounds"].to_string()
    };
    let promise = "can always still come";
    assert!(bounds("is_followed", "2").contains(promise));
    assert!(!bounds("is_never_followed", "0").contains(promise));
    // Another violation ends the search there.
    let violated = bounds("is_violated_instead", "2 * n + 1");
    assert!(violated.contains("can still come, or one of these violations;") && !violated.contains(promise));
}

/// What only a refused command brings about is no end for what is waited for.
#[test]
fn a_violation_after_a_failure_hides_no_obligation() {
    let automaton = "local n: int 0..1;
        invariant not failed;
        whenever true then n = 1 within 1 s;
        initial -> Going { go(1); }
        state Going { when done -> Going { go(1); } when n = 1 -> Going { n := 1; } }";
    let folder = put("hidden_obligation", automaton, r#"{"time_limit_s": 60}"#);
    let arguments = ["verify", "line.json", "--scenario", "scenario.json", "--all", "--format", "json"];
    let found = json(&autogen(&folder, &arguments));
    let kinds: Vec<&str> = (found["violations"].as_array().expect("a list").iter())
        .filter_map(|violation| violation["violation"].as_str())
        .collect();
    assert!(kinds.iter().any(|text| text.contains("cannot be fulfilled")), "{found:#}");
    assert!(kinds.iter().any(|text| text.contains("not failed")), "{found:#}");
}
