//! A counterexample as a page: the run that shows it, or else its steps.

use super::report::Shown;
use crate::results::results;
use autogen::backend::report::{self, story};
use autogen::executor::Executor;
use autogen::lower::Project;
use autogen::verify::story::Teller;
use runtime_sim::run::{Stepping, record};
use serde_json::json;

pub fn page(project: &Project, teller: &Teller, shown: &Shown) -> Result<String, String> {
    let steps = |simulator: &str| story::html(project, teller, shown.violation, shown.execution, simulator);
    let replay = match &shown.replay {
        Ok(replay) => replay,
        Err(why) => return Ok(steps(&format!("There is no run in the simulator: {why}"))),
    };
    let reason = teller.reason(&replay.report);
    let seconds = match &replay.result {
        Ok(seconds) => seconds,
        Err(why) => return Ok(steps(&format!("In the simulator, {why}, and the run ends: {reason}"))),
    };
    if teller.occurs(shown.violation, &replay.report) == Some(false) {
        return Ok(steps(&format!(
            "In the simulator, the same transitions have fired by {seconds:.2} s, but the violation does not occur, and the run ends: {reason}"
        )));
    }
    let mut executor = Executor::new(&project.system);
    let watched = report::watched(&project.system, &replay.line);
    let recorded = record(&replay.line, &mut executor, Stepping::Events, &watched, &mut |_| {})?;
    let mut results = results(&recorded.report, project, teller.sources)?;
    results["violation"] = json!({ "at_s": seconds, "text": teller.title(shown.violation) });
    Ok(report::html(project, teller.sources, &replay.line, &recorded, &results))
}
