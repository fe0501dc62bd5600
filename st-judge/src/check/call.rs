//! Calls: of functions in expressions, of instances of function blocks as statements.

use super::{Checker, Scope};
use crate::finding::Span;
use crate::standard;
use crate::types::Type;
use crate::view::{Call, Expression, ExpressionKind, Section, Unit, UnitKind, Variable, each_part};
use std::collections::HashSet;

/// Whether an expression calls a function with the names of its inputs.
fn has_named_call(expression: &Expression) -> bool {
    let mut found = false;
    each_part(expression, &mut |part| {
        if let ExpressionKind::Call(call) = &part.kind {
            found |= call.arguments.iter().any(|argument| argument.name.is_some());
        }
    });
    found
}

impl Checker<'_> {
    pub(super) fn function(&mut self, scope: &Scope, call: &Call) -> Option<Type> {
        let name = &call.name;
        if standard::is_standard(&name.text) {
            return self.standard(scope, call);
        }
        match self.units.get(&name.key()).copied() {
            Some(unit) if unit.kind == UnitKind::Function => {
                self.arguments(scope, call, unit);
                unit.result.as_ref().and_then(|ty| self.type_of_name(ty))
            }
            _ => {
                self.report(
                    "unknown-function",
                    name.span,
                    format!("there is no function `{}` above", name.text),
                );
                call.arguments.iter().for_each(|a| {
                    self.expression(scope, &a.value);
                });
                None
            }
        }
    }

    fn standard(&mut self, scope: &Scope, call: &Call) -> Option<Type> {
        let name = &call.name;
        let mut types = Vec::new();
        for argument in &call.arguments {
            if argument.name.is_some() {
                self.report(
                    "argument",
                    argument.span,
                    "arguments of standard functions are given by position",
                );
            }
            if has_named_call(&argument.value) {
                let text = "a call with names inside of one without: not every compiler takes it";
                self.report("argument", argument.span, text);
            }
            types.push(self.expression(scope, &argument.value));
        }
        let types: Vec<Type> = types.into_iter().collect::<Option<_>>()?;
        let result = standard::result(&name.text, &types);
        if result.is_none() {
            let list: Vec<String> = types.iter().map(Type::to_string).collect();
            self.report(
                "argument",
                name.span,
                format!("`{}` does not take ({})", name.text, list.join(", ")),
            );
        }
        result
    }

    /// A call as a statement.
    pub(super) fn block_call(&mut self, scope: &Scope, call: &Call) {
        let name = &call.name;
        let block = match scope.variables.get(&name.key()) {
            Some((_, Type::Block(block))) => block,
            _ => {
                self.report("call", name.span, format!("`{}` is no instance of a function block", name.text));
                return;
            }
        };
        if let Some(unit) = self.units.get(block).copied() {
            self.arguments(scope, call, unit);
        }
    }

    fn arguments(&mut self, scope: &Scope, call: &Call, unit: &Unit) {
        let mut given = HashSet::new();
        for argument in &call.arguments {
            let Some(name) = &argument.name else {
                self.report("argument", argument.span, "an argument without its name");
                self.expression(scope, &argument.value);
                continue;
            };
            if !given.insert(name.key()) {
                self.report("argument", name.span, format!("`{}` is given twice", name.text));
            }
            let found = self.expression(scope, &argument.value);
            let inputs = |v: &&Variable| matches!(v.section, Section::Input | Section::InOut);
            match unit.variables.iter().filter(inputs).find(|v| v.name.key() == name.key()) {
                None => {
                    let text = format!("`{}` has no input `{}`", unit.name.text, name.text);
                    self.report("argument", name.span, text);
                }
                Some(input) => {
                    self.argument_type(input, found, argument.value.span);
                    if input.section == Section::InOut {
                        self.assignable(scope, &argument.value);
                        if !matches!(argument.value.kind, ExpressionKind::Name(_)) {
                            self.report("argument", argument.value.span, "VAR_IN_OUT wants a variable");
                        }
                    }
                }
            }
        }
        for variable in &unit.variables {
            if matches!(variable.section, Section::Input | Section::InOut)
                && !given.contains(&variable.name.key())
            {
                let text = format!("the input `{}` of `{}` is not given", variable.name.text, unit.name.text);
                self.report("argument", call.name.span, text);
            }
        }
    }

    fn argument_type(&mut self, input: &Variable, found: Option<Type>, span: Span) {
        let Some(found) = found else { return };
        let count = self.findings.len();
        let wanted = self.type_of_name(&input.ty);
        // What is wrong with the declaration is reported there.
        self.findings.truncate(count);
        if let Some(wanted) = wanted
            && wanted != found
        {
            self.report(
                "type",
                span,
                format!("{found} for the input `{}`, which is {wanted}", input.name.text),
            );
        }
    }
}
