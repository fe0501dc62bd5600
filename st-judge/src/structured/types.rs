//! Types that objects declare.

use super::{Parsed, children};
use std::collections::BTreeMap;
use tree_sitter::Node;

#[derive(Clone, Debug, PartialEq)]
pub enum Ty {
    Basic(String),
    Enumeration(String),
    Structure(String),
    /// From 0, so many.
    Array(usize, Box<Ty>),
    /// A function block.
    Block(String),
}

/// A variable of the portable core that holds a part of a value.
pub struct Leaf {
    /// Behind the name of the variable.
    pub suffix: String,
    /// Elements of an array.
    pub count: Option<usize>,
    pub basic: String,
}

/// By their names in lower case.
#[derive(Default)]
pub struct Types {
    enumerations: BTreeMap<String, BTreeMap<String, i64>>,
    structures: BTreeMap<String, Vec<(String, Ty)>>,
}

impl Types {
    /// The names of types: one may have fields of another that stands behind it.
    pub fn declare(&mut self, object: &Parsed, node: Node) -> Result<(), String> {
        for (definition, name, inner) in definitions(object, node) {
            if self.enumerations.contains_key(&name) || self.structures.contains_key(&name) {
                return Err(object.wrong(definition, "a second type of this name"));
            }
            match inner.kind() {
                "enumerated_type_inline" => drop(self.enumerations.insert(name, BTreeMap::new())),
                "structure_type_inline" => drop(self.structures.insert(name, Vec::new())),
                _ => return Err(object.wrong(inner, "neither an enumeration nor a structure")),
            }
        }
        Ok(())
    }

    /// The members and fields of types that are declared.
    pub fn read(&mut self, object: &Parsed, node: Node) -> Result<(), String> {
        for (_, name, inner) in definitions(object, node) {
            if let Some(members) = self.enumerations.get_mut(&name) {
                *members = enumeration(object, inner)?;
                continue;
            }
            let fields = self.fields(object, inner)?;
            self.structures.insert(name, fields);
        }
        Ok(())
    }

    fn fields(&self, object: &Parsed, node: Node) -> Result<Vec<(String, Ty)>, String> {
        let mut fields: Vec<(String, Ty)> = Vec::new();
        for field in children(node).into_iter().filter(|n| n.kind() == "structure_field") {
            let name = object.field(field, "name").to_string();
            if fields.iter().any(|(known, _)| known.eq_ignore_ascii_case(&name)) {
                return Err(object.wrong(field, "a second field of this name"));
            }
            if crate::reserved::is_reserved(&name) {
                return Err(object.wrong(field, "the name is a word of the language"));
            }
            let Some(ty) = field.child_by_field_name("type") else { continue };
            fields.push((name, self.ty(object, ty)?));
        }
        Ok(fields)
    }

    /// The type that a node names. A name that is no type here is one of a function block.
    pub fn ty(&self, object: &Parsed, node: Node) -> Result<Ty, String> {
        let text = object.text(node);
        let name = text.to_ascii_lowercase();
        Ok(match node.kind() {
            "elementary_type" => Ty::Basic(text.to_ascii_uppercase()),
            "array_type" => {
                let element = node.child_by_field_name("element_type");
                let element = element.ok_or_else(|| object.wrong(node, "no type of elements"))?;
                let mut ty = self.ty(object, element)?;
                let ranges = children(node).into_iter().filter(|n| n.kind() == "subrange");
                for range in ranges.collect::<Vec<_>>().into_iter().rev() {
                    let bound = |field: &str| object.field(range, field).parse::<usize>().ok();
                    let (Some(0), Some(last)) = (bound("lower"), bound("upper")) else {
                        return Err(object.wrong(range, "an array counts from 0 to a number"));
                    };
                    ty = Ty::Array(last + 1, Box::new(ty));
                }
                ty
            }
            "identifier" if self.enumerations.contains_key(&name) => Ty::Enumeration(name),
            "identifier" if self.structures.contains_key(&name) => Ty::Structure(name),
            "identifier" => Ty::Block(name),
            _ => return Err(object.wrong(node, "a type of another kind")),
        })
    }

    pub fn is_enumeration(&self, name: &str) -> bool {
        self.enumerations.contains_key(&name.to_ascii_lowercase())
    }

    pub fn member(&self, enumeration: &str, member: &str) -> Option<i64> {
        self.enumerations.get(&enumeration.to_ascii_lowercase())?.get(&member.to_ascii_lowercase()).copied()
    }

    /// The fields of a structure, in their order.
    pub fn fields_of(&self, structure: &str) -> &[(String, Ty)] {
        self.structures.get(structure).map_or(&[], Vec::as_slice)
    }

    pub fn field(&self, structure: &str, field: &str) -> Option<(&str, &Ty)> {
        let mut fields = self.fields_of(structure).iter();
        fields.find(|(name, _)| name.eq_ignore_ascii_case(field)).map(|(name, ty)| (name.as_str(), ty))
    }

    pub fn leaves(&self, ty: &Ty) -> Vec<Leaf> {
        match ty {
            Ty::Basic(basic) => vec![Leaf { suffix: String::new(), count: None, basic: basic.clone() }],
            Ty::Enumeration(_) => vec![Leaf { suffix: String::new(), count: None, basic: "DINT".into() }],
            Ty::Block(_) => Vec::new(),
            Ty::Array(n, element) => {
                let of = |leaf: Leaf| Leaf { count: Some(n * leaf.count.unwrap_or(1)), ..leaf };
                self.leaves(element).into_iter().map(of).collect()
            }
            Ty::Structure(name) => {
                let of = |(field, ty): &(String, Ty)| {
                    let leaves = self.leaves(ty).into_iter();
                    leaves
                        .map(|leaf| Leaf { suffix: format!("_{field}{}", leaf.suffix), ..leaf })
                        .collect::<Vec<_>>()
                };
                self.fields_of(name).iter().flat_map(of).collect()
            }
        }
    }
}

/// Definition, name in lower case, and what it is.
fn definitions<'t>(object: &Parsed, node: Node<'t>) -> Vec<(Node<'t>, String, Node<'t>)> {
    let definitions = children(node).into_iter().filter(|n| n.kind() == "type_definition");
    let of = |definition: Node<'t>| {
        let name = object.field(definition, "name").to_ascii_lowercase();
        Some((definition, name, definition.child_by_field_name("definition")?))
    };
    definitions.filter_map(of).collect()
}

fn enumeration(object: &Parsed, node: Node) -> Result<BTreeMap<String, i64>, String> {
    let mut members = BTreeMap::new();
    for member in children(node).into_iter().filter(|n| n.kind() == "enumerator") {
        let name = object.field(member, "name").to_ascii_lowercase();
        let value = object.field(member, "value").parse();
        let value = value.map_err(|_| object.wrong(member, "a member without its number"))?;
        if members.insert(name, value).is_some() {
            return Err(object.wrong(member, "a second member of this name"));
        }
    }
    Ok(members)
}

impl Leaf {
    pub fn ty(&self) -> String {
        match self.count {
            None => self.basic.clone(),
            // The core has no array of one element.
            Some(n) => format!("ARRAY[0..{}] OF {}", n.max(2) - 1, self.basic),
        }
    }
}
