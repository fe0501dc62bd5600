//! Files of Structured Text.

use super::Line;
use super::attributes;
use super::context::Shared;
use super::declaration::{Unit, globals};
use super::name::Name;
use super::names::EnumNames;
use super::print::{Dialect, harmless};
use super::watchdog;
use crate::backend::{Part, Sink, part};
use crate::library;
use crate::source::SourceFile;
use askama::Template;
use std::fmt::{self, Write};

#[derive(Template)]
#[template(path = "plc/header.st")]
struct Header {
    made_from: String,
    /// A port, if there is one.
    example: Option<Name>,
}

#[derive(Template)]
#[template(path = "plc/unit.st")]
struct UnitText<'a> {
    pragmas: String,
    keyword: &'static str,
    name: &'a str,
    comments: Vec<String>,
    made_from: &'a str,
    declarations: Part<'a>,
    body: Part<'a>,
}

#[derive(Template)]
#[template(path = "plc/configuration.st")]
struct Configuration<'a> {
    made_from: &'a str,
    globals: Part<'a>,
    scan_ms: i32,
}

/// The whole program as one file.
pub fn portable<'a>(shared: Shared<'a>, line: &'a Line) -> Part<'a> {
    let dialect = Dialect::Portable;
    let first = shared.names.robots.iter().flat_map(|r| r.ports.iter().flatten()).next().cloned();
    let all: Vec<_> = line.globals.all().collect();
    let made_from = made_from(shared);
    part(move |f| {
        writeln!(f, "{}", Header { made_from: made_from.clone(), example: first.clone() })?;
        line.functions.iter().try_for_each(|function| write!(f, "\n{}", function.text))?;
        line.units().try_for_each(|of_line| write!(f, "\n{}", unit(&made_from, of_line, dialect)))?;
        let globals = part(|f| globals(&all, dialect, f));
        let scan_ms = shared.system.scan_ms;
        write!(f, "\n{}\n", Configuration { made_from: &made_from, globals, scan_ms })
    })
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
struct StructureText<'a> {
    made_from: &'a str,
    name: &'a str,
    about: &'a str,
    fields: Part<'a>,
}

#[derive(Template)]
#[template(path = "plc/global_list.st")]
struct GlobalList<'a> {
    made_from: &'a str,
    pragmas: String,
    name: &'a str,
    about: &'a str,
    globals: Part<'a>,
}

/// A file for each object of a project.
pub fn codesys(shared: Shared, line: &Line, files: &mut dyn Sink) {
    let made_from = made_from(shared);
    for names in enumerations(shared, line) {
        let members: Vec<_> = names.numbered().map(|(m, i)| format!("    {m} := {i}")).collect();
        let name = &names.ty;
        let text = Enumeration {
            made_from: made_from.clone(),
            pragmas: attributes::pragmas(attributes::OF_ENUMERATIONS),
            name: name.clone(),
            members: members.join(",\n"),
        };
        files.file(&format!("{name}.st"), &render(&text));
    }
    for structure in &line.structures {
        let fields = structure.fields.iter();
        let text = StructureText {
            made_from: &made_from,
            name: &structure.name,
            about: &structure.about,
            fields: part(move |f| fields.clone().try_for_each(|field| field.line(Dialect::Codesys, f))),
        };
        files.file(&format!("{}.st", structure.name), &render(&text));
    }
    for function in &line.functions {
        let text = format!("(* {}. This is not a safety function. *)\n{}", function.name, function.text);
        files.file(&format!("{}.st", function.name), &text);
    }
    for of_line in line.units() {
        files.file(&format!("{}.st", of_line.name), &unit(&made_from, of_line, Dialect::Codesys));
    }
    for list in line.globals.lists() {
        let text = GlobalList {
            made_from: &made_from,
            pragmas: attributes::pragmas(list.attributes),
            name: list.name,
            about: list.about,
            globals: part(|f| globals(&list.variables, Dialect::Codesys, f)),
        };
        files.file(&format!("{}.st", list.name), &text);
    }
    let task = include_str!("../../../../templates/plc/task.txt");
    files.file("TASK.txt", &task.replace("SCAN_MS", &shared.system.scan_ms.to_string()));
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

fn unit<'a>(made_from: &'a str, unit: &'a Unit<'a>, dialect: Dialect) -> Part<'a> {
    let text = UnitText {
        pragmas: attributes::pragmas(unit.attributes(dialect)),
        keyword: if unit.name == "MAIN" { "PROGRAM" } else { "FUNCTION_BLOCK" },
        name: &unit.name,
        comments: unit.comments.iter().map(|line| harmless(line.trim()).into_owned()).collect(),
        made_from,
        declarations: part(move |f| unit.declarations(dialect, f)),
        body: part(move |f| body(unit, dialect, f)),
    };
    part(move |f| writeln!(f, "{text}"))
}

/// The statements of a unit.
pub fn body(unit: &Unit, dialect: Dialect, to: &mut impl Write) -> fmt::Result {
    if dialect == Dialect::Codesys && unit.name == "MAIN" {
        to.write_str(watchdog::CODESYS)?;
    }
    unit.body.pieces().try_for_each(|piece| dialect.statements(piece.iter(), 0, to))
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
    let names = names.join(", ");
    let text = harmless(&names);
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
