//! The JSON Schemas and the readers, held together: the same keys in every place, what is right is valid, and what
//! has a wrong key, type, length or number is not.

use autogen::check::check;
use autogen::diagnostic::Diagnostic;
use autogen::schema;
use autogen::source::{FileId, Sources};
use autogen::spec::parser;
use autogen::{library, scenario};
use autogen_tests::{Texts, examples, json_schema, root, text};
use serde_json::{Map, Value, json};
use std::collections::BTreeSet;

/// The schema of layouts with the types of the library and these.
fn layouts(specs: &[String]) -> Value {
    let mut sources = Sources::default();
    let own = specs.iter().map(|text| ("own.aut", text.as_str()));
    let texts: Vec<(&str, &str)> = library::FILES.iter().copied().chain(own).collect();
    let files: Vec<FileId> = texts.iter().map(|(name, text)| sources.add(*name, *text)).collect();
    let trees: Vec<_> =
        files.into_iter().map(|file| (file, parser::parse(file, &sources.file(file).text).0)).collect();
    let kinds = ["battery", "sensor", "regulator", "pump"].map(String::from);
    let checked = check(&sources, &trees, Some(&kinds)).unwrap_or_else(|found| panic!("{found:#?}"));
    schema::layout(checked.model(), false)
}

fn errors(schema: &Value, text: &str) -> Vec<String> {
    json_schema::errors(schema, &serde_json::from_str(text).expect("JSON"))
}

#[test]
fn examples_are_valid() {
    let of_scenarios = schema::scenario();
    let mut count = 0;
    for (name, Texts { layout, specs, scenario, .. }) in examples() {
        let found = errors(&layouts(&specs), &layout);
        assert!(found.is_empty(), "{name}: {found:#?}");
        let found = errors(&of_scenarios, scenario.as_deref().unwrap_or(scenario::DEFAULT));
        assert!(found.is_empty(), "{name}: {found:#?}");
        count += 1;
    }
    assert!(count > 20, "{count}");
}

/// Codes of what a schema can say: types, keys, lengths, bounds.
const SHAPES: [&str; 5] = ["E0110", "E0111", "E0112", "E0113", "E0114"];

/// Fixtures of a folder that are JSON, with the codes that are expected of them.
fn fixtures(folder: &str) -> Vec<(String, String, Vec<String>)> {
    let entries = std::fs::read_dir(root().join("tests/fixtures").join(folder)).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let read = paths.filter_map(|path| {
        let text = std::fs::read_to_string(&path).ok()?;
        let (input, expected) = text.split_once("--- expect\n")?;
        serde_json::from_str::<Value>(input).ok()?;
        let codes = expected.lines().filter_map(|line| line.split(' ').next());
        let codes = codes.filter(|code| !code.is_empty()).map(String::from).collect();
        Some((path.display().to_string(), input.to_string(), codes))
    });
    read.collect()
}

#[test]
fn fixtures_are_valid_if_their_reader_takes_them() {
    for (folder, schema) in [("layout", layouts(&[])), ("scenario", schema::scenario())] {
        let (mut valid, mut refused) = (0, 0);
        for (name, input, codes) in fixtures(folder) {
            let errors = errors(&schema, &input);
            if codes.is_empty() {
                assert!(errors.is_empty(), "{name}: {errors:#?}");
                valid += 1;
            }
            if codes.iter().any(|code| SHAPES.contains(&code.as_str())) {
                assert!(!errors.is_empty(), "{name}: {codes:?}");
                refused += 1;
            }
        }
        println!("{folder}: {valid} valid, {refused} refused");
        assert!(valid >= 1 && refused >= 3, "{folder}: {valid}, {refused}");
    }
}

/// All objects of a schema that take no other keys: an instance with an unknown key in that place, and the keys.
fn places(schema: &Value, around: &dyn Fn(Value) -> Value, found: &mut Vec<(Value, BTreeSet<String>)>) {
    for option in schema["anyOf"].as_array().into_iter().flatten() {
        places(option, around, found);
    }
    if let Some(items) = schema.get("items").filter(|items| items.is_object()) {
        places(items, &|inner| around(json!([inner])), found);
    }
    if let Some(value) = schema.get("additionalProperties").filter(|value| value.is_object()) {
        places(value, &|inner| around(json!({ "x": inner })), found);
    }
    let Some(properties) = schema["properties"].as_object() else { return };
    if schema["additionalProperties"] == false {
        let keys = properties.keys().filter(|key| *key != "$schema").cloned().collect();
        found.push((around(json!({ "?": 0 })), keys));
    }
    for (key, value) in properties {
        let key = key.clone();
        places(value, &|inner| around(Value::Object(Map::from_iter([(key.clone(), inner)]))), found);
    }
}

/// The keys that a reader names when it meets an unknown one.
fn known(diagnostics: &[Diagnostic]) -> BTreeSet<String> {
    let notes = diagnostics
        .iter()
        .filter(|d| d.code == "E0111" && d.message.contains("\"?\""))
        .flat_map(|d| &d.notes);
    let lists = notes.filter_map(|note| Some(note.strip_prefix("known keys: ")?.replace(" and ", ", ")));
    lists.flat_map(|list| list.split(", ").map(String::from).collect::<Vec<_>>()).collect()
}

#[test]
fn keys_are_those_of_the_readers() {
    let mut found = Vec::new();
    places(&schema::scenario(), &|inner| inner, &mut found);
    assert!(found.len() > 8, "{}", found.len());
    for (mut instance, keys) in found {
        if instance.get("kinds").is_none() && instance.get("?").is_none() {
            instance["kinds"] = json!([{ "name": "x", "height": 0.1 }]);
        }
        let mut sources = Sources::default();
        let file = sources.add("a.json", instance.to_string());
        let diagnostics = scenario::parse(&sources, file).1;
        assert_eq!(known(&diagnostics), keys, "{instance}: {diagnostics:#?}");
    }
    let schema = layouts(&[]);
    let mut found = Vec::new();
    let mut plain = schema.clone();
    for list in ["robots", "stationary"] {
        plain["properties"][list]["items"]["properties"]["parameters"] = json!({});
    }
    places(&plain, &|inner| inner, &mut found);
    for list in ["robots", "stationary"] {
        for kind in schema["properties"][list]["items"]["allOf"].as_array().expect("types") {
            let keys = kind["then"]["propertyNames"]["enum"].as_array().expect("keys").iter();
            let keys = keys.filter_map(Value::as_str).map(String::from).collect();
            let name = &kind["if"]["properties"]["type"]["enum"][0];
            let object = json!([{ "?": 0, "name": "a", "type": name, "pose": [0, 0, 0] }]);
            let mut instance = json!({ "robots": [] });
            instance[list] = object;
            found.push((instance, keys));
        }
    }
    assert!(found.len() > 10, "{}", found.len());
    for (instance, keys) in found {
        let diagnostics = Texts::of_layout(instance.to_string()).compile().diagnostics;
        assert_eq!(known(&diagnostics), keys, "{instance}: {diagnostics:#?}");
    }
}

/// Parameters of a type are refused by the schema as they are by the compiler.
#[test]
fn parameters_are_those_of_the_types() {
    let schema = layouts(&[]);
    let layout = text("examples/ariac2021/default.json");
    let with = |parameters: &str| {
        layout.replacen(r#""name": "agv2","#, &format!(r#""name": "agv2", "parameters": {parameters},"#), 1)
    };
    for (parameters, is_right) in [
        (r#"{"capacity": 4}"#, true),
        (r#"{"capacity": 13}"#, false),
        (r#"{"capacity": 2.5}"#, false),
        (r#"{"speed": 1}"#, false),
    ] {
        let text = with(parameters);
        assert_ne!(text, layout);
        assert_eq!(errors(&schema, &text).is_empty(), is_right, "{parameters}");
        assert_eq!(Texts::of_layout(text).compile().diagnostics.is_empty(), is_right, "{parameters}");
    }
}

#[test]
fn a_file_may_name_its_schema() {
    let layout =
        text("examples/ariac2021/default.json").replacen('{', r#"{ "$schema": "layout.schema.json","#, 1);
    let scenario = scenario::DEFAULT.replacen('{', r#"{ "$schema": "scenario.schema.json","#, 1);
    assert!(errors(&layouts(&[]), &layout).is_empty());
    assert!(errors(&schema::scenario(), &scenario).is_empty());
    let texts = Texts { scenario: Some(scenario), ..Texts::of_layout(layout.clone()) };
    assert!(texts.compile().diagnostics.is_empty());
    let wrong = Texts::of_layout(layout.replace(r#""layout.schema.json""#, "1"));
    let codes: Vec<&str> = wrong.compile().diagnostics.iter().map(|d| d.code).collect();
    assert_eq!(codes, ["E0110"]);
}
