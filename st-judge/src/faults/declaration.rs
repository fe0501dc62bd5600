//! Faults in declarations.

use super::survey::{Survey, after, one, others};
use super::{Entry, Mutation};
use crate::view::{Section, TypeKind, Variable};

pub(super) const FAULTS: &[Entry] = &[
    ("unknown type", unknown_type),
    ("duplicate variable", |s| declared_again(s, str::to_string)),
    ("name that differs in case only", |s| declared_again(s, swapped_case)),
    ("VAR_EXTERNAL without VAR_GLOBAL", no_global),
    ("VAR_EXTERNAL of another type", other_type),
    ("unknown program in CONFIGURATION", |s| assignments(s, Part::Program)),
    ("unknown task in CONFIGURATION", |s| assignments(s, Part::Task)),
    ("reserved word as a name", |s| {
        renamed(s, |_| vec!["step".into(), "on".into(), "len".into(), "by".into()])
    }),
    ("double underscore", |s| renamed(s, |name| vec![format!("{name}__b"), format!("a__{name}")])),
    ("trailing underscore", |s| renamed(s, |name| vec![format!("{name}_")])),
    ("keyword within a name", |s| renamed(s, |name| vec![format!("{name}_send_program")])),
    ("name too long", |s| renamed(s, |name| vec![format!("{name}{}", "x".repeat(65))])),
    ("type outside of the core", |s| {
        types(s, |_| vec!["INT".into(), "REAL".into(), "TIME".into(), "STRING".into()])
    }),
    ("array that begins at 1", |s| types(s, array_from_one)),
    ("array of one element", |s| types(s, array_of_one)),
    ("initial value of an array", |s| arrays(s, " := [1]")),
    ("CONSTANT", |s| sections(s, "VAR CONSTANT")),
    ("NON_RETAIN", |s| sections(s, "VAR NON_RETAIN")),
    ("VAR_TEMP", |s| sections(s, "VAR_TEMP")),
];

fn variables<'a>(survey: &Survey<'a>) -> Vec<&'a Variable> {
    let text = &survey.checked.text;
    let own = text.units.iter().flat_map(|u| &u.variables);
    own.chain(text.configurations.iter().flat_map(|c| &c.globals)).collect()
}

fn types(survey: &Survey, texts: fn(&str) -> Vec<String>) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    for variable in variables(survey) {
        let span = variable.ty.span;
        mutations.extend(texts(survey.text(span)).into_iter().map(|text| one(span, text)));
    }
    mutations
}

fn unknown_type(survey: &Survey) -> Vec<Mutation> {
    let mut mutations = types(survey, |_| vec!["NoSuchType".into()]);
    let results = survey.checked.text.units.iter().filter_map(|u| u.result.as_ref());
    mutations.extend(results.map(|ty| one(ty.span, "NoSuchType")));
    mutations
}

fn array_from_one(ty: &str) -> Vec<String> {
    let text = ty.replace("[0..", "[1..");
    if text == ty { vec![] } else { vec![text] }
}

fn array_of_one(ty: &str) -> Vec<String> {
    let parts = ty.split_once("..").and_then(|(front, rest)| Some((front, rest.split_once(']')?.1)));
    parts.map(|(front, rest)| format!("{front}..0]{rest}")).into_iter().collect()
}

fn declared_again(survey: &Survey, name: fn(&str) -> String) -> Vec<Mutation> {
    let again = |v: &&Variable| format!(" {} : {};", name(&v.name.text), survey.text(v.ty.span));
    variables(survey).iter().map(|v| after(v.span, again(v))).collect()
}

fn swapped_case(name: &str) -> String {
    name.chars()
        .map(|c| if c.is_lowercase() { c.to_ascii_uppercase() } else { c.to_ascii_lowercase() })
        .collect()
}

fn no_global(survey: &Survey) -> Vec<Mutation> {
    let externals = survey.externals();
    let mut mutations: Vec<_> = externals.iter().map(|v| after(v.span, " no_such_global : BOOL;")).collect();
    let globals = survey.checked.text.configurations.iter().flat_map(|c| &c.globals);
    let used = globals.filter(|g| externals.iter().any(|e| e.name.key() == g.name.key()));
    mutations.extend(used.map(|g| one(g.name.span, format!("{}_x", g.name.text))));
    mutations
}

fn other_type(survey: &Survey) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    for variable in survey.externals() {
        let span = variable.ty.span;
        match (&variable.ty.kind, survey.scalar_type(variable)) {
            (_, Some(ty)) => mutations.extend(others(ty).map(|other| one(span, other.to_string()))),
            (TypeKind::Array { upper, .. }, _) => {
                let length: usize = survey.text(upper.span).parse().unwrap_or(0);
                mutations.push(one(upper.span, (length + 1).to_string()));
            }
            _ => {}
        }
    }
    mutations
}

#[derive(Clone, Copy)]
enum Part {
    Program,
    Task,
}

fn assignments(survey: &Survey, part: Part) -> Vec<Mutation> {
    let text = &survey.checked.text;
    let mut wrong: Vec<String> = vec!["NoSuchThing".into(), "Other1".into(), "no_such_name".into()];
    wrong.extend(
        text.units.iter().filter(|u| u.kind != crate::view::UnitKind::Program).map(|u| u.name.text.clone()),
    );
    wrong.extend(text.configurations.iter().map(|c| c.name.text.clone()));
    wrong.extend(text.configurations.iter().flat_map(|c| &c.resources).map(|r| r.name.text.clone()));
    wrong.extend(text.configurations.iter().flat_map(|c| &c.globals).take(3).map(|v| v.name.text.clone()));
    let mut mutations = Vec::new();
    for assignment in text.configurations.iter().flat_map(|c| &c.resources).flat_map(|r| &r.programs) {
        let name = match part {
            Part::Program => Some(&assignment.program),
            Part::Task => assignment.task.as_ref(),
        };
        mutations
            .extend(name.into_iter().flat_map(|name| wrong.iter().map(|text| one(name.span, text.as_str()))));
    }
    mutations
}

/// A local variable under another name, at all places at which it stands.
fn renamed(survey: &Survey, names: fn(&str) -> Vec<String>) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    for (unit, variable) in survey.locals() {
        for name in names(&variable.name.text) {
            mutations.push(survey.renamed(unit, variable, &name));
        }
    }
    mutations
}

fn arrays(survey: &Survey, text: &str) -> Vec<Mutation> {
    let arrays = variables(survey).into_iter().filter(|v| matches!(v.ty.kind, TypeKind::Array { .. }));
    arrays.filter(|v| v.section != Section::External).map(|v| after(v.ty.span, text)).collect()
}

/// `VAR` becomes another section, where it stands alone.
fn sections(survey: &Survey, text: &str) -> Vec<Mutation> {
    let mut mutations = Vec::new();
    for unit in &survey.checked.text.units {
        let body = &survey.source[unit.span.start..unit.span.end];
        for (i, _) in body.match_indices("\nVAR\n") {
            let start = unit.span.start + i + 1;
            mutations.push(one(crate::finding::Span { start, end: start + 3 }, text));
        }
    }
    mutations
}
