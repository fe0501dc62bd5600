//! Statements.

use super::{Reader, fields, of_kind};
use crate::parse::span;
use crate::view::{Branch, Clause, Statement, StatementKind};
use tree_sitter::Node;

impl Reader<'_> {
    /// The statements in a field. The grammar takes the `;` after an END for an empty statement of its own.
    pub(super) fn statements(&mut self, parent: Node, field: &str) -> Vec<Statement> {
        let nodes: Vec<_> = fields(parent, field).into_iter().filter(|n| n.kind() != "comment").collect();
        let mut statements = Vec::new();
        let mut wants_semicolon: Option<Node> = None;
        for node in nodes {
            let is_empty = node.kind() == "empty_statement";
            match wants_semicolon.take() {
                Some(_) if is_empty => continue,
                Some(before) => self.semicolon(before),
                None if is_empty => {
                    self.report("empty-statement", node, "a statement without content");
                    continue;
                }
                None => {}
            }
            if matches!(
                node.kind(),
                "if_statement" | "case_statement" | "while_statement" | "for_statement" | "repeat_statement"
            ) {
                wants_semicolon = Some(node);
            }
            let statement = self.statement(node);
            statements.push(statement);
        }
        if let Some(before) = wants_semicolon {
            self.semicolon(before);
        }
        statements
    }

    fn semicolon(&mut self, before: Node) {
        self.report("semicolon", before, "`;` is missing after the END of this statement");
    }

    fn statement(&mut self, node: Node) -> Statement {
        let kind = match node.kind() {
            "assignment_statement" => {
                StatementKind::Assign { target: self.field(node, "left"), value: self.field(node, "right") }
            }
            "invocation_statement" => {
                of_kind(node, "call_expression").first().map_or(StatementKind::Other, |&call| {
                    self.call(call).map_or(StatementKind::Other, StatementKind::Call)
                })
            }
            "if_statement" => self.choice(node),
            "case_statement" => self.case(node),
            "while_statement" => StatementKind::While {
                condition: self.field(node, "condition"),
                body: self.statements(node, "body"),
            },
            "exit_statement" => StatementKind::Exit,
            "return_statement" if node.child_by_field_name("value").is_none() => StatementKind::Return,
            kind => {
                self.outside(node, kind);
                StatementKind::Other
            }
        };
        Statement { kind, span: span(node) }
    }

    fn choice(&mut self, node: Node) -> StatementKind {
        let mut branches = vec![Branch {
            condition: self.field(node, "condition"),
            body: self.statements(node, "consequence"),
        }];
        for branch in of_kind(node, "elsif_clause") {
            let condition = self.field(branch, "condition");
            branches.push(Branch { condition, body: self.statements(branch, "body") });
        }
        StatementKind::If { branches, otherwise: self.otherwise(node) }
    }

    fn case(&mut self, node: Node) -> StatementKind {
        let subject = self.field(node, "subject");
        let clauses = of_kind(node, "case_clause").into_iter().map(|clause| self.clause(clause)).collect();
        StatementKind::Case { subject, clauses, otherwise: self.otherwise(node) }
    }

    fn clause(&mut self, node: Node) -> Clause {
        let mut labels = Vec::new();
        for value in of_kind(node, "case_value") {
            match value.named_child(0) {
                Some(label) if label.kind() != "subrange" => labels.push(self.expression(label)),
                _ => self.outside(value, "a range as a label"),
            }
        }
        Clause { labels, body: self.statements(node, "body"), span: span(node) }
    }

    fn otherwise(&mut self, node: Node) -> Option<Vec<Statement>> {
        let clause = *of_kind(node, "else_clause").first()?;
        Some(self.statements(clause, "body"))
    }
}
