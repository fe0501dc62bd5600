//! The block that sets cells to what they hold at power-up.

use crate::backend::st::Line;
use crate::backend::st::code::{Ex, Stmt, advance, assign, binary, name, not, when, within};
use crate::backend::st::context::Shared;
use crate::backend::st::declaration::{Basic, Unit, Variable};
use crate::backend::st::globals::Table;
use crate::backend::st::names::ELEMENT;
use crate::backend::st::restart::WARM;
use crate::ir::{Extent, InterfaceId};

/// Counts the elements of an array within a row.
const ITEM: &str = "item_no";

/// With the names of the portable text.
pub fn unit(shared: Shared, line: &Line) -> Unit {
    let mut body = vec![when(not(name("cold_start")), vec![Stmt::Return])];
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
        body,
        ..line.layout.clone()
    }
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
            move |(held, value): (&String, Ex)| {
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
