//! Results of a run: its report, with what the text and the layout say about it.

use super::{contact, fault};
use autogen::lower::Project;
use autogen::source::Sources;
use runtime_sim::report::Report;
use serde_json::Value;

/// The report as JSON, with faults, alarms and allowed contacts explained. An error is a bug.
pub fn results(report: &Report, project: &Project, sources: &Sources) -> Result<Value, String> {
    let mut results =
        serde_json::from_str(&report.to_json()).map_err(|e| format!("the report is not JSON: {e}"))?;
    fault::name(&mut results, report, &project.system, sources);
    contact::name_reasons(&mut results, &project.may_touch);
    Ok(results)
}
