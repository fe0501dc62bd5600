//! Numbers that a person sets on the operator's panel.

use super::operated::{Operated, Operating};
use super::settings::{Form, Setting, Settings};
use super::{Described, Running, Schema, Signal, Start};
use crate::device::{Extent, PortType};

pub const SCHEMA: Schema = Schema {
    signals: &[Signal { name: "value", ty: PortType::Real, extent: Extent::One }],
    operated: Some(Operated::SetNumber),
    ..Schema::new(
        "setpoint",
        "A number that a person sets. The key `operator` of the scenario says when.",
        &[Setting::new("begins", Form::Number, "", "the number while no operation sets it")],
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
        Ok(Some(Box::new(Operating::new(start, self.begins, |value| value))))
    }
}
