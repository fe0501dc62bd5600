//! A positioned joint that carries a chain: it slides along an axis of the world, or turns about the vertical.

use super::{Described, Schema};
use super::settings::{Form, Setting, Settings};
use crate::point::{self, Point};

pub const SCHEMA: Schema = Schema::new(
    "axis",
    "A joint that carries a chain and moves with it. With `range` it slides; without `range` it turns about the vertical.",
    &[
        Setting::new("on", Form::Part(&["axis"]), "", "the joint before it").optional(),
        Setting::new(
            "at",
            Form::Point,
            "m",
            "a point of its line, with z the height of the chain's shoulder; only for the first joint",
        )
        .optional(),
        Setting::new("along", Form::Axis, "", "axis of the world along which it slides").optional(),
        Setting::new("range", Form::Range, "m", "both ends along that axis, in the world").optional(),
        Setting::new("speed", Form::Positive, "m/s or rad/s", "greatest velocity"),
        Setting::new("acceleration", Form::Positive, "m/s2 or rad/s2", "greatest acceleration, initially"),
        Setting::new("joint", Form::Word, "", "its name, in the world"),
        Setting::new("link", Form::Word, "", "name of its link, in the world"),
        Setting::new("mass", Form::Number, "kg", "of its link, for the world"),
        Setting::new("effort", Form::Number, "N or N m", "greatest, for the world"),
        Setting::new("damping", Form::Number, "N s/m or N m s/rad", "for the world"),
        Setting::new("friction", Form::Number, "N or N m", "for the world"),
    ],
);

#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    pub on: Option<usize>,
    /// None for a joint on another one.
    pub at: Option<Point>,
    pub motion: Motion,
    pub speed: f64,
    pub acceleration: f64,
    pub joint: String,
    pub link: String,
    pub mass: f64,
    pub effort: f64,
    pub damping: f64,
    pub friction: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    Slides { along: point::Axis, range: [f64; 2] },
    Turns,
}

impl Described for Axis {
    fn new(settings: &Settings) -> Result<Self, String> {
        let motion = if settings.has("range") || settings.has("along") {
            Motion::Slides { along: settings.axis("along")?, range: settings.range("range")? }
        } else {
            Motion::Turns
        };
        if settings.has("on") == settings.has("at") {
            return Err("of the settings on and at it has one: at for the first joint, on for the others".into());
        }
        Ok(Self {
            on: settings.optional("on", Settings::part)?,
            at: settings.optional("at", Settings::point)?,
            motion,
            speed: settings.positive("speed")?,
            acceleration: settings.positive("acceleration")?,
            joint: settings.word("joint")?.into(),
            link: settings.word("link")?.into(),
            mass: settings.number("mass")?,
            effort: settings.number("effort")?,
            damping: settings.number("damping")?,
            friction: settings.number("friction")?,
        })
    }
}

impl Axis {
    /// None for a joint that turns.
    pub fn range(&self) -> Option<[f64; 2]> {
        match self.motion {
            Motion::Slides { range, .. } => Some(range),
            Motion::Turns => None,
        }
    }
}
