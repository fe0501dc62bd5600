//! Where the items of the supply appear on a lane.

use super::running::milliseconds;
use super::settings::{Form, Setting, Settings};
use super::{Described, Progress, Running, Schema, See, World, Start};
use crate::carrier::Carrier;
use crate::line::Line;

pub const SCHEMA: Schema = Schema::new(
    "source",
    "Puts the items of the scenario's supply onto a lane, at times counted while the lane moves.",
    &[
        Setting::new("on", Form::Part(&["lane"]), "", "the lane"),
        Setting::new("inset", Form::Number, "m", "from the lane's upper end to where items appear"),
    ],
);

#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    pub lane: usize,
    pub inset: f64,
}

impl Described for Source {
    fn new(settings: &Settings) -> Result<Self, String> {
        Ok(Self { lane: settings.part("on")?, inset: settings.number("inset")? })
    }

    fn start(&self, start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        let scenario = &start.line.scenario;
        let spawn = Spawn {
            first_ms: milliseconds(scenario.spawn_first_s),
            every_ms: milliseconds(scenario.spawn_every_s),
        };
        Ok(Some(Box::new(Spawning::new(self, spawn, supply(start.line, start.machine)))))
    }
}

/// When items appear, in milliseconds at full speed.
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

/// A source at work.
#[derive(Clone, Debug)]
pub struct Spawning {
    source: Source,
    spawn: Spawn,
    /// Items that are still to appear, last one first.
    supply: Vec<usize>,
    spawned: u64,
}

impl Spawning {
    pub fn new(source: &Source, spawn: Spawn, mut supply: Vec<usize>) -> Self {
        supply.reverse();
        Self { source: source.clone(), spawn, supply, spawned: 0 }
    }
}

impl Running for Spawning {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    fn advance(&mut self, world: &mut World) -> Progress {
        let part = self.source.lane;
        let Some(moving) = world.lane(part).filter(|lane| lane.is_moving()) else {
            return Progress::Going;
        };
        while self.spawn.at_ms(self.spawned) <= moving.travel_ms() {
            let Some(item) = self.supply.pop() else { break };
            let lane = moving.lane();
            let at = lane.range[1] - self.source.inset + lane.distance(self.spawn.at_ms(self.spawned));
            self.spawned += 1;
            let carrier = Carrier::Lane { machine: world.machine, part, at, across: 0.0 };
            world.items.pass(item, carrier, moving.rests(at, 0.0));
        }
        Progress::Going
    }

    fn next_change(&self, see: &See, now_ms: u64) -> f64 {
        let moving = see.lane(self.source.lane).filter(|lane| lane.is_moving() && !self.supply.is_empty());
        moving.map_or(f64::INFINITY, |lane| {
            now_ms as f64 + self.spawn.at_ms(self.spawned).saturating_sub(lane.travel_ms()) as f64
        })
    }

    fn is_busy(&self, see: &See) -> bool {
        !self.supply.is_empty() && see.lane(self.source.lane).is_some_and(|lane| lane.is_moving())
    }
}

/// Numbers of the items that come to a machine, first one first.
fn supply(line: &Line, machine: usize) -> Vec<usize> {
    let mut first = 0;
    let mut supply = Vec::new();
    for other in &line.scenario.supply {
        if other.belt == machine {
            supply.extend(first..first + other.items.len());
        }
        first += other.items.len();
    }
    supply
}
