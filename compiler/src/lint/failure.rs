//! Commands whose failure nobody handles.

use crate::diagnostic::Diagnostic;
use crate::ir::{Automaton, Clause, Domain, Expr, ExprKind, StateId, Transition, Update, UpdateKind};
use crate::source::Span;

/// Expressions that consist of one of a kind somewhere.
struct Asking {
    wanted: ExprKind,
    /// Of each definition. It reads those before it only.
    defines: Vec<bool>,
}

impl Asking {
    fn new(automaton: &Automaton, wanted: ExprKind) -> Self {
        let mut asking = Self { wanted, defines: Vec::new() };
        for define in &automaton.defines {
            let asks = asking.of(&define.value);
            asking.defines.push(asks);
        }
        asking
    }

    fn of(&self, expr: &Expr) -> bool {
        match &expr.kind {
            ExprKind::Define(define) => self.defines.get(*define).is_some_and(|asks| *asks),
            kind => *kind == self.wanted || expr.parts().into_iter().any(|part| self.of(part)),
        }
    }

    fn guard(&self, transition: &Transition) -> bool {
        expressions(transition).any(|expr| self.of(expr))
    }
}

pub fn check(automaton: &Automaton, found: &mut Vec<Diagnostic>) {
    let [done, failed] = [ExprKind::Done, ExprKind::Failed].map(|kind| Asking::new(automaton, kind));
    let handles: Vec<bool> =
        automaton.states.iter().map(|state| state.transitions.iter().any(|t| failed.guard(t))).collect();
    for (number, state) in automaton.states.iter().enumerate() {
        if handles[number] || state.transitions.is_empty() {
            continue;
        }
        if let Some(waits) = state.transitions.iter().find(|transition| done.guard(transition)) {
            let message = format!("`{}` waits for the end of a command, and not for its failure", state.name);
            found.push(
                Diagnostic::new("W0106", waits.place, message)
                    .note("a command that fails is never `done`: the machine would stay in this state")
                    .help("add `when failed -> ...`, or `any state { when failed -> ... }`"),
            );
        } else if let Some(place) = command_into(automaton, number)
            && !after(automaton, number).any(|later| handles[later])
        {
            let message =
                format!("a command is given for `{}`, and no state looks whether it fails", state.name);
            found.push(
                Diagnostic::new("W0106", place, message)
                    .note("a command that fails has moved nothing, or not all the way")
                    .help("add `when failed -> ...` to this state or to one that follows it"),
            );
        }
    }
}

/// Where the first transition into a state gives a command.
fn command_into(automaton: &Automaton, state: usize) -> Option<Span> {
    let all = automaton.states.iter().flat_map(|state| &state.transitions);
    let mut into = all.filter(|transition| transition.target == Some(StateId(state)));
    into.find_map(command)
}

fn command(transition: &Transition) -> Option<Span> {
    let is_command = |update: &&Update| matches!(update.kind, UpdateKind::Command { .. });
    transition.updates.iter().find(is_command).map(|update| update.place)
}

/// The states that follow before another command is given, this one included.
fn after(automaton: &Automaton, state: usize) -> impl Iterator<Item = usize> {
    let mut seen = vec![state];
    let mut next = 0;
    while let Some(&state) = seen.get(next) {
        next += 1;
        for transition in &automaton.states[state].transitions {
            if let (None, Some(StateId(target))) = (command(transition), transition.target)
                && !seen.contains(&target)
            {
                seen.push(target);
            }
        }
    }
    seen.into_iter()
}

fn expressions(transition: &Transition) -> impl Iterator<Item = &Expr> {
    transition.clauses.iter().flat_map(|clause| match clause {
        Clause::Condition(condition) => vec![condition],
        Clause::Bind(binder) => {
            let mut all: Vec<&Expr> = binder.condition.iter().chain(&binder.key).collect();
            if let Domain::Range(low, high) = &binder.domain {
                all.extend([low, high]);
            }
            all
        }
    })
}
