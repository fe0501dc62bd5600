//! States and transitions.

use super::context::Context;
use super::names::Space;
use super::sequence;
use crate::diagnostic::{Diagnostic, suggestion};
use crate::ir::{self, Asking, ExprKind, Place, Scalar, StateId};
use crate::spec::{ast, written};
use std::collections::BTreeMap;

/// The beginning, before the first step.
const BEGINNING: &str = "Initial";

/// Plain states of the tree: sequences expanded, transitions of `any state` put before those of each state.
fn plain(context: &mut Context, tree: &ast::Automaton) -> Vec<ast::State> {
    let mut states = Vec::new();
    for state in &tree.states {
        match &state.body {
            ast::Body::Transitions(_) => states.push(state.clone()),
            ast::Body::Sequence(sequence) => states.extend(sequence::expand(context, state, sequence)),
        }
    }
    for any in tree.any.iter().rev() {
        for name in &any.except {
            context.checker.uses(name.span, Space::States, &tree.name.value, &name.value);
            if !tree.states.iter().any(|s| s.name.value == name.value) {
                unknown_state(context, tree, name);
            }
        }
        for state in &mut states {
            let base = state.name.value.split('.').next().unwrap_or_default().to_string();
            if state.is_final || any.except.iter().any(|n| n.value == base) {
                continue;
            }
            if let ast::Body::Transitions(own) = &mut state.body {
                own.splice(0..0, any.transitions.iter().cloned());
            }
        }
    }
    states
}

pub(super) fn check(context: &mut Context, tree: &ast::Automaton) {
    let mut names: BTreeMap<String, ast::Name> = BTreeMap::new();
    for state in &tree.states {
        if state.name.value == BEGINNING {
            context.report(
                Diagnostic::new(
                    "E0301",
                    state.name.span,
                    format!("`{BEGINNING}` is the name of the state before the first step"),
                )
                .help("choose another name for this state"),
            );
        }
        if let Some(before) = names.insert(state.name.value.clone(), state.name.clone()) {
            context.report(
                Diagnostic::new(
                    "E0301",
                    state.name.span,
                    format!("there are two states `{}`", state.name.value),
                )
                .other(before.span, "first here")
                .help("rename or remove one of them"),
            );
        }
    }
    if tree.initial.is_none() {
        context.report(
            Diagnostic::new("E0326", tree.name.span, format!("`{}` has no initial state", tree.name.value))
                .help("write `initial state ...`, or `initial -> State { updates }`"),
        );
    }
    let states = plain(context, tree);
    // The beginning is number 0.
    let number = |name: &str| states.iter().position(|s| s.name.value == name).map(|i| StateId(i + 1));
    let beginning = tree.initial.as_ref().and_then(|initial| {
        let always = ast::Expr { span: initial.span, kind: ast::ExprKind::Bool(true) };
        let first = ast::Transition {
            span: initial.span,
            clauses: vec![ast::Clause::Condition(always)],
            guard: ast::Guard::FirstStep,
            target: Some(initial.target.clone()),
            updates: initial.updates.clone(),
        };
        transition(context, tree, &first, &number)
    });
    context.automaton.states.push(ir::State {
        name: BEGINNING.into(),
        doc: vec!["Before the first step.".into()],
        place: tree.initial.as_ref().map_or(tree.name.span, |i| i.span),
        is_final: false,
        is_resumable: false,
        within: None,
        transitions: beginning.into_iter().collect(),
    });
    for state in &states {
        let ast::Body::Transitions(trees) = &state.body else { continue };
        let within = state.within.as_ref().and_then(|time| context.typed(time, Scalar::Time)).map(|time| {
            let text = format!("`{}` has lasted too long", state.name.value);
            (time, context.fault(ir::FaultKind::TooLong, state.name.span, text))
        });
        let transitions: Vec<_> =
            trees.iter().filter_map(|t| transition(context, tree, t, &number)).collect();
        match (state.is_final, trees.is_empty()) {
            (true, false) => context.report(
                Diagnostic::new(
                    "E0327",
                    state.name.span,
                    format!("the final state `{}` has transitions", state.name.value),
                )
                .help("remove `final`, or the transitions"),
            ),
            (false, true) => context.report(
                Diagnostic::new(
                    "E0327",
                    state.name.span,
                    format!("no transition leaves `{}`", state.name.value),
                )
                .help("write `final state` if the automaton ends here"),
            ),
            _ => {}
        }
        context.automaton.states.push(ir::State {
            name: state.name.value.clone(),
            doc: state.doc.clone(),
            place: state.name.span,
            is_final: state.is_final,
            is_resumable: state.is_resumable,
            within,
            transitions,
        });
    }
    tree.states.iter().filter(|state| state.is_resumable).for_each(|state| resumable(context, state));
    if let Some(initial) = &tree.initial {
        unreachable_states(context, &initial.target.value, &states);
    }
}

/// A machine that continues after it was moved by hand, or power was lost, has no command under way any more.
fn resumable(context: &mut Context, state: &ast::State) {
    let automaton = &context.automaton;
    let asks_failed = Asking::new(automaton, |kind| *kind == ExprKind::Failed);
    let waits = Asking::new(automaton, |kind| match kind {
        ExprKind::Done => true,
        ExprKind::Read(Place::Port { port, .. }) => {
            matches!(automaton.device.ports[*port].name.as_str(), "got" | "ack" | "error")
        }
        _ => false,
    });
    let found = automaton.states.iter().find(|found| found.name == state.name.value);
    let is_stuck = found.is_some_and(|found| {
        found.transitions.iter().any(|t| waits.guard(t))
            && !found.transitions.iter().any(|t| asks_failed.guard(t))
    });
    let reason = match &state.body {
        _ if state.is_final => "it is a final state",
        ast::Body::Transitions(_) if is_stuck => {
            "it waits for the answer to a command, and has no transition for `failed`"
        }
        _ => return,
    };
    context.report(
        Diagnostic::new(
            "E0336",
            state.name.span,
            format!(
                "a machine cannot continue in `{}` after it was moved by hand: {reason}",
                state.name.value
            ),
        )
        .help("remove `resume`: the machine then begins anew; or add `when failed -> ...`, which then holds"),
    );
}

/// From the text, so that a transition with an error still leads to its state. A name that is no state's leads to the
/// state that is probably meant, or else to any.
fn unreachable_states(context: &mut Context, first: &str, states: &[ast::State]) {
    let number = |name: &str| states.iter().position(|s| s.name.value == name);
    let meant = |name: &str| {
        let names = states.iter().map(|state| state.name.value.as_str());
        number(name).or_else(|| number(suggestion(name, names)?))
    };
    let mut reached = vec![false; states.len()];
    let mut open: Vec<Option<usize>> = vec![meant(first)];
    while let Some(state) = open.pop() {
        let Some(state) = state else { return };
        if std::mem::replace(&mut reached[state], true) {
            continue;
        }
        let ast::Body::Transitions(transitions) = &states[state].body else { continue };
        open.extend(transitions.iter().filter_map(|t| t.target.as_ref()).map(|target| meant(&target.value)));
    }
    let is_lost = |name: &str| !name.contains('.') && number(name).is_some_and(|n| !reached[n]);
    for state in states.iter().filter(|s| is_lost(&s.name.value)) {
        context.report(
            Diagnostic::new(
                "E0328",
                state.name.span,
                format!("no transition leads to `{}`", state.name.value),
            )
            .help("add a transition to it, or remove the state"),
        );
    }
}

fn unknown_state(context: &mut Context, tree: &ast::Automaton, name: &ast::Name) {
    let known = tree.states.iter().map(|s| s.name.value.as_str());
    let help = suggestion(&name.value, known)
        .map_or(format!("declare `state {} {{ ... }}`", name.value), |n| format!("is `{n}` meant?"));
    context.report(
        Diagnostic::new("E0311", name.span, format!("there is no state `{}`", name.value)).help(help),
    );
}

fn transition(
    context: &mut Context,
    automaton: &ast::Automaton,
    tree: &ast::Transition,
    number: &dyn Fn(&str) -> Option<StateId>,
) -> Option<ir::Transition> {
    context.facts = context.required.clone();
    let depth = context.variables.len();
    context.in_guard = true;
    let mut clauses = Vec::new();
    let mut whole = true;
    for clause in &tree.clauses {
        match context.clause(clause) {
            Some(clause) => clauses.push(clause),
            None => whole = false,
        }
    }
    context.in_guard = false;
    let target = match &tree.target {
        None => None,
        Some(name) => {
            let target = number(&name.value);
            context.checker.uses(name.span, Space::States, &automaton.name.value, &name.value);
            if target.is_none() {
                unknown_state(context, automaton, name);
                whole = false;
            }
            target
        }
    };
    let commands: Vec<_> =
        tree.updates.iter().filter(|u| matches!(u.kind, ast::UpdateKind::Command { .. })).collect();
    if let [first, second, ..] = commands.as_slice() {
        context.report(
            Diagnostic::new(
                "E0334",
                second.span,
                "this command would replace another one of the same transition",
            )
            .other(first.span, "the device would never see this command")
            .help("give them one after another: in two states, or as steps of a `sequence`"),
        );
    }
    let mut updates = Vec::new();
    for update in &tree.updates {
        match context.update(update) {
            Some(update) => updates.push(update),
            None => whole = false,
        }
    }
    context.variables.truncate(depth);
    context.facts = context.required.clone();
    let text = guard_text(context, tree.guard);
    whole.then_some(ir::Transition { place: tree.span, text, clauses, target, updates })
}

fn guard_text(context: &Context, guard: ast::Guard) -> String {
    let on_one_line = |span| written::on_one_line(context.checker.sources.text(span));
    match guard {
        ast::Guard::Written(span) => match on_one_line(span).as_str() {
            "true" => "at once".into(),
            text => text.into(),
        },
        ast::Guard::FirstStep => "the first step".into(),
        ast::Guard::AtOnce => "at once".into(),
        ast::Guard::Done(span) => format!("{} is done", on_one_line(span)),
        ast::Guard::Failed(span) => format!("{} has failed", on_one_line(span)),
        ast::Guard::After(span) => format!("after {}", on_one_line(span)),
    }
}

impl Context<'_, '_> {
    fn clause(&mut self, tree: &ast::Clause) -> Option<ir::Clause> {
        match tree {
            ast::Clause::Condition(tree) => {
                let condition = self.typed(tree, Scalar::Bool)?;
                self.facts.learn(&condition, true);
                Some(ir::Clause::Condition(condition))
            }
            ast::Clause::Bind(tree) => self.binder(tree).map(ir::Clause::Bind),
        }
    }

    fn binder(&mut self, tree: &ast::Binder) -> Option<ir::Binder> {
        let Some((domain, ty, _)) = self.domain(&tree.domain) else {
            self.broken.insert(tree.variable.value.clone());
            return None;
        };
        let variable = self.bind(&tree.variable, ty);
        let condition = match &tree.condition {
            None => None,
            Some(condition) => {
                let condition = self.typed(condition, Scalar::Bool)?;
                self.facts.learn(&condition, true);
                Some(condition)
            }
        };
        let key = match &tree.choice {
            ast::Choice::First => None,
            ast::Choice::Least(key) => {
                let expr = self.expr(key, None)?;
                if !matches!(expr.ty, Scalar::Int { .. } | Scalar::Real | Scalar::Time) {
                    let name = self.checker.type_name(expr.ty);
                    self.report(
                        Diagnostic::new(
                            "E0315",
                            key.span,
                            format!("values of type {name} cannot be ordered"),
                        )
                        .help("write a number or a time after `by`"),
                    );
                    return None;
                }
                Some(expr)
            }
            ast::Choice::Nearest(from, to) => {
                let (from, to) = (self.typed(from, Scalar::Point)?, self.typed(to, Scalar::Point)?);
                let kind = ir::ExprKind::SquaredDistance(Box::new(from), Box::new(to));
                Some(ir::Expr { ty: Scalar::Real, kind })
            }
        };
        Some(ir::Binder { variable, domain, condition, key })
    }
}
