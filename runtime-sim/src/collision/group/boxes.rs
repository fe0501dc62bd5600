//! Boxes that contain a group and each of its bodies where it is, on each piece of its path, or for a time.

use super::super::body::Ball;
use super::super::bounds::BoundingBox;
use super::super::movement::Movement;
use super::super::{TOLERANCE, UNCERTAIN};
use super::{Anchor, Body, Group, Kind, present};
use crate::kinematics::arm::Frames;
use crate::memory::Memory;
use crate::motion::Motion;
use crate::part::lane::CentreLine;
use crate::plant::Plant;
use std::ops::RangeInclusive;
use std::sync::Arc;

/// Boxes that do not meet are farther apart than this, m: than what is in contact, and than what joints can differ by
/// that have the same fingerprint.
pub const NEAR: f64 = TOLERANCE + UNCERTAIN;
/// Pieces of the path of an arm, each of which has a box, and places in each of them at which it is checked.
const PIECES: usize = 16;
const PLACES: usize = 4;
/// Of a body whose ball has a greater radius the pieces are looked at, m: of a long beam it holds much besides.
const LONG: f64 = 0.1;

/// What contains a group for a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Swept {
    pub all: BoundingBox,
    /// Without what stands in the world.
    moving: BoundingBox,
    /// By the numbers of the bodies.
    stands: Arc<[bool]>,
    /// By the numbers of the bodies; that of nothing where there is none.
    pub bodies: Vec<BoundingBox>,
}

impl Swept {
    fn new(bodies: Vec<BoundingBox>, stands: Arc<[bool]>) -> Self {
        let moving = bodies.iter().zip(&*stands).filter(|(_, stands)| !**stands).map(|(body, _)| body);
        Self {
            all: bodies.iter().fold(BoundingBox::NOTHING, |all, next| all.with(next)),
            moving: moving.fold(BoundingBox::NOTHING, |all, next| all.with(next)),
            bodies,
            stands,
        }
    }

    fn with(mut self, other: &Self) -> Self {
        self.all = self.all.with(&other.all);
        self.moving = self.moving.with(&other.moving);
        for (one, other) in self.bodies.iter_mut().zip(&other.bodies) {
            *one = one.with(other);
        }
        self
    }

    fn outer(&self) -> Outer {
        Outer { all: self.all, moving: self.moving }
    }

    /// What stands in the world is left out.
    pub fn without_standing(mut self) -> Self {
        for (body, stands) in self.bodies.iter_mut().zip(&*self.stands) {
            if *stands {
                *body = BoundingBox::NOTHING;
            }
        }
        Self { all: self.moving, ..self }
    }

    /// Whether no body of one can come near one of the other; what stands in the world stays as it is.
    pub fn is_apart(&self, other: &Self) -> bool {
        if self.outer().is_apart(&other.outer()) {
            return true;
        }
        let near = self.bodies.iter().zip(&*self.stands).filter(|(own, _)| !own.is_apart(&other.all));
        near.into_iter().all(|(own, stands)| {
            let mut others = other.bodies.iter().zip(&*other.stands);
            others.all(|(body, also)| *stands && *also || own.is_apart(body))
        })
    }
}

/// What contains a group on each piece of its path, or all the while, and as long as it goes on like this.
#[derive(Clone, Debug, PartialEq)]
pub struct Boxes {
    pub pieces: Vec<Swept>,
    pub whole: Swept,
}

impl Boxes {
    /// One piece at least.
    fn new(pieces: Vec<Swept>) -> Self {
        let (first, others) = pieces.split_first().unwrap_or_else(|| unreachable!("a path has a piece"));
        Self { whole: others.iter().fold(first.clone(), |all, next| all.with(next)), pieces }
    }

    /// Of what is not looked at.
    pub fn unknown() -> Self {
        let nothing = Swept::new(Vec::new(), Arc::default());
        Self { pieces: Vec::new(), whole: nothing }
    }

    pub fn of(swept: Swept) -> Self {
        Self::new(vec![swept])
    }
}

/// What contains a group for a time, without a look at its bodies.
#[derive(Clone, Copy, Debug)]
pub struct Outer {
    all: BoundingBox,
    /// Without what stands in the world.
    moving: BoundingBox,
}

impl Outer {
    pub const NOTHING: Self = Self { all: BoundingBox::NOTHING, moving: BoundingBox::NOTHING };

    pub fn with(&self, other: &Self) -> Self {
        Self { all: self.all.with(&other.all), moving: self.moving.with(&other.moving) }
    }

    /// What stands in the world is left out.
    pub fn without_standing(&self) -> Self {
        Self { all: self.moving, ..*self }
    }

    /// Whether the two cannot come near one another; what stands in the world stays as it is.
    pub fn is_apart(&self, other: &Self) -> bool {
        self.moving.is_apart(&other.all) && self.all.is_apart(&other.moving)
    }
}

impl Group {
    /// What contains it on each piece of its path, or all the while.
    pub fn boxes(&mut self, plant: &Plant, memory: &mut Memory) -> Arc<Boxes> {
        if let Some(boxes) = &self.boxes {
            return boxes.clone();
        }
        let moving = self.moving(plant).zip(self.machine());
        let boxes = match (&self.movement, moving) {
            (Movement::Swings { motion, .. }, Some((moving, machine))) => {
                let key = moving.with(machine as u64).and(self.numbered(plant));
                memory.boxes(key, || Arc::new(self.swept(motion)))
            }
            (Movement::Swings { motion, .. }, None) => Arc::new(self.swept(motion)),
            // All that it can ever be in.
            (Movement::Slides { .. } | Movement::Rides { .. }, _) => {
                Arc::new(Boxes::of(self.each(|body| body.bounds)))
            }
            (Movement::Still, _) if self.moves_parts() => Arc::new(Boxes::of(self.each(|body| body.bounds))),
            (Movement::Still, _) => self.boxes_at_rest(plant, memory),
        };
        self.boxes.insert(boxes).clone()
    }

    /// What contains it where it rests: of an arm, which comes to the same places again and again, as remembered.
    fn boxes_at_rest(&mut self, plant: &Plant, memory: &mut Memory) -> Arc<Boxes> {
        let resting = self.resting(plant);
        let key = match (&self.kind, resting) {
            (Kind::Arm { index, .. }, Some(resting)) => resting.with(*index as u64).and(self.numbered(plant)),
            _ => return Arc::new(Boxes::of(self.present(plant))),
        };
        memory.boxes_at_rest(key, || Arc::new(Boxes::of(self.present(plant))))
    }

    /// What contains it all the while, and as long as it goes on like this.
    pub fn outer(&mut self, plant: &Plant, memory: &mut Memory) -> Outer {
        match &self.boxes {
            Some(boxes) => boxes.whole.outer(),
            None => self.boxes(plant, memory).whole.outer(),
        }
    }

    /// Whether each body stands in the world.
    fn stands(&self) -> Arc<[bool]> {
        let stands = |body: &Option<Body>| body.as_ref().is_none_or(|body| body.anchor == Anchor::World);
        self.bodies.iter().map(stands).collect()
    }

    /// What contains the bodies that stand in the world.
    pub fn standing_boxes(&self) -> Swept {
        self.each(|body| if body.anchor == Anchor::World { body.bounds } else { BoundingBox::NOTHING })
    }

    fn each(&self, of: impl Fn(&Body) -> BoundingBox) -> Swept {
        let bodies = self.bodies.iter().map(|body| body.as_ref().map_or(BoundingBox::NOTHING, &of));
        Swept::new(bodies.collect(), self.stands())
    }

    /// What contains all bodies where they are.
    fn present(&mut self, plant: &Plant) -> Swept {
        let mut bodies = vec![BoundingBox::NOTHING; self.bodies.len()];
        for (number, here) in bodies.iter_mut().enumerate() {
            let Some(anchor) = self.bodies[number].as_ref().map(|body| body.anchor) else { continue };
            let frame = self.frame(anchor, plant, 0.0);
            if let Some(body) = &self.bodies[number] {
                *here = if anchor == Anchor::World { body.bounds } else { present(&body.pieces, &frame) };
            }
        }
        Swept::new(bodies, self.stands())
    }

    /// On each piece of a path.
    fn swept(&self, motion: &Motion) -> Boxes {
        let Kind::Arm { arm, .. } = &self.kind else { return Boxes::of(self.each(|body| body.bounds)) };
        let half = 0.5 / (PIECES * PLACES) as f64;
        let stands = self.stands();
        let piece = |piece: usize| {
            let mut bodies = vec![BoundingBox::NOTHING; self.bodies.len()];
            for place in 0..PLACES {
                let middle = (2 * (piece * PLACES + place) + 1) as f64 * half;
                let frames = arm.frames(&motion.along(middle));
                let places = [middle - half, middle, middle + half];
                let sections = self.sections_of(motion, places);
                for (all, body) in bodies.iter_mut().zip(&self.bodies) {
                    if let Some(body) = body {
                        let reach = sections
                            .map_or(0.0, |sections| body.travel(motion).from_middle(places, sections));
                        *all = all.with(&present_within(body, &frames, reach));
                    }
                }
            }
            Swept::new(bodies, stands.clone())
        };
        Boxes::new((0..PIECES).map(piece).collect())
    }

    /// Of the path of an arm, those on which it is between two times.
    fn pieces_between(&self, [from, to]: [f64; 2]) -> RangeInclusive<usize> {
        let [from, to] = self.movement.span(from, to);
        let at = |place: f64| ((place * PIECES as f64) as usize).min(PIECES - 1);
        at(from.min(to))..=at(from.max(to))
    }

    /// What contains all of it between two times; none if only its bodies say that.
    pub fn outer_between(&mut self, times: [f64; 2], plant: &Plant, memory: &mut Memory) -> Option<Outer> {
        let pieces = match &self.movement {
            Movement::Swings { .. } => self.pieces_between(times),
            Movement::Still if !self.moves_parts() => 0..=0,
            Movement::Still | Movement::Rides { .. } | Movement::Slides { .. } => return None,
        };
        let boxes = self.boxes(plant, memory);
        boxes.pieces[pieces].iter().map(Swept::outer).reduce(|all, next| all.with(&next))
    }

    /// What contains it between two times, seconds from now.
    pub fn boxes_between(&mut self, [from, to]: [f64; 2], plant: &Plant, memory: &mut Memory) -> Swept {
        match &self.movement {
            Movement::Swings { .. } => {
                let pieces = self.pieces_between([from, to]);
                let boxes = self.boxes(plant, memory);
                let mut pieces = boxes.pieces[pieces].iter();
                let first = pieces.next().cloned().unwrap_or_else(|| self.each(|_| BoundingBox::NOTHING));
                pieces.fold(first, |all, next| all.with(next))
            }
            Movement::Rides { ride, now_ms } => {
                let corners = ride.corners(now_ms + 1000.0 * from, now_ms + 1000.0 * to);
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
            Movement::Still if !self.moves_parts() => self.boxes(plant, memory).whole.clone(),
            Movement::Slides { .. } | Movement::Still => {
                let mut bodies = vec![BoundingBox::NOTHING; self.bodies.len()];
                for (number, all) in bodies.iter_mut().enumerate() {
                    let Some(body) = &self.bodies[number] else { continue };
                    let (anchor, ball) = (body.anchor, Ball { radius: body.ball.radius + NEAR, ..body.ball });
                    *all = if self.goes_straight(anchor) {
                        let ends = [from, to].map(|time| self.frame(anchor, plant, time));
                        let [begin, end] = ends.map(|frame| BoundingBox::around(&ball.within(&frame)));
                        begin.with(&end)
                    } else {
                        body.bounds.wider(NEAR)
                    };
                }
                Swept::new(bodies, self.stands())
            }
        }
    }

    /// Whether what has this anchor is at any time between where it is at the ends of that time, or rests.
    fn goes_straight(&self, anchor: Anchor) -> bool {
        match anchor {
            Anchor::World | Anchor::Link(_) | Anchor::Route => true,
            Anchor::Carriage(_) => false,
            Anchor::Lying { item, .. } => self.parts.conveyed(item).is_none_or(|conveyed| {
                let is_carried = conveyed.carried.is_some_and(|carried| carried.moves());
                !is_carried && !matches!(conveyed.centre_line, CentreLine::Arc { .. })
            }),
        }
    }
}

/// What contains a body of an arm that goes no farther than so many metres from where it is at these frames.
fn present_within(body: &Body, frames: &Frames, reach: f64) -> BoundingBox {
    let Anchor::Link(link) = body.anchor else { return body.bounds };
    if body.ball.radius > LONG {
        return present(&body.pieces, &frames[link]).wider(reach);
    }
    let Ball { middle, radius } = body.ball.within(&frames[link]);
    BoundingBox::around(&Ball { middle, radius: radius + reach + NEAR })
}
