//! Operating modes: what a person does with one machine at its panel.

use super::Executor;
use crate::ir::{Action, ByHand, KeptBy, Modes, Scalar, Value};
use runtime_sim::device::{Direction, Stop};

impl Executor<'_> {
    /// The turn of an instance, before its step.
    pub(super) fn operate(&mut self, robot: usize) {
        let system = self.system;
        if let Some(modes) = &system.automaton_of(robot).modes {
            self.actions(robot, &modes.actions);
        }
    }

    pub(super) fn is_set(&self, robot: usize, local: usize) -> bool {
        self.robots[robot].locals[local][0] == Value::Bool(true)
    }

    pub(super) fn is_single(&mut self, robot: usize) -> bool {
        let system = self.system;
        system.automaton_of(robot).modes.as_ref().is_some_and(|modes| self.holds(robot, &modes.is_single))
    }

    /// Once it is stopped.
    pub(super) fn may_go_on(&mut self, robot: usize) -> bool {
        let system = self.system;
        system.automaton_of(robot).modes.as_ref().is_none_or(|modes| self.holds(robot, &modes.may_go_on))
    }

    fn actions(&mut self, robot: usize, actions: &[Action]) {
        for action in actions {
            match action {
                Action::Update(update) => {
                    let done = self.update(robot, update);
                    debug_assert!(done.is_ok(), "an update of a mode cannot fault");
                }
                Action::Stop => self.robots[robot].stopped = true,
                Action::BeginAnew => self.begin_anew(robot),
                Action::If { condition, then, otherwise, .. } => {
                    let taken = if self.holds(robot, condition) { then } else { otherwise };
                    self.actions(robot, taken);
                }
            }
        }
    }

    fn begin_anew(&mut self, robot: usize) {
        let system = self.system;
        let automaton = system.automaton_of(robot);
        self.put_beginning(robot);
        self.robots[robot].elapsed = 0;
        for (number, local) in automaton.locals.iter().enumerate() {
            if local.kept_by != KeptBy::Modes && !automaton.retained.locals.contains(&number) {
                self.put_local(robot, number, local.initial);
            }
        }
        automaton.outputs_that_stop().for_each(|port| self.put_first(robot, port));
        self.cells_begin_anew(robot);
    }

    /// Appends what an instance publishes. While it neither runs nor is moved by hand, that is stop values.
    pub(super) fn outputs_of_mode(&mut self, robot: usize, modes: &Modes, runs: bool, image: &mut Vec<f64>) {
        let moves = runs && !self.is_set(robot, modes.moved_by_hand) && !self.is_abandoned(robot)
            || modes.commanded.is_some_and(|commanded| self.is_set(robot, commanded));
        let ports = &self.system.automaton_of(robot).device.ports;
        for (number, port) in ports.iter().enumerate().filter(|(_, port)| port.direction == Direction::Output)
        {
            match (port.stop, &modes.published[number]) {
                (Stop::Value(stop), Some(ByHand::Hold)) => image.push(if moves { 0.0 } else { stop }),
                _ => {
                    let values = self.put_out(robot, number, runs);
                    values.iter().for_each(|value| value.push_words(image));
                }
            }
        }
    }

    /// What is put out at a port that is no `hold`; `runs` says whether the line runs, and the instance is not stopped.
    pub(super) fn put_out(&mut self, robot: usize, port: usize, runs: bool) -> Vec<Value> {
        let system = self.system;
        let automaton = system.automaton_of(robot);
        let set = self.robots[robot].ports[port].clone();
        let is_set = |local: Option<usize>| local.is_some_and(|local| self.is_set(robot, local));
        let modes = automaton.modes.as_ref();
        let runs = runs && !is_set(modes.map(|modes| modes.moved_by_hand));
        let (by_hand, commanded) =
            modes.map_or((false, false), |modes| (is_set(modes.by_hand), is_set(modes.commanded)));
        let declared = &automaton.device.ports[port];
        match (declared.stop, modes.and_then(|modes| modes.published[port].as_ref())) {
            (Stop::Value(_), Some(ByHand::Panel(value))) if by_hand => vec![self.value(robot, value)],
            (Stop::Value(_), Some(ByHand::Argument)) if commanded => set,
            (Stop::Value(stop), _) if !runs => {
                vec![Value::from_words(Scalar::from(declared.ty), &[stop]); set.len()]
            }
            _ => set,
        }
    }
}
