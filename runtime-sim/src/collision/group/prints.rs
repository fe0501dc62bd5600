//! What tells a group apart in the memory of the collision check: its motion, its place, and what it bears.

use super::super::movement::Movement;
use super::{Anchor, Body, Group, Kind};
use crate::fingerprint::Fingerprint;
use crate::plant::Plant;
use crate::point::Point;

impl Group {
    /// Of the motion under way; none if it rests, or does not come to rest by itself.
    pub fn moving(&mut self, plant: &Plant) -> Option<Fingerprint> {
        if self.moves_parts() {
            return None;
        }
        if self.moving.is_none() {
            let motion = match &self.movement {
                Movement::Still | Movement::Rides { .. } => return None,
                Movement::Slides { until, .. } if until.is_infinite() => return None,
                Movement::Slides { velocity, from, until } => {
                    let begin = self.position(plant) - velocity.scaled((-from).max(0.0));
                    let end = begin + velocity.scaled(until - from);
                    near(near(Fingerprint::default(), begin), end)
                }
                Movement::Swings { motion, .. } => motion.fingerprint(),
            };
            self.moving = Some(self.with_strokes(motion));
        }
        self.moving
    }

    /// Of where it is; none if it moves.
    pub fn resting(&mut self, plant: &Plant) -> Option<Fingerprint> {
        if self.moves() {
            return None;
        }
        if self.resting.is_none() {
            self.resting = Some(self.with_strokes(self.place(plant)));
        }
        self.resting
    }

    /// Of where it is now.
    fn place(&self, plant: &Plant) -> Fingerprint {
        match &self.kind {
            Kind::Obstacle => Fingerprint::default(),
            Kind::Machine { index, .. } => {
                let place = near(Fingerprint::default(), plant.position(*index).unwrap_or_default());
                plant.vehicle(*index).map_or(place, |vehicle| place.near(vehicle.yaw))
            }
            Kind::Arm { index, .. } => {
                let joints = plant.joints(*index);
                let joints = joints.iter().flat_map(|joints| joints.iter());
                joints.fold(Fingerprint::default(), |print, joint| print.near(*joint))
            }
        }
    }

    /// Of all that it does from now on until something new is asked of it; none of what nobody asks about again.
    pub fn law(&mut self, plant: &Plant) -> Option<Fingerprint> {
        let movement = match &self.movement {
            Movement::Still => self.place(plant),
            Movement::Rides { .. } => return None,
            Movement::Slides { velocity, from, until } => {
                let place = near(near(Fingerprint::default(), self.position(plant)), *velocity);
                place.near(*from).near(*until)
            }
            Movement::Swings { motion, begin } => motion.law(*begin),
        };
        Some(self.with_strokes(movement).and(self.parts.law()?).and(self.borne(plant)))
    }

    /// And of where its cylinders and positioners are.
    fn with_strokes(&self, print: Fingerprint) -> Fingerprint {
        self.parts.strokes().fold(print, |print, stroking| print.near(stroking.out))
    }

    /// Of all items, and of where they are on the machine.
    pub fn borne(&mut self, plant: &Plant) -> Fingerprint {
        if let Some(borne) = self.borne {
            return borne;
        }
        let items = self.bodies.iter().flatten().filter_map(|body| self.item(body, plant));
        let borne = items.fold(Fingerprint::default(), Fingerprint::sum);
        self.borne = Some(borne);
        borne
    }

    /// Of all items with the numbers of their bodies.
    pub fn numbered(&self, plant: &Plant) -> Fingerprint {
        let items = self.bodies.iter().enumerate();
        let items = items.filter_map(|(number, body)| Some((number, self.item(body.as_ref()?, plant)?)));
        items.fold(Fingerprint::default(), |all, (number, item)| all.with(number as u64).and(item))
    }

    /// Of an item, and of where it is on the machine; none for a body of the machine itself.
    fn item(&self, body: &Body, plant: &Plant) -> Option<Fingerprint> {
        let (place, turn) = match body.anchor {
            Anchor::Lying { item, turn } => {
                let conveyed = self.parts.conveyed(item);
                let turn =
                    conveyed.map_or(turn, |conveyed| conveyed.yaw(0.0, turn.to_degrees()).to_radians());
                (plant.place(item).unwrap_or_default() - self.position(plant), turn)
            }
            Anchor::World | Anchor::Link(_) | Anchor::Route | Anchor::Carriage(_) => (Point::default(), 0.0),
        };
        Some(near(body.item?, place).near(turn))
    }

    /// What tells an item apart; the bodies of the machine itself have all the same.
    pub fn unit(&self, body: usize, plant: &Plant) -> Fingerprint {
        let item = self.bodies[body].as_ref().and_then(|body| self.item(body, plant));
        item.unwrap_or_default()
    }
}

fn near(print: Fingerprint, place: Point) -> Fingerprint {
    [place.x, place.y, place.z].into_iter().fold(print, Fingerprint::near)
}
