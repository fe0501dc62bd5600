//! Conveyors and places through which vehicles drive: these have no solids, so no contact is found there.

use super::body::{Ball, Piece, Placed};
use super::bounds::BoundingBox;
use super::sweep::Sweep;
use crate::frame::Frame;
use crate::kinematics::facing::Facing;
use crate::kinematics::pose::Pose;
use crate::line::Line;
use crate::machine::Machine;
use crate::part::Primitive;
use crate::part::lane::CentreLine;
use crate::point::{Axis, Point};
use crate::solid::{Link, Shape, Solid};
use std::cell::OnceCell;
use std::collections::HashMap;
use std::rc::Rc;

/// A conveyor or a place, and the first vehicle that drives through it.
#[derive(Clone, Debug, PartialEq)]
pub struct DrivenThrough {
    pub vehicle: usize,
    /// Which of its bodies.
    pub body: String,
    pub machine: usize,
    pub part: usize,
    /// The position of the vehicle.
    pub at: Point,
}

/// Height of the plate under a surface that vehicles must not enter, m.
const PLATE: f64 = 0.005;
/// A conveyor that rises or turns is taken for straight plates of this length, m; longer ones if there were too many.
const STRETCH: f64 = 0.2;
const MOST_PLATES: f64 = 200.0;
/// From one look at a vehicle to the next one, m; more if there were too many.
const STEP: f64 = 0.05;
const MOST_STEPS: f64 = 2000.0;

/// One for each surface, in the order of the machines; none of what a cylinder or a positioner moves, of pairs that may
/// touch, and of machines with a body that is hit too, because a run finds that contact.
pub fn driven_through(line: &Line) -> Vec<DrivenThrough> {
    let envelopes = envelopes(line);
    if envelopes.is_empty() {
        return Vec::new();
    }
    let surfaces: Vec<Surface> =
        line.machines.iter().enumerate().flat_map(|(number, machine)| surfaces(number, machine)).collect();
    let swept = envelopes.iter().map(|envelope| envelope.whole);
    let sweep = Sweep::new(swept.chain(surfaces.iter().map(|surface| surface.bounds)));
    let mut near: Vec<Vec<usize>> = vec![Vec::new(); surfaces.len()];
    for mut pair in sweep.meeting() {
        pair.sort_unstable();
        let [envelope, surface] = pair;
        if envelope < envelopes.len() && surface >= envelopes.len() {
            near[surface - envelopes.len()].push(envelope);
        }
    }
    let found = surfaces.iter().zip(near).filter_map(|(surface, mut near)| {
        near.sort_unstable();
        surface.driven_through(line, near.into_iter().map(|envelope| &envelopes[envelope]))
    });
    found.collect()
}

/// A conveyor or the floor of a place, and the machine that it is of.
struct Surface {
    machine: usize,
    part: usize,
    bounds: BoundingBox,
}

fn surfaces(number: usize, machine: &Machine) -> impl Iterator<Item = Surface> {
    machine.parts.iter().enumerate().filter_map(move |(part, of)| {
        let bounds = plates(&of.primitive)?.bounds;
        Some(Surface { machine: number, part, bounds })
    })
}

impl Surface {
    /// By the first vehicle in the order of the machines; the first vehicles of the envelopes ascend.
    fn driven_through<'e>(
        &self,
        line: &Line,
        near: impl Iterator<Item = &'e Envelope>,
    ) -> Option<DrivenThrough> {
        let machine = &line.machines[self.machine];
        let (plates, bodies) = (OnceCell::new(), OnceCell::new());
        let is_other = |vehicle: &&usize| {
            let names = [self.machine, **vehicle].map(|machine| line.machines[machine].name.as_str());
            **vehicle != self.machine && !line.allows(names)
        };
        let mut first: Option<DrivenThrough> = None;
        for envelope in near {
            if first.as_ref().is_some_and(|found| found.vehicle < envelope.vehicles[0]) {
                break;
            }
            let plates = plates.get_or_init(|| self::plates(&machine.parts[self.part].primitive));
            let met = plates.as_ref().and_then(|plates| envelope.meets(plates));
            let Some((at, body)) = met else { continue };
            if envelope.meets(bodies.get_or_init(|| unmoved_bodies(machine))).is_some() {
                continue;
            }
            let Some(&vehicle) = envelope.vehicles.iter().find(is_other) else { continue };
            if first.as_ref().is_none_or(|found| vehicle < found.vehicle) {
                let body = body.into();
                first = Some(DrivenThrough { vehicle, body, machine: self.machine, part: self.part, at });
            }
        }
        first
    }
}

/// The bodies that do not move.
fn unmoved_bodies(machine: &Machine) -> Standing {
    let solids = machine.solids().into_iter().filter(|solid| solid.link == Link::World);
    let pieces = solids.map(|solid| Piece::new(solid.name, &solid.pose, solid.shape));
    Standing::new(pieces.map(|piece| piece.within(&Pose::IDENTITY)).collect())
}

/// What stands still.
struct Standing {
    pieces: Vec<Placed>,
    bounds: BoundingBox,
}

impl Standing {
    fn new(pieces: Vec<Placed>) -> Self {
        let bounds = around(pieces.iter().map(Placed::bounds));
        Self { pieces, bounds }
    }

    fn ball(&self) -> Ball {
        let [low, high] = self.bounds.corners();
        Ball { middle: low + (high - low).scaled(0.5), radius: (high - low).length() / 2.0 }
    }

    fn meets(&self, body: &Placed) -> bool {
        let may_meet = |piece: &&Placed| body.apart_at_least(piece, f64::MIN_POSITIVE) <= 0.0;
        self.pieces.iter().filter(may_meet).any(|piece| body.gap(piece).distance <= 0.0)
    }
}

/// What vehicles with bodies pass: one for those of the same bodies that drive on the same straights.
fn envelopes(line: &Line) -> Vec<Envelope> {
    let mut envelopes: Vec<Envelope> = Vec::new();
    let mut bodies_of_all = BodiesOfAll::default();
    // By the straights: bodies, and the number of the envelope.
    let mut known: HashMap<Vec<u64>, Vec<(Rc<Bodies>, usize)>> = HashMap::new();
    for (number, machine) in line.machines.iter().enumerate() {
        let mut bodies = machine.solids();
        bodies.retain(|solid| solid.link == Link::Route);
        if bodies.is_empty() {
            continue;
        }
        let straights = straights(machine);
        let bits = |(yaw, ends): &Straight| {
            let [from, to] = ends.map(|end| [end.x, end.y, end.z]);
            [*yaw].into_iter().chain(from).chain(to).map(f64::to_bits)
        };
        let bodies = bodies_of_all.once(bodies);
        let alike = known.entry(straights.iter().flat_map(bits).collect()).or_default();
        match alike.iter().find(|(known, _)| Rc::ptr_eq(known, &bodies)) {
            Some((_, envelope)) => envelopes[*envelope].vehicles.push(number),
            None => {
                alike.push((bodies.clone(), envelopes.len()));
                envelopes.push(Envelope::new(number, straights, bodies));
            }
        }
    }
    envelopes
}

/// Bodies of a vehicle.
struct Bodies {
    solids: Vec<Solid>,
    pieces: Vec<Piece>,
    /// No point of a body is farther from the position of the vehicle, m.
    reach: f64,
}

impl Bodies {
    fn new(solids: Vec<Solid>) -> Self {
        let pieces = solids.iter().map(|solid| Piece::new(solid.name.clone(), &solid.pose, solid.shape));
        let pieces: Vec<Piece> = pieces.collect();
        let reach = pieces.iter().map(|body| body.ball().middle.length() + body.ball().radius);
        let reach = reach.fold(0.0, f64::max);
        Self { solids, pieces, reach }
    }
}

/// Those of all vehicles, by where they are on it.
#[derive(Default)]
struct BodiesOfAll(HashMap<Vec<u64>, Vec<Rc<Bodies>>>);

impl BodiesOfAll {
    /// Of vehicles that are alike the same ones.
    fn once(&mut self, solids: Vec<Solid>) -> Rc<Bodies> {
        let places = solids.iter().map(|solid| solid.pose.position);
        let key = places.flat_map(|place| [place.x, place.y, place.z].map(f64::to_bits)).collect();
        let alike = self.0.entry(key).or_default();
        if let Some(known) = alike.iter().find(|known| known.solids == solids) {
            return known.clone();
        }
        let bodies = Rc::new(Bodies::new(solids));
        alike.push(bodies.clone());
        bodies
    }
}

/// What vehicles pass.
struct Envelope {
    /// Numbers of the machines, ascending.
    vehicles: Vec<usize>,
    bodies: Rc<Bodies>,
    /// In the order in which their bounds begin along the axis.
    segments: Vec<Segment>,
    axis: Axis,
    /// No bounds of a segment are longer along the axis, m.
    longest: f64,
    whole: BoundingBox,
}

/// The direction in which a vehicle looks, degrees, and both ends.
type Straight = (f64, [Point; 2]);

/// A straight piece on which a vehicle does not turn.
struct Segment {
    from: Frame,
    ahead: Point,
    length: f64,
    /// Contains all bodies from end to end.
    bounds: BoundingBox,
}

impl Envelope {
    fn new(vehicle: usize, straights: Vec<Straight>, bodies: Rc<Bodies>) -> Self {
        let mut at_ends: HashMap<[u64; 4], BoundingBox> = HashMap::new();
        let mut at = |yaw: f64, end: Point| {
            let bounds = || {
                let pose = Frame::new(end, yaw).pose();
                around(bodies.pieces.iter().map(|body| body.within(&pose).bounds()))
            };
            *at_ends.entry([yaw, end.x, end.y, end.z].map(f64::to_bits)).or_insert_with(bounds)
        };
        let segments = straights.into_iter().map(|(yaw, [from, to])| {
            let bounds = at(yaw, from).with(&at(yaw, to));
            segment(yaw, [from, to], bounds)
        });
        let mut segments: Vec<Segment> = segments.collect();
        let whole = around(segments.iter().map(|segment| segment.bounds));
        let length = |bounds: &BoundingBox, axis| bounds.along(axis)[1] - bounds.along(axis)[0];
        let axis = if length(&whole, Axis::X) >= length(&whole, Axis::Y) { Axis::X } else { Axis::Y };
        segments.sort_by(|a, b| a.bounds.along(axis)[0].total_cmp(&b.bounds.along(axis)[0]));
        let longest = segments.iter().map(|segment| length(&segment.bounds, axis)).fold(0.0, f64::max);
        Self { vehicles: vec![vehicle], bodies, segments, axis, longest, whole }
    }

    /// Where the vehicle is when one of its bodies meets something that stands, and the name of the body.
    fn meets(&self, standing: &Standing) -> Option<(Point, &str)> {
        if standing.pieces.is_empty() || self.whole.is_apart(&standing.bounds) {
            return None;
        }
        let mut near = self.near(&standing.bounds);
        near.find_map(|segment| {
            segment.near(standing.ball(), self.bodies.reach).find_map(|frame| {
                let pose = frame.pose();
                let body = self.bodies.pieces.iter().find(|body| standing.meets(&body.within(&pose)))?;
                Some((frame.position, body.name.as_str()))
            })
        })
    }

    /// The segments that are not apart from this.
    fn near(&self, bounds: &BoundingBox) -> impl Iterator<Item = &Segment> {
        let (axis, [low, high]) = (self.axis, bounds.along(self.axis));
        let begin = move |segment: &Segment| segment.bounds.along(axis)[0];
        let first = self.segments.partition_point(|segment| begin(segment) < low - self.longest);
        let until_end = self.segments[first..].iter().take_while(move |segment| begin(segment) <= high);
        until_end.filter(|segment| !segment.bounds.is_apart(bounds))
    }
}

impl Segment {
    /// Places on it from which a ball may be reached.
    fn near(&self, ball: Ball, reach: f64) -> impl Iterator<Item = Frame> + '_ {
        let middle = (ball.middle - self.from.position).dot(self.ahead);
        let reach = ball.radius + reach;
        let (begin, end) = ((middle - reach).max(0.0), (middle + reach).min(self.length));
        let steps = ((end - begin) / STEP).ceil().clamp(1.0, MOST_STEPS);
        let step = (end - begin) / steps;
        let count = if end < begin { 0 } else { steps as usize + 1 };
        (0..count).map(move |number| {
            let place = begin + step * number as f64;
            Frame { position: self.from.position + self.ahead.scaled(place), ..self.from }
        })
    }
}

/// What a vehicle drives on.
fn straights(machine: &Machine) -> Vec<Straight> {
    if let Some(track) = machine.track() {
        return track.driven();
    }
    let stops = machine.stops();
    let from_each = stops.iter().enumerate().map(|(number, from)| (from, &stops[number + 1..]));
    from_each.flat_map(|(from, others)| others.iter().map(move |to| (0.0, [*from, *to]))).collect()
}

fn segment(yaw: f64, [from, to]: [Point; 2], bounds: BoundingBox) -> Segment {
    let length = (to - from).length();
    let ahead = (to - from).scaled(1.0 / length.max(f64::MIN_POSITIVE));
    Segment { from: Frame::new(from, yaw), ahead, length, bounds }
}

/// The surface of a conveyor or of the floor of a place, as plates under it; none of one that is moved.
fn plates(primitive: &Primitive) -> Option<Standing> {
    let plate = |frame: Frame, length: f64, width: f64| {
        let middle = frame.point(Point::new(0.0, 0.0, -PLATE / 2.0));
        let shape = Shape::Box { size: Point::new(length, width, PLATE) };
        Piece::new(String::new(), &Frame { position: middle, ..frame }.pose(), shape).within(&Pose::IDENTITY)
    };
    match primitive {
        Primitive::Lane(lane) if lane.on.is_none() => {
            let line = &lane.centre_line;
            let is_straight = match line {
                CentreLine::Axis { .. } => true,
                CentreLine::Line { rise, .. } => *rise == 0.0,
                CentreLine::Arc { .. } => false,
            };
            let count = if is_straight {
                1
            } else {
                (line.length() / STRETCH).ceil().clamp(1.0, MOST_PLATES) as usize
            };
            let length = line.length() / count as f64;
            let middle = |number: usize| line.frame(line.end() + length * (number as f64 + 0.5));
            Some(Standing::new((0..count).map(|number| plate(middle(number), length, lane.width)).collect()))
        }
        Primitive::Place(place) if place.on.is_none() && place.facing == Facing::Down => {
            let (frame, [length, width]) = place.floor.sides();
            let frame = Frame::new(place.at, 0.0).then(frame);
            Some(Standing::new(vec![plate(frame, length, width)]))
        }
        _ => None,
    }
}

fn around(all: impl Iterator<Item = BoundingBox>) -> BoundingBox {
    all.fold(BoundingBox::NOTHING, |all, next| all.with(&next))
}
