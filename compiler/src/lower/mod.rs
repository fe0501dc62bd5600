//! From texts to a system: types bound to the machines of a layout, parameters,
//! connectivity, roles. The hinge between what knows source text and what does not.

mod awaited;
pub(crate) mod bind;
mod collected;
mod device_key;
mod draft;
mod kinds;
mod lonely;
mod masked;
mod modes;
mod overlap;
mod parameter;
mod plant;
mod resized;
mod restart;
mod role;
mod setting;
mod short;
mod size;
mod work;

pub use draft::{Draft, Line, Texts};
pub use setting::Setting;

use crate::diagnostic::Diagnostic;
use crate::layout::{MayTouch, Panel, Reading};
use crate::scenario::Drawn;
use crate::source::{FileId, Sources};
use crate::{connect, ir};
use runtime_sim::line::{Goal, Supply};
use runtime_sim::machine::Machine;
use runtime_sim::part::Primitive;
use runtime_sim::plant::{By, Transfer};
use std::collections::HashSet;

/// What is to be compiled; every text is in `sources` already, and the layout is read.
#[derive(Clone, Debug)]
pub struct Input {
    pub sources: Sources,
    pub layout: Reading,
    /// Files of types; a type of a later one replaces one of the same name of an earlier one.
    pub specs: Vec<FileId>,
    pub scenario: FileId,
    /// From the command line; they stand above the layout.
    pub settings: Vec<Setting>,
    /// Steps the instances in an order shuffled with this seed instead of layout order.
    pub order: Option<u64>,
}

/// Adds what no text declares: how each type continues after a loss of power, its panel, and what its properties see.
pub fn complete(model: &mut ir::Model, panel: Panel) {
    restart::add(model);
    if panel == Panel::Machines {
        modes::add(model);
    }
    masked::add(model);
}

/// A line that has passed every check.
#[derive(Clone, Debug)]
pub struct Project {
    pub name: String,
    pub system: ir::System,
    /// What the simulator needs; its machines are the instances.
    pub plant: runtime_sim::line::Line,
    /// How the supply was drawn from the seed, if it was.
    pub drawn: Option<Drawn>,
    /// Between instances.
    pub edges: Vec<connect::Edge>,
    /// How items go from conveyor to conveyor.
    pub transfers: Vec<Transfer>,
    /// The pairs of which the layout says that they may touch.
    pub may_touch: Vec<MayTouch>,
}

impl Project {
    /// Whether replications of this line may differ; `plant` is one of them.
    pub fn differs(&self, plant: &runtime_sim::line::Line) -> bool {
        self.drawn.is_some() || plant.is_drawn()
    }

    /// What the simulator needs for a replication: that of the scenario is 0, another one adds its number to the seed. A
    /// supply that is a list stays as it is.
    pub fn replication(&self, number: u32) -> runtime_sim::line::Line {
        let mut plant = self.plant.clone();
        let seed = (plant.scenario.seed as u32).wrapping_add(number);
        plant.scenario.seed = u64::from(seed);
        if let Some(drawn) = &self.drawn {
            let supply = drawn.supply(seed).into_iter();
            plant.scenario.supply = supply.map(|(belt, items)| Supply { belt, items }).collect();
        }
        plant
    }
}

/// Two machines that meet.
#[derive(Clone, Debug)]
pub struct Handover {
    pub from: String,
    pub to: String,
    /// How far the arm stays within its reach at the worst pose, m.
    pub margin: f64,
    /// How far its last three joints stay from their limits there, deg; none without limits.
    pub wrist_room: Option<f64>,
}

/// What the connectivity check found, by names.
#[derive(Clone, Debug, Default)]
pub struct Verdict {
    pub feasible: bool,
    /// All instances, in the order in which they step.
    pub robots: Vec<String>,
    pub edges: Vec<Handover>,
    pub sources: Vec<String>,
    pub destinations: Vec<String>,
    /// Ways of items from conveyor to conveyor; known of a line that has no other errors.
    pub passages: Vec<Passage>,
    /// What no longer comes to a sink or an order without one machine, of each machine without which something does not;
    /// known of such a line too.
    pub losses: Vec<Loss>,
    /// Where items of a goal are collected, as `station.sink`; known of such a line too.
    pub sinks: Vec<String>,
    /// Machines between sources and destinations that every item passes, in the order in which it does.
    pub single_points: Vec<String>,
    pub unreachable: Vec<String>,
    pub dead_ends: Vec<String>,
    /// Pairs that should meet and do not.
    pub apart: Vec<Apart>,
}

/// From one conveyor to another one, or by a fall to a place, each as `belt.lane`.
#[derive(Clone, Debug)]
pub struct Passage {
    pub from: String,
    pub to: String,
    pub by: Passes,
}

/// How items pass from one conveyor to another one, as [`By`].
#[derive(Clone, Debug, PartialEq)]
pub enum Passes {
    /// The margins in m and degrees.
    Joint([f64; 2]),
    /// By this part.
    Branch(String),
    Fall,
}

/// What is lost without a machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Loss {
    pub machine: String,
    pub goals: Vec<Lost>,
}

/// Kinds at a sink, as `station.sink`, or at a machine with orders.
#[derive(Clone, Debug, PartialEq)]
pub struct Lost {
    pub at: String,
    /// That no longer get there.
    pub kinds: Vec<String>,
    /// That still do.
    pub others: Vec<String>,
}

/// A pair of machines that should meet and does not.
#[derive(Clone, Debug)]
pub struct Apart {
    pub from: String,
    pub to: String,
    pub tested: usize,
    /// Place, kind, stage and missing mm of each pose, the worst first.
    pub misses: Vec<connect::Miss>,
    /// Robot, path of the number, present and new value.
    pub suggestion: Option<(String, String, f64, f64)>,
    /// Robot, present and new yaw, degrees.
    pub turn: Option<(String, f64, f64)>,
}

impl Verdict {
    /// What items do without an arm: conveyors that continue as others, and sinks.
    fn add_conveyors(
        &mut self,
        line: &runtime_sim::line::Line,
        edges: &[connect::Edge],
        transfers: &[Transfer],
    ) {
        let name = |(machine, part): (usize, usize)| {
            let machine = &line.machines[machine];
            format!("{}.{}", machine.name, machine.parts[part].name)
        };
        let passage = |Transfer { from, to, by, .. }: &Transfer| {
            let by = match by {
                By::Joint { margin } => Passes::Joint(*margin),
                By::Branch { part } => Passes::Branch(name((from.0, *part))),
                By::Fall => Passes::Fall,
            };
            Passage { from: name(*from), to: name(*to), by }
        };
        self.passages = transfers.iter().map(passage).collect();
        self.losses = collected::losses(line, edges, transfers);
        // What nobody hands over to may have its items from a conveyor.
        let has_source = |machine: usize| line.machines[machine].has("source");
        let fed = transfers.iter().filter(|transfer| transfer.from.0 != transfer.to.0);
        let fed: HashSet<&String> =
            fed.map(|t| t.to.0).filter(|to| !has_source(*to)).map(|to| &line.machines[to].name).collect();
        self.sources.retain(|source| !fed.contains(source));
        for (number, machine) in line.machines.iter().enumerate() {
            for (part, of) in machine.parts.iter().enumerate() {
                match of.primitive {
                    Primitive::Sink(_) => self.sinks.push(name((number, part))),
                    Primitive::Source(_) if !self.sources.contains(&machine.name) => {
                        self.sources.push(machine.name.clone());
                    }
                    _ => {}
                }
            }
        }
        self.single_points = self.single_points(line, edges, transfers);
    }

    fn single_points(
        &self,
        line: &runtime_sim::line::Line,
        edges: &[connect::Edge],
        transfers: &[Transfer],
    ) -> Vec<String> {
        let those = |wanted: &dyn Fn(&Machine) -> bool| -> Vec<usize> {
            let machines = line.machines.iter().enumerate();
            machines.filter(|(_, machine)| wanted(machine)).map(|(number, _)| number).collect()
        };
        let named = |names: &[String]| {
            let names: HashSet<&String> = names.iter().collect();
            those(&|machine| names.contains(&machine.name))
        };
        let leaves: Vec<usize> = match &line.scenario.goal {
            Goal::Collected(sinks) => sinks.iter().map(|sink| sink.machine).collect(),
            _ if self.destinations.is_empty() => those(&|machine| machine.has("sink")),
            Goal::AllOrders | Goal::TimeLimit => named(&self.destinations),
        };
        let handovers = edges.iter().map(|edge| [edge.from, edge.to]);
        let conveyed = transfers.iter().map(|transfer| [transfer.from.0, transfer.to.0]);
        let passed = connect::single_points(handovers.chain(conveyed), &named(&self.sources), &leaves);
        passed.into_iter().map(|machine| line.machines[machine].name.clone()).collect()
    }
}

/// The result of a compilation: `project` is there exactly when `diagnostics` is empty.
#[derive(Clone, Debug)]
pub struct Outcome {
    pub sources: Sources,
    pub diagnostics: Vec<Diagnostic>,
    /// What is hardly meant and stops nothing.
    pub warnings: Vec<Diagnostic>,
    /// There as soon as the check of connectivity could be made.
    pub verdict: Option<Verdict>,
    pub project: Option<Project>,
}

/// Compiles a line as far as it is right.
pub fn compile(input: Input) -> Outcome {
    let Input { sources, layout, specs, scenario, settings, order } = input;
    let draft = Draft::new(&sources, Texts { layout, specs: &specs, scenario }, &settings);
    let Line { diagnostics, warnings: of_layout, verdict, project } = draft.line(&settings, order);
    let warnings = draft.warnings().iter().cloned().chain(of_layout).collect();
    Outcome { sources, diagnostics, warnings, verdict, project }
}
