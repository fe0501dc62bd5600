//! Numbers that are shown to people, or to a supervisory computer.

use super::settings::Settings;
use super::{Described, Level, Schema};
use crate::device::PortType;

pub const SCHEMA: Schema = Schema {
    levels: &[
        Level { name: "number", ty: PortType::WHOLE },
        Level { name: "value", ty: PortType::Real },
    ],
    ..Schema::new(
        "display",
        "Shows a number to people or to a supervisory computer, such as a count, a recipe or a level: `number` a whole number, `value` another one. It has no effect in the plant.",
        &[],
    )
};

#[derive(Clone, Debug, PartialEq)]
pub struct Display;

impl Described for Display {
    fn new(_settings: &Settings) -> Result<Self, String> {
        Ok(Self)
    }
}
