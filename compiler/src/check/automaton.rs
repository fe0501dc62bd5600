//! One automaton: its names, then its parts.

use super::context::{Context, Symbol};
use super::facts::Facts;
use super::names::Space;
use super::{Checker, state};
use crate::device::Device;
use crate::diagnostic::{Diagnostic, suggestion};
use crate::ir::{self, Extent, Scalar, Type};
use crate::source::Span;
use crate::spec::ast;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

pub(super) fn check(checker: &mut Checker, tree: &ast::Automaton) {
    let Some(device) = device(checker, &tree.device) else { return };
    let automaton = ir::Automaton {
        name: tree.name.value.clone(),
        doc: tree.doc.clone(),
        place: tree.name.span,
        device,
        implements: Vec::new(),
        parameters: Vec::new(),
        roles: Vec::new(),
        locals: Vec::new(),
        defines: Vec::new(),
        variables: Vec::new(),
        states: Vec::new(),
        properties: Vec::new(),
        masked: Vec::new(),
        retained: ir::Retained::default(),
        abandoned: None,
        interrupted: None,
        modes: None,
        requires: Vec::new(),
    };
    let id = ir::AutomatonId(checker.model.automata.len());
    let own_interface = checker
        .model
        .interfaces
        .iter()
        .position(|i| i.name == tree.name.value)
        .map(ir::InterfaceId)
        .filter(|_| !checker.declarations.interfaces.iter().any(|i| i.name.value == tree.name.value));
    let mut context = Context {
        checker,
        automaton,
        id,
        symbols: BTreeMap::new(),
        variables: Vec::new(),
        variable_names: BTreeMap::new(),
        facts: Facts::default(),
        required: Facts::default(),
        in_guard: false,
        broken: BTreeSet::new(),
        lacks_names: false,
        states: tree.states.iter().map(|s| s.name.value.clone()).collect(),
        defined: Vec::new(),
        defined_below: Vec::new(),
        own_interface,
    };
    context.names(tree);
    context.implements(tree);
    context.defines(tree);
    // Requirements and properties say what holds, and may say what always does.
    let remarks = context.checker.remarks.len();
    for require in &tree.requires {
        context.require(require);
    }
    context.checker.remarks.truncate(remarks);
    if let Some(retain) = &tree.retain {
        context.retain(retain);
    }
    state::check(&mut context, tree);
    let remarks = context.checker.remarks.len();
    context.properties(tree);
    context.checker.remarks.truncate(remarks);
    context.bounded_work();
    let automaton = context.automaton;
    checker.model.automata.push(automaton);
}

/// None has been reported.
fn device(checker: &mut Checker, name: &ast::Name) -> Option<Arc<Device>> {
    if let Some((_, device)) = checker.devices.iter().find(|(known, _)| *known == name.value) {
        let device = device.clone();
        checker.uses(name.span, Space::Devices, "", &name.value);
        return device;
    }
    if !name.value.is_empty() {
        let known = || checker.devices.iter().map(|(name, _)| name.as_str());
        let help = suggestion(&name.value, known())
            .map_or(format!("devices are {}", known().collect::<Vec<_>>().join(", ")), |n| {
                format!("is `{n}` meant?")
            });
        checker.report(
            Diagnostic::new("E0321", name.span, format!("there is no device `{}`", name.value)).help(help),
        );
    }
    None
}

/// `seen` are the definitions that were checked already, as each may be used many times.
fn reads_changing(automaton: &ir::Automaton, expr: &ir::Expr, seen: &mut BTreeSet<usize>) -> bool {
    use ir::ExprKind as Kind;
    let changes = match &expr.kind {
        Kind::Read(place) => !matches!(place, ir::Place::Parameter { .. } | ir::Place::Shown { .. }),
        Kind::Define(define) => {
            seen.insert(*define) && reads_changing(automaton, &automaton.defines[*define].value, seen)
        }
        Kind::After(_) | Kind::Done | Kind::Failed => true,
        _ => false,
    };
    changes || expr.parts().any(|part| reads_changing(automaton, part, seen))
}

impl Context<'_, '_> {
    pub(super) fn report(&mut self, diagnostic: Diagnostic) {
        self.checker.report(diagnostic);
    }

    pub(super) fn fault(&mut self, kind: ir::FaultKind, place: Span, text: String) -> ir::FaultId {
        self.checker.model.faults.push(ir::FaultSite {
            automaton: self.id,
            kind,
            place,
            severity: ir::Severity::Line,
            text,
        });
        ir::FaultId(self.checker.model.faults.len() - 1)
    }

    fn require(&mut self, tree: &ast::Require) {
        let condition = self.typed(&tree.condition, Scalar::Bool);
        let mut text = Vec::new();
        for part in &tree.text {
            match part {
                ast::TextPart::Words(words) => text.push(ir::TextPart::Words(words.clone())),
                ast::TextPart::Value(value) => text.extend(self.expr(value, None).map(ir::TextPart::Value)),
            }
        }
        let Some(condition) = condition else { return };
        let values = text.iter().filter_map(|part| match part {
            ir::TextPart::Words(_) => None,
            ir::TextPart::Value(value) => Some(value),
        });
        let mut seen = BTreeSet::new();
        if values.chain([&condition]).any(|expr| reads_changing(&self.automaton, expr, &mut seen)) {
            self.report(
                Diagnostic::new("E0325", tree.span, "a requirement is decided before the line runs")
                    .help("use only parameters, device constants and roles; write a condition on values that change as an `invariant`"),
            );
        }
        self.required.learn(&condition, true);
        self.automaton.requires.push(ir::Require { place: tree.span, condition, text });
    }

    fn declare(&mut self, name: &ast::Name, symbol: Symbol) {
        if name.value == "self" || self.symbols.contains_key(&name.value) {
            let meaning = match self.symbols.get(&name.value) {
                Some(Symbol::Port(_)) => "a port of the device",
                Some(Symbol::DeviceConstant(_)) => "a constant of the device",
                Some(Symbol::Cell(..)) => "a cell of an interface",
                _ => "something else",
            };
            let mut told = Diagnostic::new(
                "E0301",
                name.span,
                format!("`{}` is already the name of {meaning}", name.value),
            );
            if let Some(place) = self.place_of_cell(&symbol) {
                told = told.other(place, "the cell of the interface");
            }
            let of_device = self.place_of_device_name(&name.value);
            if let Some(place) = of_device {
                told = told.other(place, "the name of the device");
            }
            let help = match symbol {
                Symbol::Cell(..) if of_device.is_some() => {
                    "rename one of the two: the automaton knows both by their names alone"
                }
                _ => "choose another name",
            };
            self.report(told.help(help));
            self.broken.insert(name.value.clone());
            return;
        }
        self.symbols.insert(name.value.clone(), symbol);
    }

    /// Where a cell of a declared interface stands.
    fn place_of_cell(&self, symbol: &Symbol) -> Option<Span> {
        let Symbol::Cell(id, cell) = symbol else { return None };
        let interface = &self.checker.model.interfaces[id.0];
        let declared = &self.checker.declarations.interfaces;
        let cells = &declared.iter().find(|i| i.name.value == interface.name)?.cells;
        cells.iter().find(|c| c.name.value == interface.cells[*cell].name).map(|c| c.name.span)
    }

    /// Where a port or a constant of the device is declared.
    fn place_of_device_name(&self, name: &str) -> Option<Span> {
        let device = &self.automaton.device;
        match self.symbols.get(name)? {
            Symbol::Port(port) => Some(device.ports[*port].place.unwrap_or(device.place)),
            Symbol::DeviceConstant(_) => {
                let declared =
                    self.checker.declarations.devices.iter().find(|d| d.name.value == device.name)?;
                declared.constants.iter().find(|c| c.name.value == name).map(|c| c.name.span)
            }
            _ => None,
        }
    }

    fn names(&mut self, tree: &ast::Automaton) {
        let device = self.automaton.device.clone();
        for (index, port) in device.ports.iter().enumerate() {
            self.symbols.insert(port.name.clone(), Symbol::Port(index));
        }
        for (index, constant) in device.constants.iter().enumerate() {
            self.symbols.insert(constant.name.clone(), Symbol::DeviceConstant(index));
        }
        let mut declared = Vec::new();
        for clause in &tree.implements {
            match self.checker.interface_or_report(&clause.interface) {
                None => self.lacks_names = true,
                Some(id) if declared.contains(&id) => self.report(
                    Diagnostic::new(
                        "E0301",
                        clause.interface.span,
                        format!("`{}` occurs here twice", clause.interface.value),
                    )
                    .help("remove one; what a machine accepts and what it offers have an interface each"),
                ),
                Some(id) => declared.push(id),
            }
        }
        declared.extend(self.own_interface);
        for id in declared {
            let cells: Vec<String> =
                self.checker.model.interfaces[id.0].cells.iter().map(|c| c.name.clone()).collect();
            for (index, cell) in cells.into_iter().enumerate() {
                let span =
                    tree.cells.iter().find(|c| c.name.value == cell).map_or(tree.name.span, |c| c.name.span);
                self.declare(&ast::Name { value: cell, span }, Symbol::Cell(id, index));
            }
        }
        for parameter in &tree.parameters {
            let ty = self.checker.resolve_type(&parameter.ty);
            let source = ty.and_then(|ty| self.checker.parameter_source(ty, parameter.default.as_ref()));
            let (Some(ty), Some(source)) = (ty, source) else {
                self.broken.insert(parameter.name.value.clone());
                continue;
            };
            self.declare(&parameter.name, Symbol::Parameter(self.automaton.parameters.len()));
            self.automaton.parameters.push(ir::Parameter {
                name: parameter.name.value.clone(),
                doc: parameter.doc.clone(),
                ty,
                source,
                place: parameter.name.span,
            });
        }
        for role in &tree.roles {
            self.role(role);
        }
        for local in &tree.locals {
            let ty = self.checker.resolve_type(&local.ty);
            let initial = ty.and_then(|ty| self.checker.initial(ty, local.initial.as_ref()));
            let (Some(ty), Some(initial)) = (ty, initial) else {
                self.broken.insert(local.name.value.clone());
                continue;
            };
            self.declare(&local.name, Symbol::Local(self.automaton.locals.len()));
            self.automaton.locals.push(ir::Local {
                name: local.name.value.clone(),
                doc: local.doc.clone(),
                ty,
                initial,
                kept_by: ir::KeptBy::Steps,
            });
        }
    }

    fn role(&mut self, tree: &ast::Role) {
        let Some(interface) = self.checker.interface_or_report(&tree.interface) else {
            self.broken.insert(tree.name.value.clone());
            return;
        };
        let also = tree.also.iter().filter_map(|n| self.checker.interface_or_report(n)).collect();
        self.declare(&tree.name, Symbol::Role(ir::RoleId(self.automaton.roles.len())));
        let kind = match tree.kind {
            ast::RoleKind::Takes => ir::RoleKind::Takes,
            ast::RoleKind::Hands => ir::RoleKind::Hands,
            ast::RoleKind::Serves => ir::RoleKind::Serves,
            ast::RoleKind::Knows => ir::RoleKind::Knows,
        };
        let is_active = matches!(kind, ir::RoleKind::Takes | ir::RoleKind::Hands);
        if is_active && !self.automaton.device.is_arm() {
            let device = &self.automaton.device;
            let lacks = if device.has("chain") { "gripper, a `grip`" } else { "arm" };
            let message =
                format!("a `{}` has no {lacks}, so it takes nothing and hands nothing over", device.name);
            self.report(
                Diagnostic::new("E0322", tree.name.span, message)
                    .help("`takes from` and `hands to` are for arms; a passive place has `is ... accepts at` or `offers at`"),
            );
        }
        self.automaton.roles.push(ir::Role {
            name: tree.name.value.clone(),
            doc: tree.doc.clone(),
            kind,
            interface,
            also,
            min: tree.min,
            max: tree.max,
            place: tree.name.span,
        });
    }

    /// The parameter that holds a device constant.
    pub(super) fn device_parameter(&mut self, constant: usize) -> usize {
        let device = self.automaton.device.clone();
        let declared = &device.constants[constant];
        let index = self.automaton.parameters.len();
        self.automaton.parameters.push(ir::Parameter {
            name: declared.name.clone(),
            doc: sentence(&declared.meaning, &declared.unit).into_iter().collect(),
            ty: Type { scalar: Scalar::from(declared.ty), extent: Extent::from(declared.extent) },
            source: ir::ParameterSource::Device,
            place: self.automaton.place,
        });
        self.symbols.insert(declared.name.clone(), Symbol::Parameter(index));
        index
    }

    pub(super) fn port_type(&self, port: usize) -> Type {
        let port = &self.automaton.device.ports[port];
        Type { scalar: Scalar::from(port.ty), extent: Extent::from(port.extent) }
    }

    fn defines(&mut self, tree: &ast::Automaton) {
        let mut depths: Vec<usize> = Vec::new();
        for (number, define) in tree.defines.iter().enumerate() {
            self.defined_below = tree.defines[number..].iter().map(|d| d.name.value.clone()).collect();
            let Some(value) = self.expr(&define.value, None) else {
                self.broken.insert(define.name.value.clone());
                continue;
            };
            let mut depth = 0;
            defines_read(&value, &mut |read| depth = depth.max(depths[read] + 1));
            if depth == DEEPEST_DEFINE {
                self.report(
                    Diagnostic::new(
                        "E0211",
                        define.name.span,
                        format!(
                            "`{}` uses a chain of {DEEPEST_DEFINE} definitions, which is the limit",
                            define.name.value
                        ),
                    )
                    .help("nest fewer definitions"),
                );
            }
            depths.push(depth);
            let ty = self.checker.type_name(value.ty);
            if let Some(names) = &mut self.checker.names
                && let Some(number) = names.find(Space::OfType, &self.automaton.name, &define.name.value)
            {
                names.set_type(number, ty);
            }
            self.declare(&define.name, Symbol::Define(self.automaton.defines.len()));
            self.defined.push(self.defined_as(&value));
            self.automaton.defines.push(ir::Define {
                name: define.name.value.clone(),
                doc: define.doc.clone(),
                place: define.name.span,
                ty: value.ty,
                value,
            });
        }
        self.defined_below.clear();
    }
}

/// Definitions that use one another, one in another, beyond which a text is refused.
const DEEPEST_DEFINE: usize = 32;

/// The definitions that an expression reads itself.
fn defines_read(expr: &ir::Expr, found: &mut dyn FnMut(usize)) {
    if let ir::ExprKind::Define(define) = expr.kind {
        found(define);
    }
    for part in expr.parts() {
        defines_read(part, found);
    }
}

/// With the unit behind the meaning; none of neither.
fn sentence(meaning: &str, unit: &str) -> Option<String> {
    let capital = meaning.chars().take(1).flat_map(char::to_uppercase);
    let meaning: String = capital.chain(meaning.chars().skip(1)).collect();
    match (meaning.as_str(), unit) {
        ("", "") => None,
        ("", unit) => Some(format!("In {unit}.")),
        (meaning, "") => Some(format!("{meaning}.")),
        (meaning, unit) => Some(format!("{meaning} [{unit}].")),
    }
}

#[cfg(test)]
mod tests {
    use super::sentence;

    #[test]
    fn a_constant_is_described_by_what_is_known_of_it() {
        assert_eq!(sentence("speed of the belt", "m/s").as_deref(), Some("Speed of the belt [m/s]."));
        assert_eq!(sentence("number of slots", "").as_deref(), Some("Number of slots."));
        assert_eq!(sentence("", "m").as_deref(), Some("In m."));
        assert_eq!(sentence("", ""), None);
    }
}
