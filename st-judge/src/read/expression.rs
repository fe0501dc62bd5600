//! Expressions.

use super::{Reader, fields};
use crate::finding::Span;
use crate::parse::span;
use crate::view::{Argument, Binary, Call, Expression, ExpressionKind, Unary};
use tree_sitter::Node;

impl Reader<'_> {
    pub(super) fn field(&mut self, node: Node, field: &str) -> Expression {
        match node.child_by_field_name(field) {
            Some(child) => self.expression(child),
            None => Expression {
                kind: ExpressionKind::Other,
                span: Span { start: node.start_byte(), end: node.start_byte() },
            },
        }
    }

    pub(super) fn expression(&mut self, node: Node) -> Expression {
        let kind = match node.kind() {
            "boolean_literal" => ExpressionKind::Bool(self.text(node).eq_ignore_ascii_case("true")),
            "integer_literal" => ExpressionKind::Int(self.text(node).into()),
            "real_literal" => ExpressionKind::Real(self.text(node).into()),
            "time_literal" => ExpressionKind::Time(self.text(node).into()),
            "identifier" => ExpressionKind::Name(self.name(node)),
            "parenthesized_expression" => match of_expression(node) {
                Some(inner) => ExpressionKind::Parenthesis(Box::new(self.expression(inner))),
                None => ExpressionKind::Other,
            },
            "index_expression" => self.index(node),
            "member_access_expression" => ExpressionKind::Member {
                object: Box::new(self.field(node, "object")),
                member: self.name_of(node, "member"),
            },
            "unary_expression" => self.unary(node),
            "binary_expression" => self.binary(node),
            "call_expression" => self.call(node).map_or(ExpressionKind::Other, ExpressionKind::Call),
            kind => {
                self.outside(node, kind);
                ExpressionKind::Other
            }
        };
        Expression { kind, span: span(node) }
    }

    fn index(&mut self, node: Node) -> ExpressionKind {
        let indices: Vec<_> = fields(node, "index").into_iter().filter(|n| n.is_named()).collect();
        let [index] = indices[..] else {
            self.outside(node, "more than one index");
            return ExpressionKind::Other;
        };
        ExpressionKind::Index {
            array: Box::new(self.field(node, "object")),
            index: Box::new(self.expression(index)),
        }
    }

    fn operator(&self, node: Node) -> String {
        node.child_by_field_name("operator").map_or(String::new(), |n| self.text(n).to_ascii_uppercase())
    }

    fn unary(&mut self, node: Node) -> ExpressionKind {
        let operator = match self.operator(node).as_str() {
            "NOT" => Unary::Not,
            "-" => Unary::Minus,
            other => {
                self.outside(node, other);
                return ExpressionKind::Other;
            }
        };
        ExpressionKind::Unary { operator, operand: Box::new(self.field(node, "operand")) }
    }

    fn binary(&mut self, node: Node) -> ExpressionKind {
        let operator = match self.operator(node).as_str() {
            "OR" => Binary::Or,
            "XOR" => Binary::Xor,
            "AND" => Binary::And,
            "=" => Binary::Equal,
            "<>" => Binary::Unequal,
            "<" => Binary::Less,
            ">" => Binary::Greater,
            "<=" => Binary::LessOrEqual,
            ">=" => Binary::GreaterOrEqual,
            "+" => Binary::Add,
            "-" => Binary::Subtract,
            "*" => Binary::Multiply,
            "/" => Binary::Divide,
            "MOD" => Binary::Modulo,
            other => {
                self.outside(node, other);
                return ExpressionKind::Other;
            }
        };
        let (left, right) = (self.field(node, "left"), self.field(node, "right"));
        ExpressionKind::Binary { operator, left: Box::new(left), right: Box::new(right) }
    }

    /// None, with a finding, if what is called is not a plain name.
    pub(super) fn call(&mut self, node: Node) -> Option<Call> {
        let function = node.child_by_field_name("function")?;
        if function.kind() != "identifier" {
            self.outside(function, "a call of what is not a name");
            return None;
        }
        let mut arguments = Vec::new();
        if let Some(list) = node.child_by_field_name("arguments") {
            for child in super::children(list).into_iter().filter(|n| n.is_named() && n.kind() != "comment") {
                arguments.push(self.argument(child));
            }
        }
        Some(Call { name: self.name(function), arguments })
    }

    fn argument(&mut self, node: Node) -> Argument {
        if node.kind() != "named_argument" {
            return Argument { name: None, value: self.expression(node), span: span(node) };
        }
        if super::children(node).iter().any(|n| n.kind() == "=>") {
            self.outside(node, "=>");
        }
        Argument {
            name: Some(self.name_of(node, "name")),
            value: self.field(node, "value"),
            span: span(node),
        }
    }
}

fn of_expression(node: Node) -> Option<Node> {
    super::children(node).into_iter().find(|n| n.is_named() && n.kind() != "comment")
}
