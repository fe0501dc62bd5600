//! The ports of a device, what they are wired to, and its commands.

use super::check::Checker;
use super::program::Symbol;
use super::{Port, Verb, head, panel, type_text};
use crate::spec::ast::{self, ExprKind, Name, Scalar};
use runtime_sim::device::{Direction, Extent, PortType, Stop};
use runtime_sim::machine::MOST_ELEMENTS;
use runtime_sim::part::chain;
use runtime_sim::wiring::{Await, Command, Drives, Input, Output, Size, Source, Wiring};

impl Checker<'_> {
    pub(super) fn port_type(&mut self, ty: &ast::Type) -> Option<(PortType, Extent)> {
        let scalar = match &ty.scalar {
            Scalar::Bool => Some(PortType::Bool),
            Scalar::Real => Some(PortType::Real),
            Scalar::Point => Some(PortType::Point),
            Scalar::Int { lo, hi } => match (whole(lo), whole(hi)) {
                (Some(lo), Some(hi)) if lo <= hi => Some(PortType::Int { lo, hi }),
                _ => None,
            },
            Scalar::Time | Scalar::Named(_) => None,
        };
        let extent = match &ty.extent {
            None => Some(Extent::One),
            Some(ast::Expr { kind: ExprKind::Name(name), .. }) if name == "Kind" => Some(Extent::PerKind),
            Some(ast::Expr { kind: ExprKind::Int(n), .. }) if (1..=MOST_ELEMENTS as i64).contains(n) => {
                Some(Extent::Times(*n as usize))
            }
            Some(_) => None,
        };
        if scalar.is_none() || extent.is_none() {
            self.report(
                "E0709",
                ty.span,
                "no port or constant has this type".into(),
                "types are `bool`, `int 0..12`, `real` and `point`, also with `[12]` or `[Kind]` after them",
            );
        }
        Some((scalar?, extent?))
    }

    /// The part and the name behind it, in an expression such as `arm.joints.tool`.
    fn wire<'t>(&mut self, expr: &'t ast::Expr) -> Option<(usize, &'t Name)> {
        let ExprKind::Member(base, name) = &expr.kind else {
            let message = "a signal or a level of a part is expected".to_string();
            self.report("E0706", expr.span, message, "write the part, a point and its signal or level");
            return None;
        };
        Some((self.part_of(0, base)?, name))
    }

    fn part_of(&mut self, scope: usize, expr: &ast::Expr) -> Option<usize> {
        let symbol = match &expr.kind {
            ExprKind::Name(name) => self.program.scopes[scope].names.get(name),
            ExprKind::Member(base, member) => {
                let inner = self.assembly_of(scope, base)?;
                self.program.scopes[inner].names.get(&member.value)
            }
            _ => None,
        };
        if let Some(Symbol::Part(part)) = symbol {
            return Some(*part);
        }
        self.report("E0706", expr.span, "this is not a part".into(), "name a part of this device");
        None
    }

    fn assembly_of(&mut self, scope: usize, expr: &ast::Expr) -> Option<usize> {
        if let ExprKind::Name(name) = &expr.kind
            && let Some(Symbol::Assembly(inner)) = self.program.scopes[scope].names.get(name)
        {
            return Some(*inner);
        }
        self.report("E0706", expr.span, "this is not an assembly".into(), "name an assembly of this device");
        None
    }

    pub(super) fn wiring(&mut self, tree: &ast::Device) -> (Vec<Port>, Vec<Verb>, Wiring) {
        let mut wiring = Wiring::default();
        let mut ports: Vec<Port> = Vec::new();
        if tree.is_assembly {
            return (ports, Vec::new(), wiring);
        }
        if !tree.commands.is_empty() {
            for (port, source) in head::inputs() {
                wiring.inputs.push(Input { size: size(&port), source });
                ports.push(port);
            }
        }
        for port in tree.ports.iter().filter(|port| port.direction == Direction::Input) {
            if let Some((declared, source)) = self.input(port) {
                wiring.inputs.push(Input { size: size(&declared), source });
                ports.push(declared);
            }
        }
        if !tree.commands.is_empty() {
            for (port, drives) in head::outputs(&tree.commands) {
                wiring.outputs.push(Output { size: size(&port), drives });
                ports.push(port);
            }
        }
        for port in tree.ports.iter().filter(|port| port.direction == Direction::Output) {
            if let Some((declared, drives)) = self.output(port, tree) {
                wiring.outputs.push(Output { size: size(&declared), drives });
                ports.push(declared);
            }
        }
        let of_head: Vec<String> = match tree.commands.is_empty() {
            true => Vec::new(),
            false => head::names(),
        };
        for (index, port) in tree.ports.iter().enumerate() {
            let is_twice = tree.ports[..index].iter().any(|other| other.name.value == port.name.value)
                || tree.constants.iter().any(|other| other.name.value == port.name.value);
            if is_twice || of_head.contains(&port.name.value) {
                let message = format!("`{}` is already a name in this device", port.name.value);
                self.report("E0701", port.name.span, message, panel::another_name(&port.name.value));
            }
        }
        let verbs = self.verbs(tree, &ports, &mut wiring);
        (ports, verbs, wiring)
    }

    fn input(&mut self, port: &ast::Port) -> Option<(Port, Source)> {
        self.no_stop(port);
        let (ty, extent) = self.port_type(&port.ty)?;
        let Some(wire) = &port.wire else {
            let message = format!("the input `{}` has no source", port.name.value);
            self.report("E0706", port.name.span, message, "write the signal that it shows: `= part.signal`");
            return None;
        };
        let (part, name) = self.wire(wire)?;
        let schema = self.program.parts[part].schema;
        let Some(signal) = schema.signals.iter().position(|signal| signal.name == name.value) else {
            let known: Vec<&str> = schema.signals.iter().map(|signal| signal.name).collect();
            let message = format!("a {} has no signal `{}`", schema.name, name.value);
            self.report("E0706", name.span, message, known_or_none("its signals are", &known));
            return None;
        };
        let given = &schema.signals[signal];
        let fits = given.extent == extent && fits(given.ty, ty);
        if !fits {
            let message = format!("the signal `{}` has another type than the input", name.value);
            self.report(
                "E0706",
                port.ty.span,
                message,
                format!("write `{}`", type_text(given.ty, given.extent)),
            );
            return None;
        }
        Some((declared(port, ty, extent, Stop::Hold), Source::Signal { part, signal }))
    }

    fn output(&mut self, port: &ast::Port, tree: &ast::Device) -> Option<(Port, Drives)> {
        let (ty, extent) = self.port_type(&port.ty)?;
        let stop = self.stop(port, ty);
        let mut arguments = tree.commands.iter().flat_map(|command| &command.arguments);
        let is_argument = arguments.any(|argument| argument.value == port.name.value);
        let Some(wire) = &port.wire else {
            if is_argument && extent == Extent::One {
                return Some((declared(port, ty, extent, stop), Drives::Argument));
            }
            let message = format!("the output `{}` drives nothing", port.name.value);
            let help = "write the level that it sets, `= part.level`, or make it an argument of a command";
            self.report("E0707", port.name.span, message, help);
            return None;
        };
        let (part, name) = self.wire(wire)?;
        let schema = self.program.parts[part].schema;
        let Some(level) = schema.levels.iter().position(|level| level.name == name.value) else {
            let known: Vec<&str> = schema.levels.iter().map(|level| level.name).collect();
            let message = format!("a {} has no level `{}`", schema.name, name.value);
            self.report("E0707", name.span, message, known_or_none("its levels are", &known));
            return None;
        };
        let given = schema.levels[level].ty;
        let fits = fits(given, ty);
        if !fits || extent != Extent::One {
            let message = format!("the level `{}` has another type than the output", name.value);
            let help = match fits {
                true => format!("it takes one value, not a list: write `{}`", type_text(ty, Extent::One)),
                false => format!("write `{}`", type_text(given, Extent::One)),
            };
            self.report("E0707", port.ty.span, message, help);
            return None;
        }
        Some((declared(port, ty, extent, stop), Drives::Level { part, level }))
    }

    fn verbs(&mut self, tree: &ast::Device, ports: &[Port], wiring: &mut Wiring) -> Vec<Verb> {
        let outputs: Vec<&Port> = ports.iter().filter(|port| port.direction == Direction::Output).collect();
        let mut verbs: Vec<Verb> = Vec::new();
        for command in &tree.commands {
            let number = i32::try_from(command.number.value).ok().filter(|number| (1..=9).contains(number));
            let is_taken =
                verbs.iter().any(|verb| Some(verb.number) == number || verb.name == command.name.value);
            let Some(number) = number.filter(|_| !is_taken) else {
                let message = format!("the command `{}` has no number of its own", command.name.value);
                self.report(
                    "E0708",
                    command.number.span,
                    message,
                    "each has another name and a number from 1 to 9",
                );
                continue;
            };
            if let Some(command) = self.command(command, number, &outputs) {
                wiring.commands.push(command);
            }
            verbs.push(Verb {
                name: command.name.value.clone(),
                number,
                arguments: command.arguments.iter().map(|argument| argument.value.clone()).collect(),
                meaning: command.doc.join(" "),
            });
        }
        verbs
    }

    fn command(&mut self, tree: &ast::Command, number: i32, outputs: &[&Port]) -> Option<Command> {
        let part = self.part_of(0, &tree.part)?;
        let schema = self.program.parts[part].schema;
        let Some(action) = schema.actions.iter().position(|action| action.name == tree.action.value) else {
            let known: Vec<&str> = schema.actions.iter().map(|action| action.name).collect();
            let message = format!("a {} has no action `{}`", schema.name, tree.action.value);
            self.report("E0708", tree.action.span, message, known_or_none("its actions are", &known));
            return None;
        };
        let settings = &self.program.parts[part].settings;
        if (schema.name, &tree.action.value[..]) == ("chain", chain::ORIENTED)
            && !chain::has_joints(|setting| settings.iter().any(|given| given.name.value == setting))
        {
            let message = format!("no joint of this chain turns its tool for `{}`", chain::ORIENTED);
            self.report(
                "E0708",
                tree.action.span,
                message,
                "take `joints`: a Cartesian robot has no joints but its axes",
            );
            return None;
        }
        let mut arguments = Vec::new();
        let mut types = Vec::new();
        for name in &tree.given {
            let declared = tree.arguments.iter().any(|argument| argument.value == name.value);
            let output = outputs.iter().position(|port| port.name == name.value).filter(|_| declared);
            let Some(output) = output else {
                let message = format!("the argument `{}` of this command is not an output", name.value);
                self.report(
                    "E0708",
                    name.span,
                    message,
                    "declare it as `out`, and name it in the parentheses of the command",
                );
                return None;
            };
            arguments.push(output);
            types.push(outputs[output].ty);
        }
        let wanted = schema.actions[action].arguments;
        let is_fit = types.len() == wanted.len() && types.iter().zip(wanted).all(|(ty, arg)| fits(*arg, *ty));
        if !is_fit || tree.arguments.len() != tree.given.len() {
            let wanted: Vec<String> =
                schema.actions[action].arguments.iter().map(|ty| type_text(*ty, Extent::One)).collect();
            let message = format!("`{}` takes other arguments", tree.action.value);
            self.report("E0708", tree.action.span, message, format!("it takes ({})", wanted.join(", ")));
            return None;
        }
        let then = match &tree.then {
            None => None,
            Some(then) => Some(self.awaited(then)?),
        };
        Some(Command { number, part, action, arguments, then })
    }

    fn awaited(&mut self, tree: &ast::Await) -> Option<Await> {
        let (part, name) = self.wire(&tree.signal)?;
        let schema = self.program.parts[part].schema;
        let is_truth = |signal: usize| {
            schema.signals[signal].ty == PortType::Bool && schema.signals[signal].extent == Extent::One
        };
        let signal = schema.signals.iter().position(|signal| signal.name == name.value);
        let Some(signal) = signal.filter(|signal| is_truth(*signal)) else {
            let message = format!("a {} has no signal `{}` of type `bool`", schema.name, name.value);
            self.report("E0708", name.span, message, "await a signal of type `bool`");
            return None;
        };
        let ExprKind::Duration(within_ms) = tree.within.kind else {
            self.report(
                "E0708",
                tree.within.span,
                "a time is expected".into(),
                "write a time such as `500 ms`",
            );
            return None;
        };
        match tree.error.kind {
            ExprKind::Int(error @ 1..=255) => {
                Some(Await { part, signal, within_ms: within_ms as u64, error: error as i32 })
            }
            _ => {
                let message = "a command cannot end in this error".to_string();
                self.report("E0708", tree.error.span, message, "write a number from 1 to 255; 2 is: no part");
                None
            }
        }
    }
}

pub(super) fn known_or_none(what: &str, known: &[&str]) -> String {
    if known.is_empty() { "it has none".into() } else { format!("{what} {}", known.join(", ")) }
}

fn whole(expr: &ast::Expr) -> Option<i32> {
    match &expr.kind {
        ExprKind::Int(value) => i32::try_from(*value).ok(),
        ExprKind::Negate(inner) => whole(inner)?.checked_neg(),
        _ => None,
    }
}

/// Bounds of an `int` are the device's own: what a part gives beyond them is clamped, as every input is.
fn fits(given: PortType, declared: PortType) -> bool {
    match (given, declared) {
        (PortType::Int { .. }, PortType::Int { .. }) => true,
        (given, declared) => given == declared,
    }
}

fn size(port: &Port) -> Size {
    Size { each: port.ty.words(), extent: port.extent }
}

fn declared(port: &ast::Port, ty: PortType, extent: Extent, stop: Stop) -> Port {
    Port {
        name: port.name.value.clone(),
        place: Some(port.name.span),
        direction: port.direction,
        ty,
        extent,
        unit: port.unit.clone(),
        meaning: port.doc.join(" "),
        stop,
    }
}
