//! Guards: conditions, and binders as nested loops that leave the chosen values in their variables.

use super::code::{Ex, Stmt, and, assign, binary, name, not, or, when};
use super::context::{Lowering, Phase};
use super::declaration::Basic;
use super::expression::conjuncts;
use super::name::Name;
use crate::ir::{Binder, Clause, Expr, Transition, Update, VariableId};
use std::collections::BTreeSet;

impl Lowering<'_> {
    /// Statements that come first, and the condition; `TRUE` for a transition that always fires.
    pub fn guard(&mut self, transition: &Transition) -> (Vec<Stmt>, Ex) {
        self.phase = Phase::Guard;
        self.release();
        let mut before = Vec::new();
        let condition = match conditions(&transition.clauses) {
            Some(conditions) => self.conditions(&conditions, &mut before),
            None => {
                let used = variables_of(&transition.updates);
                before.push(assign("found", Ex::Bool(false)));
                before.extend(self.choose(&transition.clauses, "found", &used));
                name("found")
            }
        };
        let mut first = std::mem::take(&mut self.hoisted);
        first.extend(before);
        (first, condition)
    }

    fn conditions(&mut self, conditions: &[&Expr], before: &mut Vec<Stmt>) -> Ex {
        let is_safe = conditions.iter().skip(1).all(|c| !self.may_fault(c));
        if is_safe {
            let values = conditions.iter().map(|c| self.value(c, before)).collect();
            return and(values);
        }
        before.push(assign("found", Ex::Bool(false)));
        let then = vec![assign("found", Ex::Bool(true))];
        before.extend(self.if_all(conditions, then));
        name("found")
    }

    /// Sets the flag if the clauses hold together. The flag is false before.
    fn choose(&mut self, clauses: &[Clause], flag: &str, used: &BTreeSet<VariableId>) -> Vec<Stmt> {
        let split = clauses.iter().position(|c| matches!(c, Clause::Bind(_))).unwrap_or(clauses.len());
        let leading: Vec<&Expr> = clauses[..split].iter().flat_map(clause_conjuncts).collect();
        let then = match &clauses[split..] {
            [Clause::Bind(binder), rest @ ..] => self.candidates(binder, rest, flag, used),
            _ => vec![assign(flag, Ex::Bool(true))],
        };
        self.if_all(&leading, then)
    }

    /// The loop over the candidates of a binder.
    fn candidates(
        &mut self,
        binder: &Binder,
        rest: &[Clause],
        flag: &str,
        used: &BTreeSet<VariableId>,
    ) -> Vec<Stmt> {
        let mut out = Vec::new();
        let own: Vec<&Expr> = binder.condition.iter().flat_map(conjuncts).collect();
        let Some(key) = &binder.key else {
            self.each(binder.variable, &binder.domain, &mut out, |lowering| {
                let mut body = lowering.choose(rest, flag, used);
                let is_last = body == [assign(flag, Ex::Bool(true))];
                if is_last {
                    body.push(Stmt::Exit);
                }
                let mut body = lowering.if_all(&own, body);
                if !is_last {
                    body.push(when(name(flag), vec![Stmt::Exit]));
                }
                body
            });
            return out;
        };
        let variable = self.own().variables[binder.variable.0].clone();
        let basic = Basic::of(key.ty);
        let own_key = self.temporary(&format!("{variable}_key"), basic);
        let least = self.temporary(&format!("{variable}_least"), basic);
        // The choice, and those of later binders that go with it.
        let chosen: BTreeSet<VariableId> = [binder.variable]
            .into_iter()
            .chain(rest.iter().filter_map(bound))
            .filter(|v| used.contains(v))
            .collect();
        let names: Vec<Name> = chosen.iter().map(|v| self.own().variables[v.0].clone()).collect();
        let best: Vec<(String, Name)> =
            names.into_iter().map(|v| (self.temporary(&format!("{v}_best"), Basic::Dint), v)).collect();
        let mut remember = vec![assign(flag, Ex::Bool(true)), assign(&least, name(&own_key))];
        remember.extend(best.iter().map(|(best, v)| assign(best, name(v))));
        self.each(binder.variable, &binder.domain, &mut out, |lowering| {
            let mut inner = Vec::new();
            let value = lowering.value(key, &mut inner);
            inner.push(assign(&own_key, value));
            let is_less = binary("<", name(&own_key), name(&least));
            let is_better = or(vec![not(name(flag)), is_less]);
            let then = if rest.is_empty() {
                remember
            } else {
                let fits = lowering.temporary(&format!("{variable}_fits"), Basic::Bool);
                let mut then = vec![assign(&fits, Ex::Bool(false))];
                then.extend(lowering.choose(rest, &fits, used));
                then.push(when(name(&fits), remember));
                then
            };
            inner.push(when(is_better, then));
            lowering.if_all(&own, inner)
        });
        let restore: Vec<Stmt> = best.iter().map(|(best, v)| assign(v, name(best))).collect();
        if !restore.is_empty() {
            out.push(when(name(flag), restore));
        }
        out
    }
}

/// The conditions of a guard without binders.
fn conditions(clauses: &[Clause]) -> Option<Vec<&Expr>> {
    let is_plain = clauses.iter().all(|c| matches!(c, Clause::Condition(_)));
    is_plain.then(|| clauses.iter().flat_map(clause_conjuncts).collect())
}

fn clause_conjuncts(clause: &Clause) -> Vec<&Expr> {
    match clause {
        Clause::Condition(condition) => conjuncts(condition),
        Clause::Bind(_) => Vec::new(),
    }
}

fn bound(clause: &Clause) -> Option<VariableId> {
    match clause {
        Clause::Bind(binder) => Some(binder.variable),
        Clause::Condition(_) => None,
    }
}

/// Variables that updates read.
fn variables_of(updates: &[Update]) -> BTreeSet<VariableId> {
    let mut found = BTreeSet::new();
    for update in updates {
        update.kind.exprs().into_iter().for_each(|part| variables_in(part, &mut found));
    }
    found
}

fn variables_in(expr: &Expr, found: &mut BTreeSet<VariableId>) {
    if let crate::ir::ExprKind::Variable(id) = expr.kind {
        found.insert(id);
    }
    expr.parts().for_each(|part| variables_in(part, found));
}
