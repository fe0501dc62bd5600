//! Emitted Structured Text follows the hand-written traces, and the judge finds what is wrong with a text.

use crate::long_lines;
use autogen::backend::st;
use autogen::ir::System;
use autogen::source::Sources;
use autogen_st_judge::machine::Machine;
use autogen_st_judge::{faults, judge, listed};
use autogen_tests::st::{Emitted, StructuredText};
use autogen_tests::{Texts, ariac, is_full_campaign, root, text, trace};

fn emitted(system: &System, sources: &Sources) -> Emitted {
    Emitted::of(&st::files(system, sources))
}

/// The text of a layout of the paper.
fn of_layout(layout: &str) -> (autogen::lower::Project, Emitted) {
    let outcome = ariac(layout).compile();
    let project = outcome.project.expect("a layout that can be built");
    let text = emitted(&project.system, &outcome.sources);
    (project, text)
}

#[test]
fn a_state_that_there_is_not_is_a_fault() {
    let (project, text) = of_layout("default");
    for instance in &project.system.instances {
        let mut machine = Machine::new(&text.main).expect("a clean text");
        machine.set("run_permit", 1.0);
        machine.scan().expect("a scan");
        machine.set("start", 1.0);
        machine.set(&format!("{}.state", instance.name), 99.0);
        machine.scan().expect("a scan");
        assert_eq!((machine.get("fault"), machine.get("running")), (1.0, 0.0), "{}", instance.name);
        assert!(machine.branches().iter().any(|b| b.label == "ELSE" && b.entered == 1), "{}", instance.name);
    }
}

/// Retained values are used if they are of this program and of one scan. Otherwise all is as at first, and there is a fault,
/// but for the first power-up ever.
#[test]
fn what_is_retained_is_of_this_program_and_of_one_scan() {
    let (_, text) = of_layout("default");
    let mut machine = Machine::new(&text.main).expect("a clean text");
    machine.set("run_permit", 1.0);
    machine.scan().expect("a scan");
    assert_eq!([machine.get("warm_start"), machine.get("fault_code")], [0.0, 0.0], "the first power-up");
    machine.set("start", 1.0);
    (0..500).for_each(|_| machine.scan().expect("a scan"));
    machine.set("tray_slot[3]", 2.0);
    for (name, value, is_kept) in
        [("fault_code", 0.0, true), ("retained_of", 77.0, false), ("retained_whole", 0.0, false)]
    {
        let mut machine = machine.clone();
        machine.set(name, value);
        machine.power_up();
        machine.set("run_permit", 1.0);
        machine.scan().expect("a scan");
        let found = ["warm_start", "tray_slot[3]", "agv1.state", "fault_code", "fault_robot", "running"]
            .map(|name| machine.get(name));
        let expected = match is_kept {
            // It returns to its start, with its command abandoned.
            true => [1.0, 2.0, 4.0, 0.0, -1.0, 0.0],
            false => [0.0, 0.0, 0.0, 32766.0, -1.0, 0.0],
        };
        assert_eq!(found, expected, "{name}");
        assert_eq!(machine.get("agv1.abandoned"), f64::from(u8::from(is_kept)), "{name}");
    }
}

/// An online change leaves the variables alone; a download initializes them, or only those of the blocks.
#[test]
fn another_program_stops_the_line() {
    let (_, text) = of_layout("default");
    let mut machine = Machine::new(&text.main).expect("a clean text");
    machine.set("run_permit", 1.0);
    machine.scan().expect("a scan");
    machine.set("start", 1.0);
    (0..500).for_each(|_| machine.scan().expect("a scan"));
    machine.set("start", 0.0);
    machine.scan().expect("a scan");
    assert_eq!(machine.get("running"), 1.0);
    let names = ["running", "init_done", "fault_code", "agv1.state"];
    for (values_of, is_kept, expected) in [
        (machine.get("values_of"), true, [1.0, 1.0, 0.0, 4.0]),
        (77.0, true, [0.0, 1.0, 0.0, 4.0]),
        (0.0, false, [0.0, 1.0, 32766.0, 0.0]),
    ] {
        let mut machine = machine.clone();
        machine.set("values_of", values_of);
        if !is_kept {
            machine.set("agv1.kept", 0.0);
        }
        // Buttons that are pressed meanwhile give no edge.
        machine.set("start", 1.0);
        machine.set("reset", 1.0);
        (0..10).for_each(|_| machine.scan().expect("a scan"));
        assert_eq!(names.map(|name| machine.get(name)), expected, "{values_of}");
    }
}

/// A change of a condition, which changes no variable, may read tables that nobody has read before.
#[test]
fn a_program_is_another_one_with_other_texts_or_parameters() {
    let number = |texts: &Texts| {
        let outcome = texts.compile();
        let project = outcome.project.expect("a layout that can be built");
        let main = Emitted::of(&st::files(&project.system, &outcome.sources)).main;
        let behind = main.split("values_of <> ").nth(1).expect("the number of the program");
        behind.split(' ').next().expect("a word").to_string()
    };
    let own = number(&ariac("default"));
    assert_eq!(own, number(&ariac("default")));
    assert_ne!(own, number(&ariac("default").set("agv.capacity=4")));
    let mut other = ariac("default");
    other.layout = other.layout.replacen("4.675404", "4.675405", 1);
    assert_ne!(own, number(&other));
}

/// Some controllers retain what they were told to, one variable at a time. Blocks and structures that were not kept
/// are found, in each flavour.
#[test]
fn what_is_retained_was_kept_everywhere() {
    let outcome = ariac("default").compile();
    let project = outcome.project.expect("a layout that can be built");
    let files = st::files(&project.system, &outcome.sources);
    let flat = Emitted::of(&files);
    let blocks = ["agv1", "conveyor_belt", "gantry"].map(|robot| format!("{robot}.kept"));
    let structures = ["tray_cells_kept[0]", "source_cells_kept[0]"].map(String::from);
    let structured = || blocks.iter().chain(&structures).cloned().collect();
    let codesys = Emitted::of_codesys(&files).expect("objects without a finding");
    let scl = Emitted::of_scl(&files).expect("a source without a finding");
    let flavours: [(&Emitted, &str, Vec<String>); 3] = [
        (&flat, "tray_slot[3]", blocks.to_vec()),
        (&codesys, "tray_cells_slot[3]", structured()),
        (&scl, "tray_cells_slot[3]", structured()),
    ];
    for (text, slot, marks) in flavours {
        let mut machine = Machine::new(&text.main).expect("a clean text");
        machine.set("run_permit", 1.0);
        machine.scan().expect("a scan");
        machine.set("start", 1.0);
        (0..500).for_each(|_| machine.scan().expect("a scan"));
        machine.set(slot, 2.0);
        for lost in std::iter::once(None).chain(marks.into_iter().map(Some)) {
            let mut machine = machine.clone();
            machine.power_up();
            lost.iter().for_each(|mark| machine.set(mark, 0.0));
            machine.set("run_permit", 1.0);
            machine.scan().expect("a scan");
            let found = ["warm_start", slot, "agv2.state", "fault_code", "fault_robot", "running"];
            let expected = match lost {
                None => [1.0, 2.0, 4.0, 0.0, -1.0, 0.0],
                Some(_) => [0.0, 0.0, 0.0, 32766.0, -1.0, 0.0],
            };
            assert_eq!(found.map(|name| machine.get(name)), expected, "{lost:?}");
            // The next loss finds everything kept again.
            machine.power_up();
            machine.scan().expect("a scan");
            assert_eq!(machine.get("warm_start"), 1.0, "{lost:?}");
        }
    }
}

/// Most of its vehicles get to none of most stations: a loop gives that to all, and the others get theirs behind it.
#[test]
fn a_long_table_has_all_its_values_after_the_first_scan() {
    let outcome = Texts::of_layout(long_lines::copies(4)).compile();
    let system = outcome.project.expect("a line that is right").system;
    let text = emitted(&system, &outcome.sources).main;
    judge(&text).unwrap_or_else(|findings| panic!("{}", listed(&findings, &text)));
    let mut machine = Machine::new(&text).expect("a clean text");
    machine.scan().expect("a scan");
    let wanted: Vec<bool> = system.reaches.iter().flatten().flatten().copied().collect();
    assert_eq!((wanted.len(), wanted.iter().filter(|holds| **holds).count()), (256, 64));
    let found = (0..wanted.len()).map(|i| machine.get(&format!("tray_reaches_demand[{i}]")) != 0.0);
    assert_eq!(found.collect::<Vec<_>>(), wanted);
    assert_eq!(
        text.matches("tray_reaches_demand[").count(),
        64 + 2,
        "a loop, a use and those that get there"
    );
}

/// Where a text differs, it is written to the folder that AUTOGEN_ST names.
fn keep(name: &str, text: &str) {
    if let Some(folder) = std::env::var_os("AUTOGEN_ST") {
        std::fs::write(std::path::Path::new(&folder).join(format!("{name}.st")), text).expect("a folder");
    }
}

#[test]
fn hand_written_traces_are_followed() {
    let mut wrong = Vec::new();
    let mut differ = Vec::new();
    let mut paths: Vec<_> = std::fs::read_dir(root().join("tests/fixtures/trace"))
        .expect("the folder of traces")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    paths.sort();
    for path in &paths {
        let fixture = trace::load(&std::fs::read_to_string(path).expect("a text")).expect("a trace");
        let files = st::files(&fixture.system, &fixture.sources);
        let flavours = [
            ("", Ok(Emitted::of(&files))),
            (" in CODESYS", Emitted::of_codesys(&files)),
            (" in SCL", Emitted::of_scl(&files)),
        ];
        for (flavour, text) in flavours {
            let outcome = text.as_ref().map_err(Clone::clone).and_then(|text| {
                let mut engine = StructuredText::new(&fixture.system, text)?;
                let compared = trace::compare(&fixture, &mut engine);
                engine.ended.map_or(compared, Err)
            });
            if let Err(error) = outcome {
                let name = path.file_stem().expect("a name").to_string_lossy().into_owned() + flavour;
                keep(&name, &text.unwrap_or_default().main);
                wrong.push(format!("{name}: {error}"));
                differ.push(name);
            }
        }
    }
    println!("{} traces, {} wrong\n{}", paths.len(), wrong.len(), wrong.join("\n"));
    assert!(differ.is_empty(), "{}", wrong.join("\n\n"));
}

/// A controller may be set to stop at an operation that IEEE 754 calls invalid. The fault is to come instead.
#[test]
fn what_is_not_finite_is_found_without_an_invalid_operation() {
    let fixture = trace::load(&text("tests/fixtures/trace/finite_numbers.trace")).expect("a trace");
    let emitted = emitted(&fixture.system, &fixture.sources);
    let mut engine = StructuredText::new(&fixture.system, &emitted).expect("a clean text");
    trace::compare(&fixture, &mut engine).expect("the trace");
    assert_eq!(engine.machine.invalid_operations(), 0, "{}", emitted.main);
}

#[test]
fn every_fault_seeded_into_the_default_layout_is_found() {
    let text = of_layout("default").1.main;
    let checked = judge(&text).unwrap_or_else(|findings| panic!("{}", listed(&findings, &text)));
    let places = if is_full_campaign() { 10 } else { 3 };
    let rows = faults::seed(&text, &checked, places, 1);
    println!("{}", faults::table(&rows));
    assert!(rows.iter().all(|row| row.caught == row.seeded), "{}", faults::table(&rows));
}

/// A scan in which the clock of the PLC shows `ms`.
fn at(machine: &mut Machine, ms: i64) -> [f64; 3] {
    machine.set("clock_ms", (ms % (1 << 31)) as f64);
    machine.scan().expect("a scan");
    ["running", "fault_code", "watchdog.passed_ms"].map(|name| machine.get(name))
}

/// The line of the paper at power-up, with its permit.
fn permitted() -> Machine {
    let mut machine = Machine::new(&of_layout("default").1.main).expect("a clean text");
    machine.set("run_permit", 1.0);
    machine
}

/// The clock begins again in the middle of it.
#[test]
fn a_line_runs_while_its_task_keeps_its_time() {
    let mut machine = permitted();
    let first = (1i64 << 31) - 1500;
    at(&mut machine, first);
    machine.set("start", 1.0);
    for scan in 1..=300 {
        // No task is exact.
        let found = at(&mut machine, first + 10 * scan + scan % 2);
        let passed = if scan % 2 == 1 { 11.0 } else { 9.0 };
        assert_eq!(found, [1.0, 0.0, passed], "scan {scan}");
    }
    assert_eq!(machine.get("watchdog.hundred_scans_ms"), 1000.0);
    assert_eq!(at(&mut machine, first + 3100), [1.0, 0.0, 100.0], "as late as it may come");
    assert_eq!(at(&mut machine, first + 3201), [0.0, 32765.0, 101.0], "too late");
}

/// So a PLC that was stopped while the line was running does not go on by itself.
#[test]
fn a_scan_that_comes_late_stops_the_line_that_runs() {
    let mut machine = permitted();
    at(&mut machine, 0);
    assert_eq!(at(&mut machine, 5000), [0.0, 0.0, 5000.0], "it does not run");
    machine.set("start", 1.0);
    assert_eq!(at(&mut machine, 5010), [1.0, 0.0, 10.0]);
    assert_eq!(at(&mut machine, 9000), [0.0, 32765.0, 3990.0]);
    assert_eq!(machine.get("agv1_hold"), 1.0);
    machine.set("reset", 1.0);
    assert_eq!(at(&mut machine, 9010), [0.0, 0.0, 10.0], "start is no edge");
    machine.set("start", 0.0);
    at(&mut machine, 9020);
    machine.set("start", 1.0);
    assert_eq!(at(&mut machine, 9030), [1.0, 0.0, 10.0]);
}

/// Half as fast as it says, or so fast again: the line does not start.
#[test]
fn a_line_does_not_start_with_another_interval_than_its_own() {
    for (interval, expected) in [
        (5, [0.0, 32764.0]),
        (8, [0.0, 32764.0]),
        (10, [1.0, 0.0]),
        (12, [0.0, 32764.0]),
        (90, [0.0, 32764.0]),
    ] {
        let mut machine = permitted();
        (0..150).for_each(|scan| assert_eq!(at(&mut machine, interval * scan)[..2], [0.0, 0.0]));
        machine.set("start", 1.0);
        assert_eq!(at(&mut machine, interval * 150)[..2], expected, "{interval} ms");
        machine.set("start", 0.0);
        machine.set("dt_ms", interval as f64);
        machine.set("reset", 1.0);
        at(&mut machine, interval * 151);
        machine.set("start", 1.0);
        assert_eq!(at(&mut machine, interval * 152)[..2], [1.0, 0.0], "{interval} ms, and it says so");
    }
}

/// A lamp with a panel; the line runs or not.
fn lamp_by_hand(runs: bool) -> Machine {
    let texts = Texts {
        layout: r#"{"panel": "machines", "robots": [{"name": "a", "type": "A", "pose": [0, 0, 0]}]}"#.into(),
        specs: vec![
            "device stand { part lamp = lamp { at: pose; colour: red; }; out on: bool = lamp.on stop false; }
             automaton A on stand { initial -> S { } state S { when after 1 s -> S { on := not on; } } }"
                .into(),
        ],
        ..Texts::default()
    };
    let outcome = texts.compile();
    let project = outcome.project.unwrap_or_else(|| panic!("{:?}", outcome.diagnostics));
    let mut machine = Machine::new(&emitted(&project.system, &outcome.sources).main).expect("a clean text");
    ["run_permit", "a_panel_enable", "a_panel_on"].iter().for_each(|name| machine.set(name, 1.0));
    machine.set("a_panel_mode", 2.0);
    at(&mut machine, 0);
    machine.set("start", f64::from(u8::from(runs)));
    at(&mut machine, 10);
    machine.set("a_panel_jog", 1.0);
    assert_eq!(at(&mut machine, 20)[0], f64::from(u8::from(runs)));
    assert_eq!(machine.get("a_on"), 1.0, "by hand");
    machine
}

/// A late scan is for the panels as one without `run_permit`: the button has to be released first.
#[test]
fn a_scan_that_comes_late_ends_what_is_moved_by_hand() {
    for (runs, fault) in [(false, 0.0), (true, 32765.0)] {
        let mut machine = lamp_by_hand(runs);
        assert_eq!(at(&mut machine, 3_600_020), [0.0, fault, 3_600_000.0]);
        assert_eq!(machine.get("a_on"), 0.0, "late, runs: {runs}");
        for scan in 1..=5 {
            at(&mut machine, 3_600_020 + 10 * scan);
            assert_eq!(machine.get("a_on"), 0.0, "the button is still pressed, runs: {runs}");
        }
        machine.set("a_panel_jog", 0.0);
        at(&mut machine, 3_600_080);
        machine.set("a_panel_jog", 1.0);
        at(&mut machine, 3_600_090);
        assert_eq!(machine.get("a_on"), 1.0, "released and pressed, runs: {runs}");
    }
}

#[test]
fn a_device_without_a_description_has_no_comment() {
    let comment = |description: &str| {
        let types = format!(
            "{description}
            device signal {{ part lamp = lamp {{ at: pose; colour: green; }}; out on: bool = lamp.on; }}
            automaton Signal on signal {{ initial -> Lit {{ on := true; }} state Lit {{ when false -> Lit {{}} }} }}"
        );
        let texts = Texts {
            layout: r#"{"robots": [{"name": "signal", "type": "signal", "pose": [0, 0, 0]}]}"#.into(),
            specs: vec![types],
            scenario: Some(r#"{"time_limit_s": 1}"#.into()),
            ..Texts::default()
        };
        let outcome = texts.compile();
        let main = emitted(&outcome.project.expect("a line").system, &outcome.sources).main;
        main.lines().find(|line| line.contains("On the device")).map(|line| line.trim().to_owned())
    };
    assert_eq!(comment("/// A lamp on a post."), Some("On the device signal: A lamp on a post.".into()));
    assert_eq!(comment(""), None);
}
