//! The values that a machine writes, by name.

use super::value::{Kind, Named};
use crate::ir::Element;
use crate::ir::{Extent, Scalar, System, Type};
use runtime_sim::device::Direction;

/// Words that a value takes in a trace.
pub fn words(ty: Scalar) -> usize {
    if ty == Scalar::Point { 3 } else { 1 }
}

/// All values that a machine writes, by name.
pub fn all(system: &System, robot: usize) -> Vec<(String, Named)> {
    let automaton = system.automaton_of(robot);
    let mut found = Vec::new();
    let mut put = |ty: Type, kind: Kind, element: &dyn Fn(usize) -> Element| {
        for index in 0..system.model.elements(ty.extent) {
            let named = Named { element: element(index), ty: ty.scalar, kind };
            found.push((name_of(system, robot, &named), named));
        }
    };
    for (local, declared) in automaton.locals.iter().enumerate() {
        put(declared.ty, Kind::Local, &|index| Element::Local { robot, local, index });
    }
    for (implements, row) in automaton.implements.iter().zip(&system.instances[robot].rows) {
        let (interface, row) = (implements.interface, *row);
        for (cell, declared) in system.model.interface(interface).cells.iter().enumerate() {
            put(declared.ty, Kind::Cell, &|index| Element::Cell { interface, row, cell, index });
        }
    }
    for (port, declared) in automaton.device.ports.iter().enumerate() {
        let is_of_head = ["cmd", "verb", "hold"].contains(&declared.name.as_str());
        if declared.direction == Direction::Output && !is_of_head {
            let ty = Type { scalar: declared.ty.into(), extent: declared.extent.into() };
            put(ty, Kind::Output, &|index| Element::Port { robot, port, index });
        }
    }
    found
}

pub fn name_of(system: &System, robot: usize, named: &Named) -> String {
    let (owner, name, extent, index) = match named.element {
        Element::Local { robot, local, index } => {
            let declared = &system.automaton_of(robot).locals[local];
            (robot, &declared.name, declared.ty.extent, index)
        }
        Element::Port { robot, port, index } => {
            let declared = &system.automaton_of(robot).device.ports[port];
            (robot, &declared.name, declared.extent.into(), index)
        }
        Element::Cell { interface, row, cell, index } => {
            let declared = &system.model.interface(interface).cells[cell];
            (system.members[interface.0][row], &declared.name, declared.ty.extent, index)
        }
    };
    let owner = if owner == robot { String::new() } else { format!("{}.", system.instances[owner].name) };
    match extent {
        Extent::One => format!("{owner}{name}"),
        Extent::Count(_) => format!("{owner}{name}[{index}]"),
        Extent::By(id) => format!("{owner}{name}[{}]", system.model.enums[id.0].members[index]),
    }
}
