//! Whom machines wait for, as the report counts it, on a line whose times follow from the rules.

use autogen::executor::Executor;
use autogen_tests::Texts;
use runtime_sim::run::{Stepping, run};
use serde_json::{Value, json};

/// A zone that two arms want, and a lamp that is lit when the arms have had it.
const TYPES: &str = r#"
interface Zone { shared held: bool := false by lock; shared rung: bool := false by handshake; }
device bench {
    part slide = positioner { positions: [0, 1]; slides: point(0, 0, 1); speed: 0.5; };
    out to: int 0..1;
    command 1 go(to) = slide.to(to);
}
device post { part key = button {}; in pressed: bool = key.on; }
automaton Gate on post is Zone {
    initial state Waits { when rung -> Rung { rung := false; } }
    state Rung { when false -> Rung {} }
}
/// It sees the zones, and writes nothing of theirs.
automaton Eye on post {
    knows zones: Zone[1..];
    initial state Looks { when exists z in zones: z.held -> Looks {} }
}
automaton Arm on bench {
    knows zones: Zone[1..];
    initial -> Rising { go(1); }
    state Rising { when done, first z in zones with not z.held -> Inside { z.held := true; } }
    state Inside { when after 6 s, first z in zones -> Outside { z.held := false; z.rung := true; } }
    state Outside { when false -> Outside {} }
}"#;

/// For each machine the seconds that it was moving, working and waiting, and for whom.
fn accounts(gates: usize) -> Value {
    let gates = (1..=gates).map(|n| format!(r#"{{"name": "gate{n}", "type": "gate", "pose": [{n}, 0, 0]}}"#));
    let arms = [1, 2].map(|n| format!(r#"{{"name": "arm{n}", "type": "arm", "pose": [{n}, 5, 0]}}"#));
    let eye = r#"{"name": "eye", "type": "eye", "pose": [0, 9, 0]}"#.to_string();
    let robots: Vec<String> = gates.chain(arms).chain([eye]).collect();
    let texts = Texts {
        layout: format!(r#"{{"robots": [{}]}}"#, robots.join(", ")),
        specs: vec![TYPES.into()],
        scenario: Some(r#"{"time_limit_s": 20}"#.into()),
        ..Texts::default()
    };
    let project = texts.project();
    let mut executor = Executor::new(&project.system);
    let report = run(&project.plant, &mut executor, Stepping::Events, &mut |_| {}).expect("a line that runs");
    let report: Value = serde_json::from_str(&report.to_json()).expect("JSON");
    report["robots"].clone()
}

#[test]
fn a_lock_that_another_holds_is_waited_for_and_the_answer_to_a_command_is_not() {
    let accounts = accounts(1);
    let [first, second] = ["arm1", "arm2"].map(|name| &accounts[name]);
    // Both are up at the same time. The first one takes the zone for 6 s; the second waits for it.
    assert_eq!([&first["working_s"], &second["working_s"]], [6.0, 6.0]);
    assert_eq!(first["waiting_for"], json!({}));
    assert_eq!(second["waiting_for"], json!({"gate1": 6.0}));
    // Its own cell is rung by the arms, and by nobody else that knows it.
    let gate = &accounts["gate1"];
    assert_eq!(gate["waiting_for"]["eye"], Value::Null);
    assert_eq!(gate["waiting_for"]["arm1"], gate["waiting_for"]["arm2"]);
    assert!(gate["waiting_for"]["arm1"].as_f64().expect("seconds") > 8.0, "{accounts}");
}

/// A parameter names one member, or several.
#[test]
fn who_is_known_by_a_parameter_is_waited_for() {
    let texts = Texts {
        layout: r#"{"robots": [
            {"name": "gate", "type": "gate", "pose": [0, 0, 0]},
            {"name": "caller", "type": "caller", "pose": [1, 0, 0], "parameters": {"gate": "gate"}}]}"#
            .into(),
        specs: vec![format!(
            "{TYPES} automaton Caller on post {{
                parameter gate: Zone;
                initial state Calls {{ when after 2 s -> Waits {{ gate.rung := true; }} }}
                state Waits {{ when gate.held -> Waits {{}} }}
            }}"
        )],
        scenario: Some(r#"{"time_limit_s": 10}"#.into()),
        ..Texts::default()
    };
    let project = texts.project();
    let mut executor = Executor::new(&project.system);
    let report = run(&project.plant, &mut executor, Stepping::Events, &mut |_| {}).expect("a line that runs");
    let report: Value = serde_json::from_str(&report.to_json()).expect("JSON");
    let waited_for = |name: &str| report["robots"][name]["waiting_for"].clone();
    assert!(waited_for("gate")["caller"].as_f64().is_some_and(|seconds| seconds > 1.9), "{report}");
    assert!(waited_for("caller")["gate"].as_f64().is_some_and(|seconds| seconds > 7.9), "{report}");
}

/// All zones of a line would tell nothing.
#[test]
fn members_of_a_large_role_are_not_named() {
    assert_eq!(accounts(9)["arm2"]["waiting_for"], json!({}));
}
