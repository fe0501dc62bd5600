//! `autogen schema`.

use super::options::{Format, SchemaOf, SchemaOptions};
use super::{load, named, print};
use crate::Status;
use autogen::check::check;
use autogen::diagnostic::Diagnostic;
use autogen::source::{FileId, Sources};
use autogen::spec::{ast, parser};
use autogen::{library, scenario, schema};
use serde_json::Value;

pub fn run(options: &SchemaOptions) -> Status {
    match options.of {
        SchemaOf::Scenario => say!("{:#}", schema::scenario()),
        SchemaOf::Layout => match layout(options) {
            Ok(schema) => say!("{schema:#}"),
            Err(status) => return status,
        },
    }
    Status::Done
}

/// With the library and the types that are named; what is wrong with them has been printed.
fn layout(options: &SchemaOptions) -> Result<Value, Status> {
    let failed = |failure| print::failure_in(Format::Text, &failure);
    let mut sources = Sources::default();
    let mut specs: Vec<FileId> =
        library::FILES.iter().map(|(name, text)| sources.add(*name, *text)).collect();
    for path in &options.specs {
        let paths = named::automata(path).map_err(|why| {
            complain!("autogen: {}: {why}", path.display());
            Status::WrongCommand
        })?;
        for path in paths {
            specs.push(load::add(&mut sources, &path).map_err(failed)?);
        }
    }
    let given =
        options.scenario.as_ref().map(|path| load::add(&mut sources, path)).transpose().map_err(failed)?;
    let mut found = Vec::new();
    let kinds = given.map(|file| scenario::parse(&sources, file)).map(|(scenario, wrong)| {
        found.extend(wrong);
        scenario.map_or_else(Vec::new, |s| s.kinds.into_iter().map(|kind| kind.name.value).collect())
    });
    let mut left = parser::MOST_TOKENS;
    let trees = specs.into_iter().map(|file| {
        let (tree, wrong) = parser::parse_within(file, &sources.file(file).text, &mut left);
        found.extend(wrong);
        (file, tree)
    });
    let trees: Vec<(FileId, ast::File)> = trees.collect();
    if !found.is_empty() {
        return Err(wrong(&sources, &found));
    }
    let are_known = kinds.is_some();
    let kinds = kinds.unwrap_or_else(|| vec!["part".to_string()]);
    match check(&sources, &trees, Some(&kinds)) {
        Ok(checked) => Ok(schema::layout(checked.model(), are_known)),
        Err(found) => Err(wrong(&sources, &found)),
    }
}

fn wrong(sources: &Sources, found: &[Diagnostic]) -> Status {
    print::diagnostics(sources, found);
    Status::WrongInput
}
