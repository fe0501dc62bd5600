//! Keys of devices that `--set` gives: as if the layout had them.

use super::*;

/// The machining cell with another text of its mill, in a folder of its own.
fn cell(folder: &Path, mill: &str) {
    for name in ["tending.json", "tending.aut", "tending.scenario.json"] {
        let text = fs::read_to_string(example(&format!("tending/{name}"))).expect("the example");
        let of_mill = r#""type": "mill", "pose": [1.50, 0, 0, 90], "cut": 90"#;
        assert!(name != "tending.json" || text.contains(of_mill));
        fs::write(folder.join(name), text.replace(of_mill, mill)).expect("a file");
    }
}

fn rows(output: &Output) -> Vec<Value> {
    json(output)["rows"].as_array().expect("rows").clone()
}

#[test]
fn a_run_is_that_of_a_layout_with_this_key() {
    let written = folder("device_key_written");
    cell(&written, r#""type": "mill", "pose": [1.50, 0, 0, 90], "cut": 60, "door_time": 2"#);
    let of_layout = autogen(&written, &["commission", "tending.json", "--format", "json", "--no-report"]);
    assert_eq!(status(&of_layout), 0, "{}", errors(&of_layout));
    let given = folder("device_key_given");
    // A key that is required and stands nowhere else.
    cell(&given, r#""type": "mill", "pose": [1.50, 0, 0, 90]"#);
    let set = ["--set", "mill.cut=80", "--set", "mill.cut=60", "--set", "mill.door_time=2"];
    let of_command = ["commission", "tending.json", "--format", "json", "--no-report"];
    let of_command = autogen(&given, &[&of_command[..], &set].concat());
    assert_eq!(status(&of_command), 0, "{}", errors(&of_command));
    let [of_layout, of_command] = [of_layout, of_command].map(|output| json(&output));
    assert_eq!(of_command["trace_hash"], of_layout["trace_hash"]);
    assert_eq!(of_command["simulated_s"], of_layout["simulated_s"]);
}

#[test]
fn a_sweep_varies_keys_and_says_of_which_values_they_are_wrong() {
    let folder = folder("device_key_sweep");
    // Whatever the first value is: other ones may be right.
    cell(&folder, r#""type": "mill", "pose": [1.50, 0, 0, 90]"#);
    let sweep = ["sweep", "tending.json", "--set", "mill.cut=-1,30,90", "--format", "json"];
    let output = autogen(&folder, &sweep);
    assert_eq!(status(&output), 3, "{}", errors(&output));
    let rows = rows(&output);
    assert_eq!(rows[0]["diagnostics"][0]["code"], "E0114");
    assert_eq!(rows[0]["diagnostics"][0]["file"], "--set");
    // Each of the 41 brackets takes the mill a minute less, and everything waits for the mill.
    let goal = |row: &Value| row["goal_s"].as_f64().expect("a time");
    let less = goal(&rows[2]) - goal(&rows[1]);
    assert!((less - 41.0 * 60.0).abs() < 0.1, "{less}");
    // What no value of this axis removes is said once.
    let other = "\"name\": \"arm\", \"colour\": 1, ";
    let text = fs::read_to_string(folder.join("tending.json")).expect("the layout");
    fs::write(folder.join("tending.json"), text.replace("\"name\": \"arm\", ", other)).expect("a file");
    let output = autogen(&folder, &sweep);
    assert_eq!(status(&output), 1, "{}", errors(&output));
    assert_eq!(json(&output)["rows"], serde_json::json!([]));
}

#[test]
fn all_machines_of_a_type_have_its_key() {
    let folder = folder("device_key_type");
    let check = |set: &str| {
        let layout = example("crossing/crossing.json");
        json(&autogen(&folder, &["check", &layout, "--set", set, "--format", "json"]))
    };
    let errors = |answer: &Value| {
        let all = answer["diagnostics"].as_array().expect("diagnostics").iter();
        all.filter(|told| told["severity"] == "error").map(ToString::to_string).collect::<Vec<_>>()
    };
    assert_eq!(errors(&check("carrier.speed=1.2")), [""; 0]);
    let told = errors(&check("carrier.speed=1e9"));
    assert!(told.len() == 1 && told[0].contains("E0125"), "{told:#?}");
}
