//! A light beam across a lane, or another switch that items on it actuate.

use super::lane::{AT_ONCE, OnLane, Rider};
use super::settings::{Form, Setting, Settings};
use super::{Described, Running, Schema, See, Signal, Start};
use crate::device::{Extent, PortType};
use crate::line::Kind;

pub const SCHEMA: Schema = Schema {
    signals: &[
        Signal { name: "sees", ty: PortType::Bool, extent: Extent::One },
        Signal { name: "sees_kind", ty: PortType::Bool, extent: Extent::PerKind },
    ],
    ..Schema::new(
        "beam",
        "A light barrier across a lane: `sees` is true while an item is in the beam, from its front edge to its rear edge; `sees_kind` is for the kind of that item. With `over` the beam is at this height and sees only taller items. With `only` it sees only kinds with this word, such as `metal`: an inductive sensor or a colour sensor.",
        &[
            Setting::new("across", Form::Part(&["lane"]), "", "the lane"),
            Setting::new("at", Form::Number, "m", "from the lane's beginning"),
            Setting::new("over", Form::Number, "m", "height over the surface").optional(),
            Setting::new("only", Form::Word, "", "word that a kind of the scenario has to have").optional(),
        ],
    )
};

#[derive(Clone, Debug, PartialEq)]
pub struct Beam {
    pub lane: usize,
    pub at: f64,
    pub over: f64,
    pub only: Option<String>,
}

impl Described for Beam {
    fn new(settings: &Settings) -> Result<Self, String> {
        Ok(Self {
            lane: settings.part("across")?,
            at: settings.number("at")?,
            over: settings.optional("over", Settings::number)?.unwrap_or(0.0),
            only: settings.optional("only", Settings::word)?.map(Into::into),
        })
    }

    fn start(&self, start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        Ok(Some(Box::new(Crossing::new(self, &start.line.kinds))))
    }
}

/// A beam at work.
#[derive(Clone, Debug)]
pub struct Crossing {
    beam: Beam,
    /// Of each kind.
    is_seen: Vec<bool>,
}

impl Crossing {
    pub fn new(beam: &Beam, kinds: &[Kind]) -> Self {
        let is_seen = |kind: &Kind| beam.only.as_ref().is_none_or(|only| kind.is.contains(only));
        Self { beam: beam.clone(), is_seen: kinds.iter().map(is_seen).collect() }
    }

    /// The items of the lane that are in the beam, the foremost first.
    pub fn items(&self, see: &See) -> impl Iterator<Item = usize> {
        self.riders(see).map(|rider| rider.item)
    }

    /// Whether an item of the lane is in the beam at a time from the start of this span on, ms.
    pub fn is_crossed_by(&self, item: usize, ms: f64, see: &See) -> bool {
        let Some(moving) = see.lane(self.beam.lane) else { return false };
        let beam = moving.lane().centre_line.begin() - self.beam.at;
        let mut riders = moving.riders.iter().filter(|rider| rider.item == item);
        riders.any(|rider| {
            let place = moving.place_at(rider.motion, ms);
            place - rider.half <= beam + AT_ONCE && place + rider.half >= beam - AT_ONCE
        })
    }

    fn riders<'a>(&self, see: &See<'a>) -> impl Iterator<Item = &'a Rider> {
        let moving = see.lane(self.beam.lane);
        moving.into_iter().flat_map(|moving| {
            let beam = moving.lane().centre_line.begin() - self.beam.at;
            moving.riders.iter().filter(move |rider| is_in_beam(moving.place_now(rider), rider.half, beam))
        })
    }

    /// What it sees, on the lane or on other items there.
    pub fn seen(&self, see: &See) -> impl Iterator<Item = OnLane> {
        let items = see.items;
        let moving = see.lane(self.beam.lane);
        moving.into_iter().flat_map(move |moving| {
            let beam = moving.lane().centre_line.begin() - self.beam.at;
            let all = moving.riders.iter().flat_map(move |rider| moving.on_lane(rider.item, rider.motion, items));
            all.filter(move |on_lane| {
                let is_in = is_in_beam(on_lane.place(moving), on_lane.half, beam);
                is_in && on_lane.top > self.beam.over && self.is_seen[items[on_lane.item].kind]
            })
        })
    }
}

/// From its front edge to its rear edge, of an item with its middle there and half of this length along the lane.
fn is_in_beam(place: f64, half: f64, beam: f64) -> bool {
    let beam = beam + AT_ONCE;
    place - half <= beam && place + half > beam
}

impl Running for Crossing {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    /// An edge of an item comes to the beam.
    fn next_change(&self, see: &See, now_ms: u64) -> f64 {
        let Some(moving) = see.lane(self.beam.lane) else { return f64::INFINITY };
        let beam = moving.lane().centre_line.begin() - self.beam.at;
        let all = moving.riders.iter().flat_map(|rider| moving.on_lane(rider.item, rider.motion, see.items));
        let edges = all.flat_map(|on_lane| {
            let comes_to = |place| on_lane.comes_to(place, moving, now_ms as f64);
            [comes_to(beam + on_lane.half), comes_to(beam - on_lane.half)]
        });
        edges.fold(f64::INFINITY, f64::min)
    }

    fn signal(&self, signal: usize, see: &See, out: &mut [f64]) {
        out.fill(0.0);
        for OnLane { item, .. } in self.seen(see) {
            out[if signal == 0 { 0 } else { see.items[item].kind }] = 1.0;
        }
    }
}
