//! Statements and expressions.

use super::access::Scope;
use super::lists::Global;
use super::types::Ty;
use super::{Known, Parsed, children};
use std::collections::BTreeMap;
use tree_sitter::Node;

/// The operators that an enumeration may be an operand of.
const COMPARISONS: [&str; 6] = ["=", "<>", "<", ">", "<=", ">="];

pub struct Body<'a> {
    pub object: &'a Parsed<'a>,
    pub known: &'a Known<'a>,
    pub scope: Scope,
    /// The globals that are named, with their types.
    pub used: BTreeMap<String, String>,
}

impl Body<'_> {
    pub fn uses(&mut self, global: &Global) {
        for leaf in &global.leaves {
            self.used.insert(format!("{}{}", global.name, leaf.suffix), leaf.ty());
        }
    }

    /// A node as the portable core has it.
    pub fn code(&mut self, node: Node) -> Result<String, String> {
        match node.kind() {
            "comment" | "pragma" => Ok(String::new()),
            "assignment_statement" => self.assignment(node),
            "call_expression" => self.call(node),
            "identifier" | "index_expression" => self.read(node),
            "member_access_expression" => match self.member(node)? {
                Some(number) => Ok(number),
                None => self.read(node),
            },
            "binary_expression" => {
                let operator = self.object.field(node, "operator").to_string();
                for side in ["left", "right"] {
                    let Some(side) = node.child_by_field_name(side) else { continue };
                    if self.enumeration(side)?.is_some() && !COMPARISONS.contains(&operator.as_str()) {
                        return Err(self.object.wrong(node, "a computation with an enumeration"));
                    }
                }
                self.parts(node)
            }
            _ if node.child_count() == 0 => Ok(self.object.text(node).to_string()),
            _ => self.parts(node),
        }
    }

    fn parts(&mut self, node: Node) -> Result<String, String> {
        let mut text = String::new();
        for child in children(node) {
            let part = self.code(child)?;
            let end = if part == ";" { "\n" } else { " " };
            text += &part;
            text += end;
        }
        Ok(text)
    }

    fn read(&mut self, node: Node) -> Result<String, String> {
        let access = self.access(node)?;
        match access.ty {
            Ty::Basic(_) | Ty::Enumeration(_) => Ok(access.leaf("")),
            _ => Err(self.object.wrong(node, "no single value")),
        }
    }

    /// The number of a member of an enumeration.
    fn member(&self, node: Node) -> Result<Option<String>, String> {
        let ty = self.object.field(node, "object");
        if !self.known.types.is_enumeration(ty) {
            return Ok(None);
        }
        let value = self.known.types.member(ty, self.object.field(node, "member"));
        let value = value.ok_or_else(|| self.object.wrong(node, "no such member"))?;
        Ok(Some(value.to_string()))
    }

    /// The enumeration of which a value is.
    pub fn enumeration(&mut self, node: Node) -> Result<Option<String>, String> {
        match node.kind() {
            "member_access_expression" if self.member(node)?.is_some() => {
                Ok(Some(self.object.field(node, "object").to_ascii_lowercase()))
            }
            "identifier" | "index_expression" | "member_access_expression" => {
                Ok(match self.access(node)?.ty {
                    Ty::Enumeration(name) => Some(name),
                    _ => None,
                })
            }
            _ => Ok(None),
        }
    }

    fn assignment(&mut self, node: Node) -> Result<String, String> {
        let (Some(left), Some(right)) = (node.child_by_field_name("left"), node.child_by_field_name("right"))
        else {
            return Err(self.object.wrong(node, "an assignment without its sides"));
        };
        let target = self.access(left)?;
        if !target.is_writable {
            return Err(self.object.wrong(node, "it may not be written"));
        }
        match &target.ty {
            Ty::Structure(_) => {
                let source = self.access(right)?;
                if source.ty != target.ty {
                    return Err(self.object.wrong(node, "structures of two types"));
                }
                let leaves = self.known.types.leaves(&target.ty);
                if leaves.iter().any(|leaf| leaf.count.is_some()) {
                    return Err(self.object.wrong(node, "a structure that holds arrays"));
                }
                let line = |suffix: &str| format!("{} := {};\n", target.leaf(suffix), source.leaf(suffix));
                Ok(leaves.iter().map(|leaf| line(&leaf.suffix)).collect())
            }
            Ty::Enumeration(name) if self.enumeration(right)?.as_ref() != Some(name) => {
                Err(self.object.wrong(node, "no value of the enumeration"))
            }
            Ty::Basic(_) | Ty::Enumeration(_) => {
                let value = self.code(right)?;
                Ok(format!("{} := {value};\n", target.leaf("")))
            }
            _ => Err(self.object.wrong(node, "no value can be assigned to it")),
        }
    }
}
