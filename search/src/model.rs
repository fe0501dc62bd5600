//! A line as it is searched: automata, plant, and what a state consists of.

use crate::plant::{Faults, Input, Machine, Order, Watch, status};
use crate::program::{Cells, Instance};
use crate::stroke::{Cylinder, Process};
use crate::unread::Unread;
use crate::value::{Point, Values, Var};
use std::fmt;
use std::sync::Arc;

/// In [`Model::columns`].
pub const NO_CELL: u8 = u8::MAX;

#[derive(Clone, Debug)]
pub struct Model {
    /// The first state.
    pub initial: Vec<u8>,
    /// Of each byte of a state the instance that owns it, of which others see cells; as the number of a bit.
    pub owners: Vec<u8>,
    /// Of each byte of a state the number of the cell that stands there, among those of all interfaces; [`NO_CELL`] for what others
    /// do not see.
    pub columns: Vec<u8>,
    /// In the order in which they step.
    pub instances: Vec<Instance>,
    /// The machine of each instance.
    pub machines: Vec<Machine>,
    pub inputs: Vec<Input>,
    pub cylinders: Vec<Cylinder>,
    pub processes: Vec<Process>,
    pub orders: Vec<Order>,
    /// Items may be where the search does not know them.
    pub hides_items: bool,
    /// One of these places is carried, by a cylinder, a positioner or a vehicle on a track.
    pub has_hidden_places: bool,
    /// Heights of the kinds, m.
    pub heights: Vec<f64>,
    /// Heights over their undersides at which tools grip them, m.
    pub grasps: Vec<f64>,
    /// Of each fault of the text whether its condition reads an input of a device.
    pub sensed: Vec<bool>,
    pub scan_ms: u32,
    pub faults: Faults,
    pub watch: Watch,
    pub reductions: Reductions,
    /// What is forgotten because nobody reads it; nothing, to compare the search with itself.
    pub unread: Unread,
    pub reach: Reach,
    /// Those of the first state.
    pub values: Values,
    /// What each value is, for whoever looks at a state.
    pub variables: Vec<Variable>,
}

/// What the search leaves out because it changes no verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reductions {
    /// Those of [`Reductions::OfScans`], and with any number of answers in a scan those that nobody needs yet: states that
    /// differ in these alone.
    All,
    /// Steps of instances that would do nothing, and of orders of steps all that differ in these alone; paths to an end, if
    /// there is one on which one device does something at a time.
    OfScans,
    /// Nothing: to compare the search with itself.
    Off,
}

/// Whether the arm of a machine can bring its tool to a point.
#[derive(Clone)]
pub struct Reach(pub Arc<dyn Fn(usize, Point) -> bool + Send + Sync>);

impl fmt::Debug for Reach {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("Reach")
    }
}

/// A value of a state.
#[derive(Clone, Debug)]
pub struct Variable {
    pub var: Var,
    /// Such as `agv1.slot[3]`.
    pub name: String,
    pub form: Form,
}

/// How a value is meant.
#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    /// With how much less the state holds.
    Int(i32),
    Point,
    Real,
}

impl Model {
    /// The value that stands here.
    pub(crate) fn cells_at(&self, var: Var) -> Cells {
        let at = var.at as usize;
        let owners = 1 << self.owners[at];
        let columns = if self.columns[at] == NO_CELL { 0 } else { 1 << (self.columns[at] % 64) };
        Cells { owners, columns }
    }

    /// What devices show by themselves is open in the next scan, whatever it was.
    pub(crate) fn open_inputs(&self, state: &mut [u8]) {
        self.inputs.iter().for_each(|input| input.var.store(state, 0));
        self.open_shown(state);
    }

    /// What machines have shown in a scan is open in the next one.
    pub(crate) fn open_shown(&self, state: &mut [u8]) {
        for Machine { route, lane, .. } in &self.machines {
            let shown = route.iter().filter_map(|route| route.shown);
            let shown = shown.chain(lane.iter().filter_map(|lane| lane.shown));
            shown.for_each(|shown| shown.store(state, 0));
        }
    }

    /// An operator resets a fault: the time in each state begins anew, and properties remember nothing.
    pub(crate) fn reset(&self, state: &mut [u8]) {
        for instance in &self.instances {
            let times = instance.times_come.into_iter().chain(instance.elapsed);
            let remembered = instance.properties.iter().flat_map(|property| property.check.remembered());
            times.chain(remembered).for_each(|var| var.store(state, 0));
        }
    }

    /// Whether all orders are made.
    pub fn is_made(&self, state: &[u8]) -> bool {
        self.orders.iter().all(|order| order.made.load(state) != 0)
    }

    /// Whether a machine is stopped by itself.
    pub fn stands(&self, state: &[u8], machine: usize) -> bool {
        self.instances[machine].stopped.is_some_and(|stopped| stopped.load(state) != 0)
    }

    /// Whether any machine is: then an operator has to come.
    pub fn any_stands(&self, state: &[u8]) -> bool {
        (0..self.instances.len()).any(|machine| self.stands(state, machine))
    }

    pub(crate) fn any_is_under_way(&self, state: &[u8]) -> bool {
        let mut heads = self.machines.iter().filter_map(|machine| machine.head.as_ref());
        heads.any(|head| head.status.load(state) == status::UNDER_WAY)
    }

    /// Variables of binders and quantifiers that one instance has at most.
    pub(crate) fn most_variables(&self) -> usize {
        self.instances.iter().map(|instance| instance.variables).max().unwrap_or(0)
    }
}
