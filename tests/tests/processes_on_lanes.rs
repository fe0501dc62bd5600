//! Processes that work on items on a conveyor: the tester and the printer of the test station.

use autogen_tests::{Texts, side_by_side, stepped};

fn station(changes: &[(&str, &str)]) -> Texts {
    side_by_side("scenes/test_station").replaced(changes)
}

fn reason(changes: &[(&str, &str)]) -> String {
    reason_of(&station(changes))
}

fn reason_of(texts: &Texts) -> String {
    stepped::report(texts, |_| {}).reason
}

const COLLECTED: &str = "all items collected";

/// An item of 0.2 m passes the printer in 0.8 s. It is seen in the scan in which its front edge gets there; the printer
/// works from the scan after the next one on.
#[test]
fn an_item_may_move_under_a_process_that_says_so_as_long_as_it_is_there() {
    let time = |time: &str| reason(&[("time: 300 ms;", time)]);
    assert_eq!(time("time: 300 ms;"), COLLECTED);
    assert_eq!(time("time: 760 ms;"), COLLECTED);
    assert_eq!(time("time: 820 ms;"), "interlock of station: a good left the process print before its end");
    let still = [("moving: true; time: 300 ms;", "time: 300 ms;")];
    assert_eq!(
        reason(&still),
        "interlock of station: the process print was started without an item that stands"
    );
}

/// With scans of 100 ms an item may leave and a process end in the same one.
#[test]
fn an_item_that_leaves_in_the_scan_in_which_a_process_ends_has_left_it() {
    let ends = |time: &str| {
        let mut texts = station(&[("time: 300 ms;", time), ("print_at = 2.0;", "print_at = 2.007;")]);
        texts.layout = texts.layout.replacen('{', r#"{"scan_ms": 100, "#, 1);
        reason_of(&texts)
    };
    // Seen from the scan at S on, its front edge is up to 100 ms past the printer then. It works from S + 200 ms on.
    let outcomes: Vec<bool> =
        (50..86).map(|tens| ends(&format!("time: {} ms;", 10 * tens)) == COLLECTED).collect();
    assert!(outcomes[0] && !outcomes[35], "{outcomes:?}");
    assert!(outcomes.is_sorted_by(|a, b| a >= b), "{outcomes:?}");
    let last = outcomes.iter().filter(|outcome| **outcome).count();
    assert!(last % 10 != 0, "it ends with the time for which the item is there, not with a scan: {last}");
}

/// A lift that moves what the stopper holds moves the item.
#[test]
fn an_item_on_a_conveyor_that_is_lifted_moves() {
    let lifted = [
        (
            "part belt = lane { from:",
            "part lift = cylinder { slides: point(0, 0, 0.01); extend: 1 s; retract: 1 s; };\n    part belt = lane { on: lift; from:",
        ),
        ("out push: bool", "out raise: bool = lift.extend;\n    out push: bool"),
        (
            "when testing -> Testing { start_test := false; }",
            "when testing -> Testing { start_test := false; raise := true; }",
        ),
    ];
    assert_eq!(reason(&lifted), "interlock of station: a raw was moved during the process test");
}

/// The belt runs under what the stopper holds.
#[test]
fn an_item_that_a_stopper_holds_stands() {
    assert_eq!(reason(&[]), COLLECTED);
    let early = [
        ("hold_back: bool = pin.extend stop true", "hold_back: bool = pin.extend"),
        (
            "when testing -> Testing { start_test := false; }",
            "when testing -> Testing { start_test := false; hold_back := false; }",
        ),
    ];
    assert_eq!(reason(&early), "interlock of station: a raw was moved during the process test");
}

#[test]
fn a_process_works_on_what_is_at_its_place() {
    let beside = [(
        "test = process {\n        on: belt; at: stop_at - half;",
        "test = process {\n        on: belt; at: stop_at + 0.01;",
    )];
    assert_eq!(reason(&beside), "interlock of station: the process test was started without an item");
    let edge = [(
        "test = process {\n        on: belt; at: stop_at - half;",
        "test = process {\n        on: belt; at: stop_at - 0.001;",
    )];
    assert_eq!(reason(&edge), COLLECTED);
}

/// What became bad is pushed off, what was printed is collected.
#[test]
fn what_a_process_makes_is_seen_from_its_end_on() {
    assert_eq!(reason(&[]), COLLECTED);
    let all_good = [
        ("shares: [0.3]", "shares: [0]"),
        (
            r#""station.store": {"printed": 6}, "station.scrap": {"bad": 2}"#,
            r#""station.store": {"printed": 8}"#,
        ),
    ];
    assert_eq!(reason(&all_good), COLLECTED);
}

#[test]
fn a_process_that_cannot_be_on_a_lane_is_refused() {
    let found = |from: &str, to: &str| {
        let outcome = station(&[(from, to)]).compile();
        assert!(outcome.project.is_none(), "{to}");
        let found = outcome.diagnostics.into_iter();
        found.map(|found| format!("{} {}", found.code, found.message)).collect::<Vec<_>>().join("; ")
    };
    let misfit = |reason: &str| format!("E0711 `station` cannot be built from its device: {reason}");
    for (from, to, message) in [
        (
            "on: belt; at: print_at; moving",
            "on: belt; moving",
            misfit("print has no `at`: belt is a lane, and print is at a place of it"),
        ),
        (
            "at: print_at; moving",
            "at: 2.9; moving",
            misfit("print is 2.900 m from the beginning of a lane of 2.800 m"),
        ),
        (
            "makes: [raw, good];",
            "makes: [raw, good]; frees: true;",
            misfit("test frees items, which come to lie at a place together, and belt is a lane"),
        ),
        (
            r#""printed", "height": 0.1, "size": [0.2, 0.2]"#,
            r#""printed", "height": 0.1, "size": [0.2, 0.25]"#,
            "E0413 `station.print` would make a `printed` of a `good`, which is of another size".into(),
        ),
    ] {
        assert_eq!(found(from, to), message);
    }
    let seat = "part seat = place { at: pose; slots: [point(0, 0, 0)]; by_kind: false; floor: point(0, 0, 0); \
                floor_x: [-0.1, 0.1]; floor_y: [-0.1, 0.1]; }; part print = process { on: seat;";
    for (setting, name) in [("at: 1;", "at"), ("moving: true;", "moving")] {
        let to = format!("{seat} {setting} time");
        let message = misfit(&format!("print has `{name}`, which is for a lane, and seat is a place"));
        assert_eq!(found("part print = process { on: belt; at: print_at; moving: true; time", &to), message);
    }
}

/// What works on another lane of the machine makes nothing of what is on this one.
#[test]
fn a_kind_that_is_made_on_another_lane_does_not_get_here() {
    let elsewhere =
        station(&[("print = process { on: belt; at: print_at;", "print = process { on: chute; at: 0.3;")]);
    let found = elsewhere.compile().diagnostics;
    let codes: Vec<&str> = found.iter().map(|found| found.code).collect();
    assert_eq!(codes, ["E0410"], "{found:?}");
}
