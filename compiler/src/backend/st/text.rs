//! Files of Structured Text.

use super::Line;
use super::attributes;
use super::context::Shared;
use super::declaration::{Unit, globals};
use super::names::EnumNames;
use super::print::{Dialect, harmless};
use super::watchdog;
use crate::backend::Files;
use crate::library;
use crate::source::SourceFile;
use askama::Template;

#[derive(Template)]
#[template(path = "plc/header.st")]
struct Header {
    made_from: String,
    /// A port, if there is one.
    example: Option<String>,
}

#[derive(Template)]
#[template(path = "plc/unit.st")]
struct UnitText {
    pragmas: String,
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
    let mut parts = vec![render(&Header { made_from: made_from(shared), example: first })];
    parts.extend(line.functions.iter().map(|f| f.text.to_string()));
    parts.extend(line.units().map(|u| unit(shared, u, dialect)));
    let all: Vec<_> = line.globals.all().collect();
    parts.push(render(&Configuration {
        made_from: made_from(shared),
        globals: globals(&all, dialect),
        scan_ms: shared.system.scan_ms,
    }));
    parts.join("\n")
}

#[derive(Template)]
#[template(path = "plc/enumeration.st")]
struct Enumeration {
    made_from: String,
    pragmas: String,
    name: String,
    members: String,
}

#[derive(Template)]
#[template(path = "plc/structure.st")]
struct StructureText {
    made_from: String,
    name: String,
    about: String,
    fields: String,
}

#[derive(Template)]
#[template(path = "plc/global_list.st")]
struct GlobalList {
    made_from: String,
    pragmas: String,
    name: String,
    about: String,
    globals: String,
}

/// A file for each object of a project.
pub fn codesys(shared: Shared, line: &Line) -> Files {
    let mut files = Files::new();
    for names in enumerations(shared, line) {
        let members: Vec<_> = names.numbered().map(|(m, i)| format!("    {m} := {i}")).collect();
        let name = &names.ty;
        let text = Enumeration {
            made_from: made_from(shared),
            pragmas: attributes::pragmas(attributes::OF_ENUMERATIONS),
            name: name.clone(),
            members: members.join(",\n"),
        };
        files.insert(format!("{name}.st"), render(&text));
    }
    for structure in &line.structures {
        let fields = structure.fields.iter();
        let text = StructureText {
            made_from: made_from(shared),
            name: structure.name.clone(),
            about: structure.about.clone(),
            fields: fields.map(|f| f.line(Dialect::Codesys, &f.ty(Dialect::Codesys))).collect(),
        };
        files.insert(format!("{}.st", structure.name), render(&text));
    }
    for function in &line.functions {
        let text = format!("(* {}. This is not a safety function. *)\n{}", function.name, function.text);
        files.insert(format!("{}.st", function.name), text);
    }
    for part in line.units() {
        files.insert(format!("{}.st", part.name), unit(shared, part, Dialect::Codesys));
    }
    for list in line.globals.lists() {
        let text = GlobalList {
            made_from: made_from(shared),
            pragmas: attributes::pragmas(list.attributes),
            name: list.name.into(),
            about: list.about.into(),
            globals: globals(&list.variables, Dialect::Codesys),
        };
        files.insert(format!("{}.st", list.name), render(&text));
    }
    let task = include_str!("../../../../templates/plc/task.txt");
    files.insert("TASK.txt".into(), task.replace("SCAN_MS", &shared.system.scan_ms.to_string()));
    files
}

/// The enumerations of the specification, the states of each type that has robots, and the commands of their devices.
pub fn enumerations<'a>(shared: Shared<'a>, line: &Line) -> Vec<&'a EnumNames> {
    let with_robots = line.blocks.iter().zip(&shared.names.automata).filter(|(blocks, _)| blocks.is_some());
    let states = with_robots.map(|(_, names)| &names.states);
    shared.names.enums.iter().chain(states).chain(shared.names.commands.values()).collect()
}

impl EnumNames {
    /// Each member with its number.
    pub fn numbered(&self) -> impl Iterator<Item = (&String, &i32)> {
        self.members.iter().zip(&self.values)
    }
}

pub fn unit(shared: Shared, unit: &Unit, dialect: Dialect) -> String {
    render(&UnitText {
        pragmas: attributes::pragmas(unit.attributes(dialect)),
        keyword: if unit.name == "MAIN" { "PROGRAM" } else { "FUNCTION_BLOCK" },
        name: unit.name.clone(),
        comments: unit.comments.iter().map(|line| harmless(line.trim())).collect(),
        made_from: made_from(shared),
        declarations: unit.declarations(dialect),
        body: body(unit, dialect),
    })
}

/// The statements of a unit.
pub fn body(unit: &Unit, dialect: Dialect) -> String {
    let statements = dialect.statements(&unit.body, 0);
    match (dialect, unit.name == "MAIN") {
        (Dialect::Codesys, true) => format!("{}{statements}", watchdog::CODESYS),
        _ => statements,
    }
}

/// The names of the files that were read, but for the devices that come with the tool, and what was set beside
/// them. Fit for comments, in XML too.
pub fn made_from(shared: Shared) -> String {
    let name = |file: &SourceFile| match file.name.as_str() {
        "--set" => format!("{} (set)", file.text),
        name => name.rsplit(['/', '\\']).next().unwrap_or(name).to_string(),
    };
    let names: Vec<String> =
        shared.sources.files().iter().filter(|f| !f.name.starts_with(library::DEVICES)).map(name).collect();
    let text = harmless(&names.join(", "));
    // A comment in XML has no two hyphens side by side.
    text.replace("--", "- -").replace("--", "- -")
}

/// The text of a template, with one line break at its end. Writing to memory does not fail.
pub fn render(template: &impl Template) -> String {
    let mut text = template.render().unwrap_or_default();
    text.truncate(text.trim_end().len());
    text.push('\n');
    text
}
