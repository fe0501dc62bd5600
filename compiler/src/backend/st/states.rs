//! What the numbers of states mean, for who shows them on a screen.

use super::context::Shared;
use super::screen::{Translate, Use};
use super::table::row;
use super::walk::defines;
use crate::ir::{Automaton, AutomatonId, Clause, Domain, Expr, State};
use std::collections::BTreeSet;

/// What a state without transitions waits for.
const FINAL: &str =
    "nothing: the machine has ended; it begins anew by a cold start, or when it was moved by hand";

/// `states.csv`: a row for each state of each type that has robots, with its number in the output `state`, and with
/// what it waits for.
pub fn table(shared: Shared, translate: &mut Translate) -> String {
    let mut text = row(&["type", "robots", "number", "state", "meaning", "waits for", "where"]);
    for (id, automaton) in shared.system.model.automata.iter().enumerate() {
        let robots: Vec<&str> = (shared.instances(AutomatonId(id)).iter())
            .map(|r| shared.system.instances[*r].name.as_str())
            .collect();
        if robots.is_empty() {
            continue;
        }
        for (number, state) in automaton.states.iter().enumerate() {
            let meaning = if number == 0 { "before the first step".into() } else { state.doc.join(" ") };
            let [name, meaning] =
                [translate(Use::State, &state.name), translate(Use::Meaning, meaning.trim())];
            let robots = robots.join(" ");
            let waits = if state.is_final { FINAL.into() } else { waits(automaton, state) };
            let meant = meant(shared, automaton, state);
            text += &row(&[&automaton.name, &robots, &number.to_string(), &name, &meaning, &waits, &meant]);
        }
    }
    text
}

/// The guards that lead out of a state, as written, each with the state behind it.
fn waits(automaton: &Automaton, state: &State) -> String {
    let guards = state.transitions.iter().filter_map(|transition| {
        let target = &automaton.states[transition.target?.0].name;
        Some(format!("{} -> {target}", transition.title()))
    });
    guards.collect::<Vec<_>>().join("; ")
}

/// The defines that these guards name, as written.
fn meant(shared: Shared, automaton: &Automaton, state: &State) -> String {
    let mut found = BTreeSet::new();
    for transition in state.transitions.iter().filter(|transition| transition.target.is_some()) {
        let parts = transition.clauses.iter().flat_map(parts);
        parts.for_each(|part| defines(automaton, part, &mut found));
    }
    let texts = found.into_iter().map(|define| shared.definition(automaton.defines[define].place));
    texts.collect::<Vec<_>>().join("; ")
}

fn parts(clause: &Clause) -> Vec<&Expr> {
    match clause {
        Clause::Condition(condition) => vec![condition],
        Clause::Bind(binder) => {
            let range = match &binder.domain {
                Domain::Range(low, high) => vec![low, high],
                Domain::Role(_) | Domain::Enum(_) => Vec::new(),
            };
            range.into_iter().chain(&binder.condition).chain(&binder.key).collect()
        }
    }
}
