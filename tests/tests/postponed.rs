//! A search that postpones answers nobody needs yet, against one that does not.

use autogen::verify::{Asked, model};
use autogen_search::explore::{Bounds, End, Outcome, explore};
use autogen_search::model::{Model, Reductions, Variable};
use autogen_search::plant::{Faults, status};
use autogen_search::unread::Unread;
use autogen_tests::bounds::BOUNDS;
use autogen_tests::mutants::mutants;
use autogen_tests::outcome::{states_of, verdict};
use autogen_tests::small_lines::{self, Line};
use autogen_tests::{Texts, ariac, fixtures, is_full_campaign, on_all_processors};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

const ONE_PART: &str = r#"{
    "kinds": [{"name": "battery", "height": 0.053}],
    "orders": [{"station": "as1", "parts": {"battery": 1}}]
}"#;

/// Lines with more states are not compared.
const STATES: usize = 20_000;

fn search(model: &Model, reductions: Reductions) -> Outcome {
    let model = Model { reductions, unread: Unread::default(), ..model.clone() };
    explore(&model, &Bounds { states: STATES, violations: 100, ..BOUNDS }, &mut |_| true)
}

/// The values of other machines, and those of each vehicle.
type Halves = (Vec<[u64; 3]>, Vec<Vec<[u64; 3]>>);

/// Of the values of others all that vehicles have beside them.
type All = BTreeMap<Vec<[u64; 3]>, BTreeSet<Vec<Vec<[u64; 3]>>>>;

/// All states, in halves.
fn halves(model: &Model, outcome: &Outcome) -> All {
    let owner = |variable: &Variable| usize::from(model.owners[variable.var.at as usize]);
    let vehicles: Vec<usize> =
        (0..model.machines.len()).filter(|number| model.machines[*number].route.is_some()).collect();
    let half = |state: &[[u64; 3]]| -> Halves {
        let of = |is_kept: &dyn Fn(usize) -> bool| {
            let all = model.variables.iter().zip(state).filter(|(variable, _)| is_kept(owner(variable)));
            all.map(|(_, value)| *value).collect()
        };
        let of_others = of(&|owner| !vehicles.contains(&owner));
        (of_others, vehicles.iter().map(|vehicle| of(&|owner| owner == *vehicle)).collect())
    };
    let mut all = All::new();
    for (others, vehicles) in states_of(model, outcome, |_| true).iter().map(|state| half(state)) {
        all.entry(others).or_default().insert(vehicles);
    }
    all
}

/// For each of a vehicle's values whether its command is under way.
fn is_under_way(model: &Model) -> impl Fn(&[[u64; 3]]) -> bool {
    let vehicle = model.machines.iter().position(|machine| machine.route.is_some()).unwrap_or_default();
    let own = model.variables.iter().filter(move |v| usize::from(model.owners[v.var.at as usize]) == vehicle);
    let status = model.machines[vehicle].head.as_ref().map(|head| head.status);
    let at = own.map(|variable| variable.var).position(|var| Some(var) == status).unwrap_or_default();
    move |values| values[at][0] == status::UNDER_WAY as u64
}

/// They find the same; and for each state of one there is the same of the other, but that commands of vehicles that have
/// ended may be under way. How many states fewer one has; none if it is not compared.
fn compare(name: &str, texts: &Texts, faults: Faults) -> Option<usize> {
    let model = model(&texts.compile().project?, &Asked::with(faults)).ok()?.model;
    let more = search(&model, Reductions::OfScans);
    if more.end == End::TooManyStates {
        return None;
    }
    let less = search(&model, Reductions::All);
    assert_eq!(verdict(&less), verdict(&more), "{name}");
    assert_eq!(more.end, End::Complete, "{name}");
    let is_under_way = is_under_way(&model);
    let counts_for = |less: &[Vec<[u64; 3]>], more: &[Vec<[u64; 3]>]| {
        less.iter().zip(more).all(|(less, more)| less == more || is_under_way(less) && !is_under_way(more))
    };
    let (of_less, of_more) = (halves(&model, &less), halves(&model, &more));
    for (others, vehicles) in &of_more {
        let found = of_less.get(others).unwrap_or_else(|| panic!("{name}: a state of the others is missing"));
        let missing = vehicles.iter().find(|more| !found.iter().any(|less| counts_for(less, more)));
        assert_eq!(missing, None, "{name}: for this state no other one counts");
    }
    let is_real = |(others, vehicles): (&Vec<[u64; 3]>, &BTreeSet<_>)| {
        of_more.get(others).is_some_and(|more| vehicles.is_subset(more))
    };
    assert!(of_less.iter().all(is_real), "{name}: a state that cannot be reached");
    println!("{name}: {} of {} states", less.covered.states, more.covered.states);
    Some(more.covered.states - less.covered.states)
}

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
        .replace(local, &format!("    local is_early: bool := false;\n{local}"))
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
