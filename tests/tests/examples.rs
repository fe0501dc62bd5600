//! Snapshots of what is generated for the examples.

use autogen::backend::{dot, rust};
use autogen_tests::{Texts, text};

fn texts(example: &str) -> Texts {
    let specs = match example {
        "buffer/buffer" => vec![text("examples/buffer/specs/buffer.aut")],
        _ => Vec::new(),
    };
    Texts { layout: text(&format!("examples/{example}.json")), specs, ..Texts::default() }
}

/// Each generated file under its name.
fn generated(example: &str) -> Vec<(String, String)> {
    let outcome = texts(example).compile();
    let project = outcome.project.expect("the example is right");
    let mut files: Vec<(String, String)> = rust::files(&project.system, &outcome.sources)
        .into_iter()
        .filter(|(name, _)| {
            name.starts_with("controllers/src/") && !name.ends_with("types.rs")
                || name == "adapters/src/layout.rs"
        })
        .collect();
    files.push(("parameters.txt".into(), rust::parameters_text(&project.system)));
    files.extend(dot::files(&project));
    files
}

fn shown(files: &[(String, String)], wanted: impl Fn(&str) -> bool) -> String {
    files.iter().filter(|(name, _)| wanted(name)).map(|(name, text)| format!("=== {name}\n{text}")).collect()
}

#[test]
fn all_code_of_the_default_line() {
    for (name, text) in generated("ariac2021/default") {
        insta::assert_snapshot!(format!("default-{}", name.replace('/', "-")), text);
    }
}

#[test]
fn what_the_other_examples_add() {
    let default = generated("ariac2021/default");
    for example in ["ariac2021/spaced", "ariac2021/less_agv", "buffer/buffer", "shared_agv/shared_agv"] {
        let files = generated(example);
        let is_new = |name: &str| {
            !default.iter().any(|(n, text)| n == name && files.iter().any(|(m, t)| m == name && t == text))
        };
        insta::assert_snapshot!(example.replace('/', "-"), shown(&files, is_new));
    }
}
