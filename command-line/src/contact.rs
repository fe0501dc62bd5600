//! The contacts of a report.

use autogen::layout::MayTouch;
use serde_json::{Value, json};

/// What came into contact, a line each.
pub fn text(report: &Value) -> String {
    let contacts = report["collisions"].as_array().map_or(&[][..], Vec::as_slice);
    let lines: Vec<String> = (contacts.iter())
        .map(|contact| {
            let word = |value: &Value| value.as_str().unwrap_or("").to_string();
            let [a, b] = [0, 1].map(|i| (word(&contact["pair"][i]), word(&contact["parts"][i])));
            let time = contact["time_s"].as_f64().unwrap_or(0.0);
            let whether = match contact["reason"].as_str() {
                Some(reason) => format!(", {} times, allowed: {reason}", contact["count"]),
                None => String::new(),
            };
            format!("{time:.3} s {} ({}) - {} ({}){whether}", a.0, a.1, b.0, b.1)
        })
        .collect();
    if lines.is_empty() { "none".into() } else { lines.join("\n                   ") }
}

/// Adds to each contact that the layout allows the reason that it gives.
pub fn name_reasons(report: &mut Value, may_touch: &[MayTouch]) {
    let Some(contacts) = report["collisions"].as_array_mut() else { return };
    for contact in contacts {
        let pair = [&contact["pair"][0], &contact["pair"][1]].map(|name| name.as_str().unwrap_or(""));
        let reason = may_touch.iter().find(|m| m.is_of(pair)).map(|m| m.reason.clone());
        if let Some(reason) = reason {
            contact["reason"] = json!(reason);
        }
    }
}
