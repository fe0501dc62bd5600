//! CONFIGURATION: one, with tasks and programs that there are.

use super::Checker;
use crate::literal;
use crate::types::Type;
use crate::view::{Configuration, ExpressionKind, Resource, Task, UnitKind};

impl Checker<'_> {
    pub(super) fn configurations(&mut self) {
        let text = self.text;
        match text.configurations.as_slice() {
            [one] => self.configuration(one),
            [] => {
                let end = text.units.last().map_or(0, |u| u.span.end);
                let span = crate::finding::Span { start: end, end };
                self.report("configuration", span, "there is no CONFIGURATION");
            }
            [_, second, ..] => self.report("configuration", second.span, "a second CONFIGURATION"),
        }
    }

    fn configuration(&mut self, configuration: &Configuration) {
        self.addresses(&configuration.globals);
        for variable in &configuration.globals {
            let Some(ty) = self.type_of_name(&variable.ty) else { continue };
            if let Type::Block(_) = ty {
                self.report("block-section", variable.span, "an instance of a function block stands in VAR");
            }
            self.initial(variable, &ty);
            self.located(variable, &ty);
        }
        let programs: usize = configuration.resources.iter().map(|r| r.programs.len()).sum();
        if programs == 0 {
            self.report("configuration", configuration.span, "no program is run");
        }
        configuration.resources.iter().for_each(|resource| self.resource(resource));
    }

    fn resource(&mut self, resource: &Resource) {
        resource.tasks.iter().for_each(|task| self.task(task));
        for assignment in &resource.programs {
            let program = &assignment.program;
            match self.units.get(&program.key()) {
                Some(unit) if unit.kind == UnitKind::Program => {}
                _ => self.report(
                    "unknown-program",
                    program.span,
                    format!("there is no PROGRAM `{}`", program.text),
                ),
            }
            match &assignment.task {
                None => self.report("unknown-task", assignment.span, "a program without a task"),
                Some(task) if !resource.tasks.iter().any(|t| t.name.key() == task.key()) => {
                    self.report("unknown-task", task.span, format!("there is no TASK `{}`", task.text));
                }
                Some(_) => {}
            }
        }
    }

    fn task(&mut self, task: &Task) {
        let mut has_interval = false;
        for (name, value) in &task.settings {
            let wrong = match (name.key().as_str(), &value.kind) {
                ("interval", ExpressionKind::Time(text)) => {
                    has_interval = true;
                    literal::time(text).err()
                }
                ("priority", ExpressionKind::Int(text)) => literal::int(text).err(),
                _ => Some("a task has INTERVAL, a time, and PRIORITY, a whole number"),
            };
            if let Some(wrong) = wrong {
                self.report("task", value.span, wrong);
            }
        }
        if !has_interval {
            self.report("task", task.span, "a task without INTERVAL");
        }
    }
}
