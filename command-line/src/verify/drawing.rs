//! A counterexample as a page: the run that shows it, or else its steps.

use super::report::Shown;
use crate::results::results;
use autogen::backend::report::{self, story};
use autogen::executor::Executor;
use autogen::lower::Project;
use autogen::verify::replay::Replay;
use autogen::verify::story::Teller;
use runtime_sim::run::{Stepping, record};
use serde_json::json;

pub fn page(project: &Project, teller: &Teller, shown: &Shown) -> Result<String, String> {
    let (replay, seconds) = match &shown.replay {
        Ok(replay @ Replay { result: Ok(seconds), .. }) => (replay, seconds),
        Ok(Replay { result: Err(why), report, .. }) => {
            let reason = teller.reason(report);
            let simulator = format!("In the simulator, {why}, and the run ends: {reason}");
            return Ok(story::html(project, teller, shown.violation, shown.execution, &simulator));
        }
        Err(why) => {
            let simulator = format!("There is no run in the simulator: {why}");
            return Ok(story::html(project, teller, shown.violation, shown.execution, &simulator));
        }
    };
    let mut executor = Executor::new(&project.system);
    let watched = report::watched(&project.system);
    let recorded = record(&replay.line, &mut executor, Stepping::Events, &watched, &mut |_| {})?;
    let mut results = results(&recorded.report, project, teller.sources)?;
    results["violation"] = json!({ "at_s": seconds, "text": teller.title(shown.violation) });
    Ok(report::html(project, teller.sources, &replay.line, &recorded, &results))
}
