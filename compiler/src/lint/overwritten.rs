//! Updates without effect: a later one of the same transition writes the same value anew, and nothing has read it.

use crate::diagnostic::Diagnostic;
use crate::ir::{Automaton, Expr, ExprKind, Place, Update, UpdateKind};

pub fn check(automaton: &Automaton, found: &mut Vec<Diagnostic>) {
    for transition in automaton.states.iter().flat_map(|state| &state.transitions) {
        for (number, update) in transition.updates.iter().enumerate() {
            let later = &transition.updates[number + 1..];
            let Some(by) = overwriting(automaton, update, later).filter(|_| !may_fault(update)) else {
                continue;
            };
            found.push(
                Diagnostic::new("W0111", update.place, "this update has no effect")
                    .other(by.place, "this one writes the same, and nothing has read it before")
                    .help("remove one of the two"),
            );
        }
    }
}

/// Whether it stops the line where the value is outside of the bounds: that is an effect.
fn may_fault(update: &Update) -> bool {
    match &update.kind {
        UpdateKind::Assign { check, .. }
        | UpdateKind::Fill { check, .. }
        | UpdateKind::Copy { check, .. } => check.is_some(),
        UpdateKind::Command { .. } => false,
    }
}

/// The first of these that writes what the update writes, if none before it, nor itself, reads that, or changes which
/// element or whose cell it is.
fn overwriting<'a>(automaton: &Automaton, update: &Update, later: &'a [Update]) -> Option<&'a Update> {
    let written = &update.kind.target()?.place;
    for next in later {
        if reads(automaton, &next.kind, written) {
            return None;
        }
        if next.kind.target().is_some_and(|target| target.place == *written) {
            return Some(next);
        }
        let changes = |target: &Place| written.parts().any(|part| asks(automaton, part, target));
        if next.kind.target().is_some_and(|target| changes(&target.place)) {
            return None;
        }
    }
    None
}

fn reads(automaton: &Automaton, update: &UpdateKind, place: &Place) -> bool {
    let is_copied = matches!(update, UpdateKind::Copy { source, .. } if is_same_variable(source, place));
    is_copied || update.exprs().into_iter().any(|expr| asks(automaton, expr, place))
}

/// Through definitions too.
fn asks(automaton: &Automaton, expr: &Expr, place: &Place) -> bool {
    match &expr.kind {
        ExprKind::Define(define) => asks(automaton, &automaton.defines[*define].value, place),
        ExprKind::Read(read) if is_same_variable(read, place) => true,
        _ => expr.parts().any(|part| asks(automaton, part, place)),
    }
}

/// Whichever element and whichever instance.
fn is_same_variable(a: &Place, b: &Place) -> bool {
    match (a, b) {
        (Place::Local { local: a, .. }, Place::Local { local: b, .. }) => a == b,
        (Place::Port { port: a, .. }, Place::Port { port: b, .. }) => a == b,
        (Place::Cell { interface: a, cell: of_a, .. }, Place::Cell { interface: b, cell: of_b, .. }) => {
            (a, of_a) == (b, of_b)
        }
        _ => false,
    }
}
