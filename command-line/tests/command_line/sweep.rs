//! `autogen sweep`.

use super::{autogen, contents, errors, example, folder, json, status};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Output;

/// One battery for one station: made within a minute of simulated time.
pub const ONE_PART: &str = r#"{
    "kinds": [{"name": "battery", "height": 0.053}],
    "orders": [{"station": "as1", "parts": {"battery": 1}}],
    "supply": {"items": ["battery"]}
}"#;

pub fn put(folder: &Path, name: &str, text: &str) {
    fs::write(folder.join(name), text).expect("a file that can be written");
}

/// The default layout with a vehicle half a metre out of reach.
fn put_infeasible(folder: &Path) {
    let layout = fs::read_to_string(example("ariac2021/default.json")).expect("the example");
    put(folder, "moved.json", &layout.replace("[-2.265685, -1.333917, 0]", "[-2.765685, -1.333917, 0]"));
}

pub fn printed(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

pub fn rows(output: &Output) -> Vec<Value> {
    json(output)["rows"].as_array().cloned().unwrap_or_else(|| panic!("no rows: {}", errors(output)))
}

#[test]
fn each_row_is_what_commission_says_of_the_point() {
    let folder = folder("sweep_rows");
    let layouts = [example("ariac2021/default.json"), example("ariac2021/less_agv.json")];
    let sweep = [
        "sweep",
        &layouts[0],
        &layouts[1],
        "--set",
        "agv.capacity=2,5",
        "--set",
        "agv1.capacity=1",
        "--order",
        "3,11",
        "--io-delay",
        "0,random:4",
        "--format",
        "json",
    ];
    let output = autogen(&folder, &sweep);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    assert_eq!(contents(&folder).len(), 0, "no folder is written for a point");
    let rows = rows(&output);
    assert_eq!(rows.len(), 16);

    // Layout, capacity, order and delay of some points; the last of them varies fastest.
    let points = [(0, 2, 3, "0"), (0, 5, 11, "random:4"), (1, 2, 11, "0"), (1, 5, 3, "random:4")];
    let mut hashes = Vec::new();
    for (layout, capacity, order, delay) in points {
        let index = layout * 8
            + usize::from(capacity == 5) * 4
            + usize::from(order == 11) * 2
            + usize::from(delay != "0");
        let (capacity, order) = (format!("agv.capacity={capacity}"), order.to_string());
        let commission = [
            "commission",
            &layouts[layout],
            "--set",
            &capacity,
            "--set",
            "agv1.capacity=1",
            "--order",
            &order,
            "--io-delay",
            delay,
            "--format",
            "json",
            "-o",
            "made",
        ];
        let alone = json(&autogen(&folder, &commission));
        for key in [
            "layout",
            "order_seed",
            "io_delay",
            "finished",
            "reason",
            "orders_done",
            "orders",
            "seconds_per_order",
            "simulated_s",
            "trace_hash",
        ] {
            assert!(!alone[key].is_null(), "{key}");
            assert_eq!(rows[index][key], alone[key], "{key} of row {index}");
        }
        assert_eq!(rows[index]["set"]["agv1.capacity"], 1);
        hashes.push(alone["trace_hash"].to_string());
    }
    hashes.sort();
    hashes.dedup();
    assert_eq!(hashes.len(), points.len(), "the points differ");
}

#[test]
fn a_point_that_faults_is_named_as_by_commission() {
    let folder = folder("sweep_fault");
    put(&folder, "short.json", ONE_PART);
    fs::create_dir_all(folder.join("types")).expect("a folder");
    let vehicle = fs::read_to_string(example("../compiler/library/agv.aut")).expect("the library");
    let hasty = vehicle.replace("state Loading {", "state Loading within 5 s {");
    assert!(hasty != vehicle);
    put(&folder.join("types"), "agv.aut", &hasty);
    let layout = example("ariac2021/default.json");
    let point =
        ["--specs", "types", "--scenario", "short.json", "--set", "agv.capacity=3", "--format", "json"];
    let output = autogen(&folder, &[&["sweep", layout.as_str()], &point[..]].concat());
    assert_eq!(status(&output), 3, "{}", errors(&output));
    let alone = autogen(&folder, &[&["commission", layout.as_str(), "-o", "made"], &point[..]].concat());
    let reason = json(&alone)["reason"].clone();
    assert!(
        reason.as_str().is_some_and(|r| r.contains("in state Loading") && r.contains("agv.aut:")),
        "{reason}"
    );
    assert_eq!(rows(&output)[0]["reason"], reason);
}

#[test]
fn the_bytes_do_not_depend_on_the_number_of_jobs() {
    let folder = folder("sweep_jobs");
    put(&folder, "short.json", ONE_PART);
    put_infeasible(&folder);
    let layout = example("ariac2021/default.json");
    for format in ["json", "text"] {
        let run = |jobs: &str| {
            let arguments = [
                "sweep",
                &layout,
                "moved.json",
                "--scenario",
                "short.json",
                "--set",
                "agv.capacity=1,13,12",
                "--order",
                "1,2",
                "--format",
                format,
                "--jobs",
                jobs,
            ];
            let output = autogen(&folder, &arguments);
            assert_eq!(status(&output), 3, "{}", errors(&output));
            output.stdout
        };
        let alone = run("1");
        assert!(alone == run("5"), "{format}");
        let lines = String::from_utf8_lossy(&alone).lines().count();
        // A heading, or the brackets around the rows.
        assert_eq!(lines, 12 + if format == "json" { 2 } else { 1 });
    }
}

#[test]
fn a_point_that_fails_is_a_row_with_its_reason() {
    let folder = folder("sweep_reasons");
    put_infeasible(&folder);
    put(&folder, "late.json", &ONE_PART.replacen('{', "{ \"time_limit_s\": 20,", 1));
    put(&folder, "broken.json", "{");
    let layout = example("ariac2021/default.json");
    let output = autogen(
        &folder,
        &[
            "sweep",
            "moved.json",
            &layout,
            "broken.json",
            "--scenario",
            "late.json",
            "--set",
            "agv.capacity=4,13",
            "--format",
            "json",
        ],
    );
    assert_eq!(status(&output), 3, "{}", errors(&output));
    let rows = rows(&output);
    let reason = |row: usize| rows[row]["reason"].as_str().expect("a reason").to_string();
    assert!(reason(0).starts_with("E0401: kitting cannot hand over to agv3"), "{}", reason(0));
    assert!(reason(1).starts_with("E0"), "{}", reason(1));
    assert!(reason(2).starts_with("time limit: "), "{}", reason(2));
    assert_eq!(reason(3), "E0503: this is not a value for `capacity`");
    assert!(reason(4).starts_with("E0102: ") && reason(5) == reason(4), "{}", reason(4));
    for (row, is_refused) in rows.iter().zip([true, true, false, true, true, true]) {
        assert_eq!(row["finished"], false);
        assert_eq!(row["orders"], 1);
        assert_eq!(row["orders_done"], 0);
        assert_eq!(row["seconds_per_order"], Value::Null);
        assert_eq!(row["simulated_s"].is_null(), is_refused);
        assert_eq!(row["diagnostics"].as_array().is_some_and(|d| !d.is_empty()), is_refused);
    }
    assert_eq!(rows[3]["diagnostics"][0]["code"], "E0503");
    assert!(rows[3]["diagnostics"][0]["help"].as_str().is_some_and(|h| h.contains("from 1 to 12")));
}

#[test]
fn rows_are_aligned_and_lists_may_hold_commas() {
    let folder = folder("sweep_text");
    put(&folder, "short.json", ONE_PART);
    let (default, less) = (example("ariac2021/default.json"), example("ariac2021/less_agv.json"));
    let sweep = |format: &str, set: &str| {
        let arguments =
            ["sweep", &default, &less, "--scenario", "short.json", "--set", set, "--format", format];
        let output = autogen(&folder, &arguments);
        assert_eq!(status(&output), 3, "{}", errors(&output));
        printed(&output)
    };
    assert_eq!(
        sweep("text", "agv.capacity=13,100"),
        "\
layout    agv.capacity       orders    s/order     simulated  reason
default             13       0 of 1          -             -  E0503: this is not a value for `capacity`
default            100       0 of 1          -             -  E0503: this is not a value for `capacity`
less_agv            13       0 of 1          -             -  E0503: this is not a value for `capacity`
less_agv           100       0 of 1          -             -  E0503: this is not a value for `capacity`

s/order by agv.capacity        13       100
default                         -         -
less_agv                        -         -
"
    );
    assert_eq!(
        sweep("csv", "agv.capacity=[1,2],{\"a\":3}"),
        "\
layout,agv.capacity,finished,reason,orders_done,orders,seconds_per_order,simulated_s,trace_hash
default,\"[1,2]\",false,E0503: this is not a value for `capacity`,0,1,,,
default,\"{\"\"a\"\":3}\",false,E0503: this is not a value for `capacity`,0,1,,,
less_agv,\"[1,2]\",false,E0503: this is not a value for `capacity`,0,1,,,
less_agv,\"{\"\"a\"\":3}\",false,E0503: this is not a value for `capacity`,0,1,,,
"
    );
    let rows = sweep("jsonl", "agv.capacity=[1,2],many");
    let first: Value = serde_json::from_str(rows.lines().next().expect("a row")).expect("an object");
    assert_eq!(first["set"]["agv.capacity"], serde_json::json!([1, 2]));
    let second: Value = serde_json::from_str(rows.lines().nth(1).expect("a row")).expect("an object");
    assert_eq!(second["set"]["agv.capacity"], "many");
}

#[test]
fn measured_figures_stand_beside_their_rows() {
    let folder = folder("sweep_beside");
    put(&folder, "short.json", ONE_PART);
    let layout = example("ariac2021/default.json");
    // The point that is refused has a figure; one that runs has none, nor one that stands with an empty field.
    let figures = "agv.capacity,seconds_per_order,layout\n1,20,default\n13,50.5,default\n\n3,,default\n9,1,default\n2,40,\"default\"\n";
    put(&folder, "figures.csv", figures);
    let sweep = |format: &str| {
        let arguments = ["sweep", &layout, "--scenario", "short.json", "--set", "agv.capacity=1,13,2,3,4"];
        let more = ["--beside", "figures.csv", "--format", format];
        let output = autogen(&folder, &[&arguments[..], &more[..]].concat());
        assert_eq!(status(&output), 3, "{}", errors(&output));
        output
    };
    let output = sweep("json");
    let all = rows(&output);
    let measured: Vec<Option<f64>> = all.iter().map(|r| r["measured_seconds_per_order"].as_f64()).collect();
    assert_eq!(measured, [Some(20.0), Some(50.5), Some(40.0), None, None]);
    let here = all[0]["seconds_per_order"].as_f64().expect("an order was made");
    let ratios: Vec<Option<f64>> = all.iter().map(|r| r["ratio"].as_f64()).collect();
    assert_eq!(ratios, [Some(here / 20.0), None, Some(here / 40.0), None, None]);
    let square = |ratio: f64| (ratio - 1.0) * (ratio - 1.0);
    let rms = ((square(here / 20.0) + square(here / 40.0)) / 2.0).sqrt();
    assert!((json(&output)["rms"].as_f64().expect("a figure") - rms).abs() < 1e-12);

    let output = sweep("text");
    let unused = "figures.csv: line 6: the sweep has no point with agv.capacity 9, layout default";
    assert!(errors(&output).contains(unused), "{}", errors(&output));
    let text = printed(&output);
    assert!(text.lines().next().is_some_and(|l| l.contains("s/order   measured   ratio")), "{text}");
    let cells: Vec<&str> = text.lines().nth(1).expect("a row").split_whitespace().collect();
    let ratio = format!("{:.3}", here / 20.0);
    assert_eq!(cells[2..8], ["1", "of", "1", &format!("{here:.2}"), "20.00", &ratio]);
    let last = format!("RMS of the difference between the 2 ratios and 1: {:.1} %", rms * 100.0);
    assert_eq!(text.lines().last(), Some(last.as_str()));
    let csv = printed(&sweep("csv"));
    assert!(csv.lines().next().is_some_and(|l| l.ends_with(",trace_hash,measured_seconds_per_order,ratio")));
    assert!(csv.lines().nth(2).is_some_and(|l| l.ends_with(",50.5,")), "{csv}");
}

#[test]
fn wrong_measured_figures_are_refused_with_the_place() {
    let folder = folder("sweep_beside_wrong");
    let layout = example("ariac2021/default.json");
    let cases = [
        ("", "the first line has no column `seconds_per_order`"),
        ("layout,agv.capacity\n", "the first line has no column `seconds_per_order`"),
        (
            "layout,cap,seconds_per_order\n",
            "the sweep has no column `cap`; its points are named by layout, agv.capacity",
        ),
        ("layout,layout,seconds_per_order\n", "the column `layout` occurs twice"),
        ("layout,seconds_per_order\ndefault\n", "line 2: 1 fields, 2 columns"),
        ("layout,seconds_per_order\n\ndefault,long\n", "line 3: `long` is not a number of seconds above 0"),
        ("layout,seconds_per_order\ndefault,0\n", "line 2: `0` is not a number"),
        ("layout,seconds_per_order\ndefault,NaN\n", "line 2: `NaN` is not a number"),
        ("layout,seconds_per_order\ndefault,1\ndefault,2\n", "line 3: this point occurs twice"),
    ];
    for (figures, message) in cases {
        put(&folder, "figures.csv", figures);
        let arguments = ["sweep", &layout, "--set", "agv.capacity=1,2", "--beside", "figures.csv"];
        let output = autogen(&folder, &arguments);
        assert_eq!(status(&output), 2, "{figures}: {}", errors(&output));
        assert!(errors(&output).contains(&format!("figures.csv: {message}")), "{}", errors(&output));
    }
}

#[test]
fn what_is_wrong_with_all_points_is_said_once() {
    let folder = folder("sweep_wrong_input");
    fs::create_dir_all(folder.join("types")).expect("a folder");
    put(&folder.join("types"), "agv.aut", "automaton Agv on vehicle {");
    let layouts = [example("ariac2021/default.json"), example("ariac2021/less_agv.json")];
    let sweep = |more: &[&str]| {
        let mut arguments = vec!["sweep", &layouts[0], &layouts[1], "--set", "agv.capacity=2,4"];
        arguments.extend(more);
        autogen(&folder, &arguments)
    };
    let output = sweep(&["--specs", "types"]);
    assert_eq!(status(&output), 1);
    assert!(output.stdout.is_empty());
    assert_eq!(errors(&output).matches("error[E0").count(), 1, "{}", errors(&output));
    let output = sweep(&["--specs", "types", "--format", "json"]);
    assert_eq!(status(&output), 1);
    let answer = json(&output);
    assert_eq!(answer["rows"], serde_json::json!([]));
    assert_eq!(answer["diagnostics"].as_array().map(Vec::len), Some(1), "{answer}");

    // A parameter that no layout has; then one that only one of them lacks.
    let output = sweep(&["--set", "agv.capacitee=1,2"]);
    assert_eq!(status(&output), 1);
    assert_eq!(errors(&output).matches("error[E0511]").count(), 1, "{}", errors(&output));
    let output = sweep(&["--set", "agv2.capacity=13", "--format", "json"]);
    assert_eq!(status(&output), 3);
    let codes: Vec<Value> = rows(&output).iter().map(|row| row["diagnostics"][0]["code"].clone()).collect();
    assert_eq!(codes, ["E0503", "E0503", "E0511", "E0511"]);
}

#[test]
fn wrong_command_lines_are_status_2() {
    let folder = folder("sweep_wrong_command");
    let layout = example("ariac2021/default.json");
    let cases: &[&[&str]] = &[
        &["sweep"],
        &["sweep", "no_such_file.json"],
        &["sweep", &layout, "--set", "agv.capacity"],
        &["sweep", &layout, "--set", "agv.capacity=2,,4"],
        &["sweep", &layout, "--set", "agv.capacity=[2,4"],
        &["sweep", &layout, "--set", "agv.capacity=2", "--set", "agv.capacity=4"],
        &["sweep", &layout, "--specs", "no_such_folder"],
        &["sweep", &layout, "--scenario", "no_such_file.json"],
        &["sweep", &layout, "--io-delay", "0,often"],
        &["sweep", &layout, "--order", "1,second"],
        &["sweep", &layout, "--jobs", "0"],
        &["sweep", &layout, "--format", "table"],
        &["sweep", &layout, "--beside", "no_such_file.csv"],
    ];
    for case in cases {
        let output = autogen(&folder, case);
        assert_eq!(status(&output), 2, "{case:?}: {}", errors(&output));
        assert!(!output.stderr.is_empty() && output.stdout.is_empty(), "{case:?}");
    }
}

/// The line of a goal of items, and a scenario of it that ends sooner.
fn a_to_b(folder: &Path) -> String {
    let scenario = fs::read_to_string(example("scenes/from_a_to_b.scenario.json")).expect("the example");
    put(folder, "short.json", &scenario.replacen('{', "{\"time_limit_s\": 20,", 1));
    example("scenes/from_a_to_b.json")
}

#[test]
fn of_a_goal_of_items_rows_have_the_time_until_it_and_the_items() {
    let folder = folder("sweep_goal");
    let layout = a_to_b(&folder);
    let set = ["--set", "from_a_to_b.work=1,4"];
    let sweep = |more: &[&str]| autogen(&folder, &[&["sweep", &layout][..], &set, more].concat());
    let output = sweep(&["--format", "json", "--report", "page.html"]);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    let commission = ["commission", &layout, "--set", "from_a_to_b.work=4", "--format", "json"];
    let slow = json(&autogen(&folder, &commission));
    let found = rows(&output);
    assert_eq!(found[1]["goal_s"], slow["simulated_s"]);
    assert!(found[0]["goal_s"].as_f64() < found[1]["goal_s"].as_f64(), "{found:?}");
    let asked = slow["items_asked"].as_u64().expect("a number");
    assert!(asked > 0);
    for row in &found {
        assert_eq!((&row["items"], &row["items_asked"]), (&asked.into(), &asked.into()));
        let per_hour = asked as f64 * 3600.0 / row["goal_s"].as_f64().expect("a time");
        assert!((row["items_per_hour"].as_f64().expect("a number") - per_hour).abs() < 1e-9);
    }
    let page = fs::read_to_string(folder.join("page.html")).expect("a page");
    assert!(page.contains("\"Seconds until the goal\"") && page.contains("\"goal at s\""));

    let text = printed(&sweep(&[]));
    let head = text.lines().next().expect("a line");
    assert!(head.contains("      items   items/h  goal at s     simulated  reason"), "{text}");
    assert!(text.contains("goal at, s, by from_a_to_b.work"), "{text}");
    // A run that ends before the goal has its items, and no time.
    let output = sweep(&["--format", "json", "--scenario", "short.json"]);
    assert_eq!(status(&output), 3);
    let row = rows(&output)[1].clone();
    assert!(row["items"].as_u64() < Some(asked) && row["goal_s"] == Value::Null, "{row}");
}

#[test]
fn means_differences_and_parts_of_a_goal_are_those_of_its_time() {
    let folder = folder("sweep_goal_means");
    let layout = a_to_b(&folder);
    let sweep = |more: &[&str]| {
        let fixed = ["sweep", &layout, "--set", "from_a_to_b.work=1,4", "--replications", "3"];
        autogen(&folder, &[&fixed[..], more].concat())
    };
    let output = sweep(&["--format", "json", "--compare"]);
    let found = rows(&output);
    let goal = |row: usize| found[row]["goal_s"].as_f64().expect("a time");
    // Nothing is drawn in this line: all replications are one run.
    assert_eq!(found[1]["half_width"], 0.0);
    let difference = found[1]["difference"].as_f64().expect("a difference");
    assert!((difference - (goal(1) - goal(0))).abs() < 1e-9, "{found:?}");
    let files: Vec<String> = (1..=2)
        .map(|number| {
            let name = format!("part{number}.jsonl");
            put(&folder, &name, &printed(&sweep(&["--part", &format!("{number}/2")])));
            name
        })
        .collect();
    for format in ["json", "csv", "text"] {
        let merged = autogen(&folder, &["merge", &files[0], &files[1], "--format", format]);
        let whole = sweep(&["--format", format]);
        assert_eq!(printed(&merged), printed(&whole), "{}", errors(&merged));
    }
    let output = sweep(&["--warm-up", "auto"]);
    assert_eq!(status(&output), 2);
    assert!(errors(&output).contains("--warm-up cuts orders, and these scenarios have none"));
}

#[test]
fn without_orders_and_a_goal_rows_have_the_items_of_an_hour() {
    let folder = folder("sweep_throughput");
    let text = fs::read_to_string(example("scenes/from_a_to_b.scenario.json")).expect("the example");
    let mut scenario: Value = serde_json::from_str(&text).expect("JSON");
    let object = scenario.as_object_mut().expect("an object");
    object.remove("goal");
    object.insert("time_limit_s".into(), 40.into());
    object["supply"]["times"] = 100.into();
    put(&folder, "shift.json", &scenario.to_string());
    let layout = example("scenes/from_a_to_b.json");
    let sweep = |more: &[&str]| {
        let fixed = ["sweep", &layout, "--scenario", "shift.json", "--set", "from_a_to_b.work=1,4"];
        autogen(&folder, &[&fixed[..], &["--replications", "2"], more].concat())
    };
    let output = sweep(&["--format", "json", "--report", "page.html"]);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    let found = rows(&output);
    let commission = [
        "commission",
        &layout,
        "--scenario",
        "shift.json",
        "--set",
        "from_a_to_b.work=4",
        "--format",
        "json",
    ];
    let slow = json(&autogen(&folder, &commission));
    let sinks = slow["sinks"].as_object().expect("sinks").values();
    let items: u64 =
        sinks.flat_map(|kinds| kinds.as_object().expect("kinds").values()).filter_map(Value::as_u64).sum();
    assert!(items > 0);
    assert_eq!(found[1]["items"], items);
    assert_eq!(found[1]["items_per_hour"], items as f64 * 3600.0 / 40.0);
    assert_eq!(found[1]["half_width"], 0.0);
    assert!(found[0]["items_per_hour"].as_f64() > found[1]["items_per_hour"].as_f64(), "{found:?}");
    let page = fs::read_to_string(folder.join("page.html")).expect("a page");
    assert!(page.contains("\"Items per hour\"") && page.contains("\"greatest\""));
    assert!(page.contains("\"title\":\"items\"") && !page.contains("\"title\":\"orders\""));
    let text = printed(&sweep(&[]));
    let head = text.lines().next().expect("a line");
    assert!(head.contains("      items   items/h      +-       runs     simulated  reason"), "{text}");
    assert!(text.contains("items/h by from_a_to_b.work"), "{text}");
    let parts = ["1", "2"].map(|number| {
        let name = format!("part{number}.jsonl");
        put(&folder, &name, &printed(&sweep(&["--part", &format!("{number}/2")])));
        name
    });
    let merged = autogen(&folder, &["merge", &parts[0], &parts[1]]);
    assert_eq!(printed(&merged), text, "{}", errors(&merged));
    let output = sweep(&["--warm-up", "auto"]);
    assert_eq!(status(&output), 2);
    assert!(errors(&output).contains("--warm-up cuts orders, and these scenarios have none"));
}

/// What a compiler says has many lines, a row has one.
#[cfg(unix)]
#[test]
fn a_layout_that_cannot_be_read_changes_no_column() {
    let folder = folder("sweep_beside_broken");
    for name in ["from_a_to_b.json", "from_a_to_b.aut"] {
        fs::copy(example(&format!("scenes/{name}")), folder.join(name)).expect("the example");
    }
    let kinds = r#""kinds": [{"name": "carton", "height": 0.02, "size": [0.04, 0.04]}]"#;
    put(&folder, "from_a_to_b.scenario.json", &format!(r#"{{{kinds}, "time_limit_s": 5}}"#));
    put(&folder, "broken.json", "{");
    let head = |layouts: &[&str]| {
        let output = autogen(&folder, &[&["sweep"], layouts, &["--format", "csv"]].concat());
        printed(&output).lines().next().map(String::from)
    };
    let wanted = head(&["from_a_to_b.json"]);
    assert!(wanted.as_ref().is_some_and(|head| head.ends_with(",items,items_per_hour")), "{wanted:?}");
    assert_eq!(head(&["from_a_to_b.json", "broken.json"]), wanted);
}

#[test]
fn controllers_that_cannot_be_compiled_are_a_reason_in_one_line() {
    let folder = folder("sweep_without_controllers");
    let cargo = folder.join("cargo");
    put(&folder, "cargo", "#!/bin/sh\nprintf 'error: no such thing\\n\\n --> here\\n' >&2\nexit 1\n");
    let mode = std::os::unix::fs::PermissionsExt::from_mode(0o755);
    fs::set_permissions(&cargo, mode).expect("a file of one's own");
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_autogen"))
        .args(["sweep", &example("scenes/lifting_table.json"), "--format", "jsonl"])
        .current_dir(&folder)
        .env("XDG_CACHE_HOME", folder.join("cache"))
        .env("CARGO", cargo)
        .output()
        .expect("autogen can be started");
    assert_eq!(status(&output), 2, "{}", errors(&output));
    let reason = json(&output)["reason"].as_str().expect("a text").to_string();
    let said = "the controllers could not be compiled: error: no such thing (`commission` shows all of it)";
    assert_eq!(reason, said);
}
