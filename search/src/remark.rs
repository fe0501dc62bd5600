//! What is hardly meant, although nothing goes wrong.

use crate::event::{self, What};
use crate::model::Model;
use crate::plant::{Action, Arm, Asked, Faults, motion};
use crate::possible::{Open, Possible, Stops};
use crate::program::bit;
use crate::scan::Scan;
use crate::successor::Expander;
use crate::surface;
use crate::violation::Violation;
use std::collections::HashMap;
use std::collections::hash_map::Entry;

impl Possible<'_> {
    /// Of each kind the first state, and what it is.
    pub fn remarks(&mut self) -> Result<Vec<(Violation, usize)>, Open> {
        let model = self.expander.model;
        if model.orders.is_empty() {
            let stand = self.comes_to_a_stand()?.map(|state| (Violation::ComesToAStand, state));
            return Ok(stand.into_iter().collect());
        }
        let never_rests = self.never_rests()?.map(|state| (Violation::NeverRests, state));
        self.expander.answers = 1;
        Ok(never_rests.into_iter().chain(self.waits_for_time()?).collect())
    }

    /// The first state, with no failure before it, from which nothing ever changes but inputs by themselves; none if items are
    /// not known that could come.
    fn comes_to_a_stand(&mut self) -> Result<Option<usize>, Open> {
        if self.expander.model.hides_items {
            return Ok(None);
        }
        let goes_on = self.go_on();
        let calm = self.calm();
        self.reach(goes_on, &calm, Stops::AreGoals)
    }

    /// The first state in which the whole line waits for a time of an instance whose device has not failed.
    fn waits_for_time(&mut self) -> Result<Option<(Violation, usize)>, Open> {
        let model = self.expander.model;
        let mut unfailed: HashMap<usize, Vec<bool>> = HashMap::new();
        for number in 0..self.states {
            let state = &self.store.state(number);
            let Some(instance) = self.timer(state).filter(|_| !model.is_made(state)) else { continue };
            self.allowance.check(0)?;
            let mut stays = true;
            self.expander.expand(state, u64::MAX, &mut |successor| {
                stays &= !successor.events.is_empty() || successor.state == state;
            });
            if !stays {
                continue;
            }
            let unfailed = match unfailed.entry(instance) {
                Entry::Occupied(known) => known.into_mut(),
                Entry::Vacant(unknown) => unknown.insert(self.without_failure_of(instance)?),
            };
            if unfailed[number] {
                return Ok(Some((Violation::WaitsForTime { instance }, number)));
            }
        }
        Ok(None)
    }

    /// States that are reached although a device does not fail, whatever others do.
    fn without_failure_of(&self, machine: usize) -> Result<Vec<bool>, Open> {
        let Self { store, expander, allowance, .. } = self;
        let model = Model { faults: Faults::All, ..expander.model.clone() };
        let mut expander = Expander::new(&model, 1, expander.orders);
        expander.cut = self.expander.cut.clone();
        expander.values.clone_from(&self.expander.values);
        let mut reached = vec![false; store.len()];
        reached[0] = true;
        let mut waiting = vec![0];
        while let Some(number) = waiting.pop() {
            allowance.check(0)?;
            let state = &store.state(number);
            expander.expand(state, u64::MAX, &mut |successor| {
                let fails = successor.events.iter().any(|event| {
                    event.machine == machine && event::is_fault(&model, &self.expander.values, state, event)
                });
                let to = (!fails && successor.result.is_ok()).then(|| store.find(successor.state)).flatten();
                if let Some(to) = to.filter(|to| !std::mem::replace(&mut reached[*to], true)) {
                    waiting.push(to);
                }
            });
        }
        allowance.check(0)?;
        Ok(reached)
    }

    /// The first state with all orders made from which the line cannot come to rest.
    fn never_rests(&mut self) -> Result<Option<usize>, Open> {
        let model = self.expander.model;
        let calm = self.calm();
        let states = || (0..self.states).map(|state| self.store.state(state));
        let can = states().map(|state| rests(model, &state)).collect();
        let asked: Vec<bool> =
            states().zip(&calm).map(|(state, calm)| *calm && model.is_made(&state)).collect();
        self.reach(can, &asked, Stops::AreNoGoal)
    }

    /// The instance whose time is the only thing that can come.
    fn timer(&self, state: &[u8]) -> Option<usize> {
        let model = self.expander.model;
        let mut events = Vec::new();
        for source in 0..event::sources(model) {
            event::events(model, &self.expander.values, state, source, &mut events);
        }
        let first = events.first()?.machine;
        events.iter().all(|event| event.what == What::TimeComes).then_some(first)
    }
}

/// No command is under way, and no conveyor runs.
fn rests(model: &Model, state: &[u8]) -> bool {
    let mut lanes = model.machines.iter().filter_map(|machine| machine.lane.as_ref());
    !model.any_is_under_way(state) && lanes.all(|lane| lane.motion.load(state) == motion::STANDS)
}

/// A tool that is moved by less goes straight up or down, m.
const STRAIGHT: f64 = 0.01;

impl Scan<'_> {
    /// What is hardly meant of the commands that were given in this scan.
    pub(crate) fn remark(&mut self) {
        let model = self.model;
        for (machine, plant) in model.machines.iter().enumerate() {
            if self.repeated & bit(machine) != 0 {
                self.remarked.push(Violation::Repeats { machine });
            }
            if self.given & bit(machine) != 0
                && let (Some(head), Some(arm)) = (&plant.head, &plant.arm)
            {
                let asked = &head.commands[head.command.load(self.bytes) as usize];
                if asked.action == Action::Motion && arm.goal.load(self.bytes) != 0 {
                    let remark = self.of_motion(machine, arm, asked);
                    self.remarked.extend(remark);
                }
            }
        }
    }

    fn of_motion(&self, machine: usize, arm: &Arm, asked: &Asked) -> Option<Violation> {
        let Self { model, values, bytes: state, .. } = self;
        let [tool, via, goal] = [arm.tool, arm.via, arm.goal].map(|place| values.point(place.load(state)));
        let is_empty = arm.holds.load(state) == 0;
        if asked.awaits.is_some_and(|awaits| awaits.is_hold) {
            if is_empty && surface::found(model, values, state, goal, arm.near).is_none() {
                let (at, slot) = surface::empty_slot(model, values, state, goal, arm.near)?;
                return Some(Violation::NothingThere { arm: machine, machine: at, slot });
            }
            return None;
        }
        let first = if arm.via.load(state) == 0 { goal } else { via };
        let is_straight = (0..2).all(|axis| (first[axis] - tool[axis]).abs() <= STRAIGHT);
        // One that is switched on for this motion is meant to be.
        let stays_on = arm.closes.is_some_and(|level| level.is_on(self.before) && level.is_on(state));
        let goes_down = is_straight && first[2] < tool[2];
        if stays_on && is_empty && !goes_down {
            return Some(Violation::OnAndEmpty { arm: machine });
        }
        if !asked.is_planned && !is_straight {
            let at = surface::low_in_slot(model, values, state, tool)?;
            return Some(Violation::LeavesSideways { arm: machine, machine: at });
        }
        None
    }
}
