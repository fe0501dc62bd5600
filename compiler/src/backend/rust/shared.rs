//! Modules that all automata share.

use super::automaton::step_uses;
use super::context::{Context, Shared};
use super::doc::{doc, documented};
use super::format::Unformatted;
use super::modes;
use super::property;
use super::render;
use super::retained;
use super::walk::{Access, Uses};
use crate::ir::{Automaton, AutomatonId, InterfaceId, Variable};
use askama::Template;
use runtime_sim::device::{Direction, PortType};

#[derive(Template)]
#[template(path = "rust/controllers/lib.rs")]
struct Library {
    files: String,
    modules: Vec<String>,
}

pub fn library(shared: Shared) -> Unformatted {
    let mut files: Vec<&str> = shared
        .system
        .model
        .automata
        .iter()
        .map(|a| shared.sources.file(a.place.file).name.as_str())
        .collect();
    files.sort_unstable();
    files.dedup();
    let alarm = has_alarm_module(shared).then(|| "alarm".to_string());
    let retained = shared.system.model.retains().then(|| "retained".to_string());
    let own = ["cells", "kinds", "line", "robot", "robots", "system", "types"].map(String::from);
    let mut modules: Vec<String> = alarm
        .into_iter()
        .chain(retained)
        .chain(own)
        .chain(shared.names.automata.iter().map(|a| a.module.clone()))
        .collect();
    modules.sort();
    Unformatted::Bare(render(&Library { files: documented(&files.join(", ")), modules }))
}

#[derive(Template)]
#[template(path = "rust/controllers/kinds.rs")]
struct Kinds {
    enums: Vec<EnumView>,
}

struct EnumView {
    doc: String,
    ty: String,
    members: Vec<String>,
}

pub fn kinds(shared: Shared) -> Unformatted {
    let enums = shared.system.model.enums.iter().zip(&shared.names.enums);
    let enums =
        enums.map(|(e, n)| EnumView { doc: doc(&e.doc), ty: n.ty.clone(), members: n.members.clone() });
    Unformatted::Module(render(&Kinds { enums: enums.collect() }), shared.importable("crate"))
}

#[derive(Template)]
#[template(path = "rust/controllers/cells.rs")]
struct Cells {
    interfaces: Vec<InterfaceView>,
    relations: Vec<RelationView>,
    has_cells: bool,
    has_wiring: bool,
    retains: bool,
}

struct InterfaceView {
    name: String,
    doc: String,
    field: String,
    reference: String,
    cells_type: String,
    cells: Vec<Field>,
    parameters_type: String,
    parameters: Vec<Field>,
}

struct Field {
    doc: String,
    name: String,
    ty: String,
    initial: String,
}

struct RelationView {
    doc: String,
    name: String,
}

pub fn cells(shared: Shared) -> Unformatted {
    let interfaces: Vec<InterfaceView> =
        (0..shared.system.model.interfaces.len()).map(|i| interface(shared, InterfaceId(i))).collect();
    let relations: Vec<RelationView> = (shared.system.model.relations.iter().zip(&shared.names.relations))
        .map(|(relation, name)| {
            let interface = |id: InterfaceId| &shared.system.model.interface(id).name;
            let text = format!(
                "Whether items can get from a `{}` to a `{}`.",
                interface(relation.from),
                interface(relation.to)
            );
            RelationView { doc: doc(&[text]), name: name.clone() }
        })
        .collect();
    let has_cells = interfaces.iter().any(|i| !i.cells.is_empty());
    let retains = shared.system.model.retains();
    let has_wiring = !relations.is_empty() || interfaces.iter().any(|i| !i.parameters.is_empty());
    Unformatted::Module(
        render(&Cells { interfaces, relations, has_cells, has_wiring, retains }),
        shared.importable("crate"),
    )
}

fn interface(shared: Shared, id: InterfaceId) -> InterfaceView {
    let source = shared.system.model.interface(id);
    let names = &shared.names.interfaces[id.0];
    let cells = source.cells.iter().zip(&names.cell).map(|(cell, name)| Field {
        doc: doc(&cell.doc),
        name: name.clone(),
        ty: shared.ty(cell.ty),
        initial: shared.filled(cell.ty, cell.initial),
    });
    let parameters = source.parameters.iter().zip(&names.parameter).map(|(parameter, name)| Field {
        doc: doc(&parameter.doc),
        name: name.clone(),
        ty: shared.ty(parameter.ty),
        initial: nothing(shared, parameter),
    });
    InterfaceView {
        name: source.name.clone(),
        doc: doc(&source.doc),
        field: names.field.clone(),
        reference: names.reference.clone(),
        cells_type: names.cells.clone(),
        cells: cells.collect(),
        parameters_type: names.parameters.clone(),
        parameters: parameters.collect(),
    }
}

/// What a member that is not there shows.
fn nothing(shared: Shared, parameter: &Variable) -> String {
    use crate::ir::{Scalar, Value};
    let value = match parameter.ty.scalar {
        Scalar::Bool => Value::Bool(false),
        Scalar::Int { lo, hi } => Value::Int(0.clamp(lo, hi)),
        Scalar::Real => Value::Real(0.0),
        Scalar::Point => Value::Point([0.0; 3]),
        Scalar::Time | Scalar::Enum(_) | Scalar::Ref(_) => Value::Int(0),
    };
    shared.filled(parameter.ty, value)
}

#[derive(Template)]
#[template(path = "rust/controllers/system.rs")]
struct SystemView {
    uses_cells: bool,
    limits_inputs: bool,
    properties: bool,
    properties_change: bool,
    properties_arguments: String,
    alarms: bool,
    scan: bool,
    start: bool,
    modes: bool,
    operate_writes_cells: bool,
    retains: bool,
    has_cells: bool,
}

#[derive(Template)]
#[template(path = "rust/controllers/robot.rs")]
struct RobotView {
    robots: Vec<Variant>,
    /// With a comma before them.
    operate_parameters: &'static str,
    step_parameters: &'static str,
    limits_inputs: bool,
    properties: bool,
    properties_change: bool,
    properties_parameters: String,
    alarms: bool,
    modes: bool,
    retains: bool,
    /// With a comma before them.
    forget_parameters: String,
    retain_parameters: String,
    restore_parameters: String,
}

struct Variant {
    ty: String,
    module: String,
    step_arguments: String,
    limits: bool,
    has_properties: bool,
    properties_arguments: String,
    /// Time continues in more than its state.
    counts: bool,
    begins_anew: bool,
    has_alarms: bool,
    operate_arguments: String,
    forget_arguments: &'static str,
    retains: bool,
    retain_arguments: &'static str,
}

fn contexts<'a>(shared: Shared<'a>) -> impl Iterator<Item = Context<'a>> {
    (0..shared.system.model.automata.len()).map(move |id| Context::new(shared, AutomatonId(id)))
}

fn limits(context: &Context) -> bool {
    let is_whole = |ty: PortType| matches!(ty, PortType::Int { .. });
    context.automaton().device.ports.iter().any(|p| p.direction == Direction::Input && is_whole(p.ty))
}

/// What the steps, and what the properties, of all automata need.
fn uses(shared: Shared) -> (Uses, Uses) {
    let (mut steps, mut properties) = (Uses::default(), Uses::default());
    for context in contexts(shared) {
        steps.join(step_uses(&context));
        steps.join(modes::uses(&context));
        properties.join(property::uses(&context));
    }
    (steps, properties)
}

pub fn uses_cells(shared: Shared) -> bool {
    let (steps, properties) = uses(shared);
    steps.cells.max(properties.cells) != Access::None
}

/// Whether something is checked after the steps.
fn has_properties(automaton: &Automaton) -> bool {
    automaton.can_stop() || !automaton.properties.is_empty()
}

/// Whether a robot that begins anew has cells.
fn operate_writes_cells(shared: Shared) -> bool {
    contexts(shared).any(|context| modes::uses(&context).cells != Access::None)
}

fn has_modes(shared: Shared) -> bool {
    shared.system.model.automata.iter().any(|automaton| automaton.modes.is_some())
}

fn remembers(shared: Shared) -> bool {
    shared.system.model.automata.iter().any(property::remembers)
}

pub fn has_alarms(shared: Shared) -> bool {
    shared.system.model.automata.iter().any(|automaton| automaton.alarms().next().is_some())
}

/// Whether the crate has the module `alarm`.
pub fn has_alarm_module(shared: Shared) -> bool {
    has_alarms(shared) || shared.system.model.automata.iter().any(property::waits)
}

pub fn system(shared: Shared) -> Unformatted {
    let (_, properties) = uses(shared);
    let arguments = contexts(shared).next().map(|c| c.arguments(&properties)).unwrap_or_default();
    let view = SystemView {
        uses_cells: uses_cells(shared),
        limits_inputs: contexts(shared).any(|c| limits(&c)),
        properties: shared.system.model.automata.iter().any(has_properties),
        properties_change: remembers(shared),
        properties_arguments: arguments,
        alarms: has_alarms(shared),
        scan: properties.scan,
        start: properties.start,
        modes: has_modes(shared),
        operate_writes_cells: operate_writes_cells(shared),
        retains: shared.system.model.retains(),
        has_cells: retained::has_cells(shared),
    };
    Unformatted::Bare(render(&view))
}

pub fn robot(shared: Shared) -> Unformatted {
    let (_, properties) = uses(shared);
    let robots: Vec<Variant> = contexts(shared)
        .map(|context| Variant {
            ty: context.own().ty.clone(),
            module: context.own().module.clone(),
            step_arguments: context.arguments(&step_uses(&context)),
            limits: limits(&context),
            has_properties: has_properties(context.automaton()),
            counts: context.automaton().can_stop() || property::waits(context.automaton()),
            begins_anew: !property::anew(&context).is_empty(),
            has_alarms: context.automaton().alarms().next().is_some(),
            operate_arguments: context.arguments(&modes::uses(&context)),
            forget_arguments: retained::cells_argument(&context),
            retains: !context.automaton().retained.is_empty(),
            retain_arguments: retained::argument(&context),
            properties_arguments: context.arguments(&property::uses(&context)),
        })
        .collect();
    // A line with cells is given them even where no robot needs them.
    let cells = |is_used: bool, access: &str| match (retained::has_cells(shared), is_used) {
        (false, _) => String::new(),
        (true, true) => format!(", cells: {access}Cells"),
        (true, false) => format!(", _cells: {access}Cells"),
    };
    let step_cells = contexts(shared).any(|context| step_uses(&context).cells != Access::None);
    let view = RobotView {
        step_parameters: match (uses_cells(shared), step_cells) {
            (false, _) => "wiring: &Wiring",
            (true, true) => "wiring: &Wiring, cells: &mut Cells",
            (true, false) => "wiring: &Wiring, _cells: &mut Cells",
        },
        limits_inputs: robots.iter().any(|r| r.limits),
        properties: robots.iter().any(|r| r.has_properties),
        properties_change: remembers(shared),
        alarms: has_alarms(shared),
        modes: has_modes(shared),
        retains: shared.system.model.retains(),
        forget_parameters: cells(retained::has_owned_cells(shared), "&mut "),
        retain_parameters: cells(retained::retains_cells(shared), "&"),
        restore_parameters: cells(retained::retains_cells(shared), "&mut "),
        operate_parameters: if operate_writes_cells(shared) { ", cells: &mut Cells" } else { "" },
        properties_parameters: contexts(shared).next().map(|c| c.parameters(&properties)).unwrap_or_default(),
        robots,
    };
    Unformatted::Module(render(&view), shared.importable("crate"))
}

impl Shared<'_> {
    /// What modules can import from the crate of controllers, which has this name.
    pub fn importable(&self, name: &str) -> Vec<(String, Vec<String>)> {
        let own = |names: &[&str]| names.iter().map(|n| n.to_string()).collect::<Vec<_>>();
        let mut cells = own(&["Cells", "Wiring"]);
        for interface in &self.names.interfaces {
            cells.extend([&interface.cells, &interface.parameters, &interface.reference].map(String::clone));
        }
        cells.sort();
        let mut kinds: Vec<String> = self.names.enums.iter().map(|e| e.ty.clone()).collect();
        kinds.sort();
        let mut all = vec![(format!("{name}::cells"), cells), (format!("{name}::kinds"), kinds)];
        all.extend(
            [
                ("alarm", own(&["Alarm", "waited"])),
                ("retained", own(&["Retained", "Words"])),
                ("robot", own(&["Robot"])),
                ("types", own(TYPES)),
            ]
            .map(|(m, names)| (format!("{name}::{m}"), names)),
        );
        all
    }
}

const TYPES: &[&str] = &[
    "Array",
    "Fault",
    "Point",
    "Reference",
    "Relation",
    "Rows",
    "Table",
    "greater",
    "lesser",
    "next_command",
    "quotient",
    "remainder",
    "store_point",
    "store_real",
    "store_whole",
    "within",
];
