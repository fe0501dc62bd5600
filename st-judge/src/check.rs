//! The rules of the portable core: names, types, and what the compilers do not all take.

mod call;
mod configuration;
mod declare;
mod expression;
mod located;
mod name;
mod precedence;
mod statement;

use crate::finding::{Finding, Span};
use crate::types::Type;
use crate::view::{Configuration, Expression, Section, Text, TypeKind, TypeName, Unit, UnitKind, Variable};
use std::collections::HashMap;

/// A text that keeps the rules.
#[derive(Clone, Debug)]
pub struct Checked {
    pub text: Text,
    /// The type of each expression, by its place.
    pub types: HashMap<Span, Type>,
    /// What no rule forbids but has not been tried on every compiler.
    pub untried: Vec<Finding>,
}

/// The types of all expressions, or the findings.
pub fn check(text: Text, mut findings: Vec<Finding>) -> Result<Checked, Vec<Finding>> {
    let mut checker = Checker::new(&text);
    checker.run();
    findings.append(&mut checker.findings);
    let (types, untried) = (checker.types, checker.untried);
    if findings.is_empty() {
        return Ok(Checked { text, types, untried });
    }
    findings.sort_by_key(|f| f.span);
    Err(findings)
}

struct Checker<'t> {
    text: &'t Text,
    /// Units declared so far, by key.
    units: HashMap<String, &'t Unit>,
    globals: HashMap<String, &'t Variable>,
    findings: Vec<Finding>,
    untried: Vec<Finding>,
    types: HashMap<Span, Type>,
}

/// What names mean within a unit.
struct Scope<'t> {
    unit: &'t Unit,
    variables: HashMap<String, (Section, Type)>,
}

impl<'t> Checker<'t> {
    fn new(text: &'t Text) -> Self {
        let globals = text.configurations.iter().flat_map(|c: &Configuration| &c.globals);
        Self {
            text,
            units: HashMap::new(),
            globals: globals.map(|v| (v.name.key(), v)).collect(),
            findings: Vec::new(),
            untried: Vec::new(),
            types: HashMap::new(),
        }
    }

    fn run(&mut self) {
        self.names();
        self.order();
        for unit in &self.text.units {
            let scope = self.scope(unit);
            self.body(&scope, &unit.body, unit.span, statement::Loop::Outside);
            self.result_is_set(unit);
            self.units.entry(unit.name.key()).or_insert(unit);
        }
        self.configurations();
    }

    fn report(&mut self, code: &'static str, span: Span, text: impl Into<String>) {
        self.findings.push(Finding::new(code, span, text));
    }

    /// The type, if it is one of the core and, if a function block, declared above.
    fn type_of_name(&mut self, name: &TypeName) -> Option<Type> {
        match &name.kind {
            TypeKind::Named(word) => {
                if let Some(scalar) = crate::types::Scalar::named(word) {
                    return Some(Type::Scalar(scalar));
                }
                match self.units.get(&word.to_ascii_lowercase()) {
                    Some(unit) if unit.kind == UnitKind::Block => {
                        Some(Type::Block(word.to_ascii_lowercase()))
                    }
                    _ => {
                        self.report(
                            "unknown-type",
                            name.span,
                            format!("`{word}` is no type that is known here"),
                        );
                        None
                    }
                }
            }
            TypeKind::Array { lower, upper, element } => self.array_type(lower, upper, element),
            TypeKind::Other => None,
        }
    }

    fn array_type(&mut self, lower: &Expression, upper: &Expression, element: &TypeName) -> Option<Type> {
        let bound = |expression: &Expression| match &expression.kind {
            crate::view::ExpressionKind::Int(text) => crate::literal::int(text).ok(),
            _ => None,
        };
        let (Some(0), Some(upper_value @ 1..)) = (bound(lower), bound(upper)) else {
            self.report("array-bounds", lower.span, "an array goes from the literal 0 to a greater one");
            return None;
        };
        match self.type_of_name(element)? {
            Type::Scalar(scalar) if !matches!(scalar, crate::types::Scalar::Narrow(_)) => {
                Some(Type::Array(scalar, upper_value as usize))
            }
            other => {
                self.report("array-element", element.span, format!("an array of {other}"));
                None
            }
        }
    }
}
