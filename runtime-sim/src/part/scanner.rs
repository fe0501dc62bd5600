//! What a vehicle sees ahead of it.

use super::settings::{Form, Setting, Settings};
use super::{Described, Running, Schema, See, Signal, Start};
use crate::device::{Extent, PortType};

pub const SCHEMA: Schema = Schema {
    signals: &[Signal { name: "sees", ty: PortType::Bool, extent: Extent::One }],
    ..Schema::new(
        "scanner",
        "Sees vehicles on tracks ahead on its own track, also round corners: `sees` is true while the middle of one is within the field. It sees nothing else.",
        &[
            Setting::new("on", Form::Part(&["track"]), "", "the vehicle"),
            Setting::new("range", Form::Positive, "m", "of the field, along the track from the middle of the vehicle"),
            Setting::new("width", Form::Positive, "m", "of the field, to each side of the track and beyond its end"),
        ],
    )
};

#[derive(Clone, Debug, PartialEq)]
pub struct Scanner {
    /// A part of the machine.
    pub track: usize,
    pub range: f64,
    pub width: f64,
}

impl Described for Scanner {
    fn new(settings: &Settings) -> Result<Self, String> {
        Ok(Self {
            track: settings.part("on")?,
            range: settings.positive("range")?,
            width: settings.positive("width")?,
        })
    }

    fn start(&self, _start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        Ok(Some(Box::new(Scanning { scanner: self.clone(), sees: false })))
    }
}

/// A scanner at work: the plant tells it what it sees.
#[derive(Clone, Debug)]
pub struct Scanning {
    pub scanner: Scanner,
    pub sees: bool,
}

impl Running for Scanning {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    fn signal(&self, _signal: usize, _see: &See, out: &mut [f64]) {
        out[0] = f64::from(u8::from(self.sees));
    }

    fn scanner(&self) -> Option<&Scanning> {
        Some(self)
    }

    fn scanner_mut(&mut self) -> Option<&mut Scanning> {
        Some(self)
    }
}
