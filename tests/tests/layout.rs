//! The examples of `docs/layout.md` are right.

use autogen_tests::{Texts, plain, side_by_side, text};

/// Line, what stands behind the backquotes, and text of each block of a document.
fn blocks(document: &str) -> Vec<(usize, String, String)> {
    let mut found: Vec<(usize, String, String)> = Vec::new();
    let mut inside = false;
    for (number, line) in document.lines().enumerate() {
        match line.strip_prefix("```") {
            Some(kind) => {
                inside = !inside;
                if inside {
                    found.push((number + 1, kind.into(), String::new()));
                }
            }
            None if inside => {
                if let Some((_, _, text)) = found.last_mut() {
                    *text += line;
                    *text += "\n";
                }
            }
            None => {}
        }
    }
    found
}

/// A block `json` is a whole layout or a whole scenario, `json stationary` and `json may_touch` an object of
/// these lists, `json operator` a scenario for a desk,
/// `json tending` one for that example.
/// Objects and scenarios are tried in the first layout, with the types of the document.
#[test]
fn examples_are_right() {
    const STATIONARY: &str = "\"stationary\": [";
    const DESK: &str = r#"{"robots": [{"name": "desk", "type": "desk", "pose": [0, 0, 0]}]}"#;
    let document = text("docs/layout.md");
    let blocks = blocks(&document);
    let specs: Vec<String> =
        blocks.iter().filter(|(_, kind, _)| kind == "aut").map(|(_, _, text)| text.clone()).collect();
    let (_, _, frame) = blocks
        .iter()
        .find(|(_, kind, text)| kind == "json" && text.contains("\"robots\""))
        .expect("the document has a layout");
    let tending = side_by_side("tending/tending");
    let mut cases = 0;
    for (line, kind, text) in &blocks {
        let (layout, scenario) = match kind.as_str() {
            "json" if text.contains("\"kinds\"") => (frame.clone(), Some(text.clone())),
            "json" => (text.clone(), None),
            "json tending" => (tending.layout.clone(), Some(text.clone())),
            "json operator" => (DESK.into(), Some(text.clone())),
            "json stationary" => {
                (frame.replacen(STATIONARY, &format!("{STATIONARY}\n{},", text.trim_end()), 1), None)
            }
            "json may_touch" => {
                let before = frame.trim_end().strip_suffix("\n}").expect("the end of the layout");
                (format!("{before},\n  \"may_touch\": [{text}]\n}}"), None)
            }
            "aut" => continue,
            _ => panic!("line {line}: what is a block `{kind}`?"),
        };
        cases += 1;
        let specs = if kind == "json tending" { &tending.specs } else { &specs };
        let outcome = Texts { layout, specs: specs.clone(), scenario, ..Texts::default() }.compile();
        let is_right = outcome.diagnostics.is_empty() && outcome.project.is_some();
        assert!(is_right, "docs/layout.md:{line}\n{}", plain(&outcome.sources, &outcome.diagnostics));
    }
    assert!(cases >= 5, "{cases} cases");
}

#[test]
fn the_built_in_scenario_is_shown() {
    let document = text("docs/layout.md");
    let shown = blocks(&document).into_iter().any(|(_, _, text)| text == autogen::scenario::DEFAULT);
    assert!(shown, "docs/layout.md shows another scenario than the built-in one");
}
