//! Tests of one machine on engines on which all machines step.

use super::*;

/// A line of two machines, and the outcome of a test of `m0` on the executor and on the Structured Text.
fn outcome(name: &str, specs: &str, parameters: [&str; 2], rows: &str) -> (i32, String) {
    let folder = folder(name);
    let device = "device pad { part start = button {}; in pressed: bool = start.on; }";
    let [first, second] = parameters;
    let layout = format!(
        r#"{{"specs": "types.aut", "robots": [
            {{"name": "m0", "type": "first", "pose": [0, 0, 0], "parameters": {{{first}}}}},
            {{"name": "m1", "type": "second", "pose": [5, 0, 0], "parameters": {{{second}}}}}
        ]}}"#
    );
    for (file, text) in [
        ("types.aut", format!("{device}\n{specs}")),
        ("line.json", layout),
        ("line.test", format!("layout \"line.json\"; test \"alone\" of m0 {{ {rows} }}")),
    ] {
        fs::write(folder.join(file), text).expect("a file that can be written");
    }
    let output = autogen(&folder, &["test", "line.test", "--on", "executor,st"]);
    (status(&output), String::from_utf8_lossy(&output.stdout).into_owned() + &errors(&output))
}

/// `m1` lasts too long after a second.
const IMPATIENT: &str = "automaton First on pad {
        initial state Waiting { when pressed -> Pressed {} }
        final state Pressed;
    }
    automaton Second on pad {
        initial state Waiting within 1 s { when pressed -> Pressed {} }
        final state Pressed;
    }";

#[test]
fn a_fault_of_another_machine_is_not_that_of_the_tested_one() {
    let none = ["", ""];
    let (status, text) =
        outcome("test_stopped", IMPATIENT, none, "0 s: -> Waiting; 2 s: pressed = true -> Pressed;");
    assert_eq!(status, 0, "{text}");
    assert!(
        text.contains("1 passed, 0 failed, 1 skipped") && text.contains("stops the line by a fault"),
        "{text}"
    );
    let (status, text) = outcome("test_their_fault", IMPATIENT, none, "0 s: -> Waiting; 1 s: -> fault;");
    assert_eq!(status, 3, "{text}");
    assert!(text.contains("0 passed, 1 failed, 1 skipped"), "{text}");
    let (status, text) =
        outcome("test_in_time", IMPATIENT, none, "0 s: -> Waiting; 500 ms: pressed = true -> Pressed;");
    assert_eq!(status, 0, "{text}");
    assert!(text.contains("2 passed, 0 failed"), "{text}");
    let own = IMPATIENT.replacen("Waiting {", "Waiting within 500 ms {", 1);
    let (status, text) =
        outcome("test_own_fault", &own, none, "0 s: -> Waiting; 500 ms: -> fault \"too long\";");
    assert_eq!(status, 0, "{text}");
    assert!(text.contains("2 passed, 0 failed"), "{text}");
}
