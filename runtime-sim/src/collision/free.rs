//! Whether the whole motion of a machine keeps off another one that rests, or off the machine itself; and whether two keep
//! off one another where they rest.
//!
//! Time has no part in this, only places on the path. The answer is remembered for the machine without its items and
//! for each item: where an item comes or goes, all else is known.

use super::body::{Ball, Placed};
use super::group::{Anchor, Body, Boxes, Group, Swept};
use super::{TOLERANCE, UNCERTAIN};
use crate::fingerprint::Fingerprint;
use crate::kinematics::pose::Pose;
use crate::memory::Memory;
use crate::motion::Travel;
use crate::plant::Plant;
use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::sync::Arc;

/// A motion is checked in pieces no smaller than its path divided by two so often.
const HALVINGS: u32 = 18;
/// The answer is not known if two bodies have to be checked more often in all.
const MOST_LOOKS: usize = 100_000;
/// Boxes are measured exactly on pieces of a path on which nothing goes farther, m. On longer ones it rarely helps.
const SHORT: f64 = 0.03;

/// What decides whether two groups stay apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Question {
    /// A motion, and the place of what rests; or both places.
    machines: Fingerprint,
    /// The same with all items.
    all: Fingerprint,
    /// The side of which only what stands in the world is asked about.
    standing: Option<usize>,
}

impl Question {
    /// Of two groups of which one rests at least, or of one alone; none if both move.
    pub fn of(groups: &mut [Group], pair: usize, [a, b]: [usize; 2], plant: &Plant) -> Option<Self> {
        let both = match (groups[a].resting(plant), groups[b].resting(plant)) {
            (None, None) if a == b => groups[a].moving(plant)?,
            (None, None) => return None,
            (None, Some(rests)) => groups[a].moving(plant)?.and(rests),
            (Some(rests), None) => rests.and(groups[b].moving(plant)?),
            (Some(first), Some(second)) => first.and(second).with(AT_REST),
        };
        let machines = both.with(pair as u64);
        let all = machines.and(groups[a].borne(plant)).and(groups[b].borne(plant));
        Some(Self { machines, all, standing: None })
    }

    /// Of a group as it moves, and of what stands in the world of the other one, which has this side of the pair.
    pub fn of_standing(
        groups: &mut [Group],
        pair: usize,
        numbers: [usize; 2],
        side: usize,
        plant: &Plant,
    ) -> Option<Self> {
        let mover = &mut groups[numbers[1 - side]];
        let machines = mover.moving(plant)?.with(pair as u64).with(STANDING + side as u64);
        Some(Self { machines, all: machines.and(mover.borne(plant)), standing: Some(side) })
    }
}

/// Tell questions apart.
const STANDING: u64 = 1 << 32;
const AT_REST: u64 = 1 << 33;

/// Whether two stay apart for the whole motion of one of them; false if that is not known.
pub fn is_free(
    groups: &mut [Group],
    [a, b]: [usize; 2],
    plant: &Plant,
    memory: &mut Memory,
    Question { machines, all, standing }: Question,
) -> bool {
    if let Some(known) = memory.is_free(all) {
        return known;
    }
    let stands = |group: usize| standing.is_some_and(|side| [a, b][side] == group);
    let boxes: [Arc<Boxes>; 2] = [a, b].map(|group| match (a == b, stands(group)) {
        (true, _) => Arc::new(Boxes::unknown()),
        (_, true) => Arc::new(Boxes::of(groups[group].standing_boxes())),
        (_, false) => groups[group].boxes(plant, memory),
    });
    let near = near_pieces(&boxes);
    if near.is_empty() {
        memory.note_free(all, true);
        return true;
    }
    if ![a, b].into_iter().any(|group| groups[group].has_whole_path()) {
        return false;
    }
    let mut units = Units::new([a, b], groups);
    let (mut open, mut asked): (Vec<Two>, Vec<(Fingerprint, Option<bool>)>) = (Vec::new(), Vec::new());
    for bodies in meeting(&near, [a, b], groups, plant) {
        let key =
            machines.and(units.of(0, bodies[0], groups, plant)).and(units.of(1, bodies[1], groups, plant));
        let number = asked.iter().position(|(known, _)| *known == key).unwrap_or_else(|| {
            asked.push((key, memory.is_free(key)));
            asked.len() - 1
        });
        match asked[number].1 {
            Some(true) => {}
            Some(false) => {
                memory.note_free(all, false);
                return false;
            }
            None => open.push(Two { bodies, asked: number }),
        }
    }
    let mut path = Path::new([a, b], groups, plant);
    let found = near.into_iter().try_for_each(|piece| {
        let open: Vec<Two> = open.iter().filter(|two| piece.may_meet(two.bodies)).copied().collect();
        path.keep_off(&open, piece.path, HALVINGS)
    });
    match found {
        Ok(()) => {
            let new = asked.iter().filter(|(_, known)| known.is_none());
            new.for_each(|(key, _)| memory.note_free(*key, true));
        }
        Err(number) => memory.note_free(asked[number].0, false),
    }
    memory.note_free(all, found.is_ok());
    found.is_ok()
}

/// The two were looked at where they rest, and are free of contact, farther apart than the grain of a [`Fingerprint`].
pub fn note_free(memory: &Memory, question: Question) {
    memory.note_free(question.all, true);
}

/// A piece of a path.
struct PathPiece<'a> {
    /// From place to place.
    path: [f64; 2],
    /// Of both groups on it, if they are known.
    boxes: Option<[&'a Swept; 2]>,
}

impl PathPiece<'_> {
    /// Whether the boxes of two bodies meet.
    fn may_meet(&self, [i, j]: [usize; 2]) -> bool {
        self.boxes.is_none_or(|[a, b]| !a.bodies[i].is_apart(&b.bodies[j]))
    }

    /// Bodies of one of the groups whose boxes meet that of the other group; all, where boxes are not known.
    fn near(&self, side: usize, count: usize) -> impl Iterator<Item = usize> {
        let own = self.boxes.map_or(count, |boxes| boxes[side].bodies.len());
        (0..own).filter(move |body| {
            self.boxes.is_none_or(|boxes| !boxes[side].bodies[*body].is_apart(&boxes[1 - side].all))
        })
    }
}

/// Bodies of two groups, in order, that can come into contact and whose boxes meet on one of these pieces.
fn meeting(near: &[PathPiece], [a, b]: [usize; 2], groups: &[Group], plant: &Plant) -> Vec<[usize; 2]> {
    let [of_a, of_b] = [a, b].map(|group| groups[group].bodies.len());
    let mut meet = vec![false; of_a * of_b];
    let mut second: Vec<usize> = Vec::new();
    for piece in near {
        second.clear();
        second.extend(piece.near(1, of_b));
        for i in piece.near(0, of_a) {
            for j in &second {
                let meets = &mut meet[i * of_b + j];
                *meets = *meets || piece.may_meet([i, *j]);
            }
        }
    }
    let pairs = (0..of_a).flat_map(|i| (0..of_b).map(move |j| [i, j])).zip(meet);
    let can_meet = |[i, j]: &[usize; 2]| (a != b || i < j) && can_meet(groups, [(a, *i), (b, *j)], plant);
    pairs.filter(|(_, meet)| *meet).map(|(bodies, _)| bodies).filter(can_meet).collect()
}

/// What tells the items of two groups apart, and the machines without items.
struct Units {
    numbers: [usize; 2],
    /// Of the bodies, by group; none that nobody has asked for.
    known: [Vec<Option<Fingerprint>>; 2],
}

impl Units {
    fn new(numbers: [usize; 2], groups: &[Group]) -> Self {
        Self { numbers, known: numbers.map(|group| vec![None; groups[group].bodies.len()]) }
    }

    fn of(&mut self, side: usize, body: usize, groups: &[Group], plant: &Plant) -> Fingerprint {
        let group = &groups[self.numbers[side]];
        *self.known[side][body].get_or_insert_with(|| group.unit(body, plant))
    }
}

/// The equal pieces of the path of one of two groups on which its box meets the other's; all of it, where boxes are not
/// known.
fn near_pieces(boxes: &[Arc<Boxes>; 2]) -> Vec<PathPiece<'_>> {
    let boxes = [0, 1].map(|group| &boxes[group].pieces);
    if boxes.iter().any(|boxes| boxes.is_empty()) {
        return vec![PathPiece { path: [0.0, 1.0], boxes: None }];
    }
    let count = boxes[0].len().max(boxes[1].len());
    // One of them rests: its only box holds all the while.
    let of = |group: usize, number: usize| &boxes[group][number.min(boxes[group].len() - 1)];
    let near = (0..count).filter(|number| !of(0, *number).all.is_apart(&of(1, *number).all));
    let piece = |number: usize| PathPiece {
        path: [number, number + 1].map(|end| end as f64 / count as f64),
        boxes: Some([0, 1].map(|group| of(group, number))),
    };
    near.map(piece).collect()
}

/// Whether two bodies can ever come into contact.
pub fn can_meet(groups: &[Group], two: [(usize, usize); 2], plant: &Plant) -> bool {
    let [Some(a), Some(b)] = two.map(|(group, body)| groups[group].bodies[body].as_ref()) else {
        return false;
    };
    let stand = a.anchor == Anchor::World && b.anchor == Anchor::World;
    let own = two[0].0 == two[1].0 && !groups[two[0].0].is_free_of(a, b);
    // They stop behind one another without a gap.
    let follow = match (a.anchor, b.anchor) {
        (Anchor::Lying { item: a, .. }, Anchor::Lying { item: b, .. }) => plant.are_in_line([a, b]),
        _ => false,
    };
    !stand && !own && !follow && !a.bounds.is_apart(&b.bounds)
}

/// Two bodies by their numbers in both groups, and the number of what was asked for them.
#[derive(Clone, Copy)]
struct Two {
    bodies: [usize; 2],
    asked: usize,
}

/// A body somewhere.
struct There {
    frame: Pose,
    ball: Ball,
    /// Known when something is near.
    pieces: OnceCell<Vec<Placed>>,
}

/// One that moves, where it was checked last.
struct Moving {
    body: usize,
    there: There,
    /// Metres that it goes at most from there.
    travel: f64,
}

/// The whole path of one group, and another one at rest, or the same one.
struct Path<'a> {
    numbers: [usize; 2],
    groups: &'a mut [Group],
    plant: &'a Plant,
    /// Of the bodies that rest, by group; none that nobody has asked for.
    resting: [Vec<Option<There>>; 2],
    /// How far two bodies of the same arm go at most as seen from one another.
    between: BTreeMap<[usize; 2], Option<Travel>>,
    looks: usize,
}

impl<'a> Path<'a> {
    fn new(numbers: [usize; 2], groups: &'a mut [Group], plant: &'a Plant) -> Self {
        let resting = numbers.map(|group| groups[group].bodies.iter().map(|_| None).collect());
        Self { numbers, groups, plant, resting, between: BTreeMap::new(), looks: 0 }
    }

    /// Whether these bodies, in order, stay so far apart between two places of the path that it does not matter where
    /// they are to the grain of a [`Fingerprint`]; the path is halved so often at most. From where they are in the
    /// middle they cannot go farther than they do to either end. An error is what is not known to be free.
    fn keep_off(&mut self, all: &[Two], [from, to]: [f64; 2], halvings: u32) -> Result<(), usize> {
        let Some(first) = all.first() else { return Ok(()) };
        self.looks += all.len();
        if halvings == 0 || self.looks > MOST_LOOKS {
            return Err(first.asked);
        }
        let middle = from + (to - from) / 2.0;
        let mut near = Vec::new();
        let mut moving = [None, None];
        let places = [from, middle, to];
        let sections = [0, 1].map(|side| self.groups[self.numbers[side]].sections(places));
        for two in all {
            let mut look =
                |side: usize| self.look(side, two.bodies[side], places, sections[side], &mut moving[side]);
            let (of_a, of_b) = (look(0), look(1));
            let travel = match self.between(two.bodies, places, sections[0]) {
                Some(between) => between.min(of_a + of_b),
                None => of_a + of_b,
            };
            let there = |side: usize| {
                let moving: Option<&Moving> = moving[side].as_ref();
                moving.map(|moving| &moving.there).or(self.resting[side][two.bodies[side]].as_ref())
            };
            let [Some(a), Some(b)] = [there(0), there(1)] else { continue };
            let body = |side: usize| self.body(side, two.bodies[side]);
            let [Some(of_a), Some(of_b)] = [body(0), body(1)] else { continue };
            match keeps_off([a, b], [of_a, of_b], travel) {
                KeepsOff::Yes => {}
                KeepsOff::ForNow => near.push(*two),
                KeepsOff::No => return Err(two.asked),
            }
        }
        self.keep_off(&near, [from, middle], halvings - 1)?;
        self.keep_off(&near, [middle, to], halvings - 1)
    }

    /// Looks where a body is in the middle, unless it is known; metres that it goes at most from there to either end.
    fn look(
        &mut self,
        side: usize,
        body: usize,
        places: [f64; 3],
        sections: Option<[usize; 3]>,
        moving: &mut Option<Moving>,
    ) -> f64 {
        if !self.groups[self.numbers[side]].moves() {
            if self.resting[side][body].is_none() {
                self.resting[side][body] = self.there(side, body, places[1]);
            }
            return 0.0;
        }
        if moving.as_ref().is_none_or(|known| known.body != body) {
            let travel = self.travel(side, body, places, sections);
            *moving = self.there(side, body, places[1]).map(|there| Moving { body, there, travel });
        }
        moving.as_ref().map_or(0.0, |moving| moving.travel)
    }

    fn body(&self, side: usize, body: usize) -> Option<&Body> {
        self.groups[self.numbers[side]].bodies[body].as_ref()
    }

    /// At a place on the path.
    fn there(&mut self, side: usize, body: usize, place: f64) -> Option<There> {
        let anchor = self.body(side, body)?.anchor;
        let frame = self.groups[self.numbers[side]].frame_along(anchor, self.plant, place);
        let ball = self.body(side, body)?.ball.within(&frame);
        Some(There { frame, ball, pieces: OnceCell::new() })
    }

    /// Metres that two bodies of the same arm go at most as seen from one another, from the middle to either end.
    fn between(&mut self, bodies: [usize; 2], places: [f64; 3], sections: Option<[usize; 3]>) -> Option<f64> {
        let [group, other] = self.numbers;
        let sections = sections.filter(|_| group == other)?;
        let groups = &*self.groups;
        let travel = self.between.entry(bodies).or_insert_with(|| groups[group].travel_between(bodies));
        travel.as_ref().map(|travel| travel.from_middle(places, sections))
    }

    /// Metres that the body goes at most from the middle to either end.
    fn travel(&self, side: usize, body: usize, places: [f64; 3], sections: Option<[usize; 3]>) -> f64 {
        let group = &self.groups[self.numbers[side]];
        let Some(body) = self.body(side, body) else { return 0.0 };
        if let (Some(sections), Some(motion)) = (sections, group.motion()) {
            return body.travel(motion).from_middle(places, sections);
        }
        let [from, middle, to] = places;
        group.path_along(body, [from, middle]).max(group.path_along(body, [middle, to]))
    }
}

/// Whether two bodies keep off one another while they go so far.
enum KeepsOff {
    Yes,
    /// Where they are; not known to do so all the while.
    ForNow,
    No,
}

impl There {
    fn pieces(&self, body: &Body) -> &[Placed] {
        self.pieces.get_or_init(|| body.pieces.iter().map(|piece| piece.within(&self.frame)).collect())
    }
}

/// Of two bodies where they are, while they go so far, m.
fn keeps_off(there: [&There; 2], [a, b]: [&Body; 2], travel: f64) -> KeepsOff {
    let least = TOLERANCE + UNCERTAIN;
    let needed = least + travel;
    if there[0].ball.is_apart_by(&there[1].ball, needed) {
        return KeepsOff::Yes;
    }
    for a in there[0].pieces(a) {
        for b in there[1].pieces(b) {
            if a.is_apart_by(b, needed) {
                continue;
            }
            if travel > SHORT {
                return KeepsOff::ForNow;
            }
            let distance = a.gap(b).distance;
            if distance >= needed {
                continue;
            }
            return if distance > least { KeepsOff::ForNow } else { KeepsOff::No };
        }
    }
    KeepsOff::Yes
}
