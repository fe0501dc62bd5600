//! Calls of functions and function blocks.

use super::body::Body;
use super::children;
use super::types::Ty;
use super::units::{Declared, Section, Signature};
use tree_sitter::Node;

impl Body<'_> {
    pub fn call(&mut self, node: Node) -> Result<String, String> {
        let Some(function) = node.child_by_field_name("function") else {
            return Err(self.object.wrong(node, "a call of nothing"));
        };
        let name = self.object.text(function).to_string();
        let list = node.child_by_field_name("arguments");
        let arguments: Vec<Node> = list.map(children).unwrap_or_default();
        let arguments: Vec<Node> = arguments.into_iter().filter(|n| n.is_named()).collect();
        let known = self.known;
        if let Some(function) = known.signatures.get(&name.to_ascii_lowercase())
            && function.is_function
        {
            let arguments = self.arguments(node, &arguments, function)?;
            return Ok(format!("{}({})", function.name, arguments.join(", ")));
        }
        let is_standard = arguments.iter().all(|argument| argument.kind() != "named_argument");
        if function.kind() == "identifier" && is_standard && self.access(function).is_err() {
            let arguments: Result<Vec<String>, String> =
                arguments.into_iter().map(|argument| self.code(argument)).collect();
            return Ok(format!("{name}({})", arguments?.join(", ")));
        }
        let instance = self.access(function)?;
        let Ty::Block(block) = &instance.ty else {
            return Err(self.object.wrong(function, "neither a function nor an instance"));
        };
        let Some(block) = known.signatures.get(block) else {
            return Err(self.object.wrong(function, "an instance of no block"));
        };
        let arguments = self.arguments(node, &arguments, block)?;
        Ok(format!("{}({})", instance.leaf(""), arguments.join(", ")))
    }

    /// Named arguments; none may be left out that is passed by reference.
    fn arguments(
        &mut self,
        call: Node,
        arguments: &[Node],
        called: &Signature,
    ) -> Result<Vec<String>, String> {
        let mut out = Vec::new();
        let mut given: Vec<String> = Vec::new();
        for argument in arguments {
            let name = self.object.field(*argument, "name");
            let (Some(parameter), Some(value)) =
                (called.variable(name), argument.child_by_field_name("value"))
            else {
                return Err(self.object.wrong(*argument, "no such argument"));
            };
            given.push(parameter.name.to_ascii_lowercase());
            match parameter.section {
                Section::Input => out.extend(self.argument(parameter, value)?),
                Section::InOut => self.reference(parameter, value)?,
                _ => return Err(self.object.wrong(*argument, "no input")),
            }
        }
        let mut references = called.variables.iter().filter(|v| v.section == Section::InOut);
        if let Some(left_out) = references.find(|v| !given.contains(&v.name.to_ascii_lowercase())) {
            return Err(self.object.wrong(call, &format!("`{}` is not passed", left_out.name)));
        }
        Ok(out)
    }

    fn argument(&mut self, parameter: &Declared, value: Node) -> Result<Vec<String>, String> {
        let name = &parameter.name;
        match &parameter.ty {
            Ty::Basic(_) => Ok(vec![format!("{name} := {}", self.code(value)?)]),
            Ty::Enumeration(enumeration) => {
                if self.enumeration(value)?.as_ref() != Some(enumeration) {
                    return Err(self.object.wrong(value, "no value of the enumeration"));
                }
                Ok(vec![format!("{name} := {}", self.code(value)?)])
            }
            ty => {
                let access = self.access(value)?;
                if access.ty != *ty {
                    return Err(self.object.wrong(value, "a value of another type"));
                }
                let leaves = self.known.types.leaves(ty);
                let of = |suffix: &str| format!("{name}{suffix} := {}", access.leaf(suffix));
                Ok(leaves.iter().map(|leaf| of(&leaf.suffix)).collect())
            }
        }
    }

    /// By reference the global of the same name is passed, and no other.
    fn reference(&mut self, parameter: &Declared, value: Node) -> Result<(), String> {
        let access = self.access(value)?;
        let is_same = access.global.as_deref() == Some(parameter.name.to_ascii_lowercase().as_str());
        if !is_same || !access.is_whole || !access.is_writable || access.ty != parameter.ty {
            return Err(self.object.wrong(value, "not the variable that the reference is to"));
        }
        Ok(())
    }
}
