//! Transitions of one state that can fire at the same time: which one does is a matter of their order.

mod assumed;

use crate::diagnostic::{Diagnostic, sort};
use crate::ir::{Clause, Expr, ExprKind, PropertyKind, Severity, State, StateId, System, Transition};
use crate::source::Span;
use assumed::{Assumed, MOST_STEPS_OF_STATE};
use std::collections::BTreeSet;

/// Instances of a type that are looked at: they differ in parameters and roles.
const MOST_INSTANCES: usize = 4;
/// Transitions of a state that are compared with each other.
const MOST: usize = 100;
/// Values that are shown.
const MOST_SHOWN: usize = 12;

/// A note for each pair of transitions for which there are values with which both could fire: inputs, cells and variables
/// within their bounds, with which the properties hold whose violation is a fault.
pub fn notes(system: &System) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for (number, automaton) in system.model.automata.iter().enumerate() {
        let instances = (0..system.instances.len()).filter(|i| system.instances[*i].automaton.0 == number);
        let instances: Vec<usize> = instances.take(MOST_INSTANCES).collect();
        let properties = automaton
            .properties
            .iter()
            .filter(|property| property.severity == Severity::Line && !property.asks_operator);
        let always: Vec<&Expr> = properties
            .filter_map(|property| match &property.kind {
                PropertyKind::Always(condition) => Some(condition),
                PropertyKind::Keep { .. } | PropertyKind::Whenever { .. } => None,
            })
            .collect();
        // What stands once in the text, as of `any state`, is told once.
        let mut told: BTreeSet<[Span; 2]> = BTreeSet::new();
        for (state_number, state) in automaton.states.iter().enumerate() {
            let mut left = MOST_STEPS_OF_STATE;
            for [first, second] in pairs(state) {
                let places = [first.place, second.place];
                // What stands behind one that always fires is warned of.
                if told.contains(&places) || first.is_unconditional() || is_time(second) {
                    continue;
                }
                let mut example = |instance: &usize| {
                    Assumed::new(system, *instance, StateId(state_number), [first, second], &always)
                        .find(&mut left)
                };
                let example = instances.iter().find_map(&mut example);
                if let Some(example) = example {
                    told.insert(places);
                    found.push(note(state, first, second, &example));
                }
            }
        }
    }
    sort(&mut found);
    found
}

/// A time that is up behind other conditions is meant as it stands.
fn is_time(transition: &Transition) -> bool {
    matches!(&transition.clauses[..], [Clause::Condition(Expr { kind: ExprKind::After(_), .. })])
}

fn pairs(state: &State) -> impl Iterator<Item = [&Transition; 2]> {
    let transitions = &state.transitions[..state.transitions.len().min(MOST)];
    transitions
        .iter()
        .enumerate()
        .flat_map(|(number, second)| transitions[..number].iter().map(move |first| [first, second]))
}

fn note(state: &State, first: &Transition, second: &Transition, example: &[String]) -> Diagnostic {
    let message = format!(
        "`{}` and `{}` of `{}` can hold at the same time, as far as the text tells",
        first.title(),
        second.title(),
        state.name
    );
    let mut shown = example[..example.len().min(MOST_SHOWN)].join(", ");
    if example.len() > MOST_SHOWN {
        shown += &format!(", and {} more", example.len() - MOST_SHOWN);
    }
    Diagnostic::new("N0101", second.place, message)
        .other(first.place, "this one fires then: it comes first")
        .note(format!("for example with {shown}"))
        .help("nothing has to be done if this order is meant; else exchange them, or add a condition to one of them")
}
