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

#[test]
fn who_shares_cells_through_a_reference_is_tested_on_the_executor_only() {
    let counted =
        "automaton NAME on pad is Box { initial state Low { when n > 2 -> High {} } final state High; }";
    let counts = |reference: &str| {
        format!(
            "automaton NAME on pad {{
                {reference}
                initial state Counting {{ when after 100 ms, box.n < 9 -> Counting {{ box.n += 1; }} }}
            }}"
        )
    };
    let box_ = "interface Box { shared n: int 0..9 := 0 by counter; }";
    let named = |text: &str, name: &str| text.replace("NAME", name);
    let (parameter, local) = (counts("parameter box: Box;"), counts("local box: Box;"));
    for (name, first, second, parameters, rows) in [
        ("by_another", counted, parameter.as_str(), ["", r#""box": "m0""#], "1 s: -> Low, n = 0;"),
        ("to_another", &parameter, counted, [r#""box": "m1""#, ""], "1 s: -> Counting;"),
        ("by_a_variable", counted, &local, ["", ""], "1 s: -> Low, n = 0;"),
    ] {
        let specs = [box_, &named(first, "First"), &named(second, "Second")].join("\n");
        let (status, text) = outcome(&format!("test_shares_{name}"), &specs, parameters, rows);
        assert!(text.contains("1 skipped"), "{name}: {text}");
        assert_eq!(status, 0, "{name}: {text}");
    }
}
