//! Constructs of the grammar that a text has, and how often each was executed.
//!
//! A construct is a kind of node or of token of the syntax tree, or a function that is called. It counts as often
//! as the innermost part of a statement around it was executed; a declaration, as often as its unit.

use crate::finding::Span;
use crate::parse::{parse, span};
use std::collections::{BTreeMap, HashMap};
use tree_sitter::Node;

/// Statements, conditions and units, with how often each was executed.
pub(super) type Executed = HashMap<Span, u64>;

/// `scans` is the count of what stands outside of all units.
pub(super) fn counts(source: &str, executed: &Executed, scans: u64) -> BTreeMap<String, u64> {
    let tree = parse(source).expect("the text was read before");
    let mut counts = BTreeMap::new();
    walk(tree.root_node(), source, executed, scans, &mut counts);
    counts
}

fn walk(node: Node, source: &str, executed: &Executed, around: u64, counts: &mut BTreeMap<String, u64>) {
    let count = match node.kind() {
        // Behind the first test, or not reached by every execution of the statement around it.
        "elsif_clause" | "else_clause" | "case_clause" => first(node, executed).unwrap_or(around),
        _ => executed.get(&span(node)).copied().unwrap_or(around),
    };
    let mut add = |name: String| *counts.entry(name).or_default() += count;
    add(if node.is_named() { node.kind().to_string() } else { format!("`{}`", node.kind()) });
    if let Some(name) = called(node, source) {
        add(format!("call of {name}"));
    }
    let mut cursor = node.walk();
    for child in node.children(&mut cursor) {
        walk(child, source, executed, count, counts);
    }
}

/// The count of the first statement or condition in a node.
fn first(node: Node, executed: &Executed) -> Option<u64> {
    let mut cursor = node.walk();
    node.children(&mut cursor)
        .find_map(|child| executed.get(&span(child)).copied().or_else(|| first(child, executed)))
}

/// The name of the function that an expression calls.
fn called<'s>(node: Node, source: &'s str) -> Option<&'s str> {
    let is_function =
        node.kind() == "call_expression" && node.parent().is_none_or(|p| p.kind() != "invocation_statement");
    let name = node.named_child(0).filter(|_| is_function)?;
    Some(&source[name.start_byte()..name.end_byte()])
}
