//! All bodies of one machine or obstacle, and how they move within a scan.

use super::body::{Ball, Piece};
use super::bounds::{BoundingBox, Chain, Radii};
use crate::kinematics::arm::{Arm, Frames, Joints};
use crate::kinematics::pose::Pose;
use crate::line::{Line, Obstacle};
use crate::machine::Machine;
use crate::motion::Motion;
use crate::plant::Plant;
use crate::plant::trajectory::Trajectory;
use crate::point::Point;
use crate::solid::{Link, Solid};

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
    /// Metres that no point of it has gone more than, from the start of the run to the end of the scan.
    pub path: f64,
    /// Metres for each unit of the place on the path of an arm.
    rate: f64,
}

/// What a body moves with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Anchor {
    World,
    /// An index into the frames of the arm.
    Link(usize),
    /// Along the route.
    Route,
    /// Lies on the machine; the frame has its origin at the underside of the item and is turned by so many radians.
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
    /// Metres that no body has gone more than, from the start of the run to the end of the scan.
    pub path: f64,
    movement: Movement,
    /// Of an arm, as last looked at.
    frames: Option<(Joints, Frames)>,
}

#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant)] // a dozen of them in all
pub enum Kind {
    Obstacle,
    Machine { index: usize, machine: Machine },
    Arm { index: usize, arm: Arm, chain: Chain },
}

/// Within one scan; times are seconds from its start.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant)] // a dozen of them in all
enum Movement {
    Still,
    Slides {
        velocity: Point,
        from: f64,
        until: f64,
    },
    /// `begin` is the start of the scan on the motion's clock.
    Swings {
        motion: Motion,
        begin: f64,
    },
}

impl Group {
    pub fn of_machine(line: &Line, index: usize) -> Self {
        let machine = &line.machines[index];
        let kind = match machine.arm() {
            Some(arm) => Kind::Arm { index, arm, chain: Chain::new(&arm, machine) },
            None => Kind::Machine { index, machine: machine.clone() },
        };
        Self::new(machine.name.clone(), kind, machine.solids())
    }

    pub fn of_obstacle(obstacle: &Obstacle) -> Self {
        Self::new(obstacle.name.clone(), Kind::Obstacle, obstacle.solid().into_iter().collect())
    }

    fn new(name: String, kind: Kind, mut solids: Vec<Solid>) -> Self {
        solids.sort_by_key(|solid| solid.link);
        let mut group =
            Self { name, kind, bodies: Vec::new(), path: 0.0, movement: Movement::Still, frames: None };
        for solids in solids.chunk_by(|a, b| a.link == b.link) {
            let anchor = match solids[0].link {
                Link::World => Anchor::World,
                Link::Joint(link) => Anchor::Link(link),
                Link::Route => Anchor::Route,
            };
            let pieces =
                solids.iter().map(|solid| Piece::new(solid.name.clone(), &solid.pose, solid.shape)).collect();
            group.bodies.push(Some(group.body(anchor, pieces, BoundingBox::around)));
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
            (Anchor::Route, Kind::Machine { machine, .. }) => (None, at_stops(machine, &ball)),
            _ => (None, still(&ball)),
        };
        Body { anchor, pieces, ball, bounds, radii, path: self.path, rate: 0.0 }
    }

    /// Adds an item that comes to lie or to hang here; the number of its body.
    pub fn add_item(&mut self, anchor: Anchor, piece: Piece, plant: &Plant) -> usize {
        let body = match (anchor, &self.kind) {
            (Anchor::Lying { item, .. }, Kind::Machine { index, machine }) => {
                let place = plant.place(item).unwrap_or_default();
                let offset = place - plant.position(*index).unwrap_or_default();
                self.body(anchor, vec![piece], |ball| lying(machine, ball, place, offset))
            }
            _ => self.body(anchor, vec![piece], BoundingBox::around),
        };
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

    /// Whether there is sense in watching the two; for one group and itself, whether it could touch itself.
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
            Anchor::Route | Anchor::Lying { .. } => None,
        };
        let (Some(a), Some(b)) = (number(a), number(b)) else { return true };
        // Neighbours and their neighbours always touch.
        a.abs_diff(b) > 2
    }

    /// The frame of a link at the start of the scan.
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

    /// Looks up how it is going to move in the scan of `seconds` that begins, and how far at most.
    pub fn begin_scan(&mut self, plant: &Plant, seconds: f64) {
        let Some(index) = self.machine() else { return };
        let now_ms = plant.now_ms() as f64;
        self.movement = match plant.trajectory(index).since(now_ms) {
            Trajectory::Rests => Movement::Still,
            Trajectory::Drives { velocity, from_ms, until_ms } => Movement::Slides {
                velocity,
                from: (from_ms - now_ms) / 1000.0,
                until: (until_ms - now_ms) / 1000.0,
            },
            Trajectory::Swings(motion) => Movement::Swings { motion, begin: now_ms / 1000.0 },
        };
        if let Movement::Still = self.movement {
            return;
        }
        let rates = match &self.movement {
            Movement::Swings { motion, .. } => Some(motion.rates()),
            Movement::Still | Movement::Slides { .. } => None,
        };
        for body in self.bodies.iter_mut().flatten() {
            let parts = rates.iter().flat_map(|rates| rates.iter()).zip(body.radii.iter().flatten());
            body.rate = parts.map(|(rate, radius)| rate * radius).sum();
        }
        let mut longest = 0.0_f64;
        for body in self.bodies.iter_mut().flatten() {
            let path = self.movement.path(body, 0.0, seconds);
            body.path += path;
            longest = longest.max(path);
        }
        self.path += longest;
    }

    /// Metres that no point of the body goes more than between two times of the scan.
    pub fn path_between(&self, body: &Body, from: f64, to: f64) -> f64 {
        self.movement.path(body, from, to)
    }

    /// The frame of an anchor at a time of the scan.
    pub fn frame(&mut self, anchor: Anchor, plant: &Plant, time: f64) -> Pose {
        match anchor {
            Anchor::World => Pose::IDENTITY,
            Anchor::Link(link) => self.frames(plant, time).map_or(Pose::IDENTITY, |frames| frames[link]),
            Anchor::Route => {
                let place = self.machine().and_then(|index| plant.position(index)).unwrap_or_default();
                Pose { position: place + self.movement.shift(time), ..Pose::IDENTITY }
            }
            Anchor::Lying { item, turn } => {
                let place = plant.place(item).unwrap_or_default();
                Pose::turned(place + self.movement.shift(time), turn)
            }
        }
    }

    fn frames(&mut self, plant: &Plant, time: f64) -> Option<Frames> {
        let Kind::Arm { index, arm, .. } = &self.kind else { return None };
        let joints = match &self.movement {
            Movement::Swings { motion, begin } => motion.at(begin + time),
            Movement::Still | Movement::Slides { .. } => plant.joints(*index)?,
        };
        match &self.frames {
            Some((known, frames)) if *known == joints => Some(*frames),
            _ => {
                let frames = arm.frames(&joints);
                self.frames = Some((joints, frames));
                Some(frames)
            }
        }
    }
}

impl Movement {
    fn path(&self, body: &Body, from: f64, to: f64) -> f64 {
        match (self, body.anchor) {
            (Movement::Still, _) | (_, Anchor::World) => 0.0,
            (Movement::Slides { .. }, _) => (self.shift(to) - self.shift(from)).length(),
            (Movement::Swings { motion, begin }, _) => {
                body.rate * (motion.place(begin + to) - motion.place(begin + from))
            }
        }
    }

    /// How far it has slid since the start of the scan.
    fn shift(&self, time: f64) -> Point {
        match self {
            Movement::Slides { velocity, from, until } => {
                velocity.scaled((time.min(*until) - from.max(0.0)).max(0.0))
            }
            Movement::Still | Movement::Swings { .. } => Point::default(),
        }
    }
}

/// What a vehicle's body takes at all of its stops and between them.
fn at_stops(machine: &Machine, ball: &Ball) -> BoundingBox {
    let boxes = machine.stops().iter().map(|stop| BoundingBox::around(&ball.shifted(*stop)));
    boxes.reduce(|a, b| a.with(&b)).unwrap_or(BoundingBox::around(ball))
}

/// What an item can take that lies at `place`, at `offset` from the machine's position.
fn lying(machine: &Machine, ball: &Ball, place: Point, offset: Point) -> BoundingBox {
    let here = BoundingBox::around(&ball.shifted(place));
    match (machine.route(), machine.lane()) {
        (Some(_), _) => at_stops(machine, &ball.shifted(offset)),
        (None, Some(lane)) => {
            let end = place.with_coordinate(lane.along, lane.range[0]);
            here.with(&BoundingBox::around(&ball.shifted(end)))
        }
        (None, None) => here,
    }
}
