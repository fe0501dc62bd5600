//! Faults and alarms of a run, by what and where they are in the text.

use autogen::fault::{place, reason, site};
use autogen::ir::{Severity, System};
use autogen::source::Sources;
use serde_json::{Value, json};

/// Adds to the fault and to the alarms of a report what and where they are in the text: the simulator knows their
/// numbers only.
pub fn name(report: &mut Value, system: &System, sources: &Sources) {
    name_alarms(report, system, sources);
    let Some(code) = report["fault"]["code"].as_u64() else { return };
    let Some(site) = site(system, code) else { return };
    let robot = report["fault"]["robot"].as_str().unwrap_or("").to_string();
    let state = report["robots"][&robot]["state"].as_str().unwrap_or("").to_string();
    report["reason"] = json!(reason(system, sources, code, &robot, &state));
    report["fault"]["text"] = json!(site.text);
    report["fault"]["place"] = json!(place(sources, site));
    report["fault"]["state"] = json!(state);
}

fn name_alarms(report: &mut Value, system: &System, sources: &Sources) {
    for alarm in report["alarms"].as_array_mut().into_iter().flatten() {
        let Some(site) = alarm["code"].as_u64().and_then(|code| site(system, code)) else { continue };
        alarm["text"] = json!(site.text);
        alarm["place"] = json!(place(sources, site));
        alarm["stops"] = json!(site.severity == Severity::Machine);
    }
    if report["finished"] == true {
        return;
    }
    let alarms = report["alarms"].as_array().into_iter().flatten();
    let stopping =
        alarms.filter(|a| a["stops"] == true && (a["active"] == true || a["acknowledged"] == false));
    let told = stopping.map(|alarm| {
        let text = |key: &str| alarm[key].as_str().unwrap_or("").to_string();
        format!(
            "; {} is stopped by alarm {}: {} ({})",
            text("robot"),
            alarm["code"],
            text("text"),
            text("place")
        )
    });
    let told: String = told.collect();
    if let Some(reason) = report["reason"].as_str().map(|reason| reason.to_string() + &told) {
        report["reason"] = json!(reason);
    }
}
