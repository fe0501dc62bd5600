//! Where a vehicle under way has set out.
//!
//! It makes a difference only to who is where the vehicle may be. So the search begins as if nobody ever was, and forgets it
//! as long as the vehicle is under way. If an arm is at one of its stops then, or its automaton asks where it is, where it
//! has set out is known from then on in that state of the automaton, and the search begins anew.

use crate::model::Model;
use crate::plant::status;
use crate::program::bit;
use crate::scan::Scan;
use crate::unread::Needed;
use crate::value::{Point, Values, Var};

/// An arm is at a place if its tool, or the start or the goal of its motion, is no farther than this from its floor and its
/// slots in x and in y, m: far enough for what it loses beside them. Grippers may reach farther.
const MARGIN: f64 = 0.5;

/// A vehicle, and where it is forgotten where it has set out.
#[derive(Clone, Debug)]
pub struct Start {
    pub machine: usize,
    /// Where it is, or was when its trip began.
    pub at: Var,
    /// The same for instances of the same type.
    pub kind: usize,
    /// Of each state of its automaton whether it has to be known.
    pub known: Vec<bool>,
}

/// Vehicles that may be at this point, a bit each.
fn vehicles_at(model: &Model, [x, y, _]: Point) -> u64 {
    let arms = model.machines.iter().filter_map(|machine| machine.arm.as_ref());
    let margin = arms.map(|arm| arm.near).fold(MARGIN, f64::max);
    let is_at = |machine: usize| {
        let plant = &model.machines[machine];
        let Some(route) = &plant.route else { return false };
        let carried = plant.places.iter().filter(|place| place.stands.is_none());
        carried.into_iter().any(|place| {
            route.stops.iter().any(|stop| {
                let (dx, dy) = (x - stop[0], y - stop[1]);
                place.floor.is_near([dx, dy], margin)
                    || place
                        .slots
                        .iter()
                        .any(|slot| (dx - slot[0]).abs() <= margin && (dy - slot[1]).abs() <= margin)
            })
        })
    };
    model.unread.starts.iter().filter(|start| is_at(start.machine)).fold(0, |all, s| all | bit(s.machine))
}

impl Scan<'_> {
    /// Forgets where vehicles have set out that are under way; notes where that has to be known.
    pub(crate) fn forget_starts(&mut self) {
        let model = self.model;
        for Start { machine, at, known, .. } in &model.unread.starts {
            let Some(head) = &model.machines[*machine].head else { continue };
            let state = model.instances[*machine].state.load(self.bytes) as usize;
            let is_forgotten = at.load(self.bytes) == Values::NOWHERE;
            if head.status.load(self.bytes) == status::UNDER_WAY && !known[state] {
                if !is_forgotten && self.is_at_stop(*machine) {
                    at.store(self.bytes, Values::NOWHERE);
                }
            } else if is_forgotten {
                self.need_start(*machine);
            }
        }
    }

    /// A trip that is replaced may leave a vehicle elsewhere.
    fn is_at_stop(&self, machine: usize) -> bool {
        let Some(route) = &self.model.machines[machine].route else { return false };
        let at = self.values.point(route.at.load(self.bytes));
        route.stops.contains(&at)
    }

    /// What is read here is a place; it may be where a vehicle is.
    pub(crate) fn ask_start_at(&mut self, var: Var) {
        let start = self.model.unread.starts.iter().find(|start| start.at == var);
        if let Some(machine) = start.map(|start| start.machine) {
            self.ask_start(machine);
        }
    }

    /// Somebody asks where a vehicle is.
    pub(crate) fn ask_start(&mut self, machine: usize) {
        let route = self.model.machines[machine].route.as_ref();
        if route.is_some_and(|route| route.at.load(self.bytes) == Values::NOWHERE) {
            self.need_start(machine);
        }
    }

    /// Arms may be where vehicles are of which it is forgotten where that is.
    pub(crate) fn ask_starts(&mut self) {
        let model = self.model;
        let is_forgotten = |start: &&Start| start.at.load(self.bytes) == Values::NOWHERE;
        let forgotten = model.unread.starts.iter().filter(is_forgotten);
        let forgotten = forgotten.fold(0, |all, start| all | bit(start.machine));
        if forgotten == 0 {
            return;
        }
        let mut met = 0;
        for arm in model.machines.iter().filter_map(|machine| machine.arm.as_ref()) {
            let ends = [arm.via, arm.goal].map(|place| place.load(self.bytes));
            let ends = ends.into_iter().filter(|number| *number != 0);
            for number in ends.chain([arm.tool.load(self.bytes)]) {
                met |= self.values.vehicles_at(number, |point| vehicles_at(model, point));
            }
        }
        for start in model.unread.starts.iter().filter(|start| met & forgotten & bit(start.machine) != 0) {
            self.need_start(start.machine);
        }
    }

    #[cold]
    fn need_start(&mut self, machine: usize) {
        let before: &[u8] = if self.looks_back { self.bytes } else { self.before };
        let state = self.model.instances[machine].state.load(before) as usize;
        let needed = Needed::Start { machine, state };
        if !self.needed.contains(&needed) {
            self.needed.push(needed);
        }
    }
}
