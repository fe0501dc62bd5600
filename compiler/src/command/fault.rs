//! Faults of a run, by what and where they are in the text.

use autogen::ir::System;
use autogen::source::Sources;
use serde_json::{Value, json};

/// Adds to the fault of a report what and where it is in the text: the simulator knows its number only.
pub fn name(report: &mut Value, system: &System, sources: &Sources) {
    let Some(code) = report["fault"]["code"].as_u64().filter(|code| *code > 0) else { return };
    let Some(site) = system.model.faults.get(code as usize - 1) else { return };
    let place = format!("{}:{}", sources.file(site.place.file).name, sources.position(site.place).0);
    let robot = report["fault"]["robot"].as_str().unwrap_or("").to_string();
    let state = report["robots"][&robot]["state"].as_str().unwrap_or("").to_string();
    report["reason"] = json!(format!("fault {code} of {robot}, in state {state}: {} ({place})", site.text));
    report["fault"]["text"] = json!(site.text);
    report["fault"]["place"] = json!(place);
    report["fault"]["state"] = json!(state);
}
