//! What leads items from one lane to another.

use super::settings::{Form, Setting, Settings};
use super::{Described, Schema};

pub const SCHEMA: Schema = Schema::new(
    "diverter",
    "While its cylinder is at its outer end, leads an item to the beginning of another lane when the front edge of the item is at it. While the cylinder moves, or is at its inner end, items pass.",
    &[
        Setting::new("of", Form::Part(&["lane"]), "", "the lane"),
        Setting::new("at", Form::Number, "m", "from the lane's beginning to where front edges are at it"),
        Setting::new("by", Form::Part(&["cylinder"]), "", "the cylinder that moves it"),
        Setting::new("onto", Form::Part(&["lane"]), "", "the other lane"),
    ],
);

#[derive(Clone, Debug, PartialEq)]
pub struct Diverter {
    pub lane: usize,
    pub at: f64,
    pub cylinder: usize,
    pub onto: usize,
}

impl Described for Diverter {
    fn new(settings: &Settings) -> Result<Self, String> {
        Ok(Self {
            lane: settings.part("of")?,
            at: settings.number("at")?,
            cylinder: settings.part("by")?,
            onto: settings.part("onto")?,
        })
    }
}
