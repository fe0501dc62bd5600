//! A field over a lane in which items are seen, with their kinds and places.

use super::settings::{Form, Setting, Settings};
use super::lane::{self, Lane};
use super::{Described, Primitive, Running, Schema, See, Signal, Start};
use crate::device::{Extent, PortType};
use crate::line::Kind;
use crate::point::Point;

pub const SCHEMA: Schema = Schema {
    signals: &[
        Signal { name: "sees", ty: PortType::Bool, extent: Extent::PerKind },
        Signal { name: "foremost", ty: PortType::Point, extent: Extent::PerKind },
    ],
    ..Schema::new(
        "zone",
        "A field over a lane: the kinds that are wholly in it, and the place of the foremost item of each.",
        &[
            Setting::new("over", Form::Part(&["lane"]), "", "the lane"),
            Setting::new("middle", Form::Point, "m", "the middle of the field, along the lane"),
            Setting::new("half", Form::Positive, "m", "half of the field's length"),
            Setting::new(
                "part_half",
                Form::Number,
                "m",
                "half of the least length of an item",
            ),
        ],
    )
};

#[derive(Clone, Debug, PartialEq)]
pub struct Zone {
    pub lane: usize,
    pub middle: Point,
    pub half: f64,
    pub part_half: f64,
}

impl Described for Zone {
    fn new(settings: &Settings) -> Result<Self, String> {
        Ok(Self {
            lane: settings.part("over")?,
            middle: settings.point("middle")?,
            half: settings.positive("half")?,
            part_half: settings.number("part_half")?,
        })
    }

    fn start(&self, start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        let parts = &start.line.machines[start.machine].parts;
        let Some(Primitive::Lane(lane)) = parts.get(self.lane).map(|part| &part.primitive) else {
            return Err("a zone is over a lane".into());
        };
        Ok(Some(Box::new(Seeing::new(self, lane, &start.line.kinds))))
    }
}

/// A zone at work.
#[derive(Clone, Debug)]
pub struct Seeing {
    zone: Zone,
    /// By kind: how far the middle of an item that lies wholly in the field is from the field's at most.
    farthest: Vec<f64>,
}

impl Seeing {
    pub fn new(zone: &Zone, lane: &Lane, kinds: &[Kind]) -> Self {
        let half = |kind: &Kind| (lane.lengths_of(kind.size)[0] / 2.0).max(zone.part_half);
        Self { zone: zone.clone(), farthest: kinds.iter().map(|kind| zone.half - half(kind)).collect() }
    }

    /// All items that lie wholly in the field, and where they are along the lane.
    fn seen<'a>(&'a self, see: &'a See<'a>) -> impl Iterator<Item = (usize, f64)> + 'a {
        let lane = see.lane(self.zone.lane).and_then(|moving| Some((moving, self.middle(moving)?)));
        lane.into_iter().flat_map(move |(moving, middle)| {
            see.borne_by(self.zone.lane).filter_map(move |number| {
                let item = &see.items[number];
                let along = moving.place_of(number, &item.carrier)?;
                ((along - middle).abs() <= self.farthest[item.kind]).then_some((number, along))
            })
        })
    }

    /// Of each kind the foremost one.
    fn foremost(&self, see: &See) -> Vec<Option<(usize, f64)>> {
        let mut foremost: Vec<Option<(usize, f64)>> = vec![None; self.farthest.len()];
        for (number, along) in self.seen(see) {
            let of_kind = &mut foremost[see.items[number].kind];
            if of_kind.is_none_or(|(_, other)| along < other) {
                *of_kind = Some((number, along));
            }
        }
        foremost
    }

    /// Place of the field's middle on the lane.
    fn middle(&self, moving: &lane::Moving) -> Option<f64> {
        Some(moving.lane().centre_line.find(self.zone.middle)?.0)
    }
}

impl Running for Seeing {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    /// An item comes into the field, or leaves it.
    fn next_change(&self, see: &See, now_ms: u64) -> f64 {
        let Some(moving) = see.lane(self.zone.lane) else { return f64::INFINITY };
        let Some(middle) = self.middle(moving) else { return f64::INFINITY };
        let times = see.borne_by(self.zone.lane).flat_map(|number| {
            let item = &see.items[number];
            let far = self.farthest[item.kind];
            let motion = moving.motion(number, &item.carrier);
            let comes_to = |place: f64| motion.map(|motion| moving.comes_to(motion, place, now_ms as f64));
            [comes_to(middle - far), comes_to(middle + far)].into_iter().flatten()
        });
        times.fold(f64::INFINITY, f64::min)
    }

    fn signal(&self, signal: usize, see: &See, out: &mut [f64]) {
        out.fill(0.0);
        if signal == 0 {
            self.seen(see).for_each(|(number, _)| out[see.items[number].kind] = 1.0);
            return;
        }
        for (kind, foremost) in self.foremost(see).into_iter().enumerate() {
            let place = foremost.and_then(|(number, _)| see.place(self.zone.lane, number));
            if let Some(Point { x, y, z }) = place {
                out[3 * kind..3 * kind + 3].copy_from_slice(&[x, y, z]);
            }
        }
    }
}
