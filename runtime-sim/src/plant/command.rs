//! The head of every commanded device: numbered commands and their answers.

use super::image::{in_head, out, point};
use crate::device::error;
use crate::point::Point;

/// The last command of a device, and its answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    got: i32,
    ack: i32,
    error: i32,
    accepted: u32,
    /// Which commands to refuse, counted from 1.
    refusals: Vec<u32>,
}

/// What the outputs of a scan ask of a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// Nothing new.
    Nothing,
    /// The verb with this number; the command before it is void.
    Start(i32),
    /// A command came and was refused; the command before it is void.
    Refused,
}

impl Command {
    pub fn new(refusals: Vec<u32>) -> Self {
        Self { got: 0, ack: 0, error: error::NONE, accepted: 0, refusals }
    }

    /// Takes a command if the number is new. Number 0 is no command.
    pub fn accept(&mut self, outputs: &[f64]) -> Asked {
        let number = outputs[out::CMD] as i32;
        if number == self.got || number == 0 {
            return Asked::Nothing;
        }
        self.got = number;
        self.accepted = self.accepted.saturating_add(1);
        if self.refusals.contains(&self.accepted) {
            self.end(error::REFUSED);
            return Asked::Refused;
        }
        Asked::Start(outputs[out::VERB] as i32)
    }

    pub fn is_under_way(&self) -> bool {
        self.got != self.ack
    }

    /// Answers the command under way: reached (0), or why not.
    pub fn end(&mut self, error: i32) {
        self.ack = self.got;
        self.error = error;
    }

    pub fn write(&self, image: &mut [f64]) {
        image[in_head::READY] = 1.0;
        image[in_head::GOT] = f64::from(self.got);
        image[in_head::ACK] = f64::from(self.ack);
        image[in_head::ERROR] = f64::from(self.error);
    }
}

/// The argument `goal` of a command.
pub fn goal(outputs: &[f64]) -> Point {
    point(outputs, out::GOAL)
}

pub fn is_held(outputs: &[f64]) -> bool {
    outputs[out::HOLD] != 0.0
}
