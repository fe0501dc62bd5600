//! What cannot be searched.

use super::plant::is_commanded;
use crate::diagnostic::Diagnostic;
use crate::ir::System;
use runtime_sim::kinematics::facing::Facing;
use runtime_sim::machine::Machine;
use runtime_sim::part::Primitive;
use runtime_sim::wiring::Command;

/// Why a machine cannot be, by its number.
pub fn machine(system: &System, (number, machine): (usize, &Machine)) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    if works_sideways(machine) {
        let help = "verify lines whose tools point down";
        found.push(diagnostic(system, number, "a tool comes from the side", help));
    }
    if let Some(several) = several(machine) {
        let help = "verify lines whose machines have one of each, or make two machines of it";
        found.push(diagnostic(system, number, &format!("it has {several}"), help));
    }
    found
}

/// Nobody says which values a port of a machine may have that its automaton reads.
pub fn unbounded(system: &System, number: usize, port: &str) -> Diagnostic {
    let why = format!("no contract says which values its port `{port}` may have");
    let help = "verify lines whose automata read booleans, whole numbers of few values, and places that commands fix";
    diagnostic(system, number, &why, help)
}

fn diagnostic(system: &System, number: usize, why: &str, help: &str) -> Diagnostic {
    let message = format!("`{}` cannot be searched: {why}", system.instances[number].name);
    Diagnostic::new("E1001", system.automaton_of(number).place, message).help(help)
}

fn works_sideways(machine: &Machine) -> bool {
    let is_facing = |command: &Command| {
        let schema = machine.parts[command.part].schema();
        (schema.name, schema.actions[command.action].name) == ("chain", "facing")
    };
    machine.wiring.commands.iter().any(is_facing)
        || machine.places().any(|place| place.facing != Facing::Down)
}

/// Parts of a machine of which one alone can be searched, if it has several.
fn several(machine: &Machine) -> Option<String> {
    let named = |is_one: &dyn Fn(usize, &Primitive) -> bool| -> Vec<&str> {
        let parts = machine.parts.iter().enumerate();
        parts
            .filter(|(number, part)| is_one(*number, &part.primitive))
            .map(|(_, part)| &part.name[..])
            .collect()
    };
    let lanes = named(&|number, part| matches!(part, Primitive::Lane(_)) && is_commanded(machine, number));
    let grips = named(&|_, part| matches!(part, Primitive::Grip(_)));
    let desks = named(&|_, part| matches!(part, Primitive::Orders(_)));
    let kinds = [("conveyors with commands", lanes), ("grippers", grips), ("terminals of orders", desks)];
    let found = kinds.into_iter().find(|(_, names)| names.len() > 1);
    found.map(|(what, names)| format!("several {what}: {}", names.join(", ")))
}
