//! A gripper's `attached` over another bus than the answers of its arm.

use autogen::executor::Executor;
use autogen_tests::{Texts, own_line};
use runtime_sim::run::{Recorded, Stepping, record};

/// Both arms work in it: one puts the part onto a table, the other takes it from there.
fn line(faults: &str) -> Texts {
    let scenario = format!(
        r#"{{
            "kinds": [{{"name": "battery", "height": 0.053}}],
            "orders": [{{"station": "as1", "parts": {{"battery": 1}}}}],
            "supply": {{"surplus": [4, 1], "every_s": 8}},
            "time_limit_s": 300,
            "faults": {{"sensors": [{faults}]}}
        }}"#
    );
    Texts { scenario: Some(scenario), ..own_line("buffer") }
}

/// The run, and when the arm enters each of its states, ms.
fn run(faults: &str, arm: &str) -> (Recorded, Vec<(u64, String)>) {
    let project = line(faults).project();
    let mut executor = Executor::new(&project.system);
    let run = record(&project.plant, &mut executor, Stepping::Events, &[], &mut |_| {});
    let run = run.expect("a line that can be run");
    let machine = project.system.instances.iter().position(|instance| instance.name == arm);
    let machine = machine.expect("an arm of the line");
    let states = &project.system.automaton_of(machine).states;
    let stays = &run.history.machines[machine].stays;
    let entered = stays.iter().map(|stay| (stay.scan * 10, states[stay.state].name.clone()));
    let mut entered: Vec<(u64, String)> = entered.collect();
    entered.dedup_by(|next, before| next.1 == before.1);
    (run, entered)
}

fn first(entered: &[(u64, String)], state: &str) -> Option<u64> {
    entered.iter().find(|(_, name)| name == state).map(|(ms, _)| *ms)
}

/// The faults in which `attached` reads false until so many ms after the scan in which it is true at first.
fn late(arm: &str, shown_ms: u64, late_ms: u64) -> String {
    let (at_s, for_s) = ((shown_ms - 100) as f64 / 1000.0, (100 + late_ms) as f64 / 1000.0);
    format!(r#"{{"robot": "{arm}", "signal": "attached", "reads": false, "at_s": {at_s}, "for_s": {for_s}}}"#)
}

/// Each arm, and the state in which it goes on when it holds a part.
const ARMS: [(&str, &str); 2] = [("kitting", "Lifting"), ("gantry", "Carrying")];

#[test]
fn a_part_that_is_shown_after_the_end_of_the_command_is_no_loss() {
    for (arm, holding) in ARMS {
        let (_, plain) = run("", arm);
        let shown = first(&plain, holding).expect("a part is gripped");
        for late_ms in [10, 30, 190] {
            let (late, entered) = run(&late(arm, shown, late_ms), arm);
            assert!(late.report.finished, "{arm}, {late_ms} ms: {}", late.report.reason);
            assert_eq!(first(&entered, holding), Some(shown + late_ms), "{arm}: {entered:?}");
            assert_eq!(entered.len(), plain.len() + 1, "{arm}: {entered:?}");
        }
    }
}

/// The part stays where it was, and is taken again, or another one.
#[test]
fn a_part_that_is_not_shown_in_time_is_let_go_where_it_was() {
    for (arm, holding) in ARMS {
        let (_, plain) = run("", arm);
        let shown = first(&plain, holding).expect("a part is gripped");
        let (late, entered) = run(&late(arm, shown, 1000), arm);
        assert!(late.report.finished, "{arm}: {}", late.report.reason);
        let missing = first(&entered, "Missing").expect("a grip that has failed");
        let confirming = first(&entered, "Confirming").expect("a wait");
        assert!((200..=230).contains(&(missing - confirming)), "{arm}: {entered:?}");
        assert!(first(&entered, holding).is_some_and(|ms| ms > missing), "{arm}: {entered:?}");
    }
}
