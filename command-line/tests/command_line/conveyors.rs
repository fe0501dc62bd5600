//! Conveyors that are joined, sinks, and sources that have no more parts.

use super::*;

/// The buffer station, each of its files with one text in place of another one.
fn changed(name: &str, changes: &[(&str, &str, &str)]) -> PathBuf {
    let folder = folder(name);
    for file in ["buffer_station.json", "buffer_station.scenario.json", "buffer_station.aut"] {
        let mut text = fs::read_to_string(example(&format!("scenes/{file}"))).expect("an example");
        for (of, from, to) in changes.iter().filter(|(of, ..)| *of == file) {
            assert!(text.contains(from), "{from} in {of}");
            text = text.replacen(from, to, 1);
        }
        fs::write(folder.join(file), text).expect("a file");
    }
    folder
}

fn checked(folder: &Path, more: &[&str]) -> Output {
    autogen(folder, &[&["check", "buffer_station.json"][..], more].concat())
}

#[test]
fn check_shows_joined_conveyors_and_sinks() {
    let folder = changed("joined", &[]);
    let output = checked(&folder, &[]);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    let text = String::from_utf8_lossy(&output.stdout);
    let expected = "conveyors (margin of a joint: by how much more the ends could be apart and turned)
  inlet.queue  -> inlet.fast    5.0 mm, 1.00 degrees
  inlet.fast   -> buffer.queue  5.0 mm, 1.00 degrees
  buffer.queue -> buffer.fast   5.0 mm, 1.00 degrees
sources       inlet
sinks         buffer.out_box
lost without
  inlet  all at buffer.out_box
step order    inlet, buffer
feasible
";
    assert_eq!(text, expected);
    let answer = json(&checked(&folder, &["--format", "json"]));
    let second = &answer["conveyors"][1];
    assert_eq!([&second["from"], &second["to"], &second["by"]], ["inlet.fast", "buffer.queue", "joint"]);
    assert!((second["margin_mm"].as_f64().expect("a number") - 5.0).abs() < 1e-6, "{second}");
    let lost = serde_json::json!([{"without": "inlet", "lost": [{"at": "buffer.out_box", "kinds": ["box"], "others": []}]}]);
    assert_eq!(answer["losses"], lost);
    assert_eq!(answer["sinks"], serde_json::json!(["buffer.out_box"]));
}

#[test]
fn a_sink_to_which_no_item_can_get_is_an_error() {
    // A metre away.
    let folder = changed("apart", &[("buffer_station.json", "[2.1, 0, 0]", "[3.1, 0, 0]")]);
    let output = checked(&folder, &[]);
    assert_eq!(status(&output), 1);
    let text = errors(&output);
    assert!(text.contains("error[E0410]: no `box` can get to the sink buffer.out_box"), "{text}");
    assert!(text.contains("machines that a `box` can get to: inlet"), "{text}");
    assert!(text.contains("buffer_station.scenario.json:4:"), "{text}");
    assert!(String::from_utf8_lossy(&output.stdout).ends_with("not feasible\n"));
    // What falls onto a conveyor gets there too: the buffer stands lower, so that the two are not joined.
    let lower = [("buffer_station.json", "[2.1, 0, 0]", "[2.05, 0, -0.1]")];
    let output = checked(&changed("falls", &lower), &[]);
    assert!(!errors(&output).contains("E0410"), "{}", errors(&output));
}

#[test]
fn a_sink_that_waits_for_a_kind_which_nobody_brings_is_an_error() {
    let kinds = "{\"name\": \"can\", \"height\": 0.2}, {\"name\": \"box\"";
    let folder = changed(
        "no_kind",
        &[
            ("buffer_station.scenario.json", "{\"name\": \"box\"", kinds),
            ("buffer_station.scenario.json", "{\"box\": 8}", "{\"box\": 7, \"can\": 1}"),
        ],
    );
    let output = checked(&folder, &[]);
    assert_eq!(status(&output), 1);
    let text = errors(&output);
    assert!(text.contains("error[E0410]: no `can` can get to the sink buffer.out_box"), "{text}");
    assert!(text.contains("no source brings a `can`"), "{text}");
    assert!(!text.contains("no `box`"), "{text}");
}

#[test]
fn a_source_without_parts_is_named_where_a_line_waits() {
    let scenario = "buffer_station.scenario.json";
    let folder = changed(
        "empty",
        &[
            (scenario, "\"times\": 8", "\"times\": 3"),
            (scenario, "{\"box\": 8}", "{\"box\": 3}"),
            (scenario, "\"operator\"", "\"time_limit_s\": 8, \"operator\""),
        ],
    );
    let output = autogen(&folder, &["why", "buffer_station.json"]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(status(&output), 0, "{}", errors(&output));
    assert!(text.contains("inlet: the source has no more parts, since 6.46 s\n"), "{text}");
    let output = autogen(&folder, &["why", "buffer_station.json", "--at", "5"]);
    assert!(!String::from_utf8_lossy(&output.stdout).contains("no more parts"));
    // The report of a run that does not come to its goal says so too.
    let output = autogen(&folder, &["commission", "buffer_station.json"]);
    assert_eq!(status(&output), 3, "{}", errors(&output));
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("inlet: the source has no more parts, since 6.46 s"), "{text}");
}
