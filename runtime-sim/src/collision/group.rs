//! All bodies of one machine or obstacle, and how they move from now on.

mod boxes;
pub(super) mod extent;
mod follow;
mod parts;
mod prints;

use super::body::{Ball, Piece};
use super::bounds::{BoundingBox, Chain, Radii};
use super::movement::Movement;
use crate::fingerprint::Fingerprint;
use crate::kinematics::arm::{Arm, Frames, Joints};
use crate::kinematics::pose::Pose;
use crate::line::{Line, Obstacle};
use crate::machine::Machine;
use crate::motion::{Motion, Travel};
use crate::plant::Plant;
use crate::plant::trajectory::Trajectory;
use crate::point::Point;
use crate::solid::{Link, Solid};
use boxes::NEAR;
pub use boxes::{Boxes, Outer, Swept};
use parts::Parts;
use std::cell::OnceCell;
use std::sync::Arc;

/// Solids that keep their places to one another.
#[derive(Clone, Debug)]
pub struct Body {
    pub anchor: Anchor,
    pub pieces: Vec<Piece>,
    /// Around all of them, in the frame of the anchor.
    pub ball: Ball,
    /// All that it can ever take.
    pub bounds: BoundingBox,
    /// Of an arm's joints, if it is fixed to one of the links.
    radii: Option<Radii>,
    /// Metres that no point of it has gone more than since the start of the run.
    pub path: f64,
    /// Along the path of the arm that is under way, once somebody has asked.
    travel: OnceCell<Travel>,
    /// Of an item: of its size, of how it is turned, and of how it hangs.
    item: Option<Fingerprint>,
    /// That of its group when it came, or last did not go on as before: the same never comes back at this number.
    pub version: u64,
}

/// What a body moves with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Anchor {
    World,
    /// An index into the frames of the arm.
    Link(usize),
    /// Along the route.
    Route,
    /// On a cylinder or a positioner, a part of the machine.
    Carriage(usize),
    /// Lies on the machine; the frame has its origin at the underside of the item and is turned by so many radians, as
    /// seen from the cylinder or positioner on which it is.
    Lying {
        item: usize,
        turn: f64,
    },
}

#[derive(Clone, Debug)]
pub struct Group {
    pub name: String,
    pub kind: Kind,
    /// Those of items may come and go, and leave their places to others.
    pub bodies: Vec<Option<Body>>,
    /// Nothing of it ever moves, nor what lies on it.
    is_fixed: bool,
    /// Another one if it does not go on as before, or bears something else.
    version: u64,
    /// The phase of the machine at the last look at the plant, and when that was.
    phase: u64,
    now_ms: f64,
    trajectory: Trajectory,
    movement: Movement,
    parts: Parts,
    /// Of an arm, as last checked.
    frames: Option<(Joints, Frames)>,
    /// At a place on the path under way, as last checked.
    along: Option<(f64, Frames)>,
    /// While it moves and comes to rest by itself: of where it moves along, from the beginning to the end. None until
    /// somebody asks.
    moving: Option<Fingerprint>,
    /// While it rests: of where it is.
    resting: Option<Fingerprint>,
    /// Of all items, and of where they are on the machine.
    borne: Option<Fingerprint>,
    /// None until somebody asks.
    boxes: Option<Arc<Boxes>>,
}

#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant)] // a dozen of them in all
pub enum Kind {
    Obstacle,
    Machine { index: usize, machine: Machine },
    Arm { index: usize, machine: Machine, arm: Arm, chain: Chain },
}

impl Body {
    /// Along the path of this motion of the arm, metres that no point of it goes more than; those of a body that no joint
    /// moves are none.
    pub fn travel(&self, motion: &Motion) -> &Travel {
        self.travel
            .get_or_init(|| self.radii.as_ref().map_or_else(Travel::default, |radii| motion.travel(radii)))
    }

    /// The item that lies on the machine, if it is one.
    fn lying(&self) -> Option<usize> {
        match self.anchor {
            Anchor::Lying { item, .. } => Some(item),
            Anchor::World | Anchor::Link(_) | Anchor::Route | Anchor::Carriage(_) => None,
        }
    }
}

impl Group {
    pub fn of_machine(line: &Line, index: usize) -> Self {
        let machine = &line.machines[index];
        let kind = match machine.arm() {
            Some(arm) => Kind::Arm { index, machine: machine.clone(), arm, chain: Chain::new(&arm, machine) },
            None => Kind::Machine { index, machine: machine.clone() },
        };
        Self::new(machine.name.clone(), kind, machine.solids())
    }

    pub fn of_obstacle(obstacle: &Obstacle) -> Self {
        Self::new(obstacle.name.clone(), Kind::Obstacle, obstacle.solid().into_iter().collect())
    }

    fn new(name: String, kind: Kind, mut solids: Vec<Solid>) -> Self {
        solids.sort_by_key(|solid| solid.link);
        let is_fixed = match &kind {
            Kind::Obstacle => true,
            Kind::Machine { machine, .. } | Kind::Arm { machine, .. } => {
                !machine.parts.iter().any(|part| part.moves())
            }
        };
        let mut group = Self {
            name,
            kind,
            is_fixed,
            bodies: Vec::new(),
            version: 0,
            phase: 0,
            now_ms: 0.0,
            trajectory: Trajectory::Rests,
            movement: Movement::Still,
            parts: Parts::default(),
            frames: None,
            along: None,
            moving: None,
            resting: None,
            borne: None,
            boxes: None,
        };
        for solids in solids.chunk_by(|a, b| a.link == b.link) {
            let anchor = match solids[0].link {
                Link::World => Anchor::World,
                Link::Joint(link) => Anchor::Link(link),
                Link::Route => Anchor::Route,
                Link::Carriage(part) => Anchor::Carriage(part),
            };
            let pieces: Vec<Piece> =
                solids.iter().map(|solid| Piece::new(solid.name.clone(), &solid.pose, solid.shape)).collect();
            let bounds = present(&pieces, &Pose::IDENTITY);
            group.bodies.push(Some(group.body(anchor, pieces, |_| bounds)));
        }
        group
    }

    /// `still` is the bounding box of what no joint and no vehicle moves.
    fn body(&self, anchor: Anchor, pieces: Vec<Piece>, still: impl Fn(&Ball) -> BoundingBox) -> Body {
        let ball = Ball::around(&pieces.iter().map(Piece::ball).collect::<Vec<_>>());
        let (radii, bounds) = match (anchor, &self.kind) {
            (Anchor::Link(link), Kind::Arm { chain, .. }) => {
                (Some(chain.radii(link, &ball)), chain.bounds(link, &ball))
            }
            (Anchor::Route, Kind::Machine { machine, .. } | Kind::Arm { machine, .. }) => {
                (None, extent::at_stops(machine, &ball))
            }
            (Anchor::Carriage(part), Kind::Machine { machine, .. } | Kind::Arm { machine, .. }) => {
                (None, extent::on_carriage(machine, part, &ball))
            }
            _ => (None, still(&ball)),
        };
        Body {
            anchor,
            pieces,
            ball,
            bounds,
            travel: OnceCell::new(),
            radii,
            path: 0.0,
            item: None,
            version: self.version,
        }
    }

    /// Adds an item that comes to lie or to hang here, with what lies on it; the number of its body.
    pub fn add_item(
        &mut self,
        anchor: Anchor,
        pieces: Vec<Piece>,
        item: Fingerprint,
        plant: &Plant,
    ) -> usize {
        self.forget();
        let mut body = match (anchor, &self.kind) {
            (
                Anchor::Lying { item, .. },
                Kind::Machine { index, machine } | Kind::Arm { index, machine, .. },
            ) => {
                let place = plant.place(item).unwrap_or_default();
                let offset = place - plant.position(*index).unwrap_or_default();
                let conveyed = plant.conveyed(item);
                self.body(anchor, pieces, |ball| extent::lying(machine, ball, place, offset, conveyed))
            }
            _ => self.body(anchor, pieces, BoundingBox::around),
        };
        body.item = Some(item);
        match self.bodies.iter().position(Option::is_none) {
            Some(free) => {
                self.bodies[free] = Some(body);
                free
            }
            None => {
                self.bodies.push(Some(body));
                self.bodies.len() - 1
            }
        }
    }

    /// Takes a body away.
    pub fn remove(&mut self, body: usize) -> Option<Body> {
        self.forget();
        self.bodies[body].take()
    }

    fn position(&self, plant: &Plant) -> Point {
        self.machine().and_then(|index| plant.position(index)).unwrap_or_default()
    }

    pub fn moves(&self) -> bool {
        !matches!(self.movement, Movement::Still) || self.moves_parts()
    }

    /// How a body is turned that is an item on a conveyor or on what is carried, radians about the vertical, now.
    pub fn turn(&self, body: usize, plant: &Plant) -> Option<f64> {
        let Anchor::Lying { item, turn } = self.bodies.get(body)?.as_ref()?.anchor else { return None };
        let conveyed = self.parts.conveyed(item)?;
        let passed = (plant.now_ms() as f64 - self.now_ms) / 1000.0;
        Some(conveyed.yaw(passed, turn.to_degrees()).to_radians())
    }

    /// Whether something moves on it, but not it as a whole.
    fn moves_parts(&self) -> bool {
        self.parts.moves()
    }

    /// Whether [`Self::frame_along`] knows its path from the beginning to the end.
    pub fn has_whole_path(&self) -> bool {
        self.movement.has_whole_path()
    }

    /// The frame of an anchor at a place on the whole path, 0 to 1; where it is, if it rests.
    pub fn frame_along(&mut self, anchor: Anchor, plant: &Plant, place: f64) -> Pose {
        match (&self.movement, anchor) {
            (Movement::Swings { motion, .. }, Anchor::Link(link)) => {
                if self.along.as_ref().is_none_or(|(known, _)| *known != place)
                    && let Kind::Arm { arm, .. } = &self.kind
                {
                    self.along = Some((place, arm.frames(&motion.along(place))));
                }
                self.along.as_ref().map_or(Pose::IDENTITY, |(_, frames)| frames[link])
            }
            _ => self.frame(anchor, plant, self.movement.end() * place),
        }
    }

    /// How far two of its bodies go at most along the path of an arm as seen from one another: only joints between their
    /// links move them. None if one of them is on no link.
    pub fn travel_between(&self, bodies: [usize; 2]) -> Option<Travel> {
        let Movement::Swings { motion, .. } = &self.movement else { return None };
        let on_link = |number: usize| {
            let body = self.bodies[number].as_ref()?;
            match body.anchor {
                Anchor::Link(link) => Some((link, body.radii.as_ref()?)),
                _ => None,
            }
        };
        let [first, second] = [on_link(bodies[0])?, on_link(bodies[1])?];
        let [(near, _), (_, radii)] = if first.0 <= second.0 { [first, second] } else { [second, first] };
        let between: Vec<f64> = radii
            .iter()
            .enumerate()
            .map(|(joint, radius)| if joint > near { *radius } else { 0.0 })
            .collect();
        Some(motion.travel(&between))
    }

    /// The motion of an arm that is under way.
    pub fn motion(&self) -> Option<&Motion> {
        match &self.movement {
            Movement::Swings { motion, .. } => Some(motion),
            Movement::Still | Movement::Slides { .. } | Movement::Rides { .. } => None,
        }
    }

    /// Where these places are among the sections of the path of an arm, which are the same for all of its bodies; none if
    /// it is no arm that moves.
    pub fn sections(&self, places: [f64; 3]) -> Option<[usize; 3]> {
        let Movement::Swings { motion, .. } = &self.movement else { return None };
        self.sections_of(motion, places)
    }

    /// The same on the path of this motion.
    fn sections_of(&self, motion: &Motion, places: [f64; 3]) -> Option<[usize; 3]> {
        let body = self.bodies.iter().flatten().find(|body| body.radii.is_some())?;
        Some(places.map(|place| body.travel(motion).section(place)))
    }

    /// Metres that no point of the body goes more than between two places on the whole path.
    pub fn path_along(&self, body: &Body, [from, to]: [f64; 2]) -> f64 {
        let span = match &self.movement {
            Movement::Swings { .. } => [from, to],
            Movement::Still | Movement::Slides { .. } | Movement::Rides { .. } => {
                let end = self.movement.end();
                self.movement.span(end * from, end * to)
            }
        };
        self.movement.path(body, span)
    }

    /// Whether there is sense in looking at the two; for one group and itself, whether it could touch itself.
    pub fn can_meet(&self, other: &Group, is_same: bool) -> bool {
        match (&self.kind, &other.kind) {
            (Kind::Arm { .. }, _) if is_same => true,
            (Kind::Obstacle, Kind::Obstacle) => false,
            _ => !is_same,
        }
    }

    /// Whether two of its own bodies are checked.
    pub fn is_free_of(&self, a: &Body, b: &Body) -> bool {
        // What stands comes before the first link; an item hangs from the last.
        let number = |body: &Body| match body.anchor {
            Anchor::World => Some(0),
            Anchor::Link(link) => Some(link + 1),
            Anchor::Route | Anchor::Carriage(_) | Anchor::Lying { .. } => None,
        };
        match (number(a), number(b)) {
            // Neighbours and their neighbours always touch.
            (Some(a), Some(b)) => a.abs_diff(b) > 2,
            // What else moves on a machine is checked against its arm only.
            (Some(link), None) | (None, Some(link)) => link > 0,
            (None, None) => false,
        }
    }

    /// The frame of a link now.
    pub fn link_now(&self, link: usize, plant: &Plant) -> Pose {
        match &self.kind {
            Kind::Arm { index, arm, .. } => {
                plant.joints(*index).map_or(Pose::IDENTITY, |joints| arm.frames(&joints)[link])
            }
            _ => Pose::IDENTITY,
        }
    }

    pub fn machine(&self) -> Option<usize> {
        match self.kind {
            Kind::Obstacle => None,
            Kind::Machine { index, .. } | Kind::Arm { index, .. } => Some(index),
        }
    }

    /// Metres that no point of the body goes more than between two times of the span.
    pub fn path_between(&self, body: &Body, from: f64, to: f64) -> f64 {
        path_of_parts(&self.parts, body, [from, to])
            .unwrap_or_else(|| self.movement.path(body, self.movement.span(from, to)))
    }

    /// Metres that no point of a body has gone more than by a time, seconds from now, since the start of the run.
    pub fn path_to(&self, body: usize, time: f64) -> Option<f64> {
        let body = self.bodies[body].as_ref()?;
        Some(body.path + self.path_between(body, 0.0, time))
    }

    /// The same of all bodies, by their numbers.
    pub fn paths_to(&self, time: f64) -> Vec<Option<f64>> {
        let span = self.movement.span(0.0, time);
        let path = |body: &Body| {
            path_of_parts(&self.parts, body, [0.0, time]).unwrap_or_else(|| self.movement.path(body, span))
        };
        self.bodies.iter().map(|body| body.as_ref().map(|body| body.path + path(body))).collect()
    }

    /// The frame of an anchor at a time of the span.
    pub fn frame(&mut self, anchor: Anchor, plant: &Plant, time: f64) -> Pose {
        match anchor {
            Anchor::World => Pose::IDENTITY,
            Anchor::Link(link) => self.frames(plant, time).map_or(Pose::IDENTITY, |frames| frames[link]),
            Anchor::Route => {
                if let Movement::Rides { ride, now_ms } = &self.movement {
                    return ride.frame(now_ms + 1000.0 * time).pose();
                }
                if let Some(vehicle) = self.machine().and_then(|index| plant.vehicle(index)) {
                    return vehicle.pose();
                }
                let place = self.machine().and_then(|index| plant.position(index)).unwrap_or_default();
                Pose { position: place + self.movement.shift(time), ..Pose::IDENTITY }
            }
            Anchor::Carriage(part) => {
                let stroking = self.parts.stroking(part).copied();
                let index = self.machine();
                let stroking = stroking.or_else(|| plant.stroking(index?, part));
                stroking.map_or(Pose::IDENTITY, |stroking| stroking.frame(time).pose())
            }
            Anchor::Lying { item, turn } => {
                if let Some(conveyed) = self.parts.conveyed(item) {
                    let yaw = conveyed.yaw(time, turn.to_degrees());
                    return Pose::turned(conveyed.point(time), yaw.to_radians());
                }
                let place = plant.place(item).unwrap_or_default();
                Pose::turned(place + self.movement.shift(time), turn)
            }
        }
    }

    fn frames(&mut self, plant: &Plant, time: f64) -> Option<&Frames> {
        let Kind::Arm { index, arm, .. } = &self.kind else { return None };
        let joints = match &self.movement {
            Movement::Swings { motion, begin } => motion.at(begin + time),
            Movement::Still | Movement::Slides { .. } | Movement::Rides { .. } => plant.joints(*index)?,
        };
        if self.frames.as_ref().is_none_or(|(known, _)| *known != joints) {
            self.frames = Some((joints, arm.frames(&joints)));
        }
        self.frames.as_ref().map(|(_, frames)| frames)
    }
}

/// What contains these pieces of a body where it is, and what is in contact with them.
fn present(pieces: &[Piece], frame: &Pose) -> BoundingBox {
    let bounds = pieces.iter().map(|piece| piece.within(frame).bounds().wider(NEAR));
    bounds.fold(BoundingBox::NOTHING, |all, next| all.with(&next))
}

/// Metres that no point of a body goes more than between two times; none of what moves with its machine.
fn path_of_parts(parts: &Parts, body: &Body, [from, to]: [f64; 2]) -> Option<f64> {
    if let Anchor::Carriage(part) = body.anchor {
        let Some(stroking) = parts.stroking(part) else { return Some(0.0) };
        let part = (stroking.out(to) - stroking.out(from)).abs();
        return Some(stroking.stroke.path(body.ball.middle, body.ball.radius, part));
    }
    let conveyed = parts.conveyed(body.lying()?)?;
    Some(conveyed.speed_within(body.ball.middle.length() + body.ball.radius) * (to - from))
}
