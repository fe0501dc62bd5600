//! What is hardly meant in a line in which nothing has failed, although nothing goes wrong.

use crate::event::{self, What};
use crate::model::Model;
use crate::plant::{motion, status};
use crate::possible::{Possible, Stops};
use crate::program::Update;
use crate::successor::Successor;
use crate::violation::Violation;

impl Possible<'_> {
    /// Of each kind the first state, and what it is; of lines with orders alone.
    pub fn remarks(&mut self) -> Vec<(Violation, usize)> {
        let model = self.expander.model;
        if model.orders.is_empty() {
            return Vec::new();
        }
        let never_rests = self.never_rests().map(|state| (Violation::NeverRests, state));
        let (mut waits, mut repeats) = (None, None);
        let calm = self.calm();
        self.expander.answers = 1;
        self.expander.tell = true;
        for number in (0..self.store.len()).filter(|number| calm[*number]) {
            if waits.is_some() && repeats.is_some() {
                break;
            }
            let state = self.store.state(number);
            let mut stays = true;
            let expander = &mut self.expander;
            expander.expand(state, u64::MAX, &mut |successor| {
                stays &= !successor.events.is_empty() || successor.state == state;
                repeats = repeats.take().or_else(|| {
                    let machine = repeated(model, state, &successor)?;
                    Some((Violation::Repeats { machine }, number))
                });
            });
            if waits.is_none() && stays && !model.is_made(state) {
                waits = self.timer(state).map(|instance| (Violation::WaitsForTime { instance }, number));
            }
        }
        self.expander.tell = false;
        never_rests.into_iter().chain(waits).chain(repeats).collect()
    }

    /// The first state with all orders made from which the line cannot come to rest.
    fn never_rests(&mut self) -> Option<usize> {
        let model = self.expander.model;
        let calm = self.calm();
        let states = || (0..self.store.len()).map(|state| self.store.state(state));
        let can = states().map(|state| rests(model, state)).collect();
        let asked: Vec<bool> =
            states().zip(&calm).map(|(state, calm)| *calm && model.is_made(state)).collect();
        self.reach(can, &asked, Stops::AreNoWay)
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
    model.machines.iter().all(|machine| {
        machine.head.as_ref().is_none_or(|head| head.status.load(state) != status::UNDER_WAY)
            && machine.lane.as_ref().is_none_or(|lane| lane.motion.load(state) == motion::STANDS)
    })
}

/// A machine to which the command that is under way is given again, with the same goal.
fn repeated(model: &Model, before: &[u8], successor: &Successor) -> Option<usize> {
    let fired = successor.told.fired.iter();
    fired.map(|fired| (fired, &model.machines[fired.instance])).find_map(|(fired, plant)| {
        let machine = fired.instance;
        let head = plant.head.as_ref().filter(|head| head.status.load(before) == status::UNDER_WAY)?;
        let ends = |event: &event::Event| event.machine == machine && matches!(event.what, What::Ends(_));
        let command = head.command.load(before);
        let updates = &model.instances[machine].states[fired.state].transitions[fired.transition].updates;
        let is_same =
            |update: &Update| matches!(update, Update::Command(given) if given.command as i32 == command);
        let goals = plant.arm.iter().map(|arm| arm.goal).chain(plant.route.iter().map(|route| route.goal));
        let stays = goals.into_iter().all(|goal| goal.load(before) == goal.load(successor.state));
        (!successor.events.iter().any(ends) && updates.iter().any(is_same) && stays).then_some(machine)
    })
}
