//! Obstacles about a gantry, as its planner takes it.

use super::plane::{Block, Rectangle};
use crate::collision::body::{Ball, Piece, Placed};
use crate::kinematics::arm::{Arm, Frames, Joints};
use crate::kinematics::pose::Pose;
use crate::line::{Kind, Line};
use crate::machine::Machine;
use crate::part::axis::Motion;
use crate::part::place::Place;
use crate::point::{Axis, Point};
use crate::solid::{Link, Shape, Solid};
use std::cell::OnceCell;

/// A link of the robot with all that is fixed to it.
#[derive(Clone, Debug)]
struct Member {
    link: usize,
    pieces: Vec<Piece>,
    ball: Ball,
}

/// The robot itself, obstacles around it, and what may lie beside a place.
#[derive(Clone, Debug)]
pub struct Scene {
    arm: Arm,
    members: Vec<Member>,
    /// The largest part, around the grip point.
    load: Member,
    obstacles: Vec<Cluster>,
    /// The lowest point of what does not turn with the torso, m.
    lowest_beam: f64,
    places: Vec<Places>,
    /// Of the tool at the highest grip point of a part at the highest place, m.
    pub highest_place: f64,
    /// Of the highest part, m.
    pub load_height: f64,
    /// Over all obstacles the arm carries its load from this height of the tool on, m.
    pub over_all: f64,
}

/// A solid that is an obstacle, with the axes of the world, and its corners.
#[derive(Clone, Debug)]
pub struct Obstruction {
    placed: Placed,
    low: Point,
    high: Point,
}

/// Obstacles that stand together, and the corners of all of them.
#[derive(Clone, Debug)]
pub struct Cluster {
    all: Vec<Obstruction>,
    low: Point,
    high: Point,
}

/// The places of one machine at which parts may lie, with the largest part of each.
#[derive(Clone, Debug)]
struct Places {
    all: Vec<(Point, Placed)>,
    order: Order,
}

/// In which order the places of a machine are used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Order {
    Any,
    /// While parts are taken: those before are empty.
    FirstToLast,
}

/// A part of the robot that turns about its axis: its lower and upper end from the height of the shoulder, and how far
/// the axis keeps off obstacles between, m.
#[derive(Clone, Copy)]
struct AroundAxis {
    heights: [f64; 2],
    radius: f64,
}

/// Number of the joint that turns the torso.
const TORSO: usize = 2;
/// No point of the robot and its load is farther from the torso's axis, m: to the shoulder 0.64, upper arm and forearm
/// 1.19, wrists and load 0.5.
const REACH: f64 = 2.33;
/// An obstacle this much lower than what travels on the rails is not near it, m.
const HIGH: f64 = 0.3;
/// Links with so many joints between them or more may meet.
const FREE: usize = 3;
/// A tool is over a place if it is no farther from it than this, m.
const AT_PLACE: f64 = 0.02;
/// Clearance over obstacles when the arm passes over them, m.
const OVER: f64 = 0.05;

impl Scene {
    /// What the machine of this number has around it, and what its axis keeps off; none if it is no gantry.
    pub fn of(line: &Line, index: usize) -> Option<(Self, Vec<Block>)> {
        let own = line.machines.get(index)?;
        let arm = own.arm()?;
        arm.gantry()?;
        let shoulder = own.axes().first()?.at()?.z;
        let around = own.chain()?.clearances.iter();
        let around: Vec<AroundAxis> =
            around.map(|&[low, high, radius]| AroundAxis { heights: [low, high], radius }).collect();
        let others = || {
            let machines = line.machines.iter().enumerate().filter(|(other, _)| *other != index);
            machines.map(|(_, machine)| machine)
        };
        let obstacles = line.obstacles.iter().filter_map(|o| o.solid()).map(|solid| vec![solid]);
        let boxes: Vec<Vec<Solid>> = others().flat_map(workspaces).chain(obstacles).collect();
        let passing: Vec<Vec<Solid>> = others().flat_map(passing).collect();
        let all = boxes.iter().chain(&passing);
        let blocks = all.flat_map(|solids| {
            around.iter().map(|part| part.keeps_off(shoulder, solids)).collect::<Vec<_>>()
        });
        let blocks: Vec<Block> = blocks.flatten().collect();
        let obstacles = boxes.iter().flatten();
        let largest = |value: fn(&Kind) -> f64| line.kinds.iter().map(value).fold(0.0, f64::max);
        let under = largest(|kind| kind.grasp);
        let tallest = obstacles.clone().map(top).filter(|top| *top < shoulder).fold(0.0, f64::max);
        let obstacles = boxes.iter().filter_map(|solids| Cluster::new(solids)).collect();
        let members = members(own);
        let hand = members.last()?.link;
        let load = largest_load(&line.kinds);
        let beams = members.iter().filter(|member| member.link < TORSO).flat_map(|member| &member.pieces);
        let lowest_beam = beams.map(|piece| shoulder + piece.lowest()).fold(f64::INFINITY, f64::min);
        let places = places(line);
        let heights = places.iter().flat_map(|places| &places.all).map(|(place, _)| place.z);
        let scene = Self {
            arm,
            members,
            load: Member { link: hand, ball: load.ball(), pieces: vec![load] },
            obstacles,
            lowest_beam,
            load_height: largest(|kind| kind.height),
            highest_place: heights.fold(0.0, f64::max) + under,
            places,
            over_all: tallest + under + OVER,
        };
        Some((scene, blocks))
    }

    /// The obstacles that the robot can come near while its torso is between these places.
    pub fn near(&self, places: impl IntoIterator<Item = Point>) -> Nearby<'_> {
        let none =
            [Point::new(f64::INFINITY, f64::INFINITY, 0.0), Point::new(-f64::INFINITY, -f64::INFINITY, 0.0)];
        let [low, high] = places.into_iter().fold(none, |[low, high], place| {
            [
                Point::new(low.x.min(place.x), low.y.min(place.y), 0.0),
                Point::new(high.x.max(place.x), high.y.max(place.y), 0.0),
            ]
        });
        let is_near = |other: &&Cluster| {
            let beside = other.low.x > high.x + REACH || other.high.x < low.x - REACH;
            let behind = other.low.y > high.y + REACH || other.high.y < low.y - REACH;
            !(beside || behind)
        };
        Nearby {
            all: self.obstacles.iter().filter(is_near).collect(),
            high: self.obstacles.iter().filter(|other| other.high.z > self.lowest_beam - HIGH).collect(),
        }
    }

    /// How far the robot is from these obstacles and from its own links, with or without a load, m; `enough` if it is
    /// that far or farther, 0 if they touch. Something less than `needed` if it is nearer than that.
    pub fn gap(&self, near: &Nearby, frames: &Frames, load: Load, [needed, enough]: [f64; 2]) -> f64 {
        let members = self.members.iter().chain((load == Load::Largest).then_some(&self.load));
        let members: Vec<Located> = members.map(|member| Located::new(member, frames)).collect();
        let mut least = enough;
        for (i, member) in members.iter().enumerate() {
            let obstacles = if member.link < TORSO { &near.high } else { &near.all };
            for cluster in obstacles {
                if !is_within([cluster.low, cluster.high], &member.ball, least) {
                    continue;
                }
                for other in &cluster.all {
                    if other.is_within(&member.ball, least) {
                        least = member.gap_to(other, least);
                    }
                }
            }
            for other in members[i..].iter().filter(|other| other.link >= member.link + FREE) {
                if !member.ball.is_apart_by(&other.ball, least) {
                    least = other.pieces().iter().fold(least, |least, piece| member.gap(piece, least));
                }
            }
            if least < needed {
                break;
            }
        }
        least
    }

    /// The same from parts that may lie beside the place under the tool.
    pub fn gap_at_place(&self, joints: &Joints, enough: f64) -> f64 {
        let frames = self.arm.frames(joints);
        let tool = self.arm.tool(joints);
        let is_here = |place: &Point| {
            let offset = *place - tool;
            offset.x * offset.x + offset.y * offset.y <= AT_PLACE * AT_PLACE
        };
        let members: Vec<Located> = self.members.iter().map(|m| Located::new(m, &frames)).collect();
        let mut least = enough;
        for Places { all, order } in &self.places {
            let Some(here) = all.iter().position(|(place, _)| is_here(place)) else { continue };
            for (i, (_, part)) in all.iter().enumerate() {
                if i > here || i < here && *order == Order::Any {
                    least = members.iter().fold(least, |least, member| member.gap(part, least));
                }
            }
        }
        least
    }
}

/// The obstacles that the robot can come near.
pub struct Nearby<'s> {
    all: Vec<&'s Cluster>,
    /// What travels on the rails without turning can come near these.
    high: Vec<&'s Cluster>,
}

impl Obstruction {
    fn new(solid: &Solid) -> Self {
        let (middle, half) = (solid.pose.position, half(solid));
        let placed = Piece::new(String::new(), &solid.pose, solid.shape).within(&Pose::IDENTITY);
        Self { placed, low: middle - half, high: middle + half }
    }

    /// Whether it is nearer to a ball than this, m.
    fn is_within(&self, ball: &Ball, distance: f64) -> bool {
        is_within([self.low, self.high], ball, distance)
    }
}

impl Cluster {
    /// None of nothing.
    fn new(solids: &[Solid]) -> Option<Self> {
        let all: Vec<Obstruction> = solids.iter().map(Obstruction::new).collect();
        let corners = all.iter().map(|one| [one.low, one.high]);
        let by = |a: Point, b: Point, rule: fn(f64, f64) -> f64| {
            Point::new(rule(a.x, b.x), rule(a.y, b.y), rule(a.z, b.z))
        };
        let [low, high] =
            corners.reduce(|[low, high], [a, b]| [by(low, a, f64::min), by(high, b, f64::max)])?;
        Some(Self { all, low, high })
    }
}

/// Whether what is between two corners is nearer to a ball than this, m.
fn is_within([low, high]: [Point; 2], ball: &Ball, distance: f64) -> bool {
    let outside = |at: f64, low: f64, high: f64| (low - at).max(at - high).max(0.0);
    let Ball { middle, radius } = *ball;
    let x = outside(middle.x, low.x, high.x);
    let y = outside(middle.y, low.y, high.y);
    let z = outside(middle.z, low.z, high.z);
    let reach = radius + distance;
    x * x + y * y + z * z < reach * reach
}

impl AroundAxis {
    /// What of these solids is an obstacle to it, seen from above.
    fn keeps_off(&self, shoulder: f64, solids: &[Solid]) -> Option<Block> {
        let heights = self.heights.map(|z| shoulder + z);
        let all = solids.iter().filter_map(|solid| footprint(solid, heights));
        let rectangle = all.reduce(|a, b| a.with(&b))?;
        Some(Block { rectangle, radius: self.radius })
    }
}

/// What hangs on the gripper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Load {
    None,
    Largest,
}

/// A link where it is.
struct Located<'a> {
    member: &'a Member,
    frame: &'a Pose,
    link: usize,
    ball: Ball,
    /// Known when something is near.
    pieces: OnceCell<Vec<Placed>>,
}

impl<'a> Located<'a> {
    fn new(member: &'a Member, frames: &'a [Pose]) -> Self {
        let frame = &frames[member.link];
        let ball = member.ball.within(frame);
        Self { member, frame, link: member.link, ball, pieces: OnceCell::new() }
    }

    fn pieces(&self) -> &[Placed] {
        self.pieces.get_or_init(|| self.member.pieces.iter().map(|p| p.within(self.frame)).collect())
    }

    /// The lesser of `least` and the distance.
    fn gap_to(&self, other: &Obstruction, least: f64) -> f64 {
        self.pieces().iter().fold(least, |least, piece| {
            let is_near = other.is_within(&piece.ball, least) && !piece.is_apart_by(&other.placed, least);
            if is_near { least.min(piece.gap(&other.placed).distance) } else { least }
        })
    }

    /// The lesser of `least` and the distance.
    fn gap(&self, other: &Placed, least: f64) -> f64 {
        self.pieces().iter().fold(least, |least, piece| {
            if piece.is_apart_by(other, least) {
                return least;
            }
            least.min(piece.gap(other).distance)
        })
    }
}

fn members(machine: &Machine) -> Vec<Member> {
    let mut solids = machine.solids();
    solids.sort_by_key(|solid| solid.link);
    let links = solids.chunk_by(|a, b| a.link == b.link).filter_map(|solids| {
        let Link::Joint(link) = solids[0].link else { return None };
        let pieces: Vec<Piece> =
            solids.iter().map(|s| Piece::new(s.name.clone(), &s.pose, s.shape)).collect();
        let balls: Vec<Ball> = pieces.iter().map(Piece::ball).collect();
        Some(Member { link, pieces, ball: Ball::around(&balls) })
    });
    links.collect()
}

fn shifted(solids: &[Solid], by: Point) -> Vec<Solid> {
    let moved = |s: &Solid| Solid { pose: Pose { position: s.pose.position + by, ..s.pose }, ..s.clone() };
    solids.iter().map(moved).collect()
}

/// The workspace of a vehicle on its trip from its first stop to the second, in groups that stand together.
fn passing(machine: &Machine) -> Vec<Vec<Solid>> {
    let [start, near, ..] = *machine.stops() else { return Vec::new() };
    let trip = near - start;
    let steps = (trip.length() / STEP).ceil().max(1.0);
    let solids = machine.solids();
    let on_trip = (0..=steps as u32).map(|i| shifted(&solids, start + trip.scaled(f64::from(i) / steps)));
    // Along an axis of the world all of it is one rectangle from above.
    if trip.x == 0.0 || trip.y == 0.0 { vec![on_trip.flatten().collect()] } else { on_trip.collect() }
}

/// The workspace of a machine while the gantry works, in groups that stand together: a vehicle at each of its
/// stops, an arm along its rail.
fn workspaces(machine: &Machine) -> Vec<Vec<Solid>> {
    let solids = machine.solids();
    if machine.route().is_some() {
        return machine.stops().iter().map(|stop| shifted(&solids, *stop)).collect();
    }
    let Some(chain) = machine.chain() else { return vec![solids] };
    let Some([half, height]) = chain.envelope else { return Vec::new() };
    let Some(axis) = machine.axes().first().copied() else { return Vec::new() };
    let Motion::Slides { along, range: [low, high] } = axis.motion else { return Vec::new() };
    let long = high - low + 2.0 * half;
    let middle = (high + low) / 2.0;
    let Some(at) = axis.at() else { return Vec::new() };
    let tall = at.z + height;
    let Some(along) = along.level() else { return Vec::new() };
    let (position, size) = match along {
        Axis::X => (Point::new(middle, at.y, tall / 2.0), Point::new(long, 2.0 * half, tall)),
        Axis::Y => (Point::new(at.x, middle, tall / 2.0), Point::new(2.0 * half, long, tall)),
    };
    let pose = Pose { position, ..Pose::IDENTITY };
    let shape = Shape::Box { size };
    vec![vec![Solid { name: "envelope".into(), link: Link::World, pose, shape, grips: false }]]
}

/// A vehicle that travels is taken at places so far apart: less than what passes between them is thick, m.
const STEP: f64 = 0.5;

fn half(solid: &Solid) -> Point {
    match solid.shape {
        Shape::Box { size } => size.scaled(0.5),
        Shape::Capsule { length, radius } => {
            let reach = length / 2.0 + radius;
            Point::new(reach, reach, reach)
        }
    }
}

fn top(solid: &Solid) -> f64 {
    solid.pose.position.z + half(solid).z
}

/// From above, if it is at these heights. Obstacles have the axes of the world.
fn footprint(solid: &Solid, [low, high]: [f64; 2]) -> Option<Rectangle> {
    let (middle, half) = (solid.pose.position, half(solid));
    let is_between = top(solid) > low && middle.z - half.z < high;
    let flat = |point: Point| Point { z: 0.0, ..point };
    is_between.then(|| Rectangle { low: flat(middle - half), high: flat(middle + half) })
}

/// In the frame of a tool, whose z points down: as large as the largest kinds, from their grip points.
fn largest_load(kinds: &[Kind]) -> Piece {
    let largest = |value: fn(&Kind) -> f64| kinds.iter().map(value).fold(0.0, f64::max);
    let (under, over) = (largest(|kind| kind.grasp), largest(|kind| kind.height - kind.grasp));
    let size = Point::new(largest(|kind| kind.size[0]), largest(|kind| kind.size[1]), under + over);
    let middle = Point::new(0.0, 0.0, (under - over) / 2.0 + 0.001);
    Piece::new(String::new(), &Pose { position: middle, ..Pose::IDENTITY }, Shape::Box { size })
}

/// Where parts may lie: on trays and in bins the highest kind anywhere, in a briefcase each kind at its place.
fn places(line: &Line) -> Vec<Places> {
    let part = |kind: &Kind, place: Point| {
        let size = Point::new(kind.size[0], kind.size[1], kind.height);
        let pose = Pose { position: place.up(size.z / 2.0), ..Pose::IDENTITY };
        (place, Piece::new(String::new(), &pose, Shape::Box { size }).within(&Pose::IDENTITY))
    };
    let Some(highest) = line.kinds.iter().max_by(|a, b| a.height.total_cmp(&b.height)) else {
        return Vec::new();
    };
    let of_place = |at: Point, place: &Place| {
        let slots = place.slots.iter();
        if place.by_kind {
            let slots = slots.zip(&line.kinds);
            Places { all: slots.map(|(slot, kind)| part(kind, at + *slot)).collect(), order: Order::Any }
        } else {
            Places { all: slots.map(|slot| part(highest, at + *slot)).collect(), order: Order::FirstToLast }
        }
    };
    let of = |machine: &Machine| -> Vec<Places> {
        let stops = machine.stops();
        let at_all = |place: &Place| -> Vec<Places> {
            if machine.is_driven(place) {
                stops.iter().map(|stop| of_place(*stop, place)).collect()
            } else {
                vec![of_place(place.at, place)]
            }
        };
        machine.places().filter(|place| !machine.is_on_track(place)).flat_map(at_all).collect()
    };
    line.machines.iter().flat_map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kind(height: f64, grasp: f64) -> Kind {
        Kind { name: "part".into(), height, grasp, size: [0.1, 0.2], is: Vec::new(), mass: 0.1 }
    }

    /// Upper and lower end under the tool, m.
    fn ends(kinds: &[Kind]) -> [f64; 2] {
        let load = largest_load(kinds);
        [load.lowest(), 2.0 * load.ball().middle.z - load.lowest()]
    }

    #[test]
    fn the_load_is_around_the_grip_points() {
        for (kinds, [upper, lower]) in [
            (vec![kind(0.1, 0.1)], [0.0, 0.1]),
            (vec![kind(0.1, 0.06)], [-0.04, 0.06]),
            (vec![kind(0.1, 0.06), kind(0.05, 0.05), kind(0.2, 0.02)], [-0.18, 0.06]),
        ] {
            let found = ends(&kinds);
            assert!(
                (found[0] - upper).abs() < 0.002 && (found[1] - lower).abs() < 0.002,
                "{kinds:?} {found:?}"
            );
        }
    }
}
