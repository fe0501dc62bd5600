//! Selector switches, and other whole numbers that a person sets on the operator's panel.

use super::operated::{Operated, Operating};
use super::settings::{Form, Setting, Settings};
use super::{Described, Running, Schema, Signal, Start};
use crate::device::{Extent, PortType};

pub const SCHEMA: Schema = Schema {
    signals: &[Signal { name: "position", ty: PortType::WHOLE, extent: Extent::One }],
    operated: Some(Operated::SetNumber),
    ..Schema::new(
        "selector",
        "A selector switch, or another whole number that a person sets. The key `operator` of the scenario says when.",
        &[Setting::new("begins", Form::Number, "", "the position while no operation sets it; a fraction is cut off").optional()],
    )
};

#[derive(Clone, Debug, PartialEq)]
pub struct Selector {
    pub begins: f64,
}

impl Described for Selector {
    fn new(settings: &Settings) -> Result<Self, String> {
        Ok(Self { begins: settings.optional("begins", Settings::number)?.unwrap_or(0.0) })
    }

    fn start(&self, start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        Ok(Some(Box::new(Operating::new(start, self.begins.trunc(), f64::trunc))))
    }
}
