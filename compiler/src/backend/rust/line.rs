//! The values of a layout, as constants.

use super::context::Shared;
use super::format::Unformatted;
use super::{render, tables, used_types};
use askama::Template;

#[derive(Template)]
#[template(path = "rust/controllers/line.rs")]
struct Line<'a> {
    scan_ms: i32,
    retained_of: Option<u32>,
    interfaces: Vec<InterfaceView>,
    /// Laid out, each with its comma.
    relations: Vec<String>,
    robots: Vec<RobotView<'a>>,
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

struct RobotView<'a> {
    ty: &'a str,
    module: &'a str,
    constant: &'a str,
}

/// `retained_of` is the number of what is retained, if anything is.
pub fn line(shared: Shared, retained_of: Option<u32>) -> Unformatted {
    let system = shared.system;
    let interfaces: Vec<InterfaceView> =
        (0..system.model.interfaces.len()).map(|i| interface(shared, i)).collect();
    let relations = system.reaches.iter().zip(&shared.names.relations);
    let robots = system.instances.iter().zip(&shared.names.robots).map(|(instance, constant)| {
        let names = &shared.names.automata[instance.automaton.0];
        RobotView { ty: &names.ty, module: &names.module, constant }
    });
    let types = used_types(system).into_iter().map(|id| &shared.names.automata[id.0]);
    let view = Line {
        scan_ms: system.scan_ms,
        retained_of,
        relations: relations.map(|(rows, name)| relation(rows, name)).collect(),
        robots: robots.collect(),
        types: types.map(|a| (a.module.clone(), a.ty.clone())).collect(),
        has_cells: interfaces.iter().any(|i| i.has_cells),
        interfaces,
    };
    let text = render(&view);
    drop(view);
    Unformatted::Long(text, shared.importable("crate"))
}

/// A row for each member from which items come, and in it a truth for each to which they may get.
fn relation(rows: &[Vec<bool>], name: &str) -> String {
    let words = |row: &Vec<bool>| -> Vec<&str> {
        row.iter().map(|is_reached| if *is_reached { "true" } else { "false" }).collect()
    };
    let short: Vec<String> = rows.iter().map(|row| format!("&[{}]", words(row).join(", "))).collect();
    let whole = tables::list(4, &format!("{name}: Relation(&["), &short, "]),");
    if whole.lines().count() == 1 {
        return whole;
    }
    let rows: String = rows.iter().map(|row| tables::filled(12, "&[", &words(row), "],")).collect();
    format!("    {name}: Relation(\n        &[\n{rows}        ],\n    ),\n")
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
            let constant = &shared.names.robots[*instance];
            format!("robots::{}::{constant}.{}", own.module, own.parameters[supplied])
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
