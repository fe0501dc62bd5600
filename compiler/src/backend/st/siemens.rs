//! The program as a source of SCL, which TIA Portal imports: data block, functions, blocks, and the instance of MAIN.
//!
//! The statements are those of the portable text. What differs is how names are written: `#name` within a block,
//! `"Line".name` for what all blocks share, `"F_name"` for a function; and that states and members are constants
//! of the block.

mod copies;
mod quotes;

use super::Line;
use super::code::{Ex, Member, Stmt, expressions};
use super::context::Shared;
use super::declaration::{self, Instance, Unit, Variable};
use super::print::{Dialect, Notation, Writer, comment, harmless};
use super::structured::Structure;
use super::text::{made_from, render};
use super::values::Elements;
use crate::backend::{Part, Sink, Text, part};
use crate::naming::is_reserved;
use askama::Template;
pub use copies::copies;
use quotes::{is_word, push_quoted, quoted};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::fmt::{self, Formatter, Write};

/// The data block of what all blocks share.
const SHARED: &str = "Line";
/// The block that calls all others. Each project has a block `Main` already, and names are not told by their case.
const CALLER: &str = "Line_controller";
const DIALECT: Dialect = Dialect::Siemens;

#[derive(Template)]
#[template(path = "plc/siemens/header.scl", escape = "none")]
struct Header {
    made_from: String,
}

#[derive(Template)]
#[template(path = "plc/siemens/data_block.scl", escape = "none")]
struct DataBlock<'a> {
    sections: Part<'a>,
    /// The values of arrays and structures, as assignments.
    values: Part<'a>,
    /// Some of its variables are: each section says so.
    is_retained: bool,
}

#[derive(Template)]
#[template(path = "plc/siemens/structure.scl", escape = "none")]
struct StructureText {
    name: String,
    about: String,
    fields: String,
}

#[derive(Template)]
#[template(path = "plc/siemens/function.scl", escape = "none")]
struct FunctionText {
    name: String,
    about: String,
    ty: String,
    sections: String,
    body: String,
}

#[derive(Template)]
#[template(path = "plc/siemens/block.scl", escape = "none")]
struct Block<'a> {
    name: &'a str,
    comments: Vec<String>,
    made_from: &'a str,
    sections: Part<'a>,
    body: Part<'a>,
}

/// `main.scl`, and how it is called. `copies` is what [`copies`] says of the table of addresses.
pub fn files(shared: Shared, line: &Line, copies: &str, files: &mut dyn Sink) {
    files.file("main.scl", &Text(|f: &mut Formatter| main(shared, line, f)));
    let task = include_str!("../../../../templates/plc/siemens/task.txt");
    let scan_ms = shared.system.scan_ms;
    let task = task
        .replace("SCAN_US", &(i64::from(scan_ms) * 1000).to_string())
        .replace("SCAN_MS", &scan_ms.to_string())
        .replace("AT_ADDRESSES", copies);
    files.file("TASK.txt", &task);
}

fn main(shared: Shared, line: &Line, to: &mut Formatter) -> fmt::Result {
    let made_from = made_from(shared);
    writeln!(to, "{}", Header { made_from: made_from.clone() })?;
    line.structures.iter().try_for_each(|of_line| write!(to, "\n{}", structure(of_line)))?;
    let is_retained = line.globals.all().any(|variable| variable.is_retained);
    let data = DataBlock {
        sections: part(|f| {
            let all: Vec<&Variable> = line.globals.all().collect();
            declaration::sections("VAR", all, |variable, f| declared(&without_values(variable), f), f)
        }),
        values: part(|f| line.globals.all().try_for_each(|variable| values(variable, f))),
        is_retained,
    };
    write!(to, "\n{data}\n")?;
    line.functions.iter().try_for_each(|function| write!(to, "\n{}", function_text(function.text)))?;
    line.units().try_for_each(|unit| block(unit, &made_from, to))?;
    let instance = include_str!("../../../../templates/plc/siemens/instance.scl");
    // What its blocks retain, they say.
    match is_retained {
        true => write!(to, "\n{}", instance.replace("NON_RETAIN\n", "")),
        false => write!(to, "\n{instance}"),
    }
}

fn sections(keyword: &str, variables: &[Variable], to: &mut Formatter) -> fmt::Result {
    declaration::sections(keyword, variables, |variable, f| declared(variable, f), to)
}

fn declared(variable: &Variable, to: &mut impl Write) -> fmt::Result {
    match is_word(&variable.name) {
        true => Variable { name: quoted(&variable.name).into(), ..variable.clone() }.line(DIALECT, to),
        false => variable.line(DIALECT, to),
    }
}

fn structure(structure: &Structure) -> String {
    let field = |field: &Variable| {
        let mut lines = String::new();
        // Writing to memory does not fail.
        let _ = declared(field, &mut lines);
        lines.lines().map(|line| format!("    {line}\n")).collect::<String>()
    };
    render(&StructureText {
        name: structure.name.clone(),
        about: structure.about.clone(),
        fields: structure.fields.iter().map(field).collect(),
    })
}

/// The declaration without an address and without what [`values`] writes.
fn without_values(variable: &Variable) -> Variable {
    let initial =
        variable.initial.as_ref().filter(|initial| !matches!(***initial, Ex::List(_) | Ex::Fields(_)));
    Variable { address: None, initial: initial.cloned(), ..variable.without_value() }
}

/// The values of arrays and structures as assignments.
fn values(variable: &Variable, to: &mut Formatter) -> fmt::Result {
    match variable.initial.as_deref() {
        Some(initial @ (Ex::List(_) | Ex::Fields(_))) => {
            assign(&mut quoted(&variable.name), initial, variable.each, to)
        }
        _ => Ok(()),
    }
}

/// `each`: the number of elements in a row of an array of two dimensions.
fn assign(place: &mut String, value: &Ex, each: Option<usize>, to: &mut Formatter) -> fmt::Result {
    let whole = place.len();
    match value {
        Ex::List(list) => (0..list.len).try_for_each(|i| {
            match each {
                Some(each) => write!(place, "[{}, {}]", i / each, i % each)?,
                None => write!(place, "[{i}]")?,
            }
            match &list.elements {
                Elements::Single(values) => {
                    values.get(i).map_or(Ok(()), |value| assign(place, &value, None, to))?;
                }
                Elements::Structures(fields) => {
                    let mut said = fields.iter().filter_map(|field| Some((&field.name, field.said(i)?)));
                    said.try_for_each(|(field, value)| assign_field(place, field, &value, to))?;
                }
            }
            place.truncate(whole);
            Ok(())
        }),
        Ex::Fields(fields) => {
            fields.iter().try_for_each(|(field, value)| assign_field(place, field, value, to))
        }
        // What a data block has without a start value.
        Ex::Bool(false) | Ex::Int(0) => Ok(()),
        Ex::Real(real) if real.to_bits() == 0 => Ok(()),
        Ex::Member(member) => writeln!(to, "    {place} := {}; {}", member.value, comment(&member.note)),
        single => {
            *place += " := ";
            DIALECT.write(single, place);
            writeln!(to, "    {place};")?;
            place.truncate(whole);
            Ok(())
        }
    }
}

fn assign_field(place: &mut String, field: &str, value: &Ex, to: &mut Formatter) -> fmt::Result {
    let whole = place.len();
    place.push('.');
    push_quoted(field, place);
    assign(place, value, None, to)?;
    place.truncate(whole);
    Ok(())
}

fn block(unit: &Unit, made_from: &str, to: &mut Formatter) -> fmt::Result {
    let constants = Constants::of(unit);
    let instance = |i: &Instance, f: &mut Formatter| {
        writeln!(f, "    {} : \"{}\";{}", quoted(&i.name), i.block, i.about())
    };
    let constant = |(name, member): (&String, &Member), f: &mut Formatter| {
        writeln!(f, "    {} : DINT := {};", of_constant(name), member.value)
    };
    let declared = [&unit.inputs, &unit.outputs, &unit.references, &unit.variables].into_iter().flatten();
    let declared = declared.map(|variable| variable.name.as_str());
    let own = declared.chain(unit.instances.iter().map(|instance| instance.name.as_str())).collect();
    let names = Names { own, constants: &constants };
    let text = Block {
        name: if unit.name == "MAIN" { CALLER } else { &unit.name },
        comments: unit.comments.iter().map(|line| harmless(line.trim()).into_owned()).collect(),
        made_from,
        sections: part(|f| {
            sections("VAR_INPUT", &unit.inputs, f)?;
            sections("VAR_OUTPUT", &unit.outputs, f)?;
            sections("VAR_IN_OUT", &unit.references, f)?;
            sections("VAR", &unit.variables, f)?;
            declaration::block("VAR", unit.instances.iter(), instance, f)?;
            declaration::block("VAR CONSTANT", constants.in_order().into_iter(), constant, f)
        }),
        body: part(|f| {
            let writer = Writer { dialect: DIALECT, names: &names };
            unit.body.pieces().try_for_each(|piece| writer.statements(piece.iter(), 1, f))
        }),
    };
    write!(to, "\n{text}\n")
}

/// The states and members that a block names, as constants of it.
struct Constants {
    names: BTreeMap<String, Member>,
}

impl Constants {
    fn of(unit: &Unit) -> Self {
        let own = [&unit.inputs, &unit.outputs, &unit.references, &unit.variables]
            .into_iter()
            .flatten()
            .map(|v| v.name.to_lowercase());
        let own: BTreeSet<String> = own.chain(unit.instances.iter().map(|i| i.name.to_lowercase())).collect();
        let mut names = BTreeMap::new();
        for piece in unit.body.pieces() {
            let mut members = Vec::new();
            members_of(&piece, &mut members);
            for member in members {
                let Some(name) = Self::name(member) else { continue };
                // One that is called as a variable of the block stays a number.
                if !names.contains_key(&name) && !own.contains(&name.to_lowercase()) {
                    names.insert(name, member.clone());
                }
            }
        }
        Self { names }
    }

    /// `E_Slot.Full` is `Slot_Full`.
    fn name(member: &Member) -> Option<String> {
        let qualified = member.qualified.as_ref()?;
        Some(qualified.strip_prefix("E_").unwrap_or(qualified).replace('.', "_"))
    }

    /// By their types, and by their numbers.
    fn in_order(&self) -> Vec<(&String, &Member)> {
        let mut all: Vec<_> = self.names.iter().collect();
        let ty = |name: &str| name.split_once('_').map(|(ty, _)| ty.to_string());
        all.sort_by_key(|(name, member)| (ty(name), member.value));
        all
    }

    /// The name of a member's constant, if it has one.
    fn name_of(&self, member: &Member) -> Option<String> {
        Self::name(member).filter(|name| self.names.contains_key(name))
    }
}

/// The name of a constant. The type and the member together may be a word of SCL or of the standard, as `Time_Of_Day`.
fn of_constant(name: &str) -> String {
    match is_reserved(name) {
        true => format!("\"{name}\""),
        false => quoted(name),
    }
}

fn members_of<'a>(statements: &'a [Stmt], found: &mut Vec<&'a Member>) {
    expressions(statements, &mut |ex| members_in(ex, found));
    labels(statements, found);
}

fn members_in<'a>(ex: &'a Ex, found: &mut Vec<&'a Member>) {
    match ex {
        Ex::Member(member) => found.push(member),
        Ex::Bool(_) | Ex::Int(_) | Ex::Real(_) | Ex::Name(_) | Ex::Field(..) | Ex::List(_) => {}
        Ex::Element(_, a) | Ex::Not(a) | Ex::Minus(a) | Ex::Part(a, _) => members_in(a, found),
        Ex::Binary(_, a, b) | Ex::Within(a, _, b) => {
            members_in(a, found);
            members_in(b, found);
        }
        Ex::Item(a, indices) => {
            members_in(a, found);
            indices.iter().for_each(|index| members_in(index, found));
        }
        Ex::Fields(fields) => fields.iter().for_each(|(_, value)| members_in(value, found)),
        Ex::Chain(_, parts) => parts.iter().for_each(|part| members_in(part, found)),
        Ex::Call(_, arguments) => arguments.iter().for_each(|(_, a)| members_in(a, found)),
    }
}

/// The labels of all CASE statements.
fn labels<'a>(statements: &'a [Stmt], found: &mut Vec<&'a Member>) {
    for statement in statements {
        match statement {
            Stmt::Case { branches, otherwise, .. } => {
                for (label, body) in branches {
                    found.push(label);
                    labels(body, found);
                }
                labels(otherwise, found);
            }
            Stmt::If(arms, otherwise) => {
                arms.iter().for_each(|arm| labels(&arm.body, found));
                labels(otherwise, found);
            }
            Stmt::While { body, .. } => labels(body, found),
            Stmt::Comment(_) | Stmt::Assign(..) | Stmt::Exit | Stmt::Return | Stmt::Call { .. } => {}
        }
    }
}

/// Names as SCL writes them.
struct Names<'a> {
    /// What the block declares; all else is shared.
    own: HashSet<&'a str>,
    constants: &'a Constants,
}

impl Notation for Names<'_> {
    fn variable(&self, name: &str, text: &mut String) {
        match self.own.contains(name) {
            true => text.push('#'),
            false => text.extend(["\"", SHARED, "\"."]),
        }
        push_quoted(name, text);
    }

    fn field(&self, name: &str, text: &mut String) {
        push_quoted(name, text);
    }

    fn member<'m>(&self, member: &'m Member) -> Option<Cow<'m, str>> {
        self.constants.name_of(member).map(|name| format!("#{}", of_constant(&name)).into())
    }
}

/// A function of the portable text as SCL has it.
fn function_text(text: &str) -> String {
    let (head, rest) = text.split_once("FUNCTION ").unwrap_or(("", text));
    let (name_and_type, rest) = rest.split_once('\n').unwrap_or((rest, ""));
    let (name, ty) = name_and_type.split_once(" : ").unwrap_or((name_and_type, "DINT"));
    let rest = rest.strip_suffix("END_FUNCTION\n").unwrap_or(rest);
    let (sections, body) = match rest.rfind("END_VAR\n") {
        Some(end) => rest.split_at(end + "END_VAR\n".len()),
        None => ("", rest),
    };
    let declared = sections.lines().filter_map(|line| line.trim().split_once(" : ").map(|(name, _)| name));
    let own: BTreeSet<&str> = declared.chain([name]).collect();
    let mut out = String::new();
    for line in body.split_inclusive('\n') {
        out += "    ";
        let mut rest = line;
        while let Some(first) = rest.chars().next() {
            let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
            let end = rest.find(|c| is_word(c) != is_word(first)).unwrap_or(rest.len());
            let (word, behind) = rest.split_at(end);
            let is_argument = behind.starts_with(" := ") && !out.ends_with("    ");
            out += &match word {
                // The name of an argument stands within the brackets of a call.
                _ if own.contains(word) && !is_argument => format!("#{word}"),
                _ if word.starts_with("F_") => format!("\"{word}\""),
                _ => number(word),
            };
            rest = behind;
        }
    }
    let about = head.trim().trim_start_matches("(* ").trim_end_matches(" *)").to_string();
    render(&FunctionText {
        name: name.into(),
        about,
        ty: ty.into(),
        sections: sections.replace("\nVAR\n", "\nVAR_TEMP\n"),
        body: out,
    })
}

/// A number with a point as one of 64 bits.
fn number(word: &str) -> String {
    match word.contains('.') && word.starts_with(|c: char| c.is_ascii_digit()) {
        true => format!("LREAL#{word}"),
        false => word.into(),
    }
}
