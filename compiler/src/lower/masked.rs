//! Which outputs properties see otherwise than the automaton has set them, as `docs/semantics.md` says.

use crate::ir::{Automaton, Expr, ExprKind, Model, Place};
use std::collections::BTreeSet;

/// Sets [`Automaton::masked`] of every automaton.
pub fn add(model: &mut Model) {
    model.automata.iter_mut().for_each(|automaton| automaton.masked = masked(automaton));
}

fn masked(automaton: &Automaton) -> Vec<usize> {
    if !automaton.can_stop() {
        return Vec::new();
    }
    let mut read = BTreeSet::new();
    for expr in automaton.properties.iter().flat_map(|property| property.exprs()) {
        ports(automaton, expr, &mut read);
    }
    automaton.outputs_that_stop().filter(|port| read.contains(port)).collect()
}

fn ports(automaton: &Automaton, expr: &Expr, read: &mut BTreeSet<usize>) {
    match &expr.kind {
        ExprKind::Read(Place::Port { port, .. }) => {
            read.insert(*port);
        }
        ExprKind::Define(define) => ports(automaton, &automaton.defines[*define].value, read),
        _ => {}
    }
    expr.parts().for_each(|part| ports(automaton, part, read));
}
