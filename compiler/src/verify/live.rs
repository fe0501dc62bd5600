//! What of an instance is of no use in a state: whatever it holds, it is written before it is read.

use super::properties::{read_by, searched};
use super::{Asked, Remembered};
use crate::ir::{Automaton, Clause, Domain, Expr, ExprKind, Place, Update, UpdateKind};
use std::collections::BTreeSet;

/// Locals by their numbers; behind them the answer of the last command.
type Set = BTreeSet<usize>;

/// For each state what may be read before it is written; the number of the locals stands for the answer.
pub fn live(automaton: &Automaton, asked: &Asked) -> Vec<Set> {
    let mut always = Set::new();
    searched(automaton, asked).flat_map(read_by).for_each(|read| expr(automaton, read, &mut always));
    if asked.remembered == Remembered::Whole {
        always.extend(0..=automaton.locals.len());
    }
    let mut live = vec![always; automaton.states.len()];
    loop {
        let mut has_changed = false;
        for (number, state) in automaton.states.iter().enumerate() {
            let mut found = live[number].clone();
            for transition in &state.transitions {
                let mut after = live[transition.target.map_or(number, |target| target.0)].clone();
                transition.updates.iter().rev().for_each(|update| before(automaton, update, &mut after));
                transition.clauses.iter().for_each(|clause| self::clause(automaton, clause, &mut after));
                found.extend(after);
            }
            has_changed |= found.len() > live[number].len();
            live[number] = found;
        }
        if !has_changed {
            return live;
        }
    }
}

/// What is live before an update, from what is live after it.
fn before(automaton: &Automaton, update: &Update, live: &mut Set) {
    match &update.kind {
        UpdateKind::Assign { target, value, .. } => {
            if let Place::Local { local, index: None } = &target.place {
                live.remove(local);
            }
            target.place.parts().into_iter().for_each(|part| expr(automaton, part, live));
            expr(automaton, value, live);
        }
        UpdateKind::Fill { target, value, .. } => {
            if let Place::Local { local, .. } = &target.place {
                live.remove(local);
            }
            target.place.parts().into_iter().for_each(|part| expr(automaton, part, live));
            expr(automaton, value, live);
        }
        UpdateKind::Copy { target, source, .. } => {
            if let Place::Local { local, .. } = &target.place {
                live.remove(local);
            }
            target.place.parts().into_iter().for_each(|part| expr(automaton, part, live));
            place(automaton, source, live);
        }
        UpdateKind::Command { arguments, .. } => {
            live.remove(&automaton.locals.len());
            arguments.iter().for_each(|argument| expr(automaton, &argument.value, live));
        }
    }
}

fn clause(automaton: &Automaton, clause: &Clause, live: &mut Set) {
    match clause {
        Clause::Condition(condition) => expr(automaton, condition, live),
        Clause::Bind(binder) => {
            if let Domain::Range(low, high) = &binder.domain {
                expr(automaton, low, live);
                expr(automaton, high, live);
            }
            binder.condition.iter().chain(&binder.key).for_each(|part| expr(automaton, part, live));
        }
    }
}

fn expr(automaton: &Automaton, of: &Expr, live: &mut Set) {
    match &of.kind {
        ExprKind::Done | ExprKind::Failed => {
            live.insert(automaton.locals.len());
        }
        ExprKind::Define(define) => expr(automaton, &automaton.defines[*define].value, live),
        ExprKind::Read(read) => place(automaton, read, live),
        _ => of.parts().into_iter().for_each(|part| expr(automaton, part, live)),
    }
}

fn place(automaton: &Automaton, read: &Place, live: &mut Set) {
    match read {
        Place::Local { local, .. } => {
            live.insert(*local);
        }
        Place::Port { port, .. } if automaton.device.ports[*port].name == "error" => {
            live.insert(automaton.locals.len());
        }
        Place::Port { .. } | Place::Cell { .. } | Place::Parameter { .. } | Place::Shown { .. } => {}
    }
    read.parts().into_iter().for_each(|part| expr(automaton, part, live));
}
