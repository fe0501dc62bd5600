//! Outputs that move something while the line is stopped, and moving machines without a body.

use crate::device::{Device, Port};
use crate::diagnostic::Diagnostic;
use crate::ir::{Automaton, Model};
use runtime_sim::device::{Direction, PortType, Stop};
use runtime_sim::part::Schema;
use runtime_sim::wiring::Drives;
use std::collections::BTreeSet;

/// Parts that move or fill while a level is on.
const WORK: [&str; 2] = [LANE, "tank"];
/// It runs while all its levels let it, and its machine is not held.
const LANE: &str = "lane";
/// Parts that act when a level rises: it may stay in a pause, but must not come back by itself at power-up.
const ACT_BY_EDGE: [&str; 2] = ["process", "source"];
const CYLINDER: &str = "cylinder";

/// Parts that move a machine as a whole or in its joints.
const CARRIERS: [&str; 3] = ["chain", "route", "track"];

pub fn check(model: &Model, found: &mut Vec<Diagnostic>) {
    let mut devices = BTreeSet::new();
    for automaton in &model.automata {
        found.extend(unstopped(automaton));
        if devices.insert(&automaton.device.name) {
            found.extend(bodiless(&automaton.device));
        }
    }
}

fn unstopped(automaton: &Automaton) -> Vec<Diagnostic> {
    let device = &automaton.device;
    let outputs = device.ports.iter().enumerate().filter(|(_, port)| port.direction == Direction::Output);
    let levels = outputs.zip(&device.wiring.outputs).filter_map(|(port, output)| match output.drives {
        Drives::Level { part, .. } => Some((port, part)),
        _ => None,
    });
    let levels: Vec<_> = levels.collect();
    let primitive = |wanted: usize| device.parts().find(|(part, _, _)| *part == wanted);
    let mut found = Vec::new();
    for ((number, port), part) in &levels {
        let Some((_, name, Schema { name: kind, .. })) = primitive(*part) else { continue };
        let is_retained = automaton.retained.ports.contains(number);
        let stops = |((_, other), of): &((usize, &Port), usize)| of == part && other.stop == Stop::Value(0.0);
        let is_held = device.wiring.commands.iter().any(|command| command.part == *part);
        if *kind == LANE && (is_held || levels.iter().any(stops)) {
            continue;
        }
        let valves = levels.iter().filter(|(_, other)| other == part).count();
        let comes_back = ACT_BY_EDGE.contains(kind) || *kind == CYLINDER && valves == 1;
        let moves = WORK.contains(kind) || comes_back && is_retained;
        let Some(place) = port.place.filter(|_| moves && port.stop == Stop::Hold) else { continue };
        let value = if port.ty == PortType::Bool { "false" } else { "0" };
        let message = format!("`{}` keeps its value while the line is stopped", port.name);
        let acts_by_edge = ACT_BY_EDGE.contains(kind);
        let effect = match acts_by_edge {
            true => "which acts when its level rises",
            false => "and what it moves goes on",
        };
        let mut told =
            Diagnostic::new("W0113", place, message).note(format!("it drives the {kind} `{name}`, {effect}"));
        if is_retained {
            let by = format!(
                "`{}` retains it: after a loss of power it acts before the line is started",
                automaton.name
            );
            told = told.note(by);
        }
        let stop = format!("write `stop {value}` at its end");
        found.push(told.help(match acts_by_edge {
            true => format!("{stop}, and let the automaton set {value} once it has acted: with a stop value it rises again whenever the line continues"),
            false => stop,
        }));
    }
    found
}

fn bodiless(device: &Device) -> Option<Diagnostic> {
    if device.parts_called("body").any(|(part, _)| device.sets(part, "on")) {
        return None;
    }
    let (part, name, schema) = device.parts().find(|(_, _, schema)| CARRIERS.contains(&schema.name))?;
    let message = format!("no body moves with the {} `{name}` of `{}`", schema.name, device.name);
    let on = match schema.name {
        "chain" => "one of its axes or frames",
        _ => name,
    };
    Some(
        Diagnostic::new("W0114", device.place_of(part)?, message)
            .note("what has no body is not checked for contact with other machines")
            .help(format!(
                "add one, on {on}: `part hull = body {{ on: ...; low: point(...); high: point(...); }};`"
            )),
    )
}
