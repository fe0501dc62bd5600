//! Obstacles about a gantry, as its planner takes it.

use super::gap::{Links, Load, Nearby, TORSO};
use super::member::Member;
use super::obstacle::{Cluster, half, top};
use super::plane::{Block, Rectangle};
use crate::collision::body::{Piece, Placed};
use crate::collision::reach::Chain;
use crate::kinematics::arm::{Arm, Joints};
use crate::kinematics::pose::Pose;
use crate::line::{Kind, Line};
use crate::machine::Machine;
use crate::part::axis::Motion;
use crate::part::place::Place;
use crate::point::{Axis, Point};
use crate::solid::{Link, Shape, Solid};

/// The robot itself, obstacles around it, and what may lie beside a place.
#[derive(Clone, Debug)]
pub struct Scene {
    arm: Arm,
    pub links: Links,
    obstacles: Vec<Cluster>,
    lanes: Vec<Lane>,
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

/// What a vehicle passes through between the stops at which it can be.
#[derive(Clone, Debug)]
struct Lane {
    cluster: Cluster,
    /// What it carries parts on, at each of the stops.
    places: Vec<Point>,
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

/// No point of the robot and its load is farther from the torso's axis, m: to the shoulder 0.64, upper arm and forearm
/// 1.19, wrists and load 0.5.
const REACH: f64 = 2.33;
/// An obstacle this much lower than what travels on the rails is not near it, m.
const HIGH: f64 = 0.3;
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
        let trips: Vec<(&Machine, Vec<Vec<Solid>>)> = others().map(|other| (other, trips(other))).collect();
        let all = boxes.iter().chain(trips.iter().flat_map(|(_, passed)| passed));
        let blocks = all.flat_map(|solids| {
            around.iter().map(|part| part.keeps_off(shoulder, solids)).collect::<Vec<_>>()
        });
        let blocks: Vec<Block> = blocks.flatten().collect();
        let obstacles = boxes.iter().flatten();
        let largest = |value: fn(&Kind) -> f64| line.kinds.iter().map(value).fold(0.0, f64::max);
        let under = largest(|kind| kind.grasp);
        let tallest = obstacles.clone().map(top).filter(|top| *top < shoulder).fold(0.0, f64::max);
        let obstacles = boxes.iter().filter_map(|solids| Cluster::new(solids)).collect();
        let members = Member::all(own);
        let hand = members.last()?.link;
        let load = largest_load(&line.kinds);
        let load = Member::new(hand, vec![load]);
        let beams = members.iter().filter(|member| member.link < TORSO).flat_map(|member| &member.pieces);
        let lowest_beam = beams.map(|piece| shoulder + piece.lowest()).fold(f64::INFINITY, f64::min);
        let places = places(line);
        let heights = places.iter().flat_map(|places| &places.all).map(|(place, _)| place.z);
        let scene = Self {
            links: Links::new(arm, &Chain::new(&arm, own), members, load),
            arm,
            obstacles,
            lanes: trips.iter().filter_map(|(machine, passed)| Lane::new(machine, passed)).collect(),
            lowest_beam,
            load_height: largest(|kind| kind.height),
            highest_place: heights.fold(0.0, f64::max) + under,
            places,
            over_all: tallest + under + OVER,
        };
        Some((scene, blocks))
    }

    /// The obstacles that the robot can come near while its torso is between these places, and vehicles under way: all
    /// but those that have one of these tools over them, which wait there.
    pub fn near(&self, places: impl IntoIterator<Item = Point>, tools: &[Point]) -> Nearby<'_> {
        let none =
            [Point::new(f64::INFINITY, f64::INFINITY, 0.0), Point::new(-f64::INFINITY, -f64::INFINITY, 0.0)];
        let [low, high] = places.into_iter().fold(none, |[low, high], place| {
            [
                Point::new(low.x.min(place.x), low.y.min(place.y), 0.0),
                Point::new(high.x.max(place.x), high.y.max(place.y), 0.0),
            ]
        });
        let is_near = |other: &&Cluster| {
            let [lowest, highest] = other.bounds.corners();
            let beside = lowest.x > high.x + REACH || highest.x < low.x - REACH;
            let behind = lowest.y > high.y + REACH || highest.y < low.y - REACH;
            !(beside || behind)
        };
        let waits =
            |lane: &&Lane| tools.iter().any(|tool| lane.places.iter().any(|place| is_over(*tool, *place)));
        let lanes = self.lanes.iter().filter(|lane| !waits(lane)).map(|lane| &lane.cluster);
        let is_high = |other: &&Cluster| other.bounds.corners()[1].z > self.lowest_beam - HIGH;
        let all: Vec<&Cluster> = self.obstacles.iter().chain(lanes).collect();
        let high = all.iter().copied().filter(is_high).collect();
        Nearby { all: all.into_iter().filter(is_near).collect(), high }
    }

    /// See [`super::gap::Standing::gap`].
    pub fn gap(&self, near: &Nearby, joints: &Joints, load: Load, range: [f64; 2]) -> f64 {
        self.links.at(joints).gap(near, load, range)
    }

    /// How far the robot is from parts that may lie beside the place under the tool, m; `enough` if it is that far or farther.
    pub fn gap_at_place(&self, joints: &Joints, enough: f64) -> f64 {
        let tool = self.arm.tool(joints);
        let links = self.links.at(joints);
        let mut least = enough;
        for Places { all, order } in &self.places {
            let Some(here) = all.iter().position(|(place, _)| is_over(tool, *place)) else { continue };
            for (i, (_, part)) in all.iter().enumerate() {
                if i > here || i < here && *order == Order::Any {
                    least = links.gap_to(part, least);
                }
            }
        }
        least
    }
}

impl Lane {
    /// None of a machine that stands.
    fn new(machine: &Machine, passed: &[Vec<Solid>]) -> Option<Self> {
        let stops = machine.visited();
        let carried =
            machine.places().filter(|place| machine.is_driven(place)).flat_map(|place| &place.slots);
        let places = carried.flat_map(|slot| stops.iter().map(|stop| *stop + *slot)).collect();
        Some(Self { cluster: Cluster::new(&passed.concat())?, places })
    }
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

fn is_over(tool: Point, place: Point) -> bool {
    let offset = place - tool;
    offset.x * offset.x + offset.y * offset.y <= AT_PLACE * AT_PLACE
}

fn shifted(solids: &[Solid], by: Point) -> Vec<Solid> {
    let moved = |s: &Solid| Solid { pose: Pose { position: s.pose.position + by, ..s.pose }, ..s.clone() };
    solids.iter().map(moved).collect()
}

/// What a vehicle passes through between the stops at which it can be, in groups that are one rectangle from above.
fn trips(machine: &Machine) -> Vec<Vec<Solid>> {
    let stops = machine.visited();
    let solids = machine.solids();
    let trips =
        stops.iter().enumerate().flat_map(|(i, start)| stops[i + 1..].iter().map(move |end| [start, end]));
    trips.flat_map(|[start, end]| on_trip(&solids, *start, *end)).collect()
}

/// The same on one trip.
fn on_trip(solids: &[Solid], start: Point, end: Point) -> Vec<Vec<Solid>> {
    let trip = end - start;
    let [x, y, z] = [trip.x, trip.y, trip.z].map(f64::abs);
    if [x, y, z].iter().filter(|along| **along > 0.0).count() <= 1 {
        let swept = shifted(solids, start + trip.scaled(0.5)).into_iter().map(|solid| {
            let size = half(&solid).scaled(2.0) + Point::new(x, y, z);
            Solid { shape: Shape::Box { size }, ..solid }
        });
        return vec![swept.collect()];
    }
    let steps = (trip.length() / STEP).ceil().max(1.0);
    let places = (0..=steps as u32).map(|i| start + trip.scaled(f64::from(i) / steps));
    places.map(|place| shifted(solids, place)).collect()
}

/// The workspace of a machine while the gantry works, in groups that stand together: a vehicle at each stop at
/// which it can be, an arm along its rail.
fn workspaces(machine: &Machine) -> Vec<Vec<Solid>> {
    let solids = machine.solids();
    if machine.route().is_some() {
        return machine.visited().iter().map(|stop| shifted(&solids, *stop)).collect();
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
        let stops = machine.visited();
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
        Kind { name: "part".into(), height, grasp, size: [0.1, 0.2], is: Vec::new(), mass: 0.1, deck: None }
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
