//! What measures the item at a place of a lane.

use super::beam::{Beam, Crossing};
use super::settings::{Form, Setting, Settings};
use super::{Described, Running, Schema, See, Signal, Start};
use crate::device::{Extent, PortType};

pub const SCHEMA: Schema = Schema {
    signals: &[
        Signal { name: "height", ty: PortType::Real, extent: Extent::One },
        Signal { name: "mass", ty: PortType::Real, extent: Extent::One },
    ],
    ..Schema::new(
        "gauge",
        "Measures the item at a place of a lane, from its front edge to its rear edge: its height in m, its mass in kg. 0 without an item; the greatest value of several items.",
        &[
            Setting::new("across", Form::Part(&["lane"]), "", "the lane"),
            Setting::new("at", Form::Number, "m", "from the lane's beginning"),
        ],
    )
};

#[derive(Clone, Debug, PartialEq)]
pub struct Gauge {
    pub lane: usize,
    pub at: f64,
}

impl Described for Gauge {
    fn new(settings: &Settings) -> Result<Self, String> {
        Ok(Self { lane: settings.part("across")?, at: settings.number("at")? })
    }

    fn start(&self, start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        let kinds = &start.line.kinds;
        let beam = Beam { lane: self.lane, at: self.at, over: 0.0, only: None };
        let masses = kinds.iter().map(|kind| kind.mass).collect();
        Ok(Some(Box::new(Measuring { crossing: Crossing::new(&beam, kinds), masses })))
    }
}

/// A gauge at work.
#[derive(Clone, Debug)]
struct Measuring {
    crossing: Crossing,
    /// Of each kind, kg.
    masses: Vec<f64>,
}

impl Running for Measuring {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    fn next_change(&self, see: &See, now_ms: u64) -> f64 {
        self.crossing.next_change(see, now_ms)
    }

    fn signal(&self, signal: usize, see: &See, out: &mut [f64]) {
        let mass = |item: usize| -> f64 {
            see.items.with_loads(item).map(|item| self.masses[see.items[item].kind]).sum()
        };
        out[0] = match signal {
            0 => self.crossing.seen(see).map(|on_lane| on_lane.top).fold(0.0, f64::max),
            _ => self.crossing.items(see).map(mass).fold(0.0, f64::max),
        };
    }
}
