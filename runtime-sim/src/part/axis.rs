//! A positioned joint that carries a chain: it slides along an axis, or turns about the vertical.

use super::{Described, Schema};
use super::settings::{Form, Setting, Settings};
use crate::frame::Frame;
use crate::point::{Direction, Point};

pub const SCHEMA: Schema = Schema::new(
    "axis",
    "A joint that carries a chain and moves with it. With `range` it slides; without `range` it turns about the vertical. A chain of its own joints stands on one axis that slides, or on two and one that turns. A Cartesian robot has one to three that slide, at right angles.",
    &[
        Setting::new("on", Form::Part(&["axis"]), "", "the joint before it").optional(),
        Setting::new(
            "at",
            Form::Point,
            "m",
            "a point of its line, with z the height of the chain's shoulder; only for the first joint",
        )
        .optional(),
        Setting::new(
            "from",
            Form::Frame,
            "m",
            "instead of `at`, for a Cartesian robot: where its last axis is while all are at 0; the axes lie along those of this frame",
        )
        .optional(),
        Setting::new("along", Form::Direction, "", "axis of the world or of `from` along which it slides").optional(),
        Setting::new("range", Form::Range, "m", "both ends along that axis, in the world or from `from`").optional(),
        Setting::new("speed", Form::Positive, "m/s or rad/s", "greatest velocity"),
        Setting::new("acceleration", Form::Positive, "m/s2 or rad/s2", "greatest acceleration, initially"),
        Setting::new("joint", Form::Word, "", "its name, in the world").optional(),
        Setting::new("link", Form::Word, "", "name of its link, in the world").optional(),
        Setting::new("mass", Form::Number, "kg", "of its link, for the world; without it 10").optional(),
        Setting::new("effort", Form::Number, "N or N m", "greatest, for the world; without it 1000").optional(),
        Setting::new("damping", Form::Number, "N s/m or N m s/rad", "for the world; without it 0").optional(),
        Setting::new("friction", Form::Number, "N or N m", "for the world; without it 0").optional(),
    ],
);

#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// None for the first joint.
    pub on: Option<usize>,
    pub place: Option<Place>,
    pub motion: Motion,
    pub speed: f64,
    pub acceleration: f64,
    /// Without them it is named after the part.
    pub joint: Option<String>,
    pub link: Option<String>,
    pub mass: f64,
    pub effort: f64,
    pub damping: f64,
    pub friction: f64,
}

/// Where the first joint is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// A point of its line; ranges are in the world.
    At(Point),
    /// Where all are at 0.
    From(Frame),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    Slides { along: Direction, range: [f64; 2] },
    Turns,
}

impl Described for Axis {
    fn new(settings: &Settings) -> Result<Self, String> {
        let motion = if settings.has("range") || settings.has("along") {
            Motion::Slides { along: settings.direction("along")?, range: settings.range("range")? }
        } else {
            Motion::Turns
        };
        let at = settings.optional("at", Settings::point)?.map(Place::At);
        let from = settings.optional("from", Settings::upright)?.map(Place::From);
        let on = settings.optional("on", Settings::part)?;
        let place = match (on, at, from) {
            (None, Some(place), None) | (None, None, Some(place)) => Some(place),
            (Some(_), None, None) => None,
            _ => {
                return Err("of the settings on, at and from it has one: at or from for the first joint, on for the others".into());
            }
        };
        let number = |name: &str, default: f64| Ok::<f64, String>(settings.optional(name, Settings::number)?.unwrap_or(default));
        let word = |name: &str| Ok::<_, String>(settings.optional(name, Settings::word)?.map(Into::into));
        Ok(Self {
            on,
            place,
            motion,
            speed: settings.positive("speed")?,
            acceleration: settings.positive("acceleration")?,
            joint: word("joint")?,
            link: word("link")?,
            mass: number("mass", 10.0)?,
            effort: number("effort", 1000.0)?,
            damping: number("damping", 0.0)?,
            friction: number("friction", 0.0)?,
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

    /// Of a first joint whose ranges are not in the world, but in this frame.
    pub fn base(&self) -> Option<Frame> {
        match self.place {
            Some(Place::From(frame)) => Some(frame),
            Some(Place::At(_)) | None => None,
        }
    }

    /// A point of its line, for a first joint with ranges in the world.
    pub fn at(&self) -> Option<Point> {
        match self.place {
            Some(Place::At(point)) => Some(point),
            Some(Place::From(_)) | None => None,
        }
    }
}
