//! Machines that cannot be: each mistake is one error with its code, its place, the facts and what helps.

use autogen_tests::Texts;

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
