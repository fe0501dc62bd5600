//! An arm with a gripper, on a rail or under a gantry.

use super::command::{Asked, Command, goal, is_held};
use super::course::Course;
use super::drive::{Drive, Moved, Target};
use super::gripper::Gripper;
use super::image::{in_arm, out, point, put_bit, put_point};
use crate::device::error;
use crate::kinematics::arm::Joints;
use crate::point::Point;
use crate::way::Load;

/// A `pick` waits so long at its goal for a part to be attached.
const PICK_WAIT_MS: u64 = 500;
/// Highest acceleration that `pace` takes, m/s2 or rad/s2: ten times that of a fall, more than any drive has.
const HIGHEST_GAIN: f64 = 100.0;

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

    pub fn joints(&self) -> Joints {
        self.drive.joints()
    }

    pub fn course(&self) -> Course {
        self.drive.under_way().map_or(Course::Rests, |motion| Course::Swings(motion.clone()))
    }

    /// A command is under way and not held, or the part on the gripper is about to slip.
    pub fn is_busy(&self) -> bool {
        self.command.is_under_way() && !self.held || self.gripper.is_slipping()
    }

    pub fn obey(&mut self, outputs: &[f64], now_ms: u64) {
        let now = seconds(now_ms);
        match self.command.accept(outputs) {
            Asked::Nothing => {}
            Asked::Start(verb) => self.begin(verb, outputs, now),
            Asked::Refused => self.abandon(now),
        }
        self.held = is_held(outputs);
        if self.held {
            self.drive.hold(now);
        } else {
            self.drive.resume(now);
        }
    }

    fn begin(&mut self, verb: i32, outputs: &[f64], now: f64) {
        match verb {
            1 => self.start(Task::Move, Target::Place(goal(outputs)), now),
            2 => self.start(Task::PickMove, Target::Place(goal(outputs)), now),
            3 => self.pace(outputs[out::TOP_SPEED], outputs[out::GAIN], now),
            4 if self.drive.has_torso() => {
                self.start(Task::Move, Target::Turned(goal(outputs), outputs[out::TURN]), now);
            }
            5 => self.start(Task::Move, Target::Past(point(outputs, out::VIA), goal(outputs)), now),
            6 if self.drive.has_torso() => {
                let load = if self.gripper.held().is_some() { Load::Largest } else { Load::None };
                let target = Target::Round(point(outputs, out::VIA), goal(outputs), load);
                self.start(Task::Move, target, now);
            }
            _ => self.fail(error::REFUSED, now),
        }
    }

    fn start(&mut self, task: Task, target: Target, now: f64) {
        if self.drive.start(target, now).is_some() {
            self.task = task;
        } else {
            self.fail(error::UNREACHABLE, now);
        }
    }

    fn pace(&mut self, speed: f64, gain: f64, now: f64) {
        let is_part = speed.is_normal() && speed > 0.0 && speed <= 1.0;
        let is_gain = gain.is_normal() && gain > 0.0 && gain <= HIGHEST_GAIN;
        if is_part && is_gain && self.drive.is_at_rest() {
            self.drive.set_pace(speed, gain);
            self.task = Task::None;
            self.command.end(error::NONE);
        } else {
            self.fail(error::REFUSED, now);
        }
    }

    fn fail(&mut self, error: i32, now: f64) {
        self.abandon(now);
        self.command.end(error);
    }

    fn abandon(&mut self, now: f64) {
        self.drive.stop(now);
        self.task = Task::None;
    }

    /// Moves on to the time `now_ms`, `dt_ms` after the last one. It brakes even while it is held.
    pub fn advance(&mut self, now_ms: u64, dt_ms: u64) {
        let moved = self.drive.advance(seconds(now_ms));
        if self.held {
            return;
        }
        match (self.task, moved) {
            (Task::Move, Moved::Arrived) => {
                self.task = Task::None;
                self.command.end(error::NONE);
            }
            (Task::PickMove, Moved::Arrived) => self.task = Task::PickWait { waited_ms: 0 },
            (Task::Move | Task::PickMove, Moved::Lost) => self.fail(error::UNREACHABLE, seconds(now_ms)),
            (Task::PickWait { waited_ms }, _) => {
                self.task = Task::PickWait { waited_ms: waited_ms + dt_ms };
            }
            (Task::Move | Task::PickMove, Moved::OnTheWay) | (Task::None, _) => {}
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

fn seconds(ms: u64) -> f64 {
    ms as f64 / 1000.0
}
