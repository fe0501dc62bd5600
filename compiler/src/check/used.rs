//! The declarations that a set of automata needs.

use crate::source::FileId;
use crate::spec::ast;
use std::collections::BTreeSet;

/// The files with only the automata named, and the interfaces and enumerations that these mention.
pub fn used(files: &[(FileId, ast::File)], automata: &BTreeSet<String>) -> Vec<(FileId, ast::File)> {
    let mut types: BTreeSet<String> = automata.clone();
    // Words of expressions: of the names of types they can be those of enumerations alone.
    let mut words = Vec::new();
    loop {
        let before = types.len();
        words.clear();
        for (_, file) in files {
            for automaton in &file.automata {
                if types.contains(&automaton.name.value) {
                    types.extend(of_head(automaton));
                    of_text(automaton, &mut words);
                }
            }
            for interface in &file.interfaces {
                if types.contains(&interface.name.value) {
                    types.extend(interface.parameters.iter().flat_map(|p| of_type(&p.ty)));
                    types.extend(interface.cells.iter().flat_map(|c| of_type(&c.ty)));
                    interface.properties.iter().for_each(|property| of_property(property, &mut words));
                }
            }
        }
        if types.len() == before {
            break;
        }
    }
    let words: BTreeSet<String> = words.into_iter().collect();
    let is_used = |of: &ast::Enum| {
        let name = &of.name.value;
        let has_member = || of.members.iter().any(|member| words.contains(&member.value));
        types.contains(name) || words.contains(name) || has_member()
    };
    files
        .iter()
        .map(|(id, file)| {
            let tree = ast::File {
                enums: file.enums.iter().filter(|e| is_used(e)).cloned().collect(),
                interfaces: file
                    .interfaces
                    .iter()
                    .filter(|i| types.contains(&i.name.value))
                    .cloned()
                    .collect(),
                automata: file.automata.iter().filter(|a| types.contains(&a.name.value)).cloned().collect(),
                devices: file.devices.clone(),
            };
            (*id, tree)
        })
        .collect()
}

/// The types that its declarations name.
fn of_head(automaton: &ast::Automaton) -> Vec<String> {
    let mut names: Vec<String> = automaton.implements.iter().map(|i| i.interface.value.clone()).collect();
    for role in &automaton.roles {
        names.push(role.interface.value.clone());
        names.extend(role.also.iter().map(|n| n.value.clone()));
    }
    names.extend(automaton.parameters.iter().flat_map(|p| of_type(&p.ty)));
    names.extend(automaton.cells.iter().flat_map(|c| of_type(&c.ty)));
    names.extend(automaton.locals.iter().flat_map(|l| of_type(&l.ty)));
    names
}

/// All words of the expressions: an enumeration may be mentioned there only, by its name or that of a member.
fn of_text(automaton: &ast::Automaton, names: &mut Vec<String>) {
    automaton.defines.iter().for_each(|d| of_expr(&d.value, names));
    for require in &automaton.requires {
        of_expr(&require.condition, names);
        for part in &require.text {
            if let ast::TextPart::Value(value) = part {
                of_expr(value, names);
            }
        }
    }
    automaton.properties.iter().for_each(|property| of_property(property, names));
    automaton.initial.iter().for_each(|i| of_updates(&i.updates, names));
    automaton.any.iter().for_each(|a| of_transitions(&a.transitions, names));
    for state in &automaton.states {
        state.within.iter().for_each(|e| of_expr(e, names));
        match &state.body {
            ast::Body::Transitions(transitions) => of_transitions(transitions, names),
            ast::Body::Sequence(sequence) => {
                for outcome in [Some(&sequence.then), sequence.otherwise.as_ref()].into_iter().flatten() {
                    of_updates(&outcome.updates, names);
                }
                for step in &sequence.steps {
                    match step {
                        ast::Step::Act(update) => of_updates(std::slice::from_ref(update), names),
                        ast::Step::Wait { time, .. } => of_expr(time, names),
                        ast::Step::Until { condition, at_most, .. } => {
                            of_expr(condition, names);
                            at_most.iter().for_each(|e| of_expr(e, names));
                        }
                    }
                }
            }
        }
    }
}

fn of_property(property: &ast::Property, names: &mut Vec<String>) {
    match &property.kind {
        ast::PropertyKind::Always(condition) => of_expr(condition, names),
        ast::PropertyKind::Keep { values, condition } => {
            values.iter().for_each(|value| of_expr(value, names));
            of_expr(condition, names);
        }
        ast::PropertyKind::Whenever { trigger, goal, within } => {
            [trigger, goal, within].into_iter().for_each(|expr| of_expr(expr, names));
        }
        ast::PropertyKind::Answer { within } => of_expr(within, names),
    }
}

fn of_transitions(transitions: &[ast::Transition], names: &mut Vec<String>) {
    for transition in transitions {
        of_updates(&transition.updates, names);
        for clause in &transition.clauses {
            match clause {
                ast::Clause::Condition(condition) => of_expr(condition, names),
                ast::Clause::Bind(binder) => {
                    of_domain(&binder.domain, names);
                    binder.condition.iter().for_each(|e| of_expr(e, names));
                    match &binder.choice {
                        ast::Choice::First => {}
                        ast::Choice::Least(key) => of_expr(key, names),
                        ast::Choice::Nearest(from, to) => {
                            of_expr(from, names);
                            of_expr(to, names);
                        }
                    }
                }
            }
        }
    }
}

fn of_updates(updates: &[ast::Update], names: &mut Vec<String>) {
    for update in updates {
        match &update.kind {
            ast::UpdateKind::Assign { target, value, .. } => {
                of_expr(target, names);
                of_expr(value, names);
            }
            ast::UpdateKind::Command { arguments, .. } => arguments.iter().for_each(|e| of_expr(e, names)),
        }
    }
}

fn of_domain(domain: &ast::Domain, names: &mut Vec<String>) {
    match domain {
        ast::Domain::Named(name) => names.push(name.value.clone()),
        ast::Domain::Range(low, high) => {
            of_expr(low, names);
            of_expr(high, names);
        }
    }
}

fn of_expr(expr: &ast::Expr, names: &mut Vec<String>) {
    use ast::ExprKind as Kind;
    match &expr.kind {
        Kind::Name(name) => names.push(name.clone()),
        Kind::Member(base, _) | Kind::In(base, _) => of_expr(base, names),
        Kind::Not(a) | Kind::Negate(a) | Kind::After(a) => of_expr(a, names),
        Kind::Index(a, b) | Kind::Binary(_, a, b) | Kind::Reaches(a, b) => {
            of_expr(a, names);
            of_expr(b, names);
        }
        Kind::Call(_, arguments) | Kind::List(arguments) => arguments.iter().for_each(|e| of_expr(e, names)),
        Kind::Quantified { domain, body, .. } => {
            of_domain(domain, names);
            of_expr(body, names);
        }
        Kind::Bool(_) | Kind::Int(_) | Kind::Real(_) | Kind::Duration(_) | Kind::Error => {}
    }
}

fn of_type(ty: &ast::Type) -> Vec<String> {
    let mut names = Vec::new();
    if let ast::Scalar::Named(name) = &ty.scalar {
        names.push(name.value.clone());
    }
    if let Some(ast::Expr { kind: ast::ExprKind::Name(name), .. }) = &ty.extent {
        names.push(name.clone());
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::parser;

    #[test]
    fn a_word_of_an_expression_is_no_automaton_and_no_interface() {
        let text = "enum Goal { Start, Tray }
            enum Other { Conveyor }
            interface Tray { shared full: bool by owner; }
            automaton Conveyor on belt is Tray { initial state A { when full -> A { full := false; } } }
            automaton Mill on mill { local to: Goal; initial state A { when to = Start -> A { to := Tray; } } }
            automaton Saw on mill { knows trays: Tray[]; initial state A { when exists t in trays: t.full -> A {} } }";
        let (file, wrong) = parser::parse(FileId(0), text);
        assert!(wrong.is_empty(), "{wrong:?}");
        let files = [(FileId(0), file)];
        let names = |automaton: &str| {
            let found = used(&files, &BTreeSet::from([automaton.to_string()])).remove(0).1;
            let automata = found.automata.iter().map(|it| it.name.value.clone());
            let others =
                found.interfaces.iter().map(|it| &it.name).chain(found.enums.iter().map(|it| &it.name));
            automata.chain(others.map(|name| name.value.clone())).collect::<Vec<_>>()
        };
        assert_eq!(names("Mill"), ["Mill", "Goal"]);
        assert_eq!(names("Saw"), ["Saw", "Tray"]);
        assert_eq!(names("Conveyor"), ["Conveyor", "Tray"]);
    }
}
