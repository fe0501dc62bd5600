//! What the check of connectivity says of whole layouts.

use autogen::executor::Executor;
use autogen::lower::{Handover, Outcome, Verdict};
use autogen_tests::{LAYOUTS, Texts, ariac, on_all_processors, text};
use runtime_sim::device::{Direction, error};
use runtime_sim::random::Random;
use runtime_sim::run::{Stepping, run};

/// The default layout with one text replaced by another, which has to be there.
fn changed(from: &str, to: &str) -> Outcome {
    let layout = text("examples/ariac2021/default.json");
    assert!(layout.contains(from), "`{from}` is not in the layout");
    Texts::of_layout(layout.replacen(from, to, 1)).compile()
}

fn verdict(outcome: &Outcome) -> &Verdict {
    outcome.verdict.as_ref().expect("a layout that can be judged")
}

fn codes(outcome: &Outcome) -> Vec<&'static str> {
    outcome.diagnostics.iter().map(|d| d.code).collect()
}

#[test]
fn the_default_layout_has_exactly_the_edges_of_the_paper() {
    let outcome = ariac("default").compile();
    let edges: Vec<(&str, &str)> =
        verdict(&outcome).edges.iter().map(|edge| (edge.from.as_str(), edge.to.as_str())).collect();
    let mut expected = vec![("conveyor_belt", "kitting")];
    let agvs = ["agv1", "agv2", "agv3", "agv4"];
    expected.extend(agvs.map(|agv| ("kitting", agv)));
    expected.extend(agvs.map(|agv| (agv, "gantry")));
    expected.extend(["as1", "as2", "as3", "as4"].map(|station| ("gantry", station)));
    assert_eq!(edges, expected);
    assert_eq!(edges.len(), 13);
}

#[test]
fn margins_are_those_of_an_independent_calculation() {
    let within = |layout: &str, from: &str, low: f64, high: f64| {
        for Handover { from: a, to: b, margin, .. } in &verdict(&ariac(layout).compile()).edges {
            if a.starts_with(from) {
                assert!((low..=high).contains(margin), "{layout}: {a} -> {b} has {margin}");
            }
        }
    };
    within("default", "conveyor_belt", 0.26, 1.0);
    within("default", "kitting", 0.26, 1.0);
    within("default", "agv", 0.08, 0.10);
    within("default", "gantry", 0.265, 1.0);
    within("spaced", "kitting", 0.04, 0.09);
}

#[test]
fn a_vehicle_that_is_partly_or_wholly_out_of_reach_is_named_with_a_suggested_change() {
    // The pair of the paper's Fig. 2: the arm is too far from the vehicle.
    for (x, all) in [("-2.765685", false), ("-3.265685", true)] {
        let outcome = changed("[-2.265685, -1.333917, 0]", &format!("[{x}, -1.333917, 0]"));
        assert_eq!(codes(&outcome), ["E0401"]);
        let v = verdict(&outcome);
        assert!(!v.feasible);
        assert_eq!(v.unreachable, ["agv3"]);
        let apart = v
            .apart
            .iter()
            .find(|a| a.from == "kitting" && a.to == "agv3")
            .expect("the pair that should have met");
        assert_eq!(apart.misses.len() == apart.tested, all);
        assert!(apart.misses.iter().all(|m| m.missing_mm > 0.0));
        let (robot, path, _, value) = apart.suggestion.clone().expect("a suggestion");
        assert_eq!((robot.as_str(), path.as_str()), ("agv3", "pose[0]"));
        assert!(
            ariac_with_agv3_at(value).project.is_some(),
            "the suggestion {value} makes the layout feasible"
        );
        assert!(ariac_with_agv3_at(value - 0.001).project.is_none(), "a millimetre shorter does not");
    }
}

fn ariac_with_agv3_at(x: f64) -> Outcome {
    changed("[-2.265685, -1.333917, 0]", &format!("[{x}, -1.333917, 0]"))
}

#[test]
fn a_short_rail_misses_the_outer_vehicles() {
    let layout = text("examples/ariac2021/default.json")
        .replace("\"rail_range\": [-4.8, 4.8]", "\"rail_range\": [-2.75, 2.75]");
    let outcome = Texts::of_layout(layout).set("agv.capacity=12").compile();
    let v = verdict(&outcome);
    let apart = v.apart.iter().find(|a| a.to == "agv1").expect("the pair that should have met");
    let least = apart.misses.iter().map(|m| m.missing_mm).fold(f64::MAX, f64::min);
    assert!((539.0..541.0).contains(&least), "{least}");
    assert_eq!(v.unreachable, ["agv1", "agv4"]);
}

#[test]
fn a_station_out_of_the_gantrys_reach_is_unreachable() {
    let outcome = changed("\"pose\": [-12.3, 3, 0]", "\"pose\": [-17, 3, 0]");
    assert_eq!(codes(&outcome), ["E0401"]);
    assert_eq!(verdict(&outcome).unreachable, ["as2"]);
}

#[test]
fn a_source_without_a_way_is_a_dead_end() {
    let outcome = changed("\"pose\": [-0.573076, 0, 0]", "\"pose\": [1.5, 0, 0]");
    let v = verdict(&outcome);
    assert!(v.dead_ends.contains(&"conveyor_belt".to_string()), "{:?}", v.dead_ends);
    assert!(!v.feasible);
}

#[test]
fn a_robot_that_gives_and_takes_back_is_refused() {
    let layout =
        text("examples/buffer/buffer.json").replace(",\n      \"takes_from\": [\"conveyor_belt\"]", "");
    let specs = vec![text("examples/buffer/specs/buffer.aut")];
    let outcome = Texts { layout, specs, ..Texts::default() }.compile();
    assert_eq!(codes(&outcome), ["E0504"]);
}

/// A layout drawn around the default one.
fn drawn(seed: u64) -> String {
    let mut random = Random::new(seed);
    let mut about = |middle: f64, half: f64| middle + half * (f64::from(random.up_to(2000)) / 1000.0 - 1.0);
    let mut layout = text("examples/ariac2021/default.json");
    let belt = format!("[{}, {}, 0]", about(-0.4, 0.3), about(0.0, 1.0));
    layout = layout.replace("[-0.573076, 0, 0]", &belt);
    for y in ["4.675404", "1.367643", "-1.333917", "-4.696062"] {
        let place = format!("[{}, {y}, 0]", about(-2.35, 0.25));
        layout = layout.replace(&format!("[-2.265685, {y}, 0]"), &place);
    }
    layout.replace(
        "\"pose\": [-12.3, 3, 0]",
        &format!("\"pose\": [{}, 3, {}]", about(-13.5, 2.0), about(0.0, 0.2)),
    )
}

/// Verbs of commands that end in the same error where no path is free: `travel`, `bring` and `fetch` of a gantry.
const PLANNED: [f64; 3] = [6.0, 7.0, 8.0];

#[test]
fn no_feasible_layout_fails_for_reach() {
    let count = if std::env::var("AUTOGEN_CAMPAIGN").is_ok_and(|v| v == "full") { 1000 } else { 8 };
    let seeds: Vec<u64> = (0..count).collect();
    let results = on_all_processors(&seeds, |seed| {
        let outcome = Texts::of_layout(drawn(*seed)).set("agv.capacity=12").compile();
        let Some(project) = outcome.project else {
            assert!(
                outcome.verdict.is_some_and(|v| !v.feasible),
                "layout {seed} is refused for another reason"
            );
            return None;
        };
        let mut executor = Executor::new(&project.system);
        let (mut unreachable, mut blocked) = (0, 0);
        let mut last = vec![(0.0, 0.0); project.system.instances.len()];
        let kinds = project.plant.kinds.len();
        let places: Vec<Option<[usize; 4]>> = (0..project.system.instances.len())
            .map(|i| {
                let device = &project.system.automaton_of(i).device;
                device.port("error").filter(|p| p.direction == Direction::Input)?;
                Some(
                    ["error", "ack", "cmd", "verb"]
                        .map(|port| device.offset(port, kinds).expect("a commanded device")),
                )
            })
            .collect();
        let report = run(&project.plant, &mut executor, Stepping::Events, &mut |seen| {
            for (machine, place) in places.iter().enumerate() {
                let Some([error, ack, cmd, verb]) = *place else { continue };
                // Of the command before: this scan may have given another one.
                let (inputs, outputs) = (&seen.inputs[machine], &seen.outputs[machine]);
                let (number, verb) = std::mem::replace(&mut last[machine], (outputs[cmd], outputs[verb]));
                if inputs[error] == f64::from(error::UNREACHABLE) && inputs[ack] == number {
                    let count = if PLANNED.contains(&verb) { &mut blocked } else { &mut unreachable };
                    *count += 1;
                }
            }
        })
        .expect("a line that can be run");
        assert_eq!(unreachable, 0, "layout {seed}");
        // Which machines are in each other's way, the check does not say.
        let collides = report.reason.starts_with("collision of ") || blocked > 0;
        assert!(report.finished || collides, "layout {seed}: {}", report.reason);
        Some(collides)
    });
    let feasible = results.iter().flatten().count();
    let colliding = results.iter().flatten().filter(|collides| **collides).count();
    println!(
        "{count} layouts, {feasible} feasible, none failed for reach, {colliding} where machines are in each other's way"
    );
    assert!(
        feasible * 10 >= results.len() && feasible < results.len(),
        "{feasible} feasible layouts show too little"
    );
}

#[test]
fn every_layout_of_the_paper_is_feasible() {
    for layout in LAYOUTS {
        assert!(verdict(&ariac(layout).compile()).feasible, "{layout}");
    }
}

#[test]
fn what_stands_in_something_else_is_named() {
    // Two stations at one place, a box about a station, two vehicles with one start.
    for (from, to, pair) in [
        ("\"pose\": [-12.3, 3, 0]", "\"pose\": [-7.3, 3, 0]", "as1 and as2"),
        ("\"pose\": [-1.899, 3.38, 0]", "\"pose\": [-7.3, 3.1, 0]", "as1 and bin1"),
        ("[-2.265685, -1.333917, 0]", "[-2.265685, 1.367643, 0]", "agv2 and agv3"),
    ] {
        let outcome = changed(from, to);
        assert_eq!(codes(&outcome), ["E0409"], "{pair}");
        let mut names: Vec<&str> = outcome.diagnostics[0].message.split(' ').collect();
        names.truncate(3);
        names.sort_unstable();
        let mut expected: Vec<&str> = pair.split(' ').collect();
        expected.sort_unstable();
        assert_eq!(names, expected);
        assert!(outcome.project.is_none());
    }
    let stacked = text("examples/ariac2021/default.json")
        .replacen("\"pose\": [-1.899, 3.38, 0]", "\"pose\": [-7.3, 3.1, 0]", 1)
        .replacen(
            "\"stationary\": [",
            "\"may_touch\": [{\"pair\": [\"as1\", \"bin1\"], \"reason\": \"stacked\"}], \"stationary\": [",
            1,
        );
    assert_eq!(codes(&Texts::of_layout(stacked).compile()), Vec::<&str>::new());
}
