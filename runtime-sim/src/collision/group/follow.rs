//! Whether a group goes on as it did: each movement has a version.

use super::super::movement::Movement;
use super::{Group, path_of_parts};
use crate::motion::Travel;
use crate::plant::Plant;
use crate::plant::trajectory::Trajectory;
use std::sync::Arc;

impl Group {
    /// Which of its movements this is.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Looks up how it is going to move from now on, and how far it has gone at most.
    pub fn follow(&mut self, plant: &Plant) {
        let Some(index) = self.machine().filter(|_| !self.is_fixed) else { return };
        let now_ms = plant.now_ms() as f64;
        let passed = (now_ms - self.now_ms) / 1000.0;
        self.now_ms = now_ms;
        if plant.is_idle(index) {
            return;
        }
        if self.moves() && passed > 0.0 {
            let times = [0.0, passed];
            let span = self.movement.span(0.0, passed);
            for body in self.bodies.iter_mut().flatten() {
                body.path +=
                    path_of_parts(&self.parts, body, times).unwrap_or_else(|| self.movement.path(body, span));
            }
        }
        let trajectory = plant.trajectory(index).since(now_ms);
        if trajectory == Trajectory::Rests && self.movement.rests_after() <= passed {
            self.settle();
        } else if trajectory != self.trajectory {
            self.begin(Movement::new(&trajectory, now_ms));
            self.trajectory = trajectory;
        } else if self.trajectory != Trajectory::Rests {
            self.movement = Movement::new(&self.trajectory, now_ms);
        }
        self.follow_parts(index, plant, passed);
    }

    /// It has come to rest where it was going to.
    fn settle(&mut self) {
        self.trajectory = Trajectory::Rests;
        self.movement = Movement::Still;
        self.forget_place();
    }

    /// It moves in another way than before, or at other times.
    fn begin(&mut self, movement: Movement) {
        let goes_on = movement.goes_on(&self.movement);
        self.movement = movement;
        self.version += 1;
        if goes_on {
            return;
        }
        self.forget();
        if let Movement::Swings { motion, .. } = &self.movement {
            for body in self.bodies.iter_mut().flatten() {
                body.travel = body.radii.as_ref().map_or_else(Travel::default, |radii| motion.travel(radii));
            }
        }
    }

    /// How the items on its conveyors and its cylinders continue.
    fn follow_parts(&mut self, index: usize, plant: &Plant, passed: f64) {
        let moved = self.moves_parts();
        let goes_on = self.parts.follow(&self.bodies, index, plant, passed);
        if moved || !goes_on {
            self.moving = None;
            self.resting = None;
            self.borne = None;
        }
        if !goes_on {
            self.forget();
        }
    }

    /// Seconds from now until it rests, or something on it does, if nothing new is asked of it; infinity: never, or all
    /// of it is at rest.
    pub fn rests_after(&self) -> f64 {
        self.movement.rests_after().min(self.parts.rests_after())
    }

    /// What it bears has changed, or it moves along another path.
    pub(super) fn forget(&mut self) {
        self.version += 1;
        self.forget_place();
    }

    /// It is where it was going to, or elsewhere.
    fn forget_place(&mut self) {
        self.moving = None;
        self.resting = None;
        self.borne = None;
        self.along = None;
        self.boxes = Arc::default();
        self.whole = None;
    }
}
