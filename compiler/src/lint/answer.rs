//! Answers to a command that are used twice.

use crate::diagnostic::Diagnostic;
use crate::ir::{Asking, Automaton, ExprKind, StateId, Transition, UpdateKind};
use crate::source::Span;

pub fn check(automaton: &Automaton, found: &mut Vec<Diagnostic>) {
    for (answer, word) in [(ExprKind::Done, "done"), (ExprKind::Failed, "failed")] {
        let asking = Asking::new(automaton, |kind| *kind == answer);
        let used = used(automaton, |transition| asking.guard(transition));
        for (state, used) in automaton.states.iter().zip(used) {
            let Some(used) = used else { continue };
            for transition in state.transitions.iter().filter(|transition| asking.guard(transition)) {
                let message = format!(
                    "`{}` uses an answer that has been used already: no command is given on the way to `{}`",
                    transition.title(),
                    state.name
                );
                found.push(
                    Diagnostic::new("W0107", transition.place, message)
                        .other(used, format!("this has used `{word}`"))
                        .note(format!("`{word}` holds until the next command: this fires at once"))
                        .help("give a command on the way, or test something else"),
                );
            }
        }
    }
}

/// Of each state whether it can be entered, or stayed in, with an answer that a transition has used and without a command
/// since; and that transition.
fn used(automaton: &Automaton, asks: impl Fn(&Transition) -> bool) -> Vec<Option<Span>> {
    let mut used: Vec<Option<Span>> = vec![None; automaton.states.len()];
    loop {
        let mut has_changed = false;
        for (number, state) in automaton.states.iter().enumerate() {
            for transition in state.transitions.iter().filter(|transition| !gives_command(transition)) {
                let by = if asks(transition) { Some(transition.place) } else { used[number] };
                let target = transition.target.map_or(number, |StateId(target)| target);
                if let (Some(by), None) = (by, used[target]) {
                    used[target] = Some(by);
                    has_changed = true;
                }
            }
        }
        if !has_changed {
            return used;
        }
    }
}

fn gives_command(transition: &Transition) -> bool {
    transition.updates.iter().any(|update| matches!(update.kind, UpdateKind::Command { .. }))
}
