//! A logical camera that looks down, for the world.

use super::{Described, Schema};
use super::settings::{Form, Setting, Settings};
use crate::point::Point;

pub const SCHEMA: Schema = Schema::new(
    "camera",
    "Logical cameras that look straight down. They are only in the world; zones have the signals.",
    &[
        Setting::new("over", Form::Part(&["route"]), "", "one camera over each stop").optional(),
        Setting::new("at", Form::Points, "m", "from the machine's pose, or from each stop"),
        Setting::new(
            "yaw",
            Form::Number,
            "rad",
            "turn about the vertical; at 0 the longer side lies along y",
        ),
    ],
);

#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    pub route: Option<usize>,
    pub at: Vec<Point>,
    pub yaw: f64,
}

impl Described for Camera {
    fn new(settings: &Settings) -> Result<Self, String> {
        Ok(Self {
            route: settings.optional("over", Settings::part)?,
            at: settings.points("at")?,
            yaw: settings.number("yaw")?,
        })
    }
}

