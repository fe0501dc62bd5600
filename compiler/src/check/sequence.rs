//! A `sequence` of steps, as plain states: one for each thing that is waited for.
//!
//! The state itself issues the first command in its first scan; `State.1`,
//! `State.2` and so on wait for the end of a command, for a condition or a time,
//! and issue what comes next in the scan in which that has come.

use super::context::Context;
use crate::diagnostic::Diagnostic;
use crate::source::Span;
use crate::spec::ast::{
    self, Body, Clause, Expr, ExprKind, Guard, Outcome, State, Step, Transition, Update, UpdateKind,
};

/// What one of the states waits for.
enum Wait {
    /// Nothing: continue at once.
    Nothing,
    Done(Span),
    Condition {
        span: Span,
        condition: Expr,
        at_most: Option<Expr>,
    },
    Time {
        span: Span,
        time: Expr,
    },
}

/// A wait and what is done when it is over.
struct Stage {
    wait: Wait,
    then: Vec<Update>,
}

pub(super) fn expand(context: &mut Context, state: &State, sequence: &ast::Sequence) -> Vec<State> {
    let stages = stages(sequence);
    let can_fail =
        stages.iter().any(|s| matches!(s.wait, Wait::Done(_) | Wait::Condition { at_most: Some(_), .. }));
    if can_fail && sequence.otherwise.is_none() {
        context.report(
            Diagnostic::new(
                "E0329",
                state.name.span,
                format!("the sequence `{}` does not say what follows a failed step", state.name.value),
            )
            .help("write `else State { ... }` after its last state"),
        );
    }
    let last = stages.len() - 1;
    let name = |i: usize| match i {
        0 => state.name.value.clone(),
        _ => format!("{}.{i}", state.name.value),
    };
    stages
        .into_iter()
        .enumerate()
        .map(|(i, stage)| {
            let next = if i == last {
                let mut updates = stage.then;
                updates.extend(sequence.then.updates.iter().cloned());
                Outcome { span: sequence.then.span, target: sequence.then.target.clone(), updates }
            } else {
                let target = ast::Name { value: name(i + 1), span: state.name.span };
                Outcome { span: state.name.span, target, updates: stage.then }
            };
            let (doc, transitions) =
                transitions(&stage.wait, next, sequence.otherwise.as_ref(), state.name.span);
            State {
                doc: if i == 0 && !state.doc.is_empty() { state.doc.clone() } else { vec![doc] },
                name: ast::Name { value: name(i), span: state.name.span },
                is_final: false,
                is_resumable: state.is_resumable,
                within: state.within.clone(),
                body: Body::Transitions(transitions),
            }
        })
        .collect()
}

fn stages(sequence: &ast::Sequence) -> Vec<Stage> {
    let mut stages = vec![Stage { wait: Wait::Nothing, then: Vec::new() }];
    for step in &sequence.steps {
        let wait = match step {
            Step::Act(update) => {
                if let Some(stage) = stages.last_mut() {
                    stage.then.push(update.clone());
                }
                match update.kind {
                    UpdateKind::Command { .. } => Wait::Done(update.span),
                    UpdateKind::Assign { .. } => continue,
                }
            }
            Step::Until { span, condition, at_most } => {
                Wait::Condition { span: *span, condition: condition.clone(), at_most: at_most.clone() }
            }
            Step::Wait { span, time } => Wait::Time { span: *span, time: time.clone() },
        };
        stages.push(Stage { wait, then: Vec::new() });
    }
    // A sequence that begins by waiting needs no scan before it.
    if stages.len() > 1 && stages[0].then.is_empty() {
        stages.remove(0);
    }
    stages
}

fn transitions(
    wait: &Wait,
    next: Outcome,
    otherwise: Option<&Outcome>,
    name: Span,
) -> (String, Vec<Transition>) {
    let fails = |guard, condition| otherwise.map(|o| when(o.span, guard, condition, o.clone()));
    let answer = |span, word: &str| Expr { span, kind: ExprKind::Name(word.into()) };
    let after = |time: &Expr| Expr { span: time.span, kind: ExprKind::After(Box::new(time.clone())) };
    match wait {
        Wait::Nothing => {
            let always = Expr { span: name, kind: ExprKind::Bool(true) };
            ("Begins.".into(), vec![when(name, Guard::AtOnce, always, next)])
        }
        Wait::Done(span) => {
            let failed = fails(Guard::Failed(*span), answer(*span, "failed"));
            let done = when(*span, Guard::Done(*span), answer(*span, "done"), next);
            ("Waits for the end of the command.".into(), failed.into_iter().chain([done]).collect())
        }
        Wait::Condition { span, condition, at_most } => {
            let mut all = vec![when(*span, Guard::Written(condition.span), condition.clone(), next)];
            if let Some(time) = at_most {
                all.extend(fails(Guard::After(time.span), after(time)));
            }
            ("Waits for the condition.".into(), all)
        }
        Wait::Time { span, time } => {
            ("Waits for the time.".into(), vec![when(*span, Guard::After(time.span), after(time), next)])
        }
    }
}

fn when(span: Span, guard: Guard, condition: Expr, outcome: Outcome) -> Transition {
    Transition {
        span,
        guard,
        clauses: vec![Clause::Condition(condition)],
        target: Some(outcome.target),
        updates: outcome.updates,
    }
}
