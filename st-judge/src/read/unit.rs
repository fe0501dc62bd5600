//! Program organisation units and the sections of their variables.

use super::{Reader, children, fields, of_kind};
use crate::finding::Span;
use crate::parse::span;
use crate::view::{Expression, ExpressionKind, Section, TypeKind, TypeName, Unit, UnitKind, Variable};
use tree_sitter::Node;

impl Reader<'_> {
    pub(super) fn unit(&mut self, node: Node) -> Unit {
        let kind = match node.kind() {
            "function_declaration" => UnitKind::Function,
            "function_block_declaration" => UnitKind::Block,
            _ => UnitKind::Program,
        };
        for child in children(node) {
            if matches!(
                child.kind(),
                "method_declaration"
                    | "property_declaration"
                    | "ABSTRACT"
                    | "FINAL"
                    | "EXTENDS"
                    | "IMPLEMENTS"
            ) {
                self.outside(child, child.kind());
            }
        }
        Unit {
            kind,
            name: self.name_of(node, "name"),
            result: node.child_by_field_name("return_type").map(|ty| self.type_name(ty)),
            variables: self.sections(node),
            body: self.statements(node, "body"),
            span: span(node),
        }
    }

    /// The variables of all sections of a unit or a configuration.
    pub(super) fn sections(&mut self, node: Node) -> Vec<Variable> {
        let mut variables = Vec::new();
        for block in children(node) {
            let section = match block.kind() {
                "var_block" => Section::Local,
                "var_input" => Section::Input,
                "var_output" => Section::Output,
                "var_in_out" => Section::InOut,
                "var_external" => Section::External,
                "var_global" => Section::Global,
                "var_temp" | "var_access" | "var_config" => {
                    self.outside(block, block.kind());
                    continue;
                }
                _ => continue,
            };
            let mut is_retained = false;
            for line in children(block).into_iter().filter(|n| n.is_named() && n.kind() != "comment") {
                match line.kind() {
                    "var_qualifier_list" if self.is_retain(line, section) => is_retained = true,
                    "variable_declaration" => self.variables(line, section, is_retained, &mut variables),
                    kind => self.outside(line, kind),
                }
            }
            if of_kind(block, "variable_declaration").is_empty() {
                self.report("empty-section", block, "a section without a variable");
            }
        }
        variables
    }

    fn is_retain(&self, qualifiers: Node, section: Section) -> bool {
        let keeps = matches!(section, Section::Local | Section::Output | Section::Global);
        keeps && self.text(qualifiers).eq_ignore_ascii_case("RETAIN")
    }

    fn variables(&mut self, line: Node, section: Section, is_retained: bool, variables: &mut Vec<Variable>) {
        if let Some(address) = line.child_by_field_name("address")
            && section != Section::Global
        {
            self.outside(address, "AT outside of VAR_GLOBAL");
        }
        let address = line.child_by_field_name("address").map(|at| self.name(at));
        let Some(ty) = line.child_by_field_name("type") else { return };
        let ty = self.type_name(ty);
        let initial = match fields(line, "initial_value").as_slice() {
            [] => None,
            [single] => Some(self.expression(*single)),
            list => {
                let all = Span { start: list[0].start_byte(), end: list[list.len() - 1].end_byte() };
                Some(Expression { kind: ExpressionKind::Other, span: all })
            }
        };
        for name in fields(line, "names").into_iter().filter(|n| n.kind() == "identifier") {
            let name = self.name(name);
            let (address, ty, initial) = (address.clone(), ty.clone(), initial.clone());
            variables.push(Variable { section, is_retained, name, address, ty, initial, span: span(line) });
        }
    }

    pub(super) fn type_name(&mut self, node: Node) -> TypeName {
        let kind = match node.kind() {
            "elementary_type" | "identifier" => TypeKind::Named(self.text(node).into()),
            "array_type" => self.array(node),
            kind => {
                self.outside(node, kind);
                TypeKind::Other
            }
        };
        TypeName { kind, span: span(node) }
    }

    fn array(&mut self, node: Node) -> TypeKind {
        let [range] = of_kind(node, "subrange")[..] else {
            self.outside(node, "an array of more than one dimension");
            return TypeKind::Other;
        };
        match (
            range.child_by_field_name("lower"),
            range.child_by_field_name("upper"),
            node.child_by_field_name("element_type"),
        ) {
            (Some(lower), Some(upper), Some(element)) => TypeKind::Array {
                lower: self.expression(lower),
                upper: self.expression(upper),
                element: Box::new(self.type_name(element)),
            },
            _ => TypeKind::Other,
        }
    }
}
