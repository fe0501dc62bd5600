//! What moves of a machine on its paths, whenever it goes there: for questions that no run answers.

use super::body::{Piece, Placed};
use super::bounds::{BoundingBox, Chain};
use crate::frame::Frame;
use crate::kinematics::arm::{Arm, Joints, Posture};
use crate::kinematics::facing::Facing;
use crate::kinematics::pose::Pose;
use crate::machine::Machine;
use crate::point::Point;
use crate::solid::{Link, Solid};
use std::cell::OnceCell;

/// From one place on a path to the next one no link goes much farther, m.
const STEP: f64 = 0.08;
const MOST_STEPS: f64 = 40.0;

/// The bodies of a machine that move with an arm or along a route. Of an arm under a torso, whose planner chooses how it
/// stands and goes, those that move with the tool.
#[derive(Clone, Debug)]
pub struct Moving {
    /// And how it starts.
    arm: Option<(Arm, Posture)>,
    pieces: Vec<(Link, Piece)>,
    whole: BoundingBox,
}

/// What a machine takes up on a path, at places that are near to one another.
#[derive(Clone, Debug)]
pub struct Path {
    poses: Poses,
    pub bounds: BoundingBox,
    places: OnceCell<Vec<Taken>>,
}

/// Where it is at each place.
#[derive(Clone, Debug)]
enum Poses {
    Joints(Vec<Joints>),
    Points(Vec<Point>),
}

/// Its bodies at one place, and what contains them.
type Taken = (BoundingBox, Vec<Placed>);

impl Moving {
    /// None of a machine without an arm and without a route, and of one of which nothing moves with them.
    pub fn new(machine: &Machine) -> Option<Self> {
        let arm = machine.arm();
        let last = arm.map_or(0, |arm| arm.frames(&arm.start()).len() - 1);
        let moves = |link: Link| match link {
            Link::Joint(joint) => arm.is_some_and(|arm| !arm.has_torso() || joint == last),
            Link::Route => machine.route().is_some(),
            Link::World | Link::Carriage(_) => false,
        };
        let solids: Vec<Solid> = machine.solids().into_iter().filter(|solid| moves(solid.link)).collect();
        let pieces =
            solids.into_iter().map(|solid| (solid.link, Piece::new(solid.name, &solid.pose, solid.shape)));
        let pieces: Vec<(Link, Piece)> = pieces.collect();
        let chain = arm.map(|arm| Chain::new(&arm, machine));
        let whole = pieces.iter().flat_map(|(link, piece)| match (link, &chain) {
            (Link::Joint(joint), Some(chain)) => vec![chain.bounds(*joint, &piece.ball())],
            // Straight from stop to stop, without a turn.
            _ => {
                let here = piece.within(&Pose::IDENTITY).bounds();
                machine.stops().iter().map(|stop| here.shifted(*stop)).collect()
            }
        });
        let whole = whole.reduce(|a, b| a.with(&b))?;
        let arm = arm.map(|arm| (arm, arm.posture(&arm.start())));
        Some(Self { arm, pieces, whole })
    }

    /// All that it can ever take up.
    pub fn whole(&self) -> BoundingBox {
        self.whole
    }

    /// Whether the tool of an arm can be brought to a place; a vehicle is taken anywhere.
    pub fn reaches(&self, goal: Point, facing: Facing) -> bool {
        self.arm.is_none_or(|(arm, _)| arm.margin_facing(goal, facing) >= 0.0)
    }

    /// From goal to goal, each with the direction of the tool: all joints of an arm together, or a vehicle straight on. An
    /// arm under a torso only at the goals, and straight up or down between them. None if one is out of reach, or if there are none.
    pub fn path(&self, goals: &[(Point, Facing)]) -> Option<Path> {
        let poses = match &self.arm {
            Some((arm, start)) => Poses::Joints(joints(arm, start, goals)?),
            None => Poses::Points(points(goals)),
        };
        let mut bounds: Option<BoundingBox> = None;
        self.each(&poses, |pieces| {
            bounds = bounds.into_iter().chain(pieces.map(|placed| placed.bounds())).reduce(|a, b| a.with(&b));
        });
        Some(Path { poses, bounds: bounds?, places: OnceCell::new() })
    }

    /// Its bodies at each place.
    fn each(&self, poses: &Poses, mut see: impl FnMut(&mut dyn Iterator<Item = Placed>)) {
        let mut placed = |frame: &dyn Fn(Link) -> Pose| {
            see(&mut self.pieces.iter().map(|(link, piece)| piece.within(&frame(*link))));
        };
        match (poses, &self.arm) {
            (Poses::Joints(all), Some((arm, _))) => {
                for joints in all {
                    let frames = arm.frames(joints);
                    placed(&|link| match link {
                        Link::Joint(joint) => frames[joint],
                        Link::World | Link::Route | Link::Carriage(_) => Pose::IDENTITY,
                    });
                }
            }
            (Poses::Points(points), _) => {
                points.iter().for_each(|point| placed(&|_| Frame::new(*point, 0.0).pose()));
            }
            (Poses::Joints(_), None) => {}
        }
    }

    /// Contains places where bodies of both are, whenever each of them is there; none if there are none.
    pub fn common(&self, path: &Path, (other, beside): (&Moving, &Path)) -> Option<BoundingBox> {
        if path.bounds.is_apart(&beside.bounds) {
            return None;
        }
        let mut all: Option<BoundingBox> = None;
        for (bounds, pieces) in
            self.places(path).iter().filter(|(bounds, _)| !bounds.is_apart(&beside.bounds))
        {
            for (near, others) in other.places(beside).iter().filter(|(near, _)| !near.is_apart(bounds)) {
                for piece in pieces.iter().filter(|piece| !piece.bounds().is_apart(near)) {
                    for next in others {
                        let may = piece.apart_at_least(next, f64::MIN_POSITIVE) <= 0.0;
                        if may && piece.gap(next).distance <= 0.0 {
                            let common = piece.bounds().common(&next.bounds());
                            all = Some(all.map_or(common, |all| all.with(&common)));
                        }
                    }
                }
            }
        }
        all
    }

    fn places<'p>(&self, path: &'p Path) -> &'p [Taken] {
        path.places.get_or_init(|| {
            let mut places = Vec::new();
            self.each(&path.poses, |pieces| {
                let taken: Vec<Placed> = pieces.collect();
                let bounds =
                    taken.iter().map(Placed::bounds).fold(BoundingBox::NOTHING, |all, next| all.with(&next));
                places.push((bounds, taken));
            });
            places
        })
    }
}

fn joints(arm: &Arm, start: &Posture, goals: &[(Point, Facing)]) -> Option<Vec<Joints>> {
    let mut all: Vec<Joints> = Vec::new();
    for (goal, facing) in goals {
        let from = all.last().map(|joints| arm.posture(joints));
        let to = arm.solve_from(*goal, *facing, from.as_ref().unwrap_or(start))?;
        let steps = from.as_ref().map_or(1.0, |from| {
            let aside = || Point { z: 0.0, ..arm.tool(&to) - from.tool.position };
            let is_known = !arm.has_torso() || aside().length() < 1e-6;
            if is_known { steps_between(arm, &from.joints, &to) } else { 1.0 }
        });
        let from = from.map_or(to, |from| from.joints);
        for step in 1..=steps as u32 {
            let part = f64::from(step) / steps;
            all.push(from.map(|i, value| value + part * (to[i] - value)));
        }
    }
    Some(all)
}

fn points(goals: &[(Point, Facing)]) -> Vec<Point> {
    let mut all: Vec<Point> = Vec::new();
    for (goal, _) in goals {
        let from = all.last().copied().unwrap_or(*goal);
        let steps = ((*goal - from).length() / STEP).ceil().max(1.0);
        all.extend((1..=steps as u32).map(|step| from + (*goal - from).scaled(f64::from(step) / steps)));
    }
    all
}

fn steps_between(arm: &Arm, from: &Joints, to: &Joints) -> f64 {
    let (a, b) = (arm.frames(from), arm.frames(to));
    let turned = (0..from.len()).map(|i| (to[i] - from[i]).abs()).fold(0.0, f64::max);
    let farthest =
        a.iter().zip(b.iter()).map(|(a, b)| (b.position - a.position).length()).fold(turned, f64::max);
    (farthest / STEP).ceil().clamp(1.0, MOST_STEPS)
}
