//! Commands of an arm that end in an error of reach: what the notes of a run say of them. And an arm that stands in an
//! obstacle before it moves.

use autogen::executor::Executor;
use autogen_tests::Texts;
use runtime_sim::memory::Memory;
use runtime_sim::report::Report;
use runtime_sim::run::{Stepping, run_again};

const ARM: &str = "
device ur {
    part arm = chain {
        from: origin; lengths: [0.1807, -0.6127, -0.57155, 0.17415, 0.11985, 0.11655]; tool_length: 0.15;
        rest: origin * point(0.6, 0.1, 0.3); speeds: [1.05, 1.05, 1.05, 1.05, 1.05, 1.05]; acceleration: 1.4;
    };
    part wrist = body { on: arm.wrist_3; low: point(-0.045, -0.045, -0.20); high: point(0.045, 0.045, -0.06); };
    out goal: point unit \"m\";
    out ahead: point;
    command 1 move(goal) = arm.joints(goal);
    command 2 reach(goal, ahead) = arm.facing(goal, ahead);
}
";

const FAR: &str = "
automaton Tester on ur {
    parameter far: point;
    parameter near: point;
    parameter slant: point;
    initial -> First {}
    state First = sequence { move(far); } -> Second {} else Second {}
    state Second = sequence { move(far); } -> Third {} else Third {}
    state Third = sequence { reach(near, slant); } -> Ended {} else Ended {}
    final state Ended;
}
";

fn texts(stationary: &str) -> Texts {
    let layout = format!(
        r#"{{"robots": [{{"name": "arm", "type": "tester", "pose": [0, 0, 0],
            "parameters": {{"far": [1.9, 0.2, 0.7], "near": [0.6, 0.2, 0.4], "slant": [1, 0, -1]}}}}],
            "stationary": [{stationary}]}}"#
    );
    let specs = vec![format!("{ARM}{FAR}")];
    Texts { layout, specs, scenario: Some(r#"{"time_limit_s": 5}"#.into()), ..Texts::default() }
}

fn run(texts: &Texts) -> Report {
    let project = texts.project();
    let mut executor = Executor::new(&project.system);
    run_again(&project.plant, &mut executor, Stepping::Events, &mut Memory::default(), &mut |_| {})
        .expect("a line that can be run")
}

#[test]
fn notes_say_which_places_were_missed_and_why() {
    let report = run(&texts(""));
    let [far, slant] = &report.notes[..] else { panic!("{:?}", report.notes) };
    assert!(far.starts_with("command 1 of arm ended in error 1 at "), "{far}");
    assert!(far.contains(" s, 2 times: (1.900, 0.200, 0.700) is out of reach by "), "{far}");
    assert!(slant.starts_with("command 2 of arm ended in error 1 at "), "{slant}");
    assert!(slant.ends_with(": the direction at (0.600, 0.200, 0.400) is neither down nor level"), "{slant}");
    assert_eq!(report.missed.len(), 3);
    assert!(report.to_json().contains("out of reach by "));
}

#[test]
fn an_arm_that_stands_in_an_obstacle_at_its_rest_is_named() {
    let block = |height: f64| {
        format!(r#"{{"name": "block", "type": "box", "pose": [0.6, 0.1, 0], "box": [0.2, 0.2, {height}]}}"#)
    };
    let codes = |texts: &Texts| -> Vec<&str> {
        texts.compile().diagnostics.iter().map(|diagnostic| diagnostic.code).collect()
    };
    assert_eq!(codes(&texts(&block(0.45))), ["E0409"]);
    // Under the wrist, whose lower end is 0.06 m over the finger tips.
    assert_eq!(codes(&texts(&block(0.35))), Vec::<&str>::new());
    let mut allowed = texts(&block(0.45));
    let may_touch = r#"{"may_touch": [{"pair": ["arm", "block"], "reason": "soft"}], "#;
    allowed.layout = allowed.layout.replacen('{', may_touch, 1);
    assert_eq!(codes(&allowed), Vec::<&str>::new());
}
