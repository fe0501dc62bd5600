//! Commands whose failure nobody handles.

use crate::diagnostic::Diagnostic;
use crate::ir::{Asking, Automaton, ExprKind, StateId, Transition, Update, UpdateKind};
use crate::source::Span;

pub fn check(automaton: &Automaton, found: &mut Vec<Diagnostic>) {
    let done = Asking::new(automaton, |kind| *kind == ExprKind::Done);
    let failed = Asking::new(automaton, |kind| *kind == ExprKind::Failed);
    let handles: Vec<bool> =
        automaton.states.iter().map(|state| state.transitions.iter().any(|t| failed.guard(t))).collect();
    let (handled, commands) = (handled(automaton, &handles), commands(automaton));
    for (number, state) in automaton.states.iter().enumerate() {
        if handles[number] || state.transitions.is_empty() {
            continue;
        }
        if let Some(waits) = state.transitions.iter().find(|transition| done.guard(transition)) {
            let message =
                format!("`{}` waits until a command is done, and does nothing if it fails", state.name);
            found.push(
                Diagnostic::new("W0106", waits.place, message)
                    .note("a command that fails is never `done`: the machine would stay in this state")
                    .help("add `when failed -> ...`, or `any state { when failed -> ... }`"),
            );
        } else if let Some(place) = commands[number]
            && !handled[number]
        {
            let message = format!(
                "a command is given on the way to `{}`, and no state tests whether it failed",
                state.name
            );
            found.push(
                Diagnostic::new("W0106", place, message)
                    .note("a command that fails has moved nothing, or not reached its goal")
                    .help("add `when failed -> ...` to this state or to one that follows it"),
            );
        }
    }
}

/// For each state where the first transition into it that gives a command does so.
fn commands(automaton: &Automaton) -> Vec<Option<Span>> {
    let mut found = vec![None; automaton.states.len()];
    for transition in automaton.states.iter().flat_map(|state| &state.transitions) {
        if let Some(StateId(target)) = transition.target {
            found[target] = found[target].or_else(|| command(transition));
        }
    }
    found
}

fn command(transition: &Transition) -> Option<Span> {
    let is_command = |update: &&Update| matches!(update.kind, UpdateKind::Command { .. });
    transition.updates.iter().find(is_command).map(|update| update.place)
}

/// The states from which one that looks at failures is reached before another command is given, those included.
fn handled(automaton: &Automaton, handles: &[bool]) -> Vec<bool> {
    let mut before: Vec<Vec<usize>> = vec![Vec::new(); automaton.states.len()];
    for (number, state) in automaton.states.iter().enumerate() {
        for transition in state.transitions.iter().filter(|transition| command(transition).is_none()) {
            if let Some(StateId(target)) = transition.target {
                before[target].push(number);
            }
        }
    }
    let mut handled = handles.to_vec();
    let mut found: Vec<usize> = (0..handled.len()).filter(|state| handled[*state]).collect();
    while let Some(state) = found.pop() {
        for &earlier in &before[state] {
            if !std::mem::replace(&mut handled[earlier], true) {
                found.push(earlier);
            }
        }
    }
    handled
}
