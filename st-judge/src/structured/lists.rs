//! Lists of global variables.

use super::initial::Value;
use super::types::{Leaf, Ty, Types};
use super::{Parsed, children};
use std::collections::{BTreeMap, BTreeSet};
use tree_sitter::Node;

/// By their names in lower case.
#[derive(Default)]
pub struct Lists {
    pub globals: BTreeMap<String, Global>,
}

pub struct Global {
    pub name: String,
    pub ty: Ty,
    pub leaves: Vec<Leaf>,
    pub is_retained: bool,
    pub is_constant: bool,
    address: String,
    /// Of a single value, with its `:=`.
    initial: String,
    /// The elements and fields that have a value, as statements.
    pub stores: String,
}

impl Global {
    /// Its declarations.
    pub fn lines(&self) -> String {
        let line = |leaf: &Leaf| {
            let (name, address, initial) = (&self.name, &self.address, &self.initial);
            format!("{name}{}{address} : {}{initial};\n", leaf.suffix, leaf.ty())
        };
        self.leaves.iter().map(line).collect()
    }
}

impl Lists {
    pub fn read(&mut self, object: &Parsed, node: Node, types: &Types) -> Result<(), String> {
        for block in children(node).into_iter().filter(|n| n.kind() == "var_global") {
            let (mut is_retained, mut is_constant) = (false, false);
            for line in children(block) {
                match line.kind() {
                    "var_qualifier_list" => {
                        let words = object.text(line).to_ascii_uppercase();
                        is_retained = words.split_whitespace().any(|word| word == "RETAIN");
                        is_constant = words.split_whitespace().any(|word| word == "CONSTANT");
                    }
                    "variable_declaration" => {
                        let global = global(object, line, types)?;
                        let global = Global { is_retained, is_constant, ..global };
                        if is_retained && !global.stores.is_empty() {
                            return Err(object.wrong(line, "a value would overwrite what is retained"));
                        }
                        let known = self.globals.insert(global.name.to_ascii_lowercase(), global);
                        if known.is_some() {
                            return Err(object.wrong(line, "a second global of this name"));
                        }
                    }
                    _ => {}
                }
            }
        }
        Ok(())
    }
}

fn global(object: &Parsed, line: Node, types: &Types) -> Result<Global, String> {
    let name = object.field(line, "names").to_string();
    let declared = line.child_by_field_name("type").ok_or_else(|| object.wrong(line, "no type"))?;
    let ty = types.ty(object, declared)?;
    if matches!(ty, Ty::Block(_)) {
        return Err(object.wrong(declared, "no such type"));
    }
    let address = object.field(line, "address");
    let address = if address.is_empty() { String::new() } else { format!(" AT {address}") };
    let mut initial = String::new();
    if let Some(value) = line.child_by_field_name("initial_value") {
        initial = format!(" := {}", constant(object, value, &ty, types)?);
    }
    let mut stores = String::new();
    let list = object.initials.iter().find(|(at, _)| line.byte_range().contains(at));
    if let Some((_, value)) = list {
        store(&name, None, &ty, value, types, &mut stores)
            .ok_or_else(|| object.wrong(line, "the value is not of its type"))?;
    }
    let leaves = types.leaves(&ty);
    Ok(Global { name, ty, leaves, is_retained: false, is_constant: false, address, initial, stores })
}

/// A constant as the portable core writes it.
pub fn constant(object: &Parsed, node: Node, ty: &Ty, types: &Types) -> Result<String, String> {
    match ty {
        Ty::Enumeration(name) => {
            let text = object.text(node);
            let member = text.split_once('.').filter(|(ty, _)| ty.eq_ignore_ascii_case(name));
            let value = member.and_then(|(_, member)| types.member(name, member));
            value.map(|v| v.to_string()).ok_or_else(|| object.wrong(node, "no member of its type"))
        }
        Ty::Basic(_) => Ok(object.text(node).to_string()),
        _ => Err(object.wrong(node, "no value of this type")),
    }
}

/// Statements that give a variable its value; None if the value is not of the type.
fn store(
    name: &str,
    index: Option<usize>,
    ty: &Ty,
    value: &Value,
    types: &Types,
    out: &mut String,
) -> Option<()> {
    match (ty, value) {
        (Ty::Array(n, element), Value::List(values)) => {
            // The values of several dimensions stand in one list.
            let rows: Vec<Value> = match **element {
                Ty::Array(each, _) => values.chunks(each).map(|row| Value::List(row.to_vec())).collect(),
                _ => values.clone(),
            };
            if rows.len() != *n {
                return None;
            }
            for (i, value) in rows.iter().enumerate() {
                store(name, Some(index.unwrap_or(0) * n + i), element, value, types, out)?;
            }
        }
        (Ty::Structure(structure), Value::Fields(values)) => {
            // Fields that are not written keep the zero that memory begins with; none is written twice.
            let names: BTreeSet<String> = values.iter().map(|(field, _)| field.to_lowercase()).collect();
            if names.len() != values.len() {
                return None;
            }
            for (field, value) in values {
                let (field, ty) = types.field(structure, field)?;
                store(&format!("{name}_{field}"), index, ty, value, types, out)?;
            }
        }
        (Ty::Basic(_) | Ty::Enumeration(_), Value::Single(text)) => {
            let text = match ty {
                Ty::Enumeration(enumeration) => {
                    let (of, member) = text.split_once('.')?;
                    of.eq_ignore_ascii_case(enumeration).then_some(())?;
                    types.member(enumeration, member)?.to_string()
                }
                _ => text.clone(),
            };
            let index = index.map(|i| format!("[{i}]")).unwrap_or_default();
            *out += &format!("{name}{index} := {text};\n");
        }
        _ => return None,
    }
    Some(())
}
