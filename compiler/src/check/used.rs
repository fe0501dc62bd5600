//! The declarations that a set of automata needs.

use crate::source::FileId;
use crate::spec::ast;
use std::collections::BTreeSet;

/// The files with only the automata named, and the interfaces and enumerations that these mention.
pub fn used(files: &[(FileId, ast::File)], automata: &BTreeSet<String>) -> Vec<(FileId, ast::File)> {
    let mut names: BTreeSet<String> = automata.clone();
    loop {
        let before = names.len();
        for (_, file) in files {
            for automaton in &file.automata {
                if names.contains(&automaton.name.value) {
                    names.extend(of_automaton(automaton));
                }
            }
            for interface in &file.interfaces {
                if names.contains(&interface.name.value) {
                    names.extend(interface.parameters.iter().flat_map(|p| of_type(&p.ty)));
                    names.extend(interface.cells.iter().flat_map(|c| of_type(&c.ty)));
                }
            }
        }
        if names.len() == before {
            break;
        }
    }
    files
        .iter()
        .map(|(id, file)| {
            let tree = ast::File {
                enums: file.enums.iter().filter(|e| names.contains(&e.name.value)).cloned().collect(),
                interfaces: file
                    .interfaces
                    .iter()
                    .filter(|i| names.contains(&i.name.value))
                    .cloned()
                    .collect(),
                automata: file.automata.iter().filter(|a| names.contains(&a.name.value)).cloned().collect(),
            };
            (*id, tree)
        })
        .collect()
}

fn of_automaton(automaton: &ast::Automaton) -> Vec<String> {
    let mut names: Vec<String> = automaton.implements.iter().map(|i| i.interface.value.clone()).collect();
    for role in &automaton.roles {
        names.push(role.interface.value.clone());
        names.extend(role.also.iter().map(|n| n.value.clone()));
    }
    names.extend(automaton.parameters.iter().flat_map(|p| of_type(&p.ty)));
    names.extend(automaton.cells.iter().flat_map(|c| of_type(&c.ty)));
    names.extend(automaton.locals.iter().flat_map(|l| of_type(&l.ty)));
    names
}

fn of_type(ty: &ast::Type) -> Vec<String> {
    let mut names = Vec::new();
    if let ast::Scalar::Named(name) = &ty.scalar {
        names.push(name.value.clone());
    }
    if let Some(ast::Expr { kind: ast::ExprKind::Name(name), .. }) = &ty.extent {
        names.push(name.clone());
    }
    names
}
