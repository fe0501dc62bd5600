//! What happens on trays, beside them and beyond them: each file of the folder says what it is about, and what it expects.
//!
//! `expect` has how the reason of the end begins; if wanted, what bears items at the end (`on`), where along x
//! they are (`at`), which of them have left the line (`gone`), part of a note, and how often each pair came into contact.

use autogen_tests::{Texts, stepped, text};
use serde_json::Value;
use std::fs;
use std::path::Path;

#[test]
fn each_file_ends_as_it_says() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/trays");
    let files = fs::read_dir(folder).expect("the fixtures").map(|entry| entry.expect("a file").path());
    let mut files: Vec<_> = files.filter(|path| path.extension().is_some_and(|end| end == "json")).collect();
    files.sort();
    assert!(files.len() >= 10, "{files:?}");
    let wrong: Vec<String> = files.iter().filter_map(|file| wrong(file)).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// What is not as a file says.
fn wrong(file: &Path) -> Option<String> {
    let case: Value = serde_json::from_str(&fs::read_to_string(file).expect("a text")).expect("JSON");
    let texts = Texts {
        layout: case["layout"].to_string(),
        specs: vec![text("tests/fixtures/trays/devices.aut")],
        scenario: Some(case["scenario"].to_string()),
        ..Texts::default()
    };
    let report = stepped::report(&texts, |_| {});
    let expect = case["expect"].as_object().expect("what is expected");
    let mut found = Vec::new();
    for (key, value) in expect {
        let as_expected = match (&key[..], value) {
            ("reason", Value::String(reason)) => report.reason.starts_with(reason),
            ("note", Value::String(note)) => report.notes.iter().any(|other| other.contains(note)),
            ("on", Value::Object(on)) => on.iter().all(|(name, carrier)| {
                report.items.iter().any(|item| item.name == *name && item.carrier == *carrier)
            }),
            ("at", Value::Object(at)) => at.iter().all(|(name, x)| {
                let place = report.items.iter().find(|item| item.name == *name).map(|item| &item.place);
                place.is_some_and(|place| place.contains(&format!("({:.3},", x.as_f64().unwrap_or(f64::NAN))))
            }),
            ("gone", Value::Array(gone)) => {
                report.items.iter().all(|item| !gone.contains(&Value::from(item.name.clone())))
            }
            ("contacts", Value::Array(counts)) => report
                .collisions
                .iter()
                .map(|contact| u64::from(contact.count))
                .eq(counts.iter().filter_map(Value::as_u64)),
            _ => panic!("{}: {key} is no expectation", file.display()),
        };
        if !as_expected {
            found.push(format!("{key}: not {value}"));
        }
    }
    let items: Vec<_> = report
        .items
        .iter()
        .map(|item| format!("{} on {} at {}", item.name, item.carrier, item.place))
        .collect();
    let counts: Vec<u32> = report.collisions.iter().map(|contact| contact.count).collect();
    let is = format!("{}; {:?}; {counts:?}; {}", report.reason, report.notes, items.join(", "));
    (!found.is_empty()).then(|| format!("{}: {}: {is}", file.display(), found.join(", ")))
}
