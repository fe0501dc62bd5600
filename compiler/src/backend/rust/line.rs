//! The values of a layout, as constants.

use super::context::Shared;
use super::{format, render};
use crate::ir::{InterfaceId, Scalar, Value};
use askama::Template;

#[derive(Template)]
#[template(path = "rust/controllers/robots.rs")]
struct Robots<'a> {
    modules: &'a [String],
}

pub fn robots(shared: Shared) -> String {
    format::print(&render(&Robots { modules: &shared.names.robots }))
}

#[derive(Template)]
#[template(path = "rust/controllers/instance.rs")]
struct Robot<'a> {
    name: &'a str,
    /// As it is published with a fault.
    number: usize,
    ty: &'a str,
    module: &'a str,
    /// What each role holds, by names.
    roles: Vec<String>,
    fields: Vec<(String, String)>,
}

pub fn robot(shared: Shared, number: usize) -> String {
    let system = shared.system;
    let instance = &system.instances[number];
    let automaton = system.automaton_of(number);
    let names = &shared.names.automata[instance.automaton.0];
    let mut fields = Vec::new();
    for ((parameter, name), values) in
        automaton.parameters.iter().zip(&names.parameters).zip(&instance.parameters)
    {
        fields.push((name.clone(), shared.elements(parameter.ty, values)));
    }
    let mut roles = Vec::new();
    for ((role, name), rows) in automaton.roles.iter().zip(&names.roles).zip(&instance.roles) {
        let references: Vec<String> =
            rows.iter().map(|row| reference(shared, role.interface, *row)).collect();
        fields.push((name.clone(), format!("&[{}]", references.join(", "))));
        let members: Vec<String> = (rows.iter())
            .map(|row| format!("`{}`", system.instances[system.members[role.interface.0][*row]].name))
            .collect();
        if !members.is_empty() {
            roles.push(format!("`{name}`: {}", members.join(", ")));
        }
    }
    for ((implements, name), row) in automaton.implements.iter().zip(&names.rows).zip(&instance.rows) {
        fields.push((name.clone(), reference(shared, implements.interface, *row)));
    }
    let view = Robot { name: &instance.name, number, ty: &names.ty, module: &names.module, roles, fields };
    format::module(&render(&view), &shared.importable("crate"))
}

fn reference(shared: Shared, interface: InterfaceId, row: usize) -> String {
    shared.value(Scalar::Ref(interface), Value::Int(row as i32))
}

#[derive(Template)]
#[template(path = "rust/controllers/line.rs")]
struct Line {
    scan_ms: i32,
    interfaces: Vec<InterfaceView>,
    relations: Vec<(String, String)>,
    robots: Vec<RobotView>,
    types: Vec<(String, String)>,
    has_cells: bool,
}

struct InterfaceView {
    field: String,
    constant: String,
    cells_type: String,
    has_cells: bool,
    parameters_type: String,
    has_parameters: bool,
    /// Values of each row, as fields.
    rows: Vec<Vec<(String, String)>>,
    count: usize,
}

struct RobotView {
    ty: String,
    module: String,
}

pub fn line(shared: Shared) -> String {
    let system = shared.system;
    let interfaces: Vec<InterfaceView> =
        (0..system.model.interfaces.len()).map(|i| interface(shared, i)).collect();
    let relations = system.reaches.iter().zip(&shared.names.relations).map(|(rows, name)| {
        let rows: Vec<String> = rows
            .iter()
            .map(|row| format!("&[{}]", row.iter().map(bool::to_string).collect::<Vec<_>>().join(", ")))
            .collect();
        (name.clone(), format!("Relation(&[{}])", rows.join(", ")))
    });
    let robots = system.instances.iter().zip(&shared.names.robots).map(|(instance, module)| RobotView {
        ty: shared.names.automata[instance.automaton.0].ty.clone(),
        module: module.clone(),
    });
    let is_used = |id: usize| system.instances.iter().any(|i| i.automaton.0 == id);
    let types = shared.names.automata.iter().enumerate().filter(|(id, _)| is_used(*id));
    let view = Line {
        scan_ms: system.scan_ms,
        relations: relations.collect(),
        robots: robots.collect(),
        types: types.map(|(_, a)| (a.module.clone(), a.ty.clone())).collect(),
        has_cells: interfaces.iter().any(|i| i.has_cells),
        interfaces,
    };
    format::module(&render(&view), &shared.importable("crate"))
}

fn interface(shared: Shared, id: usize) -> InterfaceView {
    let system = shared.system;
    let source = &system.model.interfaces[id];
    let names = &shared.names.interfaces[id];
    let members = &system.members[id];
    let row = |instance: &usize| -> Vec<(String, String)> {
        let automaton = system.automaton_of(*instance);
        let own = &shared.names.automata[system.instances[*instance].automaton.0];
        let Some(implements) = automaton.implements.iter().find(|i| i.interface.0 == id) else {
            return Vec::new();
        };
        let value = |supplied: usize| {
            format!("robots::{}::PARAMETERS.{}", shared.names.robots[*instance], own.parameters[supplied])
        };
        (names.parameter.iter().zip(&implements.parameters))
            .map(|(name, supplied)| (name.clone(), value(*supplied)))
            .collect()
    };
    InterfaceView {
        field: names.field.clone(),
        constant: names.constant.clone(),
        cells_type: names.cells.clone(),
        has_cells: !source.cells.is_empty(),
        parameters_type: names.parameters.clone(),
        has_parameters: !source.parameters.is_empty(),
        rows: members.iter().map(row).collect(),
        count: members.len(),
    }
}
