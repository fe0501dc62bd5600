//! A vehicle on a track.

mod polyline;
mod network;
mod ride;

pub use polyline::Polyline;
pub use network::{Edge, Network};
pub use ride::{Begin, Piece, Ride};

use super::settings::{Form, Setting, Settings};
use super::{Action, Begun, Described, Progress, Running, Schema, See, Signal, Start, World};
use crate::device::{Extent, PortType, error};
use crate::frame::Frame;
use crate::plant::EARLY_MS;
use crate::plant::trajectory::Trajectory;
use crate::point::Point;
use std::sync::Arc;

/// Places at most.
const MOST_PLACES: i32 = network::MOST_NODES as i32;

pub const SCHEMA: Schema = Schema {
    signals: &[
        Signal { name: "position", ty: PortType::Point, extent: Extent::One },
        Signal { name: "place", ty: PortType::Int { lo: -1, hi: MOST_PLACES - 1 }, extent: Extent::One },
        Signal { name: "stands", ty: PortType::Bool, extent: Extent::One },
    ],
    actions: &[
        Action { name: "to", arguments: &[PortType::Int { lo: 0, hi: MOST_PLACES - 1 }] },
        Action { name: "halt", arguments: &[] },
    ],
    can_jam: true,
    ..Schema::new(
        "track",
        "A vehicle that follows a track on the floor, straight from corner to corner. It does not slow down at corners, and turns there at once. With `corners` and `places` it goes round a closed track in one direction, and drives also back on an open one. With `nodes` and `edges` it takes the quickest way over the edges from node to node.",
        &[
            Setting::new("corners", Form::Points, "m", "of the path of its middle, all with the same z").optional(),
            Setting::new("closed", Form::Truth, "", "the track continues from the last corner to the first").optional(),
            Setting::new("places", Form::Numbers, "m", "along the track from the first corner: its possible goals, which `place` reports; at most 256").optional(),
            Setting::new("nodes", Form::Points, "m", "branches, junctions and stops, all with the same z: its possible goals, which `place` reports; at most 256").optional(),
            Setting::new("edges", Form::Numbers, "", "numbers of nodes in pairs: each edge leads straight from one node to another one, in this direction; at most 1024").optional(),
            Setting::new("speeds", Form::Numbers, "m/s", "greatest velocity on each edge; without it only that of the vehicle counts").optional(),
            Setting::new("begins", Form::Number, "m or -", "its place along the track at the start, or the number of its node; without it, the first corner or node").optional(),
            Setting::new("speed", Form::Positive, "m/s", "greatest velocity"),
            Setting::new("acceleration", Form::Positive, "m/s2", "greatest acceleration, also for braking"),
            Setting::new("mass", Form::Positive, "kg", "of all moving bodies, for the world"),
        ],
    )
};

#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    pub guide: Guide,
    pub speed: f64,
    pub acceleration: f64,
    pub mass: f64,
}

/// What it follows.
#[derive(Clone, Debug, PartialEq)]
pub enum Guide {
    /// Goals and the start are places along it.
    Line { polyline: Arc<Polyline>, places: Vec<f64>, begins: f64 },
    /// Goals and the start are nodes.
    Network { network: Arc<Network>, begins: usize },
}

/// Two places are the same that are no farther from one another, m.
const SAME: f64 = 1e-6;
/// Before it sets out on a network it stands at the end of a line of this length, m.
const LEAD: f64 = 1.0;

impl Described for Track {
    fn new(settings: &Settings) -> Result<Self, String> {
        let [line, network] = [["corners", "places"].as_slice(), &["nodes", "edges"]]
            .map(|names| names.iter().filter(|name| settings.has(name)).count());
        let others = |names: &[&str]| names.iter().any(|name| settings.has(name));
        let guide = match (line, network) {
            (2, 0) if !others(&["speeds"]) => Guide::line(settings)?,
            (0, 2) if !others(&["closed"]) => Guide::network(settings)?,
            _ => return Err("a track is given by corners and places, or by nodes and edges".into()),
        };
        Ok(Self {
            guide,
            speed: settings.positive("speed")?,
            acceleration: settings.positive("acceleration")?,
            mass: settings.positive("mass")?,
        })
    }

    fn start(&self, _start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        Ok(Some(Box::new(Driving::new(self)?)))
    }
}

impl Guide {
    fn line(settings: &Settings) -> Result<Self, String> {
        let is_closed = settings.has("closed") && settings.truth("closed")?;
        let polyline = Polyline::new(&settings.points("corners")?, is_closed)?;
        let places = settings.numbers("places")?;
        let begins = settings.optional("begins", Settings::number)?.unwrap_or(0.0);
        let length = polyline.length();
        let is_on_track = |place: f64| (-SAME..=length + SAME).contains(&place);
        if let Some((number, place)) = places.iter().enumerate().find(|(_, place)| !is_on_track(**place)) {
            return Err(format!("place {number} is at {place:.3} m of a track of {length:.3} m"));
        }
        if !is_on_track(begins) {
            return Err(format!("it begins at {begins:.3} m of a track of {length:.3} m"));
        }
        if places.len() > MOST_PLACES as usize {
            return Err(format!("{} places, {MOST_PLACES} are the most", places.len()));
        }
        let on_track = |place: f64| polyline.on_track(place);
        let places = places.into_iter().map(on_track).collect();
        Ok(Self::Line { places, begins: on_track(begins), polyline: Arc::new(polyline) })
    }

    fn network(settings: &Settings) -> Result<Self, String> {
        let speeds = settings.optional("speeds", Settings::numbers)?;
        let network = Network::new(settings.points("nodes")?, &settings.numbers("edges")?, speeds.as_deref())?;
        let begins = settings.optional("begins", Settings::number)?.unwrap_or(0.0);
        let nodes = network.nodes.len();
        if begins.fract() != 0.0 || !(0.0..nodes as f64).contains(&begins) {
            return Err(format!("it begins at node {begins}, nodes are 0 to {}", nodes - 1));
        }
        let begins = begins as usize;
        network.cut_off(begins).map_or(Ok(()), Err)?;
        Ok(Self::Network { network: Arc::new(network), begins })
    }
}

impl Track {
    /// Where the vehicle is at the start.
    pub fn begin(&self) -> Frame {
        match &self.guide {
            Guide::Line { polyline, begins, .. } => polyline.frame(*begins),
            Guide::Network { network, begins } => {
                let ahead = network.ahead(*begins);
                let yaw = libm::atan2(ahead.y, ahead.x).to_degrees();
                Frame::new(network.nodes[*begins], yaw)
            }
        }
    }

    /// Between these it drives straight.
    pub fn corners(&self) -> Vec<Point> {
        match &self.guide {
            Guide::Line { polyline, .. } => polyline.corners(),
            Guide::Network { network, .. } => network.nodes.clone(),
        }
    }

    /// What the vehicle drives on: the direction in which it looks, degrees, and both ends. Of an open track this is what lies
    /// between the first and the last of its places and of where it begins.
    pub fn driven(&self) -> Vec<(f64, [Point; 2])> {
        match &self.guide {
            Guide::Line { polyline, .. } if polyline.is_closed() => {
                polyline.pieces(0.0, polyline.length()).collect()
            }
            Guide::Line { polyline, places, begins } => {
                let first = places.iter().copied().fold(*begins, f64::min);
                let last = places.iter().copied().fold(*begins, f64::max);
                polyline.pieces(first, last).collect()
            }
            Guide::Network { network, .. } => network.edges.iter().map(|edge| network.driven(edge)).collect(),
        }
    }

    /// Both ends of all sides of its guide.
    pub fn sides(&self) -> Vec<[Point; 2]> {
        match &self.guide {
            Guide::Line { polyline, .. } => polyline.sides().collect(),
            Guide::Network { network, .. } => {
                network.edges.iter().map(|edge| [edge.from, edge.to].map(|node| network.nodes[node])).collect()
            }
        }
    }

    /// Its goals.
    pub fn goals(&self) -> Vec<Point> {
        match &self.guide {
            Guide::Line { polyline, places, .. } => {
                places.iter().map(|place| polyline.frame(*place).position).collect()
            }
            Guide::Network { network, .. } => network.nodes.clone(),
        }
    }
}

/// The place that lies last behind this one; none on an open track before the first.
fn behind(polyline: &Polyline, places: &[f64], place: f64) -> Option<usize> {
    let gone = |other: f64| {
        let gone = place - other + SAME;
        if polyline.is_closed() { polyline.on_track(gone) } else { gone }
    };
    let behind = places.iter().map(|other| gone(*other)).enumerate().filter(|(_, gone)| *gone >= 0.0);
    behind.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(number, _)| number)
}

/// From where it is to rest.
struct Way {
    leads: Leads,
    /// Where it is.
    from: f64,
    /// Less than 0 back.
    length: f64,
}

/// What it drives along.
#[derive(Clone, Debug)]
struct Leads {
    polyline: Arc<Polyline>,
    /// The goals along it, and their numbers.
    goals: Vec<(f64, usize)>,
}

/// A vehicle at work.
#[derive(Clone, Debug)]
pub struct Driving {
    track: Track,
    now_ms: u64,
    leads: Leads,
    /// Where it rests.
    place: f64,
    /// While it moves.
    ride: Option<Ride>,
    /// The goals that it comes by on this ride: when, ms, and their numbers.
    ahead: Vec<(f64, usize)>,
    passed: Option<usize>,
    asked: Option<Asked>,
    held: bool,
}

/// What the command under way asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Asked {
    Place(usize),
    Halt,
}

impl Driving {
    fn new(track: &Track) -> Result<Self, String> {
        let (leads, place, passed) = match &track.guide {
            Guide::Line { polyline, places, begins } => {
                let goals = places.iter().copied().zip(0..).collect();
                (Leads { polyline: polyline.clone(), goals }, *begins, behind(polyline, places, *begins))
            }
            Guide::Network { network, begins } => {
                let node = network.nodes[*begins];
                let lead = node - network.ahead(*begins).scaled(LEAD);
                let polyline = Arc::new(Polyline::new(&[lead, node], false)?);
                let place = polyline.length();
                (Leads { polyline, goals: vec![(place, *begins)] }, place, Some(*begins))
            }
        };
        Ok(Self {
            track: track.clone(),
            now_ms: 0,
            leads,
            place,
            ride: None,
            ahead: Vec::new(),
            passed,
            asked: None,
            held: false,
        })
    }

    fn polyline(&self) -> &Polyline {
        &self.leads.polyline
    }

    /// Where it is along the track at a time from now on, if no command changes anything.
    fn place(&self, ms: f64) -> f64 {
        self.ride.as_ref().map_or(self.place, |ride| ride.place(ms))
    }

    pub fn frame(&self, ms: f64) -> Frame {
        self.polyline().frame(self.place(ms))
    }

    pub fn frame_now(&self) -> Frame {
        self.frame(self.now_ms as f64)
    }

    /// When it comes to rest, ms.
    pub fn rests_ms(&self) -> f64 {
        self.ride.as_ref().map_or(f64::NEG_INFINITY, Ride::end_ms)
    }

    /// That it does not exceed until a command changes it, m/s.
    pub fn speed_limit(&self) -> f64 {
        self.ride.as_ref().map_or(0.0, Ride::top_speed)
    }

    /// How far a point is from the track within so many metres ahead of it at a time, m.
    pub fn distance(&self, point: Point, range: f64, ms: f64) -> f64 {
        let place = self.place(ms);
        self.polyline().distance(point, place, place + range)
    }

    fn now(&self) -> Begin {
        let now_ms = self.now_ms as f64;
        Begin {
            ms: now_ms,
            place: self.place(now_ms),
            speed: self.ride.as_ref().map_or(0.0, |ride| ride.speed(now_ms)),
            top_speed: self.track.speed,
            acceleration: self.track.acceleration,
        }
    }

    /// To a goal; none if there is no such goal, or it comes too fast to stop there.
    fn way_to(&self, goal: usize) -> Option<Way> {
        match &self.track.guide {
            Guide::Line { places, .. } => self.way_along(*places.get(goal)?),
            Guide::Network { network, .. } => self.way_over(network, goal),
        }
    }

    /// To a place of the line that it follows.
    fn way_along(&self, place: f64) -> Option<Way> {
        let now = self.now();
        let mut length = place - now.place;
        if self.polyline().is_closed() {
            length = self.polyline().on_track(length);
            if self.polyline().length() - length < SAME {
                length = 0.0;
            }
        }
        let way = |length: f64| Way { leads: self.leads.clone(), from: now.place, length };
        if length.abs() < SAME && now.speed == 0.0 {
            return Some(way(0.0));
        }
        let sign = self.ride.as_ref().map_or(length.signum(), Ride::sign);
        (now.speed == 0.0 || length * sign >= now.braking() - SAME).then(|| way(length))
    }

    /// Over edges: behind a node to the end of the edge on which it is, and on from there.
    fn way_over(&self, network: &Network, goal: usize) -> Option<Way> {
        let now = self.now();
        let at = self.leads.goals.partition_point(|(place, _)| *place <= now.place + SAME);
        let &(behind, last) = self.leads.goals.get(at.checked_sub(1)?)?;
        let is_at_node = now.place - behind < SAME;
        let speed = self.track.speed;
        let (lead, edges) = if is_at_node {
            if last == goal {
                let way = Way { leads: self.leads.clone(), from: now.place, length: 0.0 };
                return (now.speed == 0.0).then_some(way);
            }
            let ahead = self.polyline().ahead(behind.next_down());
            (Some(network.nodes[last] - ahead.scaled(LEAD)), network.way(last, goal, speed)?)
        } else {
            let next = self.leads.goals.get(at)?.1;
            let mut edges = vec![network.edge(last, next)?];
            edges.extend(network.way(next, goal, speed)?);
            (None, edges)
        };
        let polyline = network.polyline(lead, &edges, now.speed).ok()?;
        let mut place = lead.map_or(0.0, |_| LEAD);
        let mut goals = vec![(place, last)];
        for edge in &edges {
            place += network.length(*edge);
            goals.push((place, network.edges[*edge].to));
        }
        // It turns as it sets out.
        let from = if is_at_node { LEAD.next_down() } else { now.place - behind };
        let length = polyline.length() - from;
        let begin = Begin { place: from, ..now };
        let is_possible = now.speed == 0.0 || Ride::is_possible(&polyline, &begin, polyline.length(), SAME);
        let leads = Leads { polyline: Arc::new(polyline), goals };
        is_possible.then_some(Way { leads, from, length })
    }

    /// Sets out, or continues as it is.
    fn ride(&mut self, way: Way) {
        let now = Begin { place: way.from, ..self.now() };
        self.leads = way.leads;
        let length = way.length.signum() * way.length.abs().max(now.braking());
        self.ahead.clear();
        if length == 0.0 {
            self.place = now.place;
            self.ride = None;
            return;
        }
        let ride = Ride::new(self.leads.polyline.clone(), now, now.place + length);
        let round = self.polyline().length();
        for (place, number) in &self.leads.goals {
            let mut gone = (place - now.place) * ride.sign();
            if self.leads.polyline.is_closed() {
                gone = self.leads.polyline.on_track(gone);
                // A place that is rounded to be behind it.
                if round - gone < SAME {
                    gone = 0.0;
                }
            }
            if (-SAME..=length.abs() + SAME).contains(&gone) {
                self.ahead.push((ride.time_of(gone), *number));
            }
        }
        self.ahead.sort_by(|a, b| a.0.total_cmp(&b.0));
        self.ride = Some(ride);
    }

    fn brake(&mut self) {
        let sign = self.ride.as_ref().map_or(1.0, Ride::sign);
        let now = self.now();
        self.ride(Way { leads: self.leads.clone(), from: now.place, length: sign * now.braking() });
    }

    /// Goes on after it was held.
    fn resume(&mut self) {
        if let Some(Asked::Place(number)) = self.asked
            && let Some(way) = self.way_to(number)
        {
            self.ride(way);
        }
    }
}

impl Running for Driving {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    fn begin(&mut self, action: usize, arguments: &[f64], world: &mut World) -> Result<Begun, i32> {
        self.now_ms = world.now_ms;
        self.asked = None;
        match (action, arguments) {
            (0, &[number]) => {
                let way = (number >= 0.0).then(|| self.way_to(number as usize)).flatten();
                let way = way.ok_or(error::UNREACHABLE)?;
                self.asked = Some(Asked::Place(number as usize));
                if !self.held {
                    self.ride(way);
                }
            }
            (1, []) => {
                self.asked = Some(Asked::Halt);
                self.brake();
            }
            _ => return Err(error::REFUSED),
        }
        Ok(Begun::UnderWay)
    }

    /// It comes to rest.
    fn abandon(&mut self, now_ms: u64) {
        self.now_ms = now_ms;
        self.asked = None;
        self.brake();
    }

    fn hold(&mut self, held: bool, now_ms: u64) {
        if self.held == held {
            return;
        }
        self.now_ms = now_ms;
        self.held = held;
        if held { self.brake() } else { self.resume() }
    }

    fn advance(&mut self, world: &mut World) -> Progress {
        self.now_ms = world.next_ms();
        let now_ms = self.now_ms as f64;
        let gone = self.ahead.partition_point(|(ms, _)| *ms <= now_ms + EARLY_MS);
        if let Some((_, number)) = self.ahead.drain(..gone).next_back() {
            self.passed = Some(number);
        }
        if let Some(ride) = self.ride.as_ref().filter(|ride| ride.end_ms() <= now_ms + EARLY_MS) {
            self.place = self.polyline().on_track(ride.to());
            self.ride = None;
        }
        if self.ride.is_none() && !self.held && self.asked.take().is_some() {
            return Progress::Reached;
        }
        Progress::Going
    }

    fn signal(&self, signal: usize, _see: &See, out: &mut [f64]) {
        match signal {
            0 => {
                let Point { x, y, z } = self.frame_now().position;
                out.copy_from_slice(&[x, y, z]);
            }
            1 => out[0] = self.passed.map_or(-1.0, |number| number as f64),
            _ => out[0] = f64::from(u8::from(self.ride.is_none())),
        }
    }

    /// It comes by a place, or to rest.
    fn next_change(&self, _see: &See, now_ms: u64) -> f64 {
        match &self.ride {
            Some(ride) => self.ahead.first().map_or(ride.end_ms(), |(ms, _)| ms.min(ride.end_ms())),
            None if self.asked.is_some() && !self.held => now_ms as f64,
            None => f64::INFINITY,
        }
    }

    fn trajectory(&self, _now_ms: u64) -> Trajectory {
        self.ride.clone().map_or(Trajectory::Rests, Trajectory::Rides)
    }

    fn position(&self) -> Option<Point> {
        Some(self.frame_now().position)
    }

    fn vehicle(&self) -> Option<&Driving> {
        Some(self)
    }
}
