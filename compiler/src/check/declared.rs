//! The declarations of the files, for the table of names.

use super::Checker;
use super::names::{Declaration, What};
use crate::device::{Device, type_text};
use crate::source::{Sources, Span};
use crate::spec::ast::{self, DeviceMember, Name};
use crate::spec::written;
use runtime_sim::device::Extent;
use runtime_sim::part::ALL;
use std::sync::Arc;

impl Checker<'_> {
    pub(super) fn declared(&mut self) {
        let trees = self.declarations.clone();
        self.kinds();
        self.primitives();
        for tree in &trees.enums {
            self.declared_name(What::Enumeration, "", &tree.name, "", &tree.doc);
            for member in &tree.members {
                self.declared_name(What::Member, &tree.name.value, member, "", &[]);
            }
        }
        for tree in &trees.interfaces {
            self.declared_name(What::Interface, "", &tree.name, "", &tree.doc);
            self.declared_variables(&tree.name.value, &tree.parameters, &tree.cells);
        }
        for tree in &trees.automata {
            self.declared_automaton(tree);
        }
        for tree in &trees.devices {
            self.declared_device(tree);
        }
        for (_, device) in self.devices.clone() {
            device.into_iter().for_each(|device| self.built_in_ports(&device));
        }
    }

    fn declared_name(&mut self, what: What, owner: &str, name: &Name, ty: &str, doc: &[String]) {
        self.enter(Declaration {
            what,
            name: name.value.clone(),
            owner: owner.into(),
            place: Some(name.span),
            ty: ty.into(),
            doc: doc.to_vec(),
        });
    }

    fn built_in(&mut self, what: What, owner: &str, name: &str, ty: String, doc: Vec<String>) {
        let (owner, name) = (owner.to_string(), name.to_string());
        self.enter(Declaration { what, name, owner, place: None, ty, doc });
    }

    fn enter(&mut self, declaration: Declaration) {
        if let Some(names) = &mut self.names {
            names.declare(declaration);
        }
    }

    fn kinds(&mut self) {
        let kind = self.model.enums[0].clone();
        self.built_in(What::Enumeration, "", &kind.name, String::new(), kind.doc);
        for member in &kind.members {
            let doc = vec!["A kind of part, from the scenario.".into()];
            self.built_in(What::Member, &kind.name, member, String::new(), doc);
        }
    }

    fn primitives(&mut self) {
        for schema in ALL {
            self.built_in(What::Primitive, "", schema.name, String::new(), vec![schema.purpose.into()]);
            for setting in schema.settings {
                let doc = vec![setting.meaning.to_string()];
                self.built_in(What::Setting, schema.name, setting.name, setting.unit.into(), doc);
            }
            for signal in schema.signals {
                let ty = type_text(signal.ty, signal.extent);
                self.built_in(What::Wire, schema.name, signal.name, format!(": {ty}"), Vec::new());
            }
            for level in schema.levels {
                let ty = type_text(level.ty, Extent::One);
                self.built_in(What::Wire, schema.name, level.name, format!(": {ty}"), Vec::new());
            }
            for action in schema.actions {
                let types: Vec<String> =
                    action.arguments.iter().map(|ty| type_text(*ty, Extent::One)).collect();
                let ty = format!("({})", types.join(", "));
                self.built_in(What::Wire, schema.name, action.name, ty, Vec::new());
            }
        }
    }

    /// Those that are in no text; of the others the declaration is there already, and stays.
    fn built_in_ports(&mut self, device: &Arc<Device>) {
        for port in &device.ports {
            let ty = type_text(port.ty, port.extent);
            self.built_in(What::Port, &device.name, &port.name, ty, vec![port.meaning.clone()]);
        }
    }

    fn declared_variables(&mut self, owner: &str, parameters: &[ast::Parameter], cells: &[ast::Cell]) {
        for tree in parameters {
            let ty = typed(self.sources, &tree.ty, tree.default.as_ref());
            self.declared_name(What::Parameter, owner, &tree.name, &ty, &tree.doc);
        }
        for tree in cells {
            let ty = typed(self.sources, &tree.ty, tree.initial.as_ref()) + &rule(tree.rule.as_ref());
            self.declared_name(What::Cell, owner, &tree.name, &ty, &tree.doc);
        }
    }

    fn declared_automaton(&mut self, tree: &ast::Automaton) {
        let owner = &tree.name.value;
        let on = format!("on {}", tree.device.value);
        self.declared_name(What::Automaton, "", &tree.name, &on, &tree.doc);
        self.declared_variables(owner, &tree.parameters, &tree.cells);
        for role in &tree.roles {
            let last = role.also.last().unwrap_or(&role.interface).span;
            let ty = words(self.sources, role.interface.span.to(last));
            self.declared_name(What::Role, owner, &role.name, &ty, &role.doc);
        }
        for local in &tree.locals {
            let ty = typed(self.sources, &local.ty, local.initial.as_ref());
            self.declared_name(What::Local, owner, &local.name, &ty, &local.doc);
        }
        for define in &tree.defines {
            self.declared_name(What::Define, owner, &define.name, "", &define.doc);
        }
        for state in &tree.states {
            self.declared_name(What::State, owner, &state.name, "", &state.doc);
        }
    }

    fn declared_device(&mut self, tree: &ast::Device) {
        let owner = &tree.name.value;
        let what = if tree.is_assembly { What::Assembly } else { What::Device };
        self.declared_name(what, "", &tree.name, "", &tree.doc);
        for key in &tree.parameters {
            let ty = typed(self.sources, &key.ty, key.default.as_ref());
            self.declared_name(What::Key, owner, &key.name, &ty, &key.doc);
        }
        for member in &tree.members {
            match member {
                DeviceMember::Define(define) => {
                    self.declared_name(What::DeviceDefine, owner, &define.name, "", &define.doc);
                }
                DeviceMember::Part(part) => {
                    self.declared_name(What::Part, owner, &part.name, &part.kind.value, &[]);
                }
            }
        }
        for port in &tree.ports {
            let ty = with_unit(words(self.sources, port.ty.span), &port.unit);
            self.declared_name(What::Port, owner, &port.name, &ty, &port.doc);
        }
        for constant in &tree.constants {
            let ty = with_unit(words(self.sources, constant.ty.span), &constant.unit);
            self.declared_name(What::Constant, owner, &constant.name, &ty, &constant.doc);
        }
        for command in &tree.commands {
            let arguments: Vec<&str> = command.arguments.iter().map(|name| name.value.as_str()).collect();
            let ty = format!("({})", arguments.join(", "));
            self.declared_name(What::Command, owner, &command.name, &ty, &command.doc);
        }
        for place in &tree.handovers {
            self.declared_name(What::Handover, owner, &place.name, "", &[]);
        }
    }
}

/// Who may write a cell, as it is written.
fn rule(tree: Option<&ast::Rule>) -> String {
    match tree {
        None => String::new(),
        Some(ast::Rule::Owner) => " by owner".into(),
        Some(ast::Rule::Handshake) => " by handshake".into(),
        Some(ast::Rule::Lock) => " by lock".into(),
        Some(ast::Rule::Counter) => " by counter".into(),
        Some(ast::Rule::With(token)) => format!(" with {}", token.value),
        Some(ast::Rule::Token(sides)) => {
            let side = |side: &ast::Side| match side {
                ast::Side::Owner => "owner",
                ast::Side::Others => "others",
            };
            let sides: Vec<String> =
                sides.iter().map(|(name, who)| format!("{}: {}", name.value, side(who))).collect();
            format!(" by token {{ {} }}", sides.join(", "))
        }
    }
}

fn words(sources: &Sources, span: Span) -> String {
    written::on_one_line(sources.text(span))
}

fn typed(sources: &Sources, ty: &ast::Type, value: Option<&ast::Expr>) -> String {
    let value = value.map_or(String::new(), |value| format!(" := {}", words(sources, value.span)));
    words(sources, ty.span) + &value
}

fn with_unit(ty: String, unit: &str) -> String {
    if unit.is_empty() { ty } else { format!("{ty} unit \"{unit}\"") }
}
