//! A counterexample that the simulator does not show: the page of its steps.

use super::super::plan;
use crate::lower::Project;
use crate::verify::gantt;
use crate::verify::story::Teller;
use askama::Template;
use autogen_search::story::Execution;
use autogen_search::violation::Violation;

#[derive(Template)]
#[template(path = "report/story.html", escape = "html")]
struct Page<'a> {
    name: &'a str,
    violation: &'a str,
    simulator: &'a str,
    gantt: &'a str,
    plan: &'a str,
    story: &'a str,
    situation: &'a [String],
    without_contract: Option<String>,
}

/// `simulator` is what that did instead.
pub fn html(
    project: &Project,
    teller: &Teller,
    violation: &Violation,
    execution: &Execution,
    simulator: &str,
) -> String {
    let page = Page {
        name: &project.name,
        violation: &teller.title(violation),
        simulator,
        gantt: &gantt::svg(project, execution),
        plan: &plan::svg(&project.plant, &project.edges),
        story: &teller.tell(execution),
        situation: &teller.situation(execution),
        without_contract: teller.told_without_contract(execution),
    };
    // Writing to memory does not fail.
    page.render().unwrap_or_default()
}
