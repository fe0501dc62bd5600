//! What a run has looked up ahead does not hold when something else happens before.

use autogen::executor::Executor;
use autogen_tests::Texts;
use autogen_tests::words::with_words;
use runtime_sim::memory::Memory;
use runtime_sim::report::Report;
use runtime_sim::run::{Seen, Stepping, run_again};

/// A scan lasts so many seconds.
const SCAN: f64 = 0.01;

/// The report, and when a word of the inputs was first true, s; whichever scans are executed.
fn first_true(texts: &Texts, word: Option<&str>) -> (Report, Option<f64>) {
    let (project, words) = with_words(texts);
    let word = word.map(|name| words[name]);
    let execute = |stepping| {
        let (mut executor, mut memory, mut first) = (Executor::new(&project.system), Memory::default(), None);
        let mut observer = |seen: &Seen| {
            if word.as_ref().is_some_and(|word| word.value(seen) == 1.0) {
                first.get_or_insert(seen.scan as f64 * SCAN);
            }
        };
        let report = run_again(&project.plant, &mut executor, stepping, &mut memory, &mut observer);
        (report.expect("a line that runs"), first)
    };
    let events = execute(Stepping::Events);
    for stepping in [Stepping::EveryScan, Stepping::Checked] {
        assert_eq!(events, execute(stepping), "{stepping:?}");
    }
    events
}

/// A vehicle on a track, its hull so long to the front and to the back, m.
fn vehicle(name: &str, track: &str, length: f64) -> String {
    format!(
        "device {name} {{
            part drive = track {{ {track} mass: 10.0; }};
            part hull = body {{ on: drive; low: point(-{length}, -0.2, 0); high: point({length}, 0.2, 0.3); }};
            in place: int -1..1 = drive.place;
            in at: point unit \"m\" = drive.position;
            out goal: int 0..9;
            command 1 go(goal) = drive.to(goal);
        }}"
    )
}

/// 20 m along x at 1 m/s, reached after 0.2 s, its front 0.4 m ahead.
const ALONG: &str =
    "corners: [pose, pose + point(20, 0, 0)]; places: [0.0, 20.0]; speed: 1.0; acceleration: 5.0;";
const DRIVES_ALONG: &str = "automaton Along on along {
    initial -> There { go(1); }
    state There { when done -> Ended; }
    final state Ended;
}";

/// One vehicle drives along x. Another one stands 0.7 m beside its line, from x = 9.8 m on, and drives 0.5 m towards it.
fn vehicles(across: &str) -> Report {
    let aside =
        "corners: [pose, pose + point(0, -0.5, 0)]; places: [0.0, 0.5]; speed: 2.0; acceleration: 8.0;";
    let devices = [vehicle("along", ALONG, 0.4), vehicle("across", aside, 0.2)].concat();
    let texts = Texts {
        layout: r#"{"robots": [{"name": "along", "type": "along", "pose": [0, 0, 0]},
            {"name": "across", "type": "across", "pose": [10, 0.7, 0]}]}"#
            .into(),
        specs: vec![format!(
            "{devices}
            {DRIVES_ALONG}
            automaton Across on across {{ {across} final state Ended; }}"
        )],
        scenario: Some(r#"{"time_limit_s": 30}"#.into()),
        ..Texts::default()
    };
    first_true(&texts, None).0
}

#[test]
fn a_vehicle_that_sets_out_while_another_one_comes_is_run_into() {
    let report = vehicles(
        "initial -> Waiting {}
        state Waiting { when after 2 s -> In { go(1); } }
        state In { when done -> Ended; }",
    );
    let [contact] = &report.collisions[..] else { panic!("{report:?}") };
    let touches = 9.4 + 0.1;
    assert!((touches..touches + 3.0 * SCAN).contains(&contact.time_s), "{contact:?}");
}

#[test]
fn a_vehicle_that_comes_and_goes_while_another_one_passes_is_touched() {
    let report = vehicles(
        "initial -> Waiting {}
        state Waiting { when after 9500 ms -> In { go(1); } }
        state In { when done -> Out { go(0); } }
        state Out { when done -> Ended; }",
    );
    let [contact] = &report.collisions[..] else { panic!("{report:?}") };
    // It has to come 0.3 m nearer, and gets to its full speed on the first 0.25 m.
    let touches = 9.5 + 0.25 + 0.05 / 2.0;
    assert!((touches..touches + 4.0 * SCAN).contains(&contact.time_s), "{contact:?}");
}

/// One vehicle alone, which drives along x when it begins.
fn alone(states: &str) -> Report {
    let device = vehicle("along", ALONG, 0.4);
    let texts = Texts {
        layout: r#"{"robots": [{"name": "along", "type": "along", "pose": [0, 0, 0]}]}"#.into(),
        specs: vec![format!(
            "{device}
            automaton Along on along {{ initial -> There {{ go(1); }} {states} final state Ended; }}"
        )],
        scenario: Some(r#"{"time_limit_s": 30}"#.into()),
        ..Texts::default()
    };
    first_true(&texts, None).0
}

#[test]
fn a_guard_on_a_place_holds_when_it_is_passed() {
    let report = alone(
        "state There { when at.x > 5 -> Past; }
        state Past { when after 1 s -> Ended; }",
    );
    assert_eq!(report.machines[0].state, "Ended", "{report:?}");
}

#[test]
fn a_command_that_nobody_waits_for_is_booked_until_it_ends() {
    let report = alone("state There { when after 25 s -> Ended; }");
    let moving = report.machines[0].account.moving as f64 * SCAN;
    assert!((20.2..20.3).contains(&moving), "{moving}");
}

/// A piece crosses the line of a vehicle on a conveyor without a body, long before the vehicle comes; but the conveyor stops.
#[test]
fn a_piece_that_stops_on_its_way_is_run_into() {
    let crossing = "device crossing {
        part infeed = lane { from: origin * frame(0, -2, 0.1, 90); length: 4.0; width: 0.14; speed: 0.5; };
        part feeder = source { on: infeed; inset: 0.1; };
        part eye = beam { across: infeed; at: 2.0; };
        in at_line: bool = eye.sees;
        out run: bool = infeed.run stop false;
    }
    automaton Crossing on crossing {
        initial -> Running { run := true; }
        state Running { when at_line -> Standing { run := false; } }
        final state Standing;
    }";
    let texts = Texts {
        layout: r#"{"robots": [{"name": "along", "type": "along", "pose": [0, 0, 0]},
            {"name": "crossing", "type": "crossing", "pose": [10, 0, 0]}]}"#
            .into(),
        specs: vec![[&vehicle("along", ALONG, 0.4), crossing, DRIVES_ALONG].concat()],
        scenario: Some(ONE_PIECE.into()),
        ..Texts::default()
    };
    let (report, at_line) = first_true(&texts, Some("crossing_at_line"));
    assert!(at_line.is_some_and(|time| time < 7.0), "{at_line:?}");
    let [contact] = &report.collisions[..] else { panic!("{report:?}") };
    // The piece is 0.1 m long.
    let touches = 10.0 - 0.05 - 0.4 + 0.1;
    assert!((touches..touches + 3.0 * SCAN).contains(&contact.time_s), "{contact:?}");
}

const ONE_PIECE: &str = r#"{"kinds": [{"name": "piece", "height": 0.05, "size": [0.1, 0.1]}],
    "supply": {"items": ["piece"], "times": 1, "every_s": 2}, "time_limit_s": 20}"#;

/// A tool at rest over the end of a conveyor that brings one piece, 50 mm high.
fn under_a_tool(infeed: &str, grips: &str, automaton: &str) -> Texts {
    Texts {
        layout: r#"{"robots": [{"name": "cell", "type": "cell", "pose": [0, 0, 0]}]}"#.into(),
        specs: vec![format!(
            "device cell {{
                part infeed = lane {{ {infeed} length: 1.0; width: 0.14; speed: 0.25; }};
                part feeder = source {{ on: infeed; inset: 0.1; }};
                part eye = beam {{ across: infeed; at: 0.95; }};
                part robot = chain {{
                    from: origin * frame(0, 0, 0.95, 0); scara: [0.325, 0.275]; tool_length: 0.1;
                    lowest: [-132, -150, -0.2, -360]; highest: [132, 150, 0, 360];
                    speeds: [6.0, 7.0, 1.1, 20.0]; acceleration: 25.0;
                    rest: origin * point(0.25, 0.35, 0.83);
                }};
                {grips}
                in at_end: bool = eye.sees;
                in attached: bool = cup.holds;
                out run: bool = infeed.run stop false;
                out grip: bool = cup.close;
                out goal: point unit \"m\";
                command 1 move(goal) = robot.joints(goal);
            }}
            automaton Cell on cell {{ {automaton} }}"
        )],
        scenario: Some(ONE_PIECE.into()),
        ..Texts::default()
    }
}

/// A conveyor that rises by 0.8 m on one metre: its surface goes 1.28 times as fast as the piece goes along it.
#[test]
fn a_piece_on_a_rising_conveyor_is_gripped_as_it_passes() {
    let texts = under_a_tool(
        "from: origin * frame(-0.65, 0.35, 0.06, 0); rise: 0.8;",
        "part cup = grip { on: robot; period: 20 ms; looks: 1; near: 0.01; };",
        "initial -> Waiting { run := true; grip := true; }
        state Waiting { when attached -> Taken { run := false; } }
        state Taken { when done -> Ended; }
        final state Ended;",
    );
    let (report, attached) = first_true(&texts, Some("cell_attached"));
    assert!(attached.is_some(), "{report:?}");
}

/// One gripper has looked in vain for long when the other one of the same arm is switched on.
#[test]
fn a_second_gripper_looks_for_itself() {
    let texts = under_a_tool(
        "from: origin * frame(-0.65, 0.35, 0.76, 0);",
        "part cup = grip { on: robot; period: 20 ms; looks: 1; near: 0.03; };
        part small = grip { on: robot; period: 20 ms; looks: 1; near: 0.001; };
        out other: bool = small.close;",
        "initial -> Coming { run := true; other := true; }
        state Coming { when at_end -> Standing { run := false; } }
        state Standing { when after 1 s -> Waiting { grip := true; } }
        state Waiting { when attached -> Taken {} }
        state Taken { when done -> Ended; }
        final state Ended;",
    );
    let (report, attached) = first_true(&texts, Some("cell_attached"));
    assert!(attached.is_some(), "{report:?}");
}
