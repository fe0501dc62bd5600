//! What stops items on a lane.

use super::settings::{Form, Setting, Settings};
use super::{Described, Schema};

pub const SCHEMA: Schema = Schema::new(
    "stopper",
    "Stops items on a lane at their front edges, while its cylinder is not at its inner end. The surface continues under them. Items whose front edge has passed the stopper continue.",
    &[
        Setting::new("of", Form::Part(&["lane"]), "", "the lane"),
        Setting::new("at", Form::Number, "m", "from the lane's beginning to the place where front edges stop"),
        Setting::new("by", Form::Part(&["cylinder"]), "", "the cylinder that moves it"),
    ],
);

#[derive(Clone, Debug, PartialEq)]
pub struct Stopper {
    pub lane: usize,
    pub at: f64,
    pub cylinder: usize,
}

impl Described for Stopper {
    fn new(settings: &Settings) -> Result<Self, String> {
        Ok(Self {
            lane: settings.part("of")?,
            at: settings.number("at")?,
            cylinder: settings.part("by")?,
        })
    }
}
