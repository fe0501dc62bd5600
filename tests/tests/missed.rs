//! Commands of an arm that end in an error of reach: what the notes of a run say of them. And an arm that stands in an
//! obstacle before it moves.

use autogen::executor::Executor;
use autogen_tests::{Texts, ariac};
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

/// A collector may surround the end of a belt, and nothing else.
#[test]
fn a_machine_that_stands_in_a_collector_is_named() {
    let collector = |pose: &str| {
        let text =
            format!(r#"{{"name": "last", "type": "collector", "pose": {pose}, "box": [0.7, 0.9, 0.5]}}"#);
        let mut texts = ariac("default");
        texts.layout = texts.layout.replacen("\"stationary\": [", &format!("\"stationary\": [{text},"), 1);
        texts.compile().diagnostics.iter().map(|diagnostic| diagnostic.code).collect::<Vec<_>>()
    };
    assert_eq!(collector("[-2.27, 4.68, 0]"), ["E0409"], "in agv1");
    assert_eq!(collector("[-0.58, 4.7, 0]"), Vec::<&str>::new(), "at the other end of the belt");
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

const VACUUM: &str = "period: 20 ms; looks: 2;";

/// A cup that picks at a place, from a belt on which a box stands at (0.9, 0, 0.7), 0.1 m high.
fn notes_of_picks(cup: &str, place: &str, closes: bool) -> Vec<String> {
    let specs = vec![
        "device picker {
            part infeed = lane { from: origin * frame(0, 0, 0.7, 0); length: 1.0; width: 0.2; speed: 0.25; };
            part feeder = source { on: infeed; inset: 0.1; };
            part eye = beam { across: infeed; at: 0.95; };
            part slide = axis { from: origin * frame(0.8, 0, 1.25, 0); along: x; range: [0, 0.8]; speed: 1; acceleration: 4; };
            part lift = axis { on: slide; along: z; range: [-0.4, 0]; speed: 0.6; acceleration: 4; };
            part robot = chain { on: lift; tool_length: 0.1; rest: origin * point(0.9, 0, 1.0); };
            part cup = grip { on: robot; near: 0.02; CUP };
            in at_end: bool = eye.sees;
            out run: bool = infeed.run stop false;
            out grip: bool = cup.close;
            out goal: point unit \"m\";
            command 1 move(goal) = robot.joints(goal);
            command 2 pick(goal) = robot.joints(goal) then cup.holds within 500 ms else 2;
        }
        automaton Picker on picker {
            parameter place: point;
            parameter closes: bool;
            local tries: int 0..9;
            initial -> Waiting { run := true; }
            state Waiting { when at_end or after 8 s -> Picking { run := false; grip := closes; } }
            state Picking = sequence { pick(place); } -> Ended {} else Again { tries += 1; }
            state Again = sequence { move(point(0.9, 0, 1.0)); } -> Once {} else Ended {}
            state Once { when tries < 2 -> Picking {} when tries >= 2 -> Ended {} }
            final state Ended;
        }"
        .replace("CUP", cup),
    ];
    let layout = format!(
        r#"{{"robots": [{{"name": "arm", "type": "picker", "pose": [0, 0, 0], "parameters": {{"place": {place}, "closes": {closes}}}}}]}}"#
    );
    let scenario = r#"{"kinds": [{"name": "box", "height": 0.1, "size": [0.1, 0.1]}],
        "supply": {"items": ["box"]}, "time_limit_s": 20}"#;
    run(&Texts { layout, specs, scenario: Some(scenario.into()), ..Texts::default() }).notes
}

#[test]
fn notes_say_why_nothing_was_gripped() {
    assert_eq!(notes_of_picks(VACUUM, "[0.9, 0, 0.8]", true), Vec::<String>::new());
    let is_said = |notes: &[String], reason: &str| {
        let [note] = notes else { panic!("{notes:?}") };
        assert!(note.starts_with("command 2 of arm ended in error 2 at "), "{note}");
        assert!(note.ends_with(reason), "{note}");
    };
    is_said(
        &notes_of_picks(VACUUM, "[0.94, 0, 0.83]", true),
        " s, 2 times: nothing was gripped at (0.940, 0.000, 0.830): the nearest item, box_1, is gripped at \
         (0.900, 0.000, 0.800), 50.0 mm away, and the gripper takes it within 20.0 mm",
    );
    is_said(
        &notes_of_picks(VACUUM, "[0.9, 0, 0.8]", false),
        "(0.900, 0.000, 0.800): the gripper is not closed",
    );
    let fingers = |closes: u32| {
        let cup = format!("closes: {closes} ms; opens: 300 ms; sure_after: 1000 ms;");
        notes_of_picks(&cup, "[0.9, 0, 0.8]", true)
    };
    is_said(&fingers(800), ": box_1 is held, which the gripper reports later than the command waits for it");
    is_said(
        &fingers(100),
        ": box_1 is there, but the gripper has not taken it: it looked before the tool came, or the command does not wait long enough",
    );
}
