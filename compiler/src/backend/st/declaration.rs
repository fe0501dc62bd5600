//! Variables, and the units that declare them.

use super::attributes::{Attribute, OF_WHAT_IS_SHOWN};
use super::body::Body;
use super::code::Ex;
use super::externals::Externals;
use super::name::Name;
use super::print::{Dialect, comment, harmless};
use crate::io_map::Raw;
use crate::ir::{Scalar, Value};
use std::fmt::{self, Formatter, Write};
use std::sync::Arc;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Basic {
    Bool,
    Dint,
    Lreal,
    /// Of raw values in the process image only.
    Sint,
    Usint,
    Int,
    Uint,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    pub name: Name,
    pub basic: Basic,
    /// In the process image, such as `%IX0.3`.
    pub address: Option<String>,
    /// Number of elements of an array.
    pub elements: Option<usize>,
    /// So many of them are a row, where arrays have two dimensions.
    pub each: Option<usize>,
    /// The type of its elements, where there are structures.
    pub structure: Option<String>,
    /// The type of its elements, where there are enumerations.
    pub enumeration: Option<String>,
    /// Of a scalar; every other value is set by code.
    pub initial: Option<Box<Ex>>,
    /// The first line stands behind the declaration, the others below it.
    pub comments: Vec<Arc<str>>,
    /// It outlasts a loss of power.
    pub is_retained: bool,
}

/// An instance of a function block.
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    pub name: Name,
    pub block: Name,
    pub comment: String,
    /// Its block has variables that outlast a loss of power.
    pub is_retained: bool,
}

/// A function block or the program.
#[derive(Clone, Default)]
pub struct Unit<'a> {
    pub name: String,
    pub comments: Vec<String>,
    pub inputs: Vec<Variable>,
    pub outputs: Vec<Variable>,
    /// Given by reference.
    pub references: Vec<Variable>,
    pub externals: Externals,
    pub variables: Vec<Variable>,
    pub instances: Vec<Instance>,
    pub body: Body<'a>,
}

impl Basic {
    pub fn of(scalar: Scalar) -> Self {
        match scalar {
            Scalar::Bool => Basic::Bool,
            Scalar::Real | Scalar::Point => Basic::Lreal,
            Scalar::Int { .. } | Scalar::Time | Scalar::Enum(_) | Scalar::Ref(_) => Basic::Dint,
        }
    }

    pub fn name(self) -> &'static str {
        match self {
            Basic::Bool => "BOOL",
            Basic::Dint => "DINT",
            Basic::Lreal => "LREAL",
            Basic::Sint => "SINT",
            Basic::Usint => "USINT",
            Basic::Int => "INT",
            Basic::Uint => "UINT",
        }
    }

    pub fn zero(self) -> Ex {
        match self {
            Basic::Bool => Ex::Bool(false),
            Basic::Dint | Basic::Sint | Basic::Usint | Basic::Int | Basic::Uint => Ex::Int(0),
            Basic::Lreal => Ex::Real(0.0),
        }
    }
}

impl From<Raw> for Basic {
    fn from(raw: Raw) -> Self {
        match raw {
            Raw::Bool => Basic::Bool,
            Raw::Sint => Basic::Sint,
            Raw::Usint => Basic::Usint,
            Raw::Int => Basic::Int,
            Raw::Uint => Basic::Uint,
            Raw::Dint => Basic::Dint,
        }
    }
}

impl Variable {
    pub fn new(name: impl Into<Name>, basic: Basic) -> Self {
        Self {
            name: name.into(),
            basic,
            address: None,
            elements: None,
            each: None,
            structure: None,
            enumeration: None,
            initial: None,
            comments: Vec::new(),
            is_retained: false,
        }
    }

    pub fn with_address(mut self, address: String) -> Self {
        self.address = Some(address);
        self
    }

    pub fn with_comment(mut self, text: impl Into<Arc<str>>) -> Self {
        let text = text.into();
        if !text.is_empty() {
            self.comments.push(text);
        }
        self
    }

    pub fn with_initial(mut self, value: Ex) -> Self {
        self.initial = Some(Box::new(value));
        self
    }

    pub fn retained(mut self, is_retained: bool) -> Self {
        self.is_retained = is_retained;
        self
    }

    pub fn with_elements(mut self, elements: Option<usize>) -> Self {
        self.elements = elements;
        self
    }

    /// The numbers of the last element of an array, for each of its dimensions.
    pub fn last(&self, dialect: Dialect) -> Vec<usize> {
        match (dialect, self.elements, self.each) {
            (_, None, _) => Vec::new(),
            // A second element that nothing uses stands behind a single one: IronPLC takes no array of one element.
            (Dialect::Portable, Some(n), _) => vec![n.max(2) - 1],
            (_, Some(n), None) => vec![n.max(1) - 1],
            (_, Some(n), Some(each)) => vec![(n / each.max(1)).max(1) - 1, each.max(1) - 1],
        }
    }

    /// The type of a single element.
    pub fn single(&self) -> &str {
        self.structure.as_deref().or(self.enumeration.as_deref()).unwrap_or(self.basic.name())
    }

    fn write_type(&self, dialect: Dialect, to: &mut impl Write) -> fmt::Result {
        for (i, last) in self.last(dialect).iter().enumerate() {
            write!(to, "{}0..{last}", if i == 0 { "ARRAY[" } else { ", " })?;
        }
        if self.elements.is_some() {
            to.write_str("] OF ")?;
        }
        match (dialect, &self.structure) {
            (Dialect::Siemens, Some(name)) => write!(to, "\"{name}\""),
            _ => to.write_str(self.single()),
        }
    }

    /// The same variable without initial value, as it is declared where it is used.
    pub fn external(&self) -> Self {
        let comments = self.comments.iter().take(1).cloned().collect();
        Self { address: None, comments, is_retained: false, ..self.without_value() }
    }

    pub fn uncommented(&self) -> Self {
        Self { address: None, comments: Vec::new(), is_retained: false, ..self.without_value() }
    }

    /// Without its initial value, which is long in a table.
    pub fn without_value(&self) -> Self {
        Self {
            name: self.name.clone(),
            basic: self.basic,
            address: self.address.clone(),
            elements: self.elements,
            each: self.each,
            structure: self.structure.clone(),
            enumeration: self.enumeration.clone(),
            initial: None,
            comments: self.comments.clone(),
            is_retained: self.is_retained,
        }
    }

    /// The declaration, with its comments.
    pub fn line(&self, dialect: Dialect, to: &mut impl Write) -> fmt::Result {
        to.write_str("    ")?;
        to.write_str(&self.name)?;
        if let Some(at) = &self.address {
            write!(to, " AT {at}")?;
        }
        to.write_str(" : ")?;
        self.write_type(dialect, to)?;
        if let Some(initial) = &self.initial {
            to.write_str(" := ")?;
            dialect.initial(initial, to)?;
        }
        to.write_char(';')?;
        for (i, line) in self.comments.iter().enumerate() {
            to.write_str(if i == 0 { " (* " } else { "\n        (* " })?;
            to.write_str(&harmless(line))?;
            to.write_str(" *)")?;
        }
        to.write_char('\n')
    }
}

impl Unit<'_> {
    /// Without its body and its externals.
    pub fn without_body<'b>(&self) -> Unit<'b> {
        Unit {
            name: self.name.clone(),
            comments: self.comments.clone(),
            inputs: self.inputs.clone(),
            outputs: self.outputs.clone(),
            references: self.references.clone(),
            externals: Externals::default(),
            variables: self.variables.clone(),
            instances: self.instances.clone(),
            body: Body::default(),
        }
    }

    pub fn attributes(&self, dialect: Dialect) -> &'static [Attribute] {
        match (dialect, self.name == "MAIN") {
            (Dialect::Codesys, true) => OF_WHAT_IS_SHOWN,
            _ => &[],
        }
    }

    /// All sections of declarations.
    pub fn declarations(&self, dialect: Dialect, to: &mut Formatter) -> fmt::Result {
        let line = |v: &Variable, f: &mut Formatter| v.line(dialect, f);
        let instance =
            |i: &Instance, f: &mut Formatter| writeln!(f, "    {} : {};{}", i.name, i.block, i.about());
        let instances = |is_retained: bool| {
            self.instances.iter().filter(move |i| i.is_retained_in(dialect) == is_retained)
        };
        sections("VAR_INPUT", &self.inputs, line, to)?;
        sections("VAR_OUTPUT", &self.outputs(dialect), line, to)?;
        sections("VAR_IN_OUT", &self.references, line, to)?;
        if dialect == Dialect::Portable {
            block("VAR_EXTERNAL", self.externals.iter(), |v, f| v.line(dialect, f), to)?;
        }
        sections("VAR", &self.variables, line, to)?;
        block("VAR", instances(false), instance, to)?;
        block("VAR RETAIN", instances(true), instance, to)
    }

    /// STruC++ takes no outputs that are retained: in the portable text the whole instance is.
    pub fn outputs(&self, dialect: Dialect) -> Vec<Variable> {
        let is_retained = |v: &Variable| v.is_retained && dialect != Dialect::Portable;
        self.outputs.iter().map(|v| v.clone().retained(is_retained(v))).collect()
    }
}

impl Instance {
    /// What stands behind its declaration.
    pub fn about(&self) -> String {
        if self.comment.is_empty() { String::new() } else { format!(" {}", comment(&self.comment)) }
    }

    /// Whether this is said where it is declared, or its block says what is.
    pub fn is_retained_in(&self, dialect: Dialect) -> bool {
        self.is_retained && dialect == Dialect::Portable
    }
}

/// A section, if there is something in it.
pub fn block<T>(
    keyword: &str,
    all: impl Iterator<Item = T>,
    line: impl Fn(T, &mut Formatter) -> fmt::Result,
    to: &mut Formatter,
) -> fmt::Result {
    let mut all = all.peekable();
    if all.peek().is_none() {
        return Ok(());
    }
    writeln!(to, "{keyword}")?;
    all.try_for_each(|each| line(each, to))?;
    to.write_str("END_VAR\n")
}

/// Those that are retained in a section of their own.
pub fn sections<'a>(
    keyword: &str,
    variables: impl IntoIterator<Item = &'a Variable> + Clone,
    line: impl Fn(&Variable, &mut Formatter) -> fmt::Result,
    to: &mut Formatter,
) -> fmt::Result {
    for (is_retained, keyword) in [(false, keyword.to_string()), (true, format!("{keyword} RETAIN"))] {
        let some = variables.clone().into_iter().filter(|v| v.is_retained == is_retained);
        block(&keyword, some, &line, to)?;
    }
    Ok(())
}

/// Declarations of globals.
pub fn globals(variables: &[&Variable], dialect: Dialect, to: &mut Formatter) -> fmt::Result {
    let line = |v: &Variable, f: &mut Formatter| v.line(dialect, f);
    let mut lists = lists_of_globals(variables, dialect).into_iter();
    lists.try_for_each(|list| sections("VAR_GLOBAL", list, line, to))
}

/// The globals as they are declared together. matiec retains the first variable of a list only, so in the portable
/// text each has its own.
pub fn lists_of_globals<'a>(variables: &[&'a Variable], dialect: Dialect) -> Vec<Vec<&'a Variable>> {
    if dialect != Dialect::Portable {
        return vec![variables.to_vec()];
    }
    let (retained, others): (Vec<_>, Vec<_>) = variables.iter().partition(|v| v.is_retained);
    [others].into_iter().chain(retained.into_iter().map(|variable| vec![variable])).collect()
}

/// The suffixes of the variables that hold one value.
pub fn suffixes(scalar: Scalar) -> &'static [&'static str] {
    if scalar == Scalar::Point { &["_x", "_y", "_z"] } else { &[""] }
}

/// A value as the constants of its variables; members are shown by name.
pub fn constants(value: Value) -> Vec<Ex> {
    match value {
        Value::Bool(b) => vec![Ex::Bool(b)],
        Value::Int(i) => vec![Ex::Int(i)],
        Value::Real(r) => vec![Ex::Real(r)],
        Value::Point(p) => p.map(Ex::Real).into(),
    }
}
