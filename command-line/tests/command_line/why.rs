//! `why`: what machines wait for at a time of a run.

use super::*;

fn why(more: &[&str]) -> Output {
    let layout = example("ariac2021/default.json");
    autogen(&folder("why"), &[&["why", layout.as_str()][..], more].concat())
}

#[test]
fn a_machine_that_does_not_leave_says_who_is_waited_for() {
    let output = why(&["--at", "120", "--robot", "agv1"]);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("agv1 is in Loading, for 119.23 s"), "{text}");
    assert!(text.contains("FAILS  i = 3: not slot[i] = Promised"), "{text}");
    assert!(text.contains("agv1 (Loading) waits for kitting: agv1.held is true, by kitting"), "{text}");
    assert!(!text.contains("agv3 is in"), "{text}");
}

#[test]
fn scripts_get_the_same() {
    let output = why(&["--at", "120", "--robot", "agv1", "--until", "--format", "json"]);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    let answer = json(&output);
    assert_eq!(answer["at_s"], 120.0);
    let machine = &answer["machines"][0];
    assert_eq!((&machine["name"], &machine["state"]), (&"agv1".into(), &"Loading".into()));
    assert_eq!(machine["chain"][1], "kitting");
    assert_eq!(machine["transitions"][0]["holds"], false);
    let left = answer["until"][0]["left_s"].as_f64().expect("a time");
    assert!(left > 120.0 && answer["until"][0]["to"] == "Moving", "{answer}");
}

#[test]
fn what_is_asked_has_to_be_there() {
    for (more, said) in [
        (["--at", "120", "--robot", "agv9"], "there is no such machine; there are conveyor_belt"),
        (["--at", "soon", "--robot", "agv2"], "--at soon"),
        (["--at", "-1", "--robot", "agv2"], "-1"),
        (["--io-delay", "often", "--robot", "agv2"], "--io-delay takes"),
    ] {
        let output = why(&more);
        assert_eq!(status(&output), 2, "{more:?}");
        assert!(errors(&output).contains(said), "{more:?}: {}", errors(&output));
    }
    let output = why(&["--until"]);
    assert_eq!(status(&output), 2, "--until goes with --at");
}

#[test]
fn a_time_after_the_end_is_the_end() {
    let layout = example("scenes/lifting_table.json");
    let output = autogen(&folder("why_end"), &["why", &layout, "--at", "1000"]);
    assert_eq!(status(&output), 0);
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.starts_with("at 39.99 s\nthe run ends here: time limit reached\n"), "{text}");
}

#[test]
fn only_a_run_that_ended_by_itself_has_ended() {
    let layout = example("scenes/lifting_table.json");
    let why = |at: &str, more: &[&str]| {
        autogen(&folder("why_ended"), &[&["why", &layout, "--at", at][..], more].concat())
    };
    let ended = |at: &str| json(&why(at, &["--format", "json"]))["ended"].clone();
    for at in ["3", "39.98"] {
        assert_eq!(ended(at), Value::Null, "{at}");
        assert!(!String::from_utf8_lossy(&why(at, &[]).stdout).contains("the run ends here"), "{at}");
    }
    for at in ["39.99", "40", "40.5"] {
        assert_eq!(ended(at), "time limit reached", "{at}");
        let text = String::from_utf8_lossy(&why(at, &[]).stdout).into_owned();
        assert!(text.starts_with("at 39.99 s\nthe run ends here: time limit reached\n"), "{at}: {text}");
    }
    assert!(why("3", &["-q"]).stdout.is_empty(), "errors only");
}

/// What is said of a press whose door is open from 2 s on, and of a clerk who waits for it.
fn of_press(name: &str, property: &str, more: &[&str]) -> Output {
    let folder = folder(name);
    let automata = format!(
        "device post {{
    part door = button {{}};
    part glow = lamp {{ at: pose; colour: red; }};
    /// the door is open
    in is_open: bool = door.on;
    /// it glows
    out glows: bool = glow.on stop false;
}}
interface Machine {{ shared is_ready: bool := false by owner; }}
automaton Press on post is Machine {{
    {property}
    initial -> Idle {{}}
    state Idle {{ when after 1 s -> Pressing {{ glows := true; }} }}
    state Pressing {{ when after 3 s -> Idle {{ glows := false; is_ready := true; }} }}
}}
automaton Clerk on bin {{
    knows presses: Machine[1];
    initial state Waiting {{ when exists p in presses: p.is_ready -> Waiting {{}} }}
}}
"
    );
    fs::write(folder.join("press.aut"), automata).expect("a file");
    let layout = r#"{"specs": "press.aut",
        "robots": [{"name": "press", "type": "press", "pose": [0, 0, 0]}],
        "stationary": [{"name": "clerk", "type": "clerk", "pose": [5, 0, 0]}]}"#;
    fs::write(folder.join("line.json"), layout).expect("a file");
    let scenario = r#"{"time_limit_s": 6, "operator": [{"robot": "press", "part": "door", "at_s": 2}]}"#;
    fs::write(folder.join("scenario.json"), scenario).expect("a file");
    let output = autogen(&folder, &[&["why", "line.json"][..], more].concat());
    assert_eq!(status(&output), 0, "{}", errors(&output));
    output
}

fn assert_says(output: &Output, lines: &[&str]) {
    let text = String::from_utf8_lossy(&output.stdout);
    for line in lines {
        assert!(text.contains(line), "{line}\n---\n{text}");
    }
}

const STOPS_MACHINE: &str = "invariant not is_open else stop machine \"the door is open: close it\";";

#[test]
fn a_machine_that_is_stopped_tells_of_its_alarm() {
    let output = of_press("why_stopped", STOPS_MACHINE, &[]);
    assert_says(
        &output,
        &[
            "press is stopped, in Pressing\n",
            "  alarm raised at 2.00 s, active, not acknowledged; it stops the machine: the door is open: close it (press.aut:11)\n",
            "    invariant not is_open\n      FAILS  not is_open\n",
            "is_open is true, by the device of press at 2.00 s\n",
            "clerk (Waiting) waits for press: press.is_ready is false",
            "press (Pressing) is stopped by its alarm: the door is open: close it; to continue: remove the cause, acknowledge, start\n",
        ],
    );
    let output = of_press("why_stopped_json", STOPS_MACHINE, &["--format", "json"]);
    let answer = json(&output);
    let press = &answer["machines"][0];
    assert_eq!((&press["stopped"], &press["transitions"]), (&true.into(), &serde_json::json!([])));
    let property = &press["properties"][0];
    assert_eq!(property["property"], "invariant not is_open");
    assert_eq!((&property["active"], &property["stops"]), (&true.into(), &true.into()));
    assert_eq!(property["clauses"][0]["reads"][0]["changed_by"], "the device of press");
}

#[test]
fn a_line_in_a_fault_tells_of_its_property() {
    let output = of_press("why_fault", "invariant not is_open else \"the door is open\";", &[]);
    assert_says(
        &output,
        &[
            "the line is stopped since 2.00 s by a fault of press: the door is open\n",
            "  fault since 2.00 s: the door is open (press.aut:11)\n    invariant not is_open\n      FAILS  not is_open\n",
        ],
    );
}

#[test]
fn a_property_that_waits_says_since_when_and_until_when() {
    let property = "whenever glows then is_ready or is_open within 2 s else warn \"it takes too long\";";
    let output = of_press("why_waits", property, &["--at", "1.5"]);
    assert_says(
        &output,
        &[
            "  waits since 1.02 s, until 3.02 s at the latest, or: it takes too long (press.aut:11)\n",
            "    whenever glows then is_ready or is_open within 2 s\n      FAILS  then is_ready or is_open\n",
            "      -      whenever glows\n",
            "glows is true, by press at 1.02 s\n",
        ],
    );
    // It held before its time was over.
    let output = of_press("why_waits_no_more", property, &["--at", "3.5"]);
    assert!(!String::from_utf8_lossy(&output.stdout).contains("waits since"));
}

#[test]
fn a_property_over_kept_values_says_who_wrote_them() {
    let property = "keep glows while not is_open else warn \"somebody touched the lamp\";";
    let output = of_press("why_kept", property, &["--at", "1.5"]);
    assert_says(
        &output,
        &[
            "  alarm raised at 1.02 s, no longer active, not acknowledged; it stops nothing: somebody touched",
            "      ok     while not is_open\n",
            "      -      keep glows\n",
            "glows is true, by press at 1.02 s\n",
        ],
    );
}

#[test]
fn a_machine_at_its_panel_says_what_has_to_be_done_there() {
    let layout = example("scenes/by_hand.json");
    for (at, lines) in [
        (
            "7.5",
            &[
                "at its panel: press `panel_step` for each transition",
                "when is_down -> Lifting: does not hold",
            ][..],
        ),
        (
            "14.2",
            &[
                "drill is stopped, in Idle",
                "drill (Idle) is stopped at its panel; to continue: leave manual, `panel_mode` 2, start",
            ],
        ),
        ("27.5", &["drill (Lowering) is stopped at its panel; to continue: set `panel_enable`, start"]),
        ("29", &["drill (Lowering) is stopped, the cause is gone: start"]),
    ] {
        let output = autogen(&folder("why_panel"), &["why", &layout, "--at", at]);
        assert_says(&output, lines);
    }
}

/// The lamp of the door goes out two seconds after the fault.
#[test]
fn inputs_of_a_line_in_a_fault_are_those_of_now() {
    let folder = folder("why_later");
    let automata = "device post { part door = button {}; in is_open: bool = door.on; }
automaton Press on post {
    invariant not is_open else \"the door is open\";
    initial -> Idle {}
    state Idle { when is_open -> Idle {} }
}
";
    fs::write(folder.join("press.aut"), automata).expect("a file");
    let layout =
        r#"{"specs": "press.aut", "robots": [{"name": "press", "type": "press", "pose": [0, 0, 0]}]}"#;
    fs::write(folder.join("line.json"), layout).expect("a file");
    let scenario = r#"{"time_limit_s": 20, "operator": [
        {"robot": "press", "part": "door", "at_s": 2, "for_s": 2},
        {"part": "reset", "at_s": 15, "for_s": 0.2}]}"#;
    fs::write(folder.join("scenario.json"), scenario).expect("a file");
    let why = |at: &str| {
        let output = autogen(&folder, &["why", "line.json", "--scenario", "scenario.json", "--at", at]);
        assert_eq!(status(&output), 0, "{}", errors(&output));
        output
    };
    assert_says(&why("3"), &["is_open is true, by the device of press at 2.00 s"]);
    assert_says(&why("6"), &["is_open is false, by the device of press at 4.00 s"]);
}
