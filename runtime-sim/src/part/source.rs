//! Where the items of the supply appear on a lane.

use super::running::milliseconds;
use super::settings::{Form, Setting, Settings};
use super::{Described, Level, Running, Schema, Start};
use crate::device::PortType;
use crate::line::{Line, Scenario};
use crate::wiring::Drives;

pub const SCHEMA: Schema = Schema {
    levels: &[Level { name: "release", ty: PortType::Bool }],
    ..Schema::new(
        "source",
        "Puts the items of the scenario's supply onto a lane, as soon as there is room: at times counted while the lane moves, or one at each rising edge of its level `release`, like a magazine.",
        &[
            Setting::new("on", Form::Part(&["lane"]), "", "the lane"),
            Setting::new(
                "inset",
                Form::Number,
                "m",
                "from the lane's beginning to the place where the middles of items appear, before that where they leave it",
            ),
        ],
    )
};

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
        let part = start.part;
        let releases = Drives::Level { part, level: RELEASE };
        let is_asked = start.machine().wiring.outputs.iter().any(|output| output.drives == releases);
        Ok(is_asked.then(|| Box::new(Magazine::default()) as Box<dyn Running>))
    }
}

/// Number of the level.
const RELEASE: usize = 0;

/// A source that is asked for each item.
#[derive(Clone, Debug, Default)]
struct Magazine {
    is_on: bool,
    /// Rising edges.
    asked: u64,
}

impl Running for Magazine {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    fn level(&mut self, _level: usize, value: &[f64]) {
        let is_on = value[0] != 0.0;
        self.asked += u64::from(is_on && !self.is_on);
        self.is_on = is_on;
    }

    fn asked(&self) -> Option<u64> {
        Some(self.asked)
    }
}

/// When items appear, in milliseconds at full speed.
#[derive(Clone, Copy, Debug)]
pub struct Spawn {
    pub first_ms: u64,
    pub every_ms: u64,
}

impl Spawn {
    pub fn new(scenario: &Scenario) -> Self {
        let [first_ms, every_ms] = [scenario.spawn_first_s, scenario.spawn_every_s].map(milliseconds);
        Self { first_ms, every_ms }
    }

    pub fn at_ms(&self, number: u64) -> u64 {
        self.first_ms.saturating_add(number.saturating_mul(self.every_ms))
    }
}

/// Numbers of the items that come to a machine, first one first.
pub fn supply(line: &Line, machine: usize) -> Vec<usize> {
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
