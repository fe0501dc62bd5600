//! Files of Structured Text.

use super::Line;
use super::context::Shared;
use super::declaration::{Unit, globals};
use super::print::Dialect;
use askama::Template;

#[derive(Template)]
#[template(path = "plc/header.st")]
struct Header {
    made_from: String,
    example: String,
}

#[derive(Template)]
#[template(path = "plc/unit.st")]
struct UnitText {
    keyword: &'static str,
    name: String,
    comments: Vec<String>,
    made_from: String,
    declarations: String,
    body: String,
}

#[derive(Template)]
#[template(path = "plc/configuration.st")]
struct Configuration {
    made_from: String,
    globals: String,
    scan_ms: i32,
}

/// The whole program as one file.
pub fn portable(shared: Shared, line: &Line) -> String {
    let dialect = Dialect::Portable;
    let first = shared.names.robots.iter().flat_map(|r| r.ports.iter().flatten()).next().cloned();
    let mut parts = vec![render(&Header { made_from: made_from(shared), example: first.unwrap_or_default() })];
    parts.extend(line.functions.iter().map(|f| f.text.to_string()));
    parts.extend(line.units().map(|u| unit(shared, u, dialect)));
    let all: Vec<_> = line.globals.all().cloned().collect();
    parts.push(render(&Configuration {
        made_from: made_from(shared),
        globals: globals(&all, dialect),
        scan_ms: shared.system.scan_ms,
    }));
    parts.join("\n")
}

pub fn unit(shared: Shared, unit: &Unit, dialect: Dialect) -> String {
    render(&UnitText {
        keyword: if unit.name == "MAIN" { "PROGRAM" } else { "FUNCTION_BLOCK" },
        name: unit.name.clone(),
        comments: unit.comments.iter().map(|line| line.trim().replace("*)", "* )").replace("(*", "( *")).collect(),
        made_from: made_from(shared),
        declarations: unit.declarations(dialect),
        body: dialect.statements(&unit.body, 0),
    })
}

/// The names of the files that were read.
pub fn made_from(shared: Shared) -> String {
    let short = |name: &str| name.rsplit(['/', '\\']).next().unwrap_or(name).to_string();
    shared.sources.files().iter().map(|f| short(&f.name)).collect::<Vec<_>>().join(", ")
}

/// The text of a template, with one line break at its end. Writing to memory does not fail.
fn render(template: &impl Template) -> String {
    let text = template.render().unwrap_or_default();
    format!("{}\n", text.trim_end())
}
