//! Names and accesses: `slot[i]`, `tray.open`, `stops[0].x`.

use super::context::{Context, Symbol};
use super::facts;
use super::names::Space;
use crate::diagnostic::{Diagnostic, suggestion};
use crate::ir::{self, Expr, ExprKind, Extent, Place, Scalar, Type, Value};
use crate::source::Span;
use crate::spec::ast;
use runtime_sim::device;

/// What an access leads to.
pub enum Path {
    /// Something that is kept, perhaps a whole array.
    Place(Place, Type),
    /// A value.
    Value(Expr),
}

impl Context<'_, '_> {
    /// `None` has been reported. `expected` helps to choose among members of enumerations with the same name.
    pub(super) fn path(&mut self, tree: &ast::Expr, expected: Option<Scalar>) -> Option<Path> {
        match &tree.kind {
            ast::ExprKind::Name(name) => self.name(name, tree.span, expected),
            ast::ExprKind::Member(base, member) => self.member(base, member, tree.span),
            ast::ExprKind::Index(base, index) => self.index(base, index),
            _ => self.expr(tree, expected).map(Path::Value),
        }
    }

    fn name(&mut self, name: &str, span: Span, expected: Option<Scalar>) -> Option<Path> {
        if let Some((_, id, ty)) = self.variables.iter().rev().find(|(n, _, _)| n == name) {
            let (id, ty) = (*id, *ty);
            if let (Some(names), Some(number)) = (&mut self.checker.names, self.variable_names.get(&id)) {
                names.use_at(self.checker.sources, span, *number);
            }
            return Some(Path::Value(Expr { ty, kind: ExprKind::Variable(id) }));
        }
        if name == "done" || name == "failed" {
            return self.answer(name, span).map(Path::Value);
        }
        if name == "self" {
            return self.own_reference(span, expected).map(Path::Value);
        }
        let symbol = self.symbols.get(name).cloned();
        if let Some(symbol) = &symbol {
            self.uses_symbol(name, symbol, span);
        }
        match symbol {
            Some(Symbol::Local(local)) => {
                Some(Path::Place(Place::Local { local, index: None }, self.automaton.locals[local].ty))
            }
            Some(Symbol::Cell(interface, _)) if self.checker.is_broken(interface, name) => None,
            Some(Symbol::Cell(interface, cell)) => {
                let ty = self.checker.model.interfaces[interface.0].cells[cell].ty;
                Some(Path::Place(Place::Cell { interface, cell, of: None, index: None }, ty))
            }
            Some(Symbol::Port(port)) => {
                Some(Path::Place(Place::Port { port, index: None }, self.port_type(port)))
            }
            Some(Symbol::Parameter(parameter)) => {
                let ty = self.automaton.parameters[parameter].ty;
                Some(Path::Place(Place::Parameter { parameter, index: None }, ty))
            }
            Some(Symbol::DeviceConstant(constant)) => {
                let parameter = self.device_parameter(constant);
                let ty = self.automaton.parameters[parameter].ty;
                Some(Path::Place(Place::Parameter { parameter, index: None }, ty))
            }
            Some(Symbol::Define(define)) => {
                let ty = self.automaton.defines[define].ty;
                Some(Path::Value(Expr { ty, kind: ExprKind::Define(define) }))
            }
            Some(Symbol::Role(_)) => {
                self.report(
                    Diagnostic::new("E0310", span, format!("`{name}` is a role, not one robot")).help(
                        format!("choose one with `first x in {name}`, or ask `exists x in {name}: ...`"),
                    ),
                );
                None
            }
            None => self.enum_member(name, span, expected),
        }
    }

    fn own_reference(&mut self, span: Span, expected: Option<Scalar>) -> Option<Expr> {
        if let Some(Scalar::Ref(interface)) = expected
            && self.automaton.implementing(interface).is_some()
        {
            return Some(Expr { ty: Scalar::Ref(interface), kind: ExprKind::Own(interface) });
        }
        self.report(Diagnostic::new("E0310", span, "`self` has no meaning here").help(
            "`self` is a reference to this robot, where a reference to one of its interfaces is expected",
        ));
        None
    }

    fn enum_member(&mut self, name: &str, span: Span, expected: Option<Scalar>) -> Option<Path> {
        let mut found: Vec<(ir::EnumId, usize)> = Vec::new();
        for (id, e) in self.checker.model.enums.iter().enumerate() {
            if let Some(ordinal) = e.members.iter().position(|m| m == name) {
                found.push((ir::EnumId(id), ordinal));
            }
        }
        if let Some(Scalar::Enum(id)) = expected {
            match found.iter().find(|(e, _)| *e == id) {
                Some(fit) => found = vec![*fit],
                None if self.checker.takes_for_kind(id) => return None,
                None => {}
            }
        }
        match found.as_slice() {
            [(id, ordinal)] => {
                let of = self.checker.model.enums[id.0].name.clone();
                self.checker.uses(span, Space::OfType, &of, name);
                Some(Path::Value(Expr {
                    ty: Scalar::Enum(*id),
                    kind: ExprKind::Constant(Value::Int(*ordinal as i32)),
                }))
            }
            [] => {
                self.unknown_name(name, span);
                None
            }
            _ => {
                let names: Vec<String> = found
                    .iter()
                    .map(|(id, _)| format!("`{}.{name}`", self.checker.model.enums[id.0].name))
                    .collect();
                self.report(
                    Diagnostic::new("E0310", span, format!("`{name}` is a member of several enumerations"))
                        .help(format!("write {}", names.join(" or "))),
                );
                None
            }
        }
    }

    fn is_output(&self, name: &str) -> bool {
        let mut ports = self.automaton.device.ports.iter();
        ports.any(|port| port.name == name && port.direction == device::Direction::Output)
    }

    fn unknown_name(&mut self, name: &str, span: Span) {
        if self.lacks_names || self.broken.contains(name) || self.checker.takes_for_kind(ir::EnumId(0)) {
            return;
        }
        let mut known: Vec<String> = self.symbols.keys().cloned().collect();
        known.extend(self.variables.iter().map(|(n, _, _)| n.clone()));
        known.extend(self.checker.model.enums.iter().flat_map(|e| e.members.iter().cloned()));
        known.push("self".into());
        if self.automaton.device.is_commanded() {
            known.extend(["done", "failed"].map(String::from));
        }
        let diagnostic = Diagnostic::new("E0311", span, format!("there is no `{name}` here"));
        let help = match suggestion(name, known.iter().map(String::as_str)) {
            _ if self.states.iter().any(|s| s == name) => {
                format!(
                    "`{name}` is a state: write the next state after the guard, `when done -> {name} {{}}`"
                )
            }
            _ if self.defined_below.first().is_some_and(|own| own == name) => {
                "a definition cannot use itself".into()
            }
            _ if self.defined_below.iter().any(|below| below == name) => {
                format!("`{name}` is defined below: put its definition above this one")
            }
            Some(near) if self.is_output(near) => format!(
                "is `{near}` meant? It is an output of the device `{}`; an input is declared there, `in {name}: TYPE = PART.SIGNAL;`",
                self.automaton.device.name
            ),
            Some(near) => format!("is `{near}` meant?"),
            None => format!(
                "names are those of `{}`, of its interfaces, of the ports and constants of its device `{}`",
                self.automaton.name, self.automaton.device.name
            ),
        };
        self.report(diagnostic.help(help));
    }

    fn member(&mut self, base: &ast::Expr, member: &ast::Name, span: Span) -> Option<Path> {
        if let ast::ExprKind::Name(name) = &base.kind
            && !self.symbols.contains_key(name)
            && !self.variables.iter().any(|(n, _, _)| n == name)
            && let Some(id) = self.checker.enum_named(name)
        {
            let ordinal = self.checker.model.enums[id.0].members.iter().position(|m| *m == member.value);
            if ordinal.is_none() && self.checker.takes_for_kind(id) {
                return None;
            }
            let members = &self.checker.model.enums[id.0].members;
            let Some(ordinal) = ordinal else {
                let help = suggestion(&member.value, members.iter().map(String::as_str))
                    .map_or(format!("its members are {}", members.join(", ")), |n| {
                        format!("is `{n}` meant?")
                    });
                self.report(
                    Diagnostic::new(
                        "E0311",
                        member.span,
                        format!("`{name}` has no member `{}`", member.value),
                    )
                    .help(help),
                );
                return None;
            };
            self.checker.uses(base.span, Space::Types, "", name);
            self.checker.uses(member.span, Space::OfType, name, &member.value);
            let kind = ExprKind::Constant(Value::Int(ordinal as i32));
            return Some(Path::Value(Expr { ty: Scalar::Enum(id), kind }));
        }
        let of = self.expr(base, None)?;
        match of.ty {
            Scalar::Point => {
                let Some(axis) = ["x", "y", "z"].iter().position(|a| *a == member.value) else {
                    self.report(
                        Diagnostic::new("E0311", member.span, format!("a point has no `{}`", member.value))
                            .help("a point has `x`, `y` and `z`"),
                    );
                    return None;
                };
                Some(Path::Value(Expr { ty: Scalar::Real, kind: ExprKind::Coordinate(Box::new(of), axis) }))
            }
            Scalar::Ref(interface) => self.shown(of, interface, member),
            ty => {
                let name = self.checker.type_name(ty);
                self.report(
                    Diagnostic::new(
                        "E0311",
                        span,
                        format!("a value of type {name} has no `{}`", member.value),
                    )
                    .help("only robots and points have members"),
                );
                None
            }
        }
    }

    fn shown(&mut self, of: Expr, interface: ir::InterfaceId, member: &ast::Name) -> Option<Path> {
        if self.checker.is_broken(interface, &member.value) {
            return None;
        }
        let of = Box::new(of);
        let name = self.checker.model.interfaces[interface.0].name.clone();
        self.checker.uses(member.span, Space::OfType, &name, &member.value);
        let shown = &self.checker.model.interfaces[interface.0];
        if let Some(cell) = shown.cells.iter().position(|c| c.name == member.value) {
            let ty = shown.cells[cell].ty;
            return Some(Path::Place(Place::Cell { interface, cell, of: Some(of), index: None }, ty));
        }
        if let Some(parameter) = shown.parameters.iter().position(|p| p.name == member.value) {
            let ty = shown.parameters[parameter].ty;
            return Some(Path::Place(Place::Shown { interface, parameter, of, index: None }, ty));
        }
        let known = shown
            .cells
            .iter()
            .map(|c| c.name.as_str())
            .chain(shown.parameters.iter().map(|p| p.name.as_str()));
        let help = suggestion(&member.value, known)
            .map(|n| format!("is `{n}` meant?"))
            .or_else(|| self.joined(interface, &member.value))
            .unwrap_or_else(|| {
                "a neighbour shows the cells and parameters of its interface, never its ports or locals"
                    .into()
            });
        let message = format!("`{}` shows no `{}`", shown.name, member.value);
        self.report(Diagnostic::new("E0311", member.span, message).help(help));
        None
    }

    /// Help if a role joins the interface with one that shows the name.
    fn joined(&self, interface: ir::InterfaceId, name: &str) -> Option<String> {
        let interfaces = &self.checker.model.interfaces;
        let shows = |i: &&ir::InterfaceId| {
            let other = &interfaces[i.0];
            let mut cells = other.cells.iter().map(|c| &c.name);
            cells.any(|n| n == name) || other.parameters.iter().any(|p| p.name == name)
        };
        let roles = self.automaton.roles.iter().filter(|role| role.interface == interface);
        let mut found = roles.filter_map(|role| Some((role, role.also.iter().find(shows)?)));
        let (role, other) = found.next()?;
        let joined = role.also.iter().map(|i| format!(" and {}", interfaces[i.0].name)).collect::<String>();
        let (first, other) = (&interfaces[interface.0].name, &interfaces[other.0].name);
        Some(format!(
            "in `{}: ({first}{joined})` only the cells and parameters of `{first}` are seen; write `{other}` first to see those of `{other}`",
            role.name
        ))
    }

    fn index(&mut self, base: &ast::Expr, index: &ast::Expr) -> Option<Path> {
        let path = self.path(base, None)?;
        let Path::Place(mut place, ty) = path else {
            self.report(Diagnostic::new("E0312", base.span, "this is not an array").help("remove the index"));
            return None;
        };
        if ty.extent == Extent::One || slot(&mut place).is_some() {
            self.report(Diagnostic::new("E0312", base.span, "this is not an array").help("remove the index"));
            return None;
        }
        let expr = match ty.extent {
            Extent::By(id) => self.typed(index, Scalar::Enum(id))?,
            Extent::Count(_) | Extent::One => self.whole(index)?,
        };
        if let Extent::Count(n) = ty.extent {
            let known = self.facts.of(&expr);
            let allowed = facts::Interval::new(0.0, n as f64 - 1.0);
            if !known.is_within(allowed) {
                self.report(
                    Diagnostic::new("E0313", index.span, format!("this index is not proved to be in 0..{}", n - 1))
                        .label(format!("its derived bounds are {}..{}", known.lo, known.hi))
                        .help("declare the variable with these bounds, or compare it in the guard of this transition"),
                );
                return None;
            }
        }
        *slot(&mut place) = Some(Box::new(expr));
        Some(Path::Place(place, Type { scalar: ty.scalar, extent: Extent::One }))
    }
}

/// Where the index of a place is kept.
fn slot(place: &mut Place) -> &mut Option<Box<Expr>> {
    match place {
        Place::Local { index, .. }
        | Place::Cell { index, .. }
        | Place::Port { index, .. }
        | Place::Parameter { index, .. }
        | Place::Shown { index, .. } => index,
    }
}
