//! Types of the layout to automata of the same name.

use crate::device::Placed;
use crate::diagnostic::{Diagnostic, MOST, collect, suggestion};
use crate::ir::{Automaton, Model};
use crate::layout::decode::readable;
use crate::layout::{self, Layout, Object, Part, json};
use runtime_sim::line::Obstacle;
use std::collections::HashMap;

/// Machines with an automaton, and things without one, both in layout order.
pub struct Bound<'a> {
    pub robots: Vec<Robot<'a>>,
    pub obstacles: Vec<Obstacle>,
}

pub struct Robot<'a> {
    pub object: &'a Object,
    pub automaton: String,
    pub placed: Placed,
}

pub fn bind<'a>(layout: &'a Layout, model: &Model, diagnostics: &mut Vec<Diagnostic>) -> Bound<'a> {
    let mut bound = Bound { robots: Vec::new(), obstacles: Vec::new() };
    let automata: HashMap<&str, &Automaton> = model.automata.iter().map(|a| (a.name.as_str(), a)).collect();
    let device = |object: &Object| {
        automata.get(automaton_name(&object.kind.value).as_str()).map(|automaton| automaton.device.clone())
    };
    let (frames, found) = layout::at::frames(&layout.objects, &layout.routes, device);
    let of_parameters = |d| of_parameters(d, layout, &automata);
    found.into_iter().for_each(|d| collect(diagnostics, of_parameters(d)));
    for (object, pose) in layout.objects.iter().zip(frames) {
        let name = automaton_name(&object.kind.value);
        match automata.get(name.as_str()) {
            Some(automaton) => {
                match pose.map(|pose| layout::machine(object, &automaton.device, pose, &layout.routes)) {
                    Some(Ok(placed)) => bound.robots.push(Robot { object, automaton: name, placed }),
                    Some(Err(found)) => {
                        found.into_iter().for_each(|d| collect(diagnostics, of_parameters(d)));
                    }
                    None => {}
                }
            }
            None if object.part == Part::Robot => {
                if diagnostics.len() < MOST {
                    collect(diagnostics, without_automaton(object, &name, model));
                }
            }
            None => match layout::obstacle(object) {
                Ok(obstacle) => bound.obstacles.push(obstacle),
                Err(found) => found.into_iter().for_each(|d| collect(diagnostics, d)),
            },
        }
    }
    bound
}

/// The same, and if it is of a key that is a parameter of the automaton, where that belongs.
fn of_parameters(
    diagnostic: Diagnostic,
    layout: &Layout,
    automata: &HashMap<&str, &Automaton>,
) -> Diagnostic {
    if diagnostic.code != "E0111" {
        return diagnostic;
    }
    let key = layout.objects.iter().find_map(|object| {
        let member = object.members.iter().find(|member| member.key.span == diagnostic.place)?;
        let automaton = automata.get(automaton_name(&object.kind.value).as_str())?;
        let mut parameters = automaton.parameters.iter().filter(|parameter| parameter.is_settable());
        parameters.any(|parameter| parameter.name == member.key.value).then_some((member, automaton))
    });
    let Some((member, automaton)) = key else { return diagnostic };
    let name = &member.key.value;
    let value = match &member.value.value {
        json::Value::Number(number) => readable(*number),
        json::Value::Bool(truth) => truth.to_string(),
        json::Value::Text(text) => format!("\"{text}\""),
        _ => "...".into(),
    };
    diagnostic.help(format!(
        "`{name}` is a parameter of `{}`: write `\"parameters\": {{\"{name}\": {value}}}`",
        automaton.name
    ))
}

fn without_automaton(object: &Object, name: &str, model: &Model) -> Diagnostic {
    let kind = &object.kind.value;
    let known: Vec<String> =
        model.automata.iter().filter(|a| has_type(&a.name)).map(|a| json_type(&a.name)).collect();
    let without_type = model
        .automata
        .iter()
        .map(|a| a.name.as_str())
        .find(|automaton| !has_type(automaton) && words(automaton) == words(kind));
    let help = match (without_type, suggestion(kind, known.iter().map(String::as_str))) {
        (Some(automaton), _) => {
            let other = automaton_name(&words(automaton));
            let rename = match other.starts_with(|first: char| first.is_ascii_uppercase()) {
                true => format!("rename it `{other}`, whose type is \"{}\"", json_type(&other)),
                false => "rename it".into(),
            };
            format!(
                "a layout cannot name the automaton `{automaton}`: each word of its name has to begin with a capital letter, \
                 without underscores; {rename}"
            )
        }
        (None, Some(near)) => {
            format!("is \"{near}\" meant? Types with an automaton are {}", known.join(", "))
        }
        (None, None) => format!(
            "write `automaton {name} on ...` in a file of --specs; types with an automaton are {}",
            known.join(", ")
        ),
    };
    Diagnostic::new(
        "E0126",
        object.kind.span,
        format!("no automaton `{name}` for the type \"{}\"", object.kind.value),
    )
    .help(help)
}

/// `assembly_station` is another word for `station`; other types are named as their automaton.
pub(crate) fn automaton_name(kind: &str) -> String {
    let kind = if kind == "assembly_station" { "station" } else { kind };
    let mut name = String::new();
    for word in kind.split('_') {
        let mut letters = word.chars();
        name.extend(letters.next().into_iter().flat_map(char::to_uppercase));
        name.extend(letters);
    }
    name
}

/// Whether a layout can name an automaton.
pub fn has_type(automaton: &str) -> bool {
    automaton_name(&json_type(automaton)) == automaton
}

/// The words of a name in small letters, with one underscore between two of them.
fn words(name: &str) -> String {
    let type_name = json_type(name);
    type_name.split('_').filter(|word| !word.is_empty()).collect::<Vec<_>>().join("_")
}

/// The type under which a layout names an automaton.
pub fn json_type(automaton: &str) -> String {
    let mut kind = String::new();
    for (i, c) in automaton.chars().enumerate() {
        if c.is_uppercase() && i > 0 {
            kind.push('_');
        }
        kind.extend(c.to_lowercase());
    }
    kind
}
