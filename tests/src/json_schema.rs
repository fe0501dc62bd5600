//! A reader of JSON Schema, draft 7: the keywords that the schemas of autogen have, and a panic for any other, so that
//! none is passed over.

use serde_json::{Map, Value};

/// Everything in a value that its schema does not allow, with its place.
pub fn errors(schema: &Value, value: &Value) -> Vec<String> {
    let mut found = Vec::new();
    check(schema, value, "", &mut found);
    found
}

fn is_valid(schema: &Value, value: &Value) -> bool {
    let mut found = Vec::new();
    check(schema, value, "", &mut found);
    found.is_empty()
}

fn check(schema: &Value, value: &Value, at: &str, found: &mut Vec<String>) {
    let Value::Object(keywords) = schema else { panic!("{at}: no schema: {schema}") };
    for (keyword, wanted) in keywords {
        let is_right = match keyword.as_str() {
            "$schema" | "title" | "description" | "then" | "additionalProperties" => true,
            "type" => is_type(value, wanted.as_str().expect("a type")),
            "enum" => list(wanted).contains(value),
            "const" => wanted == value,
            "minimum" => value.as_f64().is_none_or(|number| number >= real(wanted)),
            "maximum" => value.as_f64().is_none_or(|number| number <= real(wanted)),
            "exclusiveMinimum" => value.as_f64().is_none_or(|number| number > real(wanted)),
            "minItems" => value.as_array().is_none_or(|items| items.len() as f64 >= real(wanted)),
            "maxItems" => value.as_array().is_none_or(|items| items.len() as f64 <= real(wanted)),
            "minProperties" => value.as_object().is_none_or(|members| members.len() as f64 >= real(wanted)),
            "maxLength" => value.as_str().is_none_or(|text| text.chars().count() as f64 <= real(wanted)),
            "pattern" => value.as_str().is_none_or(|text| matches(text, wanted.as_str().expect("a pattern"))),
            "required" => value.as_object().is_none_or(|members| has(members, wanted)),
            "dependencies" => value.as_object().is_none_or(|members| {
                let needed = wanted.as_object().expect("an object").iter();
                needed.filter(|(key, _)| members.contains_key(*key)).all(|(_, needed)| has(members, needed))
            }),
            "propertyNames" => value.as_object().is_none_or(|members| {
                members.keys().all(|key| is_valid(wanted, &Value::String(key.clone())))
            }),
            "anyOf" => list(wanted).iter().any(|option| is_valid(option, value)),
            "oneOf" => list(wanted).iter().filter(|option| is_valid(option, value)).count() == 1,
            "not" => !is_valid(wanted, value),
            "allOf" => {
                list(wanted).iter().for_each(|part| check(part, value, at, found));
                true
            }
            "if" => {
                if is_valid(wanted, value) {
                    check(&keywords["then"], value, at, found);
                }
                true
            }
            "items" => {
                items(wanted, value, at, found);
                true
            }
            "properties" => {
                properties(keywords, value, at, found);
                true
            }
            other => panic!("{at}: the keyword {other}"),
        };
        if !is_right {
            found.push(format!("{keyword} at {at}: {value}"));
        }
    }
    if !keywords.contains_key("properties") && keywords.contains_key("additionalProperties") {
        properties(keywords, value, at, found);
    }
}

fn list(value: &Value) -> &Vec<Value> {
    value.as_array().expect("a list")
}

fn real(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn has(members: &Map<String, Value>, needed: &Value) -> bool {
    list(needed).iter().all(|key| members.contains_key(key.as_str().expect("a key")))
}

fn is_type(value: &Value, ty: &str) -> bool {
    match ty {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "number" => value.is_number(),
        "integer" => value.as_f64().is_some_and(|number| number.fract() == 0.0),
        other => panic!("the type {other}"),
    }
}

/// The patterns of the schemas: a name of a layout, and a text with something in it.
fn matches(text: &str, pattern: &str) -> bool {
    match pattern {
        "^[A-Za-z]([A-Za-z0-9]|_(?=[A-Za-z0-9]))*$" => {
            text.starts_with(|c: char| c.is_ascii_alphabetic())
                && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
                && !text.contains("__")
                && !text.ends_with('_')
        }
        "\\S" => text.chars().any(|c| !c.is_whitespace()),
        other => panic!("the pattern {other}"),
    }
}

fn items(wanted: &Value, value: &Value, at: &str, found: &mut Vec<String>) {
    for (number, item) in value.as_array().into_iter().flatten().enumerate() {
        let schema = match wanted {
            Value::Array(each) => each.get(number),
            one => Some(one),
        };
        schema.into_iter().for_each(|schema| check(schema, item, &format!("{at}/{number}"), found));
    }
}

fn properties(keywords: &Map<String, Value>, value: &Value, at: &str, found: &mut Vec<String>) {
    for (key, member) in value.as_object().into_iter().flatten() {
        let own = keywords.get("properties").and_then(|properties| properties.get(key));
        let place = format!("{at}/{key}");
        match (own, keywords.get("additionalProperties")) {
            (Some(schema), _) => check(schema, member, &place, found),
            (None, None | Some(Value::Bool(true))) => {}
            (None, Some(Value::Bool(false))) => found.push(format!("unknown key {place}")),
            (None, Some(schema)) => check(schema, member, &place, found),
        }
    }
}
