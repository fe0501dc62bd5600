//! Whether a group goes on as it did: each movement has a version.

use super::super::movement::Movement;
use super::{Anchor, Group, path_of_parts};
use crate::plant::Plant;
use crate::plant::trajectory::Trajectory;
use std::cell::OnceCell;

impl Group {
    /// Which of its movements this is.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Looks up how it is going to move from now on, unless it goes on as it did.
    pub fn follow(&mut self, plant: &Plant) {
        let Some(index) = self.machine().filter(|_| !self.is_fixed) else { return };
        let phase = plant.phase(index);
        if std::mem::replace(&mut self.phase, phase) != phase {
            self.look(index, plant);
        } else if cfg!(debug_assertions) && !plant.is_idle(index) {
            let mut again = self.clone();
            again.look(index, plant);
            debug_assert_eq!(again.version, self.version, "{} does not go on as it did", self.name);
        }
    }

    /// Looks up where it is on its path by now.
    pub fn catch_up(&mut self, plant: &Plant) {
        if let Some(index) = self.machine().filter(|_| !self.is_fixed)
            && self.now_ms != plant.now_ms() as f64
        {
            self.look(index, plant);
        }
    }

    fn look(&mut self, index: usize, plant: &Plant) {
        let now_ms = plant.now_ms() as f64;
        let passed = (now_ms - self.now_ms) / 1000.0;
        self.now_ms = now_ms;
        if plant.is_idle(index) {
            return;
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

    /// Counts how far it has gone at most since it was looked at.
    pub fn count_path(&mut self, plant: &Plant) {
        let passed = (plant.now_ms() as f64 - self.now_ms) / 1000.0;
        if self.moves() && passed > 0.0 {
            let times = [0.0, passed];
            let span = self.movement.span(0.0, passed);
            for body in self.bodies.iter_mut().flatten() {
                body.path +=
                    path_of_parts(&self.parts, body, times).unwrap_or_else(|| self.movement.path(body, span));
            }
        }
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
        self.bodies.iter_mut().flatten().for_each(|body| body.version = self.version);
        if goes_on {
            return;
        }
        self.forget_place();
        self.bodies.iter_mut().flatten().for_each(|body| body.travel = OnceCell::new());
    }

    /// How the items on its conveyors and its cylinders continue.
    fn follow_parts(&mut self, index: usize, plant: &Plant, passed: f64) {
        let moved = self.moves_parts();
        let followed = self.parts.follow(&self.bodies, index, plant, passed);
        if moved || !followed.all_go_on {
            self.moving = None;
            self.resting = None;
            self.borne = None;
        }
        if !followed.all_go_on {
            self.forget();
            let (mut items, mut strokes) =
                (followed.items.iter().peekable(), followed.strokes.iter().peekable());
            for body in self.bodies.iter_mut().flatten() {
                let new = match body.anchor {
                    Anchor::Lying { item, .. } => items.next_if_eq(&&item),
                    Anchor::Carriage(part) => strokes.next_if_eq(&&part),
                    Anchor::World | Anchor::Link(_) | Anchor::Route => None,
                };
                if new.is_some() {
                    body.version = self.version;
                }
            }
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
        self.boxes = None;
    }
}
