//! JSON Schemas of layouts and scenarios, for editors: draft 7, which all of them know.
//!
//! Bounds and lists of keys are those of the readers. A schema says which keys there are and what their values look
//! like; whether names are known and machines meet, only the compiler says.

mod layout;
mod scenario;

pub use layout::layout;
pub use scenario::scenario;

use serde_json::{Map, Value, json};

const DRAFT: &str = "http://json-schema.org/draft-07/schema#";

/// A property with its description.
type Property = (String, Value);

fn described(mut schema: Value, text: &str) -> Value {
    schema["description"] = json!(text);
    schema
}

fn property(name: &str, schema: Value, text: &str) -> Property {
    (name.into(), described(schema, text))
}

/// An object that has these keys and no others.
fn object(properties: Vec<Property>, required: &[&str]) -> Value {
    json!({
        "type": "object", "properties": Map::from_iter(properties), "required": required,
        "additionalProperties": false,
    })
}

/// A whole file, which may name its schema.
fn file(title: &str, mut properties: Vec<Property>, required: &[&str]) -> Value {
    properties.push(property(
        crate::layout::decode::SCHEMA,
        json!({ "type": "string" }),
        "The schema, for an editor",
    ));
    let mut schema = object(properties, required);
    schema["$schema"] = json!(DRAFT);
    schema["title"] = json!(title);
    schema
}

fn list(of: Value) -> Value {
    json!({ "type": "array", "items": of })
}

fn number(lo: f64, hi: f64) -> Value {
    json!({ "type": "number", "minimum": lo, "maximum": hi })
}

fn whole(lo: u32, hi: u32) -> Value {
    json!({ "type": "integer", "minimum": lo, "maximum": hi })
}

fn text() -> Value {
    json!({ "type": "string" })
}

/// So many elements, one after another.
fn tuple(elements: &[Value]) -> Value {
    let count = elements.len();
    json!({ "type": "array", "items": elements, "minItems": count, "maxItems": count })
}

/// What can be in the text of a program.
fn name() -> Value {
    json!({ "type": "string", "pattern": "^[A-Za-z]([A-Za-z0-9]|_(?=[A-Za-z0-9]))*$", "maxLength": 32 })
}
