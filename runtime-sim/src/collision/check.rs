//! The collision check of a run.
//!
//! Of each pair of machines it is looked up once, for the motions of both, how long they stay apart: by boxes, by what
//! is remembered of a motion beside something that rests or of two motions with the time between them, or by conservative
//! advancement. This holds until one of the two moves in another way or bears something else; until then neither is
//! looked at, nor where it is. Conservative advancement: at a time the distance of two bodies says how far they may go
//! before they can meet at the earliest, so how much later it is looked at again. So nothing is stepped over, however thin.
//! What comes so near that it could be in contact is checked scan by scan.

use super::TOLERANCE;
use super::group::{Anchor, Group, Kind, Outer};
use super::load;
use super::pair::{AT_ONCE, Known, Pair, Span, Touch};
use crate::carrier::Carrier;
use crate::event::Event;
use crate::fingerprint::Fingerprint;
use crate::item::{self, Names};
use crate::kinematics::facing::Facing;
use crate::kinematics::pose::Pose;
use crate::line::Line;
use crate::memory::Memory;
use crate::part::place::OPPOSITE;
use crate::plant::Plant;
use crate::point::Point;
use std::collections::BTreeMap;

/// That two came into contact.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// Of the first time, from the start of the run.
    pub time_s: f64,
    /// Where, between the two.
    pub place: Point,
    /// Names of machines or obstacles.
    pub pair: [String; 2],
    /// What of each: a solid, or an item.
    pub parts: [String; 2],
    /// The layout allows the pair.
    pub allowed: bool,
    /// How often the two came into contact.
    pub count: u32,
}

/// What is known of all that could come into contact.
#[derive(Clone, Debug)]
pub struct CollisionCheck {
    groups: Vec<Group>,
    /// Of the movements of the groups; none before the first look.
    versions: Vec<Option<u64>>,
    /// What has contained each group so far.
    reaches: Vec<Outer>,
    pairs: Vec<Pair>,
    /// Of each group the numbers of its pairs.
    pairs_of: Vec<Vec<usize>>,
    /// Pairs of which it is not known that they never meet as they go on: all others need not be looked at.
    due: Vec<usize>,
    /// The earliest end of what is known of them, seconds from the start of the run.
    known_until: f64,
    /// Items that have appeared, without those that are gone for good.
    items: BTreeMap<usize, Tracked>,
    names: Names,
    /// Events that were handled.
    read: usize,
    contacts: Vec<Contact>,
    /// A pair is in contact.
    touches: bool,
    seconds: f64,
}

/// An item: how large it is, how it is turned, and where it is among the bodies.
#[derive(Clone, Debug)]
struct Tracked {
    dimensions: item::Dimensions,
    /// About the vertical, since it appeared; while it hangs, that of the moment it was gripped.
    turn: f64,
    /// In the world, as it hung or lies, if its upper side does not face up.
    tipped: Pose,
    place: Option<(usize, usize)>,
    /// From the frame of the last link to the item's underside, while it hangs; from that of a vehicle on a track, while it
    /// lies there.
    hang: Pose,
}

impl Tracked {
    fn new(dimensions: item::Dimensions) -> Self {
        Self { dimensions, turn: 0.0, tipped: Pose::IDENTITY, place: None, hang: Pose::IDENTITY }
    }
}

impl CollisionCheck {
    pub fn new(line: &Line) -> Self {
        let machines = (0..line.machines.len()).map(|index| Group::of_machine(line, index));
        let groups: Vec<Group> = machines.chain(line.obstacles.iter().map(Group::of_obstacle)).collect();
        let mut pairs = Vec::new();
        for (a, first) in groups.iter().enumerate() {
            for (b, second) in groups.iter().enumerate().skip(a) {
                if first.can_meet(second, a == b) {
                    pairs.push(Pair::new([a, b], line.allows([&first.name, &second.name])));
                }
            }
        }
        let pairs_of = |group: usize| {
            let all = pairs.iter().enumerate();
            all.filter(|(_, pair)| pair.groups.contains(&group)).map(|(number, _)| number).collect()
        };
        Self {
            items: BTreeMap::new(),
            names: Names::new(line),
            versions: vec![None; groups.len()],
            reaches: vec![Outer::NOTHING; groups.len()],
            pairs_of: (0..groups.len()).map(pairs_of).collect(),
            due: Vec::new(),
            groups,
            pairs,
            known_until: f64::NEG_INFINITY,
            read: 0,
            contacts: Vec::new(),
            touches: false,
            seconds: f64::from(line.scan_ms) / 1000.0,
        }
    }

    /// All pairs that came into contact, in the order of their first times.
    pub fn into_contacts(self) -> Vec<Contact> {
        self.contacts
    }

    /// Whether something is in contact: then every scan has to be checked.
    pub(crate) fn touches(&self) -> bool {
        self.touches
    }

    /// Looks ahead from the scan that begins, when the plant has obeyed its outputs and nothing has moved yet, to the
    /// start of the scan `next`, before which no motion changes. The scan to which it is known, and in it the first
    /// contact that the layout does not allow: what comes into contact is checked scan by scan.
    pub(crate) fn look_until(
        &mut self,
        plant: &Plant,
        memory: &mut Memory,
        scan: u64,
        next: u64,
    ) -> (u64, Option<&Contact>) {
        self.follow_items(plant);
        if self.touches() {
            for group in &mut self.groups {
                group.count_path(plant);
                group.catch_up(plant);
            }
        }
        let changed = self.follow_groups(plant, memory);
        let now = plant.now_ms() as f64 / 1000.0;
        if !changed && self.known_until - now >= self.seconds * (next - scan) as f64 + AT_ONCE {
            return (next, None);
        }
        self.due.sort_unstable();
        self.due.dedup();
        let due = std::mem::take(&mut self.due);
        let mut next = next;
        let mut near = Vec::new();
        for &index in &due {
            // What comes into contact at the very end is found in this span, however it is rounded.
            let end = self.seconds * (next - scan) as f64 + AT_ONCE;
            let pair = &mut self.pairs[index];
            let versions = pair.groups.map(|group| self.groups[group].version());
            if pair.touches() {
                if pair.known.versions != versions {
                    pair.known = Known { versions, until: f64::NEG_INFINITY };
                    pair.forget_paths();
                }
                near.push(index);
                continue;
            }
            if pair.known.versions == versions && pair.known.until - now >= end {
                continue;
            }
            let clear = pair.clear_for(&mut self.groups, index, plant, memory, end);
            pair.known = Known { versions, until: now + clear };
            if clear < end {
                // One scan less: the time is rounded.
                let before = (clear / self.seconds) as u64;
                next = next.min(scan + before.saturating_sub(1).max(1));
            }
            if clear < 2.0 * self.seconds {
                near.push(index);
            }
        }
        self.know(due);
        if next > scan + 1 {
            return (next, None);
        }
        let found = self.search(near, plant);
        self.touches = self.pairs.iter().any(Pair::touches);
        (next, self.note_all(found, plant))
    }

    /// How groups continue; whether one does not go on as it did. Those of its pairs are due whose reaches meet.
    fn follow_groups(&mut self, plant: &Plant, memory: &mut Memory) -> bool {
        let mut changed = false;
        for (number, group) in self.groups.iter_mut().enumerate() {
            group.follow(plant);
            let version = Some(group.version());
            if std::mem::replace(&mut self.versions[number], version) == version {
                continue;
            }
            changed = true;
            self.reaches[number] = self.reaches[number].with(&group.outer(plant, memory));
            let reaches = &self.reaches;
            let may_meet = |[a, b]: [usize; 2]| a == b || !reaches[a].is_apart(&reaches[b]);
            let pairs = self.pairs_of[number].iter().filter(|pair| may_meet(self.pairs[**pair].groups));
            self.due.extend(pairs);
        }
        changed
    }

    /// These have been looked at: those that may meet as they go on are due again.
    fn know(&mut self, mut looked_at: Vec<usize>) {
        let until = |pair: &Pair| if pair.touches() { f64::NEG_INFINITY } else { pair.known.until };
        looked_at.retain(|index| until(&self.pairs[*index]) < f64::INFINITY);
        let all = looked_at.iter().map(|index| until(&self.pairs[*index]));
        self.known_until = all.fold(f64::INFINITY, f64::min);
        self.due = looked_at;
    }

    /// Which of these pairs come into contact in the scan that begins, by time.
    fn search(&mut self, near: Vec<usize>, plant: &Plant) -> Vec<(usize, Touch)> {
        let mut found = Vec::new();
        for index in near {
            let mut span = Span {
                groups: &mut self.groups,
                plant,
                from: 0.0,
                to: self.seconds,
                contact: TOLERANCE,
                apart: TOLERANCE,
                swept: None,
            };
            if let Some(touch) = self.pairs[index].look(&mut span) {
                found.push((index, touch));
            }
        }
        found.sort_by(|(_, a), (_, b)| a.time.total_cmp(&b.time));
        found
    }

    fn note_all(&mut self, found: Vec<(usize, Touch)>, plant: &Plant) -> Option<&Contact> {
        let known = self.contacts.len();
        for (index, touch) in found {
            self.note(index, touch, plant);
        }
        self.contacts[known..].iter().find(|contact| !contact.allowed)
    }

    fn note(&mut self, index: usize, touch: Touch, plant: &Plant) {
        let pair = &mut self.pairs[index];
        if let Some(contact) = pair.contact {
            self.contacts[contact].count += 1;
            return;
        }
        pair.contact = Some(self.contacts.len());
        self.contacts.push(Contact {
            time_s: plant.now_ms() as f64 / 1000.0 + touch.time,
            place: touch.place,
            pair: pair.groups.map(|group| self.groups[group].name.clone()),
            parts: touch.parts,
            allowed: pair.allowed,
            count: 1,
        });
    }

    /// Where items have come to since the last time, and what they have become.
    pub(crate) fn follow_items(&mut self, plant: &Plant) {
        let log = plant.items().log();
        for event in log.since(self.read) {
            match *event {
                Event::Item { item, from, to, .. } => {
                    self.leave(item, plant);
                    // What was passed on since is followed with its own event.
                    if plant.items()[item].carrier == to {
                        if from.item().is_some() {
                            self.track(item, plant).turn = plant.turn(item);
                        }
                        self.come(item, to, plant);
                    }
                    if to.is_gone() {
                        self.items.remove(&item);
                    }
                    for under in [from, to].into_iter().filter_map(|carrier| carrier.item()) {
                        self.load(under, plant);
                    }
                }
                Event::Kind { item, .. } => self.remake(item, plant),
                _ => {}
            }
        }
        self.read = log.count();
    }

    fn track(&mut self, item: usize, plant: &Plant) -> &mut Tracked {
        self.items.entry(item).or_insert_with(|| Tracked::new(plant.items().dimensions(item)))
    }

    fn remake(&mut self, item: usize, plant: &Plant) {
        let Some(tracked) = self.items.get_mut(&item) else { return };
        let dimensions = plant.items().dimensions(item);
        if std::mem::replace(&mut tracked.dimensions, dimensions) != dimensions {
            self.load(item, plant);
        }
    }

    /// What lies on an item, or what it is itself, has changed: all above one another are one body.
    fn load(&mut self, item: usize, plant: &Plant) {
        let base = plant.items().base_of(item);
        let Some((index, before)) = self.items.get(&base).and_then(|tracked| tracked.place) else { return };
        let pairs = self.pairs_of[index].iter();
        let touching: Vec<_> =
            pairs.map(|pair| (*pair, self.pairs[*pair].touching_of(index, before))).collect();
        let touched = self.touches;
        self.leave(base, plant);
        self.come(base, plant.items()[base].carrier, plant);
        let now = self.items.get(&base).and_then(|tracked| tracked.place);
        let Some((_, now)) = now.filter(|(group, _)| *group == index) else { return };
        for (pair, touching) in touching {
            self.pairs[pair].go_on(touching, index, [before, now]);
        }
        self.touches = touched && self.pairs.iter().any(Pair::touches);
    }

    fn leave(&mut self, item: usize, plant: &Plant) {
        let Some(tracked) = self.items.get_mut(&item) else { return };
        let Some((index, body)) = tracked.place.take() else { return };
        let group = &mut self.groups[index];
        if let Some(turn) = group.turn(body, plant) {
            tracked.turn = turn;
        }
        let anchor = group.remove(body).map(|body| body.anchor);
        if let Some(Anchor::Route) = anchor {
            let vehicle = plant.vehicle(index).unwrap_or_default();
            let along = vehicle.pose().then(&tracked.hang).axis(0);
            tracked.turn = libm::atan2(along.y, along.x);
        }
        if let Some(Anchor::Link(link)) = anchor {
            tracked.tipped = group.link_now(link, plant).then(&tracked.hang);
            let [along, left] = [0, 1].map(|axis| tracked.tipped.axis(axis));
            // Of an item that is put upright again after it lay on its side.
            let is_level = libm::hypot(along.x, along.y) > 0.5;
            tracked.turn =
                if is_level { libm::atan2(along.y, along.x) } else { libm::atan2(-left.x, left.y) };
        }
        self.expect(index, body);
    }

    fn come(&mut self, item: usize, to: Carrier, plant: &Plant) {
        // Groups of machines stand in the order of the machines.
        let (Some(index), Some(place)) = (to.machine(), plant.place(item)) else { return };
        self.track(item, plant);
        let (group, Some(tracked)) = (&mut self.groups[index], self.items.get_mut(&item)) else { return };
        let upper = plant.upper(item);
        let lies = match upper {
            Some(upper) => Pose { position: place, ..lying_on_its_side(&tracked.tipped, upper) },
            None => Pose::turned(place, tracked.turn),
        };
        let (anchor, frame) = match (to, &group.kind) {
            (Carrier::Grip { .. }, Kind::Arm { chain, .. }) => {
                tracked.hang = group.link_now(chain.last(), plant).inverse().then(&lies);
                (Anchor::Link(chain.last()), tracked.hang)
            }
            (Carrier::Place { .. }, _) if plant.vehicle_under(item).is_some() => {
                let vehicle = plant.vehicle(index).unwrap_or_default();
                tracked.hang = vehicle.pose().inverse().then(&lies);
                (Anchor::Route, tracked.hang)
            }
            _ => {
                let carried = plant.conveyed(item).and_then(|conveyed| conveyed.carried);
                let on = carried.map_or(0.0, |carried| carried.frame(0.0).yaw);
                let tipped = Pose { position: Point::default(), ..lies };
                match upper {
                    Some(_) => (Anchor::Lying { item, turn: -on.to_radians() }, tipped),
                    None => (Anchor::Lying { item, turn: tracked.turn - on.to_radians() }, Pose::IDENTITY),
                }
            }
        };
        let pieces = load::pieces(item, &frame, &self.names, plant);
        let Point { x, y, z } = tracked.dimensions.size;
        let size = [x, y, z, tracked.turn];
        let turned = frame.rotation.into_iter().flatten();
        let hang = [frame.position.x, frame.position.y, frame.position.z];
        let print =
            size.into_iter().chain(turned).chain(hang).fold(Fingerprint::default(), Fingerprint::near);
        let print = load::with_loads(item, print, plant);
        let body = group.add_item(anchor, pieces, print, plant);
        tracked.place = Some((index, body));
        self.expect(index, body);
    }

    /// Another body stands at this number of a group, or none any more.
    fn expect(&mut self, group: usize, body: usize) {
        for pair in &self.pairs_of[group] {
            self.pairs[*pair].expect(group, body);
        }
        self.touches = self.touches && self.pairs.iter().any(Pair::touches);
    }
}

/// As it hung, or, if it came otherwise, with its y level.
fn lying_on_its_side(hung: &Pose, upper: Point) -> Pose {
    if hung.axis(2).dot(upper) > -OPPOSITE {
        return *hung;
    }
    let facing = Facing::new(upper.scaled(-1.0)).unwrap_or_default();
    facing.pose(Point::default(), 1.0).then(&Facing::Down.pose(Point::default(), 1.0))
}
