//! Which locks a machine has in which of its states.

use crate::ir::{
    Automaton, Clause, Expr, ExprKind, InterfaceId, Operator, Place, Rule, StateId, System, Transition,
    UpdateKind, Value,
};
use std::collections::BTreeSet;

/// A truth of another machine, or of one's own, that is set by whoever finds it false: by the local that names the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Lock {
    pub interface: InterfaceId,
    pub cell: usize,
    /// None: one's own.
    pub of: Option<usize>,
}

/// Those that a machine has in each state, whatever has happened before.
pub fn held(system: &System, automaton: &Automaton) -> Vec<BTreeSet<Lock>> {
    let mut held: Vec<Option<BTreeSet<Lock>>> = vec![None; automaton.states.len()];
    held[0] = Some(BTreeSet::new());
    let mut has_changed = true;
    while std::mem::take(&mut has_changed) {
        for (number, state) in automaton.states.iter().enumerate() {
            let Some(before) = held[number].clone() else { continue };
            for transition in &state.transitions {
                let StateId(target) = transition.target.unwrap_or(StateId(number));
                let after = after(system, transition, &before);
                let all = match &held[target] {
                    None => after,
                    Some(known) => known.intersection(&after).copied().collect(),
                };
                if held[target].as_ref() != Some(&all) {
                    held[target] = Some(all);
                    has_changed = true;
                }
            }
        }
    }
    held.into_iter().map(Option::unwrap_or_default).collect()
}

/// Those that it has behind a transition.
pub fn after(system: &System, transition: &Transition, before: &BTreeSet<Lock>) -> BTreeSet<Lock> {
    let mut held = before.clone();
    let chosen = chosen(transition);
    held.retain(|lock| lock.of.is_none_or(|local| !chosen.contains(&local)));
    for update in &transition.updates {
        let UpdateKind::Assign { target, value, .. } = &update.kind else { continue };
        if let Place::Cell { interface, cell, of, index: None } = &target.place {
            let Some(of) = named(of.as_deref(), transition) else { continue };
            let lock = Lock { interface: *interface, cell: *cell, of };
            let rule = |cell: usize| &system.model.interface(*interface).cells[cell].rule;
            match (&value.kind, rule(*cell)) {
                (ExprKind::Constant(Value::Bool(true)), Rule::Lock) => {
                    held.insert(lock);
                }
                (ExprKind::Constant(Value::Bool(true)), Rule::Handshake) if of.is_some() => {
                    if finds_false(transition, &target.place) {
                        held.insert(lock);
                    } else {
                        // It reports an end: the owner resets what was claimed.
                        held.retain(|lock| {
                            (lock.interface, lock.of) != (*interface, of)
                                || !matches!(rule(lock.cell), Rule::Handshake)
                        });
                    }
                }
                _ => {
                    held.remove(&lock);
                }
            }
        }
    }
    held
}

/// Whether a machine sets a lock of its own.
pub fn locks_itself(system: &System, instance: usize) -> bool {
    let transitions = system.automaton_of(instance).states.iter().flat_map(|state| &state.transitions);
    let mut updates = transitions.flat_map(|transition| &transition.updates);
    updates.any(|update| match &update.kind {
        UpdateKind::Assign { target, value, .. } => match &target.place {
            Place::Cell { interface, cell, of, .. } => {
                let is_own = of.as_ref().is_none_or(|of| matches!(of.kind, ExprKind::Own(_)));
                let is_lock = matches!(system.model.interface(*interface).cells[*cell].rule, Rule::Lock);
                is_own && is_lock && value.kind == ExprKind::Constant(Value::Bool(true))
            }
            _ => false,
        },
        _ => false,
    })
}

/// The locals that a transition writes.
pub fn chosen(transition: &Transition) -> BTreeSet<usize> {
    let written = transition.updates.iter().filter_map(|update| match update.kind.target()?.place {
        Place::Local { local, .. } => Some(local),
        _ => None,
    });
    written.collect()
}

/// The local that names a machine behind a transition; the outer none where none does.
fn named(of: Option<&Expr>, transition: &Transition) -> Option<Option<usize>> {
    match of.map(|of| &of.kind) {
        None | Some(ExprKind::Own(_)) => Some(None),
        Some(ExprKind::Read(Place::Local { local, index: None })) => Some(Some(*local)),
        Some(ExprKind::Variable(_)) => {
            let local = transition.updates.iter().find_map(|update| match &update.kind {
                UpdateKind::Assign { target, value, .. } if Some(value) == of => match target.place {
                    Place::Local { local, index: None } => Some(local),
                    _ => None,
                },
                _ => None,
            });
            local.map(Some)
        }
        Some(_) => None,
    }
}

/// Whether the guard holds only while a cell is false.
fn finds_false(transition: &Transition, place: &Place) -> bool {
    let conditions = transition.clauses.iter().filter_map(|clause| match clause {
        Clause::Condition(condition) => Some(condition),
        Clause::Bind(binder) => binder.condition.as_ref(),
    });
    conditions.into_iter().any(|condition| requires_false(condition, place))
}

fn requires_false(condition: &Expr, place: &Place) -> bool {
    match &condition.kind {
        ExprKind::Binary(Operator::And, a, b) => requires_false(a, place) || requires_false(b, place),
        ExprKind::Not(of) => matches!(&of.kind, ExprKind::Read(read) if read == place),
        _ => false,
    }
}
