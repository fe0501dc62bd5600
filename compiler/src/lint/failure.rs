//! Commands whose failure nobody handles.

use crate::diagnostic::Diagnostic;
use crate::ir::{Automaton, Clause, Domain, Expr, ExprKind, Transition};

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
    for state in &automaton.states {
        let waits = state.transitions.iter().find(|transition| done.guard(transition));
        let handles = state.transitions.iter().any(|transition| failed.guard(transition));
        if let Some(waits) = waits.filter(|_| !handles) {
            let message = format!("`{}` waits for the end of a command, and not for its failure", state.name);
            found.push(
                Diagnostic::new("W0106", waits.place, message)
                    .note("a command that fails is never `done`: the machine would stay in this state")
                    .help("add `when failed -> ...`, or `any state { when failed -> ... }`"),
            );
        }
    }
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
