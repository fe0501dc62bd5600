//! The page of a sweep: the same as its text, and what it is about.

use super::report::data;
use super::sweep::{printed, put, rows};
use super::{autogen, errors, example, folder, status};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// Two orders of two parts, with five seeds from 7 on: a time limit that ends some of these runs.
fn put_tight(folder: &Path) {
    let scenario = r#"{"kinds": [{"name": "battery", "height": 0.053}, {"name": "pump", "height": 0.11}],
        "orders": {"count": 2, "parts": {"battery": 1, "pump": 1}}, "supply": {"seed": 7}}"#;
    put(folder, "long.json", scenario);
    let sweep = ["sweep", &example("ariac2021/default.json"), "--scenario", "long.json"];
    let seeds = ["--set", "supply.seed=7,8,9,10,11", "--format", "json"];
    let output = autogen(folder, &[&sweep[..], &seeds].concat());
    assert_eq!(status(&output), 0, "{}", errors(&output));
    let seconds = |row: &Value| row["simulated_s"].as_f64().expect("a time");
    let mut ends: Vec<f64> = rows(&output).iter().map(seconds).collect();
    ends.sort_by(f64::total_cmp);
    assert!(ends[2] + 0.1 < ends[3], "{ends:?}");
    let limit = format!("{{\"time_limit_s\": {:.2},", ends[2] + 0.05);
    put(folder, "tight.json", &scenario.replacen('{', &limit, 1));
}

/// Cells of a line of text: two spaces stand between them at least.
fn cells(line: &str) -> Vec<&str> {
    line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).collect()
}

fn texts(list: &Value, key: &str) -> Vec<String> {
    let items = list.as_array().expect("a list").iter();
    items.map(|item| item[key].as_str().expect("a text").to_string()).collect()
}

#[test]
fn it_has_the_columns_and_the_cells_of_the_text() {
    let folder = folder("sweep_page");
    put_tight(&folder);
    let layout = example("ariac2021/default.json");
    let sweep = ["sweep", &layout, "--scenario", "tight.json", "--set", "agv.capacity=4,1,13"];
    let more = ["--replications", "5", "--compare", "--report", "page.html"];
    let output = autogen(&folder, &[&sweep[..], &more].concat());
    assert_eq!(status(&output), 3, "{}", errors(&output));
    let text = printed(&output);
    let page = data(&fs::read_to_string(folder.join("page.html")).expect("a page"));
    let names = page["names"].as_array().expect("a list");
    let mut heads = texts(&page["names"], "title");
    heads.extend(texts(&page["columns"], "title"));
    heads.push("reason".into());
    assert!(heads.contains(&"+- of difference".to_string()));
    let heads: Vec<&str> =
        heads.iter().map(|head| if *head == "+- of difference" { "+-" } else { head }).collect();
    assert_eq!(heads, cells(text.lines().next().expect("a line")));
    for (number, line) in text.lines().skip(1).take(3).enumerate() {
        let row = &page["rows"][number];
        let mut shown: Vec<&str> = Vec::new();
        for (name, at) in names.iter().zip(row["at"].as_array().expect("a list")) {
            shown.push(name["values"][at.as_u64().expect("a number") as usize].as_str().expect("a text"));
        }
        shown.extend(row["cells"].as_array().expect("a list").iter().filter_map(Value::as_str));
        shown.push(row["reason"].as_str().expect("a text"));
        assert_eq!(shown, cells(line));
    }
    let first = &page["rows"][0];
    assert_eq!((&first["runs"], &first["finished_runs"]), (&5.into(), &3.into()), "{first}");
    assert!(text.contains("3 of 5") && first["figure"].is_f64(), "{text}");
    let refused = &page["rows"][2];
    assert_eq!(refused["remarks"][0], "help: write a whole number from 1 to 12");
    assert_eq!(refused["figure"], Value::Null);
}

#[test]
fn its_head_says_what_was_run() {
    let folder = folder("sweep_page_head");
    put_tight(&folder);
    let layout = example("ariac2021/default.json");
    let sweep = ["sweep", &layout, "--scenario", "long.json", "--set", "agv.capacity=4,1", "--set"];
    let more = ["conveyor.near=0", "--replications", "2", "--warm-up", "1orders", "--compare"];
    let run = |jobs: &str, page: &str| {
        let fixed = [&sweep[..], &more, &["--jobs", jobs, "--report", page, "--keep", "2"]].concat();
        let output = autogen(&folder, &fixed);
        assert_eq!(status(&output), 0, "{}", errors(&output));
        fs::read_to_string(folder.join(page)).expect("a page")
    };
    let page = run("1", "page.html");
    assert!(page.contains("<title>Sweep of default by agv.capacity</title>"));
    for (name, value) in [
        ("layouts", "default"),
        ("scenario", "long.json"),
        ("varied", "agv.capacity = 4, 1"),
        ("fixed", "conveyor.near = 0"),
        ("replications", "2"),
        ("seed", "7, one more for each further replication"),
        ("warm-up", "1orders"),
        ("difference to", "row 1: layout default, agv.capacity 4, conveyor.near 0"),
    ] {
        assert!(page.contains(&format!("<dt>{name}</dt><dd>{value}</dd>")), "{name}");
    }
    // Neither the number of jobs nor the place of a file.
    fs::copy(folder.join("page.html"), folder.join("first.html")).expect("a copy");
    assert!(run("3", "page.html") == page);
    assert!(!page.contains(&*folder.to_string_lossy()) && !page.contains(&layout));

    let kept = fs::read_to_string(folder.join("page-runs/row-2.html")).expect("a page");
    let facts = serde_json::json!([
        ["row of the sweep", "2"],
        ["point", "layout default, agv.capacity 1, conveyor.near 0"],
        ["scenario", "long.json"],
        ["replication", "1"],
        ["seed", "7"],
    ]);
    assert_eq!(data(&kept)["results"]["of_sweep"], facts);
}

#[test]
fn a_precision_of_some_of_the_runs_is_told() {
    let folder = folder("sweep_page_precision");
    put_tight(&folder);
    let layout = example("ariac2021/default.json");
    let run = |scenario: &str| {
        let sweep = ["sweep", &layout, "--scenario", scenario, "--until-precision", "50%"];
        errors(&autogen(&folder, &[&sweep[..], &["--replications", "20", "--quiet"]].concat()))
    };
    let said = run("tight.json");
    assert!(said.contains(" of 1 point did not finish: a precision is that of the runs that did"), "{said}");
    assert_eq!(run("long.json"), "");
}
