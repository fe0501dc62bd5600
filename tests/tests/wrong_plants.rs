//! Machines that cannot be: each mistake is one error with its code, its place, the facts and what helps.

use autogen_tests::{Texts, own_line};

/// What a layout with one machine is told, with its place as line and column.
fn told(device: &str, kinds: &str) -> Vec<String> {
    let texts = Texts {
        specs: vec![format!(
            "device thing {{
{device}
}}
automaton Thing on thing {{ initial state S {{ when false -> S {{}} }} }}"
        )],
        scenario: Some(format!(
            r#"{{"kinds": [{kinds}], "supply": {{"items": ["box"], "every_s": 5}}, "goal": {{"thing.store": {{"box": 1}}}}}}"#
        )),
        ..Texts::of_layout(r#"{"robots": [{"name": "thing", "type": "thing", "pose": [0, 0, 0]}]}"#)
    };
    let outcome = texts.compile();
    let all = outcome.diagnostics.iter().chain(&outcome.warnings);
    all.map(|found| {
        assert!(!found.help.is_empty(), "{found:?}");
        let text = &outcome.sources.file(found.place.file).text[..found.place.start as usize];
        let (line, column) =
            (text.matches('\n').count() + 1, text.len() - text.rfind('\n').map_or(0, |at| at + 1) + 1);
        let notes: String = found.notes.iter().map(|note| format!(" [{note}]")).collect();
        format!("{} {line}:{column} {}{notes}", found.code, found.message)
    })
    .collect()
}

const BOX: &str = r#"{"name": "box", "height": 0.1, "size": [0.4, 0.3]}"#;

fn with_belt(length: f64, more: &str) -> String {
    format!(
        "part belt = lane {{ from: origin; length: {length:?}; width: 0.4; speed: 0.2; }};
        part feed = source {{ on: belt; inset: 0.1; }};
        {more}
        in moves: bool = belt.moves;"
    )
}

#[test]
fn a_lane_shorter_than_a_part() {
    let store = "part store = sink { of: belt; inset: 0; };";
    assert_eq!(told(&with_belt(0.4, store), BOX), [""; 0]);
    assert_eq!(
        told(&with_belt(0.39, store), BOX),
        [
            "E0411 1:22 the conveyor thing.belt is shorter than a `box` [it is 0.390 m long, a `box` is 0.400 m] \
            [an item is on the conveyor on which its middle is, and stops what comes behind it]"
        ]
    );
}

/// The scenario brings one box. `box` of a `blank` can be as many as there are blanks.
#[test]
fn a_goal_above_the_supply() {
    let scenario = |items: &str, goal: &str| {
        let kinds = r#"{"name": "box", "height": 0.1}, {"name": "blank", "height": 0.1}"#;
        Some(format!(
            r#"{{"kinds": [{kinds}], "supply": {{"items": [{items}]}}, "goal": {{"thing.store": {{{goal}}}}}}}"#
        ))
    };
    let store = "part store = sink { of: belt; inset: 0; };";
    let maker = "part seat = place {
            at: pose; slots: [point(0, 0, 0)]; by_kind: false; floor: pose; floor_x: [-0.1, 0.1]; floor_y: [-0.1, 0.1];
        };
        part press = process { on: seat; time: 1 s; makes: [blank, box]; };
        out press_it: bool = press.start;";
    let told = |more: &str, items: &str, goal: &str| -> Vec<String> {
        let device = format!("device thing {{ {} }}", with_belt(1.0, &format!("{store} {more}")));
        let automaton = "automaton Thing on thing { initial state S { when false -> S {} } }";
        let texts = Texts {
            specs: vec![format!("{device} {automaton}")],
            scenario: scenario(items, goal),
            ..Texts::of_layout(r#"{"robots": [{"name": "thing", "type": "thing", "pose": [0, 0, 0]}]}"#)
        };
        let found = texts.compile().diagnostics.into_iter();
        found.map(|found| format!("{} {} => {}", found.code, found.message, found.help)).collect()
    };
    assert_eq!(told("", r#""box", "box""#, r#""box": 2"#), [""; 0]);
    assert_eq!(
        told("", r#""box", "box""#, r#""box": 3"#),
        [r#"E0138 the belts bring too few parts "box": 2 of 3 => add 1 part "box" to "items""#]
    );
    assert_eq!(told(maker, r#""box", "blank""#, r#""box": 2"#), [""; 0]);
    let none = told("", r#""box""#, r#""blank": 1"#);
    assert!(matches!(&none[..], [one] if one.starts_with("E0410")), "{none:?}");
}

#[test]
fn two_ends_30_mm_apart() {
    let next = |at: f64| {
        format!(
            "part next = lane {{ from: origin * frame({at:?}, 0, 0, 0); length: 1.0; width: 0.4; speed: 0.2; }};
            part store = sink {{ of: next; inset: 0; }};"
        )
    };
    assert_eq!(told(&with_belt(1.0, &next(1.0)), BOX), [""; 0]);
    let found = told(&with_belt(1.0, &next(1.03)), BOX);
    assert!(
        found.iter().any(|found| found.starts_with("W0201 ") && found.contains("ends 30 mm from where")),
        "{found:?}"
    );
}

#[test]
fn a_beam_for_a_word_that_no_kind_has() {
    let beam = |word: &str| {
        format!(
            "part store = sink {{ of: belt; inset: 0; }};
            part eye = beam {{ across: belt; at: 0.5; only: {word}; }};"
        )
    };
    let warnings = |word: &str, kinds: &str| -> Vec<String> { told(&with_belt(1.0, &beam(word)), kinds) };
    let steel = r#"{"name": "box", "height": 0.1, "size": [0.4, 0.3], "is": ["metal", "red"]}"#;
    assert_eq!(warnings("metal", steel), [""; 0]);
    assert_eq!(
        warnings("mettal", steel),
        ["W0203 5:18 no kind of the scenario is `mettal`: `eye` never sees anything \
            [kinds of the scenario are metal, red]"]
    );
    assert_eq!(
        warnings("metal", BOX),
        ["W0203 5:18 no kind of the scenario is `metal`: `eye` never sees anything \
            [no kind of the scenario has the key `is`]"]
    );
}

/// Only where a kind of the scenario is nearly meant: devices are for several scenarios.
#[test]
fn a_process_for_a_kind_that_is_misspelt() {
    let process = |settings: &str| {
        let press = format!("part press = process {{ on: belt; at: 0.5; time: 1 s; {settings} }};");
        let driven = "out start: bool = press.start stop false;";
        told(&with_belt(1.0, &format!("part store = sink {{ of: belt; inset: 0; }}; {press} {driven}")), BOX)
    };
    for settings in [
        "kinds: [bux];",
        "makes: [bux, box];",
        "rejects: [bux, box]; shares: [0.5];",
        "rejects: [box, bux]; shares: [0.5];",
        "joins: [bux];",
    ] {
        let found = process(settings);
        let message = "W0206 4:57 no kind of the scenario is `bux`, which `press` names [kinds of the scenario are box]";
        assert!(found.iter().any(|found| found == message), "{settings}: {found:?}");
    }
    for settings in ["kinds: [box];", "kinds: [cover];", "makes: [cover, lid];"] {
        let found = process(settings);
        assert!(!found.iter().any(|found| found.contains("W0206")), "{settings}: {found:?}");
    }
}

#[test]
fn what_a_process_says_of_kinds_can_happen() {
    let of = |settings: &str| -> Vec<String> {
        let press = format!("part press = process {{ on: belt; at: 0.5; time: 1 s; {settings} }};");
        let store = "part store = sink { of: belt; inset: 0; };";
        let found =
            told(&with_belt(1.0, &format!("{store} {press} out start: bool = press.start stop false;")), BOX);
        found.into_iter().filter(|found| found.starts_with("E0704")).collect()
    };
    for (settings, message) in [
        ("kinds: [box]; makes: [box, lid];", ""),
        ("kinds: [];", "kinds is an empty list: name kinds, or leave it out for all kinds"),
        ("kinds: [lid]; makes: [box, lid];", "makes says what becomes of box, which is not among the kinds"),
        (
            "kinds: [lid]; rejects: [box, lid]; shares: [0.5];",
            "rejects says what becomes of box, which is not among the kinds",
        ),
        ("makes: [box, lid, box, cup];", "the setting makes says twice what becomes of box"),
        ("rejects: [box, box]; shares: [0.5];", "rejects says that some of box become box"),
        ("rejects: [box, lid]; shares: [2];", "a share is a number from 0 to 1, not 2"),
        ("makes: [box, lid, cup];", "the setting makes names cup without what becomes of it"),
    ] {
        let found = of(settings);
        match message {
            "" => assert_eq!(found, [""; 0]),
            message => assert!(found.len() == 1 && found[0].contains(message), "{settings}: {found:?}"),
        }
    }
}

#[test]
fn numbers_beyond_the_limits_of_settings() {
    let store = "part store = sink { of: belt; inset: 0; };";
    let errors = |more: &str| told(&with_belt(1.0, &format!("{store} {more}")), BOX);
    let chute = |length: &str, speed: &str| {
        format!(
            "part chute = lane {{ from: origin * frame(0, 2, 0, 0); length: {length}; width: 0.4; speed: {speed}; }};"
        )
    };
    let wrong = |setting: &str| {
        format!("E0704 4:57 the part chute: the setting {setting} is no number from 0.000000001 to 1000000")
    };
    assert_eq!(errors(&chute("1.0", "1e-9")), [""; 0]);
    assert_eq!(errors(&chute("1e9", "0.2")), [wrong("length")]);
    assert_eq!(errors(&chute("1.0", "1e300")), [wrong("speed")]);
    assert_eq!(errors(&chute("1.0", "1e-300")), [wrong("speed")]);
}

#[test]
fn a_chain_without_a_solution_anywhere() {
    let store = "part store = sink { of: belt; inset: 0; };";
    let arm = |rest: &str| {
        format!(
            "{store} part arm = chain {{
                from: origin; lengths: [0.1807, -0.6127, -0.57155, 0.17415, 0.11985, 0.11655]; tool_length: 0.15;
                rest: {rest}; speeds: [1.0, 1.0, 1.0, 1.0, 1.0, 1.0]; acceleration: 1.4;
            }};"
        )
    };
    let errors = |rest: &str| -> Vec<String> {
        let found = told(&with_belt(1.0, &arm(rest)), BOX);
        found.into_iter().filter(|found| found.starts_with('E')).collect()
    };
    assert_eq!(errors("point(0.7, 0, 0.5)"), [""; 0]);
    assert_eq!(
        errors("point(2.7, 0, 0.5)"),
        ["E0711 4:57 `thing` cannot be built from its device: its tool cannot reach its own rest position"]
    );
}

/// A robot that puts boxes onto a shelf, or takes them from it; its own lane brings them, or takes them away.
fn robot_with(part_of_lane: &str, hands: &str, place: &str) -> Vec<&'static str> {
    let text = format!(
        "device robot {{
            part lane = lane {{ from: origin * frame(0, 0.5, 0.5, 0); length: 1.0; width: 0.4; speed: 0.2; }};
            {part_of_lane}
            part slide = axis {{ from: origin * frame(0, 0, 1.2, 0); along: y; range: [-0.6, 0.6]; speed: 1.0; acceleration: 1.0; }};
            part lift = axis {{ on: slide; along: z; range: [-0.9, 0]; speed: 1.0; acceleration: 1.0; }};
            part arm = chain {{ on: lift; tool_length: 0.1; rest: origin * point(0, 0, 1.0); }};
            part claw = grip {{ on: arm; closes: 300 ms; opens: 300 ms; sure_after: 50 ms; near: 0.01; }};
            in moves: bool = lane.moves;
            out close: bool = claw.close;
            out goal: point;
            command 1 move(goal) = arm.joints(goal);
        }}
        device shelf {{
            part board = place {{
                at: pose; slots: [point(0, 0, 0.5)]; by_kind: false;
                floor: point(0, 0, 0.5); floor_x: [-0.2, 0.2]; floor_y: [-0.2, 0.2];
            }};
            constant at: point = pose + point(0, 0, 0.5);
            handover at = at \"board\";
        }}
        interface Shelf {{ parameter at: point; }}
        automaton Board on shelf is Shelf {place} at at approach 0.2 {{ initial state S {{ when false -> S {{}} }} }}
        automaton Robot on robot {{ {hands} shelves: Shelf[]; initial state S {{ when moves -> S {{}} }} }}"
    );
    let layout = r#"{"robots": [
        {"name": "robot", "type": "robot", "pose": [0, 0, 0]}, {"name": "board", "type": "board", "pose": [0, -0.5, 0]}
    ]}"#;
    let scenario = format!(r#"{{"kinds": [{BOX}]}}"#);
    let texts = Texts { specs: vec![text], scenario: Some(scenario), ..Texts::of_layout(layout) };
    let found = texts.compile().diagnostics;
    found
        .iter()
        .inspect(|found| assert!(!found.help.is_empty(), "{found:?}"))
        .map(|found| found.code)
        .collect()
}

#[test]
fn items_come_and_go_by_an_arms_own_lane() {
    let (source, sink) =
        ("part feed = source { on: lane; inset: 0.1; };", "part box = sink { of: lane; inset: 0; };");
    assert_eq!(robot_with(source, "hands to", "accepts"), [""; 0]);
    assert_eq!(robot_with("", "hands to", "accepts"), ["E0404"]);
    assert_eq!(robot_with(sink, "takes from", "offers"), [""; 0]);
    assert_eq!(robot_with("", "takes from", "offers"), ["E0405"]);
}

/// With a panel for the machine a person moves what the automaton does not.
#[test]
fn an_output_that_only_a_person_sets() {
    let spec = "device gate {
            part bar = cylinder { extend: 1 s; retract: 1 s; };
            in is_open: bool = bar.is_out;
            out open: bool = bar.extend;
        }
        automaton Gate on gate { initial state S { when is_open -> S {} } }";
    let warnings = |panel: &str| -> Vec<&str> {
        let layout = format!(
            r#"{{"panel": "{panel}", "robots": [{{"name": "gate", "type": "gate", "pose": [0, 0, 0]}}]}}"#
        );
        let texts = Texts { specs: vec![spec.into()], ..Texts::of_layout(layout) };
        texts.compile().warnings.iter().map(|warning| warning.code).collect()
    };
    assert_eq!(warnings("line"), ["W0109"]);
    assert_eq!(warnings("machines"), [""; 0]);
}

#[test]
fn floors_that_do_not_turn_with_their_machine() {
    let warned = |place: &str, yaw: f64| -> usize {
        let texts = Texts {
            specs: vec![format!(
                "device table {{
                    part drive = positioner {{ positions: [0, 90]; turns: 90; pivot: origin * point(0, 0, 0); speed: 30; }};
                    part cart = track {{
                        corners: [pose, pose + point(2, 0, 0)]; closed: false; places: [0, 2]; speed: 1; acceleration: 1; mass: 9;
                    }};
                    part seat = place {{
                        {place} slots: [point(0, 0, 0)]; by_kind: false; floor: point(0, 0, 0);
                    }};
                    in place: int -1..31 = drive.place;
                }}
                automaton Table on table {{ initial state S {{ when false -> S {{}} }} }}"
            )],
            ..Texts::of_layout(format!(
                r#"{{"robots": [{{"name": "table", "type": "table", "pose": [0, 0, 0, {yaw:?}]}}]}}"#
            ))
        };
        let outcome = texts.compile();
        assert!(outcome.diagnostics.is_empty(), "{:?}", outcome.diagnostics);
        outcome.warnings.iter().filter(|found| found.code == "W0205").count()
    };
    let floor = |x: &str, y: &str| format!("floor_x: [{x}]; floor_y: [{y}];");
    let long = floor("-0.2, 0.2", "-0.5, 0.5");
    let square = floor("-0.2, 0.2", "-0.2, 0.2");
    let aside = floor("-0.2, 0.2", "-0.1, 0.3");
    for (place, turned_by) in [
        (format!("at: pose; {long}"), [0, 1, 0, 1, 0]),
        (format!("at: pose; {square}"), [0, 0, 0, 1, 0]),
        (format!("at: pose; {aside}"), [0, 1, 1, 1, 0]),
        (format!("at: origin; {long}"), [0, 0, 0, 0, 0]),
        (format!("at: origin * frame(0, 0, 0, 90); {long}"), [0, 0, 0, 0, 0]),
        (format!("on: drive; at: pose; {long}"), [0, 1, 0, 1, 0]),
        (format!("on: drive; at: origin; {long}"), [0, 0, 0, 0, 0]),
        (format!("on: cart; at: pose; {long}"), [0, 0, 0, 0, 0]),
        (format!("at: pose; toward: point(0, 1, 0); {long}"), [0, 0, 0, 0, 0]),
    ] {
        let found = [0.0, 90.0, 180.0, 45.0, 360.0].map(|yaw| warned(&place, yaw));
        assert_eq!(found, turned_by, "{place}");
    }
}

#[test]
fn a_type_that_forgets_what_another_one_retains() {
    let count = |texts: &Texts| {
        let outcome = texts.compile();
        assert!(outcome.diagnostics.is_empty(), "{:?}", outcome.diagnostics);
        outcome.warnings.iter().filter(|found| found.code == "W0207").count()
    };
    let both = own_line("buffer");
    assert_eq!(count(&both), 0);
    let one = both.replaced(&[("    retain all;\n", "")]);
    // Three types of the library work with it.
    assert_eq!(count(&one), 3);
    assert_eq!(count(&one.replaced(&[("    local next", "    retain next;\n    local next")])), 0);

    let pads = |keeps: &str, forgets: &str| {
        Texts {
        specs: vec![format!(
            "device pad {{ part signal = lamp {{ at: pose; colour: red; }}; out lit: bool = signal.on; }}
            interface Left {{ shared left: bool := false by owner; }}
            interface Right {{ shared right: bool := false by owner; }}
            automaton Keeps on pad is Left {{
                {keeps}
                retain all;
                initial state S {{ when lit -> T {{ left := true; }} when not lit -> S {{ lit := true; }} }}
                state T {{ when lit -> S {{ left := false; }} }}
            }}
            {forgets}"
        )],
        ..Texts::of_layout(
            r#"{"robots": [
                {"name": "a", "type": "keeps", "pose": [0, 0, 0]}, {"name": "b", "type": "forgets", "pose": [1, 0, 0]}
            ]}"#
            .to_string(),
        )
    }
    };
    let both_ways = "automaton Forgets on pad is Right {
        knows others: Left[];
        initial state S { when first o in others with o.left -> S { lit := true; right := true; } }
    }";
    let knows = "knows others: Right[]; require count(others) >= 0 else \"none\";";
    assert_eq!(count(&pads(knows, both_ways)), 1);
    let only_reads = "automaton Forgets on pad {
        knows others: Left[];
        initial state S { when first o in others with o.left -> S { lit := true; } }
    }";
    assert_eq!(count(&pads("", only_reads)), 0);
}
