//! Text to syntax tree, by an independent grammar.

use crate::finding::{Finding, Span};
use tree_sitter::{Node, Parser, Tree};

/// The syntax tree of a text, or where the grammar does not take it.
pub fn parse(source: &str) -> Result<Tree, Vec<Finding>> {
    let mut parser = Parser::new();
    parser
        .set_language(&tree_sitter_iec61131_3_st::LANGUAGE.into())
        .expect("the versions of the crates agree");
    let tree = parser.parse(source, None).expect("no limit of time is set");
    if !tree.root_node().has_error() {
        return Ok(tree);
    }
    let mut findings = Vec::new();
    collect(tree.root_node(), &mut findings);
    Err(findings)
}

fn collect(node: Node, findings: &mut Vec<Finding>) {
    if node.is_missing() {
        findings.push(Finding::new("syntax", span(node), format!("`{}` is missing", node.kind())));
    } else if node.is_error() {
        findings.push(Finding::new("syntax", span(node), "the grammar does not take this"));
    } else if node.has_error() {
        let mut cursor = node.walk();
        node.children(&mut cursor).for_each(|child| collect(child, findings));
    }
}

pub(crate) fn span(node: Node) -> Span {
    Span { start: node.start_byte(), end: node.end_byte() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clean_text_has_a_tree() {
        assert!(parse("PROGRAM p\nVAR x : DINT; END_VAR\nx := 1;\nEND_PROGRAM\n").is_ok());
    }

    #[test]
    fn an_error_has_its_place() {
        let source = "PROGRAM p\nVAR x : DINT; END_VAR\nx := (1;\nEND_PROGRAM\n";
        let findings = parse(source).unwrap_err();
        assert!(findings[0].located(source).starts_with("3:"), "{findings:?}");
    }
}
