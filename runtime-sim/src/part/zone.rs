//! A field over a lane in which items are seen, with their kinds and places.

use super::settings::{Form, Setting, Settings};
use super::lane::{Moving, OnLane};
use super::{Described, Primitive, Running, Schema, See, Signal, Start};
use crate::device::{Extent, PortType};
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
        let Some(Primitive::Lane(_)) = parts.get(self.lane).map(|part| &part.primitive) else {
            return Err("a zone is over a lane".into());
        };
        Ok(Some(Box::new(Seeing::new(self))))
    }
}

/// A zone at work.
#[derive(Clone, Debug)]
pub struct Seeing {
    zone: Zone,
}

impl Seeing {
    pub fn new(zone: &Zone) -> Self {
        Self { zone: zone.clone() }
    }

    /// How far the middle of what lies wholly in the field is from the field's at most.
    fn farthest(&self, on_lane: &OnLane) -> f64 {
        self.zone.half - on_lane.half.max(self.zone.part_half)
    }

    /// Takes all on the lane, and on other items there.
    fn each(&self, moving: &Moving, see: &See, mut take: impl FnMut(&OnLane)) {
        for item in see.borne_by(self.zone.lane) {
            let Some(motion) = moving.motion(item, &see.items[item].carrier) else { continue };
            take(&moving.base_on_lane(item, motion, see.items));
            moving.loads_on_lane(item, motion, see.items).iter().for_each(&mut take);
        }
    }

    /// Takes what lies wholly in the field, with where it is along the lane.
    fn each_seen(&self, moving: &Moving, see: &See, mut take: impl FnMut(&OnLane, f64)) {
        let Some(middle) = self.middle(moving) else { return };
        self.each(moving, see, |on_lane| {
            let along = on_lane.place(moving);
            if (along - middle).abs() <= self.farthest(on_lane) {
                take(on_lane, along);
            }
        });
    }

    /// Of each of so many kinds the foremost one.
    fn foremost(&self, kinds: usize, moving: &Moving, see: &See) -> Vec<Option<(OnLane, f64)>> {
        let mut foremost: Vec<Option<(OnLane, f64)>> = vec![None; kinds];
        self.each_seen(moving, see, |on_lane, along| {
            let of_kind = &mut foremost[see.items[on_lane.item].kind];
            if of_kind.is_none_or(|(_, other)| along < other) {
                *of_kind = Some((*on_lane, along));
            }
        });
        foremost
    }

    /// Place of the field's middle on the lane.
    fn middle(&self, moving: &Moving) -> Option<f64> {
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
        let mut next_ms = f64::INFINITY;
        self.each(moving, see, |on_lane| {
            let far = self.farthest(on_lane);
            let comes_to = |place: f64| on_lane.comes_to(place, moving, now_ms as f64);
            next_ms = next_ms.min(comes_to(middle - far)).min(comes_to(middle + far));
        });
        next_ms
    }

    fn signal(&self, signal: usize, see: &See, out: &mut [f64]) {
        out.fill(0.0);
        let Some(moving) = see.lane(self.zone.lane) else { return };
        if signal == 0 {
            self.each_seen(moving, see, |on_lane, _| out[see.items[on_lane.item].kind] = 1.0);
            return;
        }
        for (kind, foremost) in self.foremost(out.len() / 3, moving, see).into_iter().enumerate() {
            let place = foremost.and_then(|(on_lane, _)| on_lane.point(moving, see));
            if let Some(Point { x, y, z }) = place {
                out[3 * kind..3 * kind + 3].copy_from_slice(&[x, y, z]);
            }
        }
    }
}
