//! Faults in expressions.

use super::survey::{Survey, literal, one, others, without};
use super::{Entry, Mutation};
use crate::finding::Span;
use crate::types::{Scalar, Type};
use crate::view::{Binary, Expression, ExpressionKind, Section};

pub(super) const FAULTS: &[Entry] = &[
    ("undefined variable", |s| undefined(s, Where::Whole)),
    ("undefined variable inside an expression", |s| undefined(s, Where::Inside)),
    ("unknown FB output", |s| members(s, |_, _| vec!["no_such_output".into()])),
    ("reading an FB's local", |s| members(s, locals_of)),
    ("unknown function", |s| {
        s.function_calls().iter().map(|call| one(call.name.span, "no_such_function")).collect()
    }),
    ("unknown function argument", |s| {
        arguments(s, |call, i| call[i].name.as_ref().map(|name| one(name.span, "no_such_input")))
    }),
    ("missing function argument", |s| arguments(s, |call, i| Some(without(call, i)))),
    ("AND on LREAL", and_on_lreal),
    ("BOOL > DINT", bool_and_dint),
    ("LREAL index", |s| indices(s, |_| vec!["1.0".into()])),
    ("indexing a scalar", indexed_scalar),
    ("constant index out of bounds", |s| indices(s, |upper| vec![format!("{}", upper + 1), "-1".into()])),
    ("literal too large", too_large),
    ("`==`", |s| operators(s, &[Binary::Equal], "=", "==")),
    ("whole number where LREAL is wanted", whole_for_real),
    ("LREAL without a point", |s| literals(s, Scalar::Lreal, "1E3")),
    ("typed literal", |s| literals(s, Scalar::Dint, "DINT#5")),
    ("based literal", |s| literals(s, Scalar::Dint, "16#FF")),
    ("second level of operators", no_parentheses),
    ("`&`", |s| operators(s, &[Binary::And], "AND", "&")),
    ("`**`", |s| operators(s, &[Binary::Multiply], "*", "**")),
    ("arithmetic on BOOL", |s| {
        binaries(s, &[Binary::Add, Binary::Multiply], |_, right| vec![one(right.span, "FALSE")])
    }),
    ("MOD on LREAL", |s| binaries(s, &[Binary::Modulo], |left, _| vec![one(left.span, "4.0")])),
    ("positional argument", |s| {
        arguments(s, |call, i| call[i].name.as_ref().map(|_| one(call[i].span, s.text(call[i].value.span))))
    }),
];

#[derive(Clone, Copy, PartialEq, Eq)]
enum Where {
    Whole,
    Inside,
}

fn undefined(survey: &Survey, place: Where) -> Vec<Mutation> {
    let parts = survey.parts.iter().filter(|part| part.is_whole == (place == Where::Whole));
    parts
        .filter(|part| matches!(part.expression.kind, ExpressionKind::Name(_)))
        .map(|part| one(part.expression.span, "no_such_thing"))
        .collect()
}

fn members(survey: &Survey, names: fn(&Survey, &MemberPlace) -> Vec<String>) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    for part in &survey.parts {
        let ExpressionKind::Member { object, member } = &part.expression.kind else { continue };
        let ExpressionKind::Name(name) = &object.kind else { continue };
        let Some(block) = survey.block_of(part.unit, &name.text) else { continue };
        let place = MemberPlace { block, ty: survey.type_of(part.expression).cloned() };
        mutations.extend(names(survey, &place).into_iter().map(|text| one(member.span, text)));
    }
    mutations
}

struct MemberPlace<'a> {
    block: &'a crate::view::Unit,
    ty: Option<Type>,
}

/// Locals of the type of the output, so that nothing but their being private is wrong; else any.
fn locals_of(survey: &Survey, place: &MemberPlace) -> Vec<String> {
    let locals = place.block.variables.iter().filter(|v| v.section == Section::Local);
    let (same, other): (Vec<_>, Vec<_>) =
        locals.partition(|v| survey.scalar_type(v).map(Type::Scalar) == place.ty);
    let chosen = if same.is_empty() { other } else { same };
    chosen.into_iter().map(|v| v.name.text.clone()).collect()
}

fn arguments(
    survey: &Survey,
    change: impl Fn(&[crate::view::Argument], usize) -> Option<Mutation>,
) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    for call in survey.function_calls() {
        let range = 0..call.arguments.len();
        mutations.extend(range.filter_map(|i| change(&call.arguments, i)));
    }
    mutations
}

fn binaries(
    survey: &Survey,
    wanted: &[Binary],
    change: impl Fn(&Expression, &Expression) -> Vec<Mutation>,
) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    for part in &survey.parts {
        if let ExpressionKind::Binary { operator, left, right } = &part.expression.kind
            && wanted.contains(operator)
        {
            mutations.extend(change(left, right));
        }
    }
    mutations
}

fn and_on_lreal(survey: &Survey) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    for part in &survey.parts {
        if let ExpressionKind::Binary { operator: Binary::And, left, right } = &part.expression.kind {
            for value in survey.values(part.unit, Scalar::Lreal) {
                mutations.push(one(left.span, value.as_str()));
                mutations.push(one(right.span, value.as_str()));
            }
        }
    }
    mutations
}

fn bool_and_dint(survey: &Survey) -> Vec<Mutation> {
    let ordered = [Binary::Less, Binary::Greater, Binary::LessOrEqual, Binary::GreaterOrEqual];
    binaries(survey, &ordered, |left, _| match survey.scalar_of(left) {
        Some(Scalar::Dint) => vec![one(left.span, "TRUE")],
        _ => vec![],
    })
}

fn indices(survey: &Survey, texts: fn(usize) -> Vec<String>) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    let mut at = |expression: &Expression| {
        if let ExpressionKind::Index { array, index } = &expression.kind
            && let Some(Type::Array(_, upper)) = survey.type_of(array)
        {
            mutations.extend(texts(*upper).into_iter().map(|text| one(index.span, text)));
        }
    };
    survey.parts.iter().for_each(|part| at(part.expression));
    for spot in &survey.statements {
        if let crate::view::StatementKind::Assign { target, .. } = &spot.statement.kind {
            at(target);
        }
    }
    mutations
}

fn indexed_scalar(survey: &Survey) -> Vec<Mutation> {
    let names = survey.parts.iter().filter(|part| {
        matches!(part.expression.kind, ExpressionKind::Name(_)) && survey.scalar_of(part.expression).is_some()
    });
    names.map(|part| super::survey::after(part.expression.span, "[0]")).collect()
}

fn too_large(survey: &Survey) -> Vec<Mutation> {
    let mut mutations = literals(survey, Scalar::Dint, "2147483648");
    mutations.extend(literals(survey, Scalar::Dint, "99999999999999999999"));
    mutations.extend(literals(survey, Scalar::Lreal, "1.0E400"));
    mutations
}

fn literals(survey: &Survey, ty: Scalar, text: &str) -> Vec<Mutation> {
    let parts = survey.parts.iter().filter(|part| match part.expression.kind {
        ExpressionKind::Int(_) => ty == Scalar::Dint,
        ExpressionKind::Real(_) => ty == Scalar::Lreal,
        _ => false,
    });
    parts.map(|part| one(part.expression.span, text)).collect()
}

fn whole_for_real(survey: &Survey) -> Vec<Mutation> {
    literals(survey, Scalar::Lreal, literal(others(Scalar::Lreal)[1]))
}

fn operators(survey: &Survey, wanted: &[Binary], from: &str, to: &str) -> Vec<Mutation> {
    binaries(survey, wanted, |left, right| {
        let between = &survey.source[left.span.end..right.span.start];
        let Some(offset) = between.to_ascii_uppercase().find(from) else { return vec![] };
        let start = left.span.end + offset;
        vec![one(Span { start, end: start + from.len() }, to)]
    })
}

/// Takes away parentheses around an operator that is another than the one outside.
fn no_parentheses(survey: &Survey) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    for part in &survey.parts {
        let ExpressionKind::Binary { operator, left, right } = &part.expression.kind else { continue };
        for side in [left, right] {
            if let ExpressionKind::Parenthesis(inner) = &side.kind
                && let ExpressionKind::Binary { operator: below, .. } = &inner.kind
                && below != operator
            {
                mutations.push(one(side.span, survey.text(inner.span)));
            }
        }
    }
    mutations
}
