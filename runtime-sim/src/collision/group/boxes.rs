//! Boxes that contain a group and each of its bodies where it is, on each piece of its path, or for a time.

use super::super::body::Ball;
use super::super::bounds::BoundingBox;
use super::super::movement::Movement;
use super::super::{TOLERANCE, UNCERTAIN};
use super::{Anchor, Body, Group, Kind};
use crate::memory::Memory;
use crate::motion::Motion;
use crate::part::lane::CentreLine;
use crate::plant::Plant;
use std::sync::Arc;

/// Boxes that do not meet are farther apart than this, m: than what is in contact, and than what joints can differ by
/// that have the same fingerprint.
const NEAR: f64 = TOLERANCE + UNCERTAIN;
/// Pieces of the path of an arm, each of which has a box, and places in each of them at which it is checked.
const PIECES: usize = 16;
const PLACES: usize = 4;

/// What contains a group for a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Swept {
    pub all: BoundingBox,
    /// By the numbers of the bodies; that of nothing where there is none.
    pub bodies: Vec<BoundingBox>,
}

impl Swept {
    fn new(bodies: Vec<BoundingBox>) -> Self {
        Self { all: bodies.iter().fold(BoundingBox::NOTHING, |all, next| all.with(next)), bodies }
    }

    fn with(&self, other: &Self) -> Self {
        Self::new(self.bodies.iter().zip(&other.bodies).map(|(one, other)| one.with(other)).collect())
    }
}

impl Group {
    /// What contains it on each piece of its path, or all the while.
    pub fn boxes(&mut self, plant: &Plant, memory: &mut Memory) -> Arc<[Swept]> {
        if self.boxes.is_empty() {
            let moving = self.moving(plant).zip(self.machine());
            self.boxes = match (&self.movement, moving) {
                (Movement::Swings { motion, .. }, Some((moving, machine))) => {
                    let key = moving.with(machine as u64).and(self.numbered(plant));
                    memory.boxes(key, || self.swept(motion))
                }
                (Movement::Swings { motion, .. }, None) => self.swept(motion),
                // All that it can ever be in.
                (Movement::Slides { .. } | Movement::Rides { .. }, _) => {
                    [self.each(|body| body.bounds)].into()
                }
                (Movement::Still, _) if self.moves_parts() => [self.each(|body| body.bounds)].into(),
                (Movement::Still, _) => [self.present(plant)].into(),
            };
        }
        self.boxes.clone()
    }

    fn each(&self, of: impl Fn(&Body) -> BoundingBox) -> Swept {
        Swept::new(self.bodies.iter().map(|body| body.as_ref().map_or(BoundingBox::NOTHING, &of)).collect())
    }

    /// What contains all bodies where they are.
    fn present(&mut self, plant: &Plant) -> Swept {
        let mut bodies = vec![BoundingBox::NOTHING; self.bodies.len()];
        for (number, here) in bodies.iter_mut().enumerate() {
            let Some((anchor, ball)) = self.bodies[number].as_ref().map(|body| (body.anchor, body.ball))
            else {
                continue;
            };
            let frame = self.frame(anchor, plant, 0.0);
            let Ball { middle, radius } = ball.within(&frame);
            *here = BoundingBox::around(&Ball { middle, radius: radius + NEAR });
        }
        Swept::new(bodies)
    }

    /// On each piece of a path.
    fn swept(&self, motion: &Motion) -> Arc<[Swept]> {
        let Kind::Arm { arm, .. } = &self.kind else { return Arc::default() };
        let half = 0.5 / (PIECES * PLACES) as f64;
        let piece = |piece: usize| {
            let nothing = self.each(|_| BoundingBox::NOTHING);
            (0..PLACES).fold(nothing, |all, place| {
                let middle = (2 * (piece * PLACES + place) + 1) as f64 * half;
                let frames = arm.frames(&motion.along(middle));
                let here = self.each(|body| {
                    let Anchor::Link(link) = body.anchor else { return body.bounds };
                    let gone = body.travel.to(middle);
                    let reach =
                        (gone - body.travel.to(middle - half)).max(body.travel.to(middle + half) - gone);
                    let Ball { middle, radius } = body.ball.within(&frames[link]);
                    BoundingBox::around(&Ball { middle, radius: radius + reach + NEAR })
                });
                all.with(&here)
            })
        };
        (0..PIECES).map(piece).collect()
    }

    /// What contains it for so many seconds from now on.
    pub fn boxes_for(&mut self, seconds: f64, plant: &Plant, memory: &mut Memory) -> Swept {
        match &self.movement {
            Movement::Swings { .. } => {
                let [from, to] = self.movement.span(0.0, seconds);
                let boxes = self.boxes(plant, memory);
                let at = |place: f64| ((place * PIECES as f64) as usize).min(boxes.len() - 1);
                let mut pieces = boxes[at(from.min(to))..=at(from.max(to))].iter();
                let first = pieces.next().cloned().unwrap_or_else(|| self.each(|_| BoundingBox::NOTHING));
                pieces.fold(first, |all, next| all.with(next))
            }
            Movement::Rides { ride, now_ms } => {
                let corners = ride.corners(*now_ms, now_ms + 1000.0 * seconds);
                self.each(|body| {
                    if body.anchor != Anchor::Route {
                        return body.bounds.wider(NEAR);
                    }
                    let radius = body.ball.middle.length() + body.ball.radius + NEAR;
                    let boxes =
                        corners.iter().map(|corner| BoundingBox::around(&Ball { middle: *corner, radius }));
                    boxes.fold(BoundingBox::NOTHING, |all, next| all.with(&next))
                })
            }
            Movement::Still if !self.moves_parts() => self.boxes(plant, memory)[0].clone(),
            Movement::Slides { .. } | Movement::Still => {
                let mut bodies = vec![BoundingBox::NOTHING; self.bodies.len()];
                for (number, all) in bodies.iter_mut().enumerate() {
                    let Some(body) = &self.bodies[number] else { continue };
                    let (anchor, ball) = (body.anchor, Ball { radius: body.ball.radius + NEAR, ..body.ball });
                    *all = if self.goes_straight(anchor) {
                        let ends = [0.0, seconds].map(|time| self.frame(anchor, plant, time));
                        let [begin, end] = ends.map(|frame| BoundingBox::around(&ball.within(&frame)));
                        begin.with(&end)
                    } else {
                        body.bounds.wider(NEAR)
                    };
                }
                Swept::new(bodies)
            }
        }
    }

    /// Whether what has this anchor is at any time between where it is at the ends of that time, or rests.
    fn goes_straight(&self, anchor: Anchor) -> bool {
        match anchor {
            Anchor::World | Anchor::Link(_) | Anchor::Route => true,
            Anchor::Carriage(_) => false,
            Anchor::Lying { item, .. } => self.conveyed.get(&item).is_none_or(|conveyed| {
                let is_carried = conveyed.carried.is_some_and(|carried| carried.moves());
                !is_carried && !matches!(conveyed.centre_line, CentreLine::Arc { .. })
            }),
        }
    }
}
