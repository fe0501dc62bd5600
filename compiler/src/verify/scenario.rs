//! A scenario of the simulator as a file.

mod faults;
mod operator;

use crate::ir::System;
use faults::Faults;
use runtime_sim::line::{Collected, Deck, During, Goal, Kind, Line, Order, Scenario, Supply};
use serde_json::{Map, Value, json};

/// The scenario of a line, as `commission` reads it: the line has the same scenario again. Orders without end cannot be
/// said beside a list of what belts bring, so it must not have such orders.
pub fn text(system: &System, line: &Line) -> String {
    // Each part is named: none is forgotten. How long a run may stand still follows from what is asked.
    let Scenario {
        goal,
        orders,
        supply,
        spawn_first_s,
        spawn_every_s,
        time_limit_s,
        stall_limit_s: _,
        start_scan: _,
        slips,
        refusals,
        answers,
        pauses,
        power_offs,
        sensors,
        jams,
        slow,
        operations,
        presses,
        removals,
        seed,
    } = &line.scenario;
    let faults = Faults { slips, refusals, answers, pauses, power_offs, sensors, jams, slow };
    let kinds: Vec<Value> = line.kinds.iter().map(kind).collect();
    let mut scenario = json!({ "kinds": kinds });
    match goal {
        Goal::AllOrders => scenario["orders"] = orders.iter().map(|it| order(line, it)).collect(),
        Goal::Collected(sinks) => scenario["goal"] = sinks.iter().map(|it| collected(line, it)).collect(),
        Goal::TimeLimit => {}
    }
    let items: Map<String, Value> = supply.iter().map(|it| supplied(line, it)).collect();
    scenario["supply"] =
        json!({"first_s": spawn_first_s, "every_s": spawn_every_s, "seed": seed, "items": items});
    scenario["time_limit_s"] = json!(time_limit_s);
    scenario["faults"] = faults.json(system, line);
    scenario["operator"] = operator::json(line, operations, presses, removals);
    format!("{scenario:#}\n")
}

fn kind(kind: &Kind) -> Value {
    let Kind { name, height, grasp, size, is, mass, deck } = kind;
    let mut value = json!({"name": name, "height": height, "size": size, "is": is, "mass": mass});
    if grasp != height {
        value["grasp"] = json!(grasp);
    }
    if let Some(Deck { height, size }) = deck {
        value["bears"] = json!({"height": height, "size": size});
    }
    value
}

fn order(line: &Line, Order { stations, parts }: &Order) -> Value {
    let stations: Vec<&str> = stations.iter().map(|station| name(line, *station)).collect();
    json!({"station": stations, "parts": counted(line, parts)})
}

fn collected(line: &Line, Collected { machine, part, items }: &Collected) -> (String, Value) {
    let sink = format!("{}.{}", name(line, *machine), part_name(line, *machine, *part));
    (sink, counted(line, items))
}

fn supplied(line: &Line, Supply { belt, items }: &Supply) -> (String, Value) {
    let items = items.iter().map(|item| line.kinds[*item].name.as_str()).collect();
    (name(line, *belt).into(), items)
}

/// Numbers of each kind, but for those of which there is none.
fn counted(line: &Line, numbers: &[u32]) -> Value {
    let kinds = line.kinds.iter().zip(numbers).filter(|(_, number)| **number > 0);
    kinds.map(|(kind, number)| (kind.name.as_str(), json!(number))).collect()
}

fn name(line: &Line, machine: usize) -> &str {
    &line.machines[machine].name
}

fn part_name(line: &Line, machine: usize, part: usize) -> &str {
    &line.machines[machine].parts[part].name
}

/// Seconds from the start of a run, or of a part of it.
fn seconds(line: &Line, scans: u64) -> f64 {
    scans as f64 * f64::from(line.scan_ms) / 1000.0
}

/// When something begins, and for how long it lasts if it ends.
fn lasts(line: &Line, During { at_scan, scans }: &During, what: &mut Value) {
    what["at_s"] = json!(seconds(line, *at_scan));
    if let Some(scans) = scans {
        what["for_s"] = json!(seconds(line, *scans));
    }
}
