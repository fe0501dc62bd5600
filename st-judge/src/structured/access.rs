//! What a name refers to, with indices and fields behind it.

use super::body::Body;
use super::types::Ty;
use super::units::{Section, Signature};
use std::collections::BTreeMap;
use tree_sitter::Node;

/// The variables of a unit by their names in lower case.
pub struct Scope {
    variables: BTreeMap<String, (String, Section, Ty)>,
    /// Of a function: its value.
    result: Option<String>,
    is_program: bool,
}

impl Scope {
    pub fn of(signature: &Signature) -> Self {
        let of = signature.variables.iter();
        let of = of.map(|v| (v.name.to_ascii_lowercase(), (v.name.clone(), v.section, v.ty.clone())));
        Self {
            variables: of.collect(),
            result: signature.is_function.then(|| signature.name.to_ascii_lowercase()),
            is_program: signature.is_program,
        }
    }
}

/// A place in a variable.
pub struct Access {
    /// With a point behind it; empty unless it is an output of a block.
    instance: String,
    name: String,
    /// Of the element, as the portable core counts it.
    index: Option<String>,
    pub ty: Ty,
    /// A value may be stored here.
    pub is_writable: bool,
    /// The global that it is, by its name.
    pub global: Option<String>,
    /// The whole variable.
    pub is_whole: bool,
}

impl Access {
    /// One of its leaves.
    pub fn leaf(&self, suffix: &str) -> String {
        let index = self.index.as_ref().map(|index| format!("[{index}]")).unwrap_or_default();
        format!("{}{}{suffix}{index}", self.instance, self.name)
    }
}

impl Body<'_> {
    pub fn access(&mut self, node: Node) -> Result<Access, String> {
        match node.kind() {
            "identifier" => self.variable(node),
            "index_expression" => {
                let Some(object) = node.child_by_field_name("object") else {
                    return Err(self.object.wrong(node, "nothing to be indexed"));
                };
                let mut access = self.access(object)?;
                let mut cursor = node.walk();
                let indices: Vec<Node> = node.children_by_field_name("index", &mut cursor).collect();
                for index in indices.into_iter().filter(|index| index.is_named()) {
                    let Ty::Array(n, element) = access.ty else {
                        return Err(self.object.wrong(node, "no array"));
                    };
                    let index = self.code(index)?;
                    access.index = Some(match access.index {
                        None => index,
                        Some(outer) => format!("(({outer}) * {n}) + ({index})"),
                    });
                    access.ty = *element;
                    access.is_whole = false;
                }
                Ok(access)
            }
            "member_access_expression" => {
                let Some(object) = node.child_by_field_name("object") else {
                    return Err(self.object.wrong(node, "nothing that has members"));
                };
                let mut access = self.access(object)?;
                let member = self.object.field(node, "member");
                match &access.ty {
                    Ty::Structure(structure) => {
                        let Some((field, ty)) = self.known.types.field(structure, member) else {
                            return Err(self.object.wrong(node, "no such field"));
                        };
                        access.name += &format!("_{field}");
                        access.ty = ty.clone();
                        access.is_whole = false;
                        Ok(access)
                    }
                    Ty::Block(block) => {
                        let variable = self.known.signatures.get(block).and_then(|s| s.variable(member));
                        let Some(variable) = variable.filter(|v| v.section == Section::Output) else {
                            return Err(self.object.wrong(node, "no such output"));
                        };
                        Ok(Access {
                            instance: format!("{}.", access.name),
                            name: variable.name.clone(),
                            index: None,
                            ty: variable.ty.clone(),
                            is_writable: false,
                            global: None,
                            is_whole: true,
                        })
                    }
                    _ => Err(self.object.wrong(node, "it has no members")),
                }
            }
            _ => Err(self.object.wrong(node, "no variable")),
        }
    }

    fn variable(&mut self, node: Node) -> Result<Access, String> {
        let written = self.object.text(node);
        let key = written.to_ascii_lowercase();
        let of = |name: &str, ty: Ty, is_writable: bool, global: Option<String>| Access {
            instance: String::new(),
            name: name.into(),
            index: None,
            ty,
            is_writable,
            global,
            is_whole: true,
        };
        if self.scope.result.as_ref() == Some(&key) {
            return Ok(of(written, Ty::Basic(String::new()), true, None));
        }
        if let Some((name, section, ty)) = self.scope.variables.get(&key)
            && *section != Section::InOut
        {
            let is_writable = matches!(section, Section::Output | Section::Own);
            return Ok(of(name, ty.clone(), is_writable, None));
        }
        // What is passed by reference is the global of the same name: each call is held to that.
        let is_reference = self.scope.variables.contains_key(&key);
        let Some(global) = self.known.lists.globals.get(&key) else {
            return Err(self.object.wrong(node, "neither a variable of the unit nor a global"));
        };
        if is_reference || self.scope.is_program {
            self.uses(global);
            return Ok(of(&global.name, global.ty.clone(), !global.is_constant, Some(key)));
        }
        Err(self.object.wrong(node, "a block reads a global that it was not given"))
    }
}
