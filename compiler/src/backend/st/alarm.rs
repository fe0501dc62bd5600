//! The table of alarms in the program: its arrays, what acknowledges, what is told of the first one.

use super::code::{Arm, Ex, Stmt, advance, and, assign, binary, name, not, or, when};
use super::context::Shared;
use super::declaration::{Basic, Variable};
use super::globals::Table;
use super::names::ELEMENT;
use super::property::STOPPED;
use super::values::Values;
use crate::ir::Severity;
use std::sync::Arc;

/// Columns of the table.
pub const COLUMNS: [&str; 7] = ["code", "robot", "active", "acknowledged", "count", "first", "last"];

pub fn any(shared: Shared) -> bool {
    !shared.system.alarms().is_empty()
}

pub fn can_stop(shared: Shared) -> bool {
    shared.system.alarms().iter().any(|entry| entry.severity == Severity::Machine) || has_modes(shared)
}

fn has_modes(shared: Shared) -> bool {
    shared.system.model.automata.iter().any(|automaton| automaton.modes.is_some())
}

/// The arrays: an element for each entry, and for each robot whether an alarm has stopped it.
pub fn tables(shared: Shared) -> Vec<Table> {
    let entries = shared.system.alarms();
    let sized = |elements: usize, name: &str, basic: Basic, about: &str, values: Values| Table {
        variable: Variable::new(name, basic).with_elements(Some(elements)).with_comment(about),
        values: Arc::new(values),
    };
    let table = |name: &str, basic: Basic, about: &str, values: Values| {
        sized(values.len(), name, basic, about, values)
    };
    // An array has two elements at least: a screen is not to show the second of a single one.
    let acknowledged = Values::Alike(Box::new(Ex::Bool(true)), entries.len().max(2));
    let all = |value: Ex| Values::Alike(Box::new(value), entries.len());
    let mut tables = Vec::new();
    if !entries.is_empty() {
        let codes = entries.iter().map(|entry| Ex::Int(entry.site.0 as i32 + 1)).collect();
        let robots = entries.iter().map(|entry| Ex::Int(entry.robot as i32)).collect();
        tables.extend([
            table("alarms_code", Basic::Dint, "see alarms.csv", codes),
            table("alarms_robot", Basic::Dint, "number of the robot", robots),
            table("alarms_active", Basic::Bool, "its cause is present", all(Ex::Bool(false))),
            sized(
                entries.len(),
                "alarms_acknowledged",
                Basic::Bool,
                "a person has acknowledged it",
                acknowledged,
            ),
            table("alarms_count", Basic::Dint, "how often it was raised", all(Ex::Int(0))),
            table("alarms_first", Basic::Dint, "scan in which it was raised first", all(Ex::Int(0))),
            table("alarms_last", Basic::Dint, "scan in which it was raised last", all(Ex::Int(0))),
        ]);
    }
    if can_stop(shared) {
        let robots = Values::Alike(Box::new(Ex::Bool(false)), shared.system.instances.len());
        let about = match has_modes(shared) {
            true => "an alarm or its panel has stopped the robot: it makes no steps, and its device is held",
            false => "an alarm has stopped the robot: it makes no steps, and its device is held",
        };
        tables.push(table(STOPPED, Basic::Bool, about, robots));
    }
    tables
}

/// Of the alarm that is told so far.
pub const OLDEST_ACKNOWLEDGED: &str = "oldest_acknowledged";

fn of(array: &str) -> Ex {
    Ex::Element(array.into(), Box::new(name(ELEMENT)))
}

/// For every entry.
fn each(shared: Shared, mut body: Vec<Stmt>) -> [Stmt; 2] {
    let count = shared.system.alarms().len();
    body.push(advance(ELEMENT));
    let condition = binary("<", name(ELEMENT), Ex::Int(count as i32));
    [assign(ELEMENT, Ex::Int(0)), Stmt::While { condition, body, most: count as u64 }]
}

/// A rising edge of `reset` acknowledges all alarms.
pub fn acknowledged(shared: Shared) -> Vec<Stmt> {
    if !any(shared) {
        return Vec::new();
    }
    let store = Stmt::Assign(of("alarms_acknowledged"), Ex::Bool(true));
    let edge = and(vec![name("reset_now"), not(name("reset_before"))]);
    vec![when(edge, each(shared, vec![store]).into())]
}

/// The outputs that tell of alarms.
pub fn told(shared: Shared) -> Vec<Stmt> {
    if !any(shared) {
        return Vec::new();
    }
    let is_open = or(vec![of("alarms_active"), not(of("alarms_acknowledged"))]);
    let is_first = or(vec![
        binary("=", name("alarm_code"), Ex::Int(0)),
        and(vec![name(OLDEST_ACKNOWLEDGED), not(of("alarms_acknowledged"))]),
        and(vec![
            binary("=", name(OLDEST_ACKNOWLEDGED), of("alarms_acknowledged")),
            binary("<", of("alarms_last"), name("oldest")),
        ]),
    ]);
    let tell = vec![
        assign("alarm_code", of("alarms_code")),
        assign("alarm_robot", of("alarms_robot")),
        assign("oldest", of("alarms_last")),
        assign(OLDEST_ACKNOWLEDGED, of("alarms_acknowledged")),
    ];
    let mut body = vec![
        Stmt::Comment(
            "Alarms: the first raised one that is not acknowledged, or else of those that are active.".into(),
        ),
        assign("alarm", Ex::Bool(false)),
        assign("alarm_code", Ex::Int(0)),
        assign("alarm_robot", Ex::Int(-1)),
        assign("oldest", Ex::Int(0)),
        assign(OLDEST_ACKNOWLEDGED, Ex::Bool(false)),
    ];
    body.extend(each(
        shared,
        vec![when(is_open, vec![assign("alarm", Ex::Bool(true)), when(is_first, tell)])],
    ));
    body
}

/// The number of the scan grows, and stops at its greatest value.
pub fn counted(shared: Shared) -> Vec<Stmt> {
    if !any(shared) {
        return Vec::new();
    }
    let room = binary("<", name("scan_no"), Ex::Int(i32::MAX));
    let arm = Arm { comments: Vec::new(), condition: room, body: vec![advance("scan_no")] };
    vec![Stmt::If(vec![arm], Vec::new())]
}
