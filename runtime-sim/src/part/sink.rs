//! Where items leave a lane.

use super::settings::{Form, Setting, Settings};
use super::{Described, Schema};

pub const SCHEMA: Schema = Schema::new(
    "sink",
    "Takes items off a lane near its end: they are collected.",
    &[
        Setting::new("of", Form::Part(&["lane"]), "", "the lane"),
        Setting::new("inset", Form::Number, "m", "from the lane's end to the place where the middles of items leave"),
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
}
