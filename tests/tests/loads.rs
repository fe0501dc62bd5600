//! Items that bear others: what comes to lie on them, what goes on with them, and who sees it.

use autogen_tests::{Texts, side_by_side, stepped, text};
use runtime_sim::carrier::Carrier;
use runtime_sim::frame::Frame;
use runtime_sim::plant::Plant;
use runtime_sim::point::Point;
use runtime_sim::report::Report;
use runtime_sim::run::Seen;

/// A tray stands under the end of a conveyor, off which these items fall, four seconds after one another; kinds with their
/// height, lengths, and what they bear.
pub fn trays(kinds: &[(&str, f64, [f64; 2], &str)], items: &[&str], more: &str) -> Texts {
    let kind = |(name, height, size, bears): &(&str, f64, [f64; 2], &str)| {
        format!(r#"{{"name": "{name}", "height": {height}, "size": {size:?}{bears}}}"#)
    };
    let kinds: Vec<String> = kinds.iter().map(kind).collect();
    Texts {
        layout: r#"{"robots": [
            {"name": "trays", "type": "trays", "pose": [0, 0, 0, 0]},
            {"name": "chute", "type": "chute", "pose": [0.41, 0.01, 0, 0]}
        ]}"#
        .into(),
        specs: vec![text("tests/fixtures/loads/trays.aut")],
        scenario: Some(format!(
            r#"{{"kinds": [{}], "supply": {{"every_s": 4, "items": {{"trays": ["tray"], "chute": {items:?}}}}}, "time_limit_s": 60{more}}}"#,
            kinds.join(", ")
        )),
        ..Texts::default()
    }
}

pub const FLAT: (&str, f64, [f64; 2], &str) = ("tray", 0.02, [0.3, 0.2], r#", "bears": {}"#);
pub const PIECE: (&str, f64, [f64; 2], &str) = ("piece", 0.05, [0.08, 0.06], "");
pub const BAKED: (&str, f64, [f64; 2], &str) = ("baked", 0.05, [0.08, 0.06], "");
/// Of all items the tray comes first.
const TRAY: usize = 0;

fn reason(texts: &Texts) -> String {
    stepped::report(texts, |_| {}).reason
}

/// Where an item is in the frame of another one, and how it is turned there, degrees.
fn seen_from(plant: &Plant, item: usize, on: usize) -> Option<(Point, f64)> {
    let frame = Frame::new(plant.place(on)?, plant.turn(on).to_degrees());
    let seen = frame.seen(plant.place(item)?);
    Some((seen, (plant.turn(item) - plant.turn(on)).to_degrees()))
}

/// Whether from the scan on in which `item` has come to lie on `on`, it keeps its place there; in how many scans it is there.
fn keeps_its_place(known: &mut Option<(Point, f64)>, seen: &Seen, item: usize, on: usize) -> u32 {
    let is_there = seen.plant.items()[item].carrier.item() == Some(on);
    let Some((place, turn)) = seen_from(seen.plant, item, on).filter(|_| is_there) else { return 0 };
    let (first, first_turn) = *known.get_or_insert((place, turn));
    assert!((place - first).length() < 1e-9, "item {item}, scan {}: {place:?}, not {first:?}", seen.scan);
    let off = (turn - first_turn).rem_euclid(360.0);
    assert!(!(1e-6..360.0 - 1e-6).contains(&off), "item {item}, scan {}: turned by {off}", seen.scan);
    1
}

fn counted(report: &Report) -> Vec<(&str, u64)> {
    report.sinks.iter().map(|(_, kind, count)| (&kind[..], *count)).collect()
}

#[test]
fn what_lies_on_a_tray_goes_with_it_round_corners_and_into_the_sink() {
    let goal = r#", "goal": {"trays.end": {"tray": 1, "piece": 2}}"#;
    let texts = trays(&[FLAT, PIECE, BAKED], &["piece", "piece"], goal);
    let (mut known, mut scans) = ([None; 2], 0);
    let mut turned = Vec::new();
    let report = stepped::report(&texts, |seen| {
        for (known, item) in known.iter_mut().zip([1, 2]) {
            scans += keeps_its_place(known, seen, item, TRAY);
        }
        turned.push(seen.plant.turn(TRAY).to_degrees());
    });
    assert_eq!(report.reason, "all items collected");
    assert_eq!(counted(&report), [("tray", 1), ("piece", 2)]);
    assert!(scans > 1000, "{scans}");
    assert!(turned.iter().any(|turn| (turn - 90.0).abs() < 1e-6), "it has gone round the corner");
    let height = |known: Option<(Point, f64)>| known.map(|(place, _)| (place.z * 1000.0).round());
    assert_eq!(known.map(height), [Some(20.0), Some(70.0)]);
}

#[test]
fn what_has_no_place_on_a_tray_ends_the_run() {
    let of = |bears: &'static str, items: &[&str]| {
        let tray = ("tray", 0.1, [0.3, 0.2], bears);
        reason(&trays(&[tray, PIECE, ("long", 0.05, [0.28, 0.06], ""), BAKED], items, ""))
    };
    const ENDS: &str = "time limit reached";
    let middle_on_deck = r#", "bears": {"size": [0.15, 0.2]}"#;
    let walls = |inner: &'static str| -> &'static str {
        match inner {
            "wide" => r#", "bears": {"height": 0.01, "size": [0.1, 0.09]}"#,
            _ => r#", "bears": {"height": 0.01, "size": [0.1, 0.07]}"#,
        }
    };
    assert_eq!(
        of("", &["piece"]),
        "interlock of trays: piece_1 comes down on tray_1, which lies on a conveyor"
    );
    assert_eq!(of(r#", "bears": {}"#, &["piece", "long"]), ENDS);
    assert_eq!(
        of(middle_on_deck, &["long"]),
        "interlock of trays: long_1 comes down beside the deck of tray_1, which lies on a conveyor"
    );
    assert_eq!(of(middle_on_deck, &["piece", "long"]), "interlock of trays: long_1 tips off piece_1");
    // It lies 10 mm beside the middle: 40 mm reach 50 mm along, 30 mm reach 40 mm across.
    assert_eq!(of(walls("wide"), &["piece"]), ENDS);
    assert_eq!(
        of(walls("narrow"), &["piece"]),
        "interlock of trays: piece_1 comes down on the edge of tray_1"
    );
}

/// The upper conveyor begins to run after so many seconds.
fn waiting(texts: Texts, seconds: u32) -> Texts {
    let begins = format!(
        "automaton Chute on chute {{
    initial -> Waiting {{}}
    state Waiting {{ when after {seconds} s -> Running {{ run := true; }} }}"
    );
    texts.replaced(&[("automaton Chute on chute {\n    initial -> Running { run := true; }", &begins)])
}

/// The tray is on the arc by then, and goes on.
#[test]
fn a_piece_that_comes_down_on_a_tray_in_a_curve_turns_with_it_from_then_on() {
    let mut texts =
        trays(&[FLAT, PIECE, BAKED], &["piece"], r#", "goal": {"trays.end": {"tray": 1, "piece": 1}}"#);
    texts.layout = texts.layout.replace("[0.41, 0.01, 0, 0]", "[1.21, 0.07, 0, 0]");
    let (mut known, mut scans, mut landed) = (None, 0, None);
    let report = stepped::report(&waiting(texts, 9), |seen| {
        scans += keeps_its_place(&mut known, seen, 1, TRAY);
        if known.is_some() {
            landed.get_or_insert(seen.plant.turn(TRAY).to_degrees());
        }
    });
    assert_eq!(report.reason, "all items collected");
    assert!(scans > 200, "{scans}");
    let (_, turn) = known.expect("it lies on the tray");
    let on_arc = landed.expect("it lies on the tray");
    assert!((10.0..35.0).contains(&on_arc), "{on_arc}");
    // In a scan the tray turns by less than a degree.
    assert!((turn + on_arc).abs() < 1.0, "turned by {turn} on a tray that was turned by {on_arc}");
}

#[test]
fn a_tray_on_a_tray_bears_too() {
    let small = ("small", 0.02, [0.2, 0.15], r#", "bears": {}"#);
    let goal = r#", "goal": {"trays.end": {"tray": 1, "small": 1, "piece": 1}}"#;
    let texts = trays(&[FLAT, small, PIECE, BAKED], &["small", "piece"], goal);
    let mut known = [None; 3];
    let report = stepped::report(&texts, |seen| {
        for (known, [item, on]) in known.iter_mut().zip([[1, TRAY], [2, 1], [2, TRAY]]) {
            let is_on = seen.plant.items()[2].carrier.item() == Some(1);
            if is_on && let Some((place, _)) = seen_from(seen.plant, item, on) {
                let first = *known.get_or_insert(place);
                assert!((place - first).length() < 1e-9, "item {item}, scan {}", seen.scan);
            }
        }
    });
    assert_eq!(report.reason, "all items collected");
    assert_eq!(counted(&report), [("tray", 1), ("small", 1), ("piece", 1)]);
    let heights = known.map(|place| place.map(|place| (place.z * 1000.0).round()));
    assert_eq!(heights, [20.0, 20.0, 40.0].map(Some));
}

/// The piece on the first tray reaches 100 mm beyond it, at the height of the crate behind.
#[test]
fn trays_on_a_conveyor_keep_as_far_apart_as_what_lies_on_them_reaches() {
    let crate_ = ("crate", 0.1, [0.3, 0.2], "");
    let long = ("long", 0.05, [0.5, 0.06], "");
    let scene = |items: &[&str], pose: &str| {
        let mut texts = trays(&[FLAT, crate_, long, PIECE, BAKED], items, "");
        texts.layout = texts.layout.replace("[0.41, 0.01, 0, 0]", pose);
        let scenario = texts.scenario.map(|text| text.replace(r#"["tray"]"#, r#"["tray", "crate"]"#));
        Texts { scenario, ..texts }.replaced(&[("at: 0.6;", "at: 0.9;")])
    };
    let mut behind = None;
    let report = stepped::report(&scene(&["long"], "[0.5, 0.01, 0, 0]"), |seen| {
        if seen.plant.now_ms() < 12_000 {
            behind = seen.plant.place(1).map(|place| place.x);
        }
    });
    assert_eq!(report.reason, "time limit reached");
    assert!(behind.is_some_and(|behind| (behind - 0.35).abs() < 1e-6), "{behind:?}");
    // The crate has closed up to the tray by the time that something lies on this.
    let reason = reason(&waiting(scene(&["long"], "[0.5, 0.01, 0, 0]"), 5));
    assert_eq!(reason, "interlock of trays: long_1 comes down on crate_1, which lies there");
}

/// The beam is over the tray: it sees what stands on it, from its own front edge to its own rear edge.
#[test]
fn a_beam_sees_what_lies_on_a_tray() {
    let texts = trays(&[FLAT, PIECE, BAKED], &["piece"], "");
    let mut rises = Vec::new();
    stepped::report(&texts, |seen| {
        let sees = seen.inputs[0][0] != 0.0;
        let is_in_beam = seen.plant.place(1).is_some_and(|place| {
            let is_on_first = seen.plant.place(TRAY).is_some_and(|tray| tray.x < 1.0 && tray.z < 0.31);
            is_on_first && place.z < 0.44 && (place.x - 0.8).abs() < 0.04 - 1e-6
        });
        let is_at_edge = seen.plant.place(1).is_some_and(|place| ((place.x - 0.8).abs() - 0.04).abs() < 1e-6);
        assert!(is_at_edge || sees == is_in_beam, "scan {}", seen.scan);
        if sees && rises.last().is_none_or(|(_, last)| *last + 1 != seen.scan) {
            rises.push((seen.inputs[0][1..4].to_vec(), seen.scan));
        } else if sees && let Some((_, last)) = rises.last_mut() {
            *last = seen.scan;
        }
    });
    // Of the kinds tray, piece and baked.
    let kinds: Vec<_> = rises.iter().map(|(kinds, _)| &kinds[..]).collect();
    assert_eq!(kinds, [[0.0, 1.0, 0.0]]);
}

/// Parts for which these are inputs of the device with trays; the field is 0.4 m long.
const SENSORS: [(&str, &str); 2] = [
    (
        "    in sees: bool",
        "    part scale = gauge { across: straight; at: 0.8; };
    part field = zone { over: straight; middle: origin * point(0.75, 0, 0.3); half: 0.2; part_half: 0; };
    in sees: bool",
    ),
    (
        "    out run_straight",
        "    in height: real = scale.height;
    in mass: real = scale.mass;
    in in_field: bool[Kind] = field.sees;
    in foremost: point[Kind] = field.foremost;
    out run_straight",
    ),
];

#[test]
fn gauges_and_zones_measure_what_lies_on_a_tray() {
    let texts = trays(&[FLAT, PIECE, BAKED], &["piece", "piece"], "").replaced(&SENSORS);
    let scenario =
        texts.scenario.map(|text| text.replace(r#""height": 0.05,"#, r#""height": 0.05, "mass": 0.25,"#));
    let texts = Texts {
        scenario: scenario.map(|text| text.replace(r#""height": 0.02,"#, r#""height": 0.02, "mass": 2,"#)),
        ..texts
    };
    let (mut highest, mut heaviest, mut scans) = (0.0, 0.0, 0);
    stepped::report(&texts, |seen| {
        let [height, mass] = [seen.inputs[0][4], seen.inputs[0][5]];
        (highest, heaviest) = (f64::max(highest, height), f64::max(heaviest, mass));
        let Some(tray) = seen.plant.place(TRAY) else { return };
        // Off the joint, and not at an edge of the field or of the beam.
        let is_at_edge = |off: f64| (off - 0.15).abs() < 1e-6 || (off - 0.16).abs() < 1e-6;
        if seen.plant.items()[2].carrier.item() != Some(TRAY)
            || tray.x > 0.99
            || is_at_edge((tray.x - 0.75).abs())
        {
            return;
        }
        let piece = seen.plant.place(1).expect("it is on the tray");
        let half = 0.2 - 0.04;
        let is_in_field = (piece.x - 0.75).abs() < half;
        assert_eq!(seen.inputs[0][7] != 0.0, is_in_field, "scan {}", seen.scan);
        if is_in_field {
            scans += 1;
            let foremost = Point::new(seen.inputs[0][12], seen.inputs[0][13], seen.inputs[0][14]);
            assert!((foremost - piece).length() < 1e-9, "scan {}: {foremost:?}", seen.scan);
        }
    });
    assert!((highest - 0.12).abs() < 1e-9 && (heaviest - 2.5).abs() < 1e-9, "{highest} m, {heaviest} kg");
    assert!(scans > 100, "{scans}");
}

#[test]
fn a_process_works_on_all_that_lies_on_a_tray() {
    let baking = |process: &str, goal: &str| {
        let goal = format!(r#", "goal": {{"trays.end": {goal}}}"#);
        let texts = trays(&[FLAT, PIECE, BAKED], &["piece", "piece"], &goal);
        let start = ("-> Baking {}", "-> Baking { bake := true; }");
        stepped::report(
            &texts.replaced(&[start, ("kinds: [piece]; makes: [piece, baked];", process)]),
            |_| {},
        )
    };
    let all = baking("kinds: [piece]; makes: [piece, baked];", r#"{"tray": 1, "baked": 2}"#);
    assert_eq!((&*all.reason, counted(&all)), ("all items collected", vec![("tray", 1), ("baked", 2)]));
    let one = baking("joins: [piece];", r#"{"tray": 1, "piece": 1}"#);
    assert_eq!((&*one.reason, counted(&one)), ("all items collected", vec![("tray", 1), ("piece", 1)]));
    let none = baking("joins: [baked];", r#"{"tray": 1, "piece": 1}"#);
    assert_eq!(none.reason, "interlock of trays: the process oven was started without a baked on it");
    let neither = baking("kinds: [baked];", r#"{"tray": 1, "piece": 1}"#);
    assert_eq!(neither.reason, "interlock of trays: the process oven was started without a time for a tray");
}

/// The items on a tray are the lower and the upper one of two pieces.
#[test]
fn what_lies_on_a_tray_that_a_process_changes_comes_to_rest_again() {
    let end = |process: &str| {
        let deep = ("deep", 0.1, [0.3, 0.2], r#", "bears": {"height": 0.01, "size": [0.28, 0.18]}"#);
        // The pieces lie 10 mm beside the middle: 40 mm long they fit, 30 mm across they do not.
        let narrow = ("narrow", 0.1, [0.3, 0.2], r#", "bears": {"height": 0.01, "size": [0.1, 0.07]}"#);
        let plain = ("plain", 0.02, [0.3, 0.2], "");
        let wide = ("wide", 0.02, [0.4, 0.2], r#", "bears": {}"#);
        let pieces = [("thick", 0.08, [0.08, 0.06], ""), ("longer", 0.05, [0.1, 0.06], "")];
        let kinds = [&[FLAT, PIECE, deep, narrow, plain, wide], &pieces[..]].concat();
        let texts = trays(&kinds, &["piece", "piece"], "").replaced(&[
            ("-> Baking {}", "-> Baking { bake := true; }"),
            ("kinds: [piece]; makes: [piece, baked];", process),
        ]);
        let mut heights = [None; 2];
        let report = stepped::report(&texts, |seen| {
            for (height, item) in heights.iter_mut().zip([1, 2]) {
                if let Some((place, _)) = seen_from(seen.plant, item, TRAY) {
                    *height = Some((place.z * 1000.0).round());
                }
            }
        });
        (report.reason, heights)
    };
    let ends = |reason: &str, heights: [f64; 2]| (reason.to_string(), heights.map(Some));
    const LIMIT: &str = "time limit reached";
    assert_eq!(end("makes: [piece, thick];"), ends(LIMIT, [20.0, 100.0]));
    assert_eq!(end("makes: [tray, deep];"), ends(LIMIT, [10.0, 60.0]));
    assert_eq!(end("joins: [piece];").1[1], Some(20.0));
    let plain = "interlock of trays: the process oven leaves a piece on a plain, which bears nothing";
    assert_eq!(end("makes: [tray, plain];").0, plain);
    assert_eq!(end("makes: [piece, longer];"), ends(LIMIT, [20.0, 70.0]));
    let wide =
        "interlock of trays: the process oven makes a wide of a tray on a conveyor, which is of another size";
    assert_eq!(end("makes: [tray, wide];").0, wide);
    let narrow = "interlock of trays: the process oven moves a piece into a narrow";
    assert_eq!(end("makes: [tray, narrow];").0, narrow);
}

/// The piece lies on a small tray in a box.
#[test]
fn what_a_process_makes_longer_does_not_reach_through_a_wall() {
    let box_ = ("tray", 0.1, [0.4, 0.3], r#", "bears": {"height": 0.01, "size": [0.38, 0.28]}"#);
    let small = ("small", 0.02, [0.2, 0.15], r#", "bears": {}"#);
    let kinds = [box_, small, PIECE, BAKED, ("longer", 0.05, [0.6, 0.06], "")];
    let mut texts = trays(&kinds, &["small", "piece"], "");
    texts.layout = texts.layout.replace("[0.41, 0.01, 0, 0]", "[0.32, 0.01, 0, 0]");
    let end = reason(&texts.replaced(&[
        ("-> Baking {}", "-> Baking { bake := true; }"),
        ("kinds: [piece]; makes: [piece, baked];", "makes: [piece, longer];"),
    ]));
    assert_eq!(end, "interlock of trays: the process oven moves a longer into a tray");
}

#[test]
fn a_piece_that_is_taken_off_its_tray_during_a_process_ends_the_run() {
    let operator = r#", "operator": [{"remove": "piece_2", "at_s": 13.5}]"#;
    let baking = |kinds: &str| {
        let texts = trays(&[FLAT, PIECE, BAKED], &["piece", "piece"], operator);
        let start = ("-> Baking {}", "-> Baking { bake := true; }");
        reason(&texts.replaced(&[start, ("kinds: [piece]; makes: [piece, baked];", kinds)]))
    };
    let taken = "interlock of trays: a piece was taken from the process oven before its end";
    assert_eq!(baking("kinds: [piece]; makes: [piece, baked];"), taken);
    assert_eq!(baking("kinds: [tray];"), "time limit reached");
}

/// A box stands at a place where items lie on one another: what comes down into it lies in it, not on its upper side.
#[test]
fn a_box_on_a_stack_is_filled() {
    let tray = ("tray", 0.1, [0.3, 0.2], r#", "bears": {"height": 0.01, "size": [0.28, 0.18]}"#);
    let mut texts = trays(&[tray, PIECE, BAKED], &["piece", "piece"], "");
    texts.layout = texts.layout.replace(r#""type": "trays""#, r#""type": "table""#);
    let mut heights = Vec::new();
    let report = stepped::report(&texts, |seen| {
        let height = |item| Some((seen.plant.place(item)?.z * 1000.0).round());
        heights = (0..3).map(height).collect();
    });
    assert_eq!(
        (&*report.reason, heights),
        ("time limit reached", vec![Some(200.0), Some(210.0), Some(260.0)])
    );
}

/// The tray falls onto a turntable, and the pieces onto the tray; then the table turns by a quarter.
#[test]
fn what_lies_on_a_tray_turns_with_a_turntable() {
    let turning = [
        (
            "    part top = place {\n        at:",
            "    part turner = positioner { turns: 90; pivot: origin * point(0.4, 0, 0); positions: [0, 90]; speed: 30; };
    out goal: int 0..1;
    command 1 turn(goal) = turner.to(goal);
    part top = place {\n        on: turner; at:",
        ),
        (
            "automaton Table on table {\n    initial -> Running { run := true; }\n    final state Running;",
            "automaton Table on table {
    initial -> Running { run := true; }
    state Running { when after 15 s -> Turning {} }
    resume state Turning = sequence { turn(1); } -> Ended {} else Ended {}
    final state Ended;",
        ),
    ];
    let mut texts = trays(&[FLAT, PIECE, BAKED], &["piece", "piece"], "");
    texts.layout = texts.layout.replace(r#""type": "trays""#, r#""type": "table""#);
    let (mut known, mut turns) = ([None; 2], Vec::new());
    let report = stepped::report(&texts.replaced(&turning), |seen| {
        for (known, item) in known.iter_mut().zip([1, 2]) {
            keeps_its_place(known, seen, item, TRAY);
        }
        turns.push(seen.plant.turn(TRAY).to_degrees());
    });
    assert_eq!(report.reason, "time limit reached");
    assert!(known.iter().all(Option::is_some), "{known:?}");
    assert!(turns.iter().any(|turn| (20.0..70.0).contains(turn)));
    assert!(turns.last().is_some_and(|turn| (turn - 90.0).abs() < 1e-6), "{:?}", turns.last());
}

#[test]
fn a_person_takes_a_tray_with_all_that_lies_on_it() {
    let removed = |item: &str| {
        let operator = format!(r#", "operator": [{{"remove": "{item}", "at_s": 14}}]"#);
        stepped::report(&trays(&[FLAT, PIECE, BAKED], &["piece", "piece"], &operator), |_| {})
    };
    let all = removed("tray_1");
    assert!(all.items.is_empty() && counted(&all).is_empty(), "{:?}", all.items);
    let upper = removed("piece_2");
    assert_eq!(counted(&upper), [("tray", 1), ("piece", 1)]);
    let lower = removed("piece_1");
    assert_eq!(counted(&lower), [("tray", 1), ("piece", 2)]);
    assert!(lower.notes.iter().any(|note| note.contains("piece_2")), "{:?}", lower.notes);
}

/// The robot takes the full box, and puts it down in another place of the conveyor, turned as it was.
#[test]
fn a_gripper_takes_a_box_with_all_that_lies_in_it() {
    let lifting = "-> Lifting {}
    }
    resume state Lifting = sequence {
        move(box_at + up(over));
        move(box_at);
        grip := true;
        until attached at most 1 s;
        move(box_at + up(over));
        move(box_at + point(0.1, 0, over));
        move(box_at + point(0.1, 0, 0.001));
        grip := false;
        until not attached at most 1 s;
        move(box_at + up(over));
    } -> Releasing { hold_back := false; } else Lifting { failures += 1; }
";
    let texts = side_by_side("scenes/packing").replaced(&[
        ("-> Releasing { hold_back := false; }\n    }\n", lifting),
        (
            "    /// Attempts that failed.\n",
            "    define box_at = spots[0] + point(0.06, 0.05, 0.055);\n    /// Attempts that failed.\n",
        ),
    ]);
    let first_box = 8;
    let (mut known, mut in_hand) = ([None; 4], 0);
    let report = stepped::report(&texts, |seen| {
        for (item, known) in known.iter_mut().enumerate() {
            let there = keeps_its_place(known, seen, item, first_box);
            in_hand += if is_gripped(seen, first_box) { there } else { 0 };
        }
    });
    assert_eq!(report.reason, "all items collected");
    assert!(in_hand > 400, "{in_hand}");
}

fn is_gripped(seen: &Seen, item: usize) -> bool {
    matches!(seen.plant.items()[item].carrier, Carrier::Grip { .. })
}

#[test]
fn a_piece_that_meets_the_wall_of_a_box_is_a_contact() {
    let texts = side_by_side("scenes/packing");
    let off = ("point(-0.06, -0.05, 0)", "point(-0.06, -0.08, 0)");
    let report = stepped::report(&texts.replaced(&[off]), |_| {});
    assert!(
        report.reason.starts_with("collision of packer (carton_1) with packer (piece_1)"),
        "{}",
        report.reason
    );
}
