//! PLCopen XML, in the two flavours that tools import: bodies are the same text as in the files of Structured Text.

use super::Line;
use super::attributes;
use super::code::Ex;
use super::context::Shared;
use super::declaration::{Instance, Unit, Variable, lists_of_globals};
use super::functions::Function;
use super::print::Dialect;
use super::text::{body, enumerations, made_from, render};
use crate::{plain, version};
use askama::Template;
use std::fmt::Write;

#[derive(Template)]
#[template(path = "plc/plcopen.xml")]
struct Plcopen {
    made_from: String,
    version: &'static str,
    day: &'static str,
    pous: Vec<Pou>,
    scan_ms: i32,
    globals: String,
}

#[derive(Template)]
#[template(path = "plc/codesys.xml")]
struct Codesys {
    made_from: String,
    version: &'static str,
    day: &'static str,
    enumerations: Vec<Enumeration>,
    structures: Vec<StructureXml>,
    pous: Vec<Pou>,
    lists: Vec<List>,
}

struct Pou {
    name: String,
    kind: &'static str,
    interface: String,
    body: String,
}

struct Enumeration {
    name: String,
    members: String,
    attributes: String,
}

struct StructureXml {
    name: String,
    fields: String,
}

struct List {
    name: &'static str,
    variables: String,
    is_retained: bool,
    attributes: String,
}

/// For Beremiz, OpenPLC and other tools that keep to the standard.
pub fn plcopen(shared: Shared, line: &Line) -> String {
    let all: Vec<&Variable> = line.globals.all().collect();
    let lists = lists_of_globals(&all, Dialect::Portable);
    let of = |v: &Variable| variable(v, Dialect::Portable, 10);
    let globals = lists.iter().map(|list| sections("globalVars", list.iter().copied(), 8, of)).collect();
    render(&Plcopen {
        made_from: escaped(&made_from(shared)),
        version: version::NUMBER,
        day: version::DAY,
        pous: pous(line, Dialect::Portable),
        scan_ms: shared.system.scan_ms,
        globals,
    })
}

/// For CODESYS and TwinCAT.
pub fn codesys(shared: Shared, line: &Line) -> String {
    let value =
        |(member, i): (&String, &i32)| format!("              <value name=\"{member}\" value=\"{i}\"/>\n");
    let enumerations = enumerations(shared, line)
        .into_iter()
        .map(|names| Enumeration {
            name: names.ty.clone(),
            members: names.numbered().map(value).collect(),
            attributes: attributes::additional_data(attributes::OF_ENUMERATIONS, 8),
        })
        .collect();
    let structures = line.structures.iter().map(|structure| StructureXml {
        name: structure.name.clone(),
        fields: structure.fields.iter().map(|v| variable(v, Dialect::Codesys, 12)).collect(),
    });
    let lists = (line.globals.lists().into_iter())
        .map(|list| List {
            name: list.name,
            variables: list.variables.iter().map(|v| variable(v, Dialect::Codesys, 8)).collect(),
            is_retained: list.is_retained,
            attributes: attributes::additional_data(list.attributes, 8),
        })
        .collect();
    render(&Codesys {
        made_from: escaped(&made_from(shared)),
        version: version::NUMBER,
        day: version::DAY,
        enumerations,
        structures: structures.collect(),
        pous: pous(line, Dialect::Codesys),
        lists,
    })
}

fn pous(line: &Line, dialect: Dialect) -> Vec<Pou> {
    let functions = line.functions.iter().map(|f| function(f));
    functions.chain(line.units().map(|unit| pou(unit, dialect))).collect()
}

fn pou(unit: &Unit, dialect: Dialect) -> Pou {
    let of = |v: &Variable| variable(v, dialect, 12);
    let mut interface = String::new();
    interface += &section("inputVars", 10, unit.inputs.iter().map(of).collect());
    interface += &sections("outputVars", &unit.outputs(dialect), 10, of);
    interface += &section("inOutVars", 10, unit.references.iter().map(of).collect());
    let instance =
        |i: &Instance| typed(&named(&i.name), &format!("<derived name=\"{}\"/>", i.block), "", "", 12);
    let instances = |is_retained: bool| {
        let some = unit.instances.iter().filter(|i| i.is_retained_in(dialect) == is_retained);
        some.map(instance).collect()
    };
    interface += &sections("localVars", &unit.variables, 10, of);
    interface += &section("localVars", 10, instances(false));
    interface += &retained("localVars", 10, instances(true));
    if dialect == Dialect::Portable {
        interface += &section("externalVars", 10, unit.externals.iter().map(of).collect());
    }
    interface += &attributes::additional_data(unit.attributes(dialect), 10);
    Pou {
        name: unit.name.clone(),
        kind: if unit.name == "MAIN" { "program" } else { "functionBlock" },
        interface,
        body: cdata(&body(unit, dialect)),
    }
}

/// A function from its text: its type stands in the first line behind the comment, then come sections.
fn function(function: &Function) -> Pou {
    let text = function.text.split_once("FUNCTION ").map_or("", |(_, rest)| rest);
    let mut lines = text.lines();
    let result = lines.next().and_then(|l| l.split(" : ").nth(1)).unwrap_or_default();
    let mut interface = format!("          <returnType><{result}/></returnType>\n");
    let mut open: Option<(&str, Vec<String>)> = None;
    let mut body = String::new();
    for line in lines {
        match (line, &mut open) {
            ("VAR_INPUT", _) => open = Some(("inputVars", Vec::new())),
            ("VAR", _) => open = Some(("localVars", Vec::new())),
            ("END_VAR", Some((name, variables))) => {
                interface += &section(name, 10, variables.clone());
                open = None;
            }
            ("END_FUNCTION", _) => {}
            (line, Some((_, variables))) => {
                if let Some((name, ty)) = line.trim().trim_end_matches(';').split_once(" : ") {
                    variables.push(typed(&named(name), &format!("<{ty}/>"), "", "", 12));
                }
            }
            (line, None) => {
                let _ = writeln!(body, "{line}");
            }
        }
    }
    Pou { name: function.name.into(), kind: "function", interface, body: cdata(&body) }
}

/// Those that are retained in a section of their own.
fn sections<'a>(
    name: &str,
    variables: impl IntoIterator<Item = &'a Variable> + Clone,
    indent: usize,
    of: impl Fn(&Variable) -> String,
) -> String {
    let lines = |is_retained: bool| {
        let some = variables.clone().into_iter().filter(move |v| v.is_retained == is_retained);
        some.map(&of).collect::<Vec<_>>()
    };
    section(name, indent, lines(false)) + &retained(name, indent, lines(true))
}

/// A section that outlasts a loss of power.
fn retained(name: &str, indent: usize, variables: Vec<String>) -> String {
    let section = section(name, indent, variables);
    section.replacen(&format!("<{name}>"), &format!("<{name} retain=\"true\">"), 1)
}

fn section(name: &str, indent: usize, variables: Vec<String>) -> String {
    let indent = " ".repeat(indent);
    match variables.is_empty() {
        true => String::new(),
        false => format!("{indent}<{name}>\n{}{indent}</{name}>\n", variables.concat()),
    }
}

fn variable(variable: &Variable, dialect: Dialect, indent: usize) -> String {
    let single = match variable.structure.as_ref().or(variable.enumeration.as_ref()) {
        Some(name) => format!("<derived name=\"{name}\"/>"),
        None => format!("<{}/>", variable.basic.name()),
    };
    let last = variable.last(dialect);
    let dimension = |last: &usize| format!("<dimension lower=\"0\" upper=\"{last}\"/>");
    let ty = match last.is_empty() {
        true => single,
        false => format!(
            "<array>{}<baseType>{single}</baseType></array>",
            last.iter().map(dimension).collect::<String>()
        ),
    };
    let mut initial = String::new();
    if let Some(ex) = &variable.initial {
        initial += "<initialValue>";
        value(ex, dialect, &mut initial);
        initial += "</initialValue>";
    }
    let about = variable.comments.iter().fold(String::new(), |text, line| match text.as_str() {
        "" => line.clone(),
        text if text.ends_with('.') => format!("{text} {line}"),
        text => format!("{text}; {line}"),
    });
    let about = escaped(&about);
    let about = match (about.is_empty(), dialect) {
        (true, _) => String::new(),
        (false, Dialect::Portable) => format!("<documentation><xhtml:p>{about}</xhtml:p></documentation>"),
        (false, Dialect::Codesys | Dialect::Siemens) => {
            format!(
                "<documentation><xhtml xmlns=\"http://www.w3.org/1999/xhtml\">{about}</xhtml></documentation>"
            )
        }
    };
    let address = variable.address.as_ref().map(|at| format!(" address=\"{at}\"")).unwrap_or_default();
    typed(&(named(&variable.name) + &address), &ty, &initial, &about, indent)
}

/// A value in a declaration.
fn value(ex: &Ex, dialect: Dialect, text: &mut String) {
    match ex {
        Ex::List(values) => {
            *text += "<arrayValue>";
            for ex in values {
                *text += "<value>";
                value(ex, dialect, text);
                *text += "</value>";
            }
            *text += "</arrayValue>";
        }
        Ex::Fields(fields) => {
            *text += "<structValue>";
            for (name, ex) in fields {
                let _ = write!(text, "<value member=\"{name}\">");
                value(ex, dialect, text);
                *text += "</value>";
            }
            *text += "</structValue>";
        }
        single => {
            let _ = write!(text, "<simpleValue value=\"{}\"/>", escaped(&dialect.expression(single)));
        }
    }
}

fn named(name: &str) -> String {
    format!("name=\"{name}\"")
}

fn typed(attributes: &str, ty: &str, initial: &str, about: &str, indent: usize) -> String {
    format!("{}<variable {attributes}><type>{ty}</type>{initial}{about}</variable>\n", " ".repeat(indent))
}

fn escaped(text: &str) -> String {
    plain::xml(&plain::line(text))
}

/// Text that does not end a CDATA section.
fn cdata(text: &str) -> String {
    text.replace("]]>", "]]]]><![CDATA[>")
}
