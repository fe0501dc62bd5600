//! What is said of the simulator beside a violation: whether the same transitions have fired.

use autogen::library;
use autogen_search::plant::Faults;
use autogen_tests::replayed::replayed;
use autogen_tests::{Texts, own_line};

/// Of a device with a button that nobody presses.
fn pad(automaton: &str) -> Texts {
    let device = "device pad { part start = button {}; in pressed: bool = start.on; }";
    Texts {
        specs: vec![device.into(), automaton.into()],
        scenario: Some(r#"{"time_limit_s": 60}"#.into()),
        ..Texts::of_layout(r#"{"robots": [{"name": "pad", "type": "counter", "pose": [0, 0, 0]}]}"#)
    }
}

/// Another fault than that of the violation ends the run.
#[test]
fn a_run_that_a_fault_ends_before_has_not_fired_the_same_transitions() {
    let replay = replayed(
        &pad("automaton Counter on pad {
            local n: int 0..1;
            initial state Waiting within 1 s { when pressed -> Counted { n := 1; } }
            final state Counted;
            invariant n = 0;
        }"),
        Faults::All,
    );
    assert_eq!(
        replay.result,
        Err("the line stops at 1.02 s, before all these transitions have fired".into())
    );
}

#[test]
fn a_transition_that_leaves_its_state_has_to_fire_too() {
    let replay = replayed(
        &pad("automaton Counter on pad {
            local n: int 0..1;
            initial state Counting { when pressed -> Counting { n += 1; } }
        }"),
        Faults::All,
    );
    assert_eq!(replay.result, Err("pad waits for something that does not come".into()));
    let replay = replayed(
        &pad("automaton Counter on pad {
            local n: int 0..9;
            initial state Counting { when n = n -> Counting { n += 1; } }
        }"),
        Faults::All,
    );
    assert!(replay.result.is_ok(), "{:?}", replay.result);
    assert!(replay.report.fault.is_some());
}

/// It fires in each scan, and the other one counts.
#[test]
fn a_transition_that_changes_nothing_fires_beside_others() {
    let mut texts = pad("automaton Counter on pad {
            local n: int 0..9;
            initial state Counting { when n = n -> Counting { n += 1; } }
            invariant n < 3;
        }
        automaton Other on pad { initial state Waiting { when not pressed {} } }");
    let other = r#", {"name": "other", "type": "other", "pose": [5, 0, 0]}]"#;
    texts.layout = texts.layout.replace("]}]", &format!("]}}{other}"));
    let replay = replayed(&texts, Faults::All);
    assert!(replay.result.is_ok(), "{:?}", replay.result);
}

/// A machine whose command never ends in the sequence: it is not answered in the run either.
#[test]
fn what_is_not_answered_in_a_sequence_is_not_answered_in_its_run() {
    let types = "device lift {
            part table = positioner { positions: [0, 0.1, 0.5]; slides: point(0, 0, 0.5); speed: 0.1; };
            out goal: int 0..2;
            command 1 go(goal) = table.to(goal);
        }
        interface Counted { shared n: int 0..1 := 0 by counter; }
        automaton Idle on lift {
            shared has_come: bool;
            initial -> Coming { go(1); }
            state Coming { when done or failed -> There { has_come := true; } }
            final state There;
        }
        automaton Counter on lift is Counted {
            knows others: Counted[];
            invariant n = 0 or not exists o in others: o.n > 0;
            initial -> Going { go(1); }
            state Going {
                when done -> Back { n := 1; go(0); }
                when failed -> Going { go(1); }
            }
            state Back { when done or failed -> There { n := 0; } }
            final state There;
        }
        automaton Watch on lift is Counted {
            knows others: Counted[];
            knows idles: Idle[1];
            initial -> Going { go(2); }
            state Going {
                when done, first i in idles with i.has_come -> There {}
                when done -> Waiting { n := 1; }
                when failed -> There {}
            }
            state Waiting { when after 10 s -> There { n := 0; } }
            final state There;
        }";
    let machine =
        |name: &str, y: u32| format!(r#"{{"name": "{name}", "type": "{name}", "pose": [0, {y}, 0]}}"#);
    let machines = [("idle", 0), ("counter", 3), ("watch", 6)].map(|(name, y)| machine(name, y));
    let replay = replayed(
        &Texts {
            specs: vec![types.into()],
            scenario: Some(r#"{"time_limit_s": 60}"#.into()),
            ..Texts::of_layout(format!(r#"{{"robots": [{}]}}"#, machines.join(", ")))
        },
        Faults::All,
    );
    assert!(replay.result.is_ok(), "{:?}", replay.result);
    assert_eq!(replay.report.fault.map(|(_, machine)| machine), Some("counter".into()));
}

/// The buffer with an order of one part.
fn one_part() -> Texts {
    let scenario = r#"{
        "kinds": [{"name": "battery", "height": 0.053}],
        "orders": [{"station": "as1", "parts": {"battery": 1}}]
    }"#;
    Texts { scenario: Some(scenario.into()), ..own_line("buffer") }
}

fn replace(text: &mut String, from: &str, to: &str) {
    assert!(text.contains(from), "{from}");
    *text = text.replace(from, to);
}

/// An item that is lost on the way falls far from both ends of the motion: the arm is not over its source any more.
#[test]
fn what_is_lost_on_the_way_is_lost_there() {
    let mut texts = one_part();
    let behind = "\n        }\n        // The arm";
    let with_lock = format!("misses := 0; held := false;{behind}");
    replace(&mut texts.specs[0], &with_lock, &format!("misses := 0;{behind}"));
    let replay = replayed(&texts, Faults::All);
    assert!(replay.result.is_ok(), "{:?}", replay.result);
    assert!(!replay.report.finished);
}

/// No transition fires when the item is lost.
#[test]
fn what_devices_do_behind_the_last_transition_is_done() {
    let file = library::FILES.iter().find(|(name, _)| *name == "library/kitting.aut");
    let mut kitting = file.expect("a type of the library").1.to_string();
    let promise = "local carries: bool; invariant attached or not grip or not carries; retain all;";
    replace(&mut kitting, "retain all;", promise);
    let lifts = "when done and attached -> Lifting {";
    replace(&mut kitting, lifts, &format!("{lifts} carries := true;"));
    replace(&mut kitting, "when not attached and grip { grip := false; }", "");
    let mut texts = one_part();
    texts.specs.push(kitting);
    let replay = replayed(&texts, Faults::All);
    assert!(replay.result.is_ok(), "{:?}", replay.result);
    assert_eq!(replay.report.fault.map(|(_, machine)| machine), Some("kitting".into()));
}
