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

/// An arm whose last joint turns by 50 degrees to either side at most.
#[test]
fn a_tool_that_cannot_be_turned_so_is_not_said_to_be_out_of_reach() {
    let notes = |place: &str| {
        let specs = vec![
            "device six {
                part arm = chain {
                    from: origin * frame(0, 0, 0.4, 0);
                    opw: [0.100, -0.135, 0, 0.615, 0.705, 0.755, 0.085]; offsets: [0, 0, -90, 0, 0, 0];
                    tool_length: 0.15; rest: origin * point(0.9, 0.5, 0.95);
                    lowest: [-180, -100, -60, -30, -120, -50]; highest: [180, 110, 65, 30, 120, 50];
                    speeds: [2.6, 2.6, 2.6, 6.2, 6.2, 7.8]; acceleration: 4.0;
                };
                out goal: point unit \"m\";
                out turn: real;
                command 1 turned(goal, turn) = arm.oriented(goal, turn);
            }
            automaton Tester on six {
                parameter place: point;
                initial -> Along {}
                state Along = sequence { turned(place, 0.0); } -> Against {} else Against {}
                state Against = sequence { turned(place, 3.14159265); } -> Ended {} else Ended {}
                final state Ended;
            }"
            .into(),
        ];
        let layout = format!(
            r#"{{"robots": [{{"name": "arm", "type": "tester", "pose": [0, 0, 0], "parameters": {{"place": {place}}}}}]}}"#
        );
        run(&Texts { layout, specs, scenario: Some(r#"{"time_limit_s": 20}"#.into()), ..Texts::default() })
            .notes
    };
    let near = notes("[0.9, 0.3, 0.6]");
    assert_eq!(near.len(), 1, "{near:?}");
    let turned =
        ": (0.900, 0.300, 0.600) is in reach, but not with the tool turned so: a joint would pass its limit";
    assert!(near[0].starts_with("command 1 of arm") && near[0].ends_with(turned), "{near:?}");
    let far = notes("[2.9, 0.2, 0.7]");
    assert!(
        far.iter().any(|note| note.contains(" 2 times: (2.900, 0.200, 0.700) is out of reach by ")),
        "{far:?}"
    );
}
