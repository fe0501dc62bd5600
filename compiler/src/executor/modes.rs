//! Operating modes: what a person does with one machine at its panel.

use super::Executor;
use crate::ir::{Action, ByHand, KeptBy, Modes, Value};
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
        automaton.outputs_that_begin_anew().for_each(|port| self.put_first(robot, port));
        self.cells_begin_anew(robot);
    }

    /// Appends what an instance publishes. While it neither runs nor is moved by hand, that is stop values.
    pub(super) fn outputs_of_mode(&mut self, robot: usize, modes: &Modes, runs: bool, image: &mut Vec<f64>) {
        let runs = runs && !self.is_set(robot, modes.moved_by_hand);
        let by_hand = modes.by_hand.is_some_and(|by_hand| self.is_set(robot, by_hand));
        let commanded = modes.commanded.is_some_and(|commanded| self.is_set(robot, commanded));
        let abandoned = self.is_abandoned(robot);
        let ports = &self.system.automaton_of(robot).device.ports;
        for (number, port) in ports.iter().enumerate().filter(|(_, port)| port.direction == Direction::Output)
        {
            let own = self.robots[robot].ports[number].clone();
            match (port.stop, &modes.published[number]) {
                (Stop::Value(stop), Some(ByHand::Hold)) => {
                    let moves = (runs && !abandoned) || commanded;
                    image.push(if moves { 0.0 } else { stop });
                }
                (Stop::Value(_), Some(ByHand::Panel(value))) if by_hand => {
                    self.value(robot, value).push_words(image);
                }
                (Stop::Value(_), Some(ByHand::Argument)) if commanded => {
                    own.iter().for_each(|value| value.push_words(image));
                }
                (Stop::Value(stop), _) if !runs => image.extend(own.iter().map(|_| stop)),
                _ => own.iter().for_each(|value| value.push_words(image)),
            }
        }
    }
}
