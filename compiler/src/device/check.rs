//! From the tree of a device to a [`Device`]: its names, its parts and their settings.

use super::evaluate::Found;
use super::panel;
use super::program::{Part, Program, Scope, Setting, Symbol};
use super::wires::known_or_none;
use super::{Constant, Device, Form, Handover, Parameter, settle};
use crate::diagnostic::{Diagnostic, suggestion};
use crate::layout::object::is_common;
use crate::source::Span;
use crate::spec::ast::{self, ExprKind, Name, Scalar};
use runtime_sim::machine::MOST_ELEMENTS;
use runtime_sim::part::{self, ALL, Form as SettingForm, Schema};
use runtime_sim::value::Value;
use rustc_hash::FxHashMap;
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// Devices and assemblies by their names.
pub type Declared<'a> = HashMap<&'a str, &'a ast::Device>;

/// Assemblies one in another.
const DEEPEST: usize = 8;
/// Names that every expression has.
const BUILT_IN: [&str; 6] = ["pose", "origin", "kind_heights", "kind_grasps", "index", "pi"];
/// Parts of a device with all its assemblies.
const MOST_PARTS: usize = 1000;

/// Checks a device; all that is wrong with it is reported.
pub fn check(tree: &ast::Device, declared: &Declared) -> Result<Arc<Device>, Vec<Diagnostic>> {
    let mut checker = Checker {
        declared,
        diagnostics: Vec::new(),
        program: Program { requires: tree.requires.clone(), ..Program::default() },
        parameters: Vec::new(),
    };
    checker.parameters(tree);
    let is_time = |parameter: &(usize, &Parameter)| parameter.1.form == Form::Time;
    checker.program.times =
        checker.parameters.iter().enumerate().filter(is_time).map(|(number, _)| number).collect();
    checker.program.routes = checker.parameters.iter().position(|parameter| parameter.form == Form::Routes);
    checker.routes(tree);
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
        can_turn: checker.program.mentions("origin"),
        program: checker.program,
    }))
}

pub(super) struct Checker<'a> {
    declared: &'a Declared<'a>,
    diagnostics: Vec<Diagnostic>,
    pub(super) program: Program,
    parameters: Vec<Parameter>,
}

impl Checker<'_> {
    pub(super) fn report(
        &mut self,
        code: &'static str,
        span: Span,
        message: String,
        help: impl Into<String>,
    ) {
        self.diagnostics.push(Diagnostic::new(code, span, message).help(help.into()));
    }

    /// What an assembly is given is not for layouts.
    fn parameters(&mut self, tree: &ast::Device) {
        if tree.is_assembly {
            return;
        }
        for parameter in &tree.parameters {
            let key = &parameter.name;
            if is_common(&key.value) && !BUILT_IN.contains(&key.value.as_str()) {
                let message = format!("`{}` is a key of every machine of a layout", key.value);
                self.report("E0701", key.span, message, panel::another_name(&key.value));
            }
            if let Some(form) = self.form(parameter) {
                let default = self.default(parameter, &form);
                let (name, meaning) = (parameter.name.value.clone(), parameter.doc.join(" "));
                self.parameters.push(Parameter { name, meaning, form, default });
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
            (Scalar::Named(name), None) if name.value == "routes" => Some(Form::Routes),
            (Scalar::Named(name), None) if name.value == "node" => Some(Form::Node),
            (Scalar::Real, None) => Some(Form::Real),
            (Scalar::Time, None) => Some(Form::Time),
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
                format!("a layout has no value of this type for `{}`", parameter.name.value),
                "types are `axis`, `range`, `real`, `time`, `point`, `routes`, `node` and `point[2] of \"first\", \"second\"`",
            );
        }
        form
    }

    /// Nodes are those of the only routes.
    fn routes(&mut self, tree: &ast::Device) {
        let form_of = |parameter: &ast::DeviceParameter| {
            let known = self.parameters.iter().find(|known| known.name == parameter.name.value);
            known.map(|known| known.form.clone())
        };
        let of = |form: Form| {
            tree.parameters.iter().filter(move |parameter| form_of(parameter) == Some(form.clone()))
        };
        let all: Vec<&ast::DeviceParameter> = of(Form::Routes).collect();
        let nodes: Vec<&ast::DeviceParameter> = of(Form::Node).collect();
        if let Some(second) = all.get(1) {
            let message = format!("`{}` is a second parameter of type `routes`", second.name.value);
            self.report(
                "E0701",
                second.name.span,
                message,
                "a machine drives on one graph: leave one of them",
            );
        }
        if let Some(node) = nodes.first().filter(|_| all.is_empty()) {
            let message = format!("`{}` is a node, and the device has no routes", node.name.value);
            self.report("E0701", node.name.span, message, "add `parameter NAME: routes;` before it");
        }
    }

    /// What a machine has whose object lacks the key.
    fn default(&mut self, parameter: &ast::DeviceParameter, form: &Form) -> Option<Value> {
        let expr = parameter.default.as_ref()?;
        let nothing = Program { scopes: vec![Scope::default()], ..Program::default() };
        let found = settle::known(&nothing, expr);
        let fits = match (form, &found) {
            (Form::Real, Ok(Found::Value(Value::Number(_))))
            | (Form::Point, Ok(Found::Value(Value::Point(_)))) => true,
            (Form::Time, Ok(Found::Duration(ms))) => *ms >= 0,
            _ => false,
        };
        match found {
            Ok(Found::Value(value)) if fits => Some(value),
            Ok(Found::Duration(ms)) if fits => Some(Value::Number(ms as f64)),
            _ => {
                let message = format!("`{}` cannot have this value by default", parameter.name.value);
                let help = match form {
                    Form::Time => "write a time with its unit, such as `6 s` or `250 ms`",
                    _ => {
                        "only a `real`, a `time` or a `point` has a default: a number, a time such as `2 s`, or `point(x, y, z)`"
                    }
                };
                self.report("E0701", expr.span, message, help);
                None
            }
        }
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
        self.program.scopes.push(Scope { parent, names: FxHashMap::default() });
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
        let names = &mut self.program.scopes[scope].names;
        if names.contains_key(&name.value) || BUILT_IN.contains(&name.value.as_str()) {
            let message = format!("`{}` is already a name in this device", name.value);
            self.report("E0701", name.span, message, panel::another_name(&name.value));
            return;
        }
        names.insert(name.value.clone(), symbol);
    }

    fn part(&mut self, scope: usize, part: &ast::Part, depth: usize) {
        let mut given = HashSet::new();
        for (name, _) in &part.settings {
            if !given.insert(name.value.as_str()) {
                let message = format!("the setting `{}` occurs here twice", name.value);
                self.report("E0703", name.span, message, "remove one");
            }
        }
        let kind = part.kind.value.as_str();
        let assembly = self.declared.get(kind).copied().filter(|device| device.is_assembly);
        match (Schema::find(kind), assembly) {
            (Some(schema), _) => self.primitive(scope, part, schema),
            (None, Some(assembly)) => self.assembly(scope, part, assembly, depth),
            (None, None) => {
                let assemblies = self.declared.values().filter(|device| device.is_assembly);
                let mut known: Vec<&str> = ALL.iter().map(|schema| schema.name).collect();
                known.extend(assemblies.map(|assembly| assembly.name.value.as_str()));
                known.sort_unstable();
                let help = match suggestion(kind, known.iter().copied()) {
                    Some(near) => format!("is `{near}` meant?"),
                    None => format!("primitives and assemblies are {}", known.join(", ")),
                };
                let message = format!("`{kind}` is neither a primitive nor an assembly");
                self.report("E0702", part.kind.span, message, help);
            }
        }
    }

    fn primitive(&mut self, scope: usize, part: &ast::Part, schema: &'static Schema) {
        self.settings(part, schema);
        let index = self.program.parts.len();
        if self.program.parts.iter().any(|other| other.name.value == part.name.value) {
            let message = format!("two parts of the device are called `{}`", part.name.value);
            let help = "parts of assemblies count too: choose another name";
            self.report("E0701", part.name.span, message, help);
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
    }

    fn assembly(&mut self, scope: usize, part: &ast::Part, assembly: &ast::Device, depth: usize) {
        if depth >= DEEPEST {
            let message = format!("more than {DEEPEST} assemblies are nested");
            self.report("E0705", part.kind.span, message, "an assembly cannot contain itself");
            return;
        }
        let wanted = assembly.parameters.iter().map(|parameter| parameter.name.value.as_str());
        let wanted: Vec<&str> = wanted.collect();
        for (name, _) in &part.settings {
            if !wanted.contains(&name.value.as_str()) {
                let message = format!("`{}` has no parameter `{}`", part.kind.value, name.value);
                self.report("E0703", name.span, message, known_or_none("it has", &wanted));
            }
        }
        for lacking in wanted {
            if part.settings.iter().all(|(name, _)| name.value != lacking) {
                let message = format!("the parameter `{lacking}` of `{}` is missing", part.kind.value);
                self.report("E0703", part.name.span, message, "give it a value in the braces");
            }
        }
        let arguments = part.settings.iter().map(|(name, value)| (name.value.clone(), value.clone()));
        let inner = self.scope(assembly, Some(scope), arguments.collect(), depth + 1);
        self.declare(scope, &part.name, Symbol::Assembly(inner));
    }

    /// Every setting is known, and none is missing.
    fn settings(&mut self, part: &ast::Part, schema: &'static Schema) {
        for (name, _) in &part.settings {
            if schema.setting(&name.value).is_none() {
                let known: Vec<&str> = schema.settings.iter().map(|setting| setting.name).collect();
                let help = match suggestion(&name.value, known.iter().copied()) {
                    Some(near) => format!("is `{near}` meant?"),
                    None => known_or_none("it has", &known),
                };
                let message = format!("a {} has no setting `{}`", schema.name, name.value);
                self.report("E0703", name.span, message, help);
            }
        }
        let is_missing = |setting: &&part::Setting| {
            !setting.is_optional && part.settings.iter().all(|(name, _)| name.value != setting.name)
        };
        let missing: Vec<&part::Setting> = schema.settings.iter().filter(is_missing).collect();
        if missing.is_empty() {
            return;
        }
        let names: Vec<String> = missing.iter().map(|setting| format!("`{}`", setting.name)).collect();
        let message = match &names[..] {
            [name] => format!("the setting {name} of `{}` is missing", part.name.value),
            names => format!("the settings {} of `{}` are missing", names.join(", "), part.name.value),
        };
        let meanings: Vec<String> =
            missing.iter().map(|setting| format!("{}: {}", setting.name, setting.meaning)).collect();
        self.report("E0703", part.name.span, message, meanings.join("; "));
    }

    /// A part refers to parts before it only: whose names are known by now.
    fn references(&mut self, scope: usize, part: &ast::Part, schema: &'static Schema) {
        for (name, expr) in &part.settings {
            let form = schema.setting(&name.value).map(|setting| setting.form);
            let Some(SettingForm::Part(primitives)) = form else { continue };
            if let ExprKind::Name(other) = &expr.kind {
                let known = &self.program.scopes[scope].names;
                let is_itself = *other == part.name.value;
                if is_itself || !known.contains_key(other) {
                    let message = match is_itself {
                        true => format!("`{other}` is carried by itself"),
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
                Some(ast::Expr { kind: ExprKind::Int(n), .. }) if (1..=MOST_ELEMENTS as i64).contains(n) => {
                    Some(*n as usize)
                }
                Some(expr) => {
                    self.report(
                        "E0709",
                        expr.span,
                        "this is not a number of places".into(),
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
                    let message = "the text of a place has `{index}`, `{number}` and `{kind}`".to_string();
                    self.report("E0709", title.span, message, "correct the text in the braces");
                }
            }
            handovers.push(Handover { name: place.name.value.clone(), indexed });
        }
        handovers
    }
}

fn unknown((name, value): &(Name, ast::Expr)) -> Setting {
    Setting { name: name.clone(), value: value.clone(), known: None }
}
