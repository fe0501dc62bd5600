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
        own_interface,
    };
    context.names(tree);
    context.implements(tree);
    context.defines(tree);
    for require in &tree.requires {
        context.require(require);
    }
    if let Some(retain) = &tree.retain {
        context.retain(retain);
    }
    state::check(&mut context, tree);
    context.properties(tree);
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
    changes || expr.parts().iter().any(|part| reads_changing(automaton, part, seen))
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
            self.report(
                Diagnostic::new(
                    "E0301",
                    name.span,
                    format!("`{}` is already the name of {meaning}", name.value),
                )
                .help("choose another name"),
            );
            self.broken.insert(name.value.clone());
            return;
        }
        self.symbols.insert(name.value.clone(), symbol);
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
                    .help("remove one"),
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
            let message = format!(
                "a `{}` has no arm, so it takes nothing and hands nothing over",
                self.automaton.device.name
            );
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

    fn implements(&mut self, tree: &ast::Automaton) {
        for clause in &tree.implements {
            let Some(interface) = self.checker.interface_named(&clause.interface.value) else { continue };
            let handover = clause.handover.as_ref().and_then(|h| self.handover(h));
            let parameters = self.supplied(interface, &clause.interface);
            self.automaton.implements.push(ir::Implements { interface, parameters, handover });
        }
        if let Some(interface) = self.own_interface {
            let parameters = self.supplied(interface, &tree.name);
            self.automaton.implements.push(ir::Implements { interface, parameters, handover: None });
        }
    }

    /// Which parameter of the automaton supplies each parameter of an interface: the one of the same name.
    fn supplied(&mut self, interface: ir::InterfaceId, clause: &ast::Name) -> Vec<usize> {
        let mut wanted = self.checker.model.interfaces[interface.0].parameters.clone();
        wanted.retain(|p| !self.checker.is_broken(interface, &p.name));
        let mut supplied = Vec::new();
        for parameter in wanted {
            let index = match self.symbols.get(&parameter.name) {
                Some(Symbol::Parameter(index)) => *index,
                Some(Symbol::DeviceConstant(index)) => {
                    let index = *index;
                    self.device_parameter(index)
                }
                _ if self.broken.contains(&parameter.name) => continue,
                _ => {
                    let message = format!(
                        "`{}` has no parameter `{}`, which the interface `{}` asks for",
                        self.automaton.name, parameter.name, clause.value
                    );
                    self.report(Diagnostic::new("E0323", clause.span, message).help(format!(
                        "declare `parameter {}: {};`",
                        parameter.name,
                        self.checker.type_name(parameter.ty.scalar)
                    )));
                    continue;
                }
            };
            let found = self.automaton.parameters[index].ty;
            let fits = found.extent == parameter.ty.extent
                && match (found.scalar, parameter.ty.scalar) {
                    (Scalar::Int { lo, hi }, Scalar::Int { lo: low, hi: high }) => lo >= low && hi <= high,
                    (a, b) => a == b,
                };
            if !fits {
                let (have, want) =
                    (self.checker.type_name(found.scalar), self.checker.type_name(parameter.ty.scalar));
                let place = self.automaton.parameters[index].place;
                self.report(
                    Diagnostic::new(
                        "E0323",
                        clause.span,
                        format!(
                            "`{}` is {have}, and the interface `{}` asks for {want}",
                            parameter.name, clause.value
                        ),
                    )
                    .other(place, "declared here")
                    .help("give both the same type and size"),
                );
            }
            self.same_name(interface, &parameter.name);
            supplied.push(index);
        }
        supplied
    }

    /// What supplies a parameter of an interface is called as it is.
    fn same_name(&mut self, interface: ir::InterfaceId, name: &str) {
        let Some(names) = &mut self.checker.names else { return };
        let of_interface = names.find(Space::OfType, &self.checker.model.interfaces[interface.0].name, name);
        let own = names.find(Space::OfType, &self.automaton.name, name);
        let of_device = names.find(Space::OfDevice, &self.automaton.device.name, name);
        names.link(of_interface, own.or(of_device));
    }

    fn handover(&mut self, tree: &ast::Handover) -> Option<ir::Handover> {
        let device = self.automaton.device.clone();
        let known = &device.handovers;
        let Some(found) = known.iter().find(|h| h.name == tree.place.value) else {
            let names: Vec<&str> = known.iter().map(|h| h.name.as_str()).collect();
            let help = if names.is_empty() {
                "this device has no place for handovers".into()
            } else {
                format!("its places are {}", names.join(", "))
            };
            let message = format!(
                "a `{}` has no place `{}` for handovers",
                self.automaton.device.name, tree.place.value
            );
            self.report(Diagnostic::new("E0324", tree.place.span, message).help(help));
            return None;
        };
        self.checker.uses(tree.place.span, Space::Handovers, &device.name, &found.name);
        let index = match (&tree.index, found.indexed) {
            (None, None) => None,
            (index, Some(n)) => {
                let index = index.as_ref().and_then(|index| self.index_of_place(index, n));
                if index.is_none() {
                    let (name, last) = (&found.name, n - 1);
                    self.report(
                        Diagnostic::new("E0324", tree.span, format!("one of the {n} places must be named"))
                            .help(format!(
                                "write `{name}[0]` to `{name}[{last}]`, or a parameter of this automaton within 0..{last}"
                            )),
                    );
                    return None;
                }
                index
            }
            (Some(index), None) => {
                self.report(
                    Diagnostic::new("E0324", index.span, format!("`{}` is one place", found.name))
                        .help("remove the index"),
                );
                return None;
            }
        };
        let approach = match &tree.approach {
            None => 0.0,
            Some(expr) => match self.checker.constant(Scalar::Real, expr)? {
                ir::Value::Real(height) if height >= 0.0 => height,
                _ => {
                    self.report(
                        Diagnostic::new("E0324", expr.span, "an approach height is 0 m or more")
                            .help("write it in metres"),
                    );
                    return None;
                }
            },
        };
        let direction = match tree.direction {
            ast::Direction::Accepts => ir::Direction::Accepts,
            ast::Direction::Offers => ir::Direction::Offers,
        };
        Some(ir::Handover { place: tree.span, direction, name: found.name.clone(), index, approach })
    }

    /// Which of so many places is meant; none if it is none of them, or not known beforehand.
    fn index_of_place(&mut self, tree: &ast::Expr, places: usize) -> Option<ir::Index> {
        match &tree.kind {
            ast::ExprKind::Int(i) if (0..places as i64).contains(i) => Some(ir::Index::Number(*i as usize)),
            ast::ExprKind::Name(name) => {
                let Some(symbol @ Symbol::Parameter(parameter)) = self.symbols.get(name) else { return None };
                let ir::Type { scalar: Scalar::Int { lo, hi }, extent: Extent::One } =
                    self.automaton.parameters[*parameter].ty
                else {
                    return None;
                };
                let index = (lo >= 0 && (hi as usize) < places).then_some(ir::Index::Parameter(*parameter));
                self.uses_symbol(name, &symbol.clone(), tree.span);
                index
            }
            _ => None,
        }
    }

    /// The parameter that holds a device constant.
    pub(super) fn device_parameter(&mut self, constant: usize) -> usize {
        let device = self.automaton.device.clone();
        let declared = &device.constants[constant];
        let index = self.automaton.parameters.len();
        self.automaton.parameters.push(ir::Parameter {
            name: declared.name.clone(),
            doc: vec![sentence(&declared.meaning, &declared.unit)],
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
        for define in &tree.defines {
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
            self.automaton.defines.push(ir::Define {
                name: define.name.value.clone(),
                doc: define.doc.clone(),
                place: define.name.span,
                ty: value.ty,
                value,
            });
        }
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

fn sentence(meaning: &str, unit: &str) -> String {
    let mut text: String =
        meaning.chars().take(1).flat_map(char::to_uppercase).chain(meaning.chars().skip(1)).collect();
    if !unit.is_empty() {
        text.push_str(&format!(" [{unit}]"));
    }
    text + "."
}
