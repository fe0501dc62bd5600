//! What a model needs to continue after a loss of power, as `docs/semantics.md` says.

use crate::ir::{
    Automaton, Expr, ExprKind, Extent, KeptBy, Local, Model, Operator, Place, PropertyKind, Scalar, Type,
    UpdateKind, Value,
};

/// Adds what every automaton that retains its state needs.
pub fn add(model: &mut Model) {
    let automata = model.automata.iter_mut();
    automata.filter(|automaton| automaton.retained.state && commands(automaton)).for_each(add_abandoned);
}

/// Whether any transition gives a command.
fn commands(automaton: &Automaton) -> bool {
    let transitions = automaton.states.iter().flat_map(|state| &state.transitions);
    let mut updates = transitions.flat_map(|transition| &transition.updates);
    updates.any(|update| matches!(update.kind, UpdateKind::Command { .. }))
}

/// Whether the answer to the last command counts, of a device with commands.
pub fn add_abandoned(automaton: &mut Automaton) {
    if !automaton.device.is_commanded() || automaton.abandoned.is_some() {
        return;
    }
    let mut add =
        |name: &str, about: &str| add_local(automaton, name, Scalar::Bool, Value::Bool(false), about);
    let abandoned = add(
        "abandoned",
        "The answer to the last command does not count: a person moved the machine, or power was lost. The device is held until the next command.",
    );
    let interrupted = add("interrupted", "It has continued since: the last command counts as failed.");
    (automaton.abandoned, automaton.interrupted) = (Some(abandoned), Some(interrupted));
    let is_abandoned =
        || Expr { ty: Scalar::Bool, kind: ExprKind::Read(Place::Local { local: abandoned, index: None }) };
    for property in &mut automaton.properties {
        // Of those that begin anew there is `answer` alone: such a command is not under way.
        if let PropertyKind::Whenever { trigger, goal, anew: Some(_), .. } = &mut property.kind {
            let not = Expr { ty: Scalar::Bool, kind: ExprKind::Not(Box::new(is_abandoned())) };
            join(trigger, Operator::And, not);
            join(goal, Operator::Or, is_abandoned());
        }
    }
}

fn join(expr: &mut Expr, operator: Operator, other: Expr) {
    let one = expr.clone();
    expr.kind = ExprKind::Binary(operator, Box::new(one), Box::new(other));
}

/// Adds a local that no text declares, under a name that is still free.
pub fn add_local(
    automaton: &mut Automaton,
    wanted: &str,
    scalar: Scalar,
    initial: Value,
    about: &str,
) -> usize {
    let is_taken = |name: &str| {
        automaton.locals.iter().any(|local| local.name == name)
            || automaton.parameters.iter().any(|parameter| parameter.name == name)
            || automaton.device.ports.iter().any(|port| port.name == name)
    };
    let mut name = wanted.to_string();
    let mut number = 2;
    while is_taken(&name) {
        name = format!("{wanted}_{number}");
        number += 1;
    }
    automaton.locals.push(Local {
        name,
        doc: vec![about.into()],
        ty: Type { scalar, extent: Extent::One },
        initial,
        kept_by: KeptBy::Modes,
    });
    automaton.locals.len() - 1
}
