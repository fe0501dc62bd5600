//! What `check` says of the ways of items, with falls off conveyors, and what the simulator does with them.

use autogen::executor::Executor;
use autogen::lower::{Outcome, Verdict};
use autogen_tests::{Texts, text};
use runtime_sim::random::Random;
use runtime_sim::report::Report;
use runtime_sim::run::{Stepping, run};

/// A conveyor, a second one whose beginning is so far ahead of its end, aside and up, and kinds of these lengths.
fn two_lanes([ahead, aside, up]: [f64; 3], lengths: &[f64]) -> Texts {
    let device = format!(
        "device rig {{
            part a = lane {{ from: origin * frame(0, 0, 0.7, 0); length: 1.0; width: 0.3; speed: 0.5; }};
            part feed = source {{ on: a; inset: 0.5; }};
            part b = lane {{ from: origin * frame(1 + {ahead:?}, {aside:?}, 0.7 + {up:?}, 0); length: 1.0; width: 0.3; speed: 0.5; }};
            part bin = sink {{ of: b; inset: 0; }};
            out run: bool = a.run;
            out run_b: bool = b.run;
        }}
        automaton Rig on rig {{ initial -> Runs {{ run := true; run_b := true; }} state Runs {{ when false -> Runs {{}} }} }}"
    );
    let numbers = 0..lengths.len();
    let kinds = numbers.clone().zip(lengths);
    let kinds = kinds.map(|(n, l)| format!(r#"{{"name": "kind_{n}", "height": 0.1, "size": [{l:?}, 0.1]}}"#));
    let [items, goal] = [|n| format!("\"kind_{n}\""), |n| format!("\"kind_{n}\": 1")]
        .map(|told: fn(usize) -> String| numbers.clone().map(told).collect::<Vec<_>>().join(", "));
    let scenario = format!(
        r#"{{"kinds": [{}], "supply": {{"items": [{items}], "every_s": 4}}, "goal": {{"rig.bin": {{{goal}}}}}, "time_limit_s": 60}}"#,
        kinds.collect::<Vec<_>>().join(", ")
    );
    Texts {
        layout: r#"{"robots": [{"name": "rig", "type": "rig", "pose": [0, 0, 0]}]}"#.into(),
        specs: vec![device],
        scenario: Some(scenario),
        ..Texts::default()
    }
}

fn errors(outcome: &Outcome) -> Vec<(&'static str, String)> {
    outcome.diagnostics.iter().map(|found| (found.code, found.message.clone())).collect()
}

/// From conveyor to conveyor or place, of each passage.
fn passages(verdict: &Verdict) -> Vec<[&str; 2]> {
    verdict.passages.iter().map(|passage| [passage.from.as_str(), passage.to.as_str()]).collect()
}

fn report(texts: &Texts) -> Report {
    let project = texts.project();
    let mut executor = Executor::new(&project.system);
    run(&project.plant, &mut executor, Stepping::Events, &mut |_| {}).expect("a line that can be run")
}

#[test]
fn an_item_falls_half_of_its_length_and_down() {
    for (begin, length, falls) in [
        ([0.04, 0.0, 0.0], 0.1, true),
        ([0.06, 0.0, 0.0], 0.1, false),
        ([0.14, 0.0, -0.3], 0.3, true),
        ([0.16, 0.0, -0.3], 0.3, false),
        ([0.8, 0.0, 0.0], 0.1, false),
        ([0.04, 0.0, 0.2], 0.1, false),
        ([0.04, 0.14, 0.0], 0.1, true),
        ([0.04, 0.16, 0.0], 0.1, false),
    ] {
        let outcome = two_lanes(begin, &[length]).compile();
        let expected = match falls {
            true => vec![],
            false => vec![("E0410", "no `kind_0` can get to the sink rig.bin".into())],
        };
        assert_eq!(errors(&outcome), expected, "{begin:?}");
        let verdict = outcome.verdict.expect("a verdict");
        assert_eq!(verdict.passages.len(), usize::from(falls), "{begin:?}");
    }
}

#[test]
fn only_the_longer_kind_gets_over_a_gap() {
    let outcome = two_lanes([0.1, 0.0, 0.0], &[0.1, 0.3]).compile();
    assert_eq!(errors(&outcome), [("E0410", "no `kind_0` can get to the sink rig.bin".into())]);
    let notes = &outcome.diagnostics[0].notes;
    assert!(
        notes
            .iter()
            .any(|note| note == "beyond the end of rig.a it falls onto neither a conveyor nor a place"),
        "{notes:?}"
    );
}

/// What falls onto what lies between does not come to what is below that.
#[test]
fn the_highest_of_what_is_below_bears_an_item() {
    let mut texts = two_lanes([0.0, 0.0, -0.3], &[0.3]);
    texts.specs[0] = texts.specs[0].replacen(
        "out run:",
        "part between = lane { from: origin * frame(1, 0, 0.6, 90); length: 0.5; width: 0.4; speed: 0.5; }; out run:",
        1,
    );
    let outcome = texts.compile();
    assert_eq!(errors(&outcome), [("E0410", "no `kind_0` can get to the sink rig.bin".into())]);
    assert_eq!(passages(&outcome.verdict.expect("a verdict")), [["rig.a", "rig.between"]]);
}

/// Drawn gaps: what `check` says is what the items do.
#[test]
fn a_line_is_feasible_if_its_items_get_over_the_gap() {
    let mut random = Random::new(27);
    let mut between = |low: f64, high: f64| low + (high - low) * f64::from(random.up_to(1000)) / 1000.0;
    let mut over = 0;
    for _ in 0..60 {
        let (begin, length) =
            ([between(-0.3, 0.3), between(-0.25, 0.25), between(-0.3, 0.1)], between(0.05, 0.5));
        let mut texts = two_lanes(begin, &[length]);
        let is_feasible = texts.compile().project.is_some();
        // The same line, asked for less.
        texts.scenario =
            texts.scenario.map(|scenario| scenario.replace(r#""goal": {"rig.bin": {"kind_0": 1}}, "#, ""));
        assert_eq!(report(&texts).sinks.is_empty(), !is_feasible, "{begin:?} {length} m");
        over += usize::from(is_feasible);
    }
    assert!((15..45).contains(&over), "{over} of 60");
}

fn fixture(name: &str) -> Texts {
    let read = |ending: &str| text(&format!("tests/fixtures/ways/{name}.{ending}"));
    Texts {
        layout: read("json"),
        specs: vec![read("aut")],
        scenario: Some(read("scenario.json")),
        ..Texts::default()
    }
}

#[test]
fn a_table_under_a_chute_gives_its_items_to_an_arm() {
    let mut texts = fixture("table");
    let outcome = texts.compile();
    assert_eq!(errors(&outcome), []);
    let verdict = outcome.verdict.expect("a verdict");
    assert_eq!(passages(&verdict), [["c.belt", "t.top"]]);
    assert_eq!(verdict.sources, ["c"]);
    let without: Vec<&str> = verdict.losses.iter().map(|loss| loss.machine.as_str()).collect();
    assert_eq!(without, ["c", "t", "crane"]);
    assert_eq!(verdict.single_points, ["t", "crane"]);
    assert_eq!(report(&texts).reason, "all items collected");
    // Higher than the end of the chute.
    texts.layout = texts.layout.replace("[1.05, 0, 0]", "[1.05, 0, 0.2]");
    assert_eq!(errors(&texts.compile()), [("E0410", "no `box` can get to the sink out.store".into())]);
}

#[test]
fn a_vehicle_that_comes_under_a_chute_takes_its_items_to_an_arm() {
    let mut texts = fixture("vehicle");
    let outcome = texts.compile();
    assert_eq!(errors(&outcome), []);
    let verdict = outcome.verdict.expect("a verdict");
    assert_eq!(passages(&verdict), [["chute.belt", "v1.deck"]]);
    assert_eq!(verdict.sources, ["chute"]);
    assert_eq!(verdict.single_points, ["v1", "crane"]);
    assert_eq!(report(&texts).reason, "all items collected");
    texts.layout = texts.layout.replace("[-1.1, 0, 0]", "[-1.1, 1, 0]");
    assert_eq!(errors(&texts.compile()), [("E0410", "no `box` can get to the sink out.store".into())]);
}

/// The palletiser of the examples as two machines: a conveyor, and an arm with its pallet, which no handover joins.
#[test]
fn the_station_of_an_order_is_within_reach_of_what_brings_its_items() {
    let types = text("examples/scenes/palletizer.aut");
    let conveyor = "device infeed {
            part belt = lane { from: origin * frame(0, 0, 0.7, 0); length: 1.5; width: 0.3; speed: 0.4; };
            part feed = source { on: belt; inset: 0.2; };
            out run: bool = belt.run;
        }
        automaton Infeed on infeed { initial -> Runs { run := true; } state Runs { when false -> Runs {} } }";
    let apart = |x: f64, faults: &str| {
        let texts = Texts {
            layout: format!(
                r#"{{"robots": [{{"name": "infeed", "type": "infeed", "pose": [{x:?}, 0.5, 0]}},
                    {{"name": "robot", "type": "palletizer", "pose": [0, 0, 0]}}]}}"#
            ),
            specs: vec![
                types.replace("part feeder = source { on: infeed; inset: 0.2; };", ""),
                conveyor.into(),
            ],
            scenario: Some(format!(
                r#"{{"kinds": [{{"name": "box", "height": 0.15, "size": [0.2, 0.2]}}],
                    "orders": {{"count": 2, "parts": {{"box": 8}}}}{faults}}}"#
            )),
            ..Texts::default()
        };
        texts.compile().diagnostics
    };
    let found = apart(-3.0, "");
    let [missing] = &found[..] else { panic!("{found:?}") };
    let told = (missing.code, missing.message.as_str());
    assert_eq!(told, ("E0410", "no `box` can get to robot, whose orders ask for it"));
    let notes: Vec<&str> = missing.notes.iter().map(String::as_str).collect();
    assert_eq!(
        notes,
        [
            "machines that a `box` can get to: infeed",
            "beyond the end of infeed.belt it falls onto neither a conveyor nor a place",
            "the tool of robot stays at least 2.630 m away from items on infeed, the nearest of these machines",
        ]
    );
    // Within reach, as far as can be seen from above; and what falls from a gripper may get anywhere.
    assert_eq!(apart(-0.5, ""), []);
    let slips = r#", "faults": {"slips": [{"robot": "robot", "pick": 1, "after_s": 0.1}]}"#;
    assert_eq!(apart(-3.0, slips), []);
}

/// Conveyors in a row, of which every item passes the second one; with another inlet beside it, only the last one.
#[test]
fn every_item_passes_the_conveyors_of_a_row() {
    let device = |name: &str, automaton: &str, part: &str| {
        format!(
            "device {name} {{
                part belt = lane {{ from: origin; length: 1.0; width: 0.4; speed: 0.3; }};
                {part}
                out run: bool = belt.run;
            }}
            automaton {automaton} on {name} {{ initial -> Runs {{ run := true; }} state Runs {{ when false -> Runs {{}} }} }}"
        )
    };
    let specs = vec![
        device("inlet", "Inlet", "part feed = source { on: belt; inset: 0.1; };"),
        device("middle", "Middle", ""),
        device("outlet", "Outlet", "part bin = sink { of: belt; inset: 0; };"),
    ];
    let single_points = |more: &str| {
        let layout = format!(
            r#"{{"robots": [
                {{"name": "a", "type": "inlet", "pose": [0, 0, 0]}}, {{"name": "b", "type": "middle", "at": "a.belt"}},
                {{"name": "c", "type": "middle", "at": "b.belt"}}, {{"name": "d", "type": "outlet", "at": "c.belt"}}{more}
            ]}}"#
        );
        let scenario = r#"{"kinds": [{"name": "box", "height": 0.1}],
            "supply": {"items": {"a": ["box"]}}, "goal": {"d.bin": {"box": 1}}}"#;
        let texts =
            Texts { layout, specs: specs.clone(), scenario: Some(scenario.into()), ..Texts::default() };
        let outcome = texts.compile();
        assert_eq!(errors(&outcome), []);
        outcome.verdict.expect("a verdict").single_points
    };
    assert_eq!(single_points(""), ["b", "c"]);
    assert_eq!(single_points(r#", {"name": "e", "type": "inlet", "pose": [1, 0, 0]}"#), ["c"]);
}
