//! `commission --trajectories`: paths of items as a table, as segments and as drawings.

use super::*;
use runtime_sim::kinematics::arm::Joints;
use runtime_sim::point::{Axis, Point};

/// `docs/NAME` is what `commission` draws of the default line with these options.
fn is_drawn_by(name: &str, layout: &str, options: &[&str]) {
    let folder = folder(name);
    let layout = example(layout);
    let output =
        autogen(&folder, &[&["commission", layout.as_str(), "--trajectories", name][..], options].concat());
    assert_eq!(status(&output), 0, "{}", errors(&output));
    let picture = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs").join(name));
    assert!(
        fs::read_to_string(folder.join(name)).expect("a drawing") == picture.expect("the picture"),
        "draw it anew: autogen commission {layout} --trajectories docs/{name} {}",
        options.join(" ")
    );
}

#[test]
fn two_batteries_are_drawn_from_the_run_of_the_default_layout() {
    is_drawn_by("paths.svg", "ariac2021/default.json", &["--items", "battery_3,battery_4"]);
}

#[test]
fn two_batteries_of_the_prototype_are_drawn_as_in_the_paper() {
    let (specs, scenario) = (example("ariac2021/prototype"), example("ariac2021/table1_v0.scenario.json"));
    let prototype = ["--specs", &specs, "--scenario", &scenario];
    let values = ["--set", "agv.capacity=4", "--set", "gantry.version=V0"];
    let items = ["--items", "battery_green_3,battery_blue_3"];
    is_drawn_by("fig6.svg", "ariac2021/prototype/default.json", &[&prototype[..], &values, &items].concat());
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(|n| n.as_f64().expect("a number")).collect()
}

/// Both ends of a segment of the default line follow from its law.
fn obeys_its_law(segment: &Value) {
    let second = |value: &Value| value.as_f64().expect("seconds");
    let [begin, end] = ["begin_s", "end_s"].map(|key| second(&segment[key]));
    let near = |place: &[f64], key: &str| {
        let known = numbers(&segment[key]);
        let off = place.iter().zip(&known).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(place.len() == 3 && known.len() == 3 && off < 1e-9, "{place:?} is not {key} in {segment}");
    };
    let from = numbers(&segment["from"]);
    match segment["law"].as_str() {
        Some("rests") => near(&from, "to"),
        Some("slides") => {
            let velocity = numbers(&segment["velocity"]);
            near(&[0, 1, 2].map(|i| from[i] + velocity[i] * (end - begin)), "to");
        }
        Some("hangs") => {
            let arm = machines::arm(&match segment["carrier"].as_str() {
                Some("gripper of kitting") => {
                    machines::rail_arm(Point::new(-1.3, 0.0, 1.127), Axis::Y, [-4.8, 4.8])
                }
                _ => machines::gantry(Point::new(-4.0, 0.0, 2.0), [-14.4, 0.4], [-4.5, 4.5]),
            });
            let hang = numbers(&segment["hang"]);
            let pieces = segment["pieces"].as_array().expect("pieces");
            for (piece, at, key) in [(pieces.first(), begin, "from"), (pieces.last(), end, "to")] {
                let piece = piece.expect("a piece");
                let t = at - second(&piece["begin_s"]);
                assert!(t >= -1e-9 && at <= second(&piece["end_s"]) + 1e-9, "{segment}");
                let joints = piece["joints"].as_array().expect("joints").iter();
                let joints =
                    joints.map(|powers| numbers(powers).iter().rev().fold(0.0, |sum, c| sum * t + c));
                let tool = arm.tool_pose(&Joints::new(&joints.collect::<Vec<f64>>()));
                let place = tool.point(Point::new(hang[0], hang[1], hang[2]));
                near(&[place.x, place.y, place.z], key);
            }
        }
        _ => panic!("no law: {segment}"),
    }
}

#[test]
fn trajectories_are_sampled_exact_or_drawn_and_change_nothing() {
    let folder = folder("trajectories");
    let layout = example("ariac2021/default.json");
    let run = |more: &[&str]| {
        autogen(&folder, &[&["commission", &layout, "--format", "json", "-o", "made"][..], more].concat())
    };
    let alone = json(&run(&[]));
    let asked = ["--trajectories", "a.csv", "--trajectories", "a.json", "--trajectories", "a.svg"];
    let output = run(&[&asked[..], &["--items", "battery_4,sensor_1", "--every", "0.25"]].concat());
    assert_eq!(status(&output), 0, "{}", errors(&output));
    assert_eq!(json(&output)["trace_hash"], alone["trace_hash"]);
    assert_eq!(alone["items"][0]["name"], "battery_1");

    let text = |name: &str| fs::read_to_string(folder.join(name)).expect("a file that was asked for");
    let segments: Value = serde_json::from_str(&text("a.json")).expect("JSON");
    let items = segments["items"].as_array().expect("items");
    let names: Vec<&str> = items.iter().filter_map(|item| item["item"].as_str()).collect();
    assert_eq!(names, ["battery_4", "sensor_1"]);
    let table = text("a.csv");
    for item in items {
        let rows: Vec<Vec<&str>> = (table.lines().map(|row| row.split(',').collect::<Vec<_>>()))
            .filter(|row| row[0] == item["item"])
            .collect();
        assert!(
            rows.iter().any(|row| row[2] == "100.250000") && rows.iter().all(|row| row[2] != "100.200000")
        );
        // Each segment begins with a row of the table.
        for segment in item["segments"].as_array().expect("segments") {
            let millionths = |value: &Value| format!("{:.6}", value.as_f64().expect("a number"));
            let from: Vec<String> = (0..3).map(|i| millionths(&segment["from"][i])).collect();
            let is_here = |row: &Vec<&str>| {
                row[2] == millionths(&segment["begin_s"]) && row[3..6] == from && row[6] == segment["carrier"]
            };
            assert!(rows.iter().any(is_here), "{segment}");
            obeys_its_law(segment);
        }
    }
    assert!(text("a.svg").contains("battery_4: conveyor_belt"));

    // Its own files are written anew, others are not.
    assert_eq!(status(&run(&asked)), 0);
    for name in ["b.csv", "b.json", "b.svg"] {
        fs::write(folder.join(name), "{ \"somebody\": \"else\" }").expect("a file");
        let output = run(&["--trajectories", name]);
        assert_eq!(status(&output), 2);
        assert!(json(&output)["reason"].as_str().is_some_and(|reason| reason.contains(name)));
        assert_eq!(text(name), "{ \"somebody\": \"else\" }");
        assert_eq!(status(&run(&["--trajectories", name, "--force"])), 0);
        assert_ne!(text(name), "{ \"somebody\": \"else\" }");
    }

    let wrong = [
        (["--trajectories", "a.txt", "--items", "battery_1"], "a.txt: the name has to end in .csv"),
        (
            ["--trajectories", "a.csv", "--items", "battery"],
            "no item `battery`; there are battery_1 to battery_11",
        ),
        (["--trajectories", "a.csv", "--every", "0.0005"], "--every 0.0005"),
        (["--trajectories", "no/a.csv", "--items", "battery_1"], "no/a.csv"),
    ];
    for (options, text) in wrong {
        let output = run(&options);
        assert_eq!(status(&output), 2, "{options:?}");
        let reason = json(&output)["reason"].as_str().unwrap_or("").to_string();
        assert!(reason.contains(text), "{reason}");
    }
    assert_eq!(status(&autogen(&folder, &["commission", &layout, "--items", "battery_1"])), 2);
}

#[test]
fn items_that_never_came_onto_the_line_have_no_path() {
    let folder = folder("trajectories_of_few");
    let scenario = fs::read_to_string(example("scenes/from_a_to_b.scenario.json")).expect("the example");
    fs::write(folder.join("short.json"), scenario.replacen('{', "{\"time_limit_s\": 2,", 1)).expect("a file");
    let layout = example("scenes/from_a_to_b.json");
    let items = |more: &[&str]| {
        let run = ["commission", &layout, "--scenario", "short.json", "--no-report", "-q", "-o", "made"];
        let output = autogen(&folder, &[&run[..], &["--trajectories", "a.json"], more].concat());
        assert_eq!(status(&output), 3, "{}", errors(&output));
        let text = fs::read_to_string(folder.join("a.json")).expect("a file that was asked for");
        let paths: Value = serde_json::from_str(&text).expect("JSON");
        let items = paths["items"].as_array().expect("items").iter();
        items
            .map(|item| (item["item"].to_string(), item["segments"].as_array().map_or(0, Vec::len)))
            .collect::<Vec<_>>()
    };
    let came = items(&[]);
    assert!((1..3).contains(&came.len()) && came.iter().all(|(_, segments)| *segments > 0), "{came:?}");
    assert_eq!(items(&["--items", "box_3"]), [("\"box_3\"".to_string(), 0)], "it is asked for");
}
