//! Numbers that a person sets on the operator's panel.

use super::operated::Operations;
use super::settings::{Form, Setting, Settings};
use super::{Described, Progress, Running, Schema, See, Signal, Start, World};
use crate::device::{Extent, PortType};

pub const SCHEMA: Schema = Schema {
    signals: &[Signal { name: "value", ty: PortType::Real, extent: Extent::One }],
    ..Schema::new(
        "setpoint",
        "A number that a person sets. The scenario says when, see `operator`.",
        &[Setting::new("begins", Form::Number, "", "the number before it is set, and after it is no longer")],
    )
};

#[derive(Clone, Debug, PartialEq)]
pub struct Setpoint {
    pub begins: f64,
}

impl Described for Setpoint {
    fn new(settings: &Settings) -> Result<Self, String> {
        Ok(Self { begins: settings.number("begins")? })
    }

    fn start(&self, start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        let operations = Operations::of(start);
        Ok(Some(Box::new(Set { begins: self.begins, operations, now_ms: 0 })))
    }
}

/// A set-point at work.
#[derive(Clone, Debug)]
pub struct Set {
    begins: f64,
    operations: Operations,
    now_ms: u64,
}

impl Running for Set {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    fn advance(&mut self, world: &mut World) -> Progress {
        self.now_ms = world.next_ms();
        Progress::Going
    }

    fn next_change(&self, _see: &See, now_ms: u64) -> f64 {
        self.operations.next_change(now_ms)
    }

    fn is_busy(&self, _see: &See) -> bool {
        self.operations.next_change(self.now_ms).is_finite()
    }

    fn signal(&self, _signal: usize, _see: &See, out: &mut [f64]) {
        out[0] = self.operations.value(self.now_ms).unwrap_or(self.begins);
    }
}
