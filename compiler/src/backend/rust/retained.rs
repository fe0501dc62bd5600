//! What outlasts a loss of power: methods that write it as words, and read it again.

use super::context::{Context, Shared};
use super::format::Unformatted;
use super::{automaton, render};
use crate::ir::{Automaton, Extent, Scalar, Type};
use askama::Template;
use runtime_sim::device::{LAST_COMMAND, PortType};

#[derive(Template)]
#[template(path = "rust/controllers/retained.rs")]
struct Module {
    enums: Vec<String>,
    references: Vec<String>,
}

/// What a robot that retains something is given as methods.
pub struct Methods {
    pub put: Vec<String>,
    pub take: Vec<String>,
    /// Parameters, with a comma before them.
    pub cells_read: &'static str,
    pub cells_write: &'static str,
}

pub fn module(shared: Shared) -> Unformatted {
    let interfaces = shared.names.interfaces.iter();
    let view = Module {
        enums: shared.names.enums.iter().map(|e| e.ty.clone()).collect(),
        references: interfaces.map(|interface| interface.reference.clone()).collect(),
    };
    let mut importable = shared.importable("crate");
    importable.retain(|(module, _)| module != "crate::retained");
    Unformatted::Module(render(&view), importable)
}

/// Whether any robot of the line has cells.
pub fn has_cells(shared: Shared) -> bool {
    shared.system.model.interfaces.iter().any(|interface| !interface.cells.is_empty())
}

/// Whether any type has cells of its own.
pub fn has_owned_cells(shared: Shared) -> bool {
    let mut implemented = shared.system.model.automata.iter().flat_map(|automaton| &automaton.implements);
    implemented.any(|i| !shared.system.model.interface(i.interface).cells.is_empty())
}

/// Whether any robot of the line retains cells.
pub fn retains_cells(shared: Shared) -> bool {
    shared.system.model.automata.iter().any(|automaton| !automaton.retained.cells.is_empty())
}

fn has_own_cells(context: &Context) -> bool {
    let mut interfaces = context.automaton().implements.iter().map(|i| i.interface);
    interfaces.any(|id| !context.system.model.interface(id).cells.is_empty())
}

/// With a comma before it; `access` is `&` or `&mut `.
pub fn cells_parameter(context: &Context, access: &str) -> &'static str {
    match (has_own_cells(context), access) {
        (false, _) => "",
        (true, "&") => ", cells: &Cells",
        (true, _) => ", cells: &mut Cells",
    }
}

pub fn cells_argument(context: &Context) -> &'static str {
    if has_own_cells(context) { "cells" } else { "" }
}

/// Statements that set the initial values of the cells of a robot.
pub fn own_cells(context: &Context) -> Vec<String> {
    let implements = context.automaton().implements.iter();
    let with_cells = implements.filter(|i| !context.system.model.interface(i.interface).cells.is_empty());
    let statement = |implemented: &crate::ir::Implements| {
        let names = &context.names.interfaces[implemented.interface.0];
        let row = context.own_row(implemented.interface);
        format!("cells.{}[{row}] = {}::NEW;", names.field, names.cells)
    };
    with_cells.map(statement).collect()
}

pub fn methods(context: &Context) -> Option<Methods> {
    let automaton = context.automaton();
    if automaton.retained.is_empty() {
        return None;
    }
    let values = values(context);
    let mut put: Vec<String> = Vec::new();
    let mut take = Vec::new();
    if automaton.retained.state {
        put.push("Retained::put(self.state as i32, put);".into());
        take.push(state(context, automaton));
    }
    for (place, ty) in &values {
        put.push(format!("Retained::put({place}, put);"));
        take.push(format!("{place} = {};", taken(context, *ty)));
    }
    take.extend(commands_at_the_beginning(context, automaton));
    if let (Some(abandoned), Some(interrupted)) = (automaton.abandoned, automaton.interrupted)
        && automaton.retained.state
    {
        let [abandoned, interrupted] = [abandoned, interrupted].map(|local| &context.own().locals[local]);
        take.push(format!("self.{abandoned} = self.outputs.cmd != 0;"));
        let first = &context.own().states[0];
        take.push(format!("self.{interrupted} = self.{abandoned} && self.state != State::{first};"));
    }
    let has_cells = !automaton.retained.cells.is_empty();
    Some(Methods {
        put,
        take,
        cells_read: if has_cells { ", cells: &Cells" } else { "" },
        cells_write: if has_cells { ", cells: &mut Cells" } else { "" },
    })
}

/// The argument of [`Methods`], if there is one.
pub fn argument(context: &Context) -> &'static str {
    if context.automaton().retained.cells.is_empty() { "" } else { "cells, " }
}

/// Places of what is retained beside the state, with their types.
fn values(context: &Context) -> Vec<(String, Type)> {
    let automaton = context.automaton();
    let retained = &automaton.retained;
    let mut values = Vec::new();
    for (number, (local, name)) in automaton.locals.iter().zip(&context.own().locals).enumerate() {
        if retained.locals.contains(&number) {
            values.push((format!("self.{name}"), local.ty));
        }
    }
    for implemented in &automaton.implements {
        let names = &context.names.interfaces[implemented.interface.0];
        let row = context.own_row(implemented.interface);
        let cells = context.system.model.interface(implemented.interface).cells.iter();
        for (number, (cell, name)) in cells.zip(&names.cell).enumerate() {
            if retained.cells.contains(&(implemented.interface, number)) {
                values.push((format!("cells.{}[{row}].{name}", names.field), cell.ty));
            }
        }
    }
    for (number, (port, name)) in automaton.device.ports.iter().zip(&context.own().ports).enumerate() {
        let is_command = automaton.device.is_commanded() && matches!(port.name.as_str(), "cmd" | "verb");
        let is_kept = retained.ports.contains(&number) || retained.state && is_command;
        if !is_kept {
            continue;
        }
        let scalar = match port.ty {
            // It is one of the commands, or 0 before the first.
            PortType::Int { .. } if port.name == "cmd" => Scalar::Int { lo: 0, hi: LAST_COMMAND },
            ty => Scalar::from(ty),
        };
        values.push((format!("self.outputs.{name}"), Type { scalar, extent: Extent::from(port.extent) }));
    }
    values
}

/// From the beginning no earlier command is finished.
fn commands_at_the_beginning(context: &Context, of: &Automaton) -> Option<String> {
    let retained = of.outputs_that_stop().filter(|port| of.retained.ports.contains(port));
    let anew = retained.map(|number| {
        let value = automaton::first_value(context, &of.device.ports[number]);
        format!("self.outputs.{} = {value};", context.own().ports[number])
    });
    let anew: String = anew.collect();
    let first = &context.own().states[0];
    match (anew.is_empty(), of.retained.state) {
        (true, _) => None,
        (false, true) => Some(format!("if self.state == State::{first} {{ {anew} }}")),
        (false, false) => Some(anew),
    }
}

fn taken(context: &Context, ty: Type) -> String {
    let bounds = match ty.scalar {
        Scalar::Int { lo, hi } => Some((lo, hi)),
        Scalar::Time => Some((0, i32::MAX)),
        _ => None,
    };
    match (bounds, ty.extent) {
        (None, _) => "Retained::take(words)?".into(),
        (Some((lo, hi)), Extent::One) => {
            format!("Retained::take(words).filter(|n| ({lo}..={hi}).contains(n))?")
        }
        (Some((lo, hi)), _) => {
            let all = format!("values.0.iter().all(|n| ({lo}..={hi}).contains(n))");
            format!("Retained::take(words).filter(|values: &{}| {all})?", context.ty(ty))
        }
    }
}

/// A state from which it does not continue is its beginning.
fn state(context: &Context, automaton: &Automaton) -> String {
    let names = &context.own().states;
    let resumable: Vec<usize> = automaton.resumable().collect();
    let begins = ranges((0..names.len()).filter(|number| !resumable.contains(number)));
    let goes_on = resumable.iter().map(|number| format!("{number} => State::{},", names[*number]));
    format!(
        "let state: i32 = Retained::take(words)?; self.state = match state {{ {} => State::{}, {} _ => return None, }};",
        begins.join(" | "),
        names[0],
        goes_on.collect::<String>()
    )
}

/// Runs of numbers that follow each other, as patterns.
fn ranges(numbers: impl Iterator<Item = usize>) -> Vec<String> {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for number in numbers {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == number => *last = number,
            _ => runs.push((number, number)),
        }
    }
    let pattern = |(first, last): (usize, usize)| match first == last {
        true => first.to_string(),
        false => format!("{first}..={last}"),
    };
    runs.into_iter().map(pattern).collect()
}
