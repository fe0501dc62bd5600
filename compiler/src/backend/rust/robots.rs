//! What the layout fixes for each robot: a module for each type.

use super::context::Shared;
use super::format::Unformatted;
use super::{render, tables, used_types};
use crate::ir::{AutomatonId, Extent, InterfaceId, Scalar, Value};
use askama::Template;

#[derive(Template)]
#[template(path = "rust/controllers/robots.rs")]
struct Modules<'a> {
    modules: Vec<&'a str>,
}

pub fn modules(shared: Shared) -> Unformatted {
    let used = used_types(shared.system).into_iter();
    let mut modules: Vec<&str> = used.map(|id| shared.names.automata[id.0].module.as_str()).collect();
    modules.sort_unstable();
    Unformatted::Bare(render(&Modules { modules }))
}

#[derive(Template)]
#[template(path = "rust/controllers/robots_of_type.rs")]
struct OfType<'a> {
    ty: &'a str,
    module: &'a str,
    robots: Vec<Robot<'a>>,
}

struct Robot<'a> {
    name: &'a str,
    constant: &'a str,
    /// As it is published with a fault.
    number: usize,
    /// What each role holds, by names.
    roles: Vec<String>,
    /// Laid out, each with its comma.
    fields: Vec<String>,
}

/// The robots of a type, in layout order.
pub fn of_type(shared: Shared, id: AutomatonId) -> Unformatted {
    let names = &shared.names.automata[id.0];
    let numbers = (0..shared.system.instances.len())
        .filter(|number| shared.system.instances[*number].automaton == id)
        .map(|number| robot(shared, number));
    let view = OfType { ty: &names.ty, module: &names.module, robots: numbers.collect() };
    let text = render(&view);
    drop(view);
    Unformatted::Long(text, shared.importable("crate"))
}

fn robot<'a>(shared: Shared<'a>, number: usize) -> Robot<'a> {
    let system = shared.system;
    let instance = &system.instances[number];
    let automaton = system.automaton_of(number);
    let names = &shared.names.automata[instance.automaton.0];
    let mut fields = Vec::new();
    for ((parameter, name), values) in
        automaton.parameters.iter().zip(&names.parameters).zip(&instance.parameters)
    {
        let values: Vec<String> = values.iter().map(|v| shared.value(parameter.ty.scalar, *v)).collect();
        fields.push(match parameter.ty.extent {
            Extent::One => format!("    {name}: {},\n", values.concat()),
            _ => tables::list(4, &format!("{name}: Array(["), &values, "]),"),
        });
    }
    let mut roles = Vec::new();
    for ((role, name), rows) in automaton.roles.iter().zip(&names.roles).zip(&instance.roles) {
        let references: Vec<String> =
            rows.iter().map(|row| reference(shared, role.interface, *row)).collect();
        fields.push(tables::list(4, &format!("{name}: &["), &references, "],"));
        let members: Vec<String> = (rows.iter())
            .map(|row| format!("`{}`", system.instances[system.members[role.interface.0][*row]].name))
            .collect();
        if !members.is_empty() {
            roles.push(format!("`{name}`: {}", members.join(", ")));
        }
    }
    for ((implements, name), row) in automaton.implements.iter().zip(&names.rows).zip(&instance.rows) {
        fields.push(format!("    {name}: {},\n", reference(shared, implements.interface, *row)));
    }
    Robot { name: &instance.name, constant: &shared.names.robots[number], number, roles, fields }
}

fn reference(shared: Shared, interface: InterfaceId, row: usize) -> String {
    shared.value(Scalar::Ref(interface), Value::Int(row as i32))
}
