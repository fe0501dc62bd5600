//! Functions, function blocks and the program.

use super::access::Scope;
use super::body::Body;
use super::lists::constant;
use super::types::Ty;
use super::{DECLARED, Known, Parsed, Types, children};
use std::collections::BTreeMap;
use tree_sitter::Node;

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Section {
    Input,
    Output,
    /// By reference.
    InOut,
    Own,
    Constant,
}

pub struct Declared {
    pub name: String,
    pub section: Section,
    pub ty: Ty,
    is_retained: bool,
    /// With its `:=`.
    initial: String,
}

/// How a unit is called, and what it keeps.
pub struct Signature {
    pub name: String,
    pub is_program: bool,
    pub is_function: bool,
    /// Of a function.
    result: String,
    /// In their order.
    pub variables: Vec<Declared>,
}

impl Signature {
    pub fn read(object: &Parsed, node: Node, types: &Types) -> Result<Self, String> {
        let mut variables: Vec<Declared> = Vec::new();
        for block in children(node) {
            let section = match block.kind() {
                "var_input" => Section::Input,
                "var_output" => Section::Output,
                "var_in_out" => Section::InOut,
                "var_block" => Section::Own,
                "var_temp" | "var_external" | "var_global" => {
                    return Err(object.wrong(block, "no section of a unit"));
                }
                _ => continue,
            };
            let mut words = String::new();
            for line in children(block) {
                match line.kind() {
                    "var_qualifier_list" => words = object.text(line).to_ascii_uppercase(),
                    "variable_declaration" => {
                        let variable = declared(object, line, section, &words, types)?;
                        if variables.iter().any(|known| known.name.eq_ignore_ascii_case(&variable.name)) {
                            return Err(object.wrong(line, "a second variable of this name"));
                        }
                        variables.push(variable);
                    }
                    _ => {}
                }
            }
        }
        Ok(Self {
            name: object.field(node, "name").into(),
            is_program: node.kind() == "program_declaration",
            is_function: node.kind() == "function_declaration",
            result: object.field(node, "return_type").into(),
            variables,
        })
    }

    pub fn variable(&self, name: &str) -> Option<&Declared> {
        self.variables.iter().find(|variable| variable.name.eq_ignore_ascii_case(name))
    }
}

fn declared(
    object: &Parsed,
    line: Node,
    section: Section,
    words: &str,
    types: &Types,
) -> Result<Declared, String> {
    let declared = line.child_by_field_name("type").ok_or_else(|| object.wrong(line, "no type"))?;
    let ty = types.ty(object, declared)?;
    let is_constant = words.contains("CONSTANT");
    let initial = match line.child_by_field_name("initial_value") {
        Some(value) => format!(" := {}", constant(object, value, &ty, types)?),
        None => String::new(),
    };
    Ok(Declared {
        name: object.field(line, "names").into(),
        section: if is_constant { Section::Constant } else { section },
        ty,
        is_retained: words.contains("RETAIN"),
        initial,
    })
}

/// The name of a unit, its text, and the blocks that it has instances of.
pub fn unit(object: &Parsed, node: Node, known: &Known) -> Result<(String, String, Vec<String>), String> {
    let name = object.field(node, "name").to_string();
    let Some(signature) = known.signatures.get(&name.to_ascii_lowercase()) else {
        return Err(object.wrong(node, "no such unit"));
    };
    let mut body = Body { object, known, scope: Scope::of(signature), used: BTreeMap::new() };
    let mut statements = String::new();
    let mut cursor = node.walk();
    for statement in node.children_by_field_name("body", &mut cursor) {
        statements += &body.code(statement)?;
    }
    let word = match (signature.is_program, signature.is_function) {
        (true, _) => "PROGRAM",
        (_, true) => "FUNCTION",
        _ => "FUNCTION_BLOCK",
    };
    let mut text = format!("{word} {name}");
    if signature.is_function {
        text += &format!(" : {}", signature.result);
    }
    text.push('\n');
    for (section, keyword) in
        [(Section::Input, "VAR_INPUT"), (Section::Output, "VAR_OUTPUT"), (Section::Own, "VAR")]
    {
        for is_retained in [false, true] {
            let of = |v: &&Declared| v.section == section && v.is_retained == is_retained;
            let lines: String = signature.variables.iter().filter(of).map(|v| lines(v, known)).collect();
            let retain = if is_retained { " RETAIN" } else { "" };
            if !lines.is_empty() {
                text += &format!("{keyword}{retain}\n{lines}END_VAR\n");
            }
        }
    }
    let stores: String = known.lists.globals.values().map(|global| global.stores.as_str()).collect();
    if signature.is_program && !stores.is_empty() {
        text += &format!("VAR\n{DECLARED} : BOOL;\nEND_VAR\n");
        statements = format!("IF NOT {DECLARED} THEN\n{DECLARED} := TRUE;\n{stores}END_IF;\n{statements}");
        for global in known.lists.globals.values().filter(|global| !global.stores.is_empty()) {
            body.uses(global);
        }
    }
    if !body.used.is_empty() {
        let lines: String = body.used.iter().map(|(name, ty)| format!("{name} : {ty};\n")).collect();
        text += &format!("VAR_EXTERNAL\n{lines}END_VAR\n");
    }
    text += &format!("{statements}END_{word}\n");
    let instances = signature.variables.iter().filter_map(|variable| match &variable.ty {
        Ty::Block(block) => known.signatures.get(block).map(|signature| signature.name.clone()),
        _ => None,
    });
    Ok((name, text, instances.collect()))
}

fn lines(variable: &Declared, known: &Known) -> String {
    if let Ty::Block(block) = &variable.ty {
        let name = known.signatures.get(block).map_or(block.as_str(), |signature| signature.name.as_str());
        return format!("{} : {name};\n", variable.name);
    }
    let line = |leaf: super::types::Leaf| {
        format!("{}{} : {}{};\n", variable.name, leaf.suffix, leaf.ty(), variable.initial)
    };
    known.types.leaves(&variable.ty).into_iter().map(line).collect()
}
