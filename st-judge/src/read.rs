//! Syntax tree to the typed view. What the view cannot hold lies outside the portable core and is a finding.

mod comment;
mod configuration;
mod expression;
mod statement;
mod unit;

use crate::finding::{Finding, Span};
use crate::parse::span;
use crate::view::{Name, Text};
use tree_sitter::{Node, Tree};

/// The view of a tree, and what it leaves out.
pub fn read(tree: &Tree, source: &str) -> (Text, Vec<Finding>) {
    let mut reader = Reader { source, findings: Vec::new() };
    let mut text = Text::default();
    let root = tree.root_node();
    reader.comments(root);
    for node in children(root) {
        match node.kind() {
            "function_declaration" | "function_block_declaration" | "program_declaration" => {
                if let Some(first) = text.configurations.first() {
                    let name = &first.name.text;
                    reader.report("order", node, format!("a unit stands after CONFIGURATION `{name}`"));
                }
                let unit = reader.unit(node);
                text.units.push(unit);
            }
            "configuration_declaration" => {
                let configuration = reader.configuration(node);
                text.configurations.push(configuration);
            }
            "comment" => {}
            kind => reader.outside(node, kind),
        }
    }
    (text, reader.findings)
}

struct Reader<'a> {
    source: &'a str,
    findings: Vec<Finding>,
}

impl Reader<'_> {
    fn text(&self, node: Node) -> &str {
        &self.source[node.byte_range()]
    }

    fn report(&mut self, code: &'static str, node: Node, text: impl Into<String>) {
        self.findings.push(Finding::new(code, span(node), text));
    }

    /// Reports a construct that is not in the portable core.
    fn outside(&mut self, node: Node, what: &str) {
        self.report("core", node, format!("`{what}` is outside the portable core"));
    }

    fn name(&self, node: Node) -> Name {
        Name { text: self.text(node).into(), span: span(node) }
    }

    /// The name in a field; an empty one where the tree has none, which a clean tree never lacks.
    fn name_of(&self, node: Node, field: &str) -> Name {
        match node.child_by_field_name(field) {
            Some(child) => self.name(child),
            None => {
                Name { text: String::new(), span: Span { start: node.start_byte(), end: node.start_byte() } }
            }
        }
    }
}

fn children(node: Node) -> Vec<Node> {
    let mut cursor = node.walk();
    node.children(&mut cursor).collect()
}

fn fields<'t>(node: Node<'t>, field: &str) -> Vec<Node<'t>> {
    let mut cursor = node.walk();
    node.children_by_field_name(field, &mut cursor).collect()
}

fn of_kind<'t>(node: Node<'t>, kind: &str) -> Vec<Node<'t>> {
    children(node).into_iter().filter(|n| n.kind() == kind).collect()
}
