//! Items on conveyors: what is in their way, and where they continue.
//!
//! Between two events every item goes at one speed, so that nothing is stepped through: the times of the events are
//! known, and each of them depends on the event before it alone, never on the scans in between.

mod ahead;
mod branch;
mod gap;
mod landing;
mod spot;
#[cfg(test)]
mod tests;
mod tracks;
mod transfer;

pub use gap::{Gap, gaps};
pub use transfer::{By, Transfer, transfers};

use super::working::Working;
use crate::carrier::Carrier;
use crate::item::Items;
use crate::line::Line;
use crate::part::lane::{Moving, Rider};
use crate::point::Point;
use spot::Spot;
use tracks::Track;

/// Places no farther apart are one, m; twice the rounding of the times at which they are reached.
const SAME: f64 = 2e-9;
/// Times no farther apart are one, ms.
const AT_ONCE: f64 = 1e-6;
/// Times in a scan at which items on conveyors pass from one to another, stop or continue.
const MOST_AT_ONCE: u32 = 100_000;

/// All lanes of a line.
#[derive(Clone, Debug)]
pub struct Conveying {
    tracks: Vec<Track>,
    /// Of each lane, when it was checked last.
    speeds: Vec<f64>,
    /// Events of items then, and whether any lay on others.
    loaded: (usize, bool),
    /// When something happens next if no output changes, ms from the start of the run.
    next_ms: f64,
}

/// An item that nothing bears any more.
#[derive(Clone, Copy, Debug)]
pub struct Falls {
    pub item: usize,
    pub from: Point,
    /// About the vertical, rad.
    pub turn: f64,
    /// When, from the start of the run.
    pub ms: f64,
}

/// The plant, as far as lanes have to do with it.
pub struct Among<'a> {
    pub machines: &'a mut [Working],
    pub items: &'a mut Items,
}

/// The same, to be looked at.
#[derive(Clone, Copy)]
pub struct View<'a> {
    pub machines: &'a [Working],
    pub items: &'a Items,
}

impl<'a> View<'a> {
    fn lane(self, track: &Track) -> &'a Moving {
        let lane = self.machines[track.machine].lane(track.part);
        lane.unwrap_or_else(|| unreachable!("a track is of a lane"))
    }
}

impl Among<'_> {
    fn view(&self) -> View<'_> {
        View { machines: self.machines, items: self.items }
    }

    fn lane(&self, track: &Track) -> &Moving {
        self.view().lane(track)
    }

    fn lane_mut(&mut self, track: &Track) -> &mut Moving {
        let lane = self.machines[track.machine].lane_mut(track.part);
        lane.unwrap_or_else(|| unreachable!("a track is of a lane"))
    }

    fn carrier(&self, item: usize) -> Carrier {
        self.items[item].carrier
    }
}

impl Conveying {
    pub fn new(line: &Line) -> Self {
        let tracks = tracks::tracks(line);
        Self { speeds: vec![f64::NAN; tracks.len()], tracks, loaded: (0, false), next_ms: f64::INFINITY }
    }

    /// Those that have lanes, once for each lane.
    pub fn machines(&self) -> impl Iterator<Item = usize> {
        self.tracks.iter().map(|track| track.machine)
    }

    /// Whether one of two lanes leads onto the other; each by the numbers of its machine and of its part.
    pub fn are_joined(&self, lanes: [(usize, usize); 2]) -> bool {
        let track = |lane| self.tracks.iter().position(|track| (track.machine, track.part) == lane);
        let [Some(a), Some(b)] = lanes.map(track) else { return false };
        self.tracks[a].leads_onto(b) || self.tracks[b].leads_onto(a)
    }

    /// When something happens next, ms; infinity: never.
    pub fn next_ms(&self) -> f64 {
        self.next_ms
    }

    /// The item on a lane onto which another one comes down, if its middle is there at a time, ms.
    pub fn lies_under(&self, among: &Among, item: usize, lands: &Carrier, ms: f64) -> Option<usize> {
        let Carrier::Lane { machine, part, at, across } = *lands else { return None };
        let track = self.tracks.iter().find(|track| (track.machine, track.part) == (machine, part))?;
        let lane = among.lane(track);
        let kind = |item: usize| among.items[item].kind;
        let place = at - lane.travel_at(ms);
        let borne = among.items.borne_by(machine).iter().copied();
        let mut others = borne.filter(|other| *other != item);
        others.find(|other| {
            let Carrier::Lane { part: of, across: beside, .. } = among.carrier(*other) else { return false };
            let Some(motion) = lane.motion(*other, &among.carrier(*other)).filter(|_| of == part) else {
                return false;
            };
            let meets = |halves: &[f64], apart: f64| {
                halves[kind(item)] + halves[kind(*other)] - apart.abs() > ahead::LIES_ON
            };
            meets(&track.halves, lane.place_at(motion, ms) - place)
                && meets(&track.half_widths, beside - across)
        })
    }

    /// Whether an item will appear even if no output changes.
    pub fn is_busy(&self, view: View, now_ms: u64) -> bool {
        let appears = |track| tracks::feed_ms(&self.tracks, track, view, now_ms as f64).is_finite();
        (0..self.tracks.len()).any(appears)
    }

    /// Takes note of drives, cylinders and items that have changed by the start of a scan.
    pub fn look(&mut self, among: &mut Among, now_ms: u64) -> Option<Falls> {
        // What lies on an item may be in the way of others.
        let loaded = (among.items.log().count(), among.items.has_loads());
        let before = std::mem::replace(&mut self.loaded, loaded);
        let mut has_changed = loaded.0 != before.0 && (loaded.1 || before.1);
        for (track, known) in self.tracks.iter_mut().zip(&mut self.speeds) {
            let lane = among.lane(track);
            let borne = among.items.borne_by(track.machine).iter();
            let borne = borne.filter(|item| among.carrier(**item).part() == Some(track.part)).count();
            has_changed |= *known != lane.speed() || lane.riders.len() != borne || !track.bears_riders(among);
            *known = lane.speed();
            let branches = track.branches.iter_mut().map(|branch| &mut branch.stops);
            for ends in branches.chain(&mut track.carried) {
                has_changed |= ends.look(&among.machines[track.machine], now_ms);
            }
            if let Some(feed) = &mut track.feed {
                has_changed |= feed.look(&among.machines[track.machine]);
            }
        }
        if has_changed { self.refresh(among, now_ms as f64) } else { None }
    }

    /// Everything that happens until a time, ms; the first item that falls by then, after which there may be more.
    /// More than [`MOST_AT_ONCE`] times until then end the run.
    pub fn proceed(&mut self, among: &mut Among, until_ms: u64) -> Option<Falls> {
        let mut times = 0;
        while self.next_ms <= until_ms as f64 + AT_ONCE {
            times += 1;
            if times > MOST_AT_ONCE {
                if let Some(track) = self.tracks.first() {
                    let reason = format!(
                        "items on the conveyors of the line go on at more than {MOST_AT_ONCE} times in a scan"
                    );
                    among.items.crash(track.machine, reason);
                }
                return None;
            }
            let falls = self.refresh(among, self.next_ms);
            if falls.is_some() {
                return falls;
            }
        }
        None
    }

    /// What happens at a time, and how all items go from then on.
    fn refresh(&mut self, among: &mut Among, ms: f64) -> Option<Falls> {
        for track in &self.tracks {
            track.adopt(among, ms);
            among.machines[track.machine].begin_phase();
        }
        tracks::join(&mut self.tracks, ms);
        let mut falls = None;
        while let Some((track, item, goes)) = self.goes_on(among, ms) {
            self.pass(among, ms, track, item, goes);
            if let Goes::Falls(from) = goes {
                falls = Some(Falls { item, from, turn: among.items.turn(item), ms });
                break;
            }
        }
        for track in 0..self.tracks.len() {
            tracks::appear(&mut self.tracks, track, among, ms);
        }
        let next_ms = ahead::move_on(&self.tracks, among, ms);
        // Where it lands is looked at next, at the same time.
        self.next_ms = if falls.is_some() { ms } else { next_ms.max(ms + AT_ONCE) };
        falls
    }

    /// The first item that leaves its lane at a time, and where it goes.
    fn goes_on(&self, among: &Among, ms: f64) -> Option<(usize, usize, Goes)> {
        for (index, track) in self.tracks.iter().enumerate() {
            let lane = among.lane(track);
            for rider in &lane.riders {
                let place = lane.place_at(rider.motion, ms);
                let goes = track.leaves(among, rider, place, ms).or_else(|| {
                    let taken = track.branches.iter().filter_map(|branch| branch.takes(rider, place, ms));
                    let mut free = taken.filter(|onto| self.has_room(among, *onto, rider, ms));
                    free.next().map(Goes::Aside)
                });
                if let Some(goes) = goes {
                    return Some((index, rider.item, goes));
                }
            }
        }
        None
    }

    /// At the beginning of a lane.
    fn has_room(&self, among: &Among, track: usize, rider: &Rider, ms: f64) -> bool {
        Spot::at_beginning(&self.tracks, among, track, rider).free_ms(&self.tracks, among.view(), ms) <= ms
    }

    fn pass(&self, among: &mut Among, ms: f64, from: usize, item: usize, goes: Goes) {
        let centre_line = self.tracks[from].centre_line(among, ms);
        let lane = among.lane_mut(&self.tracks[from]);
        let index = lane.riders.iter().position(|rider| rider.item == item);
        let Some(rider) = index.map(|index| lane.riders.remove(index)) else { return };
        let place = lane.place_at(rider.motion, ms);
        if centre_line.turns_items() {
            among.items.set_turn(item, centre_line.frame(place).yaw.to_radians());
        }
        match goes {
            Goes::Collected { sink } => {
                let Carrier::Lane { across, .. } = among.carrier(item) else { return };
                let machine = self.tracks[from].machine;
                let carrier = Carrier::Sink { machine, part: sink };
                among.items.pass(item, carrier, centre_line.point(place, across));
            }
            Goes::Onto(onto) | Goes::Aside(onto) => {
                let track = &self.tracks[onto];
                let centre_line = track.centre_line(among, ms);
                let lane = among.lane_mut(track);
                let at = centre_line.begin() + lane.travel_at(ms);
                let half = track.halves[among.items[item].kind];
                let from = matches!(goes, Goes::Onto(_)).then_some(from);
                let rider = Rider { from, ..Rider::new(item, half, at) };
                among.lane_mut(track).riders.push(rider);
                let carrier = Carrier::Lane { machine: track.machine, part: track.part, at, across: 0.0 };
                among.items.pass(item, carrier, centre_line.point(centre_line.begin(), 0.0));
            }
            Goes::Falls(_) => {}
        }
    }
}

/// Where an item goes that leaves its lane.
#[derive(Clone, Copy, Debug)]
enum Goes {
    /// Off the line, by a part of the machine.
    Collected {
        sink: usize,
    },
    /// Over a joint; the number of a lane, at its beginning.
    Onto(usize),
    /// By a diverter or a pusher, to there.
    Aside(usize),
    Falls(Point),
}
