//! The names within devices, for the table of names. A device has one space of names for its expressions, with those
//! of its assemblies behind theirs.

use super::Checker;
use super::names::Space;
use crate::spec::ast::{self, DeviceMember, Expr, ExprKind, Name};
use runtime_sim::part::Schema;

impl Checker<'_> {
    pub(super) fn uses_of_devices(&mut self) {
        for tree in self.declarations.devices.clone() {
            self.uses_of_device(&tree);
        }
    }

    fn uses_of_device(&mut self, tree: &ast::Device) {
        let owner = &tree.name.value;
        for member in &tree.members {
            match member {
                DeviceMember::Define(define) => self.in_device(tree, &define.value),
                DeviceMember::Part(part) => self.part(tree, part),
            }
        }
        for constant in &tree.constants {
            self.in_device(tree, &constant.value);
        }
        for port in &tree.ports {
            port.wire.iter().for_each(|wire| self.in_device(tree, wire));
        }
        for command in &tree.commands {
            self.in_device(tree, &command.part);
            self.of_part(tree, &command.part, &command.action);
            for name in command.arguments.iter().chain(&command.given) {
                self.uses(name.span, Space::Ports, owner, &name.value);
            }
            command.then.iter().for_each(|then| self.in_device(tree, &then.signal));
        }
        for expr in tree.handovers.iter().flat_map(ast::Place::expressions) {
            self.in_device(tree, expr);
        }
        for require in &tree.requires {
            self.in_device(tree, &require.condition);
            for part in &require.text {
                if let ast::TextPart::Value(value) = part {
                    self.in_device(tree, value);
                }
            }
        }
    }

    fn part(&mut self, tree: &ast::Device, part: &ast::Part) {
        let kind = &part.kind.value;
        let (of_kind, of_setting) = match Schema::find(kind) {
            Some(_) => (Space::Primitives, Space::Settings),
            None => (Space::Devices, Space::OfDevice),
        };
        self.uses(part.kind.span, of_kind, "", kind);
        for (name, value) in &part.settings {
            self.uses(name.span, of_setting, kind, &name.value);
            self.in_device(tree, value);
        }
    }

    fn in_device(&mut self, tree: &ast::Device, expr: &Expr) {
        match &expr.kind {
            ExprKind::Name(name) => self.uses(expr.span, Space::OfDevice, &tree.name.value, name),
            ExprKind::Member(base, member) => {
                self.in_device(tree, base);
                self.of_part(tree, base, member);
            }
            ExprKind::Index(a, b) | ExprKind::Binary(_, a, b) => {
                self.in_device(tree, a);
                self.in_device(tree, b);
            }
            ExprKind::Negate(inner) | ExprKind::Not(inner) => self.in_device(tree, inner),
            ExprKind::Call(_, all) | ExprKind::List(all) => all.iter().for_each(|e| self.in_device(tree, e)),
            _ => {}
        }
    }

    /// The names after the dot of a part: of an assembly its names, of a primitive its signals, levels and actions.
    fn of_part(&mut self, tree: &ast::Device, base: &Expr, member: &Name) {
        let Some(kind) = self.kind_of(tree, base) else { return };
        let space = if Schema::find(&kind).is_some() { Space::Wires } else { Space::OfDevice };
        self.uses(member.span, space, &kind, &member.value);
    }

    /// Of which primitive or assembly a part is.
    fn kind_of(&self, tree: &ast::Device, expr: &Expr) -> Option<String> {
        let part_of = |tree: &ast::Device, name: &str| {
            tree.members.iter().find_map(|member| match member {
                DeviceMember::Part(part) if part.name.value == name => Some(part.kind.value.clone()),
                _ => None,
            })
        };
        match &expr.kind {
            ExprKind::Name(name) => part_of(tree, name),
            ExprKind::Member(base, member) => {
                let kind = self.kind_of(tree, base)?;
                let assembly = self.declarations.devices.iter().find(|device| device.name.value == kind)?;
                part_of(assembly, &member.value)
            }
            _ => None,
        }
    }
}
