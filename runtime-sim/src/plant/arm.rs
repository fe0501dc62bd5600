//! An arm with a gripper, on a rail or under a gantry.

use super::command::{Asked, Command, goal, is_held};
use super::gripper::Gripper;
use super::image::{in_arm, put_bit, put_point};
use super::stub::Drive;
use crate::device::error;
use crate::point::Point;

/// A `pick` waits so long at its goal for a part to be attached.
const PICK_WAIT_MS: u64 = 500;

#[derive(Clone, Debug)]
pub struct Arm {
    pub command: Command,
    pub gripper: Gripper,
    drive: Drive,
    task: Task,
    held: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Task {
    None,
    Move,
    PickMove,
    PickWait { waited_ms: u64 },
}

impl Arm {
    pub fn new(command: Command, gripper: Gripper, drive: Drive) -> Self {
        Self { command, gripper, drive, task: Task::None, held: false }
    }

    pub fn tool(&self) -> Point {
        self.drive.tool()
    }

    /// A command is under way and not held, or the part on the gripper is about to slip.
    pub fn is_busy(&self) -> bool {
        self.command.is_under_way() && !self.held || self.gripper.is_slipping()
    }

    pub fn obey(&mut self, outputs: &[f64]) {
        match self.command.accept(outputs) {
            Asked::Nothing => {}
            Asked::Start(1) => self.start(Task::Move, goal(outputs)),
            Asked::Start(2) => self.start(Task::PickMove, goal(outputs)),
            Asked::Start(_) => self.fail(error::REFUSED),
            Asked::Refused => self.abandon(),
        }
        self.held = is_held(outputs);
    }

    fn start(&mut self, task: Task, goal: Point) {
        if self.drive.start(goal).is_some() {
            self.task = task;
        } else {
            self.fail(error::UNREACHABLE);
        }
    }

    fn fail(&mut self, error: i32) {
        self.abandon();
        self.command.end(error);
    }

    fn abandon(&mut self) {
        self.drive.stop();
        self.task = Task::None;
    }

    /// Moves.
    pub fn advance(&mut self, dt_ms: u64) {
        if self.held {
            return;
        }
        match self.task {
            Task::None => {}
            Task::Move => {
                if self.drive.advance(dt_ms).is_arrived() {
                    self.task = Task::None;
                    self.command.end(error::NONE);
                }
            }
            Task::PickMove => {
                if self.drive.advance(dt_ms).is_arrived() {
                    self.task = Task::PickWait { waited_ms: 0 };
                }
            }
            Task::PickWait { waited_ms } => self.task = Task::PickWait { waited_ms: waited_ms + dt_ms },
        }
    }

    /// Ends a pick, once it is known what hangs on the gripper.
    pub fn settle(&mut self) {
        let Task::PickWait { waited_ms } = self.task else { return };
        if self.held {
            return;
        }
        if self.gripper.held().is_some() {
            self.task = Task::None;
            self.command.end(error::NONE);
        } else if waited_ms >= PICK_WAIT_MS {
            self.task = Task::None;
            self.command.end(error::NO_PART);
        }
    }

    pub fn write(&self, image: &mut [f64]) {
        self.command.write(image);
        put_bit(image, in_arm::ATTACHED, self.gripper.held().is_some());
        put_point(image, in_arm::TOOL, self.tool());
    }
}
