//! Kinds that are gripped below their upper sides.

use autogen::backend::st;
use autogen::executor::Executor;
use autogen::scenario;
use autogen_tests::{Texts, ariac, side_by_side};
use runtime_sim::carrier::Carrier;
use runtime_sim::line::Line;
use runtime_sim::memory::Memory;
use runtime_sim::report::Report;
use runtime_sim::run::{Seen, Stepping, run_again};

/// The run, which is the same however it is stepped.
fn run(texts: &Texts, mut observer: impl FnMut(&Seen)) -> Report {
    let project = texts.project();
    // What is deployed reads the line from its text.
    let plant = Line::from_text(&project.plant.to_text()).expect("the text of a line");
    let execute = |stepping, see: &mut dyn FnMut(&Seen)| {
        let mut executor = Executor::new(&project.system);
        run_again(&plant, &mut executor, stepping, &mut Memory::default(), see)
            .expect("a line that can be run")
    };
    let every = execute(Stepping::EveryScan, &mut observer);
    assert_eq!(execute(Stepping::Events, &mut |_| {}), every);
    every
}

/// The Cartesian robot of the scenes; its pieces are 100 mm high, and gripped so far over their undersides.
fn robot(grasp: Option<f64>) -> Texts {
    let mut texts = side_by_side("scenes/pick_and_place");
    if let Some(grasp) = grasp {
        let scenario = texts.scenario.as_mut().expect("a scenario");
        let with = scenario.replace("\"height\": 0.1,", &format!("\"height\": 0.1, \"grasp\": {grasp},"));
        assert_ne!(*scenario, with);
        *scenario = with;
    }
    texts
}

/// How far over the underside of what hangs on it the tool is in each scan, m.
fn hangs(texts: &Texts) -> (Report, Vec<f64>) {
    let mut all = Vec::new();
    let report = run(texts, |seen: &Seen| {
        let plant = seen.plant;
        for (number, item) in plant.items().all().enumerate() {
            if let (Carrier::Grip { machine, .. }, Some(place)) = (item.carrier, plant.place(number)) {
                let tool = plant.position(machine).expect("a tool");
                all.push((tool.z - place.z).hypot(tool.x - place.x));
            }
        }
    });
    (report, all)
}

#[test]
fn an_item_hangs_by_its_grip_point() {
    for grasp in [None, Some(0.1), Some(0.085)] {
        let (report, hangs) = hangs(&robot(grasp));
        assert_eq!(report.reason.to_string(), "all items collected", "{grasp:?}");
        let wanted = grasp.unwrap_or(0.1);
        assert!(hangs.len() > 100, "{}", hangs.len());
        assert!(hangs.iter().all(|hang| (hang - wanted).abs() < 1e-3), "{grasp:?} {:?}", hangs[0]);
    }
}

/// A gripper 10 mm near at most finds nothing on the upper side if that is 15 mm over the grip point.
#[test]
fn the_upper_side_is_no_contact_then() {
    let mut texts = robot(Some(0.085));
    texts.specs[0] = texts.specs[0].replace("surface + kind_grasps[0]", "surface + kind_heights[0]");
    assert!(texts.specs[0].contains("near: 0.02"));
    texts.specs[0] = texts.specs[0].replace("near: 0.02", "near: 0.01");
    let (report, hangs) = hangs(&texts);
    assert!(hangs.is_empty() && !report.finished, "{}", report.reason);
    let mut texts = robot(None);
    texts.specs[0] = texts.specs[0].replace("surface + kind_grasps[0]", "surface + kind_heights[0]");
    assert!(run(&texts, |_| {}).finished);
}

/// The rod of the lift ends 20 mm over the tool, and is not around the pieces.
#[test]
fn a_gripper_in_the_piece_is_a_contact() {
    let reason = run(&robot(Some(0.075)), |_| {}).reason.to_string();
    assert!(reason.starts_with("collision of picker (rod) with picker (piece_1)"), "{reason}");
}

/// Over the wall the tool is 150 mm over where it grips, so the underside is 850 mm high, whatever the grip point.
#[test]
fn what_hangs_lower_or_higher_is_checked_for_contact() {
    for grasp in [None, Some(0.085)] {
        let with_wall = |top: f64| {
            let mut texts = robot(grasp);
            let wall = format!(
                r#""stationary": [{{"name": "wall", "type": "box", "pose": [1.15, 0, 0], "box": [0.02, 0.1, {top}]}}], "robots""#
            );
            texts.layout = texts.layout.replace("\"robots\"", &wall);
            run(&texts, |_| {}).reason.to_string()
        };
        assert_eq!(with_wall(0.845), "all items collected", "{grasp:?}");
        let touches = with_wall(0.855);
        assert!(touches.starts_with("collision of picker (piece_1) with wall (body)"), "{grasp:?} {touches}");
    }
}

/// The line of the paper with other heights and grip points of its kinds.
fn line(height: f64, grasp: f64) -> Texts {
    let mut scenario: serde_json::Value = serde_json::from_str(scenario::DEFAULT).expect("a scenario");
    for kind in scenario["kinds"].as_array_mut().expect("a list") {
        kind["height"] = height.into();
        kind["grasp"] = grasp.into();
    }
    Texts { scenario: Some(scenario.to_string()), ..ariac("default") }
}

/// Reach, margins and what controllers know are those of kinds that are as high as the others' grip points.
#[test]
fn arms_are_asked_at_the_grip_points() {
    let found = |height: f64, grasp: f64| {
        let outcome = line(height, grasp).compile();
        let project = outcome.project.expect("a line");
        let margins: Vec<(usize, usize, f64)> =
            project.edges.iter().map(|edge| (edge.from, edge.to, edge.margin)).collect();
        let mut files = st::files(&project.system, &outcome.sources);
        (margins, files.remove("codesys/GVL_Parameters.st").expect("the parameters"))
    };
    let [low, low_gripped, high] = [[0.06, 0.06], [0.11, 0.06], [0.11, 0.11]].map(|[h, g]| found(h, g));
    assert_eq!(low_gripped, low);
    assert!(high.0 != low.0 && high.1 != low.1);
}

/// Fingers that hold a piece 300 ms after they begin to close report this 1 s later; the arm lifts it in between. Told of it,
/// the arm lets go.
#[test]
fn fingers_hold_before_they_report_it() {
    let device = "device cell {
            part infeed = lane { from: origin * frame(0, 0, 0.7, 0); length: 1.0; width: 0.2; speed: 0.25; };
            part feeder = source { on: infeed; inset: 0.3; };
            part slide = axis {
                from: origin * frame(0.3, 0, 1.25, 0); along: x; range: [0, 1.2]; speed: 1.0; acceleration: 4.0;
            };
            part lift = axis { on: slide; along: z; range: [-0.4, 0]; speed: 0.6; acceleration: 4.0; };
            part robot = chain { on: lift; tool_length: 0.1; rest: origin * point(0.5, 0, 1.0); };
            part hand = grip { on: robot; closes: 300 ms; opens: 300 ms; sure_after: 1 s; near: 0.01; };
            in attached: bool = hand.holds;
            out grip: bool = hand.close;
            out run: bool = infeed.run;
            out release: bool = feeder.release;
            out goal: point unit \"m\";
            command 1 move(goal) = robot.joints(goal);
            constant pick_at: point unit \"m\" = origin * point(0.3, 0, 0.7 + kind_grasps[0]);
        }
        automaton Cell on cell {
            initial -> Releasing { release := true; }
            state Releasing { when after 1 s -> Moving { move(pick_at); } }
            state Moving { when done -> Closing { grip := true; } }
            state Closing { when after 500 ms -> Lifting { move(pick_at + up(0.2)); } }
            state Lifting { when attached -> Lifted { grip := false; } }
            state Lifted { when false -> Lifted {} }
        }";
    let scenario = r#"{"kinds": [{"name": "blank", "height": 0.05, "size": [0.05, 0.05]}],
        "supply": {"items": ["blank"]}, "time_limit_s": 20}"#;
    let texts = Texts {
        layout: r#"{"robots": [{"name": "cell", "type": "cell", "pose": [0, 0, 0]}]}"#.into(),
        specs: vec![device.into()],
        scenario: Some(scenario.into()),
        ..Texts::default()
    };
    let mut highest = 0.0_f64;
    run(&texts, |seen| highest = highest.max(seen.plant.place(0).map_or(0.0, |place| place.z)));
    assert!((highest - 0.9).abs() < 1e-6, "{highest}");
    let (_, hangs) = hangs(&texts);
    // The scan in which it is told, and that in which it obeys.
    assert!((100..=102).contains(&hangs.len()), "{} scans", hangs.len());
}
