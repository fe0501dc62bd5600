//! Operating modes: what a person does with one machine at its panel.

use super::{Automaton, Expr, Update};
use runtime_sim::device::{Direction, Stop};

/// How the instances of a type are operated beside the line. Numbers of locals are those of the type.
#[derive(Clone, Debug)]
pub struct Modes {
    /// What is done at the turn of an instance in every scan, before its step, whether the line runs or not.
    pub actions: Vec<Action>,
    /// A local: transitions are tested in this scan.
    pub steps: usize,
    /// Single step is selected: nothing lasts too long.
    pub is_single: Expr,
    /// An instance that is stopped may continue with an edge of `start`.
    pub may_go_on: Expr,
    /// A local: outputs are those of the panel. None if there are none beside the arguments of commands.
    pub by_hand: Option<usize>,
    /// A local: something was done by hand since the instance made its last step.
    pub moved_by_hand: usize,
    /// A local of a device with commands: the panel has given one since its button is pressed.
    pub commanded: Option<usize>,
    /// For each port of the device that is an output with a stop value, what is published by hand instead of it.
    pub published: Vec<Option<ByHand>>,
}

#[derive(Clone, Debug)]
pub enum ByHand {
    /// What the panel says.
    Panel(Expr),
    /// The argument of a command: as it was given with it.
    Argument,
    /// `hold`: false with a command, else true.
    Hold,
}

/// What is done for a mode.
#[derive(Clone, Debug)]
pub enum Action {
    /// It never faults.
    Update(Update),
    /// The instance is stopped.
    Stop,
    /// State, locals and cells of its own are those of power-up, but for what is retained; so are outputs with stop
    /// values, even if they are retained.
    BeginAnew,
    If {
        /// Why, in a sentence; empty if the condition says it.
        about: &'static str,
        condition: Expr,
        then: Vec<Action>,
        otherwise: Vec<Action>,
    },
}

impl Automaton {
    /// Outputs of the device with stop values, by their numbers, but for `hold`. They are as at power-up when an instance
    /// begins anew: no earlier command is finished.
    pub fn outputs_that_stop(&self) -> impl Iterator<Item = usize> {
        let has_stop =
            |port: &crate::device::Port| port.direction == Direction::Output && port.stop != Stop::Hold;
        let is_hold = |port: &crate::device::Port| self.device.is_commanded() && port.name == "hold";
        let ports = self.device.ports.iter().enumerate();
        let begins = move |(_, port): &(usize, &crate::device::Port)| has_stop(port) && !is_hold(port);
        ports.filter(begins).map(|(number, _)| number)
    }
}
