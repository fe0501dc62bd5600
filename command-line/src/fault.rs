//! Faults and alarms of a run, by what and where they are in the text.

use autogen::fault::{place, reason_of_run, site};
use autogen::ir::{Severity, System};
use autogen::source::Sources;
use runtime_sim::report::Report;
use serde_json::{Value, json};

/// Adds to the faults and to the alarms of a report, as JSON, what and where they are in the text: the simulator knows
/// their numbers only.
pub fn name(results: &mut Value, report: &Report, system: &System, sources: &Sources) {
    results["reason"] = json!(reason_of_run(report, system, sources));
    for (alarm, of_report) in list(results, "alarms").zip(&report.alarms) {
        let Some(site) = site(system, of_report.code) else { continue };
        alarm["text"] = json!(site.text);
        alarm["place"] = json!(place(sources, site));
        alarm["stops"] = json!(site.severity == Severity::Machine);
    }
    for (fault, of_report) in list(results, "faults").zip(&report.faults) {
        let Some(site) = site(system, of_report.code) else { continue };
        fault["text"] = json!(site.text);
        fault["place"] = json!(place(sources, site));
    }
    if let Some((code, robot)) = &report.fault
        && let Some(site) = site(system, *code)
    {
        results["fault"]["text"] = json!(site.text);
        results["fault"]["place"] = json!(place(sources, site));
        results["fault"]["state"] = json!(report.state(robot));
    }
}

/// The elements of a list that may not be there.
fn list<'r>(results: &'r mut Value, key: &str) -> impl Iterator<Item = &'r mut Value> {
    results.get_mut(key).and_then(Value::as_array_mut).into_iter().flatten()
}
