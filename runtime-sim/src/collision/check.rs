//! The collision check of a run.
//!
//! Conservative advancement: of each pair of bodies it is known how far the two may go before they can meet at
//! the earliest, from their last distance; it is looked at again when they may have gone so far. Within a scan
//! the places are those of the exact motion at exact times, each time so much later as the distance allows.
//! So nothing is stepped over, however thin.

use super::body::Piece;
use super::group::{Anchor, Group, Kind};
use super::pair::{Pair, Scan, Touch};
use crate::carrier::Carrier;
use crate::event::Event;
use crate::item;
use crate::kinematics::pose::Pose;
use crate::line::Line;
use crate::plant::Plant;
use crate::point::Point;
use crate::solid::Shape;

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
    pairs: Vec<Pair>,
    items: Vec<Tracked>,
    /// Events that were looked at.
    read: usize,
    contacts: Vec<Contact>,
    seconds: f64,
}

/// An item: how large it is, how it is turned, and where it is among the bodies.
#[derive(Clone, Debug)]
struct Tracked {
    name: String,
    /// Lengths along its own x, y and z.
    size: Point,
    /// About the vertical, since it appeared; while it hangs, that of the moment it was gripped.
    turn: f64,
    place: Option<(usize, usize)>,
    /// From the frame of the last link to the item's underside, while it hangs.
    hang: Pose,
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
        let kinds = line.scenario.supply.iter().flat_map(|supply| supply.items.iter());
        let items = item::names(line).into_iter().zip(kinds).map(|(name, &kind)| {
            let kind = &line.kinds[kind];
            let size = Point::new(kind.size[0], kind.size[1], kind.height);
            Tracked { name, size, turn: 0.0, place: None, hang: Pose::IDENTITY }
        });
        Self {
            items: items.collect(),
            groups,
            pairs,
            read: 0,
            contacts: Vec::new(),
            seconds: f64::from(line.scan_ms) / 1000.0,
        }
    }

    /// All pairs that came into contact, in the order of their first times.
    pub fn into_contacts(self) -> Vec<Contact> {
        self.contacts
    }

    /// Looks ahead over the scan that begins, when the plant has obeyed its outputs and nothing has moved yet.
    /// The first contact that the layout does not allow.
    pub(crate) fn look(&mut self, plant: &Plant) -> Option<&Contact> {
        self.follow_items(plant);
        for group in &mut self.groups {
            group.begin_scan(plant, self.seconds);
        }
        let mut found = Vec::new();
        for (index, pair) in self.pairs.iter_mut().enumerate() {
            let [a, b] = pair.groups;
            if self.groups[a].path + self.groups[b].path <= pair.clear {
                continue;
            }
            let mut scan = Scan { groups: &mut self.groups, plant, seconds: self.seconds };
            if let Some(touch) = pair.look(&mut scan) {
                found.push((index, touch));
            }
        }
        found.sort_by(|(_, a), (_, b)| a.time.total_cmp(&b.time));
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

    fn follow_items(&mut self, plant: &Plant) {
        let log = plant.items().log();
        for event in &log[self.read..] {
            let Event::Item { item, to, .. } = *event else { continue };
            self.leave(item, plant);
            // What was passed on since is followed with its own event.
            if plant.items().all()[item].carrier == to {
                self.come(item, to, plant);
            }
        }
        self.read = log.len();
    }

    fn leave(&mut self, item: usize, plant: &Plant) {
        let tracked = &mut self.items[item];
        let Some((group, body)) = tracked.place.take() else { return };
        let group = &mut self.groups[group];
        if let Some(Anchor::Link(link)) = group.bodies[body].take().map(|body| body.anchor) {
            let along = group.link_now(link, plant).then(&tracked.hang).axis(0);
            tracked.turn = libm::atan2(along.y, along.x);
        }
    }

    fn come(&mut self, item: usize, to: Carrier, plant: &Plant) {
        // Groups of machines stand in the order of the machines.
        let (Some(index), Some(place)) = (to.machine(), plant.place(item)) else { return };
        let group = &mut self.groups[index];
        let tracked = &mut self.items[item];
        // Gripped from a little above or below, a part is drawn up to the gripper's face.
        let place = match to {
            Carrier::Grip { machine, .. } => {
                let tool = plant.position(machine).unwrap_or(place);
                Point { z: tool.z - tracked.size.z, ..place }
            }
            _ => place,
        };
        let lies = Pose::turned(place, tracked.turn);
        let (anchor, frame) = match (to, &group.kind) {
            (Carrier::Grip { .. }, Kind::Arm { chain, .. }) => {
                tracked.hang = group.link_now(chain.last(), plant).inverse().then(&lies);
                (Anchor::Link(chain.last()), tracked.hang)
            }
            _ => (Anchor::Lying { item, turn: tracked.turn }, Pose::IDENTITY),
        };
        let middle = Pose { position: Point::new(0.0, 0.0, tracked.size.z / 2.0), ..Pose::IDENTITY };
        let shape = Shape::Box { size: tracked.size };
        let piece = Piece::new(tracked.name.clone(), &frame.then(&middle), shape);
        let body = group.add_item(anchor, piece, plant);
        tracked.place = Some((index, body));
        for pair in self.pairs.iter_mut().filter(|pair| pair.groups.contains(&index)) {
            pair.expect(index, body);
        }
    }
}
