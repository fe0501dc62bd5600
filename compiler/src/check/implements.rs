//! What an automaton shows to others: its interfaces, and where items change hands.

use super::context::{Context, Symbol};
use super::names::Space;
use super::types::Computed;
use crate::diagnostic::Diagnostic;
use crate::ir::{self, Extent, Scalar};
use crate::spec::ast;

impl Context<'_, '_> {
    pub(super) fn implements(&mut self, tree: &ast::Automaton) {
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
                        self.checker.type_with_size(parameter.ty)
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
                let [have, want] = [found, parameter.ty].map(|ty| self.checker.type_with_size(ty));
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
            Some(expr) => match self.checker.constant(Scalar::Real, expr, Computed::Never)? {
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
                let Some(&symbol @ Symbol::Parameter(parameter)) = self.symbols.get(name) else {
                    return None;
                };
                let ir::Type { scalar: Scalar::Int { lo, hi }, extent: Extent::One } =
                    self.automaton.parameters[parameter].ty
                else {
                    return None;
                };
                let index = (lo >= 0 && (hi as usize) < places).then_some(ir::Index::Parameter(parameter));
                self.uses_symbol(name, &symbol, tree.span);
                index
            }
            _ => None,
        }
    }
}
