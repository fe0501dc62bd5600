//! What may be a name, and that no two things share one.

use super::Checker;
use crate::reserved::{is_reserved, keyword_inside};
use crate::standard::is_standard;
use crate::view::{Name, UnitKind};
use std::collections::HashSet;

/// The longest name that all compilers take.
const LONGEST: usize = 64;

impl Checker<'_> {
    pub(super) fn names(&mut self) {
        let text = self.text;
        let mut global = HashSet::new();
        let mut own = |checker: &mut Self, name: &Name| {
            checker.is_a_name(name);
            if !global.insert(name.key()) {
                checker.report("duplicate", name.span, format!("`{}` is declared twice", name.text));
            }
        };
        for unit in &text.units {
            own(self, &unit.name);
        }
        for configuration in &text.configurations {
            own(self, &configuration.name);
            configuration.globals.iter().for_each(|v| own(self, &v.name));
            for resource in &configuration.resources {
                own(self, &resource.name);
                resource.tasks.iter().for_each(|t| own(self, &t.name));
                resource.programs.iter().for_each(|p| own(self, &p.name));
            }
        }
        for unit in &text.units {
            let mut seen = HashSet::new();
            for variable in &unit.variables {
                let name = &variable.name;
                self.is_a_name(name);
                if !seen.insert(name.key()) {
                    self.report("duplicate", name.span, format!("`{}` is declared twice", name.text));
                }
                if text.units.iter().any(|u| u.name.key() == name.key()) {
                    self.report("duplicate", name.span, format!("`{}` is the name of a unit too", name.text));
                }
            }
        }
    }

    fn is_a_name(&mut self, name: &Name) {
        let text = &name.text;
        if is_reserved(text) || is_standard(text) {
            self.report("reserved", name.span, format!("`{text}` is a reserved word"));
        }
        if let Some(keyword) = keyword_inside(text) {
            self.report("keyword-inside", name.span, format!("`{text}` has `{keyword}` inside"));
        }
        if text.contains("__") || text.ends_with('_') {
            self.report("underscore", name.span, format!("`{text}` has a double or trailing underscore"));
        }
        if text.len() > LONGEST {
            self.report("long-name", name.span, format!("`{text}` has {} characters", text.len()));
        }
    }

    /// Functions, then function blocks, then programs.
    pub(super) fn order(&mut self) {
        let rank = |kind| match kind {
            UnitKind::Function => 0,
            UnitKind::Block => 1,
            UnitKind::Program => 2,
        };
        let text = self.text;
        for pair in text.units.windows(2) {
            if rank(pair[0].kind) > rank(pair[1].kind) {
                let name = &pair[1].name;
                self.report("order", name.span, format!("`{}` stands too late", name.text));
            }
        }
    }
}
