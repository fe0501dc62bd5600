//! Faults in statements.

use super::survey::{Around, Survey, before, literal, one, others, without};
use super::{Entry, Mutation};
use crate::finding::Span;
use crate::types::Scalar;
use crate::view::{Section, Statement, StatementKind, UnitKind};

pub(super) const FAULTS: &[Entry] = &[
    ("BOOL := DINT", |s| assigned(s, Scalar::Bool, Scalar::Dint)),
    ("DINT := LREAL", |s| assigned(s, Scalar::Dint, Scalar::Lreal)),
    ("LREAL := BOOL", |s| assigned(s, Scalar::Lreal, Scalar::Bool)),
    ("missing END_IF", |s| without_end(s, "END_IF")),
    ("missing END_CASE", |s| without_end(s, "END_CASE")),
    ("unknown FB parameter", |s| {
        inputs(s, |names, i| names[i].name.as_ref().map(|n| one(n.span, "no_such_input")))
    }),
    ("wrong FB parameter type", wrong_input),
    ("IF on a number", if_on_number),
    ("duplicate CASE label", duplicate_label),
    ("CASE on LREAL", case_on_lreal),
    ("assignment to VAR_INPUT", to_input),
    ("assignment to an FB's output", to_output),
    ("stray ELSE", stray_else),
    ("`=` for `:=`", assignment_with_equal),
    ("missing FB parameter", |s| inputs(s, |all, i| Some(without(all, i)))),
    ("positional FB parameter", |s| inputs(s, |all, i| Some(one(all[i].span, s.text(all[i].value.span))))),
    ("`=>`", |s| {
        inputs(s, |all, i| {
            let name = all[i].name.as_ref()?;
            Some(one(Span { start: name.span.end, end: all[i].value.span.start }, " => "))
        })
    }),
    ("FOR", |s| {
        insertions(s, |spot| variable_of(s, spot, Scalar::Dint), "FOR @ := 0 TO 3 DO @ := 1; END_FOR; ")
    }),
    ("REPEAT", |s| insertions(s, |_| Some(String::new()), "REPEAT EXIT; UNTIL TRUE END_REPEAT; ")),
    ("CONTINUE", |s| insertions(s, |_| Some(String::new()), "CONTINUE; ")),
    ("EXIT outside of a loop", |s| insertions(s, |spot| (!spot.in_loop).then(String::new), "EXIT; ")),
    ("RETURN in a PROGRAM", |s| {
        insertions(s, |spot| (spot.unit.kind == UnitKind::Program).then(String::new), "RETURN; ")
    }),
    ("CASE without ELSE", no_else),
    ("empty branch", empty_branch),
    ("empty statement", |s| insertions(s, |_| Some(String::new()), "; ")),
    ("pragma", |s| insertions(s, |_| Some(String::new()), "{note} ")),
    ("assignment to a literal", |s| insertions(s, |_| Some(String::new()), "1 := 1; ")),
    ("WHILE on a number", while_on_number),
];

fn assigned(survey: &Survey, to: Scalar, from: Scalar) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    for spot in &survey.statements {
        if let StatementKind::Assign { target, value } = &spot.statement.kind
            && survey.scalar_of(target) == Some(to)
        {
            mutations.extend(survey.values(spot.unit, from).into_iter().map(|text| one(value.span, text)));
        }
    }
    mutations
}

fn without_end(survey: &Survey, end: &str) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    for spot in &survey.statements {
        let span = spot.statement.span;
        let start = span.end.saturating_sub(end.len());
        if matches!(spot.statement.kind, StatementKind::If { .. } | StatementKind::Case { .. })
            && survey.source[start..span.end].eq_ignore_ascii_case(end)
        {
            let semicolon = survey.source[span.end..].find(';').map_or(span.end, |i| span.end + i + 1);
            mutations.push(one(Span { start, end: semicolon }, ""));
            mutations.push(one(Span { start, end: span.end }, ""));
        }
    }
    mutations
}

fn inputs(
    survey: &Survey,
    change: impl Fn(&[crate::view::Argument], usize) -> Option<Mutation>,
) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    for (_, call) in survey.block_calls() {
        mutations.extend((0..call.arguments.len()).filter_map(|i| change(&call.arguments, i)));
    }
    mutations
}

fn wrong_input(survey: &Survey) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    for (unit, call) in survey.block_calls() {
        for argument in &call.arguments {
            let Some(ty) = survey.scalar_of(&argument.value) else { continue };
            for other in others(ty) {
                let values = survey.values(unit, other);
                mutations.extend(values.into_iter().map(|text| one(argument.value.span, text)));
            }
        }
    }
    mutations
}

fn if_on_number(survey: &Survey) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    for spot in &survey.statements {
        let StatementKind::If { branches, .. } = &spot.statement.kind else { continue };
        for branch in branches {
            for ty in [Scalar::Dint, Scalar::Lreal] {
                let values = survey.values(spot.unit, ty);
                mutations.extend(values.into_iter().map(|text| one(branch.condition.span, text)));
            }
        }
    }
    mutations
}

fn while_on_number(survey: &Survey) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    for spot in &survey.statements {
        if let StatementKind::While { condition, .. } = &spot.statement.kind {
            mutations.push(one(condition.span, "1"));
        }
    }
    mutations
}

fn duplicate_label(survey: &Survey) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    for spot in &survey.statements {
        let StatementKind::Case { clauses, .. } = &spot.statement.kind else { continue };
        let labels: Vec<Span> = clauses.iter().flat_map(|c| &c.labels).map(|l| l.span).collect();
        for pair in labels.windows(2) {
            mutations.push(one(pair[1], survey.text(pair[0])));
            mutations.push(one(pair[1], format!("{}, {}", survey.text(pair[1]), survey.text(pair[0]))));
        }
    }
    mutations
}

fn case_on_lreal(survey: &Survey) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    for spot in &survey.statements {
        if let StatementKind::Case { subject, .. } = &spot.statement.kind {
            let values = survey.values(spot.unit, Scalar::Lreal);
            mutations.extend(values.into_iter().map(|text| one(subject.span, text)));
        }
    }
    mutations
}

fn to_input(survey: &Survey) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    for (i, spot) in survey.statements.iter().enumerate() {
        let inputs = spot.unit.variables.iter().filter(|v| v.section == Section::Input);
        let inputs: Vec<_> = inputs.filter_map(|v| Some((v, survey.scalar_type(v)?))).collect();
        if !inputs.is_empty() {
            let (variable, ty) = inputs[i % inputs.len()];
            let text = format!("{} := {}; ", variable.name.text, literal(ty));
            mutations.push(before(spot.statement.span, text));
        }
    }
    mutations
}

fn to_output(survey: &Survey) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    let calls = survey.block_calls();
    for (i, spot) in survey.statements.iter().enumerate() {
        let own: Vec<_> = calls.iter().filter(|(unit, _)| std::ptr::eq(*unit, spot.unit)).collect();
        let Some((unit, call)) = own.get(i % own.len().max(1)) else { continue };
        let Some(block) = survey.block_of(unit, &call.name.text) else { continue };
        let output =
            block.variables.iter().find(|v| v.section == Section::Output && survey.scalar_type(v).is_some());
        if let Some(output) = output
            && let Some(ty) = survey.scalar_type(output)
        {
            let text = format!("{}.{} := {}; ", call.name.text, output.name.text, literal(ty));
            mutations.push(before(spot.statement.span, text));
        }
    }
    mutations
}

/// Where no IF or CASE without ELSE is open.
fn stray_else(survey: &Survey) -> Vec<Mutation> {
    let spots = survey.statements.iter().filter(|spot| spot.around != Around::Branch);
    spots.map(|spot| before(spot.statement.span, "ELSE ")).collect()
}

fn assignment_with_equal(survey: &Survey) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    let mut between = |start: usize, end: usize| {
        if let Some(i) = survey.source[start..end].find(":=") {
            mutations.push(one(Span { start: start + i, end: start + i + 2 }, "="));
        }
    };
    for spot in &survey.statements {
        if let StatementKind::Assign { target, value } = &spot.statement.kind {
            between(target.span.end, value.span.start);
        }
    }
    for (_, call) in survey.block_calls() {
        for argument in &call.arguments {
            between(argument.span.start, argument.value.span.start);
        }
    }
    mutations
}

/// Inserts a statement where `word` gives what stands for `@` in it.
fn insertions(
    survey: &Survey,
    word: impl Fn(&super::survey::Spot) -> Option<String>,
    text: &str,
) -> Vec<Mutation> {
    let spots = survey.statements.iter();
    spots.filter_map(|spot| Some(before(spot.statement.span, text.replace('@', &word(spot)?)))).collect()
}

fn variable_of(survey: &Survey, spot: &super::survey::Spot, ty: Scalar) -> Option<String> {
    let mut variables = spot.unit.variables.iter().filter(|v| v.section == Section::Local);
    variables.find(|v| survey.scalar_type(v) == Some(ty)).map(|v| v.name.text.clone())
}

/// From the first to behind the last statement of a list, its `;` included.
fn extent(survey: &Survey, list: &[Statement]) -> Option<Span> {
    let (first, last) = (list.first()?, list.last()?);
    let mut end = last.span.end;
    if !survey.source[..end].ends_with(';') {
        end += survey.source[end..].find(';')? + 1;
    }
    Some(Span { start: first.span.start, end })
}

fn no_else(survey: &Survey) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    for spot in &survey.statements {
        if let StatementKind::Case { clauses, otherwise: Some(body), .. } = &spot.statement.kind
            && let Some(extent) = extent(survey, body)
            && let Some(last) = clauses.last()
        {
            let start = survey.source[last.span.end..extent.start].rfind("ELSE").map(|i| last.span.end + i);
            mutations.extend(start.map(|start| one(Span { start, end: extent.end }, "")));
        }
    }
    mutations
}

fn empty_branch(survey: &Survey) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    for spot in &survey.statements {
        for body in crate::view::bodies(spot.statement) {
            mutations.extend(extent(survey, body).map(|extent| one(extent, "")));
        }
    }
    mutations
}
