//! From the tree of a device to a [`Device`]: names, primitives, wires.

use super::program::{Part, Program, Scope, Setting, Symbol};
use super::{Constant, Device, Form, Handover, Parameter, Port, Verb, head, settle};
use crate::diagnostic::{Diagnostic, suggestion};
use crate::source::Span;
use crate::spec::ast::{self, ExprKind, Name, Scalar};
use runtime_sim::device::{Direction, Extent, PortType, Stop};
use runtime_sim::part::{ALL, Form as SettingForm, Schema};
use runtime_sim::wiring::{Await, Command, Drives, Input, Output, Size, Source, Wiring};
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// Devices and assemblies by their names.
pub type Declared<'a> = HashMap<&'a str, &'a ast::Device>;

/// Assemblies one in another.
const DEEPEST: usize = 8;
/// Elements of a port or a constant.
const MOST_ELEMENTS: i64 = 1024;
/// Parts of a device with all its assemblies.
const MOST_PARTS: usize = 1000;

/// Checks a device; all that is wrong with it is told.
pub fn check(tree: &ast::Device, declared: &Declared) -> Result<Arc<Device>, Vec<Diagnostic>> {
    let mut checker = Checker {
        declared,
        diagnostics: Vec::new(),
        program: Program { requires: tree.requires.clone(), ..Program::default() },
        parameters: Vec::new(),
    };
    checker.parameters(tree);
    checker.scope(tree, None, HashMap::new(), 0);
    let constants = checker.constants(tree);
    checker.program.places = tree.handovers.clone();
    let handovers = checker.handovers(tree);
    let (ports, verbs, wiring) = checker.wiring(tree);
    if checker.diagnostics.is_empty() && !tree.is_assembly {
        settle::settle(&mut checker.program);
        let values = tree.constants.iter().map(|constant| &constant.value);
        let constants: Vec<_> = constants.iter().cloned().zip(values).collect();
        checker.diagnostics = settle::wrong(&checker.program, &checker.parameters, &constants);
    }
    if !checker.diagnostics.is_empty() {
        return Err(checker.diagnostics);
    }
    Ok(Arc::new(Device {
        name: tree.name.value.clone(),
        purpose: tree.doc.join(" "),
        place: tree.name.span,
        parameters: checker.parameters,
        ports,
        verbs,
        constants,
        handovers,
        wiring: Arc::new(wiring),
        program: checker.program,
    }))
}

struct Checker<'a> {
    declared: &'a Declared<'a>,
    diagnostics: Vec<Diagnostic>,
    program: Program,
    parameters: Vec<Parameter>,
}

impl Checker<'_> {
    fn report(&mut self, code: &'static str, span: Span, message: String, help: impl Into<String>) {
        self.diagnostics.push(Diagnostic::new(code, span, message).help(help.into()));
    }

    /// What an assembly is given is not for layouts.
    fn parameters(&mut self, tree: &ast::Device) {
        if tree.is_assembly {
            return;
        }
        for parameter in &tree.parameters {
            if let Some(form) = self.form(parameter) {
                self.parameters.push(Parameter { name: parameter.name.value.clone(), form });
            }
        }
    }

    fn form(&mut self, parameter: &ast::DeviceParameter) -> Option<Form> {
        let size = match &parameter.ty.extent {
            None => None,
            Some(ast::Expr { kind: ExprKind::Int(size), .. }) => Some(*size),
            Some(_) => Some(-1),
        };
        let count = parameter.elements.len() as i64;
        let form = match (&parameter.ty.scalar, size) {
            (Scalar::Named(name), None) if name.value == "axis" => Some(Form::Axis),
            (Scalar::Named(name), None) if name.value == "range" => Some(Form::Range),
            (Scalar::Real, None) => Some(Form::Real),
            (Scalar::Point, None) => Some(Form::Point),
            (Scalar::Point, Some(size)) if size == count && count > 0 => {
                Some(Form::Points(parameter.elements.clone()))
            }
            _ => None,
        };
        if form.is_none() {
            self.report(
                "E0701",
                parameter.ty.span,
                format!("the layout cannot give `{}` this type", parameter.name.value),
                "types are `axis`, `range`, `real`, `point` and `point[2] of \"first\", \"second\"`",
            );
        }
        form
    }

    /// The names of a device or an assembly, and its parts; its own number.
    fn scope(
        &mut self,
        tree: &ast::Device,
        parent: Option<usize>,
        arguments: HashMap<String, ast::Expr>,
        depth: usize,
    ) -> usize {
        let scope = self.program.scopes.len();
        self.program.scopes.push(Scope { parent, names: HashMap::new() });
        let mut arguments = arguments;
        for (number, parameter) in tree.parameters.iter().enumerate() {
            let symbol = match arguments.remove(&parameter.name.value) {
                Some(argument) => Symbol::Argument(argument),
                None => Symbol::Parameter(number),
            };
            self.declare(scope, &parameter.name, symbol);
        }
        for member in &tree.members {
            match member {
                ast::DeviceMember::Define(define) => {
                    self.declare(scope, &define.name, Symbol::Define(define.value.clone()));
                }
                ast::DeviceMember::Part(part) => self.part(scope, part, depth),
            }
        }
        scope
    }

    fn declare(&mut self, scope: usize, name: &Name, symbol: Symbol) {
        const BUILT_IN: [&str; 4] = ["pose", "kind_heights", "index", "pi"];
        let names = &mut self.program.scopes[scope].names;
        if names.contains_key(&name.value) || BUILT_IN.contains(&name.value.as_str()) {
            let message = format!("`{}` names something here already", name.value);
            self.report("E0701", name.span, message, "choose another name");
            return;
        }
        names.insert(name.value.clone(), symbol);
    }

    fn part(&mut self, scope: usize, part: &ast::Part, depth: usize) {
        let given: HashSet<&str> = part.settings.iter().map(|(name, _)| name.value.as_str()).collect();
        if given.len() < part.settings.len() {
            let twice = part.settings.iter().enumerate().find(|(i, (name, _))| {
                part.settings[..*i].iter().any(|(before, _)| before.value == name.value)
            });
            if let Some((_, (name, _))) = twice {
                let message = format!("the setting `{}` stands here twice", name.value);
                self.report("E0703", name.span, message, "remove one");
            }
        }
        if let Some(schema) = Schema::find(&part.kind.value) {
            self.settings(part, schema);
            let index = self.program.parts.len();
            if self.program.parts.iter().any(|other| other.name.value == part.name.value) {
                let message = format!("two parts of the device are called `{}`", part.name.value);
                self.report(
                    "E0701",
                    part.name.span,
                    message,
                    "parts of assemblies count too: choose another name",
                );
            }
            if index == MOST_PARTS {
                let message = format!("a device has at most {MOST_PARTS} parts");
                self.report("E0702", part.name.span, message, "make several devices of it");
            }
            if index >= MOST_PARTS {
                return;
            }
            self.program.parts.push(Part {
                name: part.name.clone(),
                schema,
                settings: part.settings.iter().map(unknown).collect(),
                scope,
                known: None,
            });
            self.declare(scope, &part.name, Symbol::Part(index));
            self.references(scope, part, schema);
            return;
        }
        match self.declared.get(part.kind.value.as_str()).filter(|assembly| assembly.is_assembly) {
            Some(assembly) if depth < DEEPEST => {
                let wanted: Vec<&str> =
                    assembly.parameters.iter().map(|parameter| parameter.name.value.as_str()).collect();
                for (name, _) in
                    part.settings.iter().filter(|(name, _)| !wanted.contains(&name.value.as_str()))
                {
                    let message = format!("`{}` has no parameter `{}`", part.kind.value, name.value);
                    self.report("E0703", name.span, message, format!("it has {}", wanted.join(", ")));
                }
                for lacking in wanted.iter().filter(|name| !given.contains(**name)) {
                    let message = format!("the parameter `{lacking}` of `{}` is missing", part.kind.value);
                    self.report("E0703", part.name.span, message, "give it a value in the braces");
                }
                let arguments = part.settings.iter();
                let arguments = arguments.map(|(name, value)| (name.value.clone(), value.clone())).collect();
                let inner = self.scope(assembly, Some(scope), arguments, depth + 1);
                self.declare(scope, &part.name, Symbol::Assembly(inner));
            }
            Some(_) => self.report(
                "E0705",
                part.kind.span,
                format!("more than {DEEPEST} assemblies stand in one another"),
                "an assembly cannot hold itself",
            ),
            None => {
                let assemblies = self.declared.values().filter(|device| device.is_assembly);
                let mut known: Vec<&str> = ALL.iter().map(|schema| schema.name).collect();
                known.extend(assemblies.map(|assembly| assembly.name.value.as_str()));
                known.sort_unstable();
                let help = match suggestion(&part.kind.value, known.iter().copied()) {
                    Some(near) => format!("is `{near}` meant?"),
                    None => format!("primitives and assemblies are {}", known.join(", ")),
                };
                let message = format!("`{}` is neither a primitive nor an assembly", part.kind.value);
                self.report("E0702", part.kind.span, message, help);
            }
        }
    }

    /// Every setting is known, and none is missing.
    fn settings(&mut self, part: &ast::Part, schema: &'static Schema) {
        for (name, _) in &part.settings {
            if schema.settings.iter().all(|setting| setting.name != name.value) {
                let known = schema.settings.iter().map(|setting| setting.name);
                let help = match suggestion(&name.value, known.clone()) {
                    Some(near) => format!("is `{near}` meant?"),
                    None => format!("it has {}", known.collect::<Vec<_>>().join(", ")),
                };
                let message = format!("a {} has no setting `{}`", schema.name, name.value);
                self.report("E0703", name.span, message, help);
            }
        }
        for setting in schema.settings.iter().filter(|setting| !setting.is_optional) {
            if part.settings.iter().all(|(name, _)| name.value != setting.name) {
                let message = format!("the setting `{}` of `{}` is missing", setting.name, part.name.value);
                self.report(
                    "E0703",
                    part.name.span,
                    message,
                    format!("{}: {}", setting.name, setting.meaning),
                );
            }
        }
    }

    /// A part refers to parts before it only: whose names are known by now.
    fn references(&mut self, scope: usize, part: &ast::Part, schema: &'static Schema) {
        for (name, expr) in &part.settings {
            let setting = schema.settings.iter().find(|setting| setting.name == name.value);
            let Some(SettingForm::Part(primitives)) = setting.map(|setting| setting.form) else { continue };
            if let ExprKind::Name(other) = &expr.kind {
                let known = &self.program.scopes[scope].names;
                let is_itself = *other == part.name.value;
                if is_itself || !known.contains_key(other) {
                    let message = match is_itself {
                        true => format!("`{other}` hangs on itself"),
                        false => format!("there is no part `{other}` before this one"),
                    };
                    let help =
                        format!("name a part that is declared before: a {}", primitives.join(" or a "));
                    self.report("E0705", expr.span, message, help);
                }
            }
        }
    }

    fn constants(&mut self, tree: &ast::Device) -> Vec<Constant> {
        let mut constants = Vec::new();
        for constant in &tree.constants {
            self.declare(0, &constant.name, Symbol::Define(constant.value.clone()));
            let Some((ty, extent)) = self.port_type(&constant.ty) else { continue };
            constants.push(Constant {
                name: constant.name.value.clone(),
                ty,
                extent,
                unit: constant.unit.clone(),
                meaning: constant.doc.join(" "),
            });
        }
        constants
    }

    fn handovers(&mut self, tree: &ast::Device) -> Vec<Handover> {
        let mut handovers: Vec<Handover> = Vec::new();
        for place in &tree.handovers {
            if handovers.iter().any(|other| other.name == place.name.value) {
                let message = format!("the place `{}` is declared twice", place.name.value);
                self.report("E0701", place.name.span, message, "choose another name");
            }
            let indexed = match &place.extent {
                None => None,
                Some(ast::Expr { kind: ExprKind::Int(n), .. }) if (1..=MOST_ELEMENTS).contains(n) => {
                    Some(*n as usize)
                }
                Some(expr) => {
                    self.report(
                        "E0709",
                        expr.span,
                        "this is no number of places".into(),
                        "write a whole number",
                    );
                    None
                }
            };
            for (_, title) in &place.points {
                let rest = ["{index}", "{number}", "{kind}"]
                    .iter()
                    .fold(title.value.clone(), |text, part| text.replace(part, ""));
                if rest.contains(['{', '}']) {
                    let message = "a place is called by `{index}`, `{number}` and `{kind}`".to_string();
                    self.report("E0709", title.span, message, "correct what stands in the braces");
                }
            }
            handovers.push(Handover { name: place.name.value.clone(), indexed });
        }
        handovers
    }

    fn port_type(&mut self, ty: &ast::Type) -> Option<(PortType, Extent)> {
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
            Some(ast::Expr { kind: ExprKind::Int(n), .. }) if (1..=MOST_ELEMENTS).contains(n) => {
                Some(Extent::Times(*n as usize))
            }
            Some(_) => None,
        };
        if scalar.is_none() || extent.is_none() {
            self.report(
                "E0709",
                ty.span,
                "no port or constant has this type".into(),
                "types are `bool`, `int 0..12`, `real` and `point`, also with `[12]` or `[Kind]` behind them",
            );
        }
        Some((scalar?, extent?))
    }

    /// The part and the name behind it, in an expression such as `arm.joints.tool`.
    fn wire<'t>(&mut self, expr: &'t ast::Expr) -> Option<(usize, &'t Name)> {
        let ExprKind::Member(base, name) = &expr.kind else {
            let message = "a signal or a level of a part is wanted".to_string();
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
        self.report("E0706", expr.span, "this is no part".into(), "name a part of this device");
        None
    }

    fn assembly_of(&mut self, scope: usize, expr: &ast::Expr) -> Option<usize> {
        if let ExprKind::Name(name) = &expr.kind
            && let Some(Symbol::Assembly(inner)) = self.program.scopes[scope].names.get(name)
        {
            return Some(*inner);
        }
        self.report("E0706", expr.span, "this is no assembly".into(), "name an assembly of this device");
        None
    }

    fn wiring(&mut self, tree: &ast::Device) -> (Vec<Port>, Vec<Verb>, Wiring) {
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
            for (port, drives) in head::outputs() {
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
        for (index, port) in tree.ports.iter().enumerate() {
            let is_head = head::inputs()
                .iter()
                .map(|(p, _)| p.name.clone())
                .chain(head::outputs().iter().map(|(p, _)| p.name.clone()))
                .any(|name| name == port.name.value);
            let is_twice = tree.ports[..index].iter().any(|other| other.name.value == port.name.value)
                || tree.constants.iter().any(|other| other.name.value == port.name.value);
            if is_twice || is_head && !tree.commands.is_empty() {
                let message = format!("`{}` names something here already", port.name.value);
                self.report("E0701", port.name.span, message, "choose another name");
            }
        }
        let verbs = self.verbs(tree, &ports, &mut wiring);
        (ports, verbs, wiring)
    }

    fn input(&mut self, port: &ast::Port) -> Option<(Port, Source)> {
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
        let stop = match port.stop.as_ref().map(|stop| &stop.kind) {
            None => Stop::Hold,
            Some(ExprKind::Bool(value)) => Stop::Value(f64::from(u8::from(*value))),
            Some(ExprKind::Int(value)) => Stop::Value(*value as f64),
            Some(ExprKind::Real(value)) => Stop::Value(*value),
            Some(_) => {
                let span = port.stop.as_ref().map_or(port.name.span, |stop| stop.span);
                let message = "what is published while the system does not run is a number".to_string();
                self.report("E0707", span, message, "write `stop false` or `stop 0`");
                Stop::Hold
            }
        };
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
        if !fits(schema.levels[level].ty, ty) || extent != Extent::One {
            let message = format!("the level `{}` has another type than the output", name.value);
            let help = format!("write `{}`", type_text(schema.levels[level].ty, Extent::One));
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
        let mut arguments = Vec::new();
        let mut types = Vec::new();
        for name in &tree.given {
            let declared = tree.arguments.iter().any(|argument| argument.value == name.value);
            let output = outputs.iter().position(|port| port.name == name.value).filter(|_| declared);
            let Some(output) = output else {
                let message = format!("`{}` is no argument of this command that is an output", name.value);
                self.report(
                    "E0708",
                    name.span,
                    message,
                    "declare it as `out`, and name it behind the command",
                );
                return None;
            };
            arguments.push(output);
            types.push(outputs[output].ty);
        }
        if types != schema.actions[action].arguments || tree.arguments.len() != tree.given.len() {
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
            let message = format!("a {} has no signal `{}` that is true or false", schema.name, name.value);
            self.report("E0708", name.span, message, "await a signal of type `bool`");
            return None;
        };
        let ExprKind::Duration(within_ms) = tree.within.kind else {
            self.report("E0708", tree.within.span, "a time is wanted".into(), "write such as `500 ms`");
            return None;
        };
        match tree.error.kind {
            ExprKind::Int(error @ 1..=255) => {
                Some(Await { part, signal, within_ms: within_ms as u64, error: error as i32 })
            }
            _ => {
                let message = "this is no error that a command can end in".to_string();
                self.report("E0708", tree.error.span, message, "write a number from 1 to 255; 2 is: no part");
                None
            }
        }
    }
}

fn unknown((name, value): &(Name, ast::Expr)) -> Setting {
    Setting { name: name.clone(), value: value.clone(), known: None }
}

fn known_or_none(what: &str, known: &[&str]) -> String {
    if known.is_empty() { "it has none".into() } else { format!("{what} {}", known.join(", ")) }
}

fn whole(expr: &ast::Expr) -> Option<i32> {
    match &expr.kind {
        ExprKind::Int(value) => i32::try_from(*value).ok(),
        ExprKind::Negate(inner) => whole(inner)?.checked_neg(),
        _ => None,
    }
}

/// Whether an `int` of the text holds all that a part gives.
fn fits(given: PortType, declared: PortType) -> bool {
    match (given, declared) {
        (PortType::Int { .. }, PortType::Int { .. }) => true,
        (given, declared) => given == declared,
    }
}

fn type_text(ty: PortType, extent: Extent) -> String {
    let scalar = match ty {
        PortType::Bool => "bool".to_string(),
        PortType::Int { lo, hi } => format!("int {lo}..{hi}"),
        PortType::Real => "real".into(),
        PortType::Point => "point".into(),
    };
    match extent {
        Extent::One => scalar,
        Extent::PerKind => format!("{scalar}[Kind]"),
        Extent::Times(n) => format!("{scalar}[{n}]"),
    }
}

fn size(port: &Port) -> Size {
    Size { each: port.ty.words(), extent: port.extent }
}

fn declared(port: &ast::Port, ty: PortType, extent: Extent, stop: Stop) -> Port {
    Port {
        name: port.name.value.clone(),
        direction: port.direction,
        ty,
        extent,
        unit: port.unit.clone(),
        meaning: port.doc.join(" "),
        stop,
    }
}
