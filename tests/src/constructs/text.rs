//! Constructs that are expanded on the way to the representation, as the text has them.

use super::meaning::Names;
use autogen::source::Span;
use autogen::spec::ast::{
    Assign, Automaton, Body, Choice, Clause, Sequence, Step, Transition, Update, UpdateKind,
};

/// Of those transitions for which `counts` holds.
pub fn automaton(tree: &Automaton, counts: &dyn Fn(Span) -> bool, names: &mut Names) {
    if let Some(initial) = &tree.initial
        && counts(initial.span)
    {
        names.add("initial ->");
        updates(&initial.updates, names);
    }
    for any in &tree.any {
        for transition in any.transitions.iter().filter(|t| counts(t.span)) {
            names.add("any state");
            if !any.except.is_empty() {
                names.add("any state: except");
            }
            self::transition(transition, names);
        }
    }
    for state in &tree.states {
        match &state.body {
            Body::Transitions(all) => {
                all.iter().filter(|t| counts(t.span)).for_each(|t| transition(t, names))
            }
            Body::Sequence(all) => sequence(all, state.name.span, counts, names),
        }
    }
}

fn sequence(sequence: &Sequence, name: Span, counts: &dyn Fn(Span) -> bool, names: &mut Names) {
    if let Some(otherwise) = sequence.otherwise.as_ref().filter(|o| counts(o.span)) {
        names.add("sequence: else");
        updates(&otherwise.updates, names);
    }
    // All of its steps were made when the last wait of it has ended.
    let mut waits = sequence.steps.iter().filter_map(|step| match step {
        Step::Act(Update { kind: UpdateKind::Assign { .. }, .. }) => None,
        Step::Act(update) => Some(update.span),
        Step::Until { span, .. } | Step::Wait { span, .. } => Some(*span),
    });
    if !counts(waits.next_back().unwrap_or(name)) {
        return;
    }
    names.add("sequence");
    updates(&sequence.then.updates, names);
    for step in &sequence.steps {
        match step {
            Step::Act(update) => {
                match update.kind {
                    UpdateKind::Assign { .. } => names.add("sequence: assignment"),
                    UpdateKind::Command { .. } => names.add("sequence: command"),
                }
                updates(std::slice::from_ref(update), names);
            }
            Step::Until { span: _, condition: _, at_most: Some(_) } => names.add("sequence: until, at most"),
            Step::Until { span: _, condition: _, at_most: None } => names.add("sequence: until"),
            Step::Wait { span: _, time: _ } => names.add("sequence: wait"),
        }
    }
}

fn transition(transition: &Transition, names: &mut Names) {
    for clause in &transition.clauses {
        match clause {
            Clause::Condition(_) => {}
            Clause::Bind(binder) => names.add(match &binder.choice {
                Choice::First => "text: first",
                Choice::Least(_) => "text: least",
                Choice::Nearest(..) => "text: nearest",
            }),
        }
    }
    updates(&transition.updates, names);
}

fn updates(updates: &[Update], names: &mut Names) {
    for update in updates {
        match &update.kind {
            UpdateKind::Assign { how, .. } => names.add(match how {
                Assign::Set => "text: :=",
                Assign::Add => "text: +=",
                Assign::Subtract => "text: -=",
            }),
            UpdateKind::Command { verb, .. } => names.add(format!("text: {}()", verb.value)),
        }
    }
}
