//! `autogen why`: lines of `fixtures/why` that were made to stand, each as it is at 20 s. A line is a layout with
//! the types of its name; all of them are made of the devices there.

use autogen::executor::Executor;
use autogen::lower::Project;
use autogen::why::{self, How, Left, Node, Picture, Verdict, Waits, Watch};
use autogen_tests::{Texts, ariac, root, side_by_side, text};
use runtime_sim::line::Pause;
use runtime_sim::run::{Seen, Stepping, run};
use runtime_sim::scan::Controllers;

/// The lines by name.
fn lines() -> Vec<String> {
    let folder = std::fs::read_dir(root().join("tests/fixtures/why")).expect("a folder");
    let names = folder.map(|entry| entry.expect("an entry").file_name().into_string().expect("a name"));
    let mut lines: Vec<String> = names.filter_map(|name| Some(name.strip_suffix(".json")?.into())).collect();
    lines.sort();
    lines
}

fn texts(line: &str) -> Texts {
    let part = |name: &str| text(&format!("tests/fixtures/why/{name}"));
    Texts {
        layout: part(&format!("{line}.json")),
        specs: vec![part("devices.aut"), part(&format!("{line}.aut"))],
        scenario: Some(r#"{"time_limit_s": 30}"#.into()),
        ..Texts::default()
    }
}

#[test]
fn lines_that_stand_say_why() {
    for line in lines() {
        let outcome = texts(&line).compile();
        let found = autogen_tests::plain(&outcome.sources, &outcome.diagnostics);
        let project = outcome.project.unwrap_or_else(|| panic!("{found}"));
        let mut watch = Watch::new(&project.system, 2000);
        let report =
            run(&project.plant, &mut watch, Stepping::Events, &mut |_| {}).expect("a line that runs");
        let (picture, _) = watch.finish(report.scans);
        let machines: String =
            picture.machines.iter().map(|machine| why::machine(machine, &outcome.sources) + "\n").collect();
        let chains = why::chains(&picture, &Waits::new(&picture, false));
        insta::assert_snapshot!(line, format!("{machines}{chains}"));
    }
}

fn picture(project: &Project, at: u64, stepping: Stepping) -> Picture {
    let mut line = project.plant.clone();
    line.scenario.time_limit_s = (at + 1) as f64 * f64::from(line.scan_ms) / 1000.0;
    let mut watch = Watch::new(&project.system, at);
    let report = run(&line, &mut watch, stepping, &mut |_| {}).expect("a line that runs");
    watch.finish(report.scans).0
}

/// A part fails exactly if one of its parts does, down to those that read something.
fn is_sound(node: &Node) -> bool {
    let fails = |node: &Node| node.verdict == Verdict::Fails;
    node.parts.iter().all(is_sound) && (node.parts.is_empty() || fails(node) && node.parts.iter().any(fails))
}

#[test]
fn guards_are_taken_apart_as_they_are_tested() {
    for (name, texts) in [("default", ariac("default")), ("tending", side_by_side("tending/tending"))] {
        let project = texts.project();
        let (mut held, mut failed) = (0, 0);
        for at in [1, 2, 3, 77, 1500, 3333, 6001, 9876] {
            let picture = picture(&project, at, Stepping::Events);
            for machine in &picture.machines {
                for tested in &machine.transitions {
                    let fails = tested.clauses.iter().any(|clause| clause.verdict == Verdict::Fails);
                    assert_eq!(tested.holds, !fails, "{name}, {at}: {tested:#?}");
                    assert!(tested.clauses.iter().all(is_sound), "{name}, {at}: {tested:#?}");
                    held += usize::from(tested.holds);
                    failed += usize::from(fails);
                }
            }
        }
        assert!(held > 3 && failed > 20, "{name}: {held}, {failed}");
    }
}

#[test]
fn scans_that_are_left_out_change_no_picture() {
    let project = ariac("default").project();
    for at in [2, 60, 4711, 5000] {
        let [events, every] =
            [Stepping::Events, Stepping::EveryScan].map(|stepping| picture(&project, at, stepping));
        let states = |picture: &Picture| -> Vec<(String, u64, Vec<bool>)> {
            let machines = picture.machines.iter();
            let shown = machines.map(|machine| {
                let holds = machine.transitions.iter().map(|tested| tested.holds).collect();
                (machine.state.clone(), machine.stay_ms, holds)
            });
            shown.collect()
        };
        assert_eq!(states(&events), states(&every), "{at}");
    }
}

/// While the power is off no time passes for the controllers; after it, states are entered anew.
#[test]
fn a_loss_of_power_is_no_time_in_a_state() {
    let mut project = ariac("default").project();
    let off = |at_scan: u64, scans: u64| Pause { at_scan, scans };
    project.plant.scenario.power_offs = vec![off(700, 500), off(1000, 900), off(2500, 30)];
    for at in [699, 700, 701, 1200, 1898, 1899, 1900, 2100, 2500, 2501, 2529, 2530, 2531, 3000] {
        let mut line = project.plant.clone();
        line.scenario.time_limit_s = 40.0;
        let mut executor = Executor::new(&project.system);
        let words = executor.stays();
        let mut stays = Vec::new();
        run(&line, &mut executor, Stepping::EveryScan, &mut |seen: &Seen| {
            if seen.scan == at {
                stays = words.iter().map(|word| seen.trace[*word] as u64).collect();
            }
        })
        .expect("a line that runs");
        for stepping in [Stepping::Events, Stepping::EveryScan] {
            let shown: Vec<u64> =
                picture(&project, at, stepping).machines.iter().map(|machine| machine.stay_ms).collect();
            assert_eq!(shown, stays, "{at}, {stepping:?}");
        }
    }
}

#[test]
fn clauses_become_true_no_later_than_their_transition_fires() {
    let project = ariac("default").project();
    let agv = project.system.instances.iter().position(|i| i.name == "agv2").expect("a vehicle");
    let mut watch = Watch::new(&project.system, 12_000).until_left(vec![agv]);
    let report = run(&project.plant, &mut watch, Stepping::Events, &mut |_| {}).expect("a line that runs");
    let (picture, later) = watch.finish(report.scans);
    let later = later.expect("it was asked for");
    insta::assert_snapshot!("until", why::later(&picture, &later));
    let became = &later.machines[0];
    let Left { at_ms: left, how } = became.left.clone().expect("it leaves its state");
    let How::Fired(by, _) = how else { panic!("it leaves by a transition") };
    assert!(became.transitions[by].1.iter().all(|(_, since)| since.is_some_and(|since| since <= left)));
    assert!(left > picture.at_ms);
}

/// A press whose curtain is interrupted while it goes down, and the values of its properties in words.
fn press_at(at_s: f64) -> Vec<String> {
    let texts = Texts {
        layout: r#"{"robots": [{"name": "press", "type": "Press", "pose": [0, 0, 0]}]}"#.into(),
        specs: vec![
            "device press {
                 part ram = cylinder { extend: 100 ms; retract: 100 ms; };
                 part curtain = button { normally_closed: true; };
                 in free: bool = curtain.on;
                 out down: bool = ram.extend stop false;
             }
             automaton Press on press {
                 invariant free or not down else stop machine \"somebody reaches in\";
                 initial -> Down { down := true; }
                 state Down { when after 10 s -> Down { down := true; } }
             }"
            .into(),
        ],
        scenario: Some(
            r#"{"time_limit_s": 3, "operator": [{"robot": "press", "part": "curtain", "at_s": 1, "for_s": 2}]}"#.into(),
        ),
        ..Texts::default()
    };
    let outcome = texts.compile();
    let found = autogen_tests::plain(&outcome.sources, &outcome.diagnostics);
    let project = outcome.project.unwrap_or_else(|| panic!("{found}"));
    let picture = picture(&project, (at_s * 100.0) as u64, Stepping::EveryScan);
    why::machine(&picture.machines[0], &outcome.sources).lines().map(|line| line.trim().to_string()).collect()
}

/// Properties are shown with the outputs that they saw, so they do not contradict their alarms.
#[test]
fn outputs_of_properties_are_shown_as_they_are_put_out() {
    let raised = press_at(1.0).join("\n");
    assert!(raised.contains(", active,"), "{raised}");
    assert!(raised.contains("FAILS  free or not down"), "{raised}");
    assert!(raised.contains("down is true, by press at 0.0"), "{raised}");
    let after = press_at(1.5).join("\n");
    assert!(after.contains(", no longer active,"), "{after}");
    assert!(after.contains("ok     free or not down"), "{after}");
    assert!(after.contains("down is put out as false; set is true, by press at 0.0"), "{after}");
}
