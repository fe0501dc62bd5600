//! Push buttons and switches of the operator's panel.

use super::operated::Operations;
use super::settings::{Form, Setting, Settings};
use super::{Described, Progress, Running, Schema, See, Signal, Start, World};
use crate::device::{Extent, PortType};

pub const SCHEMA: Schema = Schema {
    signals: &[Signal { name: "on", ty: PortType::Bool, extent: Extent::One }],
    ..Schema::new(
        "button",
        "A push button or a switch. The scenario says when it is pressed or turned on, see `operator`.",
        &[Setting::new(
            "normally_closed",
            Form::Truth,
            "",
            "`on` is true until it is pressed, as the contact of a stop button is",
        )
        .optional()],
    )
};

#[derive(Clone, Debug, PartialEq)]
pub struct Button {
    pub is_normally_closed: bool,
}

impl Described for Button {
    fn new(settings: &Settings) -> Result<Self, String> {
        let is_normally_closed = settings.optional("normally_closed", Settings::truth)?.unwrap_or(false);
        Ok(Self { is_normally_closed })
    }

    fn start(&self, start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        let operations = Operations::of(start);
        Ok(Some(Box::new(Pressed { button: self.clone(), operations, now_ms: 0 })))
    }
}

/// A button at work.
#[derive(Clone, Debug)]
pub struct Pressed {
    button: Button,
    operations: Operations,
    now_ms: u64,
}

impl Running for Pressed {
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
        let is_pressed = self.operations.value(self.now_ms).is_some_and(|value| value != 0.0);
        out[0] = f64::from(u8::from(is_pressed != self.button.is_normally_closed));
    }
}
