//! A conveyor belt with the camera over its pick zone.

use super::command::{Asked, Command, is_held};
use super::course::Course;
use super::image::{in_belt, put_bit, put_point};
use crate::carrier::Carrier;
use crate::device::error;
use crate::geometry::{BELT_SURFACE, BELT_WIDTH, END_INSET, PICK_ZONE_HALF, SPAWN_INSET};
use crate::item::Items;
use crate::line::Kind;
use crate::point::{Axis, Point};

/// Full speed in m/s (competition specification of the conveyor). Its changes are steps, as the
/// simulator of the competition sets the joint's velocity directly.
pub const SPEED: f64 = 0.2;
/// Half of the longest part's length in the competition (battery: 0.135 m, and some slack): parts lie as they
/// were let go. A longer part is let in later.
const PART_HALF: f64 = 0.07;

#[derive(Clone, Debug)]
pub struct Belt {
    pub command: Command,
    pose: Point,
    orient: Axis,
    range: [f64; 2],
    drive: Drive,
    held: bool,
    /// By kind: how far the middle of a part that lies wholly in the pick zone is from the zone's at most.
    zone: Vec<f64>,
    /// Milliseconds at full speed since the start of the run.
    travel_ms: u64,
    spawn: Spawn,
    /// Items that are still to appear, last one first.
    supply: Vec<usize>,
    spawned: u64,
}

/// When parts appear, in milliseconds at full speed.
#[derive(Clone, Copy, Debug)]
pub struct Spawn {
    pub first_ms: u64,
    pub every_ms: u64,
}

impl Spawn {
    fn at_ms(&self, number: u64) -> u64 {
        self.first_ms.saturating_add(number.saturating_mul(self.every_ms))
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Drive {
    FullSpeed,
    Rest,
}

impl Belt {
    pub fn new(
        command: Command,
        pose: Point,
        orient: Axis,
        range: [f64; 2],
        spawn: Spawn,
        kinds: &[Kind],
        mut supply: Vec<usize>,
    ) -> Self {
        let half = |kind: &Kind| (kind.size[0].max(kind.size[1]) / 2.0).max(PART_HALF);
        supply.reverse();
        Self {
            command,
            pose,
            orient,
            range,
            drive: Drive::Rest,
            held: false,
            zone: kinds.iter().map(|kind| PICK_ZONE_HALF - half(kind)).collect(),
            travel_ms: 0,
            spawn,
            supply,
            spawned: 0,
        }
    }

    pub fn obey(&mut self, outputs: &[f64]) {
        match self.command.accept(outputs) {
            Asked::Start(1) => self.drive = Drive::FullSpeed,
            Asked::Start(2) => self.drive = Drive::Rest,
            Asked::Start(_) => self.command.end(error::REFUSED),
            Asked::Nothing | Asked::Refused => {}
        }
        self.held = is_held(outputs);
    }

    pub fn advance(&mut self, machine: usize, dt_ms: u64, items: &mut Items) {
        if self.held {
            return;
        }
        if self.command.is_under_way() {
            self.command.end(error::NONE);
        }
        if self.drive == Drive::Rest {
            return;
        }
        self.travel_ms += dt_ms;
        while self.spawn.at_ms(self.spawned) <= self.travel_ms {
            let Some(item) = self.supply.pop() else { break };
            let at = self.range[1] - SPAWN_INSET + distance(self.spawn.at_ms(self.spawned));
            self.spawned += 1;
            items.pass(item, Carrier::Belt { machine, at, across: 0.0 }, self.place(at, 0.0));
        }
        let end = self.range[0] + END_INSET + self.travel();
        let mut next = 0;
        while let Some(&item) = items.borne_by(machine).get(next) {
            match items.all()[item].carrier {
                Carrier::Belt { at, across, .. } if at <= end => {
                    items.pass(item, Carrier::Collector, self.place(at, across));
                }
                _ => next += 1,
            }
        }
    }

    /// Metres that the belt has moved since the start of the run.
    pub fn travel(&self) -> f64 {
        distance(self.travel_ms)
    }

    pub fn is_moving(&self) -> bool {
        self.drive == Drive::FullSpeed && !self.held
    }

    pub fn course(&self) -> Course {
        if !self.is_moving() {
            return Course::Rests;
        }
        let velocity = match self.orient {
            Axis::X => Point::new(-SPEED, 0.0, 0.0),
            Axis::Y => Point::new(0.0, -SPEED, 0.0),
        };
        Course::Drives { velocity, from_ms: 0.0, until_ms: f64::INFINITY }
    }

    /// Parts are still to appear on it.
    pub fn has_supply(&self) -> bool {
        !self.supply.is_empty()
    }

    /// Where an item rests that has these belt coordinates, see [`Carrier::Belt`].
    pub fn place(&self, at: f64, across: f64) -> Point {
        let along = at - self.travel();
        let surface = self.pose.up(BELT_SURFACE);
        match self.orient {
            Axis::X => Point::new(along, surface.y + across, surface.z),
            Axis::Y => Point::new(surface.x + across, along, surface.z),
        }
    }

    /// What becomes of an item that comes down at this place, if it meets the belt.
    pub fn below(&self, machine: usize, point: Point) -> Option<(f64, Carrier)> {
        let (along, across) = match self.orient {
            Axis::X => (point.x, point.y - self.pose.y),
            Axis::Y => (point.y, point.x - self.pose.x),
        };
        let meets = (self.range[0]..=self.range[1]).contains(&along) && across.abs() <= BELT_WIDTH / 2.0;
        let carrier = Carrier::Belt { machine, at: along + self.travel(), across };
        meets.then_some((self.pose.z + BELT_SURFACE, carrier))
    }

    pub fn write(&self, image: &mut [f64], machine: usize, items: &Items) {
        self.command.write(image);
        put_bit(image, in_belt::MOVING, self.is_moving());
        image[in_belt::SEES..].fill(0.0);
        let middle = self.pose.coordinate(self.orient);
        for &item in items.borne_by(machine) {
            let item = &items.all()[item];
            let Carrier::Belt { at, across, .. } = item.carrier else { continue };
            let along = at - self.travel();
            if (along - middle).abs() > self.zone[item.kind] {
                continue;
            }
            let place = self.place(at, across);
            let seen_at = in_belt::SEES + self.zone.len() + 3 * item.kind;
            let sees = in_belt::SEES + item.kind;
            let other = match self.orient {
                Axis::X => image[seen_at],
                Axis::Y => image[seen_at + 1],
            };
            if image[sees] == 0.0 || along < other {
                image[sees] = 1.0;
                put_point(image, seen_at, place);
            }
        }
    }
}

/// Metres in so many milliseconds at full speed.
fn distance(ms: u64) -> f64 {
    SPEED * ms as f64 / 1000.0
}
