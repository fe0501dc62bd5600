//! Lines in which something meets something else, and lines in which it passes by less than 20 mm.

use autogen::executor::Executor;
use autogen::lower::Project;
use autogen_tests::{Texts, root, text};
use runtime_sim::memory::Memory;
use runtime_sim::plant::Plant;
use runtime_sim::report::Report;
use runtime_sim::run::{Stepping, run, run_again};
use serde_json::{Value, json};

const FOLDER: &str = "tests/fixtures/collision";

fn parsed(name: &str) -> Value {
    serde_json::from_str(&text(&format!("{FOLDER}/{name}"))).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// The fixtures that say what they expect by this key, with their names.
fn fixtures(key: &str) -> Vec<(String, Value)> {
    let mut names: Vec<String> = std::fs::read_dir(root().join(FOLDER))
        .expect("the folder of the fixtures")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .filter(|name| name.ends_with(".json"))
        .collect();
    names.sort();
    let all = names.into_iter().map(|name| (name.clone(), parsed(&name)));
    let fixtures: Vec<_> = all.filter(|(_, fixture)| !fixture[key].is_null()).collect();
    assert!(fixtures.len() >= 3, "{} fixtures say `{key}`", fixtures.len());
    fixtures
}

/// The small line with what a fixture adds.
fn project(fixture: &Value) -> Project {
    let mut layout = parsed("line.json");
    for key in ["robots", "stationary", "may_touch"] {
        let more = fixture[key].as_array().cloned().unwrap_or_default();
        layout[key].as_array_mut().expect("a list").extend(more);
    }
    if !fixture["scan_ms"].is_null() {
        layout["scan_ms"] = fixture["scan_ms"].clone();
    }
    let texts = Texts {
        layout: layout.to_string(),
        specs: vec![text(&format!("{FOLDER}/movers.aut"))],
        scenario: Some(text(&format!("{FOLDER}/scenario.json"))),
        ..Texts::default()
    };
    texts.project()
}

fn observed(project: &Project, mut observer: impl FnMut(&Plant)) -> Report {
    let mut executor = Executor::new(&project.system);
    run(&project.plant, &mut executor, Stepping::EveryScan, &mut |seen| observer(seen.plant))
        .expect("a line that can be run")
}

fn executed(fixture: &Value) -> Report {
    observed(&project(fixture), |_| {})
}

/// The fixture with one stationary thing moved.
fn moved(fixture: &Value, name: &Value, by: &Value) -> Value {
    let mut fixture = fixture.clone();
    let things = fixture["stationary"].as_array_mut().expect("a list");
    let thing = things.iter_mut().find(|thing| thing["name"] == *name).expect("a thing of this name");
    for i in 0..3 {
        let number = |value: &Value| value[i].as_f64().expect("a number");
        thing["pose"][i] = json!(number(&thing["pose"]) + number(by));
    }
    fixture
}

#[test]
fn what_collides_ends_the_run() {
    for (name, fixture) in fixtures("collides") {
        let report = executed(&fixture);
        let expected = &fixture["collides"];
        let [contact] = report.collisions.as_slice() else {
            panic!("{name}: {}, {:?}", report.reason, report.collisions)
        };
        println!("{name}: {}", report.reason);
        assert_eq!(json!(contact.pair), expected["pair"], "{name}");
        assert_eq!(json!(contact.parts), expected["parts"], "{name}");
        let within = |i: usize| expected["within_s"][i].as_f64().expect("a number");
        assert!((within(0)..within(1)).contains(&contact.time_s), "{name}: {}", contact.time_s);
        assert!(!report.finished && report.reason.starts_with("collision of "), "{name}: {}", report.reason);
        assert!(contact.time_s <= report.simulated_s, "{name}");
        let last_scan_s = report.simulated_s - f64::from(report.scan_ms) / 1000.0;
        assert!(contact.time_s > last_scan_s - 1e-9, "{name}");
    }
}

#[test]
fn what_passes_by_less_than_20_mm_does_not() {
    for (name, fixture) in fixtures("passes") {
        let report = executed(&fixture);
        assert!(report.collisions.is_empty(), "{name}: {}", report.reason);
        assert!(report.reason.starts_with("time limit"), "{name}: {}", report.reason);
        // A little nearer it is a collision.
        let nearer = &fixture["passes"]["nearer"];
        let by = (0..3).map(|i| nearer["by"][i].as_f64().expect("a number").abs()).fold(0.0, f64::max);
        assert!(by < 0.02, "{name}");
        let report = executed(&moved(&fixture, &nearer["name"], &nearer["by"]));
        println!("{name}: {by} m nearer it is a {}", report.reason);
        assert_eq!(json!(report.collisions[0].parts), fixture["passes"]["parts"], "{name}");
    }
}

#[test]
fn an_allowed_pair_is_reported_and_ends_nothing() {
    for (name, mut fixture) in fixtures("collides") {
        let pair = fixture["collides"]["pair"].clone();
        let reversed = json!([pair[1], pair[0]]);
        fixture["may_touch"] = json!([{"pair": reversed, "reason": "this is the test"}]);
        let report = executed(&fixture);
        assert!(report.reason.starts_with("time limit"), "{name}: {}", report.reason);
        let [contact] = report.collisions.as_slice() else { panic!("{name}: {:?}", report.collisions) };
        assert!(contact.allowed && contact.count >= 1 && json!(contact.pair) == pair, "{name}: {contact:?}");
    }
}

/// Looked at between scans only, the mast is before the wall once and behind it the next time.
#[test]
fn samples_would_step_over_the_thin_wall() {
    let mut fixture = parsed("thin_wall.json");
    fixture["may_touch"] = json!([{"pair": ["driver", "wall"], "reason": "this is the test"}]);
    let project = project(&fixture);
    let index = |name: &str| project.plant.machines.iter().position(|m| m.name == name);
    let driver = index("driver").expect("the vehicle");
    let wall = fixture["stationary"][0]["pose"][0].as_f64().expect("a number");
    let (mut before, mut behind) = (0, 0);
    let report = observed(&project, |plant| {
        // The mast stands 0.275 m behind the vehicle's middle and is 0.085 m thick.
        let mast = plant.position(driver).expect("it is somewhere").x - 0.27539;
        assert!((mast - wall).abs() > 0.043 + 0.001, "a sample at {mast} meets the wall");
        if mast > wall { before += 1 } else { behind += 1 }
    });
    assert!(before > 0 && behind > 0);
    assert_eq!(report.collisions.len(), 1);
}

/// Whether an arm and a vehicle meet depends on the time between their motions, which are the same in all runs.
#[test]
fn two_motions_are_remembered_with_the_time_between_them() {
    let mut fixture = parsed("arm_in_the_vehicles_way.json");
    let mut memory = Memory::default();
    let (mut meet, mut pass) = (0, 0);
    for pause in (0..=9000).step_by(300) {
        fixture["robots"][0]["parameters"]["pause"] = json!(f64::from(pause) / 1000.0);
        let project = project(&fixture);
        let run_with = |memory: &mut Memory| {
            let mut executor = Executor::new(&project.system);
            run_again(&project.plant, &mut executor, Stepping::Events, memory, &mut |_| {})
                .expect("a line that can be run")
        };
        let anew = run_with(&mut Memory::default());
        println!("{pause} ms: {}", anew.reason);
        assert_eq!(run_with(&mut memory), anew, "{pause} ms");
        if anew.collisions.is_empty() { pass += 1 } else { meet += 1 }
    }
    assert!(meet >= 3 && pass >= 3, "{meet} meet, {pass} pass by");
}
