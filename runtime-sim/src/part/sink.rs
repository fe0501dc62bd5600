//! Where items leave a lane.

use super::settings::{Form, Setting, Settings};
use super::{Described, Progress, Running, Schema, See, Start, World};
use crate::carrier::Carrier;

pub const SCHEMA: Schema = Schema::new(
    "sink",
    "Takes items off a lane near its lower end; they are collected.",
    &[
        Setting::new("of", Form::Part(&["lane"]), "", "the lane"),
        Setting::new("inset", Form::Number, "m", "from the lane's lower end to where items leave"),
    ],
);

#[derive(Clone, Debug, PartialEq)]
pub struct Sink {
    pub lane: usize,
    pub inset: f64,
}

impl Described for Sink {
    fn new(settings: &Settings) -> Result<Self, String> {
        Ok(Self { lane: settings.part("of")?, inset: settings.number("inset")? })
    }

    fn start(&self, _start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        Ok(Some(Box::new(self.clone())))
    }
}

impl Running for Sink {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    fn advance(&mut self, world: &mut World) -> Progress {
        let Some(moving) = world.lane(self.lane).filter(|lane| lane.is_moving()) else {
            return Progress::Going;
        };
        let end = moving.lane().range[0] + self.inset + moving.travel();
        let leaves = |item: &usize| match world.items.all()[*item].carrier {
            Carrier::Lane { part, at, .. } => part == self.lane && at <= end,
            _ => false,
        };
        let leaving: Vec<usize> =
            world.items.borne_by(world.machine).iter().copied().filter(leaves).collect();
        for item in leaving {
            if let Carrier::Lane { at, across, .. } = world.items.all()[item].carrier {
                world.items.pass(item, Carrier::Collector, moving.rests(at, across));
            }
        }
        Progress::Going
    }

    /// An item comes to the end.
    fn next_change(&self, see: &See, now_ms: u64) -> f64 {
        let Some(moving) = see.lane(self.lane) else { return f64::INFINITY };
        let ends = see.borne_by(self.lane).filter_map(|item| match see.items.all()[item].carrier {
            Carrier::Lane { at, .. } => Some(at - moving.lane().range[0] - self.inset),
            _ => None,
        });
        let leaves = |end: f64| {
            let is_beyond = moving.is_moving() && end <= moving.travel();
            if is_beyond { now_ms as f64 } else { moving.reaches(end, now_ms) }
        };
        ends.map(leaves).fold(f64::INFINITY, f64::min)
    }
}
