//! What is said of the simulator beside a violation: whether the same transitions have fired.

use autogen_search::plant::Faults;
use autogen_tests::Texts;
use autogen_tests::replayed::replayed;

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
