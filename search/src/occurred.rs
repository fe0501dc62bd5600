//! What has happened in the executions that are searched: of what never happens nothing is proved.

use crate::event::{Ending, Event, What};
use crate::model::Model;

/// Whatever is true here has happened in some execution.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Occurred {
    /// Of each property of each instance, by its number there, whether it was put to the test: its condition held, and of a
    /// `whenever` the goal did not.
    pub tested: Vec<Vec<bool>>,
    /// Of each command of each machine, by its number there.
    pub given: Vec<Vec<bool>>,
    pub succeeded: Vec<Vec<bool>>,
    /// Of each machine whether its gripper has taken an item.
    pub taken: Vec<bool>,
    /// Of each cylinder to which of [`crate::stroke::position`] it has come.
    pub strokes: Vec<[bool; 3]>,
    /// Of each process.
    pub begun: Vec<bool>,
    pub completed: Vec<bool>,
    /// What happens now belongs to an execution.
    pub(crate) is_noted: bool,
}

impl Occurred {
    pub(crate) fn new(model: &Model) -> Self {
        let commands = model.machines.iter().map(|machine| machine.head.as_ref());
        let commands: Vec<Vec<bool>> =
            commands.map(|head| vec![false; head.map_or(0, |head| head.commands.len())]).collect();
        Self {
            tested: model.instances.iter().map(|program| vec![false; program.properties.len()]).collect(),
            given: commands.clone(),
            succeeded: commands,
            taken: vec![false; model.machines.len()],
            strokes: vec![[false; 3]; model.cylinders.len()],
            begun: vec![false; model.processes.len()],
            completed: vec![false; model.processes.len()],
            is_noted: false,
        }
    }

    /// Adds what has happened in other executions.
    pub(crate) fn add(&mut self, other: &Self) {
        let add = |all: &mut [bool], more: &[bool]| all.iter_mut().zip(more).for_each(|(a, b)| *a |= b);
        let add_each = |all: &mut [Vec<bool>], more: &[Vec<bool>]| {
            all.iter_mut().zip(more).for_each(|(a, b)| add(a, b));
        };
        add_each(&mut self.tested, &other.tested);
        add_each(&mut self.given, &other.given);
        add_each(&mut self.succeeded, &other.succeeded);
        add(&mut self.taken, &other.taken);
        self.strokes.iter_mut().zip(&other.strokes).for_each(|(all, more)| add(all, more));
        add(&mut self.begun, &other.begun);
        add(&mut self.completed, &other.completed);
    }

    /// A property was put to the test.
    pub(crate) fn test(&mut self, instance: usize, property: usize) {
        if self.is_noted {
            self.tested[instance][property] = true;
        }
    }

    pub(crate) fn give(&mut self, machine: usize, command: usize) {
        if self.is_noted {
            self.given[machine][command] = true;
        }
    }

    /// A device does something in a state.
    pub(crate) fn event(&mut self, model: &Model, state: &[u8], event: Event) {
        match event.what {
            What::Ends(ending @ (Ending::Well | Ending::WithItem | Ending::WithItemUnseen)) => {
                if let Some(head) = &model.machines[event.machine].head {
                    self.succeeded[event.machine][head.command.load(state) as usize] = true;
                }
                self.taken[event.machine] |= ending != Ending::Well;
            }
            What::Takes | What::TakesAtStart => self.taken[event.machine] = true,
            What::Strokes { cylinder, to, .. } => self.strokes[cylinder][to as usize] = true,
            What::Begins(process) => self.begun[process] = true,
            What::Leaps(process) => {
                self.begun[process] = true;
                self.completed[process] = true;
            }
            What::Completes(process) => self.completed[process] = true,
            What::Ends(Ending::InVain | Ending::Refused(_))
            | What::Loses(_)
            | What::Shows
            | What::Opens
            | What::IsGone
            | What::TimeComes
            | What::Settles(_) => {}
        }
    }
}
