//! Faults and alarms of a run, for people.

use serde_json::Value;

/// A line for each fault that did not end the run, and for each alarm that was raised; nothing if there is none.
pub fn text(report: &Value) -> String {
    faults_text(report) + &alarms_text(report)
}

fn faults_text(report: &Value) -> String {
    let faults = report["faults"].as_array().into_iter().flatten();
    let line = |fault: &Value| {
        let text = |key: &str| fault[key].as_str().unwrap_or("").to_string();
        let cleared = match fault["cleared_s"].as_f64() {
            Some(cleared_s) => format!("cleared at {cleared_s:.2} s"),
            None => "present at the end".into(),
        };
        format!(
            "fault              {} of {}, in state {}: {} (at {:.2} s, {cleared})\n",
            fault["code"],
            text("robot"),
            text("state"),
            text("text"),
            fault["at_s"].as_f64().unwrap_or(0.0)
        )
    };
    faults.map(line).collect()
}

fn alarms_text(report: &Value) -> String {
    let alarms = report["alarms"].as_array().into_iter().flatten();
    let line = |alarm: &Value| {
        let text = |key: &str| alarm[key].as_str().unwrap_or("").to_string();
        let times = match alarm["count"].as_u64() {
            Some(1) => format!("at {:.2} s", alarm["first_s"].as_f64().unwrap_or(0.0)),
            count => format!(
                "{} times, at {:.2} s first and {:.2} s last",
                count.unwrap_or(0),
                alarm["first_s"].as_f64().unwrap_or(0.0),
                alarm["last_s"].as_f64().unwrap_or(0.0)
            ),
        };
        let lasts = if alarm["active"] == true { ", active at the end" } else { "" };
        let stops = if alarm["stops"] == true { "; it stops the machine" } else { "" };
        format!(
            "alarm              {} of {}: {} ({times}{lasts}{stops})\n",
            alarm["code"],
            text("robot"),
            text("text")
        )
    };
    alarms.map(line).collect()
}
