//! PLCopen XML, in the two flavours that tools import: bodies are the same text as in the files of Structured Text.

use super::Line;
use super::attributes;
use super::code::Ex;
use super::context::Shared;
use super::declaration::{Instance, Unit, Variable, lists_of_globals};
use super::functions::Function;
use super::print::{Dialect, harmless};
use super::text::{body, enumerations, made_from};
use super::values::Elements;
use crate::backend::{Part, part};
use crate::{plain, version};
use askama::Template;
use std::borrow::Borrow;
use std::fmt::{self, Formatter, Write};

#[derive(Template)]
#[template(path = "plc/plcopen.xml")]
struct Plcopen<'a> {
    made_from: String,
    version: &'static str,
    day: &'static str,
    pous: Vec<Pou<'a>>,
    scan_ms: i32,
    globals: Part<'a>,
}

#[derive(Template)]
#[template(path = "plc/codesys.xml")]
struct Codesys<'a> {
    made_from: String,
    version: &'static str,
    day: &'static str,
    enumerations: Vec<Enumeration>,
    structures: Vec<StructureXml<'a>>,
    pous: Vec<Pou<'a>>,
    lists: Vec<List<'a>>,
}

struct Pou<'a> {
    name: &'a str,
    kind: &'static str,
    interface: Part<'a>,
    body: Part<'a>,
}

struct Enumeration {
    name: String,
    members: String,
    attributes: String,
}

struct StructureXml<'a> {
    name: &'a str,
    fields: Part<'a>,
}

struct List<'a> {
    name: &'static str,
    variables: Part<'a>,
    is_retained: bool,
    attributes: String,
}

/// For Beremiz, OpenPLC and other tools that keep to the standard.
pub fn plcopen<'a>(shared: Shared<'a>, line: &'a Line) -> Part<'a> {
    let all: Vec<&Variable> = line.globals.all().collect();
    let lists = lists_of_globals(&all, Dialect::Portable);
    let of = |v: &Variable, f: &mut Formatter| variable(v, Dialect::Portable, 10, f);
    let text = Plcopen {
        made_from: escaped(&made_from(shared)),
        version: version::NUMBER,
        day: version::DAY,
        pous: pous(line, Dialect::Portable),
        scan_ms: shared.system.scan_ms,
        globals: part(move |f| {
            lists.iter().try_for_each(|list| sections("globalVars", list.iter().copied(), 8, of, f))
        }),
    };
    part(move |f| writeln!(f, "{text}"))
}

/// For CODESYS and TwinCAT.
pub fn codesys<'a>(shared: Shared<'a>, line: &'a Line) -> Part<'a> {
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
        name: &structure.name,
        fields: part(move |f| structure.fields.iter().try_for_each(|v| variable(v, Dialect::Codesys, 12, f))),
    });
    let lists = (line.globals.lists().into_iter())
        .map(|list| List {
            name: list.name,
            is_retained: list.is_retained,
            attributes: attributes::additional_data(list.attributes, 8),
            variables: part(move |f| {
                list.variables.iter().try_for_each(|v| variable(v, Dialect::Codesys, 8, f))
            }),
        })
        .collect();
    let text = Codesys {
        made_from: escaped(&made_from(shared)),
        version: version::NUMBER,
        day: version::DAY,
        enumerations,
        structures: structures.collect(),
        pous: pous(line, Dialect::Codesys),
        lists,
    };
    part(move |f| writeln!(f, "{text}"))
}

fn pous<'a>(line: &'a Line<'a>, dialect: Dialect) -> Vec<Pou<'a>> {
    let functions = line.functions.iter().map(|f| function(f));
    functions.chain(line.units().map(|unit| pou(unit, dialect))).collect()
}

fn pou<'a>(unit: &'a Unit<'a>, dialect: Dialect) -> Pou<'a> {
    Pou {
        name: &unit.name,
        kind: if unit.name == "MAIN" { "program" } else { "functionBlock" },
        interface: part(move |f| interface(unit, dialect, f)),
        body: part(move |f| body(unit, dialect, &mut Cdata(f))),
    }
}

fn interface(unit: &Unit, dialect: Dialect, to: &mut Formatter) -> fmt::Result {
    let of = |v: &Variable, f: &mut Formatter| variable(v, dialect, 12, f);
    section("inputVars", 10, unit.inputs.iter(), of, to)?;
    sections("outputVars", &unit.outputs(dialect), 10, of, to)?;
    section("inOutVars", 10, unit.references.iter(), of, to)?;
    let instance = |i: &Instance, f: &mut Formatter| {
        f.write_str(&typed(&named(&i.name), &format!("<derived name=\"{}\"/>", i.block), 12))
    };
    let instances =
        |is_retained: bool| unit.instances.iter().filter(move |i| i.is_retained_in(dialect) == is_retained);
    sections("localVars", &unit.variables, 10, of, to)?;
    section("localVars", 10, instances(false), instance, to)?;
    retained("localVars", 10, instances(true), instance, to)?;
    if dialect == Dialect::Portable {
        section("externalVars", 10, unit.externals.iter(), |v, f| of(&v, f), to)?;
    }
    to.write_str(&attributes::additional_data(unit.attributes(dialect), 10))
}

/// A function from its text: its type stands in the first line behind the comment, then come sections.
fn function(function: &Function) -> Pou<'static> {
    let text = function.text.split_once("FUNCTION ").map_or("", |(_, rest)| rest);
    let mut lines = text.lines();
    let result = lines.next().and_then(|l| l.split(" : ").nth(1)).unwrap_or_default();
    let mut interface = format!("          <returnType><{result}/></returnType>\n");
    let mut open: Option<(&str, String)> = None;
    let mut body = String::new();
    for line in lines {
        match (line, &mut open) {
            ("VAR_INPUT", _) => open = Some(("inputVars", String::new())),
            ("VAR", _) => open = Some(("localVars", String::new())),
            ("END_VAR", Some((name, variables))) => {
                let _ = write!(interface, "          <{name}>\n{variables}          </{name}>\n");
                open = None;
            }
            ("END_FUNCTION", _) => {}
            (line, Some((_, variables))) => {
                if let Some((name, ty)) = line.trim().trim_end_matches(';').split_once(" : ") {
                    *variables += &typed(&named(name), &format!("<{ty}/>"), 12);
                }
            }
            (line, None) => {
                let _ = writeln!(body, "{line}");
            }
        }
    }
    Pou {
        name: function.name,
        kind: "function",
        interface: Box::new(interface),
        body: part(move |f| Cdata(f).write_str(&body)),
    }
}

/// Those that are retained in a section of their own.
fn sections<'a>(
    name: &str,
    variables: impl IntoIterator<Item = &'a Variable> + Clone,
    indent: usize,
    of: impl Fn(&Variable, &mut Formatter) -> fmt::Result,
    to: &mut Formatter,
) -> fmt::Result {
    let some = |is_retained: bool| {
        variables.clone().into_iter().filter(move |variable| variable.is_retained == is_retained)
    };
    section(name, indent, some(false), &of, to)?;
    retained(name, indent, some(true), &of, to)
}

fn section<T>(
    name: &str,
    indent: usize,
    all: impl Iterator<Item = T>,
    of: impl Fn(T, &mut Formatter) -> fmt::Result,
    to: &mut Formatter,
) -> fmt::Result {
    element(name, "", indent, all, of, to)
}

/// A section that outlasts a loss of power.
fn retained<T>(
    name: &str,
    indent: usize,
    all: impl Iterator<Item = T>,
    of: impl Fn(T, &mut Formatter) -> fmt::Result,
    to: &mut Formatter,
) -> fmt::Result {
    element(name, " retain=\"true\"", indent, all, of, to)
}

/// Nothing if it would be empty.
fn element<T>(
    name: &str,
    attributes: &str,
    indent: usize,
    all: impl Iterator<Item = T>,
    of: impl Fn(T, &mut Formatter) -> fmt::Result,
    to: &mut Formatter,
) -> fmt::Result {
    let mut all = all.peekable();
    if all.peek().is_none() {
        return Ok(());
    }
    writeln!(to, "{:indent$}<{name}{attributes}>", "")?;
    all.try_for_each(|each| of(each, to))?;
    writeln!(to, "{:indent$}</{name}>", "")
}

fn variable(variable: &Variable, dialect: Dialect, indent: usize, to: &mut Formatter) -> fmt::Result {
    write!(to, "{:indent$}<variable name=\"{}\"", "", variable.name)?;
    if let Some(at) = &variable.address {
        write!(to, " address=\"{at}\"")?;
    }
    to.write_str("><type>")?;
    let last = variable.last(dialect);
    if !last.is_empty() {
        to.write_str("<array>")?;
        last.iter().try_for_each(|last| write!(to, "<dimension lower=\"0\" upper=\"{last}\"/>"))?;
        to.write_str("<baseType>")?;
    }
    match variable.structure.as_ref().or(variable.enumeration.as_ref()) {
        Some(name) => write!(to, "<derived name=\"{name}\"/>")?,
        None => write!(to, "<{}/>", variable.basic.name())?,
    }
    if !last.is_empty() {
        to.write_str("</baseType></array>")?;
    }
    to.write_str("</type>")?;
    if let Some(ex) = &variable.initial {
        to.write_str("<initialValue>")?;
        value(ex, dialect, &mut String::new(), to)?;
        to.write_str("</initialValue>")?;
    }
    about(variable, dialect, to)?;
    to.write_str("</variable>\n")
}

/// The comments of a variable.
fn about(variable: &Variable, dialect: Dialect, to: &mut Formatter) -> fmt::Result {
    let about = variable.comments.iter().fold(String::new(), |text, line| match text.as_str() {
        "" => line.to_string(),
        text if text.ends_with('.') => format!("{text} {line}"),
        text => format!("{text}; {line}"),
    });
    let about = escaped(&harmless(&about));
    match dialect {
        _ if about.is_empty() => Ok(()),
        Dialect::Portable => write!(to, "<documentation><xhtml:p>{about}</xhtml:p></documentation>"),
        Dialect::Codesys | Dialect::Siemens => write!(
            to,
            "<documentation><xhtml xmlns=\"http://www.w3.org/1999/xhtml\">{about}</xhtml></documentation>"
        ),
    }
}

/// A value in a declaration. `text` is for the text of a single one.
fn value(ex: &Ex, dialect: Dialect, text: &mut String, to: &mut Formatter) -> fmt::Result {
    match ex {
        Ex::List(list) => {
            to.write_str("<arrayValue>")?;
            for i in 0..list.len {
                to.write_str("<value>")?;
                match &list.elements {
                    Elements::Single(values) => {
                        values.get(i).map_or(Ok(()), |ex| value(&ex, dialect, text, to))?
                    }
                    Elements::Structures(fields) => {
                        let said = fields.iter().filter_map(|field| Some((&*field.name, field.said(i)?)));
                        structure(said, dialect, text, to)?;
                    }
                }
                to.write_str("</value>")?;
            }
            to.write_str("</arrayValue>")
        }
        Ex::Fields(fields) => structure(fields.iter().map(|(name, ex)| (&**name, ex)), dialect, text, to),
        single => {
            text.clear();
            dialect.write(single, text);
            to.write_str("<simpleValue value=\"")?;
            write_escaped(text, to)?;
            to.write_str("\"/>")
        }
    }
}

/// The values of a structure.
fn structure<'f, E: Borrow<Ex>>(
    fields: impl Iterator<Item = (&'f str, E)>,
    dialect: Dialect,
    text: &mut String,
    to: &mut Formatter,
) -> fmt::Result {
    to.write_str("<structValue>")?;
    for (name, ex) in fields {
        write!(to, "<value member=\"{name}\">")?;
        value(ex.borrow(), dialect, text, to)?;
        to.write_str("</value>")?;
    }
    to.write_str("</structValue>")
}

fn named(name: &str) -> String {
    format!("name=\"{name}\"")
}

fn typed(attributes: &str, ty: &str, indent: usize) -> String {
    format!("{:indent$}<variable {attributes}><type>{ty}</type></variable>\n", "")
}

/// Numbers and most names are as they are.
fn write_escaped(text: &str, to: &mut Formatter) -> fmt::Result {
    match text.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"_.-+ ".contains(&byte)) {
        true => to.write_str(text),
        false => to.write_str(&escaped(text)),
    }
}

fn escaped(text: &str) -> String {
    plain::xml(&plain::line(text))
}

/// Text that does not end a CDATA section. What would end it stands within one piece, as a statement does.
struct Cdata<'a, 'b>(&'a mut Formatter<'b>);

impl Write for Cdata<'_, '_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for (number, part) in text.split("]]>").enumerate() {
            if number > 0 {
                self.0.write_str("]]]]><![CDATA[>")?;
            }
            self.0.write_str(part)?;
        }
        Ok(())
    }
}
