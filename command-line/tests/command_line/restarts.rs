//! `compare` and `why` of lines that begin with other values, or begin anew after a loss of power or after a person has
//! moved a machine.

use super::*;

/// A desk with a button and a lamp.
const DEVICE: &str = "device desk {
    part start = button {};
    part l = lamp { at: pose + point(0, 0, 1); colour: yellow; };
    in on_button: bool = start.on;
    out light: bool = l.on stop false;
}
";

/// Writes a line of one desk with this automaton, and returns its layout.
fn put_desk(folder: &Path, name: &str, panel: &str, automaton: &str, scenario: &str) -> String {
    let write = |name: &str, text: &str| fs::write(folder.join(name), text).expect("a file");
    write(&format!("{name}.aut"), &format!("{DEVICE}automaton Desk on desk {{\n{automaton}\n}}\n"));
    write(&format!("{name}.scenario.json"), scenario);
    let layout = format!(
        r#"{{"name": "desk", "panel": "{panel}", "specs": "{name}.aut", "scenario": "{name}.scenario.json",
            "robots": [{{"name": "d", "type": "desk", "pose": [0, 0, 0]}}]}}"#
    );
    write(&format!("{name}.json"), &layout);
    format!("{name}.json")
}

/// The button is pressed at 1 s, and power is lost from 2 s to 3 s.
const LOSES_POWER: &str = r#"{"time_limit_s": 8, "operator": [{"robot": "d", "part": "start", "at_s": 1, "for_s": 0.3}],
    "faults": {"power_offs": [{"at_s": 2, "for_s": 1}]}}"#;

/// The button is pressed at 1 s; the desk is moved by hand at 3 s, and the line goes on at 6 s.
const BY_HAND: &str = r#"{"time_limit_s": 8, "operator": [
    {"robot": "d", "part": "start", "at_s": 1, "for_s": 0.3},
    {"robot": "d", "part": "panel_mode", "value": 2, "at_s": 2, "for_s": 3},
    {"robot": "d", "part": "panel_jog", "at_s": 3, "for_s": 1},
    {"part": "start", "at_s": 6, "for_s": 0.2}]}"#;

/// Counts to 9 at the button, and stays in `Counted`.
fn counting(n: u8, retain: &str, counted: &str) -> String {
    format!(
        "    local n: int 0..9 := {n};
    {retain}
    initial -> Idle {{}}
    resume state Idle {{ when on_button and n < 9 -> Counted {{ n := 9; }} }}
    {counted} state Counted {{ when n > 9 - 1 and on_button and light -> Idle {{}} }}"
    )
}

/// Status and output of a comparison of two desks.
fn compared(name: &str, panel: &str, automata: [&str; 2], scenario: &str) -> (i32, String) {
    let folder = folder(name);
    let layouts: Vec<String> = ["a", "b"]
        .iter()
        .zip(automata)
        .map(|(name, automaton)| put_desk(&folder, name, panel, automaton, scenario))
        .collect();
    let output = autogen(&folder, &["compare", &layouts[0], &layouts[1]]);
    (status(&output), String::from_utf8_lossy(&output.stdout).into_owned() + &errors(&output))
}

#[test]
fn initial_values_make_runs_different() {
    let automata = [counting(0, "", ""), counting(5, "", "")];
    let (status, text) =
        compared("restart_initial", "line", automata.each_ref().map(String::as_str), LOSES_POWER);
    assert_eq!(status, 3, "{text}");
    assert!(text.contains("first difference at 0.00 s, in scan 0: first, second\n  d.n: 0, 5\n"), "{text}");
}

#[test]
fn what_a_loss_of_power_resets_makes_runs_different() {
    let automata = [counting(0, "retain n;", ""), counting(0, "", "")];
    let automata = automata.each_ref().map(String::as_str);
    let (status, text) = compared("restart_power", "line", automata, LOSES_POWER);
    assert_eq!(status, 3, "{text}");
    assert!(
        text.contains("first difference at 3.00 s, in scan 300: first, second\n  d.n: unchanged, 0\n"),
        "{text}"
    );
    let (status, text) = compared("restart_power_same", "line", [automata[1]; 2], LOSES_POWER);
    assert_eq!(status, 0, "{text}");
}

#[test]
fn what_begins_anew_after_it_was_moved_by_hand_makes_runs_different() {
    let automata = [counting(0, "retain n;", ""), counting(0, "", "")];
    let automata = automata.each_ref().map(String::as_str);
    let (status, text) = compared("restart_by_hand", "machines", automata, BY_HAND);
    assert_eq!(status, 3, "{text}");
    assert!(
        text.contains("first difference at 6.01 s, in scan 601: first, second\n  d.n: unchanged, 0\n"),
        "{text}"
    );
}

#[test]
fn an_alarm_of_one_run_makes_runs_different() {
    let warns = |condition: &str| {
        format!(
            "    invariant {condition} else warn \"do not press\";\n    initial state Idle {{ when false -> Idle {{}} }}"
        )
    };
    let automata = [warns("not on_button"), warns("not on_button or not light")];
    let (status, text) =
        compared("restart_alarm", "line", automata.each_ref().map(String::as_str), LOSES_POWER);
    assert_eq!(status, 3, "{text}");
    let alarm = "  d, alarms: do not press (active, not acknowledged), unchanged\n";
    assert!(
        text.contains(&format!("first difference at 1.00 s, in scan 100: first, second\n{alarm}")),
        "{text}"
    );
}

/// What `why` says of a desk with this automaton.
fn why(name: &str, panel: &str, automaton: &str, scenario: &str, more: &[&str]) -> Output {
    let folder = folder(name);
    let layout = put_desk(&folder, "a", panel, automaton, scenario);
    let output = autogen(&folder, &[&["why", &layout][..], more].concat());
    assert_eq!(status(&output), 0, "{}", errors(&output));
    output
}

fn assert_says(output: &Output, line: &str) {
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains(line), "{line}\n---\n{text}");
}

#[test]
fn a_loss_of_power_is_named_as_what_has_reset_a_value() {
    let counts = counting(0, "", "");
    let output = why("restart_why_power", "line", &counts, LOSES_POWER, &["--at", "4"]);
    assert_says(&output, "n is 0, by the loss of power at 3.00 s\n");
    assert_says(&output, "on_button is false, by the device of d at 1.30 s\n");
}

#[test]
fn a_machine_that_begins_anew_has_left_its_state_by_no_transition() {
    let asked = ["--at", "1.5", "--until"];
    let counts = counting(0, "", "");
    let output = why("restart_until_power", "line", &counts, LOSES_POWER, &asked);
    assert_says(&output, "d leaves Counted at 3.00 s: it has lost its power, and begins anew\n");
    let output =
        why("restart_until_resumed", "line", &counting(0, "retain all;", "resume"), LOSES_POWER, &asked);
    assert_says(&output, "d stays in Counted to the end of the run\n");
    let output = why("restart_until_by_hand", "machines", &counts, BY_HAND, &asked);
    assert_says(&output, "d leaves Counted at 6.01 s: it was moved by hand, and begins anew\n");
    let in_json = [&asked[..], &["--format", "json"]].concat();
    let answer = json(&why("restart_until_json", "line", &counts, LOSES_POWER, &in_json));
    let until = &answer["until"][0];
    assert_eq!((&until["left_s"], &until["begins_anew"]), (&3.0.into(), &"loss of power".into()), "{answer}");
    assert!(until["to"].is_null(), "{answer}");
}

#[test]
fn a_machine_that_begins_anew_by_hand_has_reset_its_values() {
    let output = why("restart_why_by_hand", "machines", &counting(0, "", ""), BY_HAND, &["--at", "7"]);
    assert_says(&output, "n is 0, by d at 6.01 s\n");
}

#[test]
fn inputs_that_differ_after_a_loss_of_power_have_changed_then() {
    let pressed = |for_s: &str| {
        LOSES_POWER.replace(r#""at_s": 1, "for_s": 0.3"#, &format!(r#""at_s": 1.5, "for_s": {for_s}"#))
    };
    let counts = counting(0, "", "");
    let output = why("restart_input_off", "line", &counts, &pressed("1"), &["--at", "4"]);
    assert_says(&output, "on_button is false, by the device of d at 3.00 s\n");
    let output = why("restart_input_on", "line", &counts, &pressed("5"), &["--at", "4"]);
    assert_says(&output, "on_button is true, by the device of d at 1.50 s\n");
}

#[test]
fn an_alarm_after_a_loss_of_power_has_the_time_of_the_run() {
    let warns = "    invariant not on_button else warn \"do not press\";\n    initial state Idle { when false -> Idle {} }";
    let scenario = LOSES_POWER.replace(r#""at_s": 1,"#, r#""at_s": 4,"#);
    let output = why("restart_why_alarm", "line", warns, &scenario, &["--at", "4.1"]);
    assert_says(&output, "alarm raised at 4.00 s, active");
}
