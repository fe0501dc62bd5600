//! `compare` of results that runs have written.

use super::*;

const HASH: &str = "2f8fd7a7596e1fa2";
const OTHER_HASH: &str = "2f8fd7a7596e1fa3";

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn results_are_compared_row_by_row() {
    let folder = folder("compare_results");
    let results = |name: &str, per_order: f64, hash: &str| {
        fs::create_dir_all(folder.join(name)).expect("a folder");
        let text = format!(
            r#"{{"finished": true, "reason": "all orders made", "orders": 1, "orders_done": 1, "simulated_s": 83.0,
            "seconds_per_order": {per_order}, "trace_hash": "{hash}", "robots": {{"agv1": {{"moving_s": 2.0}}}},
            "order_times": [{{"order": 1, "made_s": {per_order}}}], "wall_s": {per_order}}}"#
        );
        fs::write(folder.join(name).join("results.json"), text).expect("a file");
    };
    results("a", 83.0, HASH);
    results("b", 84.5, OTHER_HASH);
    results("c", 83.0, OTHER_HASH);
    assert_eq!(status(&autogen(&folder, &["compare", "a", "a/results.json"])), 0);
    let output = autogen(&folder, &["compare", "a", "b"]);
    assert_eq!(status(&output), 3);
    let text = said(&output);
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split_whitespace().collect()).collect();
    assert!(rows.contains(&vec!["seconds_per_order", "83", "84.5", "+1.50"]), "{text}");
    assert!(rows.contains(&vec!["order", "1", "made_s", "83", "84.5", "+1.50"]), "{text}");
    assert!(!text.contains("agv1"), "{text}");
    let output = autogen(&folder, &["compare", "a", "c"]);
    assert_eq!(status(&output), 3, "another trace with the same figures");
    assert!(said(&output).contains("the hashes of the traces differ"), "{}", said(&output));

    let layout = example("scenes/lifting_table.json");
    for (a, b, why) in [
        ("a", layout.as_str(), "name two layouts or two results"),
        ("nothing", "a", "nothing: "),
        (".", "a", "`commission` writes the results"),
    ] {
        let output = autogen(&folder, &["compare", a, b]);
        assert_eq!(status(&output), 2, "{a} {b}");
        assert!(errors(&output).contains(why), "{}", errors(&output));
    }
}

/// Results with one key replaced, each time another one.
#[test]
fn every_key_of_results_is_compared() {
    let folder = folder("compare_keys");
    let write = |name: &str, keys: &[(&str, &str)]| {
        let mut results = serde_json::json!({
            "finished": true, "reason": "goal", "simulated_s": 15.82, "scans": 1582, "trace_hash": HASH,
            "order_times": [{ "order": 1, "station": "s", "opened_s": 0.0, "made_s": 1.0 }],
            "items": [{ "id": 1, "name": "box 1", "kind": "box", "place": "(0, 0, 0)", "carrier": "belt" }],
            "sinks": { "m1.store": { "red": 1 } }, "items_collected": 1, "items_asked": 2,
            "alarms": [{ "code": 3, "robot": "m1", "text": "slow", "count": 1, "first_s": 2.0, "place": "a:1" }],
            "faults": [{ "code": 4, "robot": "m1", "text": "fell", "state": "Carrying", "at_s": 3.0 }],
            "robots": { "m1": { "state": "Idle", "waiting_for": { "m2": 1.0 } } },
            "collisions": [{ "time_s": 1.0, "pair": ["m1", "m2"], "count": 1 }],
            "waits": ["m1 waits"], "settings": [], "wall_s": 1.0,
        });
        for (key, value) in keys {
            results[key] = serde_json::from_str(value).expect("a value");
        }
        fs::write(folder.join(name), results.to_string()).expect("a file");
    };
    let compared = || {
        let output = autogen(&folder, &["compare", "a.json", "b.json"]);
        (status(&output), said(&output))
    };
    write("a.json", &[]);
    for (key, value, row) in [
        ("sinks", r#"{ "m1.store": { "blue": 1 } }"#, "m1.store red 1 -"),
        ("sinks", r#"{ "m1.store": { "blue": 1 } }"#, "m1.store blue - 1"),
        ("items_collected", "2", "items_collected 1 2 +1.00"),
        ("items_asked", "3", "items_asked 2 3 +1.00"),
        ("scans", "1583", "scans 1582 1583 +1.00"),
        ("alarms", "null", "m1 alarm count: slow 1 -"),
        (
            "alarms",
            r#"[{ "code": 5, "robot": "m1", "text": "slow", "count": 2, "first_s": 2.0, "place": "a:9" }]"#,
            "m1 alarm count: slow 1 2 +1.00",
        ),
        (
            "faults",
            r#"[{ "code": 4, "robot": "m1", "text": "fell", "state": "Carrying", "at_s": 3.0 },
                { "code": 4, "robot": "m1", "text": "fell", "state": "Idle", "at_s": 9.0 }]"#,
            "m1 fault 2 at_s: fell - 9.0",
        ),
        ("order_times", r#"[{ "order": 2, "station": "s" }]"#, "order 2 station - s"),
        (
            "items",
            r#"[{ "id": 1, "name": "box 1", "kind": "lid", "place": "(0, 0, 0)", "carrier": "belt" }]"#,
            "box 1 kind box lid",
        ),
        ("robots", r#"{ "m1": { "state": "Idle", "waiting_for": {} } }"#, "m1 waiting_for m2 1.0 -"),
        (
            "collisions",
            r#"[{ "time_s": 1.0, "pair": ["m1", "m2"], "count": 5 }]"#,
            "contact of m1 and m2 count 1 5 +4.00",
        ),
        ("of_tomorrow", r#"{ "energy": 5 }"#, "of_tomorrow energy - 5"),
    ] {
        write("b.json", &[(key, value)]);
        let (status, text) = compared();
        assert_eq!(status, 3, "{key}: {text}");
        let rows: Vec<String> =
            text.lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
        assert!(rows.contains(&row.to_string()), "{row}:\n{text}");
    }
    // Neither how it was run, nor codes and places of a text that has changed elsewhere.
    let alarm =
        r#"[{ "code": 9, "robot": "m1", "text": "slow", "count": 1, "first_s": 2.0, "place": "a:7" }]"#;
    write(
        "b.json",
        &[("settings", r#"["agv.capacity=4"]"#), ("waits", "[]"), ("wall_s", "7"), ("alarms", alarm)],
    );
    assert_eq!(compared().0, 0, "{}", compared().1);
}

#[test]
fn options_of_layouts_are_refused_for_results() {
    let folder = folder("compare_options");
    fs::write(folder.join("a.json"), format!(r#"{{"trace_hash": "{HASH}"}}"#)).expect("a file");
    for option in [["--set", "agv.capacity=4"], ["--specs", "."], ["--scenario", "a.json"]] {
        let output = autogen(&folder, &["compare", "a.json", "a.json", option[0], option[1]]);
        assert_eq!(status(&output), 2, "{option:?}");
        let said = errors(&output);
        assert!(said.contains(&format!("{} is for layouts", option[0])) && said.contains("a.json"), "{said}");
    }
}

#[test]
fn results_that_cannot_be_used_are_named() {
    let folder = folder("compare_unusable");
    fs::write(folder.join("right.json"), format!(r#"{{"trace_hash": "{HASH}"}}"#)).expect("a file");
    fs::create_dir(folder.join("out")).expect("a folder");
    for (text, why) in [
        ("{}", "`trace_hash`"),
        ("", "empty"),
        ("%PDF", "not JSON"),
        ("[1]", "`trace_hash`"),
        (r#"{"simulated_s": 1.0, "robots": {}}"#, "have none"),
        (r#"{"trace_hash": ""}"#, "have something else"),
        (r#"{"trace_hash": 7}"#, "have something else"),
    ] {
        fs::write(folder.join("wrong.json"), text).expect("a file");
        fs::write(folder.join("out/results.json"), text).expect("a file");
        for [a, b] in [["right.json", "wrong.json"], ["wrong.json", "right.json"], ["out", "right.json"]] {
            let output = autogen(&folder, &["compare", a, b]);
            assert_eq!(status(&output), 2, "{text}: {}", errors(&output));
            let said = errors(&output);
            let name = if a == "out" { "results.json: " } else { "wrong.json: " };
            assert!(said.contains(name) && said.contains(why), "{text}: {said}");
        }
    }
}
