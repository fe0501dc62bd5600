//! The page of a run, and that of a sweep.

use super::sweep::{put, rows};
use super::{autogen, errors, example, folder, json, status};
use serde_json::Value;
use std::fs;

/// One order of one part.
const SCENARIO: &str = r#"{"kinds": [{"name": "battery", "height": 0.053}],
    "orders": {"count": 1, "parts": {"battery": 1}}}"#;

/// The data of a page.
pub fn data(page: &str) -> Value {
    let (_, rest) = page.split_once("id=\"data\">").expect("the data");
    serde_json::from_str(rest.split_once("</script>").expect("their end").0).expect("JSON")
}

#[test]
fn a_report_stays_with_its_results() {
    let folder = folder("report");
    put(&folder, "one.json", SCENARIO);
    let layout = example("ariac2021/default.json");
    let run = |more: &[&str]| {
        let line = ["commission", &layout, "--scenario", "one.json", "-o", "made", "--format", "json"];
        autogen(&folder, &[&line[..], more].concat())
    };
    let page = folder.join("made/report.html");
    let first = run(&[]);
    assert_eq!(status(&first), 0, "{}", errors(&first));
    let text = fs::read_to_string(&page).expect("a report");
    let results: Value =
        serde_json::from_str(&fs::read_to_string(folder.join("made/results.json")).expect("results"))
            .expect("JSON");
    assert_eq!(data(&text)["results"], results);
    let manifest = fs::read_to_string(folder.join("made/manifest.json")).expect("a manifest");
    assert!(manifest.contains("\"report.html\""));

    // The run is the same with and without; a report of other results would be none.
    let without = run(&["--no-report"]);
    assert_eq!(json(&without)["trace_hash"], json(&first)["trace_hash"]);
    assert!(!page.exists() && folder.join("made/results.json").exists());

    // What goes with other files is said, once.
    let said = |command: &[&str]| {
        let line = ["--scenario", "one.json", "-o", "made"];
        let output = autogen(&folder, &[command, &[&layout], &line].concat());
        assert_eq!(status(&output), 0, "{}", errors(&output));
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        text.lines().find(|line| line.contains("earlier run")).map(String::from)
    };
    let of = |what: &str| Some(format!("{what} not belong to what the folder has now"));
    assert_eq!(said(&["commission"]), None);
    assert_eq!(said(&["build"]), None);
    assert_eq!(
        said(&["commission", "--no-report"]),
        of("report.html of an earlier run was removed: it does")
    );
    assert_eq!(said(&["commission"]), None);
    let both = "results.json and report.html of an earlier run were removed: they do";
    assert_eq!(said(&["build", "--drives"]), of(both));
    assert_eq!(said(&["build"]), None);

    // It is written over nothing that somebody else has written, and this is known before the run.
    fs::write(&page, "mine").expect("a file");
    let refused = run(&[]);
    assert_eq!(status(&refused), 2);
    assert!(json(&refused)["reason"].as_str().is_some_and(|reason| reason.contains("report.html")));
    assert_eq!(fs::read_to_string(&page).expect("a file"), "mine");
    assert_eq!(status(&run(&["--no-report"])), 0);
    assert_eq!(fs::read_to_string(&page).expect("a file"), "mine");
    assert_eq!(status(&run(&["--force"])), 0);
    assert_eq!(fs::read_to_string(&page).expect("a report"), text);

    // One of an earlier run that was changed would be taken for one of this run.
    fs::write(&page, format!("{text}<!-- mine -->")).expect("a file");
    let refused = run(&["--no-report"]);
    assert_eq!(status(&refused), 2);
    assert!(json(&refused)["reason"].as_str().is_some_and(|reason| reason.contains("report.html")));
    assert!(page.exists());
    assert_eq!(status(&run(&["--no-report", "--force"])), 0);
    assert!(!page.exists());
}

#[test]
fn a_sweep_has_a_report_that_links_the_runs_that_are_kept() {
    let folder = folder("sweep_report");
    put(&folder, "one.json", SCENARIO);
    let layout = example("ariac2021/default.json");
    let line = ["sweep", &layout, "--scenario", "one.json", "--set", "agv.capacity=2,4", "--format", "json"];
    let run = |more: &[&str]| autogen(&folder, &[&line[..], more].concat());
    let output = run(&["--report", "all pages.html", "--keep", "2"]);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    assert_eq!(output.stdout, run(&[]).stdout, "the table is the same");
    let page = data(&fs::read_to_string(folder.join("all pages.html")).expect("a report"));
    let expected = rows(&output);
    let shown = page["rows"].as_array().expect("rows");
    assert_eq!(shown.len(), expected.len());
    assert_eq!(page["names"][1]["title"], "agv.capacity");
    for (number, (shown, row)) in shown.iter().zip(&expected).enumerate() {
        assert_eq!(shown["at"], serde_json::json!([0, number]));
        assert_eq!(shown["figure"], row["seconds_per_order"]);
        assert_eq!(page["names"][1]["values"][number], row["set"]["agv.capacity"].to_string());
    }
    assert_eq!(page["kept"], serde_json::json!({ "2": "./all%20pages-runs/row-2.html" }));
    let kept = data(&fs::read_to_string(folder.join("all pages-runs/row-2.html")).expect("a report"));
    assert_eq!(kept["results"]["trace_hash"], expected[1]["trace_hash"]);
    assert!(!folder.join("all pages-runs/row-1.html").exists());

    // Its own files are written anew, others are not.
    assert_eq!(status(&run(&["--report", "all pages.html", "--keep", "all"])), 0);
    assert!(folder.join("all pages-runs/row-1.html").exists());
    put(&folder, "other.html", "mine");
    for (options, text) in [
        (&["--report", "other.html"][..], "other.html: this file is not a report"),
        (
            &["--report", "new.html", "--keep", "3"],
            "--keep 3: it takes `all`, or numbers of rows from 1 to 2",
        ),
        (&["--report", "new.html", "--keep", "x"], "--keep x"),
        (&["--report", "none/new.html"], "none/new.html"),
    ] {
        let output = run(options);
        assert_eq!(status(&output), 2, "{options:?}");
        let said: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert!(said["reason"].as_str().is_some_and(|reason| reason.contains(text)), "{said}");
    }
    assert_eq!(fs::read_to_string(folder.join("other.html")).expect("a file"), "mine");
    assert!(!folder.join("new.html").exists());
}
