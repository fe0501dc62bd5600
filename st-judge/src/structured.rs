//! Reads the objects of a CODESYS project as they are generated, and says the same in the portable core.
//!
//! Written from the rules of the language, never from the emitter: an enumeration becomes numbers, a structure one
//! variable for each of its fields, an array of structures one array for each of them. A parameter that is passed by
//! reference is what it refers to.

mod access;
mod body;
mod call;
mod initial;
mod lists;
mod types;
mod units;

use crate::finding::{Finding, Span};
use crate::parse;
use lists::{Global, Lists};
use std::collections::BTreeMap;
use tree_sitter::{Node, Tree};
use types::Types;
use units::{Signature, unit};

/// The local of the program that is set when the variables have their declared values.
const DECLARED: &str = "declared_values_are_set";

/// The text of one object.
#[derive(Clone, Copy)]
pub struct Object<'a> {
    /// For messages.
    pub name: &'a str,
    pub text: &'a str,
}

/// The same program in the portable core; or what is wrong with an object, with its name and place.
pub fn portable(objects: &[Object]) -> Result<String, String> {
    let mut parsed = Vec::new();
    for object in objects {
        let (text, initials) = initial::taken_out(object.text);
        // The grammar wants a semicolon behind a structure.
        let text = without_clock(&text).replace("END_STRUCT\n", "END_STRUCT;");
        let tree = parse::parse(&text)
            .map_err(|found| format!("{}: {}", object.name, crate::listed(&found, object.text)))?;
        parsed.push(Parsed { name: object.name, text, tree, initials });
    }
    let mut types = Types::default();
    for object in &parsed {
        object.each("type_declaration", |node| types.declare(object, node))?;
    }
    for object in &parsed {
        object.each("type_declaration", |node| types.read(object, node))?;
    }
    let mut lists = Lists::default();
    let mut signatures = BTreeMap::new();
    for object in &parsed {
        object.each("global_var_declaration_block", |node| lists.read(object, node, &types))?;
        for kind in ["function_declaration", "function_block_declaration", "program_declaration"] {
            object.each(kind, |node| {
                let signature = Signature::read(object, node, &types)?;
                let name = signature.name.to_ascii_lowercase();
                match signatures.insert(name, signature) {
                    None => Ok(()),
                    Some(_) => Err(object.wrong(node, "a second object of this name")),
                }
            })?;
        }
    }
    written(&parsed, &types, &lists, &signatures)
}

fn written(
    parsed: &[Parsed],
    types: &Types,
    lists: &Lists,
    signatures: &BTreeMap<String, Signature>,
) -> Result<String, String> {
    let known = Known { types, lists, signatures };
    let mut texts = BTreeMap::new();
    let mut called = BTreeMap::new();
    for object in parsed {
        for kind in ["function_declaration", "function_block_declaration", "program_declaration"] {
            object.each(kind, |node| {
                let (name, text, instances) = unit(object, node, &known)?;
                called.insert(name.clone(), instances);
                texts.insert(name, (kind, text));
                Ok(())
            })?;
        }
    }
    let mut text = String::new();
    for (_, unit) in texts.values().filter(|(kind, _)| *kind == "function_declaration") {
        text += unit;
    }
    // A block stands behind those that it has instances of.
    let mut open: Vec<&String> =
        texts.iter().filter(|(_, (kind, _))| *kind != "function_declaration").map(|(name, _)| name).collect();
    while !open.is_empty() {
        let ready = open.iter().position(|name| called[*name].iter().all(|inner| !open.contains(&inner)));
        let Some(ready) = ready else { return Err("blocks that have instances of each other".into()) };
        text += &texts[open.remove(ready)].1;
    }
    let programs: Vec<&Signature> = signatures.values().filter(|s| s.is_program).collect();
    let [program] = programs[..] else { return Err("there is not one program".into()) };
    Ok(text + &configuration(lists, &program.name))
}

fn configuration(lists: &Lists, program: &str) -> String {
    let section = |keyword: &str, is_retained: bool| {
        let of = lists.globals.values().filter(|global| global.is_retained == is_retained);
        let lines: String = of.map(Global::lines).collect();
        if lines.is_empty() { lines } else { format!("{keyword}\n{lines}END_VAR\n") }
    };
    format!(
        "CONFIGURATION Config0\n{}{}RESOURCE Res0 ON PLC\nTASK Scan(INTERVAL := T#10ms, PRIORITY := 0);\n\
         PROGRAM Main_program WITH Scan : {program};\nEND_RESOURCE\nEND_CONFIGURATION\n",
        section("VAR_GLOBAL", false),
        section("VAR_GLOBAL RETAIN", true),
    )
}

/// What a unit may name beside its own variables.
struct Known<'a> {
    types: &'a Types,
    lists: &'a Lists,
    signatures: &'a BTreeMap<String, Signature>,
}

struct Parsed<'a> {
    name: &'a str,
    text: String,
    tree: Tree,
    /// Values of lists, by where their `:=` stands.
    initials: Vec<(usize, initial::Value)>,
}

impl Parsed<'_> {
    fn each(&self, kind: &str, mut visit: impl FnMut(Node) -> Result<(), String>) -> Result<(), String> {
        let root = self.tree.root_node();
        let mut cursor = root.walk();
        root.children(&mut cursor).filter(|node| node.kind() == kind).try_for_each(&mut visit)
    }

    fn text(&self, node: Node) -> &str {
        &self.text[node.byte_range()]
    }

    fn field(&self, node: Node, field: &str) -> &str {
        node.child_by_field_name(field).map_or("", |child| self.text(child))
    }

    fn wrong(&self, node: Node, text: &str) -> String {
        let span = Span { start: node.start_byte(), end: node.end_byte() };
        let about = format!("`{}`: {text}", self.text(node));
        format!("{}: {}", self.name, Finding::new("structured", span, about).located(&self.text))
    }
}

fn children(node: Node) -> Vec<Node> {
    let mut cursor = node.walk();
    node.children(&mut cursor).filter(|child| !matches!(child.kind(), "comment" | "pragma")).collect()
}

/// Without the statement that reads the clock of the PLC: the evaluator has none, and the variable keeps its value.
fn without_clock(text: &str) -> String {
    let line = |line: &str| match line.starts_with("clock_ms := ") && line.contains("TIME()") {
        true => " ".repeat(line.len()),
        false => line.to_string(),
    };
    text.split('\n').map(line).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests;
