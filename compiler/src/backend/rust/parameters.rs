//! A layout as a stream of words, so that a compiled program can run another one.
//!
//! The order is that in which the generated `adapters.rs` reads: the period, for each interface what its
//! members show, the relations, and the robots in layout order.

use crate::ir::{InterfaceId, System, Value};
use std::fmt::Write;

pub fn parameters_text(system: &System) -> String {
    let model = &system.model;
    let mut out = format!("parameters 1\nscan_ms {}\n", system.scan_ms);
    for (id, interface) in model.interfaces.iter().enumerate() {
        let rows = system.members[id].len();
        let _ = writeln!(out, "{} {rows}", interface.name);
        for row in 0..rows {
            let shown = (0..interface.parameters.len()).flat_map(|p| system.shown(InterfaceId(id), row, p));
            entry(&mut out, shown.map(|v| word(*v)));
        }
    }
    for (relation, rows) in model.relations.iter().zip(&system.reaches) {
        let name = |id: InterfaceId| &model.interface(id).name;
        let _ = writeln!(out, "{}_{} {}", name(relation.from), name(relation.to), rows.len());
        for row in rows {
            entry(
                &mut out,
                [row.len().to_string()].into_iter().chain(row.iter().map(|b| u8::from(*b).to_string())),
            );
        }
    }
    let _ = writeln!(out, "robots {}", system.instances.len());
    for instance in &system.instances {
        let values = instance.parameters.iter().flatten().map(|v| word(*v));
        let list = |rows: &Vec<usize>| {
            [rows.len()].into_iter().chain(rows.iter().copied()).map(|n| n.to_string()).collect::<Vec<_>>()
        };
        let roles = instance.roles.iter().flat_map(list);
        let rows = instance.rows.iter().map(usize::to_string);
        let head = [model.automaton(instance.automaton).name.clone(), instance.name.clone()];
        entry(&mut out, head.into_iter().chain(values).chain(roles).chain(rows));
    }
    out + "end\n"
}

fn entry(out: &mut String, words: impl Iterator<Item = String>) {
    let words: Vec<String> = words.collect();
    if !words.is_empty() {
        let _ = writeln!(out, "  {}", words.join(" "));
    }
}

fn word(value: Value) -> String {
    match value {
        Value::Bool(b) => u8::from(b).to_string(),
        Value::Int(i) => i.to_string(),
        Value::Real(r) => format!("{r:?}"),
        Value::Point([x, y, z]) => format!("{x:?} {y:?} {z:?}"),
    }
}
