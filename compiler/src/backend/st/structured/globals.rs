//! Shared variables as structures, with their values where they are declared.

use super::access::Places;
use super::enumerations::Typed;
use super::{Common, POINT, Structure};
use crate::backend::st::Line;
use crate::backend::st::code::Ex;
use crate::backend::st::context::Shared;
use crate::backend::st::declaration::{Basic, Variable};
use crate::backend::st::globals::{Globals, Table, about, meaning, rows};
use crate::backend::st::name::Name;
use crate::backend::st::names::Held;
use crate::backend::st::restart;
use crate::backend::st::values::{Elements, Field, List};
use crate::ir::{Extent, InterfaceId, Scalar};
use std::collections::BTreeMap;
use std::sync::Arc;

pub fn globals(shared: Shared, line: &Line, common: &Common, typed: &Typed) -> (Globals, Vec<Structure>) {
    let places = &common.places;
    let mut structures = vec![point()];
    let mut cells = Vec::new();
    for id in (0..shared.system.model.interfaces.len()).map(InterfaceId) {
        let Some((structure, array)) = interface(shared, line, id, typed) else { continue };
        structures.push(structure);
        cells.push(Table::declared(array));
    }
    let mut alarms = Vec::new();
    if let Some((structure, array)) = table_of_alarms(line) {
        structures.push(structure);
        alarms.push(Table::declared(array));
    }
    let of_robots = line.globals.alarms.iter().filter(|table| places.get(&table.variable.name).is_none());
    alarms.extend(of_robots.map(|table| Table::declared(with_values(table))));
    let globals = Globals {
        system: line.globals.system.clone(),
        ports: common.ports.clone(),
        raw: line.globals.raw.clone(),
        cells,
        parameters: parameters(shared, line, places, typed),
        alarms,
        unread: Vec::new(),
    };
    (globals, structures)
}

/// For each robot its ports, with points as such. None is of an enumeration.
pub fn ports(shared: Shared, line: &Line) -> Vec<Vec<Arc<Variable>>> {
    let robots = shared.names.robots.iter().zip(&*line.globals.ports);
    robots.map(|(names, ports)| with_points(&names.ports, ports)).collect()
}

fn with_points(names: &[Held], mut ports: &[Arc<Variable>]) -> Vec<Arc<Variable>> {
    let mut out = Vec::with_capacity(names.len());
    for held in names {
        let (parts, others) = ports.split_at(held.len());
        match (&held.whole, parts) {
            (Some(whole), [first, ..]) => {
                let structure = Some(POINT.into());
                let point = Variable { name: whole.clone(), structure, initial: None, ..(**first).clone() };
                out.push(Arc::new(point));
            }
            _ => out.extend(parts.iter().cloned()),
        }
        ports = others;
    }
    out
}

fn point() -> Structure {
    let coordinate = |(name, about): (&str, &str)| Variable::new(name, Basic::Lreal).with_comment(about);
    let fields = [("x", "m"), ("y", "m"), ("z", "m")];
    Structure { name: POINT.into(), about: "a point".into(), fields: fields.map(coordinate).into() }
}

/// The cells of an interface that are used.
fn interface(shared: Shared, line: &Line, id: InterfaceId, typed: &Typed) -> Option<(Structure, Variable)> {
    let (interface, names) = (shared.system.model.interface(id), &shared.names.interfaces[id.0]);
    let is_used = |held: &[Name]| line.globals.cells.iter().any(|table| held.contains(&table.variable.name));
    let cells = interface.cells.iter().zip(&names.cells).zip(&names.fields);
    let fields: Vec<Variable> = cells
        .filter(|((_, held), _)| is_used(held))
        .map(|((cell, held), field)| {
            let elements =
                (cell.ty.extent != Extent::One).then(|| shared.system.model.elements(cell.ty.extent));
            let variable = Variable::new(field, Basic::of(cell.ty.scalar)).with_elements(elements);
            Variable {
                comments: about(&cell.doc, meaning(shared, cell.ty.scalar)),
                structure: (cell.ty.scalar == Scalar::Point).then(|| POINT.into()),
                enumeration: typed.get("", &held[0]).cloned(),
                ..variable
            }
        })
        .collect();
    if fields.is_empty() {
        return None;
    }
    let is_retained = is_retained(shared, line, id);
    let mark = is_retained.then(|| restart::mark().retained(false));
    let fields = fields.into_iter().chain(mark).collect();
    let array = Variable {
        structure: Some(names.structure.clone()),
        comments: vec![format!("cells of {}", interface.name).into(), rows(shared, id, None).into()],
        ..Variable::new(&names.rows, Basic::Bool)
    }
    .with_elements(Some(shared.system.members[id.0].len().max(1)))
    .retained(is_retained);
    let about = format!("what each {} shows to others", interface.name);
    Some((Structure { name: names.structure.clone(), about, fields }, array))
}

/// Whether a cell of the interface outlasts a loss of power: then the whole array does.
pub fn is_retained(shared: Shared, line: &Line, id: InterfaceId) -> bool {
    let cells = &shared.names.interfaces[id.0].cells;
    let mut tables = line.globals.cells.iter();
    tables.any(|t| t.variable.is_retained && cells.iter().any(|held| held.contains(&t.variable.name)))
}

fn table_of_alarms(line: &Line) -> Option<(Structure, Variable)> {
    let columns: Vec<(&str, &Table)> = (line.globals.alarms.iter())
        .filter_map(|table| Some((table.variable.name.strip_prefix("alarms_")?, table)))
        .collect();
    let (_, first) = columns.first()?;
    let fields = columns.iter().map(|(name, table)| Variable {
        name: (*name).into(),
        elements: None,
        ..table.variable.clone()
    });
    let column = |(name, table): &(&str, &Table)| Field {
        name: (*name).into(),
        values: table.values.clone(),
        unsaid: Some(table.variable.basic.zero()),
    };
    let values = columns.iter().map(column).collect();
    let count = first.variable.elements.unwrap_or_default();
    let array = Variable {
        structure: Some("ST_Alarm".into()),
        comments: vec!["an entry for each alarm of each robot, see alarms.csv".into()],
        ..Variable::new("alarms", Basic::Bool)
    }
    .with_elements(Some(count))
    .with_initial(Ex::List(List { len: count, elements: Elements::Structures(values) }));
    let about = "an entry of the table of alarms".to_string();
    Some((Structure { name: "ST_Alarm".into(), about, fields: fields.collect() }, array))
}

/// The values of a table in its declaration.
fn with_values(table: &Table) -> Variable {
    let values = (table.values.len() > 0).then(|| Box::new(Ex::List(List::single(table.values.clone()))));
    Variable { initial: values, ..table.variable.clone() }
}

/// Of a point all coordinates, if one of them is read.
fn parameters(shared: Shared, line: &Line, places: &Places, typed: &Typed) -> Vec<Table> {
    let of = |table: &Table| {
        let place = places.get(&table.variable.name)?;
        Some((place.of.clone(), place.coordinate?))
    };
    let globals = &line.globals;
    let mut points: BTreeMap<Name, Vec<(&str, &Table)>> = BTreeMap::new();
    for table in globals.parameters.iter().chain(&globals.unread) {
        if let Some((point, coordinate)) = of(table) {
            points.entry(point).or_default().push((coordinate, table));
        }
    }
    let rows = rows_by_element(shared);
    let mut out = Vec::new();
    for table in &globals.parameters {
        let variable = with_values(table);
        let comments = variable.comments.iter().map(|text| rows.get(text).unwrap_or(text).clone()).collect();
        let variable = Variable { comments, ..variable };
        let variable = match of(table) {
            None => Variable { enumeration: typed.get("", &variable.name).cloned(), ..variable },
            Some((point, _)) => {
                let Some(mut parts) = points.remove(&point) else { continue };
                parts.sort_by_key(|(coordinate, _)| *coordinate);
                let first = parts[0].1;
                let fields = parts.iter().map(|(coordinate, table)| Field {
                    name: (*coordinate).into(),
                    values: table.values.clone(),
                    unsaid: None,
                });
                let elements = Elements::Structures(fields.collect());
                let initial = Some(Box::new(Ex::List(List { len: first.values.len(), elements })));
                let comments = first.variable.comments.iter();
                let comments = comments.map(|text| rows.get(text).unwrap_or(text).clone()).collect();
                let structure = Some(POINT.into());
                Variable { name: point, structure, initial, comments, ..variable }
            }
        };
        out.push(Table::declared(variable));
    }
    out
}

/// What is said of an array with so many elements for each row, and what of one of two dimensions.
fn rows_by_element(shared: Shared) -> BTreeMap<Arc<str>, Arc<str>> {
    let mut texts = BTreeMap::new();
    let model = &shared.system.model;
    let mut add = |id: InterfaceId, each: usize| {
        texts.insert(rows(shared, id, Some(each)).into(), rows(shared, id, None).into());
    };
    for (i, interface) in model.interfaces.iter().enumerate() {
        for parameter in interface.parameters.iter().filter(|p| p.ty.extent != Extent::One) {
            add(InterfaceId(i), model.elements(parameter.ty.extent));
        }
    }
    for (relation, reaches) in model.relations.iter().zip(&shared.system.reaches) {
        add(relation.from, reaches.first().map_or(0, Vec::len));
    }
    texts
}
