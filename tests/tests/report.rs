//! The report of a run, in a browser: what it shows is what the run recorded.

use crate::loads;
use autogen::backend::report;
use autogen::executor::Executor;
use autogen_tests::{Texts, ariac, browser, side_by_side, stepped};
use runtime_sim::item;
use runtime_sim::path::table_csv;
use runtime_sim::run::{Recorded, Seen, Stepping, record};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

/// Rows of the table of places are so far apart, and rounded to a millionth.
const EVERY_MS: u64 = 100;
const ROUNDED: f64 = 0.6e-6;
/// What the page rounds itself, m.
const DRAWN: f64 = 1e-6;

struct Run {
    recorded: Recorded,
    results: Value,
    page: String,
    table: String,
}

fn run(texts: &Texts) -> Run {
    run_told(texts, |_| {})
}

/// The same, with more that is told of it.
fn run_told(texts: &Texts, tell: impl Fn(&mut Value)) -> Run {
    let outcome = texts.compile();
    let project = outcome.project.expect("a line that is right");
    let (line, mut executor) = (&project.plant, Executor::new(&project.system));
    let watched = report::watched(&project.system, line);
    let ignore = &mut |_: &Seen| {};
    let recorded = record(line, &mut executor, Stepping::Events, &watched, ignore).expect("a run");
    let mut results: Value = serde_json::from_str(&recorded.report.to_json()).expect("JSON");
    tell(&mut results);
    let page = report::html(&project, &outcome.sources, line, &recorded, &results);
    let items: Vec<usize> = (0..item::Names::new(line).all().len()).collect();
    let table = table_csv(line, &recorded.paths, &items, EVERY_MS);
    Run { recorded, results, page, table }
}

/// One order of the default line.
fn default_line() -> Texts {
    let scenario = autogen_tests::text("examples/ariac2021/scenario.json");
    Texts { scenario: Some(scenario.replace("\"count\": 8", "\"count\": 1")), ..ariac("default") }
}

/// Pieces that lie across trays, which go round a corner.
fn trays() -> Texts {
    let goal = r#", "goal": {"trays.end": {"tray": 1, "piece": 2}}"#;
    let mut texts = loads::trays(&[loads::FLAT, loads::PIECE, loads::BAKED], &["piece", "piece"], goal);
    texts.layout = texts.layout.replace("[0.41, 0.01, 0, 0]", "[0.44, -0.03, 0, 90]");
    texts
}

/// The lines that are drawn: arms and vehicles, arms alone, lanes on turning and sliding cylinders.
fn lines() -> Vec<(&'static str, Texts)> {
    let mut tending = side_by_side("tending/tending");
    tending.scenario = tending.scenario.map(|text| text.replace("41", "2"));
    let scene = |name: &'static str| (name, side_by_side(&format!("scenes/{name}")));
    vec![
        ("default", default_line()),
        ("tending", tending),
        ("sorting", side_by_side("sorting/sorting")),
        scene("separating_station"),
        scene("elevator"),
        scene("converge_station"),
        scene("packing"),
        ("trays", trays()),
    ]
}

/// The data of a page.
fn data(page: &str) -> Value {
    let (_, rest) = page.split_once("id=\"data\">").expect("the data");
    let (json, _) = rest.split_once("</script>").expect("the end of the data");
    serde_json::from_str(json).expect("JSON")
}

/// Ten times, all of them multiples of the table's.
fn ten_times(end_s: f64) -> Vec<u64> {
    let steps = (end_s * 1000.0) as u64 / EVERY_MS;
    (0..10).map(|i| (steps * (2 * i + 1) / 20) * EVERY_MS).collect()
}

/// Kinds and places of the items on the line at a time by the table; two where an item changes its carrier.
fn places(table: &str, ms: u64) -> BTreeMap<String, Vec<(String, [f64; 3])>> {
    let time = format!("{:.6}", ms as f64 / 1000.0);
    let mut places: BTreeMap<String, Vec<(String, [f64; 3])>> = BTreeMap::new();
    for row in table.lines().map(|row| row.split(',').collect::<Vec<_>>()) {
        if row[2] == time {
            let place = [3, 4, 5].map(|column| row[column].parse().expect("a number"));
            places.entry(row[0].into()).or_default().push((row[1].into(), place));
        }
    }
    places
}

fn is_near(shown: &Value, place: &[f64; 3]) -> bool {
    let shown = shown.as_array().expect("a place");
    let off = |i: usize| (shown[i].as_f64().expect("a number") - place[i]).abs();
    (0..3).all(|i| off(i) < ROUNDED + DRAWN)
}

#[test]
fn the_page_draws_plays_and_zooms_and_shows_the_places_of_the_run() {
    let Some(browser) = browser::browser() else { return };
    for (name, texts) in lines() {
        let run = run(&texts);
        let end_s = run.results["simulated_s"].as_f64().expect("a number");
        let times = ten_times(end_s);
        let script = format!("const TIMES = {times:?};\n{}", include_str!("../fixtures/report/driver.js"));
        let found = browser::found(browser, name, &run.page, &script);
        let found: Value = serde_json::from_str(&found).expect("JSON");
        assert_eq!(found["errors"], Value::Array(Vec::new()), "{name}");

        for (canvas, least) in [("plan", 5), ("gantt", 5), ("signals", 4)] {
            assert!(
                found["colours"][canvas].as_u64() >= Some(least),
                "{name}: {canvas} {}",
                found["colours"]
            );
        }
        let asked = &run.results["items_asked"];
        let of_goal = format!("{} of {asked}", run.results["items_collected"]);
        for shown in ["ordered", "figures"].map(|key| found[key].as_str().expect("a text")) {
            assert_eq!(shown.contains(&of_goal), asked.is_u64(), "{name}: {shown}");
        }
        let (mut compared, mut became) = (0, 0);
        for (ms, drawn) in times.iter().zip(found["drawn"].as_array().expect("a list")) {
            assert_eq!(drawn["shown"].as_f64(), Some(*ms as f64), "{name}");
            let places = places(&run.table, *ms);
            let shown = drawn["items"].as_object().expect("items");
            for (item, place) in shown {
                let is_it = |(kind, known): &(String, [f64; 3])| {
                    is_near(place, known) && drawn["kinds"][item] == kind.as_str()
                };
                let is = places.get(item).is_some_and(|known| known.iter().any(is_it));
                let kind = &drawn["kinds"][item];
                assert!(is, "{name}: {item} at {ms} ms: {kind} {place} is not {:?}", places.get(item));
                became += usize::from(!kind.as_str().is_some_and(|kind| item.starts_with(kind)));
            }
            let gone = |item: &str| has_left(&run, item, *ms);
            let missing = places.keys().find(|item| !shown.contains_key(*item) && !gone(item));
            assert_eq!(missing, None, "{name} at {ms} ms");
            compared += shown.len();
        }
        assert!(compared >= 10, "{name}: {compared} places");
        assert_ne!(data(&run.page)["path"], json!([]), "{name}");
        // The mill makes another kind of what it cuts; an item keeps its name.
        assert_eq!(became > 0, name == "tending", "{name}");

        let played = &found["played"];
        assert!(played["to"].as_f64() > played["from"].as_f64(), "{name}: {played}");
        assert!(played["rests"] == true && played["changed"] == true, "{name}: {played}");
        assert_eq!(found["next"]["time"], found["next"]["first"], "{name}");
        let zoomed = &found["zoomed"];
        let ratio = zoomed["whole"].as_f64().expect("a number") / zoomed["line"].as_f64().expect("a number");
        assert!((ratio - 2.0).abs() < 1e-9 && zoomed["plan"] == true, "{name}: {zoomed}");
        let machine = data(&run.page)["machines"][0]["name"].as_str().expect("a name").to_string();
        assert!(found["inspector"].as_str().is_some_and(|text| text.starts_with(&machine)), "{name}");
        let steps = data(&run.page)["throughput"]["steps"].as_array().map(Vec::len);
        assert_eq!(found["bars"].as_u64(), steps.map(|steps| steps as u64), "{name}");
        // The other lines have no machines with commands.
        let moving = found["moving"].as_array().expect("cells");
        let has_commands = moving.iter().any(|cell| cell != "no commands");
        assert_eq!(has_commands, ["default", "tending", "packing"].contains(&name), "{name}: {moving:?}");
        let percent = |value: &Value| -> f64 {
            value.as_str().and_then(|text| text.strip_suffix(" %")?.parse().ok()).expect("a percentage")
        };
        assert!(percent(&found["sorted"][0]) <= percent(&found["sorted"][1]), "{name}: {}", found["sorted"]);
    }
}

/// As they are drawn, rad, at times in which the trays are on both straight conveyors and on the arc.
#[test]
fn the_page_turns_items_with_the_trays_on_which_they_lie() {
    let Some(browser) = browser::browser() else { return };
    let texts = trays();
    let times: Vec<u64> = (12..24).map(|i| 1000 * i).collect();
    let mut turns = Vec::new();
    stepped::report(&texts, |seen| {
        if times.contains(&seen.plant.now_ms()) {
            turns.push([0, 1, 2].map(|item| seen.plant.place(item).map(|_| seen.plant.turn(item))));
        }
    });
    let script = format!("const TIMES = {times:?};\n{}", include_str!("../fixtures/report/driver.js"));
    let found = browser::found(browser, "turns", &run(&texts).page, &script);
    let found: Value = serde_json::from_str(&found).expect("JSON");
    let mut turned = 0;
    for (drawn, turns) in found["drawn"].as_array().expect("a list").iter().zip(turns) {
        for (item, turn) in ["tray_1", "piece_1", "piece_2"].into_iter().zip(turns) {
            let Some(turn) = turn else { continue };
            let shown = drawn["turns"][item].as_f64().expect("a number");
            let off = (shown - turn + PI).rem_euclid(TAU) - PI;
            assert!(off.abs() < 1e-6, "{item} at {}: {shown}, not {turn}", drawn["shown"]);
            turned += 1;
        }
    }
    assert!(turned > 20, "{turned}");
}

/// Whether the table has an item at a time only since it leaves the line then.
fn has_left(run: &Run, item: &str, ms: u64) -> bool {
    let time = format!("{:.6}", ms as f64 / 1000.0);
    let mut rows = run.table.lines().rev().map(|row| row.split(',').collect::<Vec<_>>());
    let last = rows.find(|row| row[0] == item).expect("a row of the item");
    last[2] == time && (last[6] == "collector" || last[6].starts_with("order "))
}

/// What stands in a text of the line is text on the page.
#[test]
fn text_of_a_specification_is_never_markup() {
    let hostile =
        "</script><img src=x onerror=\"errors.push('markup')\"><script>errors.push('script')</script><!--";
    let plain = run(&side_by_side("scenes/lifting_table"));
    let mut texts = side_by_side("scenes/lifting_table");
    let own = texts.specs[0].replacen("automaton ", &format!("/// {hostile}\nautomaton "), 1);
    texts.specs[0] = own.replacen("    state ", &format!("    /// {hostile}\n    state "), 1);
    let run = run(&texts);
    for (tag, more) in [("<script", 0), ("<img", 0), ("<!--", 0)] {
        let count = |page: &str| page.matches(tag).count();
        assert_eq!(count(&run.page), count(&plain.page) + more, "{tag}");
    }
    let Some(browser) = browser::browser() else { return };
    let script = format!("const TIMES = [0];\n{}", include_str!("../fixtures/report/driver.js"));
    let found = browser::found(browser, "hostile", &run.page, &script);
    let found: Value = serde_json::from_str(&found).expect("JSON");
    assert_eq!(found["errors"], Value::Array(Vec::new()));
    assert_eq!(found["images"], 0);
    let text = found["inspector"].as_str().expect("a text");
    assert!(text.contains(hostile), "{text}");
}

#[test]
fn a_run_of_a_sweep_says_which_one_it_is() {
    let Some(browser) = browser::browser() else { return };
    let facts = json!([["row of the sweep", "2"], ["point", "layout <b>, speed 4"], ["seed", "7"]]);
    let run = run_told(&side_by_side("scenes/lifting_table"), |results| results["of_sweep"] = facts.clone());
    let script = format!("const TIMES = [0];\n{}", include_str!("../fixtures/report/driver.js"));
    let found = browser::found(browser, "of-sweep", &run.page, &script);
    let found: Value = serde_json::from_str(&found).expect("JSON");
    assert_eq!(found["errors"], Value::Array(Vec::new()));
    assert_eq!(found["facts"], "row of the sweep2pointlayout <b>, speed 4seed7");
    assert!(found["title"].as_str().is_some_and(|title| title.ends_with(", row of the sweep 2 – report")));
}

/// Nothing is fetched, and nothing that could be is named.
#[test]
fn the_page_names_nothing_outside_of_it() {
    let page = run(&side_by_side("scenes/lifting_table")).page;
    // The name of a namespace is no address.
    let page = page.replace("'http://www.w3.org/2000/svg'", "");
    for outside in ["http:", "https:", "src=", "href=", "@import", "url(", "fetch(", "import("] {
        assert!(!page.contains(outside), "{outside}");
    }
}

/// The shares of what limits a line are one after another, each within a stay of its machine, and add up.
#[test]
fn the_path_that_limits_a_run_has_no_gap() {
    for (name, texts) in lines() {
        let run = run(&texts);
        let data = data(&run.page);
        let limit = &data["limit"];
        let scan_ms = data["scan_ms"].as_f64().expect("a number");
        let legs: Vec<[u64; 3]> = serde_json::from_value(data["path"].clone()).expect("a list of legs");
        assert!(legs.windows(2).all(|pair| pair[0][2] == pair[1][1]), "{name}: {legs:?}");
        assert_eq!(legs.first().map(|leg| leg[1]), Some(0), "{name}");
        let shares = limit["machines"].as_array().expect("a list").iter();
        let sum: f64 = shares.map(|share| share["s"].as_f64().expect("a number")).sum();
        let sum = sum + limit["stands_s"].as_f64().expect("a number");
        let end = legs.last().map_or(0, |leg| leg[2]);
        assert!((sum - end as f64 * scan_ms / 1000.0).abs() < 1e-6, "{name}: {sum}");
        assert!(end <= run.recorded.report.scans);
    }
}

/// By hand: the mill cuts for 90 s a piece, and all else is done while it cuts or takes less.
#[test]
fn the_mill_limits_the_tending_cell() {
    let (_, texts) = lines().swap_remove(1);
    let data = data(&run(&texts).page);
    let first = &data["limit"]["machines"][0];
    assert_eq!(data["machines"][first["machine"].as_u64().expect("a number") as usize]["name"], "mill");
    let cutting = first["states"][0][1].as_f64().expect("a number");
    assert!((cutting - 180.0).abs() < 1.0, "two pieces: {cutting}");
}

/// Faults of the scenario are in the table of alarms, those that come after the end are not.
#[test]
fn faults_of_the_scenario_are_told() {
    let mut texts = side_by_side("sorting/sorting");
    let faults = r#"{"time_limit_s": 40, "faults": {
        "sensors": [{"robot": "sorter", "signal": "is_red", "reads": true, "at_s": 9, "for_s": 2}],
        "jams": [{"robot": "sorter", "part": "second_arm", "at_s": 12.5},
                 {"robot": "sorter", "part": "belt", "at_s": 500}]},"#;
    texts.scenario = texts
        .scenario
        .map(|text| text.replacen('{', faults, 1).replace("\"supply\": {", "\"supply\": {\"first_s\": 90, "));
    let data = data(&run(&texts).page);
    let told = data["alarms"].as_array().expect("a list").iter();
    let told: Vec<(f64, i64, &str)> = told
        .map(|row| {
            let text = row[2].as_str().expect("a text");
            (row[0].as_f64().expect("a number"), row[1].as_i64().expect("a number"), text)
        })
        // Without an item the line itself ends in a fault.
        .filter(|(_, _, text)| !text.starts_with("fault"))
        .collect();
    let expected =
        [(9.0, 0, "is_red sticks: it reads true"), (11.0, 0, "is_red is free"), (12.5, 0, "second_arm jams")];
    assert_eq!(told, expected);
}

/// A pause is told with its times, and is the share of no machine on the path that limits the run.
#[test]
fn a_pause_limits_a_run_but_is_no_work() {
    let mut texts = default_line();
    let pause = r#"{"faults": {"pauses": [{"at_s": 30, "for_s": 5}]},"#;
    texts.scenario = texts.scenario.map(|text| text.replacen('{', pause, 1));
    let data = data(&run(&texts).page);
    let told = data["alarms"].as_array().expect("a list").iter();
    let told: Vec<(f64, &str)> = told
        .map(|row| (row[0].as_f64().expect("a number"), row[2].as_str().expect("a text")))
        .filter(|(_, text)| text.contains("run_permit"))
        .collect();
    assert_eq!(told, [(30.0, "run_permit falls: the line stops"), (35.0, "run_permit is back")]);
    // Two scans before the first start, and one from the permit to the next start.
    assert_eq!(data["limit"]["stands_s"], json!(5.03));
}

/// The states of the page are those of the accounts.
#[test]
fn times_in_states_add_up_to_the_accounts() {
    let run = run(&default_line());
    let data = data(&run.page);
    let scan_ms = data["scan_ms"].as_f64().expect("a number");
    let end = run.recorded.report.scans;
    for (machine, stays) in data["stays"].as_array().expect("a list").iter().enumerate() {
        let stays: Vec<u64> = serde_json::from_value(stays.clone()).expect("whole numbers");
        let mut sums = [0.0; 4];
        let mut begin = 0;
        for (i, stay) in stays.chunks(3).enumerate() {
            begin += stay[0];
            let next = stays.get(3 * (i + 1)).map_or(end, |later| begin + later);
            sums[stay[2] as usize] += (next - begin) as f64 * scan_ms / 1000.0;
        }
        let name = data["machines"][machine]["name"].as_str().expect("a name");
        let account = &run.results["robots"][name];
        for (sum, key) in sums.iter().zip(["moving_s", "working_s", "waiting_s", "stopped_s"]) {
            assert!((sum - account[key].as_f64().expect("a number")).abs() < 1e-6, "{name} {key}: {sum}");
        }
        let in_states: Vec<(usize, f64)> =
            serde_json::from_value(data["machines"][machine]["in_states"].clone()).expect("times in states");
        let sum: f64 = in_states.iter().map(|(_, s)| s).sum();
        assert!((sum - (sums[0] + sums[1] + sums[2])).abs() < 1e-6, "{name}: {sum}");
        assert!(in_states.is_sorted_by(|a, b| a.1 >= b.1), "{name}: {in_states:?}");
    }
}

/// What the controllers' faults are called is added to the results by those who know the text.
#[test]
fn faults_are_listed_once_with_their_machine() {
    let listed = |reset: Value| {
        let mut tending = side_by_side("tending/tending");
        let mut scenario: Value = serde_json::from_str(&tending.scenario.unwrap_or_default()).expect("JSON");
        scenario["time_limit_s"] = 220.into();
        scenario["faults"] = json!({"jams": [{"robot": "mill", "part": "door", "at_s": 110, "for_s": 60}]});
        scenario["operator"] = reset;
        tending.scenario = Some(scenario.to_string());
        let run = run(&tending);
        let rows = data(&run.page)["alarms"].clone();
        let rows = rows
            .as_array()
            .expect("a list")
            .iter()
            .filter(|row| row[2].as_str().is_some_and(|text| text.contains("fault")));
        let machine = |row: &Value| {
            let number = row[1].as_u64().and_then(|number| usize::try_from(number).ok()).expect("a machine");
            run.recorded.report.machines[number].name.clone()
        };
        let rows = rows.map(|row| (row[0].as_f64().expect("a time"), machine(row), row[2].clone()));
        rows.collect::<Vec<_>>()
    };
    let ended = listed(json!([]));
    assert_eq!(ended.len(), 1, "{ended:?}");
    assert_eq!(ended[0].1, "mill");
    let at_s = ended[0].0;
    let cleared = listed(json!([{"part": "reset", "at_s": 200, "for_s": 0.2}]));
    let times: Vec<(f64, &str)> =
        cleared.iter().map(|(at_s, machine, _)| (*at_s, machine.as_str())).collect();
    assert_eq!(times, [(at_s, "mill"), (200.0, "mill")], "{cleared:?}");
    assert!(cleared[0].2.as_str().is_some_and(|text| text.contains(" in Opening")), "{cleared:?}");
}
