//! What is in the way of items, and how fast they go behind it.

use super::spot::Spot;
use super::tracks::{self, Track};
use super::{AT_ONCE, Among, SAME};
use crate::item::block::Block;
use crate::part::lane::{Motion, Moving};

/// One that is farther in another one than this lies on it, m.
pub const LIES_ON: f64 = 1e-4;

/// An item on a lane, as it goes from a time on.
struct Entry {
    track: usize,
    rider: usize,
    place: f64,
    half: f64,
    /// Of the surface, m/s.
    surface: f64,
    speed: f64,
    /// What is in its way: behind what is near and goes may be something that stands.
    limits: Vec<Limit>,
}

/// Where the middle of an item stops, and the entry that moves this place, if one does.
#[derive(Clone, Copy)]
struct Limit {
    place: f64,
    behind: Option<usize>,
}

/// Sets how all items go from a time on; when something happens next, ms.
pub fn move_on(tracks: &[Track], among: &mut Among, ms: f64) -> f64 {
    let mut entries = entries(tracks, among, ms);
    let loaded = Loaded::of(tracks, among, &entries);
    let limits = |at| limits(tracks, among, &entries, loaded.as_ref(), at, ms);
    let all: Vec<Vec<Limit>> = (0..entries.len()).map(limits).collect();
    for (entry, limits) in entries.iter_mut().zip(all) {
        entry.limits = limits;
    }
    slow_down(&mut entries);
    for entry in &entries {
        let stands = |limit: &&Limit| limit.behind.is_none_or(|other| entries[other].speed == 0.0);
        let standing = entry.limits.iter().filter(stands).map(|limit| limit.place);
        set(tracks, among, entry, standing.fold(f64::NEG_INFINITY, f64::max), ms);
    }
    next_ms(tracks, among, &entries, ms)
}

fn entries(tracks: &[Track], among: &Among, ms: f64) -> Vec<Entry> {
    let mut entries = Vec::new();
    for (track, of) in tracks.iter().enumerate() {
        let lane = among.lane(of);
        for (rider, on) in lane.riders.iter().enumerate() {
            let surface = lane.speed();
            entries.push(Entry {
                track,
                rider,
                place: lane.place_at(on.motion, ms),
                half: on.half,
                surface,
                speed: surface,
                limits: Vec::new(),
            });
        }
    }
    entries
}

/// All that is in the way of an item.
fn limits(
    tracks: &[Track],
    among: &Among,
    entries: &[Entry],
    loaded: Option<&Loaded>,
    at: usize,
    ms: f64,
) -> Vec<Limit> {
    let entry = &entries[at];
    let track = &tracks[entry.track];
    let rider = &among.lane(track).riders[entry.rider];
    let stops = track.branches.iter().filter_map(|branch| branch.stops(rider, entry.place, ms));
    let mut limits: Vec<Limit> = stops.map(|place| Limit { place, behind: None }).collect();
    let ahead = entries[..at].iter().enumerate().rev().take_while(|(_, other)| other.track == entry.track);
    // What lies on another one does not stop behind it.
    limits.extend(
        ahead
            .map(|(other, of)| Limit { place: of.place + of.half + entry.half, behind: Some(other) })
            .find(|limit| limit.place <= entry.place + LIES_ON),
    );
    limits.extend(loaded.iter().flat_map(|loaded| loaded.limits(tracks, among, entries, at)));
    if let Some(onto) = track.onto.filter(|_| entry.rider == 0 && track.sink.is_none()) {
        limits.extend(beyond_end(tracks, among, entries, at, onto));
    }
    limits
}

/// What items on lanes take up with all that lies on them.
struct Loaded {
    /// Of each entry, itself first.
    blocks: Vec<Vec<Block>>,
    /// How far any of them reaches behind the middle of its item.
    reach_back: f64,
}

impl Loaded {
    /// None if nothing lies on any item.
    fn of(tracks: &[Track], among: &Among, entries: &[Entry]) -> Option<Self> {
        if !among.items.has_loads() {
            return None;
        }
        let blocks = |entry: &Entry| {
            let lane = among.lane(&tracks[entry.track]);
            lane.blocks_on(lane.riders[entry.rider].item, among.items)
        };
        let blocks: Vec<Vec<Block>> = entries.iter().map(blocks).collect();
        let reach_back = blocks.iter().flatten().map(Block::reach_back).fold(0.0, f64::max);
        Some(Self { blocks, reach_back })
    }

    /// Where an item stops because something that lies on it, or on one ahead on its lane or on the next one, may reach
    /// beyond that.
    fn limits(&self, tracks: &[Track], among: &Among, entries: &[Entry], at: usize) -> Vec<Limit> {
        let entry = &entries[at];
        let (track, own) = (&tracks[entry.track], &self.blocks[at]);
        let here = (0..at).rev().take_while(|other| entries[*other].track == entry.track);
        let here = here.map(|other| (other, entries[other].place));
        let onto = track.onto.filter(|_| track.sink.is_none());
        let beyond = onto.into_iter().flat_map(|onto| {
            let [end, begin] = [entry.track, onto].map(|track| among.lane(&tracks[track]).lane().centre_line);
            let offset = end.end() - begin.begin();
            let there = (0..entries.len()).rev().filter(move |other| entries[*other].track == onto);
            there.map(move |other| (other, entries[other].place + offset))
        });
        let reach = own.iter().map(Block::reach_ahead).fold(0.0, f64::max) + self.reach_back;
        let mut limits = Vec::new();
        // All that is between the two keeps them apart.
        let mut between = entry.half;
        for (other, place) in here.chain(beyond) {
            if reach <= between {
                break;
            }
            between += 2.0 * entries[other].half;
            let place = apart_by_loads(&self.blocks[other], own).map(|apart| place + apart);
            let place = place.filter(|place| *place <= entry.place + LIES_ON);
            limits.extend(place.map(|place| Limit { place, behind: Some(other) }));
        }
        limits
    }
}

/// How far the middles of two items are apart if something on one of them touches the other one or something on that, m; the
/// items themselves come first.
fn apart_by_loads(ahead: &[Block], behind: &[Block]) -> Option<f64> {
    let pairs = ahead.iter().enumerate().flat_map(|(i, ahead)| {
        behind.iter().enumerate().filter(move |(j, _)| i + j > 0).map(move |(_, behind)| (ahead, behind))
    });
    let pairs = pairs.filter(|(ahead, behind)| ahead.is_across_from(behind));
    pairs.map(|(ahead, behind)| behind.reach_ahead() + ahead.reach_back()).reduce(f64::max)
}

/// What is in the way of the first item of a lane on the lane after it, or beside it on another one that leads there.
fn beyond_end(tracks: &[Track], among: &Among, entries: &[Entry], at: usize, onto: usize) -> Vec<Limit> {
    let entry = &entries[at];
    let end = among.lane(&tracks[entry.track]).lane().centre_line.end();
    let begin = among.lane(&tracks[onto]).lane().centre_line.begin();
    let last = entries.iter().enumerate().rev().find(|(_, other)| other.track == onto);
    let last = last.map(|(number, last)| {
        let rear = last.place + last.half;
        // On its way over from another lane it is in nobody's way before the joint.
        let comes_along = among.lane(&tracks[onto]).riders[last.rider].from == Some(entry.track);
        if comes_along || rear <= begin + SAME {
            Limit { place: end + rear - begin + entry.half, behind: Some(number) }
        } else {
            Limit { place: end + entry.half, behind: None }
        }
    });
    // One at a time goes from several lanes onto one.
    let inputs = tracks[onto].inputs.iter().filter(|input| **input != entry.track);
    let others = inputs.filter_map(|input| {
        let other = entries.iter().find(|other| other.track == *input)?;
        let over = among.lane(&tracks[*input]).lane().centre_line.end() - (other.place - other.half);
        let own_over = end - (entry.place - entry.half);
        let goes_first = over > SAME || over > -SAME && (own_over < -SAME || *input < entry.track);
        (goes_first && own_over <= SAME).then_some(Limit { place: end + entry.half, behind: None })
    });
    let last = last.filter(|limit| limit.place <= entry.place + LIES_ON || limit.behind.is_none());
    others.chain(last).collect()
}

/// Whoever is right behind another item goes no faster than that.
fn slow_down(entries: &mut [Entry]) {
    let mut is_settled = false;
    while !is_settled {
        is_settled = true;
        for at in 0..entries.len() {
            let touching = entries[at].touching();
            let speeds = touching.map(|limit| limit.behind.map_or(0.0, |other| entries[other].speed));
            let most = speeds.fold(f64::INFINITY, f64::min);
            if entries[at].speed > most {
                entries[at].speed = most;
                is_settled = false;
            }
        }
    }
}

impl Entry {
    /// What it has come up to.
    fn touching(&self) -> impl Iterator<Item = &Limit> {
        self.limits.iter().filter(|limit| self.place <= limit.place + SAME)
    }
}

fn set(tracks: &[Track], among: &mut Among, entry: &Entry, stops_at: f64, ms: f64) {
    let lane = among.lane_mut(&tracks[entry.track]);
    let old = lane.riders[entry.rider].motion;
    let place = entry.touching().fold(entry.place, |place, limit| place.min(limit.place));
    let motion = if entry.speed == entry.surface {
        match old {
            Motion::Goes { .. } => old,
            Motion::Stands { .. } | Motion::Follows { .. } => Motion::Goes { at: place + lane.travel_at(ms) },
        }
    } else if entry.speed == 0.0 {
        match old {
            Motion::Stands { .. } => old,
            Motion::Goes { .. } | Motion::Follows { .. } => Motion::Stands { place },
        }
    } else {
        match old {
            Motion::Follows { speed, .. } if speed == entry.speed => old,
            _ => Motion::Follows { place, since_ms: ms, speed: entry.speed },
        }
    };
    let rider = &mut lane.riders[entry.rider];
    (rider.motion, rider.stops_at) = (motion, stops_at);
}

/// When one comes to what is in its way, to a diverter or to the end, a cylinder comes to its end, or an item appears.
fn next_ms(tracks: &[Track], among: &Among, entries: &[Entry], ms: f64) -> f64 {
    let mut next = f64::INFINITY;
    for entry in entries {
        let track = &tracks[entry.track];
        let lane = among.lane(track);
        let rider = &lane.riders[entry.rider];
        let mut comes_to = |place: f64| {
            // What is there now has been looked at.
            if place < entry.place - SAME {
                next = next.min(lane.comes_to(rider.motion, place, ms));
            }
        };
        comes_to(track.sink.map_or(lane.lane().centre_line.end(), |sink| sink.place));
        track.branches.iter().filter_map(|branch| branch.awaits(rider)).for_each(&mut comes_to);
        // One that waits at the joint for this one, which has not come over it.
        if tracks[entry.track].inputs.iter().any(|input| rider.from != Some(*input)) {
            comes_to(lane.lane().centre_line.begin() - rider.half);
        }
        if track.onto.is_some_and(|onto| tracks[onto].inputs.len() > 1) {
            comes_to(lane.lane().centre_line.end() + rider.half);
        }
        for onto in track.branches.iter().filter_map(|branch| branch.takes(rider, entry.place, ms)) {
            next = next.min(Spot::at_beginning(tracks, among, onto, rider).free_ms(tracks, among.view(), ms));
        }
        for limit in &entry.limits {
            next = next.min(meets(entry, *limit, entries, lane, ms));
        }
    }
    let others = tracks.iter().enumerate().map(|(index, track)| {
        let carriages = track.branches.iter().map(|branch| &branch.stops).chain(&track.carried);
        let branches = carriages.map(|stops| stops.next_ms(ms));
        let feed = tracks::feed_ms(tracks, index, among.view(), ms);
        branches.fold(if feed > ms + AT_ONCE { feed } else { f64::INFINITY }, f64::min)
    });
    others.fold(next, f64::min)
}

/// When an item meets what is in its way, ms.
fn meets(entry: &Entry, limit: Limit, entries: &[Entry], lane: &Moving, ms: f64) -> f64 {
    if entry.place <= limit.place + SAME {
        return f64::INFINITY;
    }
    match limit.behind.map(|other| entries[other].speed) {
        None | Some(0.0) => lane.comes_to(lane.riders[entry.rider].motion, limit.place, ms),
        Some(speed) if speed < entry.speed => {
            ms + 1000.0 * (entry.place - limit.place) / (entry.speed - speed)
        }
        Some(_) => f64::INFINITY,
    }
}
