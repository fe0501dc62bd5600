//! `verify --counterexample`: the scenario of a violation, and what is said of its run.

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
