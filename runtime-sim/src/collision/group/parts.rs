//! What moves on a machine: items on its conveyors, and cylinders.

use super::{Anchor, Body};
use crate::fingerprint::Fingerprint;
use crate::part::stroke::Stroking;
use crate::plant::Plant;
use crate::plant::conveyed::Conveyed;

/// How items and cylinders continue from the last look on, by their numbers, in the order of the bodies.
#[derive(Clone, Debug, Default)]
pub struct Parts {
    conveyed: Vec<(usize, Conveyed)>,
    strokes: Vec<(usize, Stroking)>,
}

impl Parts {
    /// None of an item that lies where nothing conveys or carries it.
    pub fn conveyed(&self, item: usize) -> Option<&Conveyed> {
        find(&self.conveyed, item)
    }

    pub fn stroking(&self, part: usize) -> Option<&Stroking> {
        find(&self.strokes, part)
    }

    pub fn strokes(&self) -> impl Iterator<Item = &Stroking> {
        self.strokes.iter().map(|(_, stroking)| stroking)
    }

    pub fn moves(&self) -> bool {
        self.conveyed.iter().any(|(_, conveyed)| conveyed.moves()) || self.strokes().any(Stroking::moves)
    }

    /// Seconds until the first of them rests; infinity: none moves, or never.
    pub fn rests_after(&self) -> f64 {
        let items = self.conveyed.iter().filter(|(_, conveyed)| conveyed.moves());
        let items = items.map(|(_, conveyed)| conveyed.rests_after());
        items.chain(self.strokes().map(Stroking::rests_after)).fold(f64::INFINITY, f64::min)
    }

    /// Of how they continue; none if a cylinder moves or carries one of them.
    pub fn law(&self) -> Option<Fingerprint> {
        if self.strokes().any(Stroking::moves) {
            return None;
        }
        let mut laws = self.conveyed.iter().map(|(_, conveyed)| conveyed.law());
        laws.try_fold(Fingerprint::default(), |all, law| Some(all.and(law?)))
    }

    /// Looks again, so many seconds after the last time; whether all of them have continued as they were going to.
    pub fn follow(&mut self, bodies: &[Option<Body>], machine: usize, plant: &Plant, passed: f64) -> bool {
        let lying = bodies.iter().flatten().filter_map(Body::lying);
        let conveyed = lying.filter_map(|item| Some((item, plant.conveyed(item)?)));
        let items_go_on =
            replace(&mut self.conveyed, conveyed, |then: &Conveyed, now| then.becomes(now, passed));
        let cylinders = bodies.iter().flatten().filter_map(|body| match body.anchor {
            Anchor::Carriage(part) => Some(part),
            _ => None,
        });
        let strokes = cylinders.filter_map(|part| Some((part, plant.stroking(machine, part)?)));
        let strokes_go_on =
            replace(&mut self.strokes, strokes, |then: &Stroking, now| then.becomes(now, passed));
        items_go_on && strokes_go_on
    }
}

fn find<T>(all: &[(usize, T)], number: usize) -> Option<&T> {
    all.iter().find(|(known, _)| *known == number).map(|(_, one)| one)
}

/// Whether the new ones are those that the old ones become.
fn replace<T>(
    all: &mut Vec<(usize, T)>,
    new: impl Iterator<Item = (usize, T)>,
    becomes: impl Fn(&T, &T) -> bool,
) -> bool {
    let (mut count, mut goes_on) = (0, true);
    for (number, now) in new {
        match all.get_mut(count) {
            Some(known) => {
                goes_on &= known.0 == number && becomes(&known.1, &now);
                *known = (number, now);
            }
            None => {
                goes_on = false;
                all.push((number, now));
            }
        }
        count += 1;
    }
    goes_on &= count == all.len();
    all.truncate(count);
    goes_on
}
