//! The block that sets cells to what they hold at power-up.

use super::globals::is_retained;
use crate::backend::st::Line;
use crate::backend::st::code::{Ex, Stmt, advance, and, assign, binary, name, not, when, within};
use crate::backend::st::context::Shared;
use crate::backend::st::declaration::{Basic, Unit, Variable};
use crate::backend::st::globals::Table;
use crate::backend::st::name::Name;
use crate::backend::st::names::ELEMENT;
use crate::backend::st::restart::{KEPT, WARM};
use crate::backend::st::value::NOT_RETAINED;
use crate::ir::{Extent, InterfaceId};

/// Counts the elements of an array within a row.
const ITEM: &str = "item_no";

/// With the names of the portable text.
pub fn unit<'a>(shared: Shared, line: &Line) -> Unit<'a> {
    let mut body = vec![when(not(name("cold_start")), vec![Stmt::Return])];
    let retained: Vec<Ex> = ((0..shared.system.model.interfaces.len()).map(InterfaceId))
        .filter(|id| is_retained(shared, line, *id))
        .map(|id| mark(shared, id))
        .collect();
    if !retained.is_empty() {
        let mut is_lost = vec![name(WARM)];
        is_lost.push(not(and(retained.clone())));
        let lost =
            [(WARM, Ex::Bool(false)), ("fault_code", Ex::Int(NOT_RETAINED)), ("fault_robot", Ex::Int(-1))];
        body.push(when(and(is_lost), lost.map(|(name, value)| assign(name, value)).into()));
        body.extend(retained.into_iter().map(|mark| Stmt::Assign(mark, Ex::Bool(true))));
    }
    for id in (0..shared.system.model.interfaces.len()).map(InterfaceId) {
        body.extend(cells(shared, id, line, |table| !table.variable.is_retained));
        let retained = cells(shared, id, line, |table| table.variable.is_retained);
        if !retained.is_empty() {
            body.push(when(not(name(WARM)), retained));
        }
    }
    let used = crate::backend::st::code::names(&body);
    let counters = [(ELEMENT, "number of a row"), (ITEM, "number of an element within it")];
    let counters = counters.into_iter().filter(|(name, _)| used.contains(*name));
    Unit {
        comments: vec!["What shared cells hold at power-up.".into()],
        variables: counters
            .map(|(name, about)| Variable::new(name, Basic::Dint).with_comment(about))
            .collect(),
        name: line.layout.name.clone(),
        inputs: line.layout.inputs.clone(),
        body: body.into(),
        ..Unit::default()
    }
}

/// The mark of the cells of an interface.
fn mark(shared: Shared, id: InterfaceId) -> Ex {
    let rows = shared.names.interfaces[id.0].rows.clone();
    Ex::Part(Box::new(Ex::Element(rows, Box::new(Ex::Int(0)))), KEPT.into())
}

/// Some of the cells of an interface, in all rows.
fn cells(shared: Shared, id: InterfaceId, line: &Line, is_wanted: impl Fn(&Table) -> bool) -> Vec<Stmt> {
    let (interface, names) = (shared.system.model.interface(id), &shared.names.interfaces[id.0]);
    let is_wanted =
        |held: &str| line.globals.cells.iter().any(|table| table.variable.name == held && is_wanted(table));
    let mut body = Vec::new();
    for (cell, held) in interface.cells.iter().zip(&names.cells) {
        let values = shared.constants(cell.ty.scalar, cell.initial);
        let values = held.iter().zip(values).filter(|(held, _)| is_wanted(held));
        let store = |index: Ex| {
            move |(held, value): (&Name, Ex)| {
                Stmt::Assign(Ex::Element(held.clone(), Box::new(index.clone())), value)
            }
        };
        if cell.ty.extent == Extent::One {
            body.extend(values.map(store(name(ELEMENT))));
            continue;
        }
        let each = shared.system.model.elements(cell.ty.extent);
        let mut stores: Vec<Stmt> = values.map(store(within(name(ELEMENT), each, name(ITEM)))).collect();
        if !stores.is_empty() {
            stores.push(advance(ITEM));
            let condition = binary("<", name(ITEM), Ex::Int(each as i32));
            body.push(assign(ITEM, Ex::Int(0)));
            body.push(Stmt::While { condition, body: stores, most: each as u64 });
        }
    }
    if body.is_empty() {
        return body;
    }
    body.push(advance(ELEMENT));
    let rows = shared.system.members[id.0].len().max(1);
    let condition = binary("<", name(ELEMENT), Ex::Int(rows as i32));
    vec![assign(ELEMENT, Ex::Int(0)), Stmt::While { condition, body, most: rows as u64 }]
}
