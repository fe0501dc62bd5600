//! A scenario of the simulator as a file.

use runtime_sim::line::Line;
use serde_json::{Map, Value, json};

/// The scenario of a line, as `commission` reads it.
pub fn text(line: &Line) -> String {
    let name = |machine: usize| line.machines[machine].name.as_str();
    let kind = |kind: usize| line.kinds[kind].name.as_str();
    let kinds: Vec<Value> = (line.kinds.iter())
        .map(|k| {
            let mut value =
                json!({"name": k.name, "height": k.height, "size": k.size, "is": k.is, "mass": k.mass});
            if k.grasp != k.height {
                value["grasp"] = json!(k.grasp);
            }
            value
        })
        .collect();
    let orders: Vec<Value> = (line.scenario.orders.iter())
        .map(|order| {
            let parts = order.parts.iter().enumerate().filter(|(_, count)| **count > 0);
            let parts: Map<String, Value> =
                parts.map(|(number, count)| (kind(number).to_string(), json!(count))).collect();
            let stations: Vec<&str> = order.stations.iter().map(|station| name(*station)).collect();
            json!({"station": stations, "parts": parts})
        })
        .collect();
    let items: Map<String, Value> = (line.scenario.supply.iter())
        .map(|supply| {
            let items: Vec<&str> = supply.items.iter().map(|item| kind(*item)).collect();
            (name(supply.belt).to_string(), json!(items))
        })
        .collect();
    let slips: Vec<Value> = (line.scenario.slips.iter())
        .map(|slip| json!({"robot": name(slip.machine), "pick": slip.pick, "after_s": slip.after_s}))
        .collect();
    let answers: Vec<Value> = (line.scenario.answers.iter())
        .map(|answer| {
            let mut value =
                json!({"robot": name(answer.machine), "command": answer.command, "late_s": answer.late_s});
            if let Some(error) = answer.error {
                value["error"] = json!(error);
            }
            value
        })
        .collect();
    let (first_s, every_s) = (line.scenario.spawn_first_s, line.scenario.spawn_every_s);
    let scenario = json!({
        "kinds": kinds,
        "orders": orders,
        "supply": {"first_s": first_s, "every_s": every_s, "items": items},
        "time_limit_s": line.scenario.time_limit_s,
        "faults": {"slips": slips, "answers": answers},
    });
    format!("{scenario:#}\n")
}
