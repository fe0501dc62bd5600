//! The columns of the I/O trace: where a run has the values of the globals of the portable text, and of the
//! states of its blocks.

use super::context::Shared;
use super::declaration::suffixes;
use super::globals::Globals;
use super::name::Name;
use crate::ir::{Scalar, Type};
use runtime_sim::device::{self, Direction, PortType};
use runtime_sim::io_trace::{Column, Columns, Form, Source};
use std::collections::BTreeMap;

/// Inputs first; what they lead to behind them. Cells that the text leaves out have no column.
pub fn columns(shared: Shared, globals: &Globals) -> Columns {
    let mut columns = vec![
        column("run_permit", Form::Truth, Source::RunPermit),
        column("start", Form::Truth, Source::Start),
        column("reset", Form::Truth, Source::Reset),
    ];
    let robots = 0..shared.system.instances.len();
    columns.extend(robots.clone().flat_map(|robot| ports(shared, robot, Direction::Input)));
    columns.extend([
        column("running", Form::Truth, Source::Running),
        column("fault", Form::Truth, Source::Fault),
        column("fault_code", Form::WHOLE, Source::FaultCode),
        column("fault_robot", Form::WHOLE, Source::FaultRobot),
    ]);
    if !shared.system.alarms().is_empty() {
        columns.extend([
            column("alarm", Form::Truth, Source::Alarm),
            column("alarm_code", Form::WHOLE, Source::AlarmCode),
            column("alarm_robot", Form::WHOLE, Source::AlarmRobot),
        ]);
    }
    columns.extend(robots.flat_map(|robot| ports(shared, robot, Direction::Output)));
    let (states, mut cells) = remembered(shared);
    columns.extend(states);
    for table in &globals.cells {
        columns.extend(cells.remove(&table.variable.name).unwrap_or_default());
    }
    Columns(columns)
}

fn column(name: impl Into<String>, form: Form, source: Source) -> Column {
    Column { name: name.into(), form, source }
}

fn ports(shared: Shared, robot: usize, direction: Direction) -> Vec<Column> {
    let names = &shared.names.robots[robot].ports;
    let mut columns = Vec::new();
    for (port, held) in shared.system.automaton_of(robot).device.ports.iter().zip(names) {
        if port.direction != direction {
            continue;
        }
        let form = match port.ty {
            PortType::Bool => Form::Truth,
            PortType::Int { lo, hi } => Form::Whole { lo, hi },
            PortType::Real | PortType::Point => Form::Real,
        };
        for element in 0..port.extent.elements(shared.system.kinds()) {
            for name in held {
                let name = match port.extent {
                    device::Extent::One => name.to_string(),
                    device::Extent::PerKind | device::Extent::Times(_) => format!("{name}[{element}]"),
                };
                let (machine, word) = (robot, columns.len());
                let source = match direction {
                    Direction::Input => Source::Input { machine, word },
                    Direction::Output => Source::Output { machine, word },
                };
                columns.push(column(name, form, source));
            }
        }
    }
    columns
}

/// Columns of the trace, in whose order they are found: state and elapsed time of each robot, and the elements
/// of the cells by the name of the global.
fn remembered(shared: Shared) -> (Vec<Column>, BTreeMap<Name, Vec<Column>>) {
    let model = &shared.system.model;
    let words = |ty: Type| model.elements(ty.extent) * suffixes(ty.scalar).len();
    let mut states = Vec::new();
    let mut cells: BTreeMap<Name, Vec<(usize, Column)>> = BTreeMap::new();
    let mut at = 0;
    for (robot, (instance, names)) in shared.system.instances.iter().zip(&shared.names.robots).enumerate() {
        let automaton = shared.system.automaton_of(robot);
        for variable in ["state", "elapsed"] {
            states.push(column(format!("{}.{variable}", names.instance), Form::WHOLE, Source::Trace(at)));
            at += 1;
        }
        at += automaton.locals.iter().map(|local| words(local.ty)).sum::<usize>();
        for (implemented, row) in automaton.implements.iter().zip(&instance.rows) {
            let interface = model.interface(implemented.interface);
            let names = &shared.names.interfaces[implemented.interface.0].cells;
            for (cell, held) in interface.cells.iter().zip(names) {
                let elements = model.elements(cell.ty.extent);
                for element in row * elements..(row + 1) * elements {
                    for name in held {
                        let found = column(format!("{name}[{element}]"), form(cell.ty), Source::Trace(at));
                        cells.entry(name.clone()).or_default().push((element, found));
                        at += 1;
                    }
                }
            }
        }
        at += automaton.device.words(Direction::Output, shared.system.kinds()) + automaton.alarm_words();
    }
    let sorted = |mut found: Vec<(usize, Column)>| {
        found.sort_by_key(|(element, _)| *element);
        found.into_iter().map(|(_, column)| column).collect()
    };
    (states, cells.into_iter().map(|(name, found)| (name, sorted(found))).collect())
}

fn form(ty: Type) -> Form {
    match ty.scalar {
        Scalar::Bool => Form::Truth,
        Scalar::Int { .. } | Scalar::Time | Scalar::Enum(_) | Scalar::Ref(_) => Form::WHOLE,
        Scalar::Real | Scalar::Point => Form::Real,
    }
}
