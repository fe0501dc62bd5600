//! Between process images or texts and the controllers.

use super::context::Shared;
use super::format::Unformatted;
use super::shared::{has_alarms, uses_cells};
use super::{render, retained};
use askama::Template;
use runtime_sim::device::Direction;

#[derive(Template)]
#[template(path = "rust/adapters/layout.rs")]
struct Adapters {
    enums: Vec<String>,
    interfaces: Vec<InterfaceView>,
    relations: Vec<RelationView>,
    robots: Vec<RobotView>,
    has_outputs: bool,
    has_cells: bool,
    /// Some robot has cells of its own.
    traces_cells: bool,
    uses_cells: bool,
    has_wiring: bool,
    alarms: bool,
    retains: bool,
}

struct InterfaceView {
    keyword: String,
    field: String,
    reference: String,
    cells_type: String,
    has_cells: bool,
    parameters_type: String,
    parameters: Vec<String>,
}

struct RelationView {
    keyword: String,
    name: String,
}

struct RobotView {
    keyword: String,
    ty: String,
    module: String,
    inputs: Vec<String>,
    /// All outputs, one after the other.
    outputs: Option<String>,
    parameters: Vec<String>,
    /// Its state, the time in it, locals, its own cells, outputs, alarms.
    trace: String,
}

pub fn adapters(shared: Shared) -> Unformatted {
    let model = &shared.system.model;
    let interfaces =
        model.interfaces.iter().zip(&shared.names.interfaces).map(|(interface, names)| InterfaceView {
            keyword: interface.name.clone(),
            field: names.field.clone(),
            reference: names.reference.clone(),
            cells_type: names.cells.clone(),
            has_cells: !interface.cells.is_empty(),
            parameters_type: names.parameters.clone(),
            parameters: names.parameter.clone(),
        });
    let relations =
        model.relations.iter().zip(&shared.names.relations).map(|(relation, name)| RelationView {
            keyword: format!("{}_{}", model.interface(relation.from).name, model.interface(relation.to).name),
            name: name.clone(),
        });
    let interfaces: Vec<InterfaceView> = interfaces.collect();
    let has_wiring = !model.relations.is_empty() || interfaces.iter().any(|i| !i.parameters.is_empty());
    let robots: Vec<RobotView> = (0..model.automata.len()).map(|id| robot(shared, id)).collect();
    let view = Adapters {
        enums: shared.names.enums.iter().map(|e| e.ty.clone()).collect(),
        relations: relations.collect(),
        has_outputs: robots.iter().any(|robot| robot.outputs.is_some()),
        robots,
        has_cells: interfaces.iter().any(|i| i.has_cells),
        interfaces,
        traces_cells: retained::has_owned_cells(shared),
        uses_cells: uses_cells(shared),
        has_wiring,
        alarms: has_alarms(shared),
        retains: shared.system.model.retains(),
    };
    let mut importable = shared.importable("controllers");
    importable.push(("crate::image".into(), ["Image", "Latch", "Put", "words_of"].map(String::from).into()));
    importable.push(("crate::kept".into(), ["Kept"].map(String::from).into()));
    importable.push(("crate::read".into(), ["Read", "Reader", "kept", "rows"].map(String::from).into()));
    Unformatted::Module(render(&view), importable)
}

fn robot(shared: Shared, id: usize) -> RobotView {
    let automaton = &shared.system.model.automata[id];
    let names = &shared.names.automata[id];
    let ports = |direction: Direction| {
        let ports = automaton.device.ports.iter().zip(&names.ports);
        ports.filter(move |(p, _)| p.direction == direction).map(|(_, name)| name)
    };
    let owned = automaton.implements.iter().zip(&names.rows).flat_map(|(implements, row)| {
        let interface = &shared.names.interfaces[implements.interface.0];
        interface
            .cell
            .iter()
            .map(move |cell| format!("cells.{}[robot.parameters.{row}].{cell}", interface.field))
    });
    let state = ["(robot.state as i32)", "robot.elapsed"].map(String::from).into_iter();
    let locals = names.locals.iter().map(|local| format!("robot.{local}"));
    let outputs = in_a_row(ports(Direction::Output).map(|name| format!("outputs.{name}")).collect());
    let traced_outputs = outputs.as_ref().map(|_| format!("outputs_of_{}(robot.outputs)", names.module));
    let stopped = automaton.can_stop().then(|| "robot.stopped".into());
    let alarms = automaton.alarms().next().map(|_| "robot.alarms.each_ref()".into());
    let trace = state.chain(locals).chain(owned).chain(traced_outputs).chain(stopped).chain(alarms);
    RobotView {
        keyword: automaton.name.clone(),
        ty: names.ty.clone(),
        module: names.module.clone(),
        inputs: ports(Direction::Input).cloned().collect(),
        outputs,
        parameters: names.parameters.iter().chain(&names.roles).chain(&names.rows).cloned().collect(),
        trace: in_a_row(trace.collect()).unwrap_or_default(),
    }
}

/// So many values are put in a row, and rows into one another: the type of all is not nested too deep for rustc.
const IN_A_ROW: usize = 16;

/// An expression that puts all values one after the other; none of no values.
fn in_a_row(values: Vec<String>) -> Option<String> {
    if values.len() > IN_A_ROW {
        return in_a_row(values.chunks(IN_A_ROW).filter_map(|row| in_a_row(row.to_vec())).collect());
    }
    values.into_iter().reduce(|row, next| format!("{row}.with({next})"))
}
