//! What stands where in a text that has no faults.

use super::Mutation;
use crate::check::Checked;
use crate::finding::Span;
use crate::types::{Scalar, Type};
use crate::view::{
    Argument, Call, Expression, ExpressionKind, Section, Statement, StatementKind, Unit, UnitKind, Variable,
    bodies, each_part, expressions,
};

pub(super) struct Survey<'a> {
    pub(super) source: &'a str,
    pub(super) checked: &'a Checked,
    pub(super) statements: Vec<Spot<'a>>,
    /// Parts of expressions that are read, outer ones first.
    pub(super) parts: Vec<Part<'a>>,
}

pub(super) struct Spot<'a> {
    pub(super) unit: &'a Unit,
    pub(super) statement: &'a Statement,
    pub(super) around: Around,
    pub(super) in_loop: bool,
}

/// The list in which a statement stands.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Around {
    Unit,
    Loop,
    Else,
    Branch,
}

pub(super) struct Part<'a> {
    pub(super) unit: &'a Unit,
    pub(super) expression: &'a Expression,
    /// It is not part of another expression.
    pub(super) is_whole: bool,
}

impl<'a> Survey<'a> {
    pub(super) fn new(source: &'a str, checked: &'a Checked) -> Self {
        let mut survey = Self { source, checked, statements: vec![], parts: vec![] };
        for unit in &checked.text.units {
            survey.list(unit, &unit.body, Around::Unit, false);
        }
        survey
    }

    fn list(&mut self, unit: &'a Unit, body: &'a [Statement], around: Around, in_loop: bool) {
        for statement in body {
            self.statements.push(Spot { unit, statement, around, in_loop });
            for (i, expression) in expressions(statement).into_iter().enumerate() {
                let is_target = i == 0 && matches!(statement.kind, StatementKind::Assign { .. });
                let parts = &mut self.parts;
                each_part(expression, &mut |part| {
                    let is_whole = std::ptr::eq(part, expression);
                    if !is_target || !is_whole {
                        parts.push(Part { unit, expression: part, is_whole });
                    }
                });
            }
            let ends_with_else = match &statement.kind {
                StatementKind::If { otherwise, .. } | StatementKind::Case { otherwise, .. } => {
                    otherwise.is_some()
                }
                _ => false,
            };
            let lists = bodies(statement);
            for (i, list) in lists.iter().enumerate() {
                let is_loop = matches!(statement.kind, StatementKind::While { .. });
                let around = if is_loop {
                    Around::Loop
                } else if ends_with_else && i + 1 == lists.len() {
                    Around::Else
                } else {
                    Around::Branch
                };
                self.list(unit, list, around, in_loop || is_loop);
            }
        }
    }

    pub(super) fn text(&self, span: Span) -> &'a str {
        &self.source[span.start..span.end]
    }

    pub(super) fn type_of(&self, expression: &Expression) -> Option<&Type> {
        self.checked.types.get(&expression.span)
    }

    pub(super) fn scalar_of(&self, expression: &Expression) -> Option<Scalar> {
        match self.type_of(expression) {
            Some(Type::Scalar(scalar)) => Some(*scalar),
            _ => None,
        }
    }

    /// Ways to write a value of the type in the unit: literals, and some of its variables.
    pub(super) fn values(&self, unit: &Unit, ty: Scalar) -> Vec<String> {
        let other = match ty {
            Scalar::Bool => "FALSE",
            Scalar::Dint | Scalar::Narrow(_) => "-2",
            Scalar::Lreal => "0.0",
        };
        let variables = unit.variables.iter().filter(|v| self.scalar_type(v) == Some(ty)).take(2);
        [literal(ty), other]
            .map(String::from)
            .into_iter()
            .chain(variables.map(|v| v.name.text.clone()))
            .collect()
    }

    pub(super) fn scalar_type(&self, variable: &Variable) -> Option<Scalar> {
        match &variable.ty.kind {
            crate::view::TypeKind::Named(word) => Scalar::named(word),
            _ => None,
        }
    }

    pub(super) fn block(&self, name: &str) -> Option<&'a Unit> {
        let units = &self.checked.text.units;
        units.iter().find(|u| u.kind == UnitKind::Block && u.name.text.eq_ignore_ascii_case(name))
    }

    /// The function block of which a variable of the unit is an instance.
    pub(super) fn block_of(&self, unit: &Unit, instance: &str) -> Option<&'a Unit> {
        let variable = unit.variables.iter().find(|v| v.name.text.eq_ignore_ascii_case(instance))?;
        match &variable.ty.kind {
            crate::view::TypeKind::Named(word) => self.block(word),
            _ => None,
        }
    }

    /// Calls of function blocks with the unit in which they stand.
    pub(super) fn block_calls(&self) -> Vec<(&'a Unit, &'a Call)> {
        let calls = self.statements.iter().filter_map(|spot| match &spot.statement.kind {
            StatementKind::Call(call) => Some((spot.unit, call)),
            _ => None,
        });
        calls.collect()
    }

    /// Calls of functions.
    pub(super) fn function_calls(&self) -> Vec<&'a Call> {
        let calls = self.parts.iter().filter_map(|part| match &part.expression.kind {
            ExpressionKind::Call(call) => Some(call),
            _ => None,
        });
        calls.collect()
    }

    /// All places at which a local variable stands, its declaration too.
    pub(super) fn renamed(&self, unit: &'a Unit, variable: &'a Variable, to: &str) -> Mutation {
        let mut spans = vec![variable.name.span];
        let key = variable.name.key();
        for spot in self.statements.iter().filter(|spot| std::ptr::eq(spot.unit, unit)) {
            if let StatementKind::Call(call) = &spot.statement.kind
                && call.name.key() == key
            {
                spans.push(call.name.span);
            }
            for expression in expressions(spot.statement) {
                each_part(expression, &mut |part| match &part.kind {
                    ExpressionKind::Name(name) if name.key() == key => spans.push(name.span),
                    _ => {}
                });
            }
        }
        spans.sort();
        spans.dedup();
        spans.into_iter().map(|span| (span, to.to_string())).collect()
    }

    pub(super) fn locals(&self) -> Vec<(&'a Unit, &'a Variable)> {
        let units = self.checked.text.units.iter();
        let all = units.flat_map(|unit| unit.variables.iter().map(move |variable| (unit, variable)));
        all.filter(|(_, v)| v.section == Section::Local).collect()
    }

    pub(super) fn externals(&self) -> Vec<&'a Variable> {
        let variables = self.checked.text.units.iter().flat_map(|u| &u.variables);
        variables.filter(|v| v.section == Section::External).collect()
    }

    /// Bytes that stand in no comment.
    pub(super) fn code(&self) -> Vec<(usize, char)> {
        let mut bytes = Vec::new();
        let mut rest = 0;
        while rest < self.source.len() {
            let end = self.source[rest..].find("(*").map_or(self.source.len(), |i| rest + i);
            bytes.extend(self.source[rest..end].char_indices().map(|(i, c)| (rest + i, c)));
            rest = self.source[end..].find("*)").map_or(self.source.len(), |i| end + i + 2);
        }
        bytes
    }
}

pub(super) fn literal(ty: Scalar) -> &'static str {
    match ty {
        Scalar::Bool => "TRUE",
        Scalar::Dint | Scalar::Narrow(_) => "1",
        Scalar::Lreal => "1.5",
    }
}

/// The two other types.
pub(super) fn others(ty: Scalar) -> [Scalar; 2] {
    match ty {
        Scalar::Bool => [Scalar::Dint, Scalar::Lreal],
        Scalar::Dint | Scalar::Narrow(_) => [Scalar::Lreal, Scalar::Bool],
        Scalar::Lreal => [Scalar::Bool, Scalar::Dint],
    }
}

pub(super) fn one(span: Span, text: impl Into<String>) -> Mutation {
    vec![(span, text.into())]
}

pub(super) fn before(span: Span, text: impl Into<String>) -> Mutation {
    vec![(Span { start: span.start, end: span.start }, text.into())]
}

pub(super) fn after(span: Span, text: impl Into<String>) -> Mutation {
    vec![(Span { start: span.end, end: span.end }, text.into())]
}

/// Takes an argument out of a list, with a comma.
pub(super) fn without(arguments: &[Argument], i: usize) -> Mutation {
    let (start, end) = match (i.checked_sub(1).map(|before| arguments[before].span.end), arguments.get(i + 1))
    {
        (Some(start), _) => (start, arguments[i].span.end),
        (None, Some(next)) => (arguments[i].span.start, next.span.start),
        (None, None) => (arguments[i].span.start, arguments[i].span.end),
    };
    one(Span { start, end }, "")
}
