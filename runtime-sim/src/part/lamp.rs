//! A signal lamp: it shows what the controller says.

use super::settings::{Form, Setting, Settings};
use super::{Described, Level, Schema};
use crate::device::PortType;
use crate::point::Point;

pub const SCHEMA: Schema = Schema {
    levels: &[Level { name: "on", ty: PortType::Bool }],
    ..Schema::new(
        "lamp",
        "A signal lamp. It has no effect in the plant.",
        &[
            Setting::new("at", Form::Point, "m", "its place"),
            Setting::new("colour", Form::Word, "", "such as red, yellow, green, blue or white"),
        ],
    )
};

#[derive(Clone, Debug, PartialEq)]
pub struct Lamp {
    pub at: Point,
    pub colour: String,
}

impl Described for Lamp {
    fn new(settings: &Settings) -> Result<Self, String> {
        Ok(Self { at: settings.point("at")?, colour: settings.word("colour")?.into() })
    }
}
