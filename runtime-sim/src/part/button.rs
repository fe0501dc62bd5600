//! Push buttons and switches of the operator's panel.

use super::operated::{Operated, Operating};
use super::settings::{Form, Setting, Settings};
use super::{Described, Running, Schema, Signal, Start};
use crate::device::{Extent, PortType};

pub const SCHEMA: Schema = Schema {
    signals: &[Signal { name: "on", ty: PortType::Bool, extent: Extent::One }],
    operated: Some(Operated::Press),
    ..Schema::new(
        "button",
        "A push button or a switch. The key `operator` of the scenario says when it is pressed or turned on.",
        &[Setting::new(
            "normally_closed",
            Form::Truth,
            "",
            "`on` is true until it is pressed, as with the contact of a stop button",
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
        let on = |pressed: bool| f64::from(u8::from(pressed != self.is_normally_closed));
        Ok(Some(Box::new(Operating::new(start, on(false), |value| on(value != 0.0)))))
    }
}
