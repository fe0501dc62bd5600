//! `new`, `test` and `schema`.

use super::*;

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn a_new_line_passes_its_tests_and_nothing_is_written_over() {
    let folder = folder("new");
    let output = autogen(&folder, &["new", "my line"]);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    assert_eq!(said(&output).lines().filter(|line| line.starts_with("  autogen ")).count(), 3);
    assert!(said(&output).contains("  autogen commission 'my line/line.json'\n"), "{}", said(&output));
    assert!(fs::read_to_string(folder.join("my line/README.md")).expect("a text").starts_with("# my line\n"));
    let readme = fs::read_to_string(folder.join("my line/README.md")).expect("a text");
    assert!(readme.lines().count() <= 12, "{readme}");
    let output = autogen(&folder, &["test", "my line"]);
    assert_eq!(status(&output), 0, "{}{}", said(&output), errors(&output));
    assert!(said(&output).contains("4 passed, 0 failed"), "{}", said(&output));
    assert_eq!(status(&autogen(&folder, &["check", "my line/line.json"])), 0);
    assert_eq!(
        status(&autogen(&folder, &["fmt", "--check", "my line/specs"])),
        0,
        "what is written is formatted"
    );

    let before = contents(&folder);
    for name in ["my line", "my line/line.json"] {
        let output = autogen(&folder, &["new", name]);
        assert_eq!(status(&output), 2, "{name}");
        assert!(errors(&output).contains("choose another name"), "{}", errors(&output));
    }
    assert_eq!(before, contents(&folder));
    fs::create_dir(folder.join("empty")).expect("a folder");
    assert_eq!(status(&autogen(&folder, &["new", "empty"])), 0, "an empty folder is free");
}

/// A shell takes the commands that `new` prints as they are.
#[cfg(unix)]
#[test]
fn the_next_commands_can_be_given() {
    let folder = folder("next_commands");
    for (name, shown) in
        [("-x", "./-x"), ("my line", "'my line'"), ("a\\b", "'a\\b'"), ("it's $HOME", "'it'\\''s $HOME'")]
    {
        let output = autogen(&folder, &["new", "--", name]);
        assert_eq!(status(&output), 0, "{}", errors(&output));
        let commands = said(&output);
        assert!(commands.contains(&format!("  autogen test {shown}\n")), "{commands}");
        let check = commands.lines().find(|line| line.starts_with("  autogen check ")).expect("a command");
        let tool = Path::new(env!("CARGO_BIN_EXE_autogen")).parent().expect("a folder");
        let output = Command::new("sh")
            .args(["-c", &format!("PATH={}:$PATH; {check}", tool.display())])
            .current_dir(&folder)
            .output()
            .expect("a shell");
        assert_eq!(status(&output), 0, "{check}: {}", errors(&output));
    }
}

#[test]
fn the_library_passes_its_tests() {
    let output = autogen(&folder("library_tests"), &["test", &example("ariac2021"), "--quiet"]);
    assert_eq!(status(&output), 0, "{}{}", said(&output), errors(&output));
}

/// The tests of a new line with one text in place of another one.
fn changed(name: &str, file: &str, from: &str, to: &str) -> PathBuf {
    let folder = folder(name);
    assert_eq!(status(&autogen(&folder, &["new", "line", "-q"])), 0);
    let path = folder.join("line").join(file);
    let text = fs::read_to_string(&path).expect("a text");
    assert!(text.contains(from), "{from}");
    fs::write(path, text.replace(from, to)).expect("a file");
    folder
}

#[test]
fn a_failure_is_shown_on_a_time_line_and_in_the_form_of_junit() {
    let folder =
        changed("test_fails", "specs/stamp.aut", "hold_time: time := 500 ms", "hold_time: time := 700 ms");
    let line = folder.join("line/line.json");
    let text =
        fs::read_to_string(&line).expect("a text").replace(r#", "parameters": {"hold_time": 0.5}"#, "");
    fs::write(line, text).expect("a file");
    let output = autogen(&folder, &["test", "line", "--junit", "results.xml"]);
    assert_eq!(status(&output), 3, "{}{}", said(&output), errors(&output));
    let text = said(&output);
    assert!(text.contains("  FAIL  a box is stamped and goes on\n"), "{text}");
    assert!(text.contains("station.test:10: within 600 ms: -> Lifting, press = false;\n"), "{text}");
    assert!(text.contains("       2.400 s  Holding\n"), "{text}");
    assert!(
        text.contains("  -    3.000 s  Lifting\n") && text.contains("  +    3.000 s  Holding\n"),
        "{text}"
    );
    assert!(text.contains("3 passed, 1 failed"), "{text}");
    let xml = fs::read_to_string(folder.join("results.xml")).expect("a file");
    assert!(xml.contains(r#"tests="4" failures="1" skipped="0""#), "{xml}");
    assert!(xml.contains("within 600 ms: -&gt; Lifting"), "{xml}");
    assert_eq!(status(&autogen(&folder, &["test", "line", "--junit", "results.xml"])), 3, "its own file");
    fs::write(folder.join("results.xml"), "mine").expect("a file");
    assert_eq!(status(&autogen(&folder, &["test", "line", "--junit", "results.xml"])), 2);
    assert_eq!(fs::read_to_string(folder.join("results.xml")).expect("a file"), "mine");
}

#[test]
fn what_a_run_lacks_is_said() {
    let folder = changed(
        "test_lacks",
        "station.test",
        "expect contacts = 0;",
        "expect not finished; expect orders > 2; expect never station in Holding; expect fault \"no such\" of station; expect station in Stamping before 1 s; expect reason \"deadlock\";",
    );
    let output = autogen(&folder, &["test", "line"]);
    assert_eq!(status(&output), 3, "{}{}", said(&output), errors(&output));
    let text = said(&output);
    for line in [
        "the run does not reach its goal",
        "orders = 0",
        "station never in Holding",
        "no fault",
        "station in Stamping before 1 s",
        "reason all items collected",
    ] {
        assert!(text.contains(line), "{line}: {text}");
    }
}

#[test]
fn wrong_tests_are_refused_with_their_places() {
    for (from, to, code, said) in [
        ("-> Stopped;", "-> Stoped;", "E0902", "is `Stopped` meant?"),
        ("at_stamp = true ->", "at_stmp = true ->", "E0902", "is `at_stamp` meant?"),
        ("put = true;", "put = 1;", "E0903", "write `true` or `false`"),
        ("100 ms: start", "105 ms: start", "E0903", "every 10 ms"),
        ("100 ms: start", "0 s: start", "E0903", "not later"),
        ("100 ms: start", "100: start", "E0901", "`ms`, `s` or `min`"),
        ("start_button = true -> Loading", "run = true -> Loading", "E0902", "the automaton itself writes"),
        ("of station", "of staton", "E0902", "is `station` meant?"),
        ("expect finished;", "expect finish;", "E0901", "`in`"),
        ("layout \"line.json\";", "", "E0902", "layout \"line.json\""),
        ("layout \"line.json\";", "layout \"../line.json\";", "E0902", "leads out of the folder"),
        ("layout \"line.json\";", "layout \"no.json\";", "E0902", "names \"no.json\""),
        ("stamped = 1", "stamped[0] = 1", "E0903", "not an array"),
        ("is_up = true -> Stopped", "done -> Stopped", "E0902", "has no commands"),
    ] {
        let folder = changed("test_wrong", "station.test", from, to);
        fs::copy(folder.join("line/line.json"), folder.join("line.json")).expect("a file");
        let output = autogen(&folder, &["test", "line"]);
        assert_eq!(status(&output), 1, "{to}: {}{}", self::said(&output), errors(&output));
        let text = errors(&output);
        assert!(text.contains(code) && text.contains(said) && text.contains("station.test:"), "{to}: {text}");
    }
    let folder = folder("test_none");
    for arguments in [&["test", "."][..], &["test", "none.test"], &["test"]] {
        assert_eq!(status(&autogen(&folder, arguments)), 2, "{arguments:?}");
    }
}

#[test]
fn a_test_gives_no_cell_that_its_machine_alone_writes() {
    let folder = folder("test_own_cell");
    fs::copy(example("ariac2021/default.json"), folder.join("line.json")).expect("a copy");
    for (given, is_right) in [("offer", false), ("slot[0]", true), ("taken", true)] {
        let value = if given.starts_with("slot") { "Full" } else { "true" };
        let test =
            format!("layout \"line.json\";\ntest \"a\" of agv1 {{ 1 s: {given} = {value} -> Returning; }}\n");
        fs::write(folder.join("line.test"), test).expect("a file");
        let output = autogen(&folder, &["test", "."]);
        let told = errors(&output).contains("the automaton itself writes `offer`");
        assert_eq!(told, !is_right, "{given}: {}{}", said(&output), errors(&output));
    }
}

#[test]
fn files_with_errors_are_named_behind_the_results() {
    let folder = changed("test_not_run", "specs/stamp.aut", "hold_time: time", "hold_time: tim");
    let output = autogen(&folder, &["test", "line", "--junit", "results.xml"]);
    assert_eq!(status(&output), 1, "{}", errors(&output));
    assert!(errors(&output).contains("error[E0306]"), "{}", errors(&output));
    let last = "no test was run; the tests of line/station.test were not run: see the errors\n";
    assert_eq!(said(&output), last);
    let xml = fs::read_to_string(folder.join("results.xml")).expect("a file");
    assert!(xml.contains("errors=\"1\"") && xml.contains("<error message=\"error[E0306]: "), "{xml}");

    // The tests of another file are run.
    let folder = changed("test_some_run", "station.test", "-> Stopped;", "-> Stopped;");
    fs::write(folder.join("line/wrong.test"), "test").expect("a file");
    let output = autogen(&folder, &["test", "line"]);
    assert_eq!(status(&output), 1, "{}", errors(&output));
    let last = "4 passed, 0 failed; the tests of line/wrong.test were not run: see the errors\n";
    assert!(said(&output).ends_with(last), "{}", said(&output));
    fs::write(folder.join("line/worse.test"), "test").expect("a file");
    let output = autogen(&folder, &["test", "line"]);
    let last = "4 passed, 0 failed; the tests of 2 files were not run: see the errors\n";
    assert!(said(&output).ends_with(last), "{}", said(&output));
}

#[test]
fn the_compiled_controllers_and_the_text_pass_the_same_tests() {
    let folder = folder("test_rust");
    assert_eq!(status(&autogen(&folder, &["new", "line", "-q"])), 0);
    let output = autogen(&folder, &["test", "line", "--on", "executor,rust,st"]);
    assert_eq!(status(&output), 0, "{}{}", said(&output), errors(&output));
    assert!(said(&output).contains("12 passed, 0 failed\n"), "{}", said(&output));
}

/// What the executor and the Structured Text say of the run of a small line.
fn run_of(name: &str, spec: &str, robots: &str, scenario: &str, expected: &str) -> Output {
    let folder = folder(name);
    let write = |name: &str, text: &str| fs::write(folder.join(name), text).expect("a file");
    write("types.aut", spec);
    write("line.json", &format!(r#"{{"specs": "types.aut", "scenario": "run.json", "robots": [{robots}]}}"#));
    write("run.json", scenario);
    write("line.test", &format!("layout \"line.json\"; test \"run\" {{ {expected} }}"));
    autogen(&folder, &["test", "line.test", "--on", "executor,st"])
}

/// Who waits has the same times on all engines, also over a loss of power.
#[test]
fn a_loss_of_power_has_the_same_times_on_all_engines() {
    let spec = "device unit {
            part button = button {};
            part light = lamp { at: pose; colour: red; };
            in pressed: bool = button.on;
            out on: bool = light.on stop false;
        }
        automaton Unit on unit {
            retain all;
            initial -> Off {}
            resume state Off { when after 20 s -> On { on := true; } }
            state On { when pressed -> Off { on := false; } }
        }";
    let robots = r#"{"name": "unit", "type": "unit", "pose": [0, 0, 0]}"#;
    let off = r#"{"time_limit_s": 60, "faults": {"power_offs": [{"at_s": 5, "for_s": 20}]}}"#;
    let output = run_of("test_power_times", spec, robots, off, "expect unit in On before 45 s;");
    let at_45 = said(&output).matches("+             at 45 s\n").count();
    assert_eq!((status(&output), at_45), (3, 2), "{}{}", said(&output), errors(&output));
}

/// A button that must not be pressed, and power is lost from 2 s to 3 s.
fn alarms_of_presses(name: &str, at_s: &[u32], expected: &str) -> Output {
    let spec = "device unit { part button = button {}; in pressed: bool = button.on; }
        automaton Unit on unit {
            invariant not pressed else warn \"do not press\";
            initial state Idle { when false -> Idle {} }
        }";
    let robots = r#"{"name": "unit", "type": "unit", "pose": [0, 0, 0]}"#;
    let press = |at_s| format!(r#"{{"robot": "unit", "part": "button", "at_s": {at_s}, "for_s": 0.3}}"#);
    let presses = at_s.iter().map(press).collect::<Vec<_>>().join(", ");
    let off = r#""faults": {"power_offs": [{"at_s": 2, "for_s": 1}]}"#;
    let scenario = format!(r#"{{"time_limit_s": 8, "operator": [{presses}], {off}}}"#);
    run_of(name, spec, robots, &scenario, expected)
}

#[test]
fn alarms_from_before_a_loss_of_power_count_on_all_engines() {
    for (name, at_s, expected) in [
        ("test_alarm_before", &[1][..], "expect alarm \"do not press\" of unit; expect alarms = 1;"),
        ("test_alarm_again", &[1, 4, 6], "expect alarm \"do not press\" of unit; expect alarms = 3;"),
    ] {
        let output = alarms_of_presses(name, at_s, expected);
        assert_eq!(status(&output), 0, "{}{}", said(&output), errors(&output));
    }
}

#[test]
fn a_test_that_misses_alarms_tells_their_number() {
    let output = alarms_of_presses("test_no_alarm", &[], "expect alarms >= 1;");
    assert!(said(&output).contains("+             alarms = 0\n"), "{}{}", said(&output), errors(&output));
}

/// A button that must not be pressed is pressed at 1 s; the line is reset at 3 s and started at 4 s.
#[test]
fn a_fault_that_is_reset_is_the_same_on_all_engines() {
    let spec = "device unit { part button = button {}; in pressed: bool = button.on; }
        automaton Unit on unit {
            invariant not pressed else stop line \"do not press\";
            initial state Waiting { when after 2 s -> Done {} }
            final state Done;
        }";
    let robots = r#"{"name": "unit", "type": "unit", "pose": [0, 0, 0]}"#;
    let scenario = r#"{"time_limit_s": 8, "operator": [
        {"robot": "unit", "part": "button", "at_s": 1, "for_s": 0.5},
        {"part": "reset", "at_s": 3, "for_s": 0.2}, {"part": "start", "at_s": 4, "for_s": 0.2}]}"#;
    let expected = "expect finished; expect fault \"do not press\" of unit; expect faults = 1; expect unit in Done before 6.05 s;";
    let output = run_of("test_fault_reset", spec, robots, scenario, expected);
    assert_eq!(status(&output), 0, "{}{}", said(&output), errors(&output));
    let output = run_of(
        "test_fault_reset_early",
        spec,
        robots,
        scenario,
        "expect unit in Done before 5.9 s; expect faults = 0;",
    );
    for told in ["+             at 5.99 s\n", "+             faults = 1\n"] {
        assert_eq!(said(&output).matches(told).count(), 2, "{}{}", said(&output), errors(&output));
    }
}

/// A test may pass although its fault did not come: then it says so.
#[test]
fn a_fault_that_a_run_does_not_come_to_is_told() {
    let spec =
        "device unit { part light = lamp { at: pose; colour: red; }; out on: bool = light.on stop false; }
        automaton Unit on unit { initial -> On { on := true; } final state On; }";
    let robots = r#"{"name": "unit", "type": "unit", "pose": [0, 0, 0]}"#;
    let pause = r#"{"time_limit_s": 2, "faults": {"pauses": [{"at_s": 5, "for_s": 1}]}}"#;
    let output = run_of("test_not_reached", spec, robots, pause, "expect finished;");
    let note = "    note: not reached: pause at 5.00 s, as the run ended at 2.00 s; give an earlier time\n";
    let told = said(&output).matches(note).count();
    assert_eq!((status(&output), told), (0, 2), "{}{}", said(&output), errors(&output));
}

/// Two belts that wait for one another stand still on all engines, although times in states go on.
#[test]
fn a_deadlock_is_found_on_all_engines() {
    let spec = "device feeder {
            part belt = lane { from: origin * frame(0, 0, 0.8, 0); length: 1.0; width: 0.12; speed: 0.3; };
            part magazine = source { on: belt; inset: 0.1; };
            part box = sink { of: belt; inset: 0.1; };
            out run: bool = belt.run stop false;
        }
        automaton Feeder on feeder {
            knows others: Feeder[1];
            shared go: bool := false;
            initial state Wait { when exists o in others: o.go -> Run { run := true; go := true; } }
            state Run { when false -> Run {} }
        }";
    let robot =
        |name: &str, y: u32| format!(r#"{{"name": "{name}", "type": "feeder", "pose": [0, {y}, 0]}}"#);
    let robots = [robot("a", 0), robot("b", 2)].join(", ");
    let one = r#"{"kinds": [{"name": "box", "height": 0.1}], "supply": {"items": {"a": ["box"], "b": ["box"]}},
        "goal": {"a.box": {"box": 1}}, "time_limit_s": 300}"#;
    let expected = "expect reason \"deadlock\"; expect simulated < 150;";
    let output = run_of("test_deadlock", spec, &robots, one, expected);
    assert_eq!(status(&output), 0, "{}{}", said(&output), errors(&output));
}

/// What is retained, and what is not: the same on all engines.
#[test]
fn a_test_takes_the_power_away() {
    let retains = "retain stamped;\n    initial -> Stopped {}";
    let folder = changed("test_power", "specs/stamp.aut", "initial -> Stopped {}", retains);
    let test = |last: &str| {
        format!(
            "layout \"line.json\";\ntest \"power\" of station {{
            0 s: not_stopped = true, is_up = true, at_feeder = true, at_stamp = true -> Stopped;
            1 s: start_button = true -> Loading;
            after 30 ms: is_up = false, is_down = true -> Holding;
            after 500 ms: is_up = true -> Lifting;
            after 10 ms: power -> Passing;
            after 10 ms: start_button = false, power off -> stamped = 1, run = false;
            after 10 ms: -> Stopped, {last};
            after 1 s: -> Stopped;
            }}"
        )
    };
    let path = folder.join("line/station.test");
    let write = |text: String| fs::write(&path, text).expect("a file");
    write(test("stamped = 1"));
    let output = autogen(&folder, &["test", "line"]);
    assert!(errors(&output).contains("E0901"), "`power` alone: {}", errors(&output));
    write(test("stamped = 1").replace("power ->", "->"));
    let output = autogen(&folder, &["test", "line", "--on", "executor,rust,st"]);
    assert_eq!(status(&output), 0, "{}{}", said(&output), errors(&output));
    assert!(said(&output).contains("3 passed, 0 failed\n"), "{}", said(&output));
    write(test("stamped = 0").replace("power ->", "->"));
    let output = autogen(&folder, &["test", "line", "--on", "executor,rust,st"]);
    assert_eq!(status(&output), 3, "{}{}", said(&output), errors(&output));
    assert_eq!(said(&output).matches("+    1.560 s  stamped = 1").count(), 3, "{}", said(&output));
    assert_eq!(said(&output).matches("1.550 s  power off").count(), 3, "{}", said(&output));
}

#[test]
fn a_machine_with_a_panel_passes_the_same_tests() {
    let folder = changed("test_panel", "line.json", "\"robots\"", "\"panel\": \"machines\", \"robots\"");
    let output = autogen(&folder, &["test", "line", "--on", "executor,st"]);
    assert_eq!(status(&output), 0, "{}{}", said(&output), errors(&output));
    assert!(said(&output).contains("8 passed, 0 failed\n"), "{}", said(&output));
}

#[test]
fn schemas_are_json_and_know_types_of_ones_own() {
    let folder = folder("schema");
    let of = |arguments: &[&str]| {
        let output = autogen(&folder, &[&["schema"], arguments].concat());
        assert_eq!(status(&output), 0, "{}", errors(&output));
        json(&output)
    };
    assert!(of(&["scenario"])["properties"]["kinds"].is_object());
    let text = of(&["layout"]).to_string();
    assert!(text.contains("orient_range") && !text.contains("lifting_table"));
    let text = of(&["layout", "--specs", &example("scenes/lifting_table.aut")]).to_string();
    assert!(text.contains("lifting_table") && text.contains("warning_time"));
    assert_eq!(status(&autogen(&folder, &["schema", "layout", "--specs", "none"])), 2);
    fs::write(folder.join("a.aut"), "automaton").expect("a file");
    assert_eq!(status(&autogen(&folder, &["schema", "layout", "--specs", "a.aut"])), 1);
}

/// The same on the executor and on the text; a claim that is not so is told with what is.
#[test]
fn alarms_are_expected_and_told() {
    let folder = folder("test_alarms");
    assert_eq!(status(&autogen(&folder, &["new", "line", "-q"])), 0);
    let append = |name: &str, change: &dyn Fn(String) -> String| {
        let path = folder.join("line").join(name);
        let text = fs::read_to_string(&path).expect("a file");
        fs::write(&path, change(text)).expect("a file");
    };
    let property =
        "    whenever at_stamp then not at_stamp within 300 ms else warn \"a box stays\";\n    initial";
    append("specs/stamp.aut", &|text| text.replacen("    initial", property, 1));
    let rows = "test \"it warns\" of station {\n    1 s: at_stamp = true -> no alarm;\n    after 500 ms: -> alarm \"a box stays\";\n}\n";
    let claims = "test \"line\" {\n    expect alarms >= 1;\n    expect alarm \"a box\" of station;\n}\n";
    append("station.test", &|text| text + rows + claims);
    let output = autogen(&folder, &["test", "line", "--on", "executor,st"]);
    assert_eq!(status(&output), 0, "{}{}", said(&output), errors(&output));
    append("station.test", &|text| {
        text.replace("-> no alarm", "-> alarm").replace("alarms >= 1", "alarms = 0")
    });
    let output = autogen(&folder, &["test", "line", "--on", "executor,st"]);
    assert_eq!(status(&output), 3, "{}{}", said(&output), errors(&output));
    for told in ["+    1.000 s  no alarm", "+             alarms = 3"] {
        assert_eq!(said(&output).matches(told).count(), 2, "{told}\n{}", said(&output));
    }
}

#[test]
fn words_of_tests_may_be_names_of_variables() {
    let folder = folder("test_words");
    let automaton = "automaton Own on bin {
        local fault: int 0..9 := 1; local alarm: int 0..9 := 2; local no: int 0..9 := 3;
        initial state S { when after 1 s -> T { fault += 1; alarm += 1; no += 1; } }
        final state T;
    }";
    let layout = r#"{"specs": "own.aut", "robots": [], "stationary": [
        {"name": "own", "type": "own", "pose": [0, 0, 0], "box": [1, 1, 1]}
    ]}"#;
    let test = r#"layout "line.json"; test "words" of own {
        0 s: -> S, fault = 1, alarm = 2, no = 3;
        1 s: -> T, fault = 2, alarm = 3, no = 4, no alarm;
    }"#;
    for (file, text) in [("own.aut", automaton), ("line.json", layout), ("own.test", test)] {
        fs::write(folder.join(file), text).expect("a file that can be written");
    }
    let output = autogen(&folder, &["test", "."]);
    assert_eq!(status(&output), 0, "{}{}", said(&output), errors(&output));
}

const STOPS: &str = "automaton Alpha on bin {
    whenever false then true within 1 s else warn \"never\";
    initial -> S {}
    state S within 50 ms { when false -> S {} }
}
";

/// The text of the file is named as `commission` names it, from wherever the test is run.
#[test]
fn a_reason_does_not_depend_on_the_folder_of_the_command() {
    let folder = folder("test_reason");
    fs::create_dir_all(folder.join("line/specs")).expect("a folder");
    let reason = "(specs/a.aut:4)";
    let layout = r#"{"specs": "specs", "robots": [{"name": "m1", "type": "alpha", "pose": [0, 0, 0]}]}"#;
    let tests = format!("layout \"line.json\";\ntest \"a\" {{ expect reason \"{reason}\"; }}\n");
    for (name, text) in [("specs/a.aut", STOPS), ("line.json", layout), ("line.test", &tests)] {
        fs::write(folder.join("line").join(name), text).expect("a file");
    }
    let output = autogen(&folder, &["sweep", "line/line.json", "--format", "json"]);
    assert!(json(&output)["rows"][0]["reason"].to_string().contains(reason), "{}", said(&output));
    for (from, path) in [(folder.clone(), "line/line.test"), (folder.join("line"), "line.test")] {
        let output = autogen(&from, &["test", path]);
        assert_eq!(status(&output), 0, "{path}: {}{}", said(&output), errors(&output));
    }
    fs::write(folder.join("line/line.test"), tests.replace(reason, "another")).expect("a file");
    let text = said(&autogen(&folder, &["test", "line/line.test"]));
    assert!(text.contains("line/line.test:2: ") && text.contains(reason), "{text}");
    assert!(!text.contains("line/specs"), "{text}");
}
