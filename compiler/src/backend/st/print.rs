//! Text of statements and expressions, in one of two dialects.

use super::code::{self, Arm, Ex, Member, Stmt};
use super::values::List;
use crate::plain;
use std::borrow::{Borrow, Cow};
use std::fmt::{self, Write};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dialect {
    /// What common compilers take: numbers for members and states, globals declared where they are used.
    Portable,
    /// CODESYS and TwinCAT: enumerations, global variable lists.
    Codesys,
    /// SCL: constants for members and states, numbers with their type, functions in quotes. Its names are written by
    /// [`super::siemens`].
    Siemens,
}

/// Lines longer than this are broken at AND and OR.
const WIDTH: usize = 108;

/// A text as a comment.
pub fn comment(text: &str) -> String {
    format!("(* {} *)", harmless(text))
}

/// Text on one line that neither begins nor ends a comment.
pub fn harmless(text: &str) -> Cow<'_, str> {
    let text = plain::on_a_line(text);
    if text.contains('*') { text.replace("(*", "( *").replace("*)", "* )").into() } else { text }
}

/// Adds a number with a point.
fn real(value: f64, text: &mut String) {
    let begin = text.len();
    // Writing to memory does not fail.
    let _ = write!(text, "{value:?}");
    if let Some(power) = text[begin..].find('e').map(|at| begin + at) {
        let point = if text[begin..power].contains('.') { "" } else { ".0" };
        text.replace_range(power..=power, &format!("{point}E"));
    }
}

/// A number that is too great or too small for a literal of old tools, as a product that is exactly it.
fn product(value: f64) -> Option<(f64, f64)> {
    /// 2 to the power of 100.
    const POWER: f64 = 1_267_650_600_228_229_401_496_703_205_376.0;
    let size = value.abs();
    if size > 1.0e38 {
        Some((value / POWER, POWER))
    } else if size > 0.0 && size < 1.0e-37 {
        Some((value * POWER, 1.0 / POWER))
    } else {
        None
    }
}

/// How a text writes the names of a unit.
pub trait Notation {
    /// A variable or an instance of a block.
    fn variable(&self, name: &str, text: &mut String);
    /// A field of a structure, an input or an output of a block.
    fn field(&self, name: &str, text: &mut String);
    /// The name of a member; none of one that stands as a number.
    fn member<'m>(&self, member: &'m Member) -> Option<Cow<'m, str>>;
}

/// Names as they are.
impl Notation for Dialect {
    fn variable(&self, name: &str, text: &mut String) {
        *text += name;
    }

    fn field(&self, name: &str, text: &mut String) {
        *text += name;
    }

    fn member<'m>(&self, member: &'m Member) -> Option<Cow<'m, str>> {
        match self {
            Dialect::Portable => None,
            Dialect::Codesys | Dialect::Siemens => member.qualified.as_deref().map(Cow::Borrowed),
        }
    }
}

impl Dialect {
    fn writer(&self) -> Writer<'_, Dialect> {
        Writer { dialect: *self, names: self }
    }

    pub fn expression(self, ex: &Ex) -> String {
        self.writer().expression(ex)
    }

    /// Adds an expression to a text.
    pub fn write(self, ex: &Ex, text: &mut String) {
        self.writer().write(ex, text);
    }

    /// The value in a declaration: that of a long array on several lines.
    pub fn initial(self, value: &Ex, to: &mut impl Write) -> fmt::Result {
        self.writer().initial(value, to)
    }

    /// Writes statements one by one.
    pub fn statements<S: Borrow<Stmt>>(
        self,
        statements: impl IntoIterator<Item = S>,
        depth: usize,
        to: &mut impl Write,
    ) -> fmt::Result {
        self.writer().statements(statements, depth, to)
    }
}

/// Writes the expressions and statements of a unit.
pub struct Writer<'a, N> {
    pub dialect: Dialect,
    /// How their names are written.
    pub names: &'a N,
}

impl<N> Clone for Writer<'_, N> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<N> Copy for Writer<'_, N> {}

impl<N: Notation> Writer<'_, N> {
    fn expression(self, ex: &Ex) -> String {
        let mut text = String::new();
        self.write(ex, &mut text);
        text
    }

    /// SCL has literals of 64 bits, and data blocks take no expressions.
    fn factors(self, value: f64) -> Option<(f64, f64)> {
        match self.dialect {
            Dialect::Portable | Dialect::Codesys => product(value),
            Dialect::Siemens => None,
        }
    }

    fn write(self, ex: &Ex, text: &mut String) {
        match ex {
            Ex::Bool(true) => *text += "TRUE",
            Ex::Bool(false) => *text += "FALSE",
            Ex::Int(i32::MIN) => *text += "-2147483647 - 1",
            Ex::Int(i) => _ = write!(text, "{i}"),
            Ex::Real(r) => match self.factors(*r) {
                Some((rest, power)) => self.write(&code::binary("*", Ex::Real(rest), Ex::Real(power)), text),
                None => {
                    if self.dialect == Dialect::Siemens {
                        *text += "LREAL#";
                    }
                    real(*r, text);
                }
            },
            Ex::Member(member) => match self.names.member(member) {
                Some(name) => *text += &name,
                None => _ = write!(text, "{} {}", member.value, comment(&member.note)),
            },
            Ex::Name(name) => self.names.variable(name, text),
            Ex::Element(name, index) => {
                self.names.variable(name, text);
                self.write_all("[", std::slice::from_ref(&**index), "]", text);
            }
            Ex::Field(instance, output) => {
                self.names.variable(instance, text);
                text.push('.');
                self.names.field(output, text);
            }
            Ex::Within(row, each, element) => {
                self.write(&code::sum(code::times((**row).clone(), *each), (**element).clone()), text);
            }
            Ex::Part(of, field) => {
                self.write(of, text);
                text.push('.');
                self.names.field(field, text);
            }
            Ex::Item(of, indices) => {
                self.write(of, text);
                self.write_all("[", indices, "]", text);
            }
            Ex::List(list) => text.extend(["[", &self.list(list).collect::<Vec<_>>().join(", "), "]"]),
            Ex::Fields(fields) => {
                for (i, (name, value)) in fields.iter().enumerate() {
                    text.extend([if i == 0 { "(" } else { ", " }, name.as_str(), " := "]);
                    self.write(value, text);
                }
                *text += if fields.is_empty() { "()" } else { ")" };
            }
            Ex::Not(a) => {
                *text += "NOT ";
                self.write_operand(a, text);
            }
            Ex::Minus(a) => {
                text.push('-');
                self.write_operand(a, text);
            }
            Ex::Binary(operator, a, b) => {
                self.write_operand(a, text);
                text.extend([" ", operator, " "]);
                self.write_operand(b, text);
            }
            Ex::Chain(operator, parts) => {
                for (i, part) in parts.iter().enumerate() {
                    if i > 0 {
                        text.extend([" ", operator, " "]);
                    }
                    self.write_operand(part, text);
                }
            }
            Ex::Call(function, arguments) => {
                *text += &self.function(function);
                text.push('(');
                for (i, (name, value)) in arguments.iter().enumerate() {
                    if i > 0 {
                        *text += ", ";
                    }
                    self.write_argument(name, value, text);
                }
                text.push(')');
            }
        }
    }

    fn write_all(self, begin: &str, all: &[Ex], end: &str, text: &mut String) {
        *text += begin;
        for (i, ex) in all.iter().enumerate() {
            if i > 0 {
                *text += ", ";
            }
            self.write(ex, text);
        }
        *text += end;
    }

    fn initial(self, value: &Ex, to: &mut impl Write) -> fmt::Result {
        let Ex::List(list) = value else { return to.write_str(&self.expression(value)) };
        let room = WIDTH / 2 - "[\n        ".len();
        let mut length = 0;
        let is_short = self.list(list).all(|part| {
            length += part.len() + ", ".len();
            length <= room + ", ".len()
        });
        if is_short {
            return to.write_str(&self.expression(value));
        }
        to.write_char('[')?;
        let mut width = WIDTH;
        for (i, part) in self.list(list).enumerate() {
            if i > 0 {
                to.write_char(',')?;
            }
            if width + part.len() + 2 > WIDTH - 8 {
                to.write_str("\n        ")?;
                width = 0;
            } else {
                to.write_char(' ')?;
            }
            width += part.len() + 2;
            to.write_str(&part)?;
        }
        to.write_char(']')
    }

    /// Values side by side; those that are alike by their number.
    fn list(self, list: &List) -> impl Iterator<Item = String> {
        let mut values = list.iter().peekable();
        let alike = std::iter::from_fn(move || {
            let first = values.next()?;
            let mut count = 1;
            while values.next_if(|value| *value == first).is_some() {
                count += 1;
            }
            Some((first, count))
        });
        alike.flat_map(move |(value, count)| {
            let text = self.expression(&value);
            match count > 2 {
                true => std::iter::repeat_n(format!("{count}({text})"), 1),
                false => std::iter::repeat_n(text, count),
            }
        })
    }

    /// Those of the program begin with `F_`.
    fn function(self, name: &str) -> String {
        match self.dialect == Dialect::Siemens && name.starts_with("F_") {
            true => format!("\"{name}\""),
            false => name.into(),
        }
    }

    /// Functions of the standard are called by position: their arguments have no names.
    fn write_argument(self, name: &str, value: &Ex, text: &mut String) {
        if !name.is_empty() {
            self.names.field(name, text);
            *text += " := ";
        }
        self.write(value, text);
    }

    fn operands(self, parts: &[Ex]) -> Vec<String> {
        parts.iter().map(|p| self.operand(p)).collect()
    }

    fn operand(self, ex: &Ex) -> String {
        let mut text = String::new();
        self.write_operand(ex, &mut text);
        text
    }

    fn write_operand(self, ex: &Ex, text: &mut String) {
        let begin = text.len();
        self.write(ex, text);
        let is_simple = match ex {
            Ex::Not(_) | Ex::Minus(_) | Ex::Binary(..) | Ex::Chain(..) => false,
            Ex::Real(r) if self.factors(*r).is_some() => false,
            Ex::Int(_) | Ex::Real(_) => !text[begin..].starts_with('-'),
            _ => true,
        };
        if !is_simple {
            text.insert(begin, '(');
            text.push(')');
        }
    }

    /// Writes statements one by one.
    pub fn statements<S: Borrow<Stmt>>(
        self,
        statements: impl IntoIterator<Item = S>,
        depth: usize,
        to: &mut impl Write,
    ) -> fmt::Result {
        let mut printer = Printer { writer: self, text: String::new() };
        for statement in statements {
            printer.statement(statement.borrow(), depth);
            to.write_str(&printer.text)?;
            printer.text.clear();
        }
        Ok(())
    }
}

struct Printer<'a, N> {
    writer: Writer<'a, N>,
    text: String,
}

impl<N: Notation> Printer<'_, N> {
    fn line(&mut self, depth: usize, text: &str) {
        self.indent(depth);
        self.text += text;
        self.text.push('\n');
    }

    fn indent(&mut self, depth: usize) {
        (0..depth).for_each(|_| self.text += "    ");
    }

    /// Long ones go over several lines.
    fn comment(&mut self, depth: usize, text: &str) {
        let text = comment(text);
        let mut line = String::new();
        let text = text.strip_suffix(" *)").unwrap_or(&text);
        for word in text.split_inclusive(' ') {
            if !line.is_empty() && 4 * depth + line.len() + word.trim_end().len() > WIDTH - 3 {
                self.line(depth, line.trim_end());
                line = "   ".into();
            }
            line += word;
        }
        self.line(depth, &format!("{} *)", line.trim_end()));
    }

    /// A line that begins and ends so around a condition.
    fn conditional(&mut self, depth: usize, begin: &str, condition: &Ex, end: &str) {
        let text = format!("{begin} {} {end}", self.writer.expression(condition));
        let (true, Ex::Chain(operator, parts)) = (4 * depth + text.len() > WIDTH, condition) else {
            return self.line(depth, &text);
        };
        let parts = self.writer.operands(parts);
        let last = parts.len() - 1;
        for (i, part) in parts.iter().enumerate() {
            let tail = if i == last { format!(" {end}") } else { String::new() };
            match i {
                0 => self.line(depth, &format!("{begin} {part}{tail}")),
                _ => self.line(depth + 1, &format!("{operator} {part}{tail}")),
            }
        }
    }

    fn block(&mut self, statements: &[Stmt], depth: usize) {
        statements.iter().for_each(|s| self.statement(s, depth));
    }

    fn statement(&mut self, statement: &Stmt, depth: usize) {
        match statement {
            Stmt::Comment(text) => self.comment(depth, text),
            Stmt::Assign(target, assigned) => {
                let begin = self.text.len();
                self.indent(depth);
                self.writer.write(target, &mut self.text);
                self.text += " := ";
                match assigned {
                    // The comment of a member stands behind the statement.
                    Ex::Member(m) if self.writer.names.member(m).is_none() => {
                        let _ = write!(self.text, "{}; {}", m.value, comment(&m.note));
                    }
                    _ => {
                        self.writer.write(assigned, &mut self.text);
                        self.text.push(';');
                    }
                }
                match assigned {
                    Ex::Call(function, arguments) if self.text.len() - begin > WIDTH => {
                        self.text.truncate(begin);
                        let begin = format!(
                            "{} := {}",
                            self.writer.expression(target),
                            self.writer.function(function)
                        );
                        let arguments = arguments.iter().map(|(name, value)| (*name, value));
                        self.call(&begin, arguments, depth);
                    }
                    _ => self.text.push('\n'),
                }
            }
            Stmt::If(arms, otherwise) => {
                for (i, arm) in arms.iter().enumerate() {
                    self.arm(arm, if i == 0 { "IF" } else { "ELSIF" }, depth);
                }
                if !otherwise.is_empty() {
                    self.line(depth, "ELSE");
                    self.block(otherwise, depth + 1);
                }
                self.line(depth, "END_IF;");
            }
            Stmt::Case { selector, branches, otherwise } => {
                let selector = self.writer.expression(selector);
                self.line(depth, &format!("CASE {selector} OF"));
                for (label, body) in branches {
                    let label = match self.writer.names.member(label) {
                        Some(name) => format!("{name}:"),
                        None => format!("{}: {}", label.value, comment(&label.note)),
                    };
                    self.line(depth + 1, &label);
                    self.block(body, depth + 2);
                }
                self.line(depth + 1, "ELSE");
                self.block(otherwise, depth + 2);
                self.line(depth, "END_CASE;");
            }
            Stmt::While { condition, body, .. } => {
                self.conditional(depth, "WHILE", condition, "DO");
                self.block(body, depth + 1);
                self.line(depth, "END_WHILE;");
            }
            Stmt::Exit => self.line(depth, "EXIT;"),
            Stmt::Return => self.line(depth, "RETURN;"),
            Stmt::Call { instance, arguments } => {
                let mut begin = String::new();
                self.writer.names.variable(instance, &mut begin);
                self.call(&begin, arguments.iter().map(|(name, value)| (name.as_str(), value)), depth);
            }
        }
    }

    fn arm(&mut self, arm: &Arm, word: &str, depth: usize) {
        arm.comments.iter().for_each(|text| self.comment(depth, text));
        self.conditional(depth, word, &arm.condition, "THEN");
        self.block(&arm.body, depth + 1);
    }

    /// A call on one line, or with an argument on each.
    fn call<'a>(
        &mut self,
        begin: &str,
        arguments: impl Iterator<Item = (&'a str, &'a Ex)> + Clone,
        depth: usize,
    ) {
        let mut one_line = format!("{begin}(");
        for (i, (name, value)) in arguments.clone().enumerate() {
            if i > 0 {
                one_line += ", ";
            }
            self.writer.write_argument(name, value, &mut one_line);
            // The brackets and the semicolon have three characters.
            if 4 * depth + one_line.len() + 2 > WIDTH {
                return self.long_call(begin, arguments, depth);
            }
        }
        self.line(depth, &(one_line + ");"));
    }

    fn long_call<'a>(
        &mut self,
        begin: &str,
        arguments: impl Iterator<Item = (&'a str, &'a Ex)>,
        depth: usize,
    ) {
        self.line(depth, &format!("{begin}("));
        let mut arguments = arguments.peekable();
        while let Some((name, value)) = arguments.next() {
            self.indent(depth + 1);
            self.writer.write_argument(name, value, &mut self.text);
            self.text += if arguments.peek().is_none() { ");\n" } else { ",\n" };
        }
    }
}
