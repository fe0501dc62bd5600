//! A conveyor: items lie on it and go with it, until something is in their way.

mod centre_line;
mod moving;
mod on_lane;

pub use centre_line::CentreLine;
pub use moving::{AT_ONCE, Motion, Moving, Rider};
pub use on_lane::OnLane;

use super::settings::{Form, Setting, Settings};
use super::{Action, Described, Level, Running, Schema, Signal, Start};
use crate::device::{Extent, PortType};
use crate::point::Axis;
use crate::wiring::Drives;

pub const SCHEMA: Schema = Schema {
    signals: &[Signal { name: "moves", ty: PortType::Bool, extent: Extent::One }],
    levels: &[Level { name: "run", ty: PortType::Bool }, Level { name: "run_by", ty: PortType::Real }],
    actions: &[Action { name: "run", arguments: &[] }, Action { name: "rest", arguments: &[] }],
    can_jam: true,
    ..Schema::new(
        "lane",
        "A conveyor. It runs while its level `run` is on, or after its command `run` until `rest`; with neither it always runs, like a chute. Its level `run_by`, if it has this one, is the part of its full speed at which it then runs, from 0 to 1, like the setpoint of a converter; what is less counts as 0, what is more as 1. With `from` and `length` it has any direction, straight or as an arc; with `along`, `range` and `surface` it lies along an axis of the world, from the upper to the lower end of its range. It has no solid of its own: give the machine bodies, such as guards and a frame, so that contact with it is found.",
        &[
            Setting::new("on", Form::Part(&["cylinder", "positioner"]), "", "what carries it; `from` is then its frame at the inner end, or at 0").optional(),
            Setting::new("from", Form::Frame, "m", "its beginning, on its surface; x is its direction").optional(),
            Setting::new("length", Form::Positive, "m", "along its middle line").optional(),
            Setting::new("turn", Form::Number, "deg", "turn to the left over its length; without it, it is straight")
                .optional(),
            Setting::new("rise", Form::Number, "m", "height of its end over its beginning; less than 0 for a chute, and less than the length up or down").optional(),
            Setting::new("along", Form::Axis, "", "axis of the world along which it lies").optional(),
            Setting::new("range", Form::Range, "m", "both ends along this axis, in the world").optional(),
            Setting::new("surface", Form::Point, "m", "a point of its middle line").optional(),
            Setting::new("width", Form::Positive, "m", "of the moving surface"),
            Setting::new("outline", Form::Positive, "m", "width of the whole conveyor in drawings, if different")
                .optional(),
            Setting::new("speed", Form::Positive, "m/s", "full speed; the speed changes in steps"),
        ],
    )
};

#[derive(Clone, Debug, PartialEq)]
pub struct Lane {
    /// The cylinder that carries it.
    pub on: Option<usize>,
    /// At the inner end of what carries it.
    pub centre_line: CentreLine,
    pub width: f64,
    pub outline: f64,
    /// m/s.
    pub speed: f64,
}

/// Numbers of the levels.
pub const RUN: usize = 0;
pub const RUN_BY: usize = 1;

impl Described for Lane {
    fn new(settings: &Settings) -> Result<Self, String> {
        let width = settings.positive("width")?;
        let (on, centre_line) = (settings.optional("on", Settings::part)?, CentreLine::new(settings)?);
        if on.is_some() && !centre_line.turns_items() {
            return Err("a lane on a cylinder or a positioner is given by from and length".into());
        }
        Ok(Self {
            on,
            centre_line,
            width,
            outline: settings.optional("outline", Settings::positive)?.unwrap_or(width),
            speed: settings.positive("speed")?,
        })
    }

    fn start(&self, start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        let (part, wiring) = (start.part, &start.machine().wiring);
        let has = |level| wiring.outputs.iter().any(|output| output.drives == Drives::Level { part, level });
        let has_command = wiring.commands.iter().any(|command| command.part == part);
        let moving = Moving::new(self, part);
        let moving = if has(RUN) || has_command { moving } else { moving.always() };
        Ok(Some(Box::new(if has(RUN_BY) { moving.by(0.0) } else { moving })))
    }
}

impl Lane {
    /// Of an item with these lengths along its x and y: along the lane, and across it.
    pub fn lengths_of(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        match self.centre_line {
            CentreLine::Axis { along: Axis::Y, .. } => [y, x],
            CentreLine::Axis { along: Axis::X, .. } | CentreLine::Line { .. } | CentreLine::Arc { .. } => {
                [x, y]
            }
        }
    }

    /// Metres in so many milliseconds at full speed.
    pub fn distance(&self, ms: f64) -> f64 {
        self.speed * ms / 1000.0
    }
}
