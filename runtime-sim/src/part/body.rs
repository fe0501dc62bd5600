//! A body of simple shape on a link of its machine: for contact, drawing and the world.

use super::{Described, Schema};
use super::settings::{Form, Setting, Settings};
use crate::kinematics::pose::Pose;
use crate::point::Point;
use crate::solid::Shape;

pub const SCHEMA: Schema = Schema::new(
    "body",
    "A box, given by two corners or by its middle and size, or a capsule, given by an end, a direction, a length and a radius.",
    &[
        Setting::new(
            "on",
            Form::Part(&["route", "track", "axis", "chain", "cylinder", "positioner"]),
            "",
            "what moves it; without it, it is at rest",
        )
        .optional(),
        Setting::new("at", Form::Frame, "m", "frame of the other settings, in the frame of its link").optional(),
        Setting::new("low", Form::Point, "m", "lower corner of a box, in the frame of its link").optional(),
        Setting::new("high", Form::Point, "m", "upper corner").optional(),
        Setting::new("middle", Form::Point, "m", "middle of a box").optional(),
        Setting::new("size", Form::Point, "m", "lengths of a box").optional(),
        Setting::new("from", Form::Point, "m", "first end of a capsule's segment").optional(),
        Setting::new("direction", Form::Word, "", "direction of the segment: x, y or z of the frame")
            .optional(),
        Setting::new("length", Form::Positive, "m", "of the segment").optional(),
        Setting::new("radius", Form::Positive, "m", "of a capsule").optional(),
        Setting::new("grips", Form::Truth, "", "items hang on it; a separate link in the world").optional(),
    ],
);

#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Part and frame that move it.
    pub on: Option<(usize, usize)>,
    /// In that frame, or in the world.
    pub pose: Pose,
    pub shape: Shape,
    /// Items hang on it.
    pub grips: bool,
}

impl Described for Body {
    fn new(settings: &Settings) -> Result<Self, String> {
        let on = settings.optional("on", Settings::frame)?;
        let grips = settings.has("grips") && settings.truth("grips")?;
        let at = |position: Point| Pose { position, ..Pose::IDENTITY };
        let (pose, shape) = if settings.has("low") {
            let (low, high) = (settings.point("low")?, settings.point("high")?);
            let middle = Point::new((low.x + high.x) / 2.0, (low.y + high.y) / 2.0, (low.z + high.z) / 2.0);
            (at(middle), Shape::Box { size: high - low })
        } else if settings.has("middle") {
            (at(settings.point("middle")?), Shape::Box { size: settings.point("size")? })
        } else {
            capsule(settings)?
        };
        let frame = settings.optional("at", Settings::upright)?;
        let pose = frame.map_or(pose, |frame| frame.pose().then(&pose));
        match shape {
            Shape::Box { size } if size.x <= 0.0 || size.y <= 0.0 || size.z <= 0.0 => {
                Err("a length of the box is not over 0".into())
            }
            _ => Ok(Self { on, pose, shape, grips }),
        }
    }
}

fn capsule(settings: &Settings) -> Result<(Pose, Shape), String> {
    let (length, radius) = (settings.positive("length")?, settings.positive("radius")?);
    // The capsule's own z lies along the segment.
    let rotation = match settings.word("direction")? {
        "x" => [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        "y" => [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
        "z" => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        other => return Err(format!("`{other}` is no direction: x, y or z")),
    };
    let half = Pose { position: Point::new(0.0, 0.0, length / 2.0), ..Pose::IDENTITY };
    let end = Pose { rotation, position: settings.point("from")? };
    Ok((end.then(&half), Shape::Capsule { length, radius }))
}
