//! Checked text to the internal form.

mod expression;
mod statement;

use super::code::{Code, Slot};
use super::layout::{Base, Frame, Layouts, Spot};
use crate::check::Checked;
use crate::literal;
use crate::view::{ExpressionKind, Name, Unit};
use std::collections::HashMap;

pub(super) fn compile(checked: &Checked, layouts: &Layouts) -> Code {
    let mut compiler = Compiler { checked, layouts, numbers: HashMap::new(), code: Code::default() };
    for (number, unit) in checked.text.units.iter().enumerate() {
        let body = compiler.body(&Scope { unit, frame: layouts.unit(&unit.name.key()) }, &unit.body);
        compiler.code.units.push(body);
        compiler.numbers.insert(unit.name.key(), number);
    }
    for resource in checked.text.configurations.iter().flat_map(|c| &c.resources) {
        for assignment in &resource.programs {
            let key = assignment.program.key();
            compiler.code.programs.push((compiler.numbers[&key], layouts.base(&key)));
        }
        for (_, value) in resource.tasks.iter().flat_map(|t| &t.settings) {
            if let ExpressionKind::Time(text) = &value.kind {
                compiler.code.interval_ms = compiler.code.interval_ms.or(literal::time(text).ok());
            }
        }
    }
    compiler.code
}

struct Compiler<'c> {
    checked: &'c Checked,
    layouts: &'c Layouts,
    /// Numbers of the units compiled so far.
    numbers: HashMap<String, usize>,
    code: Code,
}

struct Scope<'c> {
    unit: &'c Unit,
    frame: &'c Frame,
}

impl<'c> Scope<'c> {
    fn spot(&self, name: &Name) -> &'c Spot {
        &self.frame.variables[&name.key()]
    }
}

impl Spot {
    fn slot(&self) -> Slot {
        match self.base {
            Base::Frame => Slot::Frame(self.offset),
            Base::Global => Slot::Memory(self.offset),
        }
    }
}
