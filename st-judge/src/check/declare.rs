//! Declarations of a unit.

use super::{Checker, Scope};
use crate::finding::Finding;
use crate::types::{Scalar, Type};
use crate::view::{
    Expression, ExpressionKind, Section, StatementKind, Unit, UnitKind, Variable, each_statement,
};
use std::collections::HashMap;

impl<'t> Checker<'t> {
    pub(super) fn scope(&mut self, unit: &'t Unit) -> Scope<'t> {
        let mut variables = HashMap::new();
        if let Some(result) = &unit.result
            && let Some(ty) = self.type_of_name(result)
            && !matches!(ty, Type::Scalar(scalar) if !matches!(scalar, Scalar::Narrow(_)))
        {
            self.report("function-result", result.span, format!("a function gives no {ty}"));
        }
        if unit.kind == UnitKind::Function && !unit.variables.iter().any(|v| v.section == Section::Input) {
            self.report("function-inputs", unit.name.span, "a function without VAR_INPUT");
        }
        for variable in &unit.variables {
            self.section(unit, variable);
            let Some(ty) = self.type_of_name(&variable.ty) else { continue };
            self.initial(variable, &ty);
            if matches!(ty, Type::Block(_))
                && (variable.section != Section::Local || unit.kind == UnitKind::Function)
            {
                self.report("block-section", variable.span, "an instance of a function block stands in VAR");
            }
            if let Type::Array(..) = ty
                && matches!(variable.section, Section::Input | Section::Output | Section::InOut)
            {
                let text = "an array of a type without a name is an input or output";
                self.untried.push(Finding::new("array-passed", variable.span, text));
            }
            if let Type::Scalar(Scalar::Narrow(_)) = ty
                && variable.section != Section::External
            {
                self.report("narrow", variable.ty.span, format!("{ty} is for the process image only"));
            }
            if variable.section == Section::External {
                self.external(variable, &ty);
            }
            variables.insert(variable.name.key(), (variable.section, ty));
        }
        Scope { unit, variables }
    }

    fn section(&mut self, unit: &Unit, variable: &Variable) {
        use Section::{External, InOut, Input, Local, Output};
        let allowed: &[Section] = match unit.kind {
            UnitKind::Function => &[Input, Local],
            UnitKind::Block => &[Input, Output, InOut, Local, External],
            UnitKind::Program => &[Local, External],
        };
        if !allowed.contains(&variable.section) {
            self.report("section", variable.span, "such a section is not portable in this unit");
        }
    }

    pub(super) fn initial(&mut self, variable: &Variable, ty: &Type) {
        let Some(initial) = &variable.initial else { return };
        if matches!(variable.section, Section::External | Section::InOut) {
            self.report("initial", initial.span, "no initial value can stand here");
        }
        let Type::Scalar(scalar) = ty else {
            self.report("initial", initial.span, "only scalars have an initial value everywhere");
            return;
        };
        if let Some(found) = self.literal_type(initial)
            && found != *scalar
            && !self.narrow_initial(initial, *scalar)
        {
            self.report("type", initial.span, format!("{found} for the {scalar} `{}`", variable.name.text));
        }
    }

    /// Whether a whole number is one of a type of the process image.
    fn narrow_initial(&self, initial: &Expression, scalar: Scalar) -> bool {
        let (Scalar::Narrow(narrow), ExpressionKind::Int(text)) = (scalar, &initial.kind) else {
            return false;
        };
        let (low, high) = narrow.bounds();
        crate::literal::int(text).is_ok_and(|value| (low..=high).contains(&value))
    }

    fn literal_type(&mut self, expression: &Expression) -> Option<Scalar> {
        match &expression.kind {
            ExpressionKind::Bool(_) | ExpressionKind::Int(_) | ExpressionKind::Real(_) => {
                match self.literal(expression)? {
                    Type::Scalar(scalar) => Some(scalar),
                    _ => None,
                }
            }
            ExpressionKind::Other => None,
            _ => {
                self.report("initial", expression.span, "an initial value is a literal");
                None
            }
        }
    }

    fn external(&mut self, variable: &Variable, ty: &Type) {
        let name = &variable.name.text;
        let Some(global) = self.globals.get(&variable.name.key()).copied() else {
            self.report("external", variable.name.span, format!("there is no VAR_GLOBAL `{name}`"));
            return;
        };
        let count = self.findings.len();
        let other = self.type_of_name(&global.ty);
        // What is wrong with the global is reported at the global.
        self.findings.truncate(count);
        if let Some(other) = other
            && other != *ty
        {
            self.report(
                "external",
                variable.ty.span,
                format!("`{name}` is {ty} here and {other} as VAR_GLOBAL"),
            );
        }
    }

    pub(super) fn result_is_set(&mut self, unit: &Unit) {
        if unit.kind != UnitKind::Function {
            return;
        }
        let mut is_set = false;
        each_statement(&unit.body, &mut |statement| {
            if let StatementKind::Assign { target, .. } = &statement.kind
                && let ExpressionKind::Name(name) = &target.kind
            {
                is_set |= name.key() == unit.name.key();
            }
        });
        if !is_set {
            self.report(
                "function-result",
                unit.name.span,
                format!("`{}` never gets a value", unit.name.text),
            );
        }
    }
}
