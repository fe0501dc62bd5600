//! Where a file names what another key or another file has: machines, their parts, kinds of part.

use super::tree::{Node, Place, Step, Wanted};
use super::{Line, MOST_WORDS, Of, Thing};
use crate::device::Form;
use crate::ir::{Automaton, Scalar};
use crate::lower::bind::{automaton_name, has_type, json_type};
use crate::scenario::read::operator::OF_LINE;
use runtime_sim::device::Direction;
use std::collections::BTreeMap;

/// The names that a place asks for.
pub fn names(line: &Line, of: Of, place: &Place) -> Vec<String> {
    let path: Vec<&str> = place
        .path
        .iter()
        .map(|step| match step {
            Step::Key(key) => key.as_str(),
            Step::Index(_) => "*",
        })
        .collect();
    let is_key = matches!(place.wanted, Wanted::Key { .. });
    match (of, is_key) {
        (Of::Layout, false) => in_layout(line, &path, place),
        (Of::Layout, true) => Vec::new(),
        (Of::Scenario, true) => keys_of_scenario(line, &path),
        (Of::Scenario, false) => in_scenario(line, &path, place),
    }
}

fn in_layout(line: &Line, path: &[&str], place: &Place) -> Vec<String> {
    let own = || place.around.get(2).copied();
    let text = |key: &str| own().and_then(|own| own.get(key)?.text());
    match path {
        ["robots" | "stationary", "*", "type"] => {
            line.declared.iter().filter(|name| has_type(name)).map(|name| json_type(name)).collect()
        }
        ["robots" | "stationary", "*", "takes_from" | "hands_to", "*"] => {
            let name = text("name");
            of_things(line, |thing, automaton| automaton.is_some() && Some(thing.name.as_str()) != name)
        }
        ["robots" | "stationary", "*", "at"] => lanes_of_others(line, text("name")),
        ["robots" | "stationary", "*", "at", "*"] => match (place.path.last(), own()) {
            (Some(Step::Index(0)), Some(own)) => {
                let automaton = own.get("type").and_then(Node::text).and_then(|kind| line.automaton(kind));
                automaton.map_or_else(Vec::new, |automaton| lanes(automaton).map(String::from).collect())
            }
            _ => lanes_of_others(line, text("name")),
        },
        ["routes", _, "edges", "*", "from" | "to"] => own().map_or_else(Vec::new, nodes),
        ["robots" | "stationary", "*", key] => {
            own().map_or_else(Vec::new, |own| tracks(line, place, own, key))
        }
        ["may_touch", "*", "pair", "*"] => of_things(line, |_, _| true),
        ["robots" | "stationary", "*", "parameters", parameter, ..] => {
            let automaton = text("type").and_then(|kind| line.automaton(kind));
            let parameters = automaton.map(|automaton| automaton.parameters.as_slice()).unwrap_or_default();
            let found = parameters.iter().find(|known| known.name == *parameter);
            match found.map(|parameter| parameter.ty.scalar) {
                Some(Scalar::Ref(interface)) => of_things(line, |_, automaton| {
                    automaton.is_some_and(|automaton| automaton.implementing(interface).is_some())
                }),
                _ => Vec::new(),
            }
        }
        _ => Vec::new(),
    }
}

/// The nodes of routes.
fn nodes(routes: &Node) -> Vec<String> {
    let nodes = routes.get("nodes").into_iter().flat_map(|nodes| nodes.members());
    nodes.map(|node| node.name.clone()).collect()
}

/// What a key of a vehicle on a track may be: the routes of the layout, or the nodes of its own.
fn tracks(line: &Line, place: &Place, own: &Node, key: &str) -> Vec<String> {
    let routes = place.around.first().and_then(|layout| layout.get("routes"));
    let automaton = own.get("type").and_then(Node::text).and_then(|kind| line.automaton(kind));
    let (Some(routes), Some(automaton)) = (routes, automaton) else { return Vec::new() };
    let parameters = &automaton.device.parameters;
    match parameters.iter().find(|parameter| parameter.name == key).map(|parameter| &parameter.form) {
        Some(Form::Routes) => routes.members().iter().map(|member| member.name.clone()).collect(),
        Some(Form::Node) => {
            let of_routes = parameters.iter().find(|parameter| parameter.form == Form::Routes);
            let named = of_routes.and_then(|parameter| own.get(&parameter.name)?.text());
            named.and_then(|name| routes.get(name)).map_or_else(Vec::new, nodes)
        }
        _ => Vec::new(),
    }
}

fn lanes(automaton: &Automaton) -> impl Iterator<Item = &str> {
    automaton.device.parts_called("lane").map(|(_, lane)| lane)
}

/// At whose ends the lane of a machine may begin, as `belt.lane`.
fn lanes_of_others(line: &Line, own: Option<&str>) -> Vec<String> {
    let others = machines(line).filter(|(thing, _)| Some(thing.name.as_str()) != own);
    others
        .flat_map(|(thing, automaton)| lanes(automaton).map(|lane| format!("{}.{lane}", thing.name)))
        .collect()
}

fn keys_of_scenario(line: &Line, path: &[&str]) -> Vec<String> {
    match path {
        ["orders", "parts"] | ["orders", "*", "parts"] | ["goal", _] => line.kinds.clone(),
        ["supply", "items"] => having(line, "source"),
        ["goal"] => machines(line)
            .flat_map(|(thing, automaton)| {
                let sinks = automaton.device.parts_called("sink");
                sinks.map(|(_, sink)| format!("{}.{sink}", thing.name))
            })
            .collect(),
        _ => Vec::new(),
    }
}

fn in_scenario(line: &Line, path: &[&str], place: &Place) -> Vec<String> {
    match path {
        ["supply", "items", "*"] | ["supply", "items", _, "*"] => line.kinds.clone(),
        ["orders", "stations", "*"]
        | ["orders", "*", "station"]
        | ["orders", "*", "station" | "stations", "*"] => having(line, "orders"),
        ["faults", "slips", "*", "robot"] => having(line, "grip"),
        ["faults", "jams", "*", "robot"] => {
            of_machines(line, |automaton| automaton.device.jamming().count() > 0)
        }
        ["faults", "jams", "*", "part"] => {
            of_robot(line, place, |automaton| texts(automaton.device.jamming()))
        }
        ["faults", "slow", "*", "robot"] => having(line, "process"),
        ["faults", "slow", "*", "part"] => of_robot(line, place, |automaton| {
            texts(automaton.device.parts_called("process").map(|(_, part)| part))
        }),
        ["faults", "sensors", "*", "robot"] => of_machines(line, |automaton| inputs(automaton).count() > 0),
        ["faults", "sensors", "*", "signal"] => of_robot(line, place, |automaton| texts(inputs(automaton))),
        ["faults", _, "*", "robot"] => of_machines(line, |automaton| automaton.device.is_commanded()),
        ["operator", "*", "remove"] => items(line, place),
        ["operator", "*", "robot"] => of_machines(line, |automaton| automaton.device.operated().count() > 0),
        ["operator", "*", "part"] => {
            if named_robot(place).is_none() {
                return OF_LINE.iter().map(|(button, _)| button.to_string()).collect();
            }
            of_robot(line, place, |automaton| texts(automaton.device.operated().map(|(_, part, _)| part)))
        }
        _ => Vec::new(),
    }
}

/// What the supply brings, by kind and number; the first of each kind, where the supply is no list.
fn items(line: &Line, place: &Place) -> Vec<String> {
    let supply = place.around.first().and_then(|scenario| scenario.get("supply"));
    let list = supply.and_then(|supply| supply.get("items"));
    let belts = list.into_iter().flat_map(|list| list.members()).filter_map(|belt| belt.value.as_ref());
    let names = belts.chain(list).flat_map(Node::items).filter_map(Node::text);
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    names.for_each(|name| *counts.entry(name).or_default() += 1);
    let times = supply.and_then(|supply| supply.get("times")?.number()).unwrap_or(1).min(MOST_WORDS);
    let of_kind = |kind: &String| match list {
        Some(_) => counts.get(kind.as_str()).map_or(0, |count| count * times),
        None => 1,
    };
    let most = line.kinds.iter().map(of_kind).max().unwrap_or_default();
    let numbered = |number: usize| {
        let brought = line.kinds.iter().filter(move |kind| number <= of_kind(kind));
        brought.map(move |kind| format!("{kind}_{number}"))
    };
    (1..=most).flat_map(numbered).take(MOST_WORDS).collect()
}

/// The machine that the object names in which the place is.
fn named_robot<'a>(place: &'a Place) -> Option<&'a str> {
    place.around.last().and_then(|own| own.get("robot")?.text())
}

fn of_robot(line: &Line, place: &Place, names: impl Fn(&Automaton) -> Vec<String>) -> Vec<String> {
    let robot = named_robot(place);
    let mut of_name = machines(line).filter(|(thing, _)| Some(thing.name.as_str()) == robot);
    of_name.next().map_or_else(Vec::new, |(_, automaton)| names(automaton))
}

fn inputs(automaton: &Automaton) -> impl Iterator<Item = &str> {
    let inputs = automaton.device.ports.iter().filter(|port| port.direction == Direction::Input);
    inputs.map(|port| port.name.as_str())
}

fn texts<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    names.map(String::from).collect()
}

fn of_things(line: &Line, is_wanted: impl Fn(&Thing, Option<&Automaton>) -> bool) -> Vec<String> {
    let wanted = line.things.iter().filter(|thing| is_wanted(thing, line.automaton(&thing.kind)));
    wanted.map(|thing| thing.name.clone()).collect()
}

fn machines(line: &Line) -> impl Iterator<Item = (&Thing, &Automaton)> {
    line.things.iter().filter_map(|thing| Some((thing, line.automaton(&thing.kind)?)))
}

fn of_machines(line: &Line, is_wanted: impl Fn(&Automaton) -> bool) -> Vec<String> {
    machines(line)
        .filter(|(_, automaton)| is_wanted(automaton))
        .map(|(thing, _)| thing.name.clone())
        .collect()
}

/// Machines with a part of this primitive.
fn having(line: &Line, primitive: &str) -> Vec<String> {
    of_machines(line, |automaton| automaton.device.has(primitive))
}

impl Line {
    fn automaton(&self, kind: &str) -> Option<&Automaton> {
        let name = automaton_name(kind);
        self.model.automata.iter().find(|automaton| automaton.name == name)
    }
}
