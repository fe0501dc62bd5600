//! The scenario of a counterexample: read again, it is that of the line that was replayed.

use autogen::schema;
use autogen::verify::scenario;
use autogen_search::plant::Faults;
use autogen_tests::replayed::replayed;
use autogen_tests::{Texts, ariac, own_line, text};
use runtime_sim::line::Line;
use serde_json::Value;
use std::collections::BTreeSet;

/// A list of orders, and all faults but those of processes and of what moves by itself.
const LISTED: &str = r#"{
    "kinds": [
        {"name": "battery", "height": 0.053, "grasp": 0.05, "size": [0.135, 0.06], "is": ["metal", "black"], "mass": 0.3},
        {"name": "pump", "height": 0.11}
    ],
    "orders": [{"station": ["as1", "as3"], "parts": {"battery": 2}}, {"station": "as2", "parts": {"pump": 1}}],
    "supply": {"items": {"conveyor_belt": ["pump", "battery", "battery"]}, "first_s": 0.0, "every_s": 4.5, "seed": 7},
    "time_limit_s": 600.5,
    "faults": {
        "slips": [{"robot": "kitting", "pick": 2, "after_s": 0.8}],
        "refusals": [{"robot": "agv1", "command": 2}],
        "answers": [{"robot": "kitting", "command": 5, "late_s": 1.5, "error": 2}, {"robot": "agv2", "command": 1, "late_s": 2}],
        "pauses": [{"at_s": 30, "for_s": 5}],
        "power_offs": [{"at_s": 300, "for_s": 0.1}],
        "sensors": [
            {"robot": "kitting", "signal": "attached", "reads": false, "at_s": 50, "for_s": 0.5},
            {"robot": "kitting", "signal": "ack", "reads": 3, "at_s": 60},
            {"robot": "conveyor_belt", "signal": "sees", "element": "pump", "reads": true, "at_s": 70, "for_s": 2},
            {"robot": "conveyor_belt", "signal": "sees", "reads": true, "at_s": 80, "for_s": 2}
        ]
    }
}"#;
/// Items for a sink, and the other faults.
const COLLECTED: &str = r#"{
    "kinds": [
        {"name": "blank", "height": 0.02, "size": [0.04, 0.04]},
        {"name": "bracket", "height": 0.02, "size": [0.04, 0.04]}
    ],
    "supply": {"items": ["blank"], "times": 4},
    "goal": {"outfeed.box": {"bracket": 3}},
    "faults": {
        "jams": [{"robot": "mill", "part": "door", "at_s": 30, "for_s": 5}, {"robot": "mill", "part": "door", "at_s": 90}],
        "slow": [{"robot": "mill", "part": "cycle", "cycle": 2, "longer_s": 30}]
    }
}"#;
/// Nothing is asked for, and somebody operates what there is.
const OPERATED: &str = r#"{
    "time_limit_s": 60,
    "operator": [
        {"robot": "desk", "part": "start", "at_s": 0.5},
        {"robot": "desk", "part": "speed", "at_s": 5, "for_s": 2, "value": 0.4},
        {"part": "reset", "at_s": 8, "for_s": 0.2},
        {"part": "start", "at_s": 9}
    ]
}"#;
const WITHOUT_END: &str = r#"{
    "kinds": [{"name": "battery", "height": 0.053}, {"name": "pump", "height": 0.11}],
    "orders": {"count": "without end", "parts": {"battery": 1}}
}"#;
const ONE_PART: &str = r#"{
    "kinds": [{"name": "battery", "height": 0.053}, {"name": "pump", "height": 0.11}],
    "orders": [{"station": "as3", "parts": {"battery": 1}}]
}"#;

/// A desk with a button and a set-point, and a positioner that may refuse its commands.
const DESK: &str = "
    device desk {
        part start = button {};
        part speed = setpoint { begins: 1.0; };
        part slide = positioner { positions: [0, 1]; slides: point(0, 0, 1); speed: 0.5; };
        in pressed: bool = start.on;
        out goal: int 0..1;
        command 1 go(goal) = slide.to(goal);
    }";

fn desk(automaton: &str, scenario: &str) -> Texts {
    Texts {
        specs: vec![DESK.into(), automaton.into()],
        scenario: Some(scenario.into()),
        ..Texts::of_layout(r#"{"robots": [{"name": "desk", "type": "press", "pose": [0, 0, 0]}]}"#)
    }
}

/// Two refusals violate it, the second one after a second.
const TRIES: &str = "automaton Press on desk {
    local tries: int 0..9;
    initial state Waiting { when pressed -> Going { go(1); } }
    state Going { when failed -> Failed { tries += 1; } when done -> Going { go(0); } }
    state Failed { when after 1 s -> Going { go(1); } }
    invariant tries < 2;
}";

fn tending(scenario: &str) -> Texts {
    Texts {
        specs: vec![text("examples/tending/tending.aut")],
        scenario: Some(scenario.into()),
        ..Texts::of_layout(text("examples/tending/tending.json"))
    }
}

/// The line with the scenario that is written of another one.
fn again(texts: &Texts, line: &Line) -> Line {
    let system = texts.project().system;
    let scenario = scenario::text(&system, line);
    Texts { scenario: Some(scenario), ..texts.clone() }.project().plant
}

/// Without the one for editors.
fn keys(schema: &Value) -> BTreeSet<String> {
    let keys = schema["properties"].as_object().expect("an object").keys().cloned();
    keys.filter(|key| key != "$schema").collect()
}

#[test]
fn a_scenario_that_is_written_is_the_same_when_it_is_read() {
    let lines = [
        (Texts { scenario: Some(LISTED.into()), ..ariac("default") }, LISTED),
        (tending(COLLECTED), COLLECTED),
        (desk(TRIES, OPERATED), OPERATED),
    ];
    let (mut used, mut faults) = (BTreeSet::new(), BTreeSet::new());
    for (texts, scenario) in &lines {
        let line = texts.project().plant;
        let again = again(texts, &line);
        assert_eq!((again.scenario, again.kinds), (line.scenario, line.kinds));
        let scenario: Value = serde_json::from_str(scenario).expect("JSON");
        used.extend(scenario.as_object().expect("an object").keys().cloned());
        faults.extend(scenario["faults"].as_object().into_iter().flat_map(|faults| faults.keys().cloned()));
    }
    let mut all = schema::scenario();
    assert_eq!(used, keys(&all));
    assert_eq!(faults, keys(&all["properties"]["faults"].take()));
}

/// The buffer without the lock of its table.
fn unlocked(scenario: &str) -> Texts {
    let mut texts = Texts { scenario: Some(scenario.into()), ..own_line("buffer") };
    assert!(texts.specs[0].contains("held := true;"));
    texts.specs[0] = texts.specs[0].replace("held := true;", "");
    texts
}

#[test]
fn the_scenario_of_a_counterexample_is_that_of_its_replay() {
    let pressed = r#"{"time_limit_s": 60, "operator": [{"robot": "desk", "part": "start", "at_s": 0.5}]}"#;
    let mut goal = tending(COLLECTED);
    goal.specs[0] =
        goal.specs[0].replace("\n    state Emptying", "\n    invariant not empty;\n    state Emptying");
    for (name, texts, faults) in [
        ("a goal", goal, Faults::None),
        (
            "orders",
            unlocked(&ONE_PART.replace(r#""battery": 1"#, r#""battery": 1, "pump": 1"#)),
            Faults::None,
        ),
        ("orders without end", unlocked(WITHOUT_END), Faults::None),
        ("no orders, and an operator", desk(TRIES, pressed), Faults::All),
        (
            "no orders",
            desk(&TRIES.replace("when pressed", "when after 10 ms"), r#"{"time_limit_s": 60}"#),
            Faults::All,
        ),
    ] {
        let replay = replayed(&texts, faults);
        assert!(replay.result.is_ok(), "{name}: {:?}", replay.result);
        let again = again(&texts, &replay.line);
        assert_eq!((again.scenario, again.kinds), (replay.line.scenario, replay.line.kinds), "{name}");
    }
}
