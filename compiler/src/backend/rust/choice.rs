//! The choice of a transition's variables: binders as nested loops.

use super::context::Context;
use super::expression::{Condition, all};
use super::walk::Uses;
use crate::ir::{Binder, Clause, Domain, Scalar, Transition, VariableId};
use std::fmt::Write;

/// How a transition is tested.
pub struct Test {
    /// Behind `if`; `None` if it always fires.
    pub condition: Option<String>,
    /// The method that chooses, if there is one.
    pub method: Option<String>,
}

/// A clause of a guard with binders: conditions have been put behind the binder after which they stand.
struct Loop<'a> {
    binder: &'a Binder,
    /// The binder and the conditions behind it.
    clauses: &'a [Clause],
    conditions: Vec<Condition>,
}

impl Context<'_> {
    pub fn test(&self, transition: &Transition, method: &str) -> Test {
        let split = transition.clauses.iter().position(|c| matches!(c, Clause::Bind(_)));
        let (leading, bound) = transition.clauses.split_at(split.unwrap_or(transition.clauses.len()));
        let mut conditions = self.conditions(leading);
        if bound.is_empty() {
            return Test { condition: all(&conditions), method: None };
        }
        let loops = self.loops(bound);
        let updates = Uses::of_updates(self.automaton(), &transition.updates);
        let chosen: Vec<VariableId> =
            loops.iter().map(|l| l.binder.variable).filter(|v| updates.variables.contains(v)).collect();
        let is_simple = loops.len() == 1 && loops[0].binder.key.is_none();
        if is_simple && chosen.is_empty() {
            conditions.push(self.any(&loops[0]));
            return Test { condition: all(&conditions), method: None };
        }
        let names = tuple(chosen.iter().map(|v| self.variable(*v)));
        let types = tuple(chosen.iter().map(|v| self.scalar(self.automaton().variables[v.0].ty.scalar)));
        let uses = Uses::of_clauses(self.automaton(), bound);
        let uses = Uses { cells: uses.cells.min(super::walk::Access::Read), ..uses };
        let call = format!("self.{method}({})", self.arguments(&uses));
        let (result, condition) = if chosen.is_empty() {
            ("bool".to_string(), call)
        } else {
            (format!("Option<{types}>"), format!("let Some({names}) = {call}"))
        };
        conditions.push(Condition::new(condition));
        let body = if is_simple { self.find(&loops[0]) } else { self.search(&loops, &chosen) };
        let parameters = self.parameters(&uses);
        let separator = if parameters.is_empty() { "" } else { ", " };
        let method = format!("fn {method}(&self{separator}{parameters}) -> {result} {{ {body} }}");
        Test { condition: all(&conditions), method: Some(method) }
    }

    /// Without those that are always true.
    pub fn conditions(&self, clauses: &[Clause]) -> Vec<Condition> {
        let of_clause = |clause: &Clause| match clause {
            Clause::Condition(condition) => self.condition(condition),
            Clause::Bind(_) => None,
        };
        clauses.iter().filter_map(of_clause).collect()
    }

    fn loops<'c>(&self, clauses: &'c [Clause]) -> Vec<Loop<'c>> {
        let mut loops: Vec<Loop> = Vec::new();
        for (i, clause) in clauses.iter().enumerate() {
            let Clause::Bind(binder) = clause else { continue };
            let is_binder = |clause: &Clause| matches!(clause, Clause::Bind(_));
            let behind = clauses[i + 1..].iter().position(is_binder).map_or(clauses.len(), |n| i + 1 + n);
            let clauses = &clauses[i..behind];
            loops.push(Loop { binder, clauses, conditions: self.conditions(clauses) });
        }
        loops
    }

    /// The condition of the binder and those behind it.
    fn candidate(&self, step: &Loop) -> Vec<Condition> {
        let own = step.binder.condition.as_ref().and_then(|c| self.condition(c));
        own.into_iter().chain(step.conditions.iter().cloned()).collect()
    }

    fn any(&self, step: &Loop) -> Condition {
        let body = all(&self.candidate(step));
        let Some(body) = body else { return self.not_empty(&step.binder.domain) };
        let name = self.loop_pattern(std::slice::from_ref(step), &[]);
        Condition::new(format!("{}.any(|{name}| {body})", self.iterator(&step.binder.domain)))
    }

    fn find(&self, step: &Loop) -> String {
        let domain = &step.binder.domain;
        let copied = if matches!(domain, Domain::Role(_)) { ".copied()" } else { "" };
        let Some(condition) = all(&self.candidate(step)) else {
            return format!("{}{copied}", self.first(domain));
        };
        let values = format!("{}{copied}", self.iterator(domain));
        let variable = step.binder.variable;
        let is_read = Uses::of_clauses(self.automaton(), step.clauses).variables.contains(&variable);
        let pattern = if is_read { format!("&{}", self.variable(variable)) } else { "_".into() };
        format!("{values}.find(|{pattern}| {condition})")
    }

    /// The first value of a domain, if there is one; a reference to it for a role.
    fn first(&self, domain: &Domain) -> String {
        match domain {
            Domain::Role(role) => format!("self.parameters.{}.first()", self.own().roles[role.0]),
            _ => format!("{}.next()", self.iterator(domain)),
        }
    }

    fn not_empty(&self, domain: &Domain) -> Condition {
        Condition::new(match domain {
            Domain::Role(role) => format!("!self.parameters.{}.is_empty()", self.own().roles[role.0]),
            _ => format!("{}.is_some()", self.first(domain)),
        })
    }

    /// Conditions, and the loops behind them. A last loop that would end with its first value is a condition too.
    fn ahead<'l, 'c>(
        &self,
        mut conditions: Vec<Condition>,
        rest: &'l [Loop<'c>],
        chosen: &[VariableId],
    ) -> (Vec<Condition>, &'l [Loop<'c>]) {
        let [last] = rest else { return (conditions, rest) };
        if last.binder.key.is_some() || !self.candidate(last).is_empty() {
            return (conditions, rest);
        }
        let Binder { variable, domain, .. } = last.binder;
        if chosen.contains(variable) {
            let name = self.pattern(*variable, domain);
            conditions.push(Condition::new(format!("let Some({name}) = {}", self.first(domain))));
        } else {
            conditions.push(self.not_empty(domain));
        }
        (conditions, &[])
    }

    /// Nested loops; each choice by a key remembers the best candidate with which the rest holds.
    fn search(&self, loops: &[Loop], chosen: &[VariableId]) -> String {
        let names = tuple(chosen.iter().map(|v| self.variable(*v)));
        let (success, failure) = if chosen.is_empty() {
            ("return true;".to_string(), "false")
        } else {
            (format!("return Some({names});"), "None")
        };
        if loops[0].binder.key.is_some() && !chosen.is_empty() {
            return format!("{} best.map(|(_, chosen)| chosen)", self.best(loops, chosen, 1).0);
        }
        format!("{} {failure}", self.nested(loops, chosen, 1, &success))
    }

    fn nested(&self, loops: &[Loop], chosen: &[VariableId], rank: usize, success: &str) -> String {
        let Some((step, rest)) = loops.split_first() else { return success.to_string() };
        if step.binder.key.is_some() {
            let (search, found) = self.best(loops, chosen, rank);
            return format!("{search} if {found} {{ {success} }}");
        }
        let (conditions, rest) = self.ahead(self.candidate(step), rest, chosen);
        let body = guarded(&conditions, &self.nested(rest, chosen, rank, success));
        let pattern = self.loop_pattern(loops, chosen);
        format!("for {pattern} in {} {{ {body} }}", self.values(&step.binder.domain))
    }

    /// The search for the best candidate, and the condition that there is one. Searches within
    /// others have a higher rank.
    fn best(&self, loops: &[Loop], chosen: &[VariableId], rank: usize) -> (String, String) {
        let (step, rest) = (&loops[0], &loops[1..]);
        let Some(key) = &step.binder.key else { return Default::default() };
        let number = if rank == 1 { String::new() } else { rank.to_string() };
        let (best, key_name, label) =
            (format!("best{number}"), format!("key{number}"), format!("'best{number}"));
        let kept: Vec<VariableId> =
            loops.iter().map(|l| l.binder.variable).filter(|v| chosen.contains(v)).collect();
        let names = tuple(kept.iter().map(|v| self.variable(*v)));
        let types = tuple(kept.iter().map(|v| self.scalar(self.automaton().variables[v.0].ty.scalar)));
        let key_type = if key.ty == Scalar::Real { "f64" } else { "i32" };
        let (ty, value, least, found) = if kept.is_empty() {
            (key_type.to_string(), key_name.clone(), "least", format!("{best}.is_some()"))
        } else {
            (
                format!("({key_type}, {types})"),
                format!("({key_name}, {names})"),
                "(least, _)",
                format!("let Some((_, {names})) = {best}"),
            )
        };
        let mut better = vec![Condition::new(format!("{best}.is_none_or(|{least}| {key_name} < least)"))];
        better.extend(step.conditions.iter().cloned());
        let (better, rest) = self.ahead(better, rest, &kept);
        let again = if rest.is_empty() { String::new() } else { format!(" continue {label};") };
        let success = format!("{best} = Some({value});{again}");
        let inner = self.nested(rest, &kept, rank + 1, &success);
        let body = format!("let {key_name} = {}; {}", self.expr(key), guarded(&better, &inner));
        let own: Vec<Condition> = step.binder.condition.iter().filter_map(|c| self.condition(c)).collect();
        let body = guarded(&own, &body);
        let label = if rest.is_empty() { String::new() } else { format!("{label}: ") };
        let mut text = format!("let mut {best}: Option<{ty}> = None;");
        let pattern = self.loop_pattern(loops, chosen);
        let _ = write!(text, "{label}for {pattern} in {} {{ {body} }}", self.values(&step.binder.domain));
        (text, found)
    }

    /// The variable of the first loop, or `_` if nothing reads it.
    fn loop_pattern(&self, loops: &[Loop], chosen: &[VariableId]) -> String {
        let variable = loops[0].binder.variable;
        let is_read =
            |step: &Loop| Uses::of_clauses(self.automaton(), step.clauses).variables.contains(&variable);
        if loops.iter().any(is_read) || chosen.contains(&variable) {
            self.pattern(variable, &loops[0].binder.domain)
        } else {
            "_".into()
        }
    }

    /// A domain behind `in`.
    fn values(&self, domain: &Domain) -> String {
        match domain {
            Domain::Enum(id) => format!("{}::ALL", self.names.enums[id.0].ty),
            Domain::Range(low, high) => self.range(low, high),
            Domain::Role(role) => format!("self.parameters.{}", self.own().roles[role.0]),
        }
    }
}

fn guarded(conditions: &[Condition], body: &str) -> String {
    all(conditions).map_or_else(|| body.to_string(), |condition| format!("if {condition} {{ {body} }}"))
}

/// One name, or several in brackets.
fn tuple(names: impl Iterator<Item = String>) -> String {
    let names: Vec<String> = names.collect();
    if names.len() == 1 { names.concat() } else { format!("({})", names.join(", ")) }
}
