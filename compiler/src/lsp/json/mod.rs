//! What can be at a place of a layout or a scenario that is being typed: keys and values by the schema, and names of
//! what the line has.

mod names;
mod rules;
mod tree;

pub use tree::{Member, Node, Wanted, parse};

use super::completion::MOST_WORDS;
use super::hover::escaped;
use crate::ir::Model;
use crate::schema;
use serde_json::Value;
use std::ops::Range;

/// Which schema a file follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    Layout,
    Scenario,
}

/// What is known of the line that a file belongs to.
#[derive(Debug)]
pub struct Line {
    /// The types that have no errors.
    pub model: Model,
    /// The names of all automata, of those with errors too.
    pub declared: Vec<String>,
    /// Kinds of part; empty if the scenario names none.
    pub kinds: Vec<String>,
    pub things: Vec<Thing>,
}

/// A machine or an obstacle.
#[derive(Clone, Debug, PartialEq)]
pub struct Thing {
    pub name: String,
    /// The key `type`.
    pub kind: String,
}

/// What a word would replace, and what may be there.
#[derive(Debug)]
pub struct Completion {
    pub span: Range<usize>,
    pub wanted: Wanted,
    pub words: Vec<Word>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Word {
    pub value: Value,
    pub detail: &'static str,
    pub doc: String,
}

/// Machines and things of a layout with a name and a type.
pub fn things(layout: &Node) -> Vec<Thing> {
    let lists = ["robots", "stationary"].into_iter().filter_map(|key| layout.get(key));
    let text = |node: &Node, key| node.get(key).and_then(Node::text).map(str::to_string);
    lists
        .flat_map(Node::items)
        .filter_map(|node| Some(Thing { name: text(node, "name")?, kind: text(node, "type")? }))
        .collect()
}

/// The kinds of part that a scenario names.
pub fn kinds(scenario: &Node) -> Vec<String> {
    let kinds = scenario.get("kinds").map(Node::items).unwrap_or_default();
    kinds.iter().filter_map(|kind| kind.get("name")?.text()).map(str::to_string).collect()
}

fn schema(line: &Line, of: Of) -> Value {
    match of {
        Of::Layout => schema::layout(&line.model, !line.kinds.is_empty()),
        Of::Scenario => schema::scenario(),
    }
}

pub fn completion(line: &Line, of: Of, text: &str, offset: usize) -> Option<Completion> {
    let tree = parse(text);
    let place = tree.place(offset)?;
    let schema = schema(line, of);
    let rules = rules::at(&schema, &place.path, &place.around);
    let named = names::names(line, of, &place).into_iter().take(MOST_WORDS);
    let mut words: Vec<Word> =
        named.map(|name| Word { value: name.into(), detail: "", doc: String::new() }).collect();
    match place.wanted {
        Wanted::Key { .. } => {
            let own = place.around.last().map(|node| node.members()).unwrap_or_default();
            let others = own.iter().filter(|member| member.key != place.span);
            let present: Vec<&str> = others.map(|member| member.name.as_str()).collect();
            words.extend(rules::keys(&rules).into_iter().map(|(key, rule)| Word {
                value: key.into(),
                detail: if rules::is_needed(&rules, key) { "needed" } else { "" },
                doc: description(rule).into(),
            }));
            let is_new = |key: &str| !present.contains(&key) && rules::may_have(&rules, key, &present);
            words.retain(|word| word.value.as_str().is_some_and(is_new));
        }
        Wanted::Value => {
            let values = rules::values(&rules).into_iter();
            words.extend(values.map(|value| Word { value, detail: "", doc: String::new() }));
        }
    }
    words.sort_by_key(|word| word.value.to_string());
    words.dedup_by(|a, b| a.value == b.value);
    Some(Completion { span: place.span, wanted: place.wanted, words })
}

fn description(rule: &Value) -> &str {
    rule["description"].as_str().unwrap_or_default()
}

/// What a key means, as Markdown, and its place.
pub fn hover(line: &Line, of: Of, text: &str, offset: usize) -> Option<(String, Range<usize>)> {
    let tree = parse(text);
    let place = tree.place(offset)?;
    let own = place.around.last()?.members();
    let key = &own.iter().find(|member| member.key == place.span)?.name;
    let schema = schema(line, of);
    let rules = rules::at(&schema, &place.path, &place.around);
    let keys = rules::keys(&rules);
    let meant = keys.iter().filter(|(known, _)| known == key).map(|(_, rule)| description(rule));
    let meaning = meant.into_iter().rev().find(|text| !text.is_empty())?;
    Some((escaped(meaning), place.span))
}
