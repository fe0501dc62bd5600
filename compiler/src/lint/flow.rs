//! States and transitions that cannot come.

use super::contradiction;
use super::implies::{Facts, constant};
use crate::diagnostic::Diagnostic;
use crate::ir::{Automaton, Clause, Expr, ExprKind, Model, State, Transition, Value};

pub fn check(model: &Model, automaton: &Automaton, found: &mut Vec<Diagnostic>) {
    for state in &automaton.states {
        for (number, transition) in state.transitions.iter().enumerate() {
            if contradiction::never_holds(model, automaton, transition) {
                continue;
            }
            if let Some(before) = covering(automaton, state, number) {
                let message = format!(
                    "`{}` never fires in `{}`: the one before it always does",
                    transition.title(),
                    state.name
                );
                found.push(
                    Diagnostic::new("W0102", transition.place, message)
                        .other(before.place, "this fires whenever that could")
                        .help("put it before that one, or remove it"),
                );
            }
        }
        found.extend(endless(state));
    }
    let reached = reached(model, automaton);
    for (state, _) in automaton.states.iter().zip(reached).filter(|(_, reached)| !reached) {
        let message = format!("`{}` cannot be reached", state.name);
        found.push(
            Diagnostic::new("W0101", state.place, message)
                .note("no path of transitions that can fire leads to it from the beginning")
                .help("add a transition that leads to it, or remove the state"),
        );
    }
}

/// Transitions of a state that are compared with each other.
const MOST: usize = 100;

/// An earlier transition of the state that fires whenever this one could.
fn covering<'a>(automaton: &'a Automaton, state: &'a State, number: usize) -> Option<&'a Transition> {
    if number > MOST {
        return None;
    }
    let facts = Facts::new(automaton, conditions(&state.transitions[number]));
    let mut earlier = state.transitions[..number.min(MOST)].iter();
    earlier.find(|earlier| {
        let mut clauses = earlier.clauses.iter();
        clauses.all(|clause| matches!(clause, Clause::Condition(condition) if facts.imply(condition)))
    })
}

fn conditions(transition: &Transition) -> impl Iterator<Item = &Expr> {
    transition.clauses.iter().filter_map(|clause| match clause {
        Clause::Condition(condition) => Some(condition),
        Clause::Bind(binder) => binder.condition.as_ref(),
    })
}

/// Whether each state can be reached from the beginning, whatever the guards of what can fire are.
fn reached(model: &Model, automaton: &Automaton) -> Vec<bool> {
    let mut reached = vec![false; automaton.states.len()];
    let mut open = vec![0];
    while let Some(number) = open.pop() {
        if std::mem::replace(&mut reached[number], true) {
            continue;
        }
        let state = &automaton.states[number];
        let can_fire = |(number, transition): &(usize, &Transition)| {
            let is_false = |condition: &Expr| condition.kind == ExprKind::Constant(Value::Bool(false));
            !conditions(transition).any(is_false)
                && !contradiction::never_holds(model, automaton, transition)
                && covering(automaton, state, *number).is_none()
        };
        let firing = state.transitions.iter().enumerate().filter(can_fire);
        open.extend(firing.filter_map(|(_, transition)| transition.target).map(|target| target.0));
    }
    reached
}

/// A `within` of which the state's own transitions see to it that it never passes.
fn endless(state: &State) -> Option<Diagnostic> {
    let longest = constant(&state.within.as_ref()?.0)?;
    let leaves_in_time = |transition: &&Transition| match &transition.clauses[..] {
        [Clause::Condition(Expr { kind: ExprKind::After(time), .. })] => {
            constant(time).is_some_and(|ms| ms < longest)
        }
        _ => transition.is_unconditional(),
    };
    // While one without a target fires, none behind it does.
    let leaving = state.transitions.iter().take_while(|transition| transition.target.is_some());
    let leaves = leaving.into_iter().find(leaves_in_time)?;
    let message = format!("`{}` never lasts as long as its `within`", state.name);
    Some(
        Diagnostic::new("W0103", state.place, message)
            .other(leaves.place, "this leaves it before")
            .help("give the state a shorter `within`, or none"),
    )
}
