//! The module of one type of automaton.

use super::context::Context;
use super::doc::{doc, documented};
use super::format::Unformatted;
use super::modes;
use super::property;
use super::render;
use super::retained;
use super::walk::Uses;
use crate::device::Port;
use crate::ir::{Extent, KeptBy, RoleKind, Scalar, Type, Value};
use askama::Template;
use runtime_sim::device::{Direction, PortType, Stop};

#[derive(Template)]
#[template(path = "rust/controllers/automaton.rs")]
struct Module {
    title: String,
    about: Vec<String>,
    device: String,
    ty: String,
    parameters: Vec<Field>,
    states: Vec<Field>,
    inputs: Vec<Field>,
    limits: Vec<String>,
    outputs: Vec<Field>,
    stops: Vec<String>,
    holds_all: bool,
    verbs: Vec<Field>,
    locals: Vec<Field>,
    first_state: String,
    step_parameters: String,
    arms: Vec<String>,
    methods: Vec<String>,
    defines: Vec<String>,
    commands: bool,
    done: bool,
    failed: bool,
    checks: property::Checks,
    property_parameters: String,
    /// Outputs of which properties see what is put out.
    masks: Vec<String>,
    /// Properties keep something from scan to scan.
    remembers: bool,
    anew: Vec<String>,
    counters: Vec<String>,
    alarms: Vec<String>,
    can_stop: bool,
    modes: Option<modes::Methods>,
    /// A local.
    abandoned: Option<String>,
    /// The same.
    interrupted: Option<String>,
    retained: Option<retained::Methods>,
    /// With a comma before it.
    cells_parameter: &'static str,
    /// Statements that set the initial values of its own cells.
    own_cells: Vec<String>,
}

struct Field {
    doc: String,
    name: String,
    ty: String,
    initial: String,
}

pub fn module(context: &Context) -> Unformatted {
    let automaton = context.automaton();
    let names = context.own();
    let device = &automaton.device;
    let ports = |direction: Direction| {
        device.ports.iter().zip(&names.ports).filter(move |(p, _)| p.direction == direction)
    };
    let mut methods = Vec::new();
    let mut arms = Vec::new();
    let mut uses = Uses { wiring: true, ..Uses::default() };
    let mut commands = false;
    for number in 0..automaton.states.len() {
        let state = context.state(number);
        arms.push(state.arm);
        methods.push(state.text);
        commands |= state.commands;
        uses.join(state.uses);
    }
    commands |= automaton.modes.is_some() && device.is_commanded();
    let mut asked = uses.clone();
    asked.join(property::uses(context));
    automaton.defines.iter().for_each(|d| asked.expr(automaton, &d.value));
    let stops: Vec<String> =
        ports(Direction::Output).filter_map(|(port, name)| stop(context, port, name)).collect();
    let module = Module {
        title: format!(
            "{}: the logic of every `{}`. Made by autogen from {}.",
            names.ty,
            automaton.name,
            documented(&context.line(automaton.place))
        ),
        about: automaton.doc.iter().map(|line| documented(line)).collect(),
        device: documented(&format!("`{}`: {}", device.name, device.purpose)),
        ty: names.ty.clone(),
        parameters: parameters(context),
        states: automaton
            .states
            .iter()
            .zip(&names.states)
            .map(|(s, name)| plain(doc(&s.doc), name))
            .collect(),
        inputs: ports(Direction::Input).map(|(p, name)| port_field(context, p, name)).collect(),
        limits: ports(Direction::Input).filter_map(|(p, name)| limit(p, name)).collect(),
        outputs: ports(Direction::Output).map(|(p, name)| port_field(context, p, name)).collect(),
        holds_all: !stops.is_empty() && stops.len() == ports(Direction::Output).count(),
        stops,
        verbs: device
            .verbs
            .iter()
            .zip(&names.verbs)
            .map(|(v, name)| Field {
                initial: v.number.to_string(),
                ..plain(doc(&[sentence(&v.meaning)]), name)
            })
            .collect(),
        locals: automaton
            .locals
            .iter()
            .zip(&names.locals)
            .map(|(l, name)| Field {
                doc: match l.kept_by {
                    KeptBy::Steps | KeptBy::Modes => doc(&l.doc),
                    KeptBy::Properties => doc(&["Stored value of a property.".into()]),
                },
                name: name.clone(),
                ty: context.ty(l.ty),
                initial: context.filled(l.ty, l.initial),
            })
            .collect(),
        first_state: names.states.first().cloned().unwrap_or_default(),
        step_parameters: context.parameters(&uses),
        arms,
        methods,
        defines: (0..automaton.defines.len()).map(|i| define(context, i)).collect(),
        commands,
        done: asked.done,
        failed: asked.failed,
        checks: property::checks(context),
        property_parameters: context.parameters(&property::uses(context)),
        masks: automaton.masked.iter().map(|port| names.ports[*port].clone()).collect(),
        remembers: property::remembers(automaton),
        anew: property::anew(context),
        counters: property::counters(context),
        alarms: property::alarms(context),
        can_stop: automaton.can_stop(),
        modes: modes::methods(context),
        abandoned: automaton.abandoned.map(|local| names.locals[local].clone()),
        interrupted: automaton.interrupted.map(|local| names.locals[local].clone()),
        retained: retained::methods(context),
        cells_parameter: retained::cells_parameter(context, "&mut "),
        own_cells: retained::own_cells(context),
    };
    Unformatted::Module(render(&module), context.importable("crate"))
}

fn plain(doc: String, name: &str) -> Field {
    Field { doc, name: name.into(), ty: String::new(), initial: String::new() }
}

fn parameters(context: &Context) -> Vec<Field> {
    let automaton = context.automaton();
    let names = context.own();
    let field = |doc: String, name: &String, ty: String| Field {
        doc,
        name: name.clone(),
        ty,
        initial: String::new(),
    };
    let values = automaton.parameters.iter().zip(&names.parameters);
    let roles = automaton.roles.iter().zip(&names.roles);
    let rows = automaton.implements.iter().zip(&names.rows);
    let reference = |id: crate::ir::InterfaceId| context.scalar(Scalar::Ref(id));
    (values.map(|(p, name)| field(doc(&p.doc), name, context.ty(p.ty))))
        .chain(roles.map(|(r, name)| {
            let about = if r.doc.is_empty() { doc(&[role_doc(r.kind).into()]) } else { doc(&r.doc) };
            field(about, name, format!("&'a [{}]", reference(r.interface)))
        }))
        .chain(rows.map(|(i, name)| {
            let about = format!("Its own row as `{}`.", context.system.model.interface(i.interface).name);
            field(doc(&[about]), name, reference(i.interface))
        }))
        .collect()
}

fn role_doc(kind: RoleKind) -> &'static str {
    match kind {
        RoleKind::Takes => "Those within reach that offer items.",
        RoleKind::Hands => "Those within reach that accept items.",
        RoleKind::Serves => "Those to which items can get from here.",
        RoleKind::Knows => "All other members.",
    }
}

/// The value of a port at power-up.
pub fn first_value(context: &Context, port: &Port) -> String {
    let ty = Type { scalar: Scalar::from(port.ty), extent: Extent::from(port.extent) };
    let first = match port.ty {
        PortType::Bool => Value::Bool(false),
        PortType::Int { lo, hi } => Value::Int(0.clamp(lo, hi)),
        PortType::Real => Value::Real(0.0),
        PortType::Point => Value::Point([0.0; 3]),
    };
    context.filled(ty, first)
}

fn port_field(context: &Context, port: &Port, name: &str) -> Field {
    let ty = Type { scalar: Scalar::from(port.ty), extent: Extent::from(port.extent) };
    let text = sentence(&port.about(", in "));
    let initial = first_value(context, port);
    Field { doc: doc(&[text]), name: name.into(), ty: context.ty(ty), initial }
}

/// With a capital and a full stop, if there is a text.
fn sentence(text: &str) -> String {
    if text.is_empty() {
        return String::new();
    }
    let mut letters = text.chars();
    let first: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
    format!("{first}{}.", letters.as_str())
}

fn limit(port: &Port, name: &str) -> Option<String> {
    let PortType::Int { lo, hi } = port.ty else { return None };
    Some(match Extent::from(port.extent) {
        Extent::One => format!("self.{name} = self.{name}.clamp({lo}, {hi});"),
        _ => format!("for element in &mut self.{name}.0 {{ *element = (*element).clamp({lo}, {hi}); }}"),
    })
}

fn stop(context: &Context, port: &Port, name: &str) -> Option<String> {
    let Stop::Value(value) = port.stop else { return None };
    let ty = Type { scalar: Scalar::from(port.ty), extent: Extent::from(port.extent) };
    let value = match port.ty {
        PortType::Bool => Value::Bool(value != 0.0),
        PortType::Int { .. } => Value::Int(value as i32),
        PortType::Real => Value::Real(value),
        PortType::Point => Value::Point([value; 3]),
    };
    Some(format!("{name}: {},", context.filled(ty, value)))
}

fn define(context: &Context, number: usize) -> String {
    let define = &context.automaton().defines[number];
    let uses = Uses::of_expr(context.automaton(), &define.value);
    let parameters = context.parameters(&uses);
    let separator = if parameters.is_empty() { "" } else { ", " };
    let mut about = define.doc.clone();
    about.push(format!("`{}`, {}", define.name, context.line(define.place)));
    format!(
        "{}pub fn {}(&self{separator}{parameters}) -> {} {{ {} }}",
        doc(&about),
        context.own().defines[number],
        context.scalar(define.ty),
        context.expr(&define.value)
    )
}

/// What a step needs beside the robot.
pub fn step_uses(context: &Context) -> Uses {
    let mut uses = Uses { wiring: true, ..Uses::default() };
    for number in 0..context.automaton().states.len() {
        uses.join(context.state(number).uses);
    }
    uses
}
