//! Mistakes in types of the library, each a file of `fixtures/verify/mistakes`: what a search with one answer in a scan finds
/// in a small line, as a violation or as something hardly meant.
use autogen::verify::{Asked, model};
use autogen_search::explore::{Bounds, End, explore};
use autogen_tests::{bounds, fixtures, small_lines};
use serde_json::Value;

const BOUNDS: Bounds = Bounds { answers: Some(1), ..bounds::BOUNDS };

/// Names of what is found.
fn found(mistake: &Value) -> Vec<String> {
    let text = |key: &str| mistake[key].as_str().unwrap_or_else(|| panic!("no text `{key}`"));
    let lines = small_lines::all();
    let line = lines.iter().find(|line| line.name == text("line")).expect("the name of a line");
    let original = line.text_of(text("type"));
    assert!(original.contains(text("from")), "{}", text("from"));
    let texts = line.with(text("type"), &original.replace(text("from"), text("to")));
    let project = texts.project();
    let model = model(&project, &Asked::with(line.faults)).expect("a line that can be searched").model;
    let outcome = explore(&model, &BOUNDS, &mut |_| true);
    assert!(matches!(outcome.end, End::Complete | End::Violated), "{:?}", outcome.end);
    let all = outcome.violations.iter().chain(&outcome.remarks).map(|(found, _)| format!("{found:?}"));
    all.map(|found| found.split(' ').next().unwrap_or_default().to_string()).collect()
}

#[test]
fn mistakes_are_found() {
    let mut wrong = Vec::new();
    for (name, text) in fixtures("verify/mistakes", "json") {
        let mistake: Value = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{name}: {e}"));
        let found = found(&mistake);
        let is_right = match mistake["found"].as_str() {
            Some(expected) => found.iter().any(|found| found == expected),
            None => found.is_empty(),
        };
        if !is_right {
            wrong.push(format!("{name}: {found:?} instead of {}", mistake["found"]));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
