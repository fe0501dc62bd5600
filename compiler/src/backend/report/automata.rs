//! What each type does in which state, as it is written.

use crate::ir::{Automaton, ExprKind, State, System, Value as Constant};
use crate::plain;
use crate::source::Sources;
use serde_json::{Value, json};

/// Each automaton with its states and their transitions.
pub fn automata(system: &System, sources: &Sources) -> Vec<Value> {
    system
        .model
        .automata
        .iter()
        .map(|automaton| {
            json!({
                "name": automaton.name,
                "doc": plain::line(automaton.doc.join(" ").trim()),
                "states": automaton.states.iter().map(|s| state(automaton, s, sources)).collect::<Vec<_>>(),
            })
        })
        .collect()
}

fn state(automaton: &Automaton, state: &State, sources: &Sources) -> Value {
    let transitions = state.transitions.iter().map(|transition| {
        let target = transition.target.map(|target| automaton.states[target.0].name.as_str());
        json!({ "when": plain::line(&transition.title()), "to": target })
    });
    // A stay that is computed has no number here.
    let within = state.within.as_ref().map(|(longest, _)| match &longest.kind {
        ExprKind::Constant(Constant::Int(ms)) => json!(f64::from(*ms) / 1000.0),
        _ => json!(true),
    });
    json!({
        "name": state.name,
        "doc": plain::line(state.doc.join(" ").trim()),
        "place": format!("{}:{}", sources.file(state.place.file).name, sources.position(state.place).0),
        "final": state.is_final,
        "within": within,
        "transitions": transitions.collect::<Vec<_>>(),
    })
}
