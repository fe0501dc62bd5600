//! What pushes items off a lane, onto another one.

use super::settings::{Form, Setting, Settings};
use super::{Described, Schema};

pub const SCHEMA: Schema = Schema::new(
    "pusher",
    "Pushes items from a lane onto the beginning of another one. While its cylinder is not at its inner end, items with their middles in front of it stay there, and others stop before it. If the front edge of an item is in front of it already, the item goes on until its middle is, and stays there. When the cylinder is at its outer end, the items in front of it move to the other lane as soon as there is room.",
    &[
        Setting::new("of", Form::Part(&["lane"]), "", "the lane"),
        Setting::new("at", Form::Number, "m", "from the lane's beginning to the middle of its plate"),
        Setting::new("width", Form::Positive, "m", "of its plate, along the lane"),
        Setting::new("by", Form::Part(&["cylinder"]), "", "the cylinder that moves it"),
        Setting::new("onto", Form::Part(&["lane"]), "", "the other lane"),
    ],
);

#[derive(Clone, Debug, PartialEq)]
pub struct Pusher {
    pub lane: usize,
    pub at: f64,
    pub width: f64,
    pub cylinder: usize,
    pub onto: usize,
}

impl Described for Pusher {
    fn new(settings: &Settings) -> Result<Self, String> {
        Ok(Self {
            lane: settings.part("of")?,
            at: settings.number("at")?,
            width: settings.positive("width")?,
            cylinder: settings.part("by")?,
            onto: settings.part("onto")?,
        })
    }
}
