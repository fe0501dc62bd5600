//! The lanes of a line: what stands at each, and where they lead.

use super::super::working::Working;
use super::branch::{Branch, Kind, Stops};
use super::spot::Spot;
use super::{AT_ONCE, Among, Goes, SAME, View};
use crate::carrier::Carrier;
use crate::line::Line;
use crate::machine::Machine;
use crate::part::Primitive;
use crate::part::lane::{CentreLine, Lane, Rider};
use crate::part::source::{self, Spawn};

/// A lane with all that stands at it. Places are those of its centre line.
#[derive(Clone, Debug)]
pub struct Track {
    pub machine: usize,
    pub part: usize,
    /// Where the middles of items leave the line.
    pub sink: Option<Leaves>,
    pub feed: Option<Feed>,
    pub branches: Vec<Branch>,
    /// Where its cylinder or its positioner is, if it is on one.
    pub carried: Option<Stops>,
    /// The lanes that begin where this one ends, at a stop of what carries either.
    joints: Vec<Joint>,
    /// The one that does so now.
    pub onto: Option<usize>,
    /// The lanes that end where this one begins now, in their order.
    pub inputs: Vec<usize>,
    /// Half of the length of an item of each kind, along the lane, m.
    pub halves: Vec<f64>,
    /// Half of its width, across the lane, m.
    pub half_widths: Vec<f64>,
}

impl Track {
    /// Whether that one begins where this one ends, at some stop of what carries them.
    pub fn leads_onto(&self, other: usize) -> bool {
        self.joints.iter().any(|joint| joint.onto == other)
    }

    /// Whether nothing ever falls at its end.
    pub fn is_always_joined(&self) -> bool {
        self.joints.iter().any(|joint| joint.when == [None, None])
    }
}

/// A lane that begins where another one ends.
#[derive(Clone, Copy, Debug)]
struct Joint {
    onto: usize,
    /// The stop at which the first lane is then, and that of the second.
    when: [Option<usize>; 2],
}

/// A sink: its part of the machine, and the place of the middles of items that leave.
#[derive(Clone, Copy, Debug)]
pub struct Leaves {
    part: usize,
    pub place: f64,
}

/// Where items appear.
#[derive(Clone, Debug)]
pub struct Feed {
    /// Of the machine.
    part: usize,
    place: f64,
    /// How many items were asked for, if somebody asks for each.
    asked: Option<u64>,
    spawn: Spawn,
    /// Items that are still to appear, last one first.
    supply: Vec<usize>,
    spawned: u64,
}

impl Feed {
    /// Takes note of how many items were asked for; whether that has changed.
    pub fn look(&mut self, machine: &Working) -> bool {
        let asked = machine.asked(self.part);
        std::mem::replace(&mut self.asked, asked) != asked
    }
}

/// Lanes of which one begins where the other one ends: m and degrees.
pub const JOINED: f64 = 0.005;
pub const ALIGNED: f64 = 1.0;

/// All lanes of all machines.
pub fn tracks(line: &Line) -> Vec<Track> {
    let lanes = || {
        line.machines.iter().enumerate().flat_map(|(number, machine)| {
            let parts = machine.parts.iter().enumerate();
            parts.filter_map(move |(part, of)| match &of.primitive {
                Primitive::Lane(lane) => Some((number, part, lane)),
                _ => None,
            })
        })
    };
    let places: Vec<(usize, usize)> = lanes().map(|(machine, part, _)| (machine, part)).collect();
    let centre_lines: Vec<Vec<(Option<usize>, CentreLine)>> =
        lanes().map(|(machine, _, lane)| line.machines[machine].centre_lines(lane)).collect();
    let number = |machine: usize, part: usize| places.iter().position(|place| *place == (machine, part));
    let track = |(index, (machine, part, lane)): (usize, (usize, usize, &Lane))| Track {
        machine,
        part,
        sink: sink(&line.machines[machine], part, lane),
        feed: feed(line, machine, part, lane),
        branches: branches(&line.machines[machine], part, lane, &|onto| number(machine, onto)),
        carried: lane.on.map(|part| Stops::of(&line.machines[machine], part)),
        joints: joints(&centre_lines, index),
        onto: None,
        inputs: Vec::new(),
        halves: line.kinds.iter().map(|kind| lane.lengths_of(kind.size)[0] / 2.0).collect(),
        half_widths: line.kinds.iter().map(|kind| lane.lengths_of(kind.size)[1] / 2.0).collect(),
    };
    lanes().enumerate().map(track).collect()
}

/// The lanes on which a lane continues.
fn joints(centre_lines: &[Vec<(Option<usize>, CentreLine)>], index: usize) -> Vec<Joint> {
    let mut joints = Vec::new();
    for (own, from) in &centre_lines[index] {
        for (onto, others) in centre_lines.iter().enumerate().filter(|(onto, _)| *onto != index) {
            let joined = others.iter().filter(|(_, to)| joins(from, to));
            joints.extend(joined.map(|(other, _)| Joint { onto, when: [*own, *other] }));
        }
    }
    joints
}

/// Settles which lane continues as which one at a time.
pub fn join(tracks: &mut [Track], ms: f64) {
    let is_at = |track: &Track, stop: Option<usize>| {
        stop.is_none_or(|stop| track.carried.as_ref().is_some_and(|stops| stops.is_at(stop, ms)))
    };
    let onto: Vec<Option<usize>> = tracks
        .iter()
        .map(|track| {
            let holds =
                |joint: &&Joint| is_at(track, joint.when[0]) && is_at(&tracks[joint.onto], joint.when[1]);
            track.joints.iter().find(holds).map(|joint| joint.onto)
        })
        .collect();
    for (index, track) in tracks.iter_mut().enumerate() {
        track.onto = onto[index];
        track.inputs = (0..onto.len()).filter(|other| onto[*other] == Some(index)).collect();
    }
}

/// Whether a lane continues as another one.
pub fn joins(from: &CentreLine, to: &CentreLine) -> bool {
    let [off, turn] = apart(from, to);
    off <= JOINED && turn <= ALIGNED
}

/// How far the end of one is from the beginning of the other, m, and how much they are turned, degrees.
pub fn apart(from: &CentreLine, to: &CentreLine) -> [f64; 2] {
    let (end, begin) = (from.frame(from.end()), to.frame(to.begin()));
    let turn = crate::frame::whole_turn(end.yaw - begin.yaw);
    [(end.position - begin.position).length(), turn.abs()]
}

fn sink(machine: &Machine, lane_part: usize, lane: &Lane) -> Option<Leaves> {
    machine.parts.iter().enumerate().find_map(|(part, other)| match &other.primitive {
        Primitive::Sink(sink) if sink.lane == lane_part => {
            Some(Leaves { part, place: lane.centre_line.end() + sink.inset })
        }
        _ => None,
    })
}

fn feed(line: &Line, machine: usize, lane_part: usize, lane: &Lane) -> Option<Feed> {
    line.machines[machine].parts.iter().enumerate().find_map(|(part, other)| match &other.primitive {
        Primitive::Source(source) if source.lane == lane_part => {
            let mut supply = source::supply(line, machine);
            supply.reverse();
            let place = lane.centre_line.begin() - source.inset;
            let spawn = Spawn::new(&line.scenario);
            Some(Feed { part, place, asked: None, spawn, supply, spawned: 0 })
        }
        _ => None,
    })
}

fn branches(
    machine: &Machine,
    part: usize,
    lane: &Lane,
    number: &dyn Fn(usize) -> Option<usize>,
) -> Vec<Branch> {
    let begin = lane.centre_line.begin();
    let parts = machine.parts.iter().enumerate().filter_map(|(other, of)| {
        let (kind, at, cylinder) = match &of.primitive {
            Primitive::Stopper(stopper) if stopper.lane == part => {
                (Kind::Stopper, stopper.at, stopper.cylinder)
            }
            Primitive::Diverter(diverter) if diverter.lane == part => {
                (Kind::Diverter { onto: number(diverter.onto)? }, diverter.at, diverter.cylinder)
            }
            Primitive::Pusher(pusher) if pusher.lane == part => {
                let (onto, half) = (number(pusher.onto)?, pusher.width / 2.0);
                (Kind::Pusher { onto, half }, pusher.at, pusher.cylinder)
            }
            _ => return None,
        };
        Some(Branch { part: other, kind, place: begin - at, stops: Stops::of(machine, cylinder) })
    });
    parts.collect()
}

impl Track {
    /// Makes riders of exactly the items that its lane bears, the foremost first.
    pub fn adopt(&self, among: &mut Among, ms: f64) {
        let borne = among.items.borne_by(self.machine).iter().copied();
        let borne: Vec<usize> = borne.filter(|item| among.carrier(*item).part() == Some(self.part)).collect();
        let come: Vec<Rider> = {
            let known = &among.lane(self).riders;
            let new = borne.iter().filter(|item| known.iter().all(|rider| rider.item != **item));
            new.filter_map(|item| {
                let Carrier::Lane { at, .. } = among.carrier(*item) else { return None };
                let half = self.halves[among.items[*item].kind];
                Some(Rider::new(*item, half, at))
            })
            .collect()
        };
        let lane = among.lane_mut(self);
        lane.riders.retain(|rider| borne.contains(&rider.item));
        lane.riders.extend(come);
        let mut riders = std::mem::take(&mut lane.riders);
        riders.sort_by(|a, b| lane.place_at(a.motion, ms).total_cmp(&lane.place_at(b.motion, ms)));
        lane.riders = riders;
    }

    /// Whether all riders are still on the lane.
    pub fn bears_riders(&self, among: &Among) -> bool {
        let is_here = |rider: &Rider| {
            let carrier = among.carrier(rider.item);
            carrier.machine() == Some(self.machine) && carrier.part() == Some(self.part)
        };
        among.lane(self).riders.iter().all(is_here)
    }

    /// Where the lane is at a time.
    pub fn centre_line(&self, among: &Among, ms: f64) -> CentreLine {
        let centre_line = among.lane(self).lane().centre_line;
        let carried = self.carried.as_ref();
        let carriage = carried.and_then(|stops| among.machines[self.machine].carriage(stops.part));
        carriage.map_or(centre_line, |carriage| centre_line.moved(carriage.frame(ms)))
    }

    /// Where an item goes that has come to the end of the lane.
    pub fn leaves(&self, among: &Among, rider: &Rider, place: f64, ms: f64) -> Option<Goes> {
        let centre_line = among.lane(self).lane().centre_line;
        let end = self.sink.map_or(centre_line.end(), |sink| sink.place);
        if place > end + SAME {
            return None;
        }
        Some(match (self.sink, self.onto) {
            (Some(sink), _) => Goes::Collected { sink: sink.part },
            (None, Some(onto)) => Goes::Onto(onto),
            (None, None) => {
                let centre_line = self.centre_line(among, ms);
                Goes::Falls(centre_line.point(centre_line.end() - rider.half, 0.0))
            }
        })
    }
}

/// Items appear on a lane whose time has come, as soon as there is room.
pub fn appear(tracks: &mut [Track], index: usize, among: &mut Among, ms: f64) {
    while feed_ms(tracks, index, among.view(), ms) <= ms + AT_ONCE {
        let track = &mut tracks[index];
        let lane = among.lane(track);
        let (centre_line, machine, part) = (lane.lane().centre_line, track.machine, track.part);
        let Some(feed) = &mut track.feed else { return };
        let Some(item) = feed.supply.pop() else { return };
        let due_ms = feed.spawn.at_ms(feed.spawned) as f64;
        let is_late = feed.asked.is_some() || lane.travel_ms_at(ms) > due_ms + AT_ONCE;
        let travel = if is_late { lane.travel_at(ms) } else { lane.travel_after(due_ms) };
        feed.spawned += 1;
        let at = feed.place + travel;
        let point = centre_line.point(at - lane.travel_at(ms), 0.0);
        among.items.pass(item, Carrier::Lane { machine, part, at, across: 0.0 }, point);
        track.adopt(among, ms);
    }
}

/// When the next item appears on a lane, if all continues as it does, ms; infinity: never.
pub fn feed_ms(tracks: &[Track], index: usize, view: View, ms: f64) -> f64 {
    let track = &tracks[index];
    let Some(feed) = &track.feed else { return f64::INFINITY };
    let Some(next) = feed.supply.last() else { return f64::INFINITY };
    let lane = view.lane(track);
    let is_asked_for = feed.asked.is_some_and(|asked| asked > feed.spawned);
    if !is_asked_for && (feed.asked.is_some() || !lane.is_moving()) {
        return f64::INFINITY;
    }
    let due_ms = match feed.asked {
        Some(_) => ms,
        None => ms + (feed.spawn.at_ms(feed.spawned) as f64 - lane.travel_ms_at(ms)).max(0.0),
    };
    if due_ms > ms + AT_ONCE {
        return due_ms;
    }
    let half = track.halves[view.items[*next].kind];
    let spot = Spot { track: index, place: feed.place, item: *next, half };
    spot.free_ms(tracks, view, ms).max(due_ms)
}
