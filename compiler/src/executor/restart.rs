//! Going on after a loss of power.

use super::{Alarm, Executor, Status};
use crate::ir::Value;
use runtime_sim::device::Direction;

impl Executor<'_> {
    /// Power was lost between two scans and is back: what is retained stays, all else is as at power-up.
    pub(super) fn begin_with_what_is_retained(&mut self) {
        let system = self.system;
        let fault = self.status.fault.filter(|_| system.model.retains());
        self.status = Status { fault, ..Status::NEW };
        self.scan = 0;
        self.permit = false;
        for robot in 0..self.robots.len() {
            self.begin_of(robot);
        }
    }

    fn begin_of(&mut self, robot: usize) {
        let system = self.system;
        let automaton = system.automaton_of(robot);
        let retained = &automaton.retained;
        let kept = &mut self.robots[robot];
        if !retained.state || !automaton.states[kept.state].is_resumable {
            kept.state = 0;
        }
        kept.elapsed = 0;
        kept.stopped = false;
        kept.alarms.fill(Alarm::NONE);
        for (number, (values, local)) in kept.locals.iter_mut().zip(&automaton.locals).enumerate() {
            if !retained.locals.contains(&number) {
                values.fill(local.initial);
            }
        }
        for (number, (values, port)) in kept.ports.iter_mut().zip(&automaton.device.ports).enumerate() {
            let is_command = matches!(port.name.as_str(), "cmd" | "verb") && automaton.device.is_commanded();
            let stays = retained.ports.contains(&number) || retained.state && is_command;
            if port.direction == Direction::Input || !stays {
                values.fill(Self::first_value(port.ty));
            }
        }
        self.cells_begin_anew(robot);
        let has_commanded = self.port_of(robot, "cmd") != 0;
        let goes_on = self.robots[robot].state != 0;
        self.set_truth(robot, automaton.abandoned, has_commanded);
        self.set_truth(robot, automaton.interrupted, has_commanded && goes_on);
    }

    /// Those of the instance, but for what is retained.
    pub(super) fn cells_begin_anew(&mut self, robot: usize) {
        let system = self.system;
        let automaton = system.automaton_of(robot);
        for (implemented, row) in automaton.implements.iter().zip(&system.instances[robot].rows) {
            let interface = implemented.interface;
            let cells =
                self.cells[interface.0][*row].iter_mut().zip(&system.model.interface(interface).cells);
            for (number, (values, cell)) in cells.enumerate() {
                if !automaton.retained.cells.contains(&(interface, number)) {
                    values.fill(cell.initial);
                }
            }
        }
    }

    /// A command was given: its answer counts.
    pub(super) fn commanded(&mut self, robot: usize) {
        let automaton = self.system.automaton_of(robot);
        self.set_truth(robot, automaton.abandoned, false);
        self.set_truth(robot, automaton.interrupted, false);
    }

    fn set_truth(&mut self, robot: usize, local: Option<usize>, truth: bool) {
        if let Some(local) = local {
            self.robots[robot].locals[local][0] = Value::Bool(truth);
        }
    }

    /// The answer to the last command does not count.
    pub(super) fn is_abandoned(&self, robot: usize) -> bool {
        self.system.automaton_of(robot).abandoned.is_some_and(|local| self.is_set(robot, local))
    }

    /// It counts as failed.
    pub(super) fn is_interrupted(&self, robot: usize) -> bool {
        self.system.automaton_of(robot).interrupted.is_some_and(|local| self.is_set(robot, local))
    }
}
