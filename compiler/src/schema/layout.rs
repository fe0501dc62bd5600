//! The schema of layouts, with the keys and the parameters of the types that are known.

use super::{Property, described, file, list, name, number, object, property, text, tuple};
use crate::device::{self, Form};
use crate::ir::{Automaton, Extent, KIND, Model, Scalar, Type};
use crate::layout::Panel;
use crate::layout::machine::{LONGEST_S, OBSTACLES};
use crate::layout::object::{COMMON_KEYS, FARTHEST};
use crate::layout::read::{KEYS, SCANS_MS};
use crate::layout::routes::FASTEST;
use crate::lower::bind::{has_type, json_type};
use serde_json::{Map, Value, json};

/// `model` has the types. If `are_kinds_known` its kinds are those of the scenario, and else their number is not known.
pub fn layout(model: &Model, are_kinds_known: bool) -> Value {
    let types = Types { model, are_kinds_known };
    let objects = |items: Value| json!({ "type": "array", "items": items });
    let paths = json!({ "anyOf": [text(), list(text())] });
    let all = vec![
        property("robots", objects(types.object(false)), "The machines, in the order in which they step"),
        property(
            "stationary",
            objects(types.object(true)),
            "Objects that do not move: stations, tables, obstacles",
        ),
        property(
            "name",
            name(),
            "Name of the layout and of its output folder. Without it: the name of the file",
        ),
        property(
            "specs",
            paths,
            "A folder with *.aut files, or one such file, or a list of these, below the layout's folder",
        ),
        property(
            "scenario",
            text(),
            "The file of the scenario. Without it: scenario.json beside the layout, else the built-in one",
        ),
        property(
            "scan_ms",
            super::whole(*SCANS_MS.start(), *SCANS_MS.end()),
            "Period of the scan, ms. Without it: 10",
        ),
        property(
            "panel",
            json!({ "enum": Panel::ALL.map(|(word, _)| word) }),
            "What a person can operate: the line as a whole, or each of its machines too. Without it: line",
        ),
        property(
            "routes",
            json!({ "type": "object", "additionalProperties": routes() }),
            "Nodes and edges on which vehicles drive, by their names",
        ),
        property("may_touch", list(may_touch()), "Pairs whose contact does not end a run"),
    ];
    debug_assert!(all.iter().map(|(key, _)| key.as_str()).eq(KEYS));
    file("Layout of autogen", all, &["robots"])
}

fn routes() -> Value {
    let edge = vec![
        property("from", text(), "The node at which it begins"),
        property("to", text(), "The node at which it ends"),
        property("speed", number(0.001, FASTEST), "Greatest velocity of vehicles on it, m/s"),
        property(
            "both_ways",
            json!({ "type": "boolean" }),
            "Vehicles also drive from its end to its beginning",
        ),
    ];
    let all = vec![
        property(
            "nodes",
            json!({ "type": "object", "additionalProperties": point() }),
            "Places by their names",
        ),
        property(
            "edges",
            list(object(edge, &["from", "to"])),
            "Each leads straight from one node to another one",
        ),
    ];
    object(all, &["nodes", "edges"])
}

fn may_touch() -> Value {
    let all = vec![
        property("pair", tuple(&[text(), text()]), "The two, by their names"),
        property("reason", json!({ "type": "string", "pattern": "\\S" }), "Why the two may touch"),
    ];
    object(all, &["pair", "reason"])
}

fn metres() -> Value {
    number(-FARTHEST, FARTHEST)
}

fn point() -> Value {
    described(tuple(&[metres(), metres(), metres()]), "x, y, z in m")
}

struct Types<'a> {
    model: &'a Model,
    are_kinds_known: bool,
}

impl Types<'_> {
    /// An element of `robots` or of `stationary`. Of a type that is known no other keys are allowed.
    fn object(&self, is_stationary: bool) -> Value {
        let mut pose = vec![metres(), metres(), metres(), number(-360.0, 360.0)];
        pose[3]["description"] = json!("Rotation in degrees to the left");
        let automata = self.model.automata.iter().filter(|automaton| has_type(&automaton.name));
        let mut known: Vec<String> = automata.map(|automaton| json_type(&automaton.name)).collect();
        known.extend(OBSTACLES.iter().filter(|_| is_stationary).map(|kind| kind.to_string()));
        let kind = json!({ "anyOf": [{ "enum": known }, text()] });
        let mut all = vec![
            property("name", name(), "Its name"),
            property("type", kind, "Its type: agv is the automaton Agv"),
            property(
                "pose",
                json!({ "type": "array", "items": pose, "minItems": 3, "maxItems": 4 }),
                "Its position: x, y, z in m, and degrees if it is turned",
            ),
            property(
                "at",
                json!({ "anyOf": [text(), tuple(&[text(), text()])] }),
                "Instead of a pose: its lane begins where this lane of another machine ends, such as c1.belt",
            ),
            property("parameters", json!({ "type": "object" }), "Values of the parameters of its type"),
            property("takes_from", list(text()), "An arm takes only from these"),
            property("hands_to", list(text()), "An arm hands over only to these"),
        ];
        debug_assert!(all.iter().map(|(key, _)| key.as_str()).eq(COMMON_KEYS));
        let mut keys: Vec<&str> = COMMON_KEYS.to_vec();
        if is_stationary {
            let over_0 = json!({ "type": "number", "exclusiveMinimum": 0, "maximum": FARTHEST });
            let lengths = tuple(&[over_0.clone(), over_0.clone(), over_0]);
            all.push(property(
                "box",
                lengths,
                "Lengths along x, y and z, m. The pose is the middle of its base",
            ));
            keys.push("box");
        }
        let types: Vec<Value> =
            self.model.automata.iter().map(|automaton| self.of_type(automaton, &keys)).collect();
        json!({
            "type": "object", "properties": Map::from_iter(all), "required": ["name", "type"],
            "oneOf": [{ "required": ["pose"] }, { "required": ["at"] }], "allOf": types,
        })
    }

    /// What holds for the objects of one type.
    fn of_type(&self, automaton: &Automaton, keys: &[&str]) -> Value {
        let kind = json_type(&automaton.name);
        let kinds = if kind == "station" { vec![kind, "assembly_station".into()] } else { vec![kind] };
        let own = &automaton.device.parameters;
        let mut properties: Vec<Property> = own
            .iter()
            .map(|parameter| property(&parameter.name, form(&parameter.form), &parameter.meaning))
            .collect();
        properties.push(("parameters".into(), self.parameters(automaton)));
        let required: Vec<&String> = own.iter().filter(|p| p.default.is_none()).map(|p| &p.name).collect();
        let names: Vec<&str> = keys.iter().copied().chain(own.iter().map(|p| p.name.as_str())).collect();
        json!({
            "if": { "properties": { "type": { "enum": kinds } }, "required": ["type"] },
            "then": {
                "properties": Map::from_iter(properties), "required": required,
                "propertyNames": { "enum": names },
            },
        })
    }

    fn parameters(&self, automaton: &Automaton) -> Value {
        let settable = automaton.parameters.iter().filter(|parameter| parameter.is_settable());
        let properties = settable
            .map(|parameter| property(&parameter.name, self.value(parameter.ty), &parameter.doc.join(" ")));
        object(properties.collect(), &[])
    }

    fn value(&self, ty: Type) -> Value {
        let one = self.scalar(ty.scalar);
        match ty.extent {
            Extent::One => one,
            Extent::Count(count) => {
                json!({ "type": "array", "items": one, "minItems": count, "maxItems": count })
            }
            Extent::By(KIND) if !self.are_kinds_known => {
                json!({ "anyOf": [{ "type": "object", "additionalProperties": one }, list(one)] })
            }
            Extent::By(id) => {
                let members: Vec<&str> = self.model.enums[id.0].members.iter().map(String::as_str).collect();
                let each: Vec<Property> =
                    members.iter().map(|member| (member.to_string(), one.clone())).collect();
                let count = members.len();
                let in_order = json!({ "type": "array", "items": one, "minItems": count, "maxItems": count });
                json!({ "anyOf": [object(each, &members), in_order] })
            }
        }
    }

    fn scalar(&self, ty: Scalar) -> Value {
        match ty {
            Scalar::Bool => json!({ "type": "boolean" }),
            Scalar::Int { lo, hi } => json!({ "type": "integer", "minimum": lo, "maximum": hi }),
            Scalar::Real => json!({ "type": "number" }),
            Scalar::Time => described(json!({ "type": "number", "minimum": 0 }), "seconds"),
            Scalar::Point => tuple(&[
                json!({ "type": "number" }),
                json!({ "type": "number" }),
                json!({ "type": "number" }),
            ]),
            Scalar::Enum(KIND) if !self.are_kinds_known => text(),
            Scalar::Enum(id) => json!({ "enum": self.model.enums[id.0].members }),
            Scalar::Ref(_) => described(text(), "the name of an object"),
        }
    }
}

/// A key that a device reads.
fn form(form: &device::Form) -> Value {
    match form {
        Form::Axis => json!({ "enum": ["x", "y"] }),
        Form::Range => tuple(&[metres(), metres()]),
        Form::Real => metres(),
        Form::Time => number(0.0, LONGEST_S),
        Form::Point => point(),
        Form::Routes => described(text(), "the name of routes of the layout"),
        Form::Node => described(text(), "the name of a node"),
        Form::Points(each) => tuple(&each.iter().map(|what| described(point(), what)).collect::<Vec<_>>()),
    }
}
