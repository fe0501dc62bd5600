//! What expressions need: defines that they read, and whether they may be computed where no guard protects them.

use crate::ir::{Automaton, Clause, Domain, Expr, ExprKind, Model, Operator, Place, Scalar, UpdateKind, Value};
use std::collections::BTreeSet;

/// Whether a `define` is read in guards only, and can be computed before them.
pub fn is_for_guards_only(model: &Model, automaton: &Automaton, define: usize) -> bool {
    let mut elsewhere = BTreeSet::new();
    for state in &automaton.states {
        state.within.iter().for_each(|(longest, _)| defines(automaton, longest, &mut elsewhere));
        for update in state.transitions.iter().flat_map(|t| &t.updates) {
            update_parts(&update.kind).into_iter().for_each(|e| defines(automaton, e, &mut elsewhere));
        }
    }
    !elsewhere.contains(&define) && !may_fault(model, automaton, &automaton.defines[define].value)
}

/// The defines that an expression reads, and those that these read.
fn defines(automaton: &Automaton, expr: &Expr, found: &mut BTreeSet<usize>) {
    if let ExprKind::Define(define) = expr.kind
        && found.insert(define)
    {
        defines(automaton, &automaton.defines[define].value, found);
    }
    expr.parts().into_iter().for_each(|part| defines(automaton, part, found));
}

/// Expressions of an update: of what it writes, and what it stores.
pub fn update_parts(update: &UpdateKind) -> Vec<&Expr> {
    match update {
        UpdateKind::Assign { target, value, .. } | UpdateKind::Fill { target, value, .. } => {
            target.place.parts().into_iter().chain([value]).collect()
        }
        UpdateKind::Copy { target, source, .. } => target.place.parts().into_iter().chain(source.parts()).collect(),
        UpdateKind::Command { arguments, .. } => arguments.iter().map(|a| &a.value).collect(),
    }
}

/// Whether guards of an automaton ask for the answer to its last command: well, in error.
pub fn answers(automaton: &Automaton) -> (bool, bool) {
    let mut found = (false, false);
    for clause in automaton.states.iter().flat_map(|s| &s.transitions).flat_map(|t| &t.clauses) {
        match clause {
            Clause::Condition(condition) => answer(condition, &mut found),
            Clause::Bind(binder) => {
                if let Domain::Range(low, high) = &binder.domain {
                    answer(low, &mut found);
                    answer(high, &mut found);
                }
                binder.condition.iter().chain(&binder.key).for_each(|e| answer(e, &mut found));
            }
        }
    }
    found
}

fn answer(expr: &Expr, found: &mut (bool, bool)) {
    found.0 |= matches!(expr.kind, ExprKind::Done);
    found.1 |= matches!(expr.kind, ExprKind::Failed);
    expr.parts().into_iter().for_each(|part| answer(part, found));
}

/// Whether an expression could index beyond an array, divide by zero or leave 32 bits if what stands before it
/// did not hold: then it must not be computed where that is not tested first.
pub fn may_fault(model: &Model, automaton: &Automaton, expr: &Expr) -> bool {
    let here = match &expr.kind {
        ExprKind::Read(place) => index_may_leave(model, automaton, place),
        ExprKind::Binary(Operator::Divide | Operator::Modulo, _, divisor) => match (&divisor.kind, divisor.ty) {
            (ExprKind::Constant(Value::Real(r)), _) => *r == 0.0,
            (_, Scalar::Int { lo, hi }) => lo <= 0 && hi >= -1,
            _ => true,
        },
        ExprKind::Binary(operator @ (Operator::Add | Operator::Subtract | Operator::Multiply), a, b) => {
            leaves_32_bits(*operator, a.ty, b.ty)
        }
        ExprKind::Define(define) => may_fault(model, automaton, &automaton.defines[*define].value),
        _ => false,
    };
    here || expr.parts().into_iter().any(|part| may_fault(model, automaton, part))
}

fn index_may_leave(model: &Model, automaton: &Automaton, place: &Place) -> bool {
    let (index, extent) = match place {
        Place::Local { local, index } => (index, automaton.locals[*local].ty.extent),
        Place::Parameter { parameter, index } => (index, automaton.parameters[*parameter].ty.extent),
        Place::Port { port, index } => (index, automaton.device.ports[*port].extent.into()),
        Place::Cell { interface, cell, index, .. } => (index, model.interface(*interface).cells[*cell].ty.extent),
        Place::Shown { interface, parameter, index, .. } => {
            (index, model.interface(*interface).parameters[*parameter].ty.extent)
        }
    };
    match index.as_ref().map(|i| i.ty) {
        Some(Scalar::Int { lo, hi }) => lo < 0 || hi as usize >= model.elements(extent),
        _ => false,
    }
}

fn leaves_32_bits(operator: Operator, a: Scalar, b: Scalar) -> bool {
    let bounds = |ty: Scalar| match ty {
        Scalar::Int { lo, hi } => Some((i64::from(lo), i64::from(hi))),
        Scalar::Time => Some((0, i64::from(i32::MAX))),
        _ => None,
    };
    let (Some(a), Some(b)) = (bounds(a), bounds(b)) else { return false };
    let ends = [(a.0, b.0), (a.0, b.1), (a.1, b.0), (a.1, b.1)];
    let fits = |value: i64| i32::try_from(value).is_ok();
    !ends.into_iter().all(|(x, y)| match operator {
        Operator::Add => fits(x + y),
        Operator::Subtract => fits(x - y),
        _ => fits(x * y),
    })
}
