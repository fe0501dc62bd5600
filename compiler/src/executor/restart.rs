//! Going on after a loss of power.

use super::{Alarm, Executor, Seen, Status};
use crate::ir::{Element, Value};
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
        if !retained.state || !automaton.states[self.robots[robot].state].is_resumable {
            self.put_beginning(robot);
        }
        let kept = &mut self.robots[robot];
        kept.elapsed = 0;
        kept.stopped = false;
        kept.seen = Seen::default();
        kept.alarms.fill(Alarm::NONE);
        for (number, local) in automaton.locals.iter().enumerate() {
            if !retained.locals.contains(&number) {
                self.put_local(robot, number, local.initial);
            }
        }
        for (number, port) in automaton.device.ports.iter().enumerate() {
            let is_command = matches!(port.name.as_str(), "cmd" | "verb") && automaton.device.is_commanded();
            let stays = retained.ports.contains(&number) || retained.state && is_command;
            if port.direction == Direction::Input || !stays {
                self.put_first(robot, number);
            }
        }
        if self.robots[robot].state == 0 {
            automaton.outputs_that_stop().for_each(|port| self.put_first(robot, port));
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
            let (interface, row) = (implemented.interface, *row);
            for (cell, declared) in system.model.interface(interface).cells.iter().enumerate() {
                if automaton.retained.cells.contains(&(interface, cell)) {
                    continue;
                }
                for index in 0..self.cells[interface.0][row][cell].len() {
                    self.put(robot, Element::Cell { interface, row, cell, index }, declared.initial);
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
            self.put_local(robot, local, Value::Bool(truth));
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
