//! A panel for each device: inputs with which a person enables its machines, selects their mode and moves them by hand.
//!
//! In the simulator a person operates parts that are added to the device; on a controller these inputs are variables
//! that a screen writes, or switches.

use super::head;
use crate::diagnostic::Diagnostic;
use crate::source::{FileId, Span};
use crate::spec::ast::{self, Device, DeviceMember, Expr, ExprKind, Name, Scalar, Type};
use runtime_sim::device::Direction;
use std::collections::BTreeMap;

pub const ENABLE: &str = "panel_enable";
pub const MODE: &str = "panel_mode";
pub const STEP: &str = "panel_step";
pub const JOG: &str = "panel_jog";
pub const VERB: &str = "panel_verb";

/// Values of [`MODE`]. Automatic is 0.
pub const SINGLE_STEP: i32 = 1;
pub const MANUAL: i32 = 2;

/// Whether a part or an input of a device with a panel is of the panel.
pub fn has(name: &str) -> bool {
    name.starts_with("panel_")
}

/// Help for a name that is taken.
pub fn another_name(name: &str) -> &'static str {
    match has(name) {
        true => {
            "choose another name: in a layout with \"panel\": \"machines\", names that begin with `panel_` are those of the panel"
        }
        false => "choose another name",
    }
}

/// The input that gives an output by hand; of a point, one for each coordinate.
pub fn inputs_for(output: &str, is_point: bool) -> Vec<String> {
    let suffixes: &[&str] = if is_point { &["_x", "_y", "_z"] } else { &[""] };
    suffixes.iter().map(|suffix| format!("panel_{output}{suffix}")).collect()
}

/// Gives every device with inputs and outputs a panel. Nothing is added if names meet.
pub fn add(files: &mut [(FileId, ast::File)]) -> Vec<Diagnostic> {
    let mut devices: Vec<&mut Device> = files
        .iter_mut()
        .flat_map(|(_, file)| &mut file.devices)
        .filter(|device| !device.is_assembly)
        .collect();
    let found: Vec<Diagnostic> = devices.iter().flat_map(|device| clashes(device)).collect();
    if found.is_empty() {
        devices.iter_mut().for_each(|device| equip(device));
    }
    found
}

/// Outputs whose values by hand would have a name that the panel has already, and names that the text gives to something
/// else.
fn clashes(device: &Device) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    let own = [ENABLE, MODE, STEP, JOG].into_iter().chain((!device.commands.is_empty()).then_some(VERB));
    let mut taken: BTreeMap<String, String> =
        own.map(|name| (name.to_string(), "an input of every panel".into())).collect();
    for output in device.ports.iter().filter(|port| port.direction == Direction::Output) {
        let name = &output.name.value;
        let inputs = inputs_for(name, matches!(output.ty.scalar, Scalar::Point));
        if let Some((input, other)) = inputs.iter().find_map(|input| Some((input, taken.get(input)?))) {
            let message = format!("the panel cannot give `{name}` by hand: `{input}` is {other}");
            let help =
                format!("rename the output `{name}`, or leave out \"panel\": \"machines\" in the layout");
            found.push(Diagnostic::new("E0701", output.name.span, message).help(help));
        }
        for input in inputs {
            taken.entry(input).or_insert_with(|| format!("the value by hand of the output `{name}`"));
        }
    }
    let members = device.members.iter().map(|member| match member {
        DeviceMember::Define(define) => &define.name,
        DeviceMember::Part(part) => &part.name,
    });
    let constants = device.constants.iter().map(|constant| &constant.name);
    let declared = device.ports.iter().map(|port| &port.name).chain(members).chain(constants);
    for name in declared {
        if let Some(other) = taken.get(&name.value) {
            let message = format!("`{}` is {other}", name.value);
            found.push(Diagnostic::new("E0701", name.span, message).help(another_name(&name.value)));
        }
    }
    found
}

fn equip(device: &mut Device) {
    let place = device.name.span;
    let commands = head::numbered(&device.commands);
    let is_output = |port: &&ast::Port| port.direction == Direction::Output;
    let outputs: Vec<ast::Port> = device.ports.iter().filter(is_output).cloned().collect();
    let mut panel = Panel { device, place };
    panel.switch(
        ENABLE,
        true,
        "panel: the machine may step, and be moved by hand; without it, and until start after it, it is stopped",
    );
    panel.whole(MODE, int(place, 0, i64::from(MANUAL)), "panel: 0 automatic, 1 single step, 2 manual");
    panel.switch(STEP, false, "panel: in single step its rising edge lets one transition fire");
    panel.switch(
        JOG,
        false,
        "panel: in manual its rising edge gives the command, and outputs are given while it is true",
    );
    if !commands.is_empty() {
        panel.whole(VERB, int(place, 0, 32767), &format!("panel: the command by hand: {commands}; 0 none"));
    }
    for output in &outputs {
        panel.output(output);
    }
}

struct Panel<'a> {
    device: &'a mut Device,
    /// What is added stands nowhere in the text: it is shown at the device.
    place: Span,
}

impl Panel<'_> {
    fn output(&mut self, output: &ast::Port) {
        let name = &output.name.value;
        let is_point = matches!(output.ty.scalar, Scalar::Point);
        let about = format!(
            "panel, by hand: {}",
            if output.doc.is_empty() { name.clone() } else { plain(&output.doc) }
        );
        for input in inputs_for(name, is_point) {
            match &output.ty.scalar {
                Scalar::Bool => self.switch(&input, false, &about),
                Scalar::Int { .. } => self.whole(&input, output.ty.clone(), &about),
                _ => self.real(&input, &output.unit, &about),
            }
        }
    }

    fn switch(&mut self, name: &str, is_on_at_rest: bool, about: &str) {
        let closed = Expr { span: self.place, kind: ExprKind::Bool(is_on_at_rest) };
        self.part(name, "button", vec![(self.name("normally_closed"), closed)]);
        self.input(name, "on", Type { span: self.place, scalar: Scalar::Bool, extent: None }, "", about);
    }

    fn whole(&mut self, name: &str, ty: Type, about: &str) {
        self.part(name, "selector", Vec::new());
        self.input(name, "position", ty, "", about);
    }

    fn real(&mut self, name: &str, unit: &str, about: &str) {
        let begins = Expr { span: self.place, kind: ExprKind::Int(0) };
        self.part(name, "setpoint", vec![(self.name("begins"), begins)]);
        self.input(name, "value", Type { span: self.place, scalar: Scalar::Real, extent: None }, unit, about);
    }

    fn part(&mut self, name: &str, kind: &str, settings: Vec<(Name, Expr)>) {
        let part = ast::Part { name: self.name(name), kind: self.name(kind), settings };
        self.device.members.push(DeviceMember::Part(part));
    }

    fn input(&mut self, name: &str, signal: &str, ty: Type, unit: &str, about: &str) {
        let part = Expr { span: self.place, kind: ExprKind::Name(name.into()) };
        let wire = ExprKind::Member(Box::new(part), self.name(signal));
        self.device.ports.push(ast::Port {
            doc: vec![about.into()],
            direction: Direction::Input,
            name: self.name(name),
            ty,
            unit: unit.into(),
            wire: Some(Expr { span: self.place, kind: wire }),
            stop: None,
        });
    }

    fn name(&self, value: &str) -> Name {
        Name { value: value.into(), span: self.place }
    }
}

fn int(span: Span, lo: i64, hi: i64) -> Type {
    let bound = |value| Expr { span, kind: ExprKind::Int(value) };
    Type { span, scalar: Scalar::Int { lo: bound(lo), hi: bound(hi) }, extent: None }
}

fn plain(doc: &[String]) -> String {
    doc.iter().map(|line| line.trim()).collect::<Vec<_>>().join(" ")
}
