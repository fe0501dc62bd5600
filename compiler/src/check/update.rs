//! Updates: assignments and commands.

use super::context::Context;
use super::facts::{self, Interval};
use super::names::Space;
use super::path::Path;
use crate::diagnostic::{Diagnostic, suggestion};
use crate::ir::{
    self, Argument, Expr, ExprKind, Extent, FaultId, FaultKind, Place, Scalar, Target, Type, UpdateKind,
};
use crate::source::Span;
use crate::spec::ast::{self, Assign};
use runtime_sim::device::Direction;

impl Context<'_, '_> {
    pub(super) fn update(&mut self, tree: &ast::Update) -> Option<ir::Update> {
        let kind = match &tree.kind {
            ast::UpdateKind::Assign { target, how, value } => self.assign(target, *how, value, tree.span)?,
            ast::UpdateKind::Command { verb, arguments } => self.command(verb, arguments)?,
        };
        Some(ir::Update { place: tree.span, kind })
    }

    fn assign(
        &mut self,
        target: &ast::Expr,
        how: Assign,
        value: &ast::Expr,
        span: Span,
    ) -> Option<UpdateKind> {
        let (place, ty) = self.target(target)?;
        if ty.extent != Extent::One {
            return self.assign_array(place, ty, how, value, span);
        }
        let value = match how {
            Assign::Set => self.typed(value, ty.scalar)?,
            Assign::Add | Assign::Subtract => {
                let operator = if how == Assign::Add { ast::Operator::Add } else { ast::Operator::Subtract };
                let sum = ast::Expr {
                    span,
                    kind: ast::ExprKind::Binary(operator, Box::new(target.clone()), Box::new(value.clone())),
                };
                self.typed(&sum, ty.scalar)?
            }
        };
        self.check_rule(&place, how, &value, target.span)?;
        let check = self.store(&place, ty.scalar, &value, span);
        let mut known = self.facts.of(&value);
        if check.is_some() {
            known = known.meet(facts::of_type(ty.scalar));
        }
        self.facts.write(&place, ty.scalar, known);
        Some(UpdateKind::Assign { target: Target { place, ty }, value, check })
    }

    fn assign_array(
        &mut self,
        place: Place,
        ty: Type,
        how: Assign,
        value: &ast::Expr,
        span: Span,
    ) -> Option<UpdateKind> {
        if how != Assign::Set {
            self.report(
                Diagnostic::new("E0330", span, "`+=` and `-=` do not take a whole array")
                    .help("write an index, or `:=`"),
            );
            return None;
        }
        let is_access = matches!(value.kind, ast::ExprKind::Name(_) | ast::ExprKind::Member(..));
        let target = Target { place: place.clone(), ty };
        if is_access
            && let Path::Place(source, found) = self.path(value, Some(ty.scalar))?
            && found.extent != Extent::One
        {
            return self.copy_array(target, source, found, value.span, span);
        }
        let value = self.typed(value, ty.scalar)?;
        self.check_rule(&place, how, &value, span)?;
        let check = self.store(&place, ty.scalar, &value, span);
        self.facts.write(&place, ty.scalar, Interval::ALL);
        Some(UpdateKind::Fill { target, value, check })
    }

    fn copy_array(
        &mut self,
        target: Target,
        source: Place,
        found: Type,
        value: Span,
        span: Span,
    ) -> Option<UpdateKind> {
        let ty = target.ty;
        let fits = match (found.scalar, ty.scalar) {
            (Scalar::Int { .. }, Scalar::Int { .. }) => true,
            (a, b) => a == b,
        };
        if !fits || found.extent != ty.extent {
            self.report(
                Diagnostic::new("E0330", value, "this array has another type or another size")
                    .help("copy arrays of the same size and type, or assign element by element"),
            );
            return None;
        }
        let element = Expr { ty: found.scalar, kind: ExprKind::Read(source.clone()) };
        self.check_rule(&target.place, Assign::Set, &element, span)?;
        let check = self.store(&target.place, ty.scalar, &element, span);
        self.facts.write(&target.place, ty.scalar, Interval::ALL);
        Some(UpdateKind::Copy { target, source, check })
    }

    fn target(&mut self, tree: &ast::Expr) -> Option<(Place, Type)> {
        let Path::Place(place, ty) = self.path(tree, None)? else {
            let help = match &tree.kind {
                ast::ExprKind::Member(base, _) if matches!(base.kind, ast::ExprKind::Name(_)) => {
                    "a point is assigned as a whole: `point(x, y, z)`"
                }
                _ => "locals, own cells, cells of a neighbour and own output ports can be written",
            };
            self.report(Diagnostic::new("E0331", tree.span, "this cannot be written").help(help));
            return None;
        };
        match &place {
            Place::Local { .. } | Place::Cell { .. } => {}
            Place::Parameter { .. } | Place::Shown { .. } => {
                self.report(
                    Diagnostic::new("E0331", tree.span, "a parameter is fixed by the layout")
                        .help("declare a `local` for a value that changes"),
                );
                return None;
            }
            Place::Port { port, .. } => {
                let device = &self.automaton.device;
                let port = &device.ports[*port];
                let mut arguments = device.verbs.iter().flat_map(|verb| &verb.arguments);
                let is_of_command = match port.name.as_str() {
                    "cmd" | "verb" | "hold" => device.is_commanded(),
                    "goal" => arguments.any(|argument| argument == "goal"),
                    _ => false,
                };
                let help = if port.direction == Direction::Input {
                    "the device writes it; the automaton reads it"
                } else if is_of_command {
                    "a command writes it"
                } else {
                    return Some((place, ty));
                };
                let message = format!("the automaton cannot write the port `{}`", port.name);
                self.report(Diagnostic::new("E0331", tree.span, message).help(help));
                return None;
            }
        }
        Some((place, ty))
    }

    /// The fault that storing this value could be, if it is not proved to fit.
    fn store(&mut self, place: &Place, ty: Scalar, value: &Expr, span: Span) -> Option<FaultId> {
        let name = self.place_name(place);
        match ty {
            Scalar::Int { .. } | Scalar::Time => {
                let bounds = facts::of_type(ty);
                let known = self.facts.of(value);
                if known.is_within(bounds) {
                    return None;
                }
                self.remark_misfit(&name, known, bounds, span);
                let text = format!("`{name}` would leave {}..{}", bounds.lo, bounds.hi);
                Some(self.fault(FaultKind::OutOfBounds, span, text))
            }
            Scalar::Real | Scalar::Point if facts::may_be_non_finite(value) => {
                Some(self.fault(FaultKind::NotFinite, span, format!("`{name}` would not be finite")))
            }
            _ => None,
        }
    }

    fn place_name(&self, place: &Place) -> String {
        match place {
            Place::Local { local, .. } => self.automaton.locals[*local].name.clone(),
            Place::Cell { interface, cell, .. } => {
                self.checker.model.interfaces[interface.0].cells[*cell].name.clone()
            }
            Place::Port { port, .. } => self.automaton.device.ports[*port].name.clone(),
            Place::Parameter { parameter, .. } => self.automaton.parameters[*parameter].name.clone(),
            Place::Shown { interface, parameter, .. } => {
                self.checker.model.interfaces[interface.0].parameters[*parameter].name.clone()
            }
        }
    }

    fn command(&mut self, verb: &ast::Name, arguments: &[ast::Expr]) -> Option<UpdateKind> {
        let device = self.automaton.device.clone();
        // `goto` is how the paper's figure writes a vehicle's command.
        let name = if verb.value == "goto" { "move" } else { verb.value.as_str() };
        let Some(known) = device.verbs.iter().find(|v| v.name == name) else {
            let names: Vec<&str> = device.verbs.iter().map(|v| v.name.as_str()).collect();
            let help = match suggestion(&verb.value, names.iter().copied()) {
                Some(near) => format!("is `{near}` meant?"),
                None if names.is_empty() => format!("the device `{}` has no commands", device.name),
                None => format!("a `{}` obeys {}", device.name, names.join(", ")),
            };
            self.report(
                Diagnostic::new(
                    "E0332",
                    verb.span,
                    format!("a `{}` has no command `{}`", device.name, verb.value),
                )
                .help(help),
            );
            return None;
        };
        self.checker.uses(verb.span, Space::Commands, &device.name, name);
        if arguments.len() != known.arguments.len() {
            self.report(
                Diagnostic::new(
                    "E0332",
                    verb.span,
                    format!(
                        "`{}` takes {} arguments, not {}",
                        verb.value,
                        known.arguments.len(),
                        arguments.len()
                    ),
                )
                .help(format!("write `{}({})`", verb.value, known.arguments.join(", "))),
            );
            return None;
        }
        let mut written = Vec::new();
        for (tree, port_name) in arguments.iter().zip(&known.arguments) {
            let port = device.ports.iter().position(|p| p.name == *port_name)?;
            let ty = self.port_type(port);
            let value = self.typed(tree, ty.scalar)?;
            let place = Place::Port { port, index: None };
            let check = self.store(&place, ty.scalar, &value, tree.span);
            written.push(Argument { port, value, check });
        }
        let ports = device.ports.iter().enumerate();
        for (port, _) in ports
            .filter(|(_, p)| ["cmd", "verb"].contains(&p.name.as_str()) || known.arguments.contains(&p.name))
        {
            self.facts.forget(&Place::Port { port, index: None });
        }
        Some(UpdateKind::Command { verb: known.number, arguments: written })
    }
}
