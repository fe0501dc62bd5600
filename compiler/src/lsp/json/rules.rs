//! What a schema says of one value of a file. It knows the words that the schemas of autogen use.

use super::tree::{Node, Step};
use serde_json::{Map, Value};

/// All that the schema says of the value at a place. `around` are the values on the way there.
pub fn at<'s>(schema: &'s Value, path: &[Step], around: &[&Node]) -> Vec<&'s Value> {
    let mut rules = all(schema, around.first().copied());
    for (number, step) in path.iter().enumerate() {
        let node = around.get(number + 1).copied();
        rules = rules.iter().filter_map(|rule| below(rule, step)).flat_map(|rule| all(rule, node)).collect();
    }
    rules
}

/// A schema and those that it joins, as far as they hold for this value.
fn all<'s>(schema: &'s Value, node: Option<&Node>) -> Vec<&'s Value> {
    let joined = ["allOf", "anyOf"].into_iter().filter_map(|word| schema[word].as_array()).flatten();
    let mut found = vec![schema];
    found.extend(joined.flat_map(|schema| all(schema, node)));
    if schema.get("if").is_some_and(|condition| holds(condition, node)) {
        found.extend(all(&schema["then"], node));
    }
    found
}

/// The conditions of the schemas name one of several texts for keys.
fn holds(condition: &Value, node: Option<&Node>) -> bool {
    let properties = condition["properties"].as_object().into_iter().flatten();
    properties.into_iter().all(|(key, rule)| {
        let given = node.and_then(|node| node.get(key)?.text());
        let known = rule["enum"].as_array().into_iter().flatten().filter_map(Value::as_str);
        given.is_some_and(|given| known.into_iter().any(|known| known == given))
    })
}

fn below<'s>(rule: &'s Value, step: &Step) -> Option<&'s Value> {
    match step {
        Step::Key(key) => {
            let own = rule["properties"].get(key);
            own.or_else(|| rule.get("additionalProperties").filter(|others| others.is_object()))
        }
        Step::Index(number) => match &rule["items"] {
            Value::Array(each) => each.get(*number),
            Value::Null => None,
            every => Some(every),
        },
    }
}

/// Keys with their schemas.
pub fn keys<'s>(rules: &[&'s Value]) -> Vec<(&'s str, &'s Value)> {
    let properties = rules.iter().filter_map(|rule| rule["properties"].as_object());
    properties.flat_map(Map::iter).map(|(key, rule)| (key.as_str(), rule)).collect()
}

/// Whether an object that has these keys may have this one too.
pub fn may_have(rules: &[&Value], key: &str, present: &[&str]) -> bool {
    let excluded = rules.iter().filter_map(|rule| rule["not"]["required"].as_array());
    let mut excluded = excluded.filter(|keys| keys.iter().any(|k| k == key));
    !excluded.any(|keys| keys.iter().any(|k| k != key && present.iter().any(|present| k == present)))
}

pub fn is_needed(rules: &[&Value], key: &str) -> bool {
    rules.iter().filter_map(|rule| rule["required"].as_array()).flatten().any(|needed| needed == key)
}

/// The values that are listed.
pub fn values(rules: &[&Value]) -> Vec<Value> {
    let of_rule = |rule: &&Value| {
        let listed = rule["enum"].as_array().cloned().unwrap_or_default();
        let truth = if rule["type"] == "boolean" { vec![true.into(), false.into()] } else { Vec::new() };
        listed.into_iter().chain(rule.get("const").cloned()).chain(truth).collect::<Vec<_>>()
    };
    rules.iter().flat_map(of_rule).collect()
}
