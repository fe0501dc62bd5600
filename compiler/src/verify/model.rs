//! The whole line.

use super::automaton::{Instance, Line, Vars};
use super::fed::Fed;
use super::memory::{Kept, Memory, kept};
use super::plant::{Known, has_hidden_places, hides_items, plant};
use super::properties::{can_stop, read_by, searched};
use super::strokes::Changing;
use super::unread::unread;
use super::unsearched;
use super::{Asked, Remembered, Skipped};
use crate::diagnostic::Diagnostic;
use crate::ir::{
    Asking, Automaton, Expr, ExprKind, InterfaceId, KeptBy, Place, Scalar, System, Type, UpdateKind, Value,
};
use crate::lower::Project;
use crate::reads::{Reads, is_fixed};
use autogen_search::model::{Model, NO_CELL, Reach, Reductions};
use autogen_search::plant::{Order, Watch};
use autogen_search::unread::Unread;
use runtime_sim::device::{Direction, PortType};
use runtime_sim::point::Point;
use runtime_sim::wiring::Drives;
use std::sync::Arc;

/// A line as it is searched.
pub struct Searched {
    pub model: Model,
    /// Properties that are left out.
    pub skipped: Vec<Skipped>,
}

/// A line as it is searched; or why it cannot be.
pub fn model(project: &Project, asked: &Asked) -> Result<Searched, Vec<Diagnostic>> {
    let Project { system, plant: line, .. } = project;
    let machines = line.machines.iter().enumerate();
    let unknown: Vec<_> = machines.flat_map(|of| unsearched::machine(system, of)).collect();
    if !unknown.is_empty() {
        return Err(unknown);
    }
    let mut memory = Memory::default();
    let mut changing = Changing::default();
    let fed = Fed::of(line);
    let mut whole = Line {
        system,
        plant: line,
        states: Vec::new(),
        elapsed: Vec::new(),
        stopped: Vec::new(),
        locals: Vec::new(),
        cells: Vec::new(),
        plants: Vec::new(),
        outputs: Vec::new(),
        seen: Vec::new(),
        initial: &[],
    };
    whole.cells = vec![Vec::new(); system.model.interfaces.len()];
    let kept = |ty: Scalar| -> Kept {
        kept(ty, |ty| match ty {
            Scalar::Enum(id) => system.model.enums[id.0].members.len(),
            Scalar::Ref(id) => system.members[id.0].len(),
            _ => 0,
        })
    };
    let values = |memory: &mut Memory, owner: usize, name: &str, ty: Type, initial: Value| -> Vars {
        let kept = kept(ty.scalar);
        let count = system.model.elements(ty.extent);
        let vars = (0..count).map(|element| {
            let name = if count == 1 { name.to_string() } else { format!("{name}[{element}]") };
            memory.value(owner, name, ty.scalar, kept, initial)
        });
        (vars.collect(), kept.low)
    };
    for (number, instance) in system.instances.iter().enumerate() {
        let automaton = system.automaton_of(number);
        let name = &instance.name;
        let state = memory.number(number, format!("{name}.(state)"), automaton.states.len(), 0);
        let states = automaton.states.iter();
        let timers: Vec<&Expr> = states.flat_map(|state| Reads::of_guards(automaton, state).timers).collect();
        let times =
            (!timers.is_empty()).then(|| memory.number(number, format!("{name}.(times)"), timers.len(), 0));
        let elapsed = timers.iter().any(|time| !is_fixed(automaton, time)).then(|| {
            let name = format!("{name}.(elapsed)");
            memory.value(number, name, Scalar::Time, kept(Scalar::Time), Value::Int(0))
        });
        whole.elapsed.push(elapsed);
        let stopped =
            can_stop(automaton, asked).then(|| memory.number(number, format!("{name}.(stopped)"), 1, 0));
        whole.states.push((state, times));
        whole.stopped.push(stopped);
        let locals = automaton.locals.iter().map(|local| match local.kept_by {
            // Nothing that is searched reads it.
            KeptBy::Properties | KeptBy::Modes => (Vec::new(), 0),
            KeptBy::Steps => {
                values(&mut memory, number, &format!("{name}.{}", local.name), local.ty, local.initial)
            }
        });
        whole.locals.push(locals.collect());
        let ports = 0..automaton.device.ports.len();
        let reads: Vec<bool> = ports.map(|port| reads_port(automaton, port, asked)).collect();
        whole.plants.push(plant(
            line,
            number,
            &automaton.device.ports,
            Known { reads_error: reads_error(automaton, asked), stopped, reads: &reads, fed: &fed },
            &mut memory,
            &mut changing,
        ));
        let mut outputs = vec![None; automaton.device.ports.len()];
        let published = automaton.device.ports.iter().enumerate();
        let published = published.filter(|(_, port)| port.direction == Direction::Output);
        let driven = line.machines[number].wiring.outputs.iter().zip(&whole.plants[number].outputs);
        for ((port, output), (wired, level)) in published.zip(driven) {
            outputs[port] = level.map(|var| (vec![var], 0));
            // What the head publishes by itself is not followed: the number of the command grows without end.
            let is_of_head = matches!(wired.drives, Drives::Command | Drives::Verb);
            if level.is_none() && !is_of_head && reads_port(automaton, port, asked) {
                let ty = Type { scalar: output.ty.into(), extent: output.extent.into() };
                let initial = match output.ty {
                    PortType::Bool => Value::Bool(false),
                    PortType::Int { lo, hi } => Value::Int(0.clamp(lo, hi)),
                    PortType::Real => Value::Real(0.0),
                    PortType::Point => Value::Point([0.0; 3]),
                };
                let name = format!("{name}.{}", output.name);
                outputs[port] = Some(values(&mut memory, number, &name, ty, initial));
            }
        }
        whole.outputs.push(outputs);
    }
    for (interface, (shape, members)) in system.model.interfaces.iter().zip(&system.members).enumerate() {
        for member in members {
            let name = &system.instances[*member].name;
            let row = shape.cells.iter().map(|cell| {
                values(&mut memory, *member, &format!("{name}.{}", cell.name), cell.ty, cell.initial)
            });
            whole.cells[interface].push(row.collect());
        }
    }
    let orders = line.scenario.orders.iter().enumerate().map(|(number, order)| Order {
        parts: order.parts.clone(),
        made: memory.number(0, format!("(order {} made)", number + 1), 1, 0),
    });
    let orders: Vec<Order> = orders.collect();
    let stays = |number| changing.inputs.iter().filter(move |input| input.stays == Some(number));
    whole.seen = (0..system.instances.len()).map(|n| stays(n).map(|input| input.var).collect()).collect();
    let initial = memory.initial.clone();
    whole.initial = &initial;
    let (mut refused, mut skipped) = (Vec::new(), Vec::new());
    let instances = (0..system.instances.len()).map(|number| {
        let mut instance = Instance::new(&whole, number);
        let program = instance.program(asked, &mut memory, &mut skipped);
        refused.extend(instance.refused.into_iter().map(|port| (number, port)));
        program
    });
    let instances: Vec<_> = instances.collect();
    if !refused.is_empty() {
        return Err(refused
            .into_iter()
            .map(|(number, port)| unsearched::unbounded(system, number, &port))
            .collect());
    }
    memory.end();
    let columns = columns(&whole, memory.initial.len());
    let unread = match asked.remembered {
        Remembered::Least => unread(&whole, asked, &instances, memory.initial.len()),
        Remembered::Whole => Unread::default(),
    };
    let arms: Vec<_> = line.machines.iter().map(|machine| machine.arm()).collect();
    let reach = Reach(Arc::new(move |machine: usize, [x, y, z]: [f64; 3]| {
        arms[machine].as_ref().is_some_and(|arm| arm.solve(Point { x, y, z }, &arm.start()).is_some())
    }));
    let Memory { initial, owners, variables, values } = memory;
    let machines = || 0..line.machines.len();
    let model = Model {
        initial,
        owners,
        columns,
        instances,
        machines: whole.plants.into_iter().map(|plant| plant.machine).collect(),
        inputs: changing.inputs,
        cylinders: changing.cylinders,
        processes: changing.processes,
        orders,
        hides_items: machines().any(|number| hides_items(line, number, &fed)),
        has_hidden_places: machines().any(|number| has_hidden_places(line, number, &fed)),
        heights: line.kinds.iter().map(|kind| kind.height).collect(),
        grasps: line.kinds.iter().map(|kind| kind.grasp).collect(),
        sensed: sensed(system),
        scan_ms: line.scan_ms,
        faults: asked.faults,
        watch: Watch::Everything,
        reductions: Reductions::All,
        unread,
        reach,
        values,
        variables,
    };
    Ok(Searched { model, skipped })
}

/// Of each byte of a state which cell stands there.
fn columns(line: &Line, length: usize) -> Vec<u8> {
    let mut columns = vec![NO_CELL; length];
    for (interface, rows) in line.cells.iter().enumerate() {
        for (cell, (vars, _)) in rows.iter().flat_map(|row| row.iter().enumerate()) {
            // Columns with the same bit count as one.
            let column = (line.column(InterfaceId(interface), cell) % 64) as u8;
            vars.iter().for_each(|var| columns[var.at as usize] = column);
        }
    }
    columns
}

/// Of each fault whether the property of which it is reads an input of a device.
fn sensed(system: &System) -> Vec<bool> {
    let mut sensed = vec![false; system.model.faults.len()];
    for automaton in &system.model.automata {
        let ports = &automaton.device.ports;
        let asks = Asking::new(
            automaton,
            |kind| matches!(kind, ExprKind::Read(Place::Port { port, .. }) if ports[*port].direction == Direction::Input),
        );
        for property in &automaton.properties {
            sensed[property.site.0] |= property.exprs().into_iter().any(|expr| asks.expression(expr));
        }
    }
    sensed
}

fn reads_error(automaton: &Automaton, asked: &Asked) -> bool {
    let port = automaton.device.ports.iter().position(|port| port.name == "error");
    port.is_some_and(|port| reads_port(automaton, port, asked))
}

/// Whether an expression reads a port by its name.
fn reads_port(automaton: &Automaton, port: usize, asked: &Asked) -> bool {
    fn reads(expr: &Expr, port: usize) -> bool {
        let here = matches!(&expr.kind, ExprKind::Read(Place::Port { port: p, .. }) if *p == port);
        here || expr.parts().any(|part| reads(part, port))
    }
    let place = |place: &Place| {
        matches!(place, Place::Port { port: p, .. } if *p == port)
            || place.parts().any(|part| reads(part, port))
    };
    let update = |update: &UpdateKind| match update {
        UpdateKind::Assign { target, value, .. } | UpdateKind::Fill { target, value, .. } => {
            reads(value, port) || target.place.parts().any(|part| reads(part, port))
        }
        UpdateKind::Copy { target, source, .. } => {
            place(source) || target.place.parts().any(|part| reads(part, port))
        }
        UpdateKind::Command { arguments, .. } => arguments.iter().any(|a| reads(&a.value, port)),
    };
    let clause = |clause: &crate::ir::Clause| match clause {
        crate::ir::Clause::Condition(condition) => reads(condition, port),
        crate::ir::Clause::Bind(binder) => {
            let ends = match &binder.domain {
                crate::ir::Domain::Range(low, high) => reads(low, port) || reads(high, port),
                _ => false,
            };
            ends || binder.condition.iter().chain(&binder.key).any(|expr| reads(expr, port))
        }
    };
    let defines = automaton.defines.iter().any(|define| reads(&define.value, port));
    let properties = searched(automaton, asked).flat_map(read_by).any(|expr| reads(expr, port));
    let mut transitions = automaton.states.iter().flat_map(|state| &state.transitions);
    defines
        || properties
        || transitions.any(|transition| {
            transition.clauses.iter().any(clause) || transition.updates.iter().any(|u| update(&u.kind))
        })
}
