//! A search that postpones answers nobody needs yet, against one that does not.

use autogen::verify::{Asked, model};
use autogen_search::explore::{Bounds, Decided, End, explore};
use autogen_search::plant::Faults;
use autogen_tests::bounds::BOUNDS;
use autogen_tests::mutants::mutants;
use autogen_tests::outcome::verdict;
use autogen_tests::postponing::{compare, compare_verdicts, found_with_and_without};
use autogen_tests::small_lines::{self, Line};
use autogen_tests::{Texts, ariac, fixtures, is_full_campaign, on_all_processors};
use serde_json::Value;

const ONE_PART: &str = r#"{
    "kinds": [{"name": "battery", "height": 0.053}],
    "orders": [{"station": "as1", "parts": {"battery": 1}}]
}"#;

const TWO_PARTS: &str = r#"{
    "kinds": [{"name": "battery", "height": 0.053}, {"name": "pump", "height": 0.12}],
    "orders": [{"station": "as1", "parts": {"battery": 1, "pump": 1}}]
}"#;

fn four_vehicles(layout: &str) -> Texts {
    Texts { scenario: Some(ONE_PART.into()), ..ariac(layout) }
}

#[test]
fn small_lines_do_the_same() {
    let lines = small_lines::all();
    let saved = lines.iter().filter_map(|line| compare(line.name, &line.texts, line.faults));
    assert!(saved.sum::<usize>() > 0);
}

#[test]
fn lines_with_mistakes_do_the_same() {
    let lines = small_lines::all();
    for (name, text) in fixtures("verify/mistakes", "json") {
        let mistake: Value = serde_json::from_str(&text).expect("a file");
        let text = |key: &str| mistake[key].as_str().expect("a text");
        let line = lines.iter().find(|line| line.name == text("line")).expect("the name of a line");
        let changed = line.text_of(text("type")).replace(text("from"), text("to"));
        compare(&name, &line.with(text("type"), &changed), line.faults);
    }
}

/// An arm chooses a vehicle for the second part while the first one is on its way.
#[test]
fn two_parts_do_the_same() {
    let texts = Texts { scenario: Some(TWO_PARTS.into()), ..ariac("less_agv") };
    assert!(compare("less_agv, two parts", &texts, Faults::None) > Some(0));
}

#[test]
fn four_vehicles_do_the_same() {
    for layout in ["default", "less_agv"] {
        assert!(compare(layout, &four_vehicles(layout), Faults::None) > Some(0));
    }
}

/// The long form: all mutants, with faults too.
#[test]
fn mutants_do_the_same() {
    let is_long = is_full_campaign();
    let mut lines =
        vec![Line { name: "four vehicles", texts: four_vehicles("default"), faults: Faults::None }];
    lines.extend(small_lines::all().into_iter().filter(|line| line.name.starts_with("vehicle, ")));
    lines.retain(|line| is_long || line.faults == Faults::None);
    let mut all = Vec::new();
    for name in ["agv", "kitting", "gantry", "station", "conveyor"] {
        let of_type = mutants(&lines[0].text_of(name)).into_iter().map(|mutant| (name, mutant));
        all.extend(of_type.step_by(if is_long { 1 } else { 20 }));
    }
    let compared = on_all_processors(&all, |(name, mutant)| {
        let of_line = |line: &Line| {
            let what = format!("{}, {name}.aut, {}", line.name, mutant.what);
            compare(&what, &line.with(name, &mutant.text), line.faults)
        };
        lines.iter().filter_map(of_line).count()
    });
    assert!(compared.into_iter().sum::<usize>() >= all.len());
}

/// The library's types with one place of this one changed.
fn changed(texts: Texts, name: &str, from: &str, to: &str) -> Texts {
    let line = Line { name: "", texts, faults: Faults::None };
    let text = line.text_of(name);
    assert!(text.contains(from), "{from}");
    line.with(name, &text.replace(from, to))
}

/// In some orders of steps a vehicle that has come home sees that a part is on its way that no arm has claimed yet.
#[test]
fn what_is_so_within_one_scan_alone_is_seen() {
    let line = Line { name: "", texts: four_vehicles("less_agv"), faults: Faults::None };
    let (local, from) = ("    local next:", "        when all_loaded -> Moving");
    let claimed = "not is_early and (exists s in stations, k in Kind: s.coming[k] > s.aboard[k])";
    let text = line.text_of("agv");
    assert!(text.contains(local) && text.contains(from));
    let text = text
        .replace(
            local,
            &format!("    serves stations: Demand[1..];\n    local is_early: bool := false;\n{local}"),
        )
        .replace(from, &format!("        when {claimed} {{ is_early := true; }}\n{from}"));
    let texts = line.with("agv", &text);
    for order in 1..8 {
        let texts = Texts { order: Some(order), ..texts.clone() };
        assert!(compare(&format!("order {order}"), &texts, Faults::None) > Some(0));
    }
}

/// An arm whose grip is refused does another thing if all vehicles are at home.
#[test]
fn what_is_read_when_devices_fail_is_seen() {
    let from = "        when failed -> Missing { grip := false; move(grip_point + up(clearance)); }\n    }\n    /// No part";
    let other = "        when failed and (forall t in trays: t.open) -> Missing { grip := false; move(grip_point + up(tray_clearance)); }\n";
    let texts = changed(four_vehicles("less_agv"), "kitting", from, &format!("{other}{from}"));
    assert!(compare("less_agv", &texts, Faults::All).is_some());
}

/// What is beside the machines of a fixture, if that says nothing else.
const OTHERS: &str = "
automaton Feed on belt { initial -> Idle {} final state Idle; }
automaton Bystander on vehicle {
    initial -> Going { goto(stops[0]); }
    state Going { when done -> Home {} }
    final state Home;
}
automaton Desk on station {
    initial -> Idle {}
    state Idle { when after 1 s -> Sent { complete := true; } }
    final state Sent;
}
automaton Idle on station { initial -> Idle {} final state Idle; }";

/// If the orders cannot be made, nothing is postponed in the end.
const NO_WAY_OUT: &str = "// no way out";

/// Machines that step in the order of the text, then a station, and a conveyor if it names none. Every state has a way out,
/// because the station sends away what is wrong, unless the text says that there is none.
fn line_of(text: &str) -> (Texts, Faults) {
    let after = |word: &str| text.lines().find_map(|line| line.strip_prefix(word));
    let types = after("// machines: ").expect("the types of machines").split(", ");
    let robot = |(number, of): (usize, &str)| {
        let y = 3 * number;
        let place = match of {
            "table" => format!(r#""pose": [0, {y}, 0]"#),
            "over" => r#""pose": [0.966, 0, 1.127], "rail_dim": "y", "rail_range": [-4.8, 4.8]"#.to_string(),
            "across" => {
                r#""pose": [-0.966, 0, 1.127], "rail_dim": "y", "rail_range": [-4.8, 4.8]"#.to_string()
            }
            "feed" => r#""pose": [1.693, 0, 0], "orient": "y", "orient_range": [-5, 5]"#.to_string(),
            _ => format!(r#""pose": [0, {y}, 0], "destinations": [[5, {y}, 0], [10, {y}, 0]]"#),
        };
        format!(r#"{{"name": "v{number}", "type": "{of}", {place}}}"#)
    };
    let last = if types.clone().any(|of| of == "feed") { None } else { Some("feed") };
    let arm = types.clone().position(|of| matches!(of, "over" | "across"));
    let robots: Vec<String> = types.chain(last).enumerate().map(robot).collect();
    let desk = if after(NO_WAY_OUT).is_some() { "idle" } else { "desk" };
    let layout = format!(
        r#"{{"robots": [{}, {{"name": "desk", "type": "{desk}", "pose": [-5, 0, 0]}}]}}"#,
        robots.join(", ")
    );
    let mut scenario = ONE_PART.replace("as1", after("// order: ").unwrap_or("desk"));
    // Nothing brings parts to the desk. In a line with an arm that is an error, unless parts may slip.
    if let Some(arm) = arm {
        let slip = format!(r#""faults": {{"slips": [{{"robot": "v{arm}", "pick": 1, "after_s": 1}}]}}"#);
        scenario = scenario.replacen('{', &format!("{{{slip}, "), 1);
    }
    let specs = vec![OTHERS.to_string(), text.to_string()];
    let texts = Texts { specs, scenario: Some(scenario), ..Texts::of_layout(layout) };
    (texts, if after("// faults").is_some() { Faults::All } else { Faults::None })
}

/// Each needs one of the rules that say what must not be postponed.
#[test]
fn small_lines_of_vehicles_do_the_same() {
    for (name, text) in fixtures("verify/postponed", "aut") {
        let (texts, faults) = line_of(&text);
        compare_verdicts(&name, &texts, faults);
        let saved = compare(&name, &texts, faults);
        assert!(saved > Some(0) || text.contains(NO_WAY_OUT), "{name}");
    }
}

/// Each needs one of the rules that say what must not be forgotten, and which machines are asked in a scan and behind a stop.
#[test]
fn what_is_left_out_is_not_missed() {
    let mut wrong = Vec::new();
    for (name, text) in fixtures("verify/forgotten", "aut") {
        let (texts, faults) = line_of(&text);
        let [found, without] = found_with_and_without(&texts, faults);
        let of_kind = |violation: &String| violation.split(' ').next().unwrap_or_default().to_string();
        let mut kinds: Vec<String> = found.1.iter().map(of_kind).collect();
        kinds.dedup();
        // The desk sends away what is not there.
        kinds.retain(|kind| kind != "WrongItems");
        let expected = text.lines().find_map(|line| line.strip_prefix("// finds: ")).expect("what it finds");
        let is_expected = kinds.join(", ") == if expected == "nothing" { "" } else { expected };
        if found != without || !is_expected {
            wrong.push(name);
        }
    }
    assert_eq!(wrong, Vec::<String>::new());
}

/// At first a few states show a mistake, but not that the orders can be made. All that may happen are too many states.
#[test]
fn what_was_found_is_told_if_the_search_begins_anew() {
    let text = "
// machines: racer, bystander, bystander, bystander, bystander
// no way out
automaton Racer on vehicle {
    local laps: int 0..5 := 0;
    invariant laps < 5 else stop machine \"it has gone too far\";

    initial -> Going { goto(stops[1]); }
    state Going {
        when done -> Going { laps += 1; goto(stops[1]); }
        when after 1 s -> Stuck {}
    }
    final state Stuck;
}";
    let (texts, faults) = line_of(text);
    let model = model(&texts.project(), &Asked::with(faults)).expect("a line that can be searched").model;
    let outcome = explore(&model, &Bounds { states: 40, violations: 100, ..BOUNDS }, &mut |_| true);
    assert_eq!(
        verdict(&outcome),
        (End::Complete, vec!["MachineStops { instance: 0, fault: 1 }".to_string()])
    );
    assert_eq!(outcome.orders, Decided::NotReached);
    let (_, execution) = &outcome.violations[0];
    assert_eq!(execution.scans.len(), 6);
}
